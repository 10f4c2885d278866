//! The equations of motions, as the reduction to normal forms needs them.

use super::classes::Classes;
use super::equilibria::Equilibria;
use super::family::Neighbours;
use super::normal_form::{NormalForm, Order, Undetermined};
use super::orbits::Orbits;
use super::problem::Equations;
use super::reduction::{Size, System, leading};
use super::shooting::segment;
use motiform_analysis::equilibrium::Units;
use motiform_analysis::linear::{add, apply, basis, dot, norm};
use motiform_dynamics::Equivariant;

/// Shapes below this part of the unit of the equations are 0, which is no unit.
const ROUND_OFF: f64 = 1e-9;

/// The step is doubled so often; at rest it begins far smaller, as a part of the unit of the equations, and is doubled more often.
const DOUBLINGS: usize = 7;
const AT_REST: (f64, usize) = (0.05, 15);

/// The same beside an offset: up to the size of changes.
const BESIDE: usize = 12;

/// Error of the pairing of null vectors, as a part of their lengths: what their location leaves.
const PAIRED: f64 = 1e-9;

/// Places along an orbit at which the size of a deviation is read.
const PLACES: usize = 64;

/// The coefficient at a relative equilibrium.
pub(super) fn of_equilibrium(problem: &Equilibria<'_>, x: &[f64], order: Order) -> NormalForm {
    let Some(free) = problem.free(x) else { return NormalForm::Undetermined(Undetermined::Obstructed) };
    let (dim, shape) = (free.dim, &x[..free.dim]);
    let alike = free.bodies.at(x).is_ok_and(|body| Classes::of(body.as_ref(), &[shape]).circle);
    let size = free.extent(x);
    let Units { length, rate } = free.vicinity.units;
    let scale = length * rate;
    let at_rest = (AT_REST.0 * length, AT_REST.1);
    let (unit, doublings) = match size > ROUND_OFF * length {
        // the size of changes is a part of what that of a shape would be
        true if free.vicinity.is_offset() => (size, BESIDE),
        true => (size, DOUBLINGS),
        false => at_rest,
    };
    leading(
        &System {
            matrix: &|x| {
                Some(free.local(x, &()).ok()?.linear.matrix.columns(0, dim + 1).into_owned() * scale)
            },
            rows: dim,
            x,
            size: &|v| Some((norm(&v[..dim]), 0.0)),
            pairing: &|p, q| (dot(&p[..dim], &q[..dim]), PAIRED * norm(&p[..dim]) * norm(&q[..dim])),
            alike,
            unit,
            doublings,
        },
        order,
    )
}

/// The coefficient at a relative periodic orbit, or at the same orbit passed twice.
pub(super) fn of_orbit(problem: &Orbits<'_>, x: &[f64], order: Order, doubled: bool) -> NormalForm {
    let found = free(problem, x, doubled).map(|(free, x)| {
        let (dim, parts, rows) = (free.dim, free.parts, free.parts * free.dim);
        let unknowns = free.unknowns() - free.bodies.count();
        let time = x[rows];
        let through = |p: &[f64], q: &[f64]| {
            let node = |i: usize| i * dim..(i + 1) * dim;
            let all: Vec<f64> = (0..parts).map(|i| dot(&p[node(i)], &q[node((i + 1) % parts)])).collect();
            // it is the same at every node
            let mean = all.iter().sum::<f64>() / parts as f64;
            let off = all.iter().map(|value| (value - mean).abs()).fold(0.0, f64::max);
            (time * mean, time * (off + f64::EPSILON * norm(p) * norm(q)))
        };
        leading(
            &System {
                matrix: &|x| Some(free.local(x, &()).ok()?.linear.matrix.columns(0, unknowns).into_owned()),
                rows,
                x: &x,
                size: &|v| size_along(&free, &x, v),
                pairing: &through,
                alike: false,
                unit: free.size,
                doublings: DOUBLINGS,
            },
            order,
        )
    });
    found.unwrap_or(NormalForm::Undetermined(Undetermined::Obstructed))
}

/// The equations of all orbits nearby, whatever their symmetry, and the unknowns; of twice the time if `doubled`.
fn free<'f>(problem: &Orbits<'f>, x: &[f64], doubled: bool) -> Option<(Orbits<'f>, Vec<f64>)> {
    let body = problem.bodies.at(x).ok()?;
    let (parts, rows) = (problem.parts, problem.parts * problem.dim);
    let mirrored = problem.mirrored && !doubled;
    let free = Orbits {
        classes: Classes::of(body.as_ref(), &[]),
        parts: if doubled { 2 * parts } else { parts },
        mirrored,
        turns: body.symmetry().rotations && !mirrored,
        size: problem.extent(x),
        widths: problem.widths.clone(),
        family: Vec::new(),
        drift: if doubled { 2.0 * problem.drift } else { problem.drift },
        ..*problem
    };
    if !doubled {
        return Some((free, x.to_vec()));
    }
    let mut out = x[..rows].to_vec();
    for i in 0..parts {
        let mut image = problem.node(x, i).to_vec();
        if problem.mirrored {
            body.mirror(&mut image);
        }
        body.rotate(problem.angle(x), &mut image);
        out.extend(image);
    }
    out.push(2.0 * x[rows]);
    if free.turns {
        out.push(2.0 * problem.angle(x)); // 0 for a mirrored one
    }
    out.extend(&x[x.len() - problem.bodies.count()..]);
    Some((free, out))
}

/// The root mean square over the period of a deviation `v` of the unknowns, normal to the flow and the group, and its error: the difference
/// from the mean over half of the places. (The rule of trapezoids: of a periodic function it converges faster than any power.)
fn size_along(orbits: &Orbits<'_>, x: &[f64], v: &[f64]) -> Option<Size> {
    let neighbours =
        Neighbours::of(orbits.bodies, x, &orbits.widths, (orbits.length, orbits.round_off)).ok()?;
    let (parts, rows) = (orbits.parts, orbits.parts * orbits.dim);
    let each = PLACES.div_ceil(parts).next_multiple_of(2);
    let (span, stretch) = (orbits.span(x) / each as f64, v[rows] / (parts * each) as f64);
    let mut sums = [0.0; 2];
    for i in 0..parts {
        let mut shape = orbits.node(x, i).to_vec();
        let mut deviation = orbits.node(v, i).to_vec();
        for place in 0..each {
            sums[place % 2] += normal_part(neighbours.body.as_ref(), &shape, &deviation);
            let next = segment(&neighbours, &shape, span, &orbits.flow, &()).ok()?;
            deviation = apply(&next.tangents, &deviation);
            add(&mut deviation, stretch, &next.slope);
            shape = next.end;
        }
    }
    let count = (parts * each) as f64;
    let (all, half) = (((sums[0] + sums[1]) / count).sqrt(), (2.0 * sums[0] / count).sqrt());
    Some((all, (all - half).abs()))
}

/// The square of the part of a deviation normal to the flow and the group.
fn normal_part(body: &dyn Equivariant, shape: &[f64], deviation: &[f64]) -> f64 {
    let (rate, spin) = (body.rates(shape), body.spun(shape));
    let columns: Vec<&[f64]> =
        [&spin[..], &rate[..]].into_iter().filter(|column| column.iter().any(|x| *x != 0.0)).collect();
    let mut rest = deviation.to_vec();
    for direction in basis(&columns, 1e-8) {
        add(&mut rest, -dot(&direction, deviation), &direction);
    }
    dot(&rest, &rest)
}
