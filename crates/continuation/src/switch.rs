//! The branches that begin or cross at a special point.

use super::branch::Branch;
use super::classes::Classes;
use super::correct::{correct, crossing, normal, product, scaled};
use super::equilibria::Equilibria;
use super::family::{Bodies, Family};
use super::hopf::critical_pair;
use super::leaving::leaving;
use super::levels::Level;
use super::orbits::Orbits;
use super::point::{Motion, Point};
use super::problem::{Equations, Problem};
use super::settings::Settings;
use super::special::{Broken, Special};
use super::tangents::tangents;
use super::tracer::Tracer;
use motiform_analysis::linear::{add, norm};
use motiform_analysis::{Error, PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_dynamics::{Equivariant, Watch};
use std::f64::consts::TAU;

/// Distances from the special point at which the new branch is looked for, in the units of [`Settings`].
const DISTANCES: [f64; 7] = [0.005, 0.02, 0.05, 0.1, 0.001, 0.0002, 0.00004];

/// How much nearer the branch is looked at again, and the ratios of the two changes of the parameter where it begins: this one to the power
/// 1 or 2, within a factor 2.
const NEARER: f64 = 8.0;
const RATIOS: std::ops::RangeInclusive<f64> = 0.5 * NEARER..=2.0 * NEARER * NEARER;

/// Levels below this may have either sign next to a special point.
const UNCLEAR: f64 = 1e-6;

/// Least change of the parameter that tells anything, in tolerances of Newton's method.
const SEEN: f64 = 100.0;

/// A special point: its unknowns, a direction that a new branch leaves in, and in how many directions deviations grow on that branch at first.
struct Begin<'b> {
    origin: &'b [f64],
    direction: &'b [f64],
    growing: std::ops::RangeInclusive<usize>,
}

impl<'b> Begin<'b> {
    /// Deviations grow in the directions in which they do at the point, and at most in those of the critical levels too.
    fn at(point: &Point, origin: &'b [f64], direction: &'b [f64]) -> Self {
        let twice = matches!(point.special, Some(Special::Pitchfork { breaks: Broken::Rotations }));
        let critical = if twice { 2 } else { 1 };
        Self { origin, direction, growing: point.unstable..=point.unstable + critical }
    }
}

/// Nodes of the orbits that begin at a Hopf bifurcation.
const NODES: usize = 8;

/// The branches that begin or cross at a special point, each with its legs: one where it begins, two where it crosses; none at a fold, a
/// continuum or a torus, nor where the special point is unresolved.
///
/// Where the two sides of a new branch are images of each other under the symmetry (a pitchfork, a symmetry breaking) or under time (a
/// period doubling, a Hopf bifurcation), there is one: its copies are not followed. A shape with three or more axes may lose its rotations
/// in two ways that are no images of each other: two branches. The first step does not know the direction of
/// the parameter, so the sign of [`Settings::first_step`] means nothing here.
///
/// # Errors
/// [`Error::NotOnABranch`] if there is no new branch within reach of the point; settings out of range.
pub fn switch<'f>(
    family: &'f dyn Family,
    point: &Point,
    settings: &Settings,
    watch: &'f dyn Watch,
) -> Result<Vec<Vec<Branch<'f>>>> {
    settings.check(point.parameter)?;
    let Some(special) = point.special else { return Ok(Vec::new()) };
    let sides: &[f64] = if special == Special::BranchPoint { &[1.0, -1.0] } else { &[1.0] };
    match (&point.motion, special) {
        (_, Special::Fold | Special::Continuum | Special::Torus { .. } | Special::Unresolved { .. }) => {
            Ok(Vec::new())
        }
        (Motion::Equilibrium(start), Special::Hopf(hopf)) => {
            begin(family, (point, start, hopf.frequency), settings, watch).map(|branch| vec![vec![branch]])
        }
        (Motion::Equilibrium(start), Special::Pitchfork { .. }) => {
            fork(family, (point, start), settings, watch)
        }
        (Motion::Equilibrium(start), _) => {
            let (problem, x) = crossed(family, point, start, settings)?;
            let direction = direction(&problem, &x, point).ok_or_else(|| nothing(point.parameter))?;
            let leg = |&side| cross(family, (point, start, &turned(&direction, side)), settings, watch);
            sides.iter().map(leg).collect::<Result<_>>().map(|legs| vec![legs])
        }
        (Motion::Orbit { orbit, nodes }, _) => {
            let doubled = matches!(special, Special::PeriodDoubling | Special::SymmetryBreaking);
            let new = |&side| leave(family, (point, (orbit, nodes), doubled, side), settings, watch);
            sides.iter().map(new).collect::<Result<_>>().map(|legs| vec![legs])
        }
    }
}

fn nothing(parameter: f64) -> Error {
    let why = "Newton's method finds none beside the special point".to_owned();
    Error::NotOnABranch { what: "new branch", parameter, why }
}

/// Follows the new branch from a point at which as many deviations grow as the special point lets expect, and up to which the parameter
/// changes as a branch begins: otherwise there may be another special point on the way, and a nearer one is looked for.
fn follow<P: Problem>(
    mut problem: P,
    &Begin { origin, direction, ref growing }: &Begin<'_>,
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<Tracer<P>> {
    let mut farthest = f64::INFINITY;
    let mut doubtful = None;
    for distance in DISTANCES {
        if distance > farthest {
            continue;
        }
        match Tracer::beside(problem, (origin, direction, distance), settings, watch) {
            Ok(tracer)
                if growing.contains(&tracer.growing())
                    && is_beginning(&tracer, (origin, direction, distance), settings, watch) =>
            {
                return Ok(tracer);
            }
            Ok(tracer) => {
                farthest = distance;
                problem = tracer.into_problem();
                doubtful = Some(distance);
            }
            Err((back, _)) => problem = back,
        }
    }
    let nothing = || nothing(origin.last().copied().unwrap_or(f64::NAN));
    let distance = doubtful.ok_or_else(nothing)?;
    Tracer::beside(problem, (origin, direction, distance), settings, watch).map_err(|_| nothing())
}

/// Whether nothing happens between the special point and the first point of a new branch: the parameter changes with the distance from the
/// special point, or with its square, and as many deviations grow nearer to it.
fn is_beginning<P: Problem>(
    tracer: &Tracer<P>,
    (origin, direction, distance): (&[f64], &[f64], f64),
    settings: &Settings,
    watch: &dyn Watch,
) -> bool {
    let problem = tracer.problem();
    let row = normal(direction, &problem.weights(origin));
    let guess = origin.iter().zip(direction).map(|(x, d)| x + distance / NEARER * d).collect();
    let Ok(near) = correct(problem, guess, &row, settings.tolerance, watch) else { return false };
    let changed = |x: &[f64]| x.last().copied().unwrap_or(f64::NAN) - origin.last().copied().unwrap_or(0.0);
    let (closer, far) = (changed(&near.x), changed(tracer.unknowns()));
    let seen = SEEN * settings.tolerance * settings.width();
    let begins =
        if closer.abs() > seen { RATIOS.contains(&(far / closer)) } else { far.abs() <= RATIOS.end() * seen };
    begins
        && problem
            .levels(&near.x, &near.local)
            .is_some_and(|levels| growing(&levels).contains(&tracer.growing()))
}

/// How many levels grow: at least, and with those that are too small to tell.
fn growing(levels: &[Vec<Level>]) -> std::ops::RangeInclusive<usize> {
    let above = |least: f64| levels.iter().flatten().filter(|level| level.growth > least).count();
    above(UNCLEAR)..=above(-UNCLEAR)
}

/// Slopes that differ by less than this may be of one branch.
const TURNS: f64 = 1e-6;

/// What the equations do not see to first order: the direction along the parameter, and those that leave the parameter as it is.
fn unseen<P: Problem>(problem: &P, x: &[f64]) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
    let local = problem.local(x, &()).ok()?;
    let weights = problem.weights(x);
    let null = crossing(problem.linear(&local), &weights);
    let last = |v: &Vec<f64>| v.last().copied().unwrap_or(0.0);
    let along = null.iter().max_by(|a, b| last(a).abs().total_cmp(&last(b).abs()))?;
    let across = |v: &Vec<f64>| {
        let mut out = v.clone();
        add(&mut out, -last(v) / last(along), along);
        out
    };
    let mut others: Vec<Vec<f64>> = null.iter().filter(|v| !std::ptr::eq(*v, along)).map(across).collect();
    let length = |v: &Vec<f64>| product(&weights, v, v);
    others.sort_by(|a, b| length(b).total_cmp(&length(a)));
    let others: Option<Vec<Vec<f64>>> = others.into_iter().map(|v| scaled(v, &weights)).collect();
    Some((along.clone(), others?))
}

/// A direction of the new branch: the tangent of the branches that cross at a branch point which is not that of the point's own branch, known
/// by its slope; elsewhere what the equations do not see to first order, and leaves the parameter as it is.
fn direction<P: Problem>(problem: &P, x: &[f64], point: &Point) -> Option<Vec<f64>> {
    if point.special == Some(Special::BranchPoint) {
        let slope = |v: &Vec<f64>| (v.last().copied().unwrap_or(0.0).abs() - point.slope.abs()).abs();
        let width = problem.weights(x).last().map_or(1.0, |weight| 1.0 / weight.sqrt());
        let other = tangents(problem, x).into_iter().max_by(|a, b| slope(a).total_cmp(&slope(b)));
        if let Some(other) = other.filter(|other| slope(other) > TURNS * width) {
            return Some(other);
        }
    }
    unseen(problem, x)?.1.into_iter().next()
}

fn turned(direction: &[f64], side: f64) -> Vec<f64> {
    direction.iter().map(|d| side * d).collect()
}

/// The equations of all relative equilibria near one, and its unknowns.
fn crossed<'f>(
    family: &'f dyn Family,
    point: &Point,
    start: &RelativeEquilibrium,
    settings: &Settings,
) -> Result<(Equilibria<'f>, Vec<f64>)> {
    let parameter = point.parameter;
    let mut problem = Equilibria::near(Bodies::One(family), &[parameter], &start.shape, &[settings.width()])?;
    problem.classes = Classes::of(family.at(parameter)?.as_ref(), &[]);
    let mut x = start.shape.clone();
    x.extend([start.turning_rate, parameter]);
    Ok((problem, x))
}

/// The branches that leave a pitchfork, one of each kind; those that Newton's method finds, if it finds any.
fn fork<'f>(
    family: &'f dyn Family,
    (point, start): (&Point, &RelativeEquilibrium),
    settings: &Settings,
    watch: &'f dyn Watch,
) -> Result<Vec<Vec<Branch<'f>>>> {
    let (problem, x) = crossed(family, point, start, settings)?;
    let body = family.at(point.parameter)?;
    let (_, critical) = unseen(&problem, &x).ok_or_else(|| nothing(point.parameter))?;
    let directions = leaving(body.as_ref(), &start.shape, &critical, &problem.weights(&x));
    let branch = |direction: &Vec<f64>| cross(family, (point, start, direction), settings, watch);
    let (found, failed): (Vec<_>, Vec<_>) = directions.iter().map(branch).partition(Result::is_ok);
    match failed.into_iter().next() {
        Some(Err(error)) if found.is_empty() => Err(error),
        _ => Ok(found.into_iter().flatten().map(|branch| vec![branch]).collect()),
    }
}

/// Another branch of relative equilibria, which leaves in this direction.
fn cross<'f>(
    family: &'f dyn Family,
    (point, start, direction): (&Point, &RelativeEquilibrium, &[f64]),
    settings: &Settings,
    watch: &'f dyn Watch,
) -> Result<Branch<'f>> {
    let (problem, x) = crossed(family, point, start, settings)?;
    let body = family.at(point.parameter)?;
    let mut tracer = follow(problem, &Begin::at(point, &x, direction), settings, watch)?;
    let dim = start.shape.len();
    let shape = tracer.unknowns()[..dim].to_vec();
    tracer.problem_mut().classes = Classes::of(body.as_ref(), &[&shape]);
    tracer.renew();
    Ok(Branch::equilibria(tracer, watch))
}

/// Another branch of orbits, of twice the length if `doubled`.
fn leave<'f>(
    family: &'f dyn Family,
    (point, (orbit, nodes), doubled, side): (&Point, (&PeriodicOrbit, &[Vec<f64>]), bool, f64),
    settings: &Settings,
    watch: &'f dyn Watch,
) -> Result<Branch<'f>> {
    let parameter = point.parameter;
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
    let direction = direction(&problem, &x, point).ok_or_else(|| nothing(parameter))?;
    let direction: Vec<f64> = direction.iter().map(|d| side * d).collect();
    Ok(Branch::orbits(symmetric(follow(problem, &Begin::at(point, &x, &direction), settings, watch)?), watch))
}

/// With the symmetry that all shapes of the first orbit have.
fn symmetric(mut tracer: Tracer<Orbits<'_>>) -> Tracer<Orbits<'_>> {
    let x = tracer.unknowns().to_vec();
    let problem = tracer.problem_mut();
    if let Ok(body) = problem.bodies.at(&x) {
        let nodes: Vec<&[f64]> = (0..problem.parts).map(|i| problem.node(&x, i)).collect();
        problem.classes = Classes::of(body.as_ref(), &nodes);
        tracer.renew();
    }
    tracer
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
    (point, start, frequency): (&Point, &RelativeEquilibrium, f64),
    settings: &Settings,
    watch: &'f dyn Watch,
) -> Result<Branch<'f>> {
    let parameter = point.parameter;
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
    Ok(Branch::orbits(symmetric(follow(problem, &Begin::at(point, &x, &direction), settings, watch)?), watch))
}

/// Whether a shape has a mirror axis and the deviation is odd under it.
fn is_odd(body: &dyn Equivariant, shape: &[f64], deviation: &[f64]) -> bool {
    let classes = Classes::of(body, &[shape]);
    let even = |basis: &Vec<Vec<f64>>| {
        basis.iter().map(|v| motiform_analysis::linear::dot(v, deviation).abs()).fold(0.0, f64::max)
    };
    classes.axis.is_some() && even(&classes.bases[0]) < 1e-6 * norm(deviation)
}
