//! The numbers of one point of a branch.

use super::family::Bodies;
use motiform_analysis::regime::{Direction, Form, Regime, repeating};
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium, SteadyMotion};
use motiform_continuation::{Motion, Point};
use motiform_dynamics::{Model, Watch, escape::norm};
use motiform_study::Error;
use serde::{Deserialize, Serialize};

/// A point of a branch in numbers that people know; `None` where a number has no meaning.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    /// The kind of motion.
    pub motion: Regime,
    /// Its symmetry, if it repeats.
    pub form: Option<Form>,
    /// The time after which the body is as it was, but for the net rotation (model time).
    pub period: Option<f64>,
    /// Its direction, as far as the symmetry of the model distinguishes directions.
    #[serde(default)]
    pub direction: Direction,
    /// Mean turning rate of the heading (rad per model time).
    pub turning_rate: Option<f64>,
    /// Net rotation per period (rad, in -pi..pi).
    pub net_rotation: Option<f64>,
    /// Mean, smallest and largest speed (model length per model time).
    pub speed: [f64; 3],
    /// Largest size `|u|` of the shape, velocity included where it is an unknown.
    pub size: f64,
    /// The leading eigenvalue (of an orbit: multiplier, over half the period for an orbit that is its own mirror image).
    pub leading: Option<(f64, f64)>,
    /// A shape of the motion in the model's coordinates.
    pub state: Vec<f64>,
}

impl Reading {
    pub(super) fn of(bodies: &Bodies<'_>, point: &Point, watch: &dyn Watch) -> Result<Self, Error> {
        let model = bodies.model(point.parameter)?;
        let mut reading = match &point.motion {
            Motion::Equilibrium(found) => still(model.as_ref(), found),
            Motion::Orbit { orbit, nodes } => periodic(bodies, model.as_ref(), orbit, nodes, watch)?,
        };
        model.decode(point.motion.shape(), &mut reading.state);
        Ok(reading)
    }
}

fn still(model: &dyn Model, found: &RelativeEquilibrium) -> Reading {
    let steady = SteadyMotion::of(model, found);
    Reading {
        motion: steady.regime(),
        form: None,
        direction: steady.direction(model, found),
        period: None,
        turning_rate: steady.turning(),
        net_rotation: None,
        speed: [steady.pace(); 3],
        size: norm(&found.shape),
        leading: found.eigenvalues.first().copied(),
        state: vec![0.0; model.coordinates().len()],
    }
}

fn periodic(
    bodies: &Bodies<'_>,
    model: &dyn Model,
    orbit: &PeriodicOrbit,
    nodes: &[Vec<f64>],
    watch: &dyn Watch,
) -> Result<Reading, Error> {
    let seen = repeating(model, orbit, nodes, &bodies.looks(), &motiform_dynamics::StopOnly(watch))?;
    Ok(Reading {
        motion: seen.form.regime(),
        form: Some(seen.form),
        direction: seen.direction,
        period: Some(seen.period),
        turning_rate: seen.turning_rate,
        net_rotation: Some(seen.net_rotation),
        speed: seen.speed.map_or([0.0; 3], |speed| [speed.mean, speed.min, speed.max]),
        size: seen.size,
        leading: orbit.multipliers.first().copied(),
        state: vec![0.0; model.coordinates().len()],
    })
}
