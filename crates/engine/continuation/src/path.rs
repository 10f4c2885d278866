//! The path of a body in the plane on a motion of a branch.

use super::point::Motion;
use motiform_analysis::periodic::Flow;
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium};
use motiform_dynamics::drive::drive;
use motiform_dynamics::{Equivariant, InPlane, Request, Sink, StopOnly, Watch};
use std::f64::consts::TAU;

/// Parts of equal time that a path is divided into, about.
const PARTS: usize = 360;

/// A steady motion is shown over one turn, or this model time if a turn takes longer.
const LONGEST: f64 = 100.0;

/// The path of the centre of mass over one period. What follows is the same path again: turned by `rotation` about its first point, and
/// moved so that it begins where this one ends.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitPath {
    /// Positions at equal times, the first at the origin, the last after `time`.
    pub points: Vec<[f64; 2]>,
    /// The period; of a steady motion one turn, or 100 model times if a turn takes longer.
    pub time: f64,
    /// Rotation of the body over this time (rad).
    pub rotation: f64,
}

/// The path of `body` on a motion that it has, from the motion's own shape on: stable or not, each part of an orbit is followed from its
/// own node. `None` where the flow fails, the watch stops it, or an orbit has no nodes.
///
/// # Checked by  tests/all/path.rs: the flow of a stable zigzag over a whole period, circles in closed form
pub fn path(body: &dyn Equivariant, motion: &Motion, flow: &Flow, watch: &dyn Watch) -> Option<OrbitPath> {
    match motion {
        Motion::Equilibrium(found) => Some(arc(found)),
        Motion::Orbit { orbit, nodes } => whole(body, orbit, nodes, flow, watch),
    }
}

/// A circle, or a straight line: `integral of R(omega s) v ds = t sin(a)/a R(a) v` with `a = omega t / 2`.
fn arc(found: &RelativeEquilibrium) -> OrbitPath {
    let time = LONGEST.min(TAU / found.turning_rate.abs());
    let point = |k: usize| {
        let t = time * k as f64 / PARTS as f64;
        let a = 0.5 * found.turning_rate * t;
        let chord = if a == 0.0 { t } else { t * libm::sin(a) / a };
        turned(a, found.velocity).map(|v| chord * v)
    };
    OrbitPath { points: (0..=PARTS).map(point).collect(), time, rotation: found.turning_rate * time }
}

/// An orbit; of one that comes back mirrored after `orbit.time` both halves.
fn whole(
    body: &dyn Equivariant,
    orbit: &PeriodicOrbit,
    nodes: &[Vec<f64>],
    flow: &Flow,
    watch: &dyn Watch,
) -> Option<OrbitPath> {
    if nodes.is_empty() {
        return None;
    }
    let span = orbit.time / nodes.len() as f64;
    let count = PARTS.div_ceil(nodes.len() * if orbit.mirrored { 2 } else { 1 });
    let mut points = vec![[0.0; 2]];
    for node in nodes {
        let start = *points.last()?;
        points.extend(part(body, node, (span, count), flow, watch)?.iter().map(|p| sum(start, *p)));
    }
    let end = *points.last()?;
    if !orbit.mirrored {
        return Some(OrbitPath { points, time: orbit.time, rotation: orbit.angle });
    }
    let image = |[x, y]: [f64; 2]| sum(end, turned(orbit.angle, [x, -y]));
    points.extend(points.clone().into_iter().skip(1).map(image));
    Some(OrbitPath { points, time: 2.0 * orbit.time, rotation: 0.0 })
}

/// Positions after `count` equal parts of `span`, relative to where it begins.
fn part(
    body: &dyn Equivariant,
    node: &[f64],
    (span, count): (f64, usize),
    flow: &Flow,
    watch: &dyn Watch,
) -> Option<Vec<[f64; 2]>> {
    let state = [node, &[0.0; 2]].concat();
    let body = InPlane(body);
    let mut orbit = flow.method.shape_orbit(&body, flow.control, 0.0, &state).ok()?;
    let mut positions = Positions(Vec::new());
    let request = Request {
        sample_every: Some(span / count as f64),
        max_steps: flow.max_steps,
        watch: &StopOnly(watch),
        ..Request::around(span, node)
    };
    let outcome = drive(orbit.as_mut(), &request, &mut positions).ok()?;
    let Positions(mut points) = positions;
    points.truncate(count); // round-off decides whether the end is a sample
    points.push(place(orbit.state()));
    points.remove(0);
    outcome.is_complete().then_some(points)
}

/// The positions of the samples.
struct Positions(Vec<[f64; 2]>);

impl Sink for Positions {
    fn sample(&mut self, _t: f64, u: &[f64]) {
        self.0.push(place(u));
    }
}

/// The position of a body in the plane.
fn place(u: &[f64]) -> [f64; 2] {
    match u {
        [.., x, y] => [*x, *y],
        _ => [0.0; 2],
    }
}

fn sum(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

fn turned(angle: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
    [cosine * x - sine * y, sine * x + cosine * y]
}
