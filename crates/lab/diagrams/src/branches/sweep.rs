//! Motions sampled along a parameter, swept upwards and downwards: what a simulation shows, beside the branches.

use crate::branches::family::Bodies;
use crate::branches::kept::Kept;
use motiform_dynamics::drive::drive;
use motiform_dynamics::escape::norm;
use motiform_dynamics::model::{turning_rate, velocity_and_acceleration};
use motiform_dynamics::{Model, Request, Sink, StopOnly, Watch};
use motiform_lab::pool::each;
use motiform_store::Journal;
use motiform_study::{BranchPlan, Error};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A sample at one value of the parameter; nothing where the run ended early.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SweepPoint {
    /// The parameter.
    pub parameter: f64,
    /// Mean, smallest and largest speed.
    pub speed: Option<[f64; 3]>,
    /// Mean turning rate of the heading (rad per model time).
    pub turning_rate: Option<f64>,
    /// Largest size of the shape.
    pub size: Option<f64>,
}

/// Samples in the order in which they were taken.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sweeps {
    /// From the lower end of the range upwards.
    pub up: Vec<SweepPoint>,
    /// From the upper end of the range downwards.
    pub down: Vec<SweepPoint>,
}

/// Looks of the model before the samples, and with them.
const LOOKS: (f64, f64) = (1.0, 4.0);

/// Samples in a look.
const SAMPLES: f64 = 2000.0;

/// Each run starts this part of its size off the end of the one before: exactly on a motion that has become unstable it would stay.
const OFF: f64 = 1e-6;

/// Samples a plan's motions at its values of the parameter, evenly spaced over the range, in both directions. The first run of a
/// sweep starts at the plan's own start, each other one at the end of the one before, or at the plan's start again if that one ended
/// early (by a blow-up). Means are weighted by `sin^4` over the time recorded, so that they are those of whole periods. The two
/// sweeps run at the same time; the numbers do not depend on that. `None` if the watch stopped it.
///
/// Samples go to the journal every second and when the watch stops it; what the journal has is not sampled again.
///
/// # Errors
/// Errors of the model, and those of the journal.
pub fn sweeps(plan: &BranchPlan, journal: &dyn Journal, watch: &dyn Watch) -> Result<Option<Sweeps>, Error> {
    let (count, along) = (plan.computation.samples, &plan.computation.along);
    let value = |k: usize| along.from + (along.to - along.from) * (k as f64 / (count - 1) as f64);
    let upwards: Vec<f64> = (0..count).map(value).collect();
    let downwards = upwards.iter().rev().copied().collect();
    let both = [("upwards.json", upwards), ("downwards.json", downwards)];
    match each(&both, 2, watch, |(item, values)| sweep(plan, values, Kept::new(journal, item), watch)) {
        Ok(mut both) => {
            let down = both.pop().unwrap_or_default();
            Ok(both.pop().map(|up| Sweeps { up, down }))
        }
        Err(Error::Interrupted) => Ok(None),
        Err(error) => Err(error),
    }
}

fn sweep(
    plan: &BranchPlan,
    values: &[f64],
    mut kept: Kept<'_>,
    watch: &dyn Watch,
) -> Result<Vec<SweepPoint>, Error> {
    let bodies = Bodies::new(plan)?;
    let mut begun = kept.read(values);
    for (number, &value) in values.iter().enumerate().skip(begun.points.len()) {
        let model = bodies.model(value)?;
        let mut shape = match &begun.state {
            Some(shape) => shape.clone(),
            None => start(plan, model.as_ref()),
        };
        push_off(&mut shape, number);
        let (point, end) = run(&bodies, model.as_ref(), value, &shape, watch)?;
        if watch.stopped() {
            kept.write(&begun)?;
            return Err(Error::Interrupted);
        }
        begun.points.push(point);
        begun.state = end;
        kept.now_and_then(&begun)?;
    }
    Ok(begun.points)
}

fn start(plan: &BranchPlan, model: &dyn Model) -> Vec<f64> {
    model.encoded(&plan.computation.start.initial.values()[..model.dim()])
}

/// Moves a shape by different parts of its size in all coordinates.
fn push_off(shape: &mut [f64], number: usize) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (size, dim) = (norm(shape), shape.len());
    for (place, value) in shape.iter_mut().enumerate() {
        let part = ((number * dim + place + 1) as f64 * GOLDEN).fract() - 0.5;
        *value += OFF * size * part;
    }
}

/// One run, and the shape at its end if it came there.
fn run(
    bodies: &Bodies<'_>,
    model: &dyn Model,
    value: f64,
    shape: &[f64],
    watch: &dyn Watch,
) -> Result<(SweepPoint, Option<Vec<f64>>), Error> {
    let (settings, look) = (bodies.looks(), bodies.look());
    let (before, all) = (LOOKS.0 * look, (LOOKS.0 + LOOKS.1) * look);
    let mut orbit = settings.method.shape_orbit(model, settings.control, 0.0, shape)?;
    let mut record = Record::new(model, before, all);
    let mut complete = true;
    for (t_end, sample_every) in [(before, None), (all, Some(look / SAMPLES))] {
        let request = Request {
            sample_every,
            max_steps: settings.max_steps,
            escape_norm: settings.escape_norm,
            watch: &StopOnly(watch),
            ..Request::until(t_end, shape.len())
        };
        complete = complete && drive(orbit.as_mut(), &request, &mut record)?.is_complete();
    }
    let nothing = SweepPoint { parameter: value, speed: None, turning_rate: None, size: None };
    let point = if complete { record.point(value) } else { nothing };
    Ok((point, complete.then(|| orbit.state().to_vec())))
}

/// Sums over the samples.
struct Record<'m> {
    model: &'m dyn Model,
    from: f64,
    to: f64,
    weight: f64,
    speed: [f64; 3],
    turning: f64,
    size: f64,
}

impl<'m> Record<'m> {
    fn new(model: &'m dyn Model, from: f64, to: f64) -> Self {
        let speed = [0.0, f64::INFINITY, 0.0];
        Self { model, from, to, weight: 0.0, speed, turning: 0.0, size: 0.0 }
    }

    fn point(&self, parameter: f64) -> SweepPoint {
        let [sum, min, max] = self.speed;
        let turning_rate = Some(self.turning / self.weight).filter(|rate| rate.is_finite());
        SweepPoint {
            parameter,
            speed: Some([sum / self.weight, min, max]),
            turning_rate,
            size: Some(self.size),
        }
    }
}

impl Sink for Record<'_> {
    fn sample(&mut self, t: f64, shape: &[f64]) {
        let weight = libm::sin(PI * (t - self.from) / (self.to - self.from)).powi(4);
        let (v, a) = velocity_and_acceleration(self.model, shape);
        let speed = libm::hypot(v[0], v[1]);
        self.weight += weight;
        self.speed = [self.speed[0] + weight * speed, self.speed[1].min(speed), self.speed[2].max(speed)];
        self.turning += weight * turning_rate(v, a).unwrap_or(f64::NAN);
        self.size = self.size.max(norm(shape));
    }
}
