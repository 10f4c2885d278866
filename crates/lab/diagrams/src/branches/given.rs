//! The motion that a plan begins with: the one that its start settles on, or one that is known from an earlier result.

use super::family::Bodies;
use super::settle::{Start, settle};
use motiform_analysis::equilibrium::Units;
use motiform_analysis::symmetry::align;
use motiform_analysis::{Error as Refused, PeriodicOrbit, Regime, RelativeEquilibrium, SteadyMotion};
use motiform_continuation::{Branch, Motion, Settings};
use motiform_dynamics::escape::norm;
use motiform_dynamics::{Equivariant, Model, Watch};
use motiform_study::{Error, Given};

/// A motion that is farther from the given one than this part of its size is another one.
const CLOSE: f64 = 0.5;

/// Newton's method leaves this much of a shape that vanishes, in the unit of the equations.
const ZERO: f64 = 1e-6;

/// Parts of an orbit that are tried one after the other: one that amplifies deviations needs more.
const PARTS: [usize; 3] = [4, 16, 64];

/// The motion to begin with, and how it is followed; `None` if the watch stopped it.
///
/// # Errors
/// [`Error::Start`] where the start is simulated; [`Error::StartPoint`] where there is no motion close to the one that is given.
pub(super) fn first(bodies: &Bodies<'_>, watch: &dyn Watch) -> Result<Option<(Start, Settings)>, Error> {
    let (c, settings) = (&bodies.plan.computation, bodies.settings());
    let settled = || Ok(settle(bodies.plan, watch)?.map(|found| (found.0, settings)));
    let Some(given) = c.given else { return settled() };
    let model = bodies.model(bodies.plan.start_value())?;
    let shape = model.encoded(&c.start.initial.values()[..model.dim()]);
    let at_rest = |shape: &[f64]| steady(model.as_ref(), shape, bodies.units);
    let found = match given {
        Given::Equilibrium => at_rest(&shape)
            .map(|found| (Start::Equilibrium(found), settings))
            .ok_or_else(|| NO_SOLUTION.to_owned()),
        Given::Orbit { time, angle, mirrored } => {
            let (residual, multipliers, errors) = (0.0, Vec::new(), Vec::new());
            let near = PeriodicOrbit { shape, time, angle, mirrored, residual, multipliers, errors };
            in_parts(bodies, &near, watch)
        }
        Given::State => match at_rest(&shape).filter(|found| is_asked(model.as_ref(), found, c.origin)) {
            Some(found) => Ok((Start::Equilibrium(found), settings)),
            None => return settled().map_err(|error| with_steady(error, c.origin)),
        },
    };
    match found {
        Err(_) if watch.stopped() => Ok(None),
        Err(why) => Err(none(bodies, given, &why)),
        Ok(found) => Ok(Some(found)),
    }
}

const NO_SOLUTION: &str = "Newton's method leads to none, or to another one";

/// The same refusal of the motion that the flow leads to, with the way to steady motions.
fn with_steady(error: Error, asked: Option<Regime>) -> Error {
    match error {
        Error::Start { found, why, problem } if asked.is_none() => {
            let problem = format!(
                "{problem}; or ask for the steady motion close to the state: motionless, straight, circular or spinning"
            );
            Error::Start { found, why, problem }
        }
        error => error,
    }
}

/// The steady motion close to a shape.
fn steady(model: &dyn Model, shape: &[f64], units: Units) -> Option<RelativeEquilibrium> {
    let body: &dyn Equivariant = model;
    let found = RelativeEquilibrium::find(body, shape)?;
    let room = CLOSE * norm(shape) + ZERO * units.length;
    (found.distance(body, shape) <= room).then_some(found)
}

/// Returns `true` if this kind of steady motion is asked for.
fn is_asked(model: &dyn Model, found: &RelativeEquilibrium, asked: Option<Regime>) -> bool {
    asked.is_some_and(|asked| SteadyMotion::of(model, found).regime() == asked)
}

/// The orbit, if there is one close to it, with the parts that Newton's method needs from it: that the branch begins with the same Newton
/// steps makes sure that they lead there again.
fn in_parts(
    bodies: &Bodies<'_>,
    near: &PeriodicOrbit,
    watch: &dyn Watch,
) -> Result<(Start, Settings), String> {
    let mut first = None;
    for parts in PARTS {
        let settings = Settings { parts, ..bodies.settings() };
        match orbit(bodies, near, &settings, watch) {
            Ok(()) => return Ok((Start::Orbit(near.clone()), settings)),
            Err(why) => first = first.or(Some(why)),
        }
    }
    Err(first.unwrap_or_default())
}

/// Checks that multiple shooting leads to an orbit close to this one: the first point of the branch through it.
fn orbit(
    bodies: &Bodies<'_>,
    near: &PeriodicOrbit,
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<(), String> {
    let value = bodies.plan.start_value();
    let found = bodies.model(value).and_then(|body| {
        let mut branch = Branch::of_orbits(bodies, value, near, settings, watch)?;
        Ok((body, branch.next()))
    });
    let (body, first) = found.map_err(|error| match error {
        Refused::NotOnABranch { why, .. } => why,
        error => error.to_string(),
    })?;
    let Some(Motion::Orbit { orbit, nodes }) = first.map(|point| point.motion) else {
        return Err(NO_SOLUTION.to_owned());
    };
    let off = |node: &Vec<f64>| align(body.as_ref(), node, &near.shape, false).distance;
    let distance = nodes.iter().chain([&orbit.shape]).map(off).fold(f64::INFINITY, f64::min);
    let close = distance <= CLOSE * norm(&near.shape) && (orbit.time / near.time - 1.0).abs() < CLOSE;
    if close { Ok(()) } else { Err(NO_SOLUTION.to_owned()) }
}

fn none(bodies: &Bodies<'_>, given: Given, why: &str) -> Error {
    let what = match given {
        Given::Orbit { .. } => "orbit",
        Given::Equilibrium | Given::State => "steady motion",
    };
    let problem = format!(
        "there is no {what} close to the given one ({why}): give the parameters that it belongs to, or values closer to \
         them; where branches meet, turn back or end, give a point farther from there"
    );
    let (name, value) = (&bodies.plan.computation.along.name, bodies.plan.start_value());
    Error::StartPoint { text: format!("at {name} = {value}"), problem }
}
