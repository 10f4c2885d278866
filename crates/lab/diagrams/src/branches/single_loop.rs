//! From an orbit that passes one loop of a homoclinic connection and then its mirror image to an orbit along one of them.

use super::family::Bodies;
use super::origin::both;
use super::result::{Leg, Sample};
use super::settle::Start;
use motiform_analysis::periodic::Flow;
use motiform_analysis::symmetry::align;
use motiform_analysis::{Error as Refused, PeriodicOrbit, RelativeEquilibrium};
use motiform_continuation::Branch;
use motiform_dynamics::drive::drive;
use motiform_dynamics::{Equivariant, Request, Watch, escape::norm};

/// An orbit that misses its own image by more than this part of its size has been amplified too much to be a guess.
const HELD: f64 = 1e-3;

/// So many orbits are tried.
const TRIES: usize = 8;

/// Shapes of an orbit of which the one closest to the saddle is taken.
const PLACES: usize = 400;

/// The branch of orbits along one loop, to both sides; `None` where none is found.
///
/// Beside the saddle an orbit of two loops and one of a single loop are nearly the same, up to the side on which they leave it: so the
/// shape closest to the saddle is the guess. The closer an orbit is to the connection the better is the guess, but the more is it
/// amplified on the way: several are tried, from the end of the leg backwards.
pub(super) fn single_loop<'f>(
    bodies: &'f Bodies<'_>,
    leg: &Leg,
    saddle: &RelativeEquilibrium,
    watch: &'f dyn Watch,
) -> Result<Option<Vec<Branch<'f>>>, Refused> {
    let flow = bodies.settings().flow;
    let mut tried = 0;
    for sample in leg.samples.iter().rev() {
        let Some(guess) = guess(bodies, sample, saddle, &flow)? else { continue };
        if let Ok(branches) = both(bodies, sample.point.parameter, &Start::Orbit(guess), watch) {
            return Ok(Some(branches));
        }
        tried += 1;
        if tried == TRIES || watch.stopped() {
            break;
        }
    }
    Ok(None)
}

/// A guess of the single loop from an orbit: a shape, and its image after the time of one loop.
fn guess(
    bodies: &Bodies<'_>,
    sample: &Sample,
    saddle: &RelativeEquilibrium,
    flow: &Flow,
) -> Result<Option<PeriodicOrbit>, Refused> {
    let Some(orbit) = sample.point.motion.orbit() else { return Ok(None) };
    let body = bodies.model(sample.point.parameter)?;
    let body: &dyn Equivariant = body.as_ref();
    let Some(shape) = beside(body, orbit, saddle, flow) else { return Ok(None) };
    let Some(after) = places(body, &shape, orbit.time, 1, flow).and_then(|mut all| all.pop()) else {
        return Ok(None);
    };
    if align(body, &after, &shape, true).distance > HELD * norm(&shape) {
        return Ok(None);
    }
    let plain = align(body, &after, &shape, false);
    Ok(Some(PeriodicOrbit {
        shape,
        time: orbit.time,
        angle: plain.angle,
        mirrored: false,
        residual: plain.distance,
        multipliers: Vec::new(),
        errors: Vec::new(),
    }))
}

/// The shape of an orbit that is closest to a saddle, up to rotations and the mirror.
fn beside(
    body: &dyn Equivariant,
    orbit: &PeriodicOrbit,
    saddle: &RelativeEquilibrium,
    flow: &Flow,
) -> Option<Vec<f64>> {
    let away = |shape: &Vec<f64>| {
        let distance = |mirrored| align(body, shape, &saddle.shape, mirrored).distance;
        distance(false).min(distance(true))
    };
    let all = places(body, &orbit.shape, orbit.time, PLACES, flow)?;
    all.into_iter().min_by(|a, b| away(a).total_cmp(&away(b)))
}

/// Shapes after `count` equal parts of a time.
fn places(
    body: &dyn Equivariant,
    shape: &[f64],
    time: f64,
    count: usize,
    flow: &Flow,
) -> Option<Vec<Vec<f64>>> {
    let mut solution = flow.method.shape_orbit(body, flow.control, 0.0, shape).ok()?;
    let mut all = Vec::with_capacity(count);
    for place in 1..=count {
        let t = time * place as f64 / count as f64;
        let request = Request { max_steps: flow.max_steps, ..Request::around(t, shape) };
        if !drive(solution.as_mut(), &request, &mut ()).ok()?.is_complete() {
            return None;
        }
        all.push(solution.state().to_vec());
    }
    Some(all)
}
