//! The branches that begin or cross at a special point.

use super::branch::Branch;
use super::classes::Classes;
use super::correct::{null_vectors, product, scaled};
use super::equilibria::Equilibria;
use super::family::{Bodies, Family};
use super::hopf::critical_pair;
use super::orbits::Orbits;
use super::point::{Motion, Point};
use super::problem::{Equations, Problem};
use super::settings::Settings;
use super::special::Special;
use super::tracer::Tracer;
use motiform_analysis::linear::{add, norm};
use motiform_analysis::{Error, PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_dynamics::{Equivariant, Watch};
use std::f64::consts::TAU;

/// Distances from the special point at which the new branch is looked for, in the units of [`Settings`].
const DISTANCES: [f64; 5] = [0.02, 0.05, 0.005, 0.1, 0.001];

/// Nodes of the orbits that begin at a Hopf bifurcation.
const NODES: usize = 8;

/// Vectors that the equations see less than this part of the largest are solutions to first order.
const NULL: f64 = 1e-6;

/// The branches that begin or cross at a special point, each on to one side from there; none at a fold, a continuum or a torus, nor where the special point is unresolved.
///
/// Where the two sides of a new branch are images of each other under the symmetry (a pitchfork, a symmetry breaking) or under time (a
/// period doubling, a Hopf bifurcation), there is one: its copies are not followed. The first step does not know the direction of
/// the parameter, so the sign of [`Settings::first_step`] means nothing here.
///
/// # Errors
/// [`Error::NotOnABranch`] if there is no new branch within reach of the point; settings out of range.
pub fn switch<'f>(
    family: &'f dyn Family,
    point: &Point,
    settings: &Settings,
    watch: &'f dyn Watch,
) -> Result<Vec<Branch<'f>>> {
    settings.check(point.parameter)?;
    let Some(special) = point.special else { return Ok(Vec::new()) };
    match (&point.motion, special) {
        (_, Special::Fold | Special::Continuum | Special::Torus { .. } | Special::Unresolved { .. }) => {
            Ok(Vec::new())
        }
        (Motion::Equilibrium(start), Special::Hopf(hopf)) => {
            begin(family, (point.parameter, start, hopf.frequency), settings, watch)
                .map(|branch| vec![branch])
        }
        (Motion::Equilibrium(start), _) => {
            let sides: &[f64] = if special == Special::BranchPoint { &[1.0, -1.0] } else { &[1.0] };
            sides.iter().map(|&side| cross(family, (point.parameter, start, side), settings, watch)).collect()
        }
        (Motion::Orbit { orbit, nodes }, _) => {
            let sides: &[f64] = if special == Special::BranchPoint { &[1.0, -1.0] } else { &[1.0] };
            let doubled = matches!(special, Special::PeriodDoubling | Special::SymmetryBreaking);
            let new = |&side| leave(family, (point.parameter, orbit, nodes, doubled, side), settings, watch);
            sides.iter().map(new).collect()
        }
    }
}

fn nothing(parameter: f64) -> Error {
    let why = "Newton's method finds none beside the special point".to_owned();
    Error::NotOnABranch { what: "new branch", parameter, why }
}

/// Follows the new branch from the nearest point that Newton's method reaches.
fn follow<P: Problem>(
    mut problem: P,
    (origin, direction): (&[f64], &[f64]),
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<Tracer<P>> {
    for distance in DISTANCES {
        match Tracer::beside(problem, (origin, direction, distance), settings, watch) {
            Ok(tracer) => return Ok(tracer),
            Err((back, _)) => problem = back,
        }
    }
    Err(nothing(origin.last().copied().unwrap_or(f64::NAN)))
}

/// A direction of the new branch: what the equations do not see to first order, and leaves the parameter as it is.
fn direction<P: Problem>(problem: &P, x: &[f64]) -> Option<Vec<f64>> {
    let local = problem.local(x, &()).ok()?;
    let weights = problem.weights(x);
    let null = null_vectors(problem.linear(&local), NULL, &weights);
    let last = |v: &Vec<f64>| v.last().copied().unwrap_or(0.0);
    let along = null.iter().max_by(|a, b| last(a).abs().total_cmp(&last(b).abs()))?;
    let across = |v: &Vec<f64>| {
        let mut out = v.clone();
        add(&mut out, -last(v) / last(along), along);
        out
    };
    let candidates = null.iter().filter(|v| !std::ptr::eq(*v, along)).map(across);
    let length = |v: &Vec<f64>| product(&weights, v, v);
    let best = candidates.max_by(|a, b| length(a).total_cmp(&length(b)))?;
    scaled(best, &weights)
}

/// Another branch of relative equilibria.
fn cross<'f>(
    family: &'f dyn Family,
    (parameter, start, side): (f64, &RelativeEquilibrium, f64),
    settings: &Settings,
    watch: &'f dyn Watch,
) -> Result<Branch<'f>> {
    let mut problem = Equilibria::near(Bodies::One(family), &[parameter], &start.shape, &[settings.width()])?;
    let body = family.at(parameter)?;
    problem.classes = Classes::of(body.as_ref(), &[]);
    let mut x = start.shape.clone();
    x.extend([start.turning_rate, parameter]);
    let direction = direction(&problem, &x).ok_or_else(|| nothing(parameter))?;
    let direction: Vec<f64> = direction.iter().map(|d| side * d).collect();
    let mut tracer = follow(problem, (&x, &direction), settings, watch)?;
    let dim = start.shape.len();
    let shape = tracer.unknowns()[..dim].to_vec();
    tracer.problem_mut().classes = Classes::of(body.as_ref(), &[&shape]);
    tracer.renew();
    Ok(Branch::equilibria(tracer, watch))
}

/// Another branch of orbits, of twice the length if `doubled`.
fn leave<'f>(
    family: &'f dyn Family,
    (parameter, orbit, nodes, doubled, side): (f64, &PeriodicOrbit, &[Vec<f64>], bool, f64),
    settings: &Settings,
    watch: &'f dyn Watch,
) -> Result<Branch<'f>> {
    let body = family.at(parameter)?;
    let mut all = nodes.to_vec();
    let (mut time, mut angle) = (orbit.time, orbit.angle);
    if doubled {
        let image = |node: &Vec<f64>| {
            let mut image = node.clone();
            if orbit.mirrored {
                body.mirror(&mut image);
            }
            body.rotate(orbit.angle, &mut image);
            image
        };
        all.extend(nodes.iter().map(image));
        time *= 2.0;
        angle = if orbit.mirrored { 0.0 } else { 2.0 * angle };
    }
    let mirrored = orbit.mirrored && !doubled;
    let problem = orbits(family, body.as_ref(), (&all, mirrored), settings);
    let x = unknowns(&problem, &all, (time, angle, parameter));
    let direction = direction(&problem, &x).ok_or_else(|| nothing(parameter))?;
    let direction: Vec<f64> = direction.iter().map(|d| side * d).collect();
    Ok(Branch::orbits(follow(problem, (&x, &direction), settings, watch)?, watch))
}

fn orbits<'f>(
    family: &'f dyn Family,
    body: &dyn Equivariant,
    (nodes, mirrored): (&[Vec<f64>], bool),
    settings: &Settings,
) -> Orbits<'f> {
    let size = nodes.iter().map(|node| norm(node)).fold(0.0, f64::max);
    Orbits {
        bodies: Bodies::One(family),
        flow: settings.flow,
        classes: Classes::of(body, &[]),
        dim: body.dim(),
        parts: nodes.len(),
        mirrored,
        turns: body.symmetry().rotations && !mirrored,
        size: if size > 1e-6 { size } else { 1.0 },
        widths: vec![settings.width()],
    }
}

fn unknowns(problem: &Orbits<'_>, nodes: &[Vec<f64>], (time, angle, parameter): (f64, f64, f64)) -> Vec<f64> {
    let mut x = nodes.concat();
    x.push(time);
    if problem.turns {
        x.push(angle);
    }
    x.push(parameter);
    x
}

/// The orbits that begin at a Hopf bifurcation. Where the oscillation swings a shape from one side of its mirror axis to the other,
/// half the period brings its mirror image.
fn begin<'f>(
    family: &'f dyn Family,
    (parameter, start, frequency): (f64, &RelativeEquilibrium, f64),
    settings: &Settings,
    watch: &'f dyn Watch,
) -> Result<Branch<'f>> {
    let body = family.at(parameter)?;
    let body = body.as_ref();
    let (mut re, mut im) = critical_pair(body, &start.shape, frequency).ok_or_else(|| nothing(parameter))?;
    let mut shape = start.shape.clone();
    let mirrored = is_odd(body, &shape, &re);
    if let (true, Some(axis)) = (mirrored, Classes::of(body, &[&shape]).axis) {
        for vector in [&mut shape, &mut re, &mut im] {
            body.rotate(-0.5 * axis, vector);
        }
    }
    let time = TAU / frequency * if mirrored { 0.5 } else { 1.0 };
    let (mut nodes, mut swings) = (Vec::new(), Vec::new());
    for i in 0..NODES {
        let t = time * i as f64 / NODES as f64;
        let (sin, cos) = libm::sincos(frequency * t);
        let (mut node, mut swing) = (shape.clone(), vec![0.0; shape.len()]);
        add(&mut swing, cos, &re);
        add(&mut swing, -sin, &im);
        body.rotate(start.turning_rate * t, &mut node);
        body.rotate(start.turning_rate * t, &mut swing);
        nodes.push(node);
        swings.push(swing);
    }
    let problem = orbits(family, body, (&nodes, mirrored), settings);
    let x = unknowns(&problem, &nodes, (time, start.turning_rate * time, parameter));
    let mut direction = swings.concat();
    direction.resize(x.len(), 0.0);
    let direction = scaled(direction, &problem.weights(&x)).ok_or_else(|| nothing(parameter))?;
    Ok(Branch::orbits(follow(problem, (&x, &direction), settings, watch)?, watch))
}

/// Whether a shape has a mirror axis and the deviation is odd under it.
fn is_odd(body: &dyn Equivariant, shape: &[f64], deviation: &[f64]) -> bool {
    let classes = Classes::of(body, &[shape]);
    let even = |basis: &Vec<Vec<f64>>| {
        basis.iter().map(|v| motiform_analysis::linear::dot(v, deviation).abs()).fold(0.0, f64::max)
    };
    classes.axis.is_some() && even(&classes.bases[0]) < 1e-6 * norm(deviation)
}
