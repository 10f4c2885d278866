//! The motion that a plan begins with: the one that its start settles on, or one that is known from an earlier result.

use super::family::Bodies;
use super::settle::{Start, settle};
use motiform_analysis::symmetry::align;
use motiform_analysis::{PeriodicOrbit, Regime, RelativeEquilibrium, SteadyMotion};
use motiform_continuation::{Branch, Motion};
use motiform_dynamics::escape::norm;
use motiform_dynamics::{Equivariant, Model, Watch};
use motiform_study::{Error, Given};

/// A motion that is farther from the given one than this part of its size is another one.
const CLOSE: f64 = 0.5;

/// Newton's method leaves this much of a shape that vanishes.
const ZERO: f64 = 1e-6;

/// The motion to begin with; `None` if the watch stopped it.
///
/// # Errors
/// [`Error::Start`] where the start is simulated; [`Error::StartPoint`] where there is no motion close to the one that is given.
pub(super) fn first(bodies: &Bodies<'_>, watch: &dyn Watch) -> Result<Option<Start>, Error> {
    let c = &bodies.plan.computation;
    let settled = || Ok(settle(bodies.plan, watch)?.map(|found| found.0));
    let Some(given) = c.given else { return settled() };
    let model = bodies.model(bodies.plan.start_value())?;
    let mut shape = vec![0.0; model.dim()];
    model.encode(&c.start.initial.values()[..model.dim()], &mut shape);
    let found = match given {
        Given::Equilibrium => steady(model.as_ref(), &shape).map(Start::Equilibrium),
        Given::Orbit { time, angle, mirrored } => {
            let (residual, multipliers, errors) = (0.0, Vec::new(), Vec::new());
            let near = PeriodicOrbit { shape, time, angle, mirrored, residual, multipliers, errors };
            orbit(bodies, &near, watch).map(Start::Orbit)
        }
        Given::State => {
            let asked = |found: &RelativeEquilibrium| is_asked(model.as_ref(), found, c.origin);
            match steady(model.as_ref(), &shape).filter(asked) {
                Some(found) => Some(Start::Equilibrium(found)),
                None => return settled(),
            }
        }
    };
    match found {
        None if watch.stopped() => Ok(None),
        None => Err(none(bodies, given)),
        found => Ok(found),
    }
}

/// The steady motion close to a shape.
fn steady(model: &dyn Model, shape: &[f64]) -> Option<RelativeEquilibrium> {
    let body: &dyn Equivariant = model;
    let found = RelativeEquilibrium::find(body, shape)?;
    (found.distance(body, shape) <= CLOSE * norm(shape) + ZERO).then_some(found)
}

/// Whether this kind of steady motion is asked for.
fn is_asked(model: &dyn Model, found: &RelativeEquilibrium, asked: Option<Regime>) -> bool {
    asked.is_some_and(|asked| SteadyMotion::of(model, found).regime() == asked)
}

/// The orbit close to another one, by multiple shooting: the first point of the branch through it.
fn orbit(bodies: &Bodies<'_>, near: &PeriodicOrbit, watch: &dyn Watch) -> Option<PeriodicOrbit> {
    let (value, settings) = (bodies.plan.start_value(), bodies.settings());
    let mut branch = Branch::of_orbits(bodies, value, near, &settings, watch).ok()?;
    let Motion::Orbit { orbit, nodes } = branch.next()?.motion else { return None };
    let body = bodies.model(value).ok()?;
    let off = |node: &Vec<f64>| align(body.as_ref(), node, &near.shape, false).distance;
    let distance = nodes.iter().chain([&orbit.shape]).map(off).fold(f64::INFINITY, f64::min);
    let close = distance <= CLOSE * norm(&near.shape) && (orbit.time / near.time - 1.0).abs() < CLOSE;
    close.then_some(orbit)
}

fn none(bodies: &Bodies<'_>, given: Given) -> Error {
    let what = match given {
        Given::Orbit { .. } => "orbit",
        Given::Equilibrium | Given::State => "steady motion",
    };
    let problem = format!(
        "Newton's method finds no {what} close to the given one: give the parameters that it belongs to, or values \
         closer to them; where branches meet or turn back, give a point beside that one"
    );
    let (name, value) = (&bodies.plan.computation.along.name, bodies.plan.start_value());
    Error::StartPoint { text: format!("at {name} = {value}"), problem }
}
