//! Many orbits of one model at given times: from many starts, with many values of the parameters, or both.

use crate::pool::{Jobs, spread};
use motiform_dynamics::Watch;
use motiform_dynamics::drive::drive;
use motiform_dynamics::ensemble::Propagation;
use motiform_dynamics::simd::{InstructionSet, has_lanes};
use motiform_dynamics::{InPlane, Integration, Model, Outcome, Request, StepControl, StopOnly};
use motiform_kernels::{Kernel, Start, propagate_bodies};
use motiform_study::plan::{check, check_closed, check_no_noise, check_steps};
use motiform_study::{Error, Plan, Random};

/// One orbit of an ensemble.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// All parameters of the model, in registry order.
    pub parameters: Vec<f64>,
    /// The model's coordinates at time 0, then x and y.
    pub start: Vec<f64>,
}

/// `count` members with the plan's parameters and random starts at the origin, from the plan's seed.
///
/// # Errors
/// An unknown model, or an invalid distribution.
pub fn random_members(plan: &Plan, count: usize, random: Random) -> Result<Vec<Member>, Error> {
    random.check()?;
    let (info, c) = (plan.info()?, &plan.computation);
    let parameters = c.parameters.values();
    let dim = info.build(&parameters)?.coordinates().len();
    let member = |sample: usize| {
        let mut start = random.coordinates(info, dim, c.seed, sample as u64 + 1);
        start.extend([0.0, 0.0]);
        Member { parameters: parameters.clone(), start }
    };
    Ok((0..count).map(member).collect())
}

/// The states of one orbit at the requested times.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// The model's coordinates, then x and y, for each time that it reached.
    pub states: Vec<Vec<f64>>,
    /// Its outcome: [`Outcome::Completed`] if it reached all times.
    pub outcome: Outcome,
}

/// The tracks of `members`, in their order, at `times` (increasing, the first one at least 0), with the method and the tolerances of
/// `plan`; `None` if the watch stopped it. The plan's own parameters, start, transient and time span are not used.
///
/// Tensor models and amplitude equations of at most four modes run in the lanes of vector registers if the
/// method is dop853 with a tolerance. A track does not depend on the other members, on `threads`, or on the
/// machine.
///
/// # Errors
/// Parameters or a start that the model rejects, times that are not increasing, a plan with noise.
///
/// # Checked by  tests/all/ensemble.rs: tracks against single runs to the bit, for both models
pub fn tracks(
    plan: &Plan,
    members: &[Member],
    times: &[f64],
    threads: usize,
    watch: &dyn Watch,
) -> Result<Option<Vec<Track>>, Error> {
    check_no_noise(plan.computation.noise.map_or(0.0, |noise| noise.largest()))?;
    if plan.computation.noise.is_some() {
        let remedy = "tracks of an ensemble have no noise: set its coefficients to 0, or ask for statistics";
        return Err(Error::Setting { key: "noise", value: "in the equations".to_owned(), remedy });
    }
    check_times(times)?;
    let bodies: Vec<Body> =
        members.iter().map(|member| Body::new(plan, member, times)).collect::<Result<_, _>>()?;
    let lanes = lanes(plan, times).zip(Kernel::of_most(bodies.iter().map(|body| body.model.as_ref())));
    spread(members.len(), threads, watch, |jobs| match &lanes {
        Some((how, kernel)) => in_lanes(plan, &bodies, how, *kernel, jobs, watch),
        None => jobs.each(|job| bodies[job].track(plan, times, watch)),
    })
}

pub(crate) fn check_times(times: &[f64]) -> Result<(), Error> {
    let remedy = "give increasing times, the first one not before 0";
    let mut before = 0.0;
    for (place, &t) in times.iter().enumerate() {
        check("times", t, t > before || (place == 0 && t == 0.0), remedy)?;
        before = t;
    }
    Ok(())
}

/// The settings of lanes, if the plan's method has lanes.
fn lanes<'t>(plan: &Plan, times: &'t [f64]) -> Option<Propagation<'t>> {
    let c = &plan.computation;
    let StepControl::Adaptive { rtol, atol } = c.control.into() else { return None };
    let suited = has_lanes() && c.stepper == "dop853";
    suited.then_some(Propagation {
        times,
        rtol,
        atol,
        escape_norm: c.escape_norm,
        set: InstructionSet::widest(),
    })
}

/// The model of a member, and its state at the start.
struct Body {
    model: Box<dyn Model>,
    start: Vec<f64>,
}

impl Body {
    fn new(plan: &Plan, member: &Member, times: &[f64]) -> Result<Self, Error> {
        let info = plan.info()?;
        let model = info.build(&member.parameters)?;
        let dim = model.coordinates().len();
        let whole = member.start.len() == dim + 2;
        check("start", member.start.len() as f64, whole, "give the model's coordinates, then x and y")?;
        for &value in &member.start {
            check("start", value, true, "give finite numbers")?;
        }
        let mut start = model.encoded(&member.start[..dim]);
        check_closed(model.as_ref(), &start)?;
        let span = times.last().copied().unwrap_or(0.0);
        check_steps(model.as_ref(), plan.method()?, plan.computation.control, span)?;
        start.extend_from_slice(&member.start[dim..]);
        Ok(Self { model, start })
    }

    /// The track of a single orbit; `None` if it was stopped.
    fn track(&self, plan: &Plan, times: &[f64], watch: &dyn Watch) -> Result<Option<Track>, Error> {
        let c = &plan.computation;
        let body = InPlane(self.model.as_ref());
        let mut orbit = plan.method()?.orbit(&body, c.control.into(), 0.0, &self.start)?;
        let request = Request {
            max_steps: c.max_steps,
            escape_norm: c.escape_norm,
            watched: self.model.dim(),
            watch: &StopOnly(watch),
            ..Request::until(0.0, self.start.len())
        };
        track_of(orbit.as_mut(), times, &request, &|state| named(self.model.as_ref(), state))
    }
}

/// The states of an orbit at these times, as `shown` has them, until it ends; `None` if it was stopped.
pub(crate) fn track_of(
    orbit: &mut dyn Integration,
    times: &[f64],
    request: &Request<'_>,
    shown: &dyn Fn(&[f64]) -> Vec<f64>,
) -> Result<Option<Track>, Error> {
    let (mut states, mut outcome) = (Vec::with_capacity(times.len()), Outcome::Completed { t: 0.0 });
    for &t_end in times {
        if t_end > 0.0 {
            outcome = drive(orbit, &Request { t_end, ..*request }, &mut ())?;
        }
        match outcome {
            Outcome::Completed { .. } => states.push(shown(orbit.state())),
            Outcome::Interrupted { .. } => return Ok(None),
            _ => break,
        }
    }
    Ok(Some(Track { states, outcome }))
}

/// A state as the model's coordinates, x and y.
pub(crate) fn named(model: &dyn Model, state: &[f64]) -> Vec<f64> {
    let (shape, position) = state.split_at(state.len() - 2);
    let mut named = model.decoded(shape);
    named.extend_from_slice(position);
    named
}

/// Tracks in lanes, on this thread.
fn in_lanes(
    plan: &Plan,
    bodies: &[Body],
    how: &Propagation<'_>,
    kernel: Kernel,
    jobs: &Jobs<'_, Track>,
    watch: &dyn Watch,
) {
    let mut next = || loop {
        let key = jobs.next()?;
        let body = &bodies[key];
        if kernel.computes(body.model.as_ref()) {
            return Some(Start { key, body: body.model.as_ref(), state: body.start.clone() });
        }
        jobs.done(key, body.track(plan, how.times, watch));
    };
    let mut done = |job: usize, states: Option<Vec<&[f64]>>| {
        let track = match states {
            Some(states) => Ok(Some(Track {
                outcome: Outcome::Completed { t: how.times.last().copied().unwrap_or(0.0) },
                states: states.iter().map(|state| named(bodies[job].model.as_ref(), state)).collect(),
            })),
            None => bodies[job].track(plan, how.times, watch),
        };
        jobs.done(job, track);
    };
    propagate_bodies(kernel, how, &mut next, &mut done, watch);
}
