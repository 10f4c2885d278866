//! The last steps before a singularity.

use super::super::context::Context;
use motiform_dynamics::drive::drive;
use motiform_dynamics::sample::ascending;
use motiform_dynamics::{Outcome, Request, Sink};
use motiform_study::{Error, RunPlan, Study};

/// Far enough that time is resolved to 10^-6 before t*; in a quick run to 10^-4: the steps are as many as one over the time left.
const BOUND: (f64, f64) = (1e12, 1e10);

/// The modes z1, z2, z3 at the steps of a run that blows up.
#[derive(Clone)]
pub(super) struct Approach {
    pub(super) t_star: f64,
    /// Time and |z1|, |z2|, |z3|.
    steps: Vec<(f64, [f64; 3])>,
    /// e11 and e22 of the equations.
    e: (f64, f64),
}

/// Runs a study that blows up, keeping every step.
///
/// The shape of the tensor model is z1, z2, z3, real and imaginary parts in turn.
pub(super) fn follow(context: &Context<'_>, start: &Study) -> Result<Approach, Error> {
    let mut study = start.clone();
    let bound = context.choose(BOUND.0, BOUND.1);
    (study.run.rtol, study.run.atol, study.run.escape_norm) = (1e-13, Some(1e-16), Some(bound));
    let plan = RunPlan::new(&study)?;
    let c = &plan.computation;
    let model = plan.body()?;
    let shape = model.encoded(&c.initial.values()[..model.dim()]);
    let mut orbit = plan.method()?.shape_orbit(model.as_ref(), c.control.into(), 0.0, &shape)?;
    let watch = &context.quiet();
    let request = Request { escape_norm: bound, watch, ..Request::until(c.t_end, shape.len()) };
    let mut steps = Steps(Vec::new());
    let outcome = drive(orbit.as_mut(), &request, &mut steps)?;
    let t_star = match outcome {
        Outcome::Escaped { t, .. } => t,
        Outcome::Interrupted { .. } => return Err(Error::Interrupted),
        other => other.t(),
    };
    let of = |name: &str| c.parameters.get(name).unwrap_or(0.0);
    Ok(Approach { t_star, steps: steps.0, e: (-2.0 * of("a1"), of("b2")) })
}

struct Steps(Vec<(f64, [f64; 3])>);

impl Sink for Steps {
    fn step(&mut self, t: f64, u: &[f64], _slope: &[f64]) {
        if let [a, b, c, d, e, f] = *u {
            self.0.push((t, [libm::hypot(a, b), libm::hypot(c, d), libm::hypot(e, f)]));
        }
    }
}

impl Approach {
    /// |z1| (t* - t), the median close to t*.
    pub(super) fn coefficient(&self) -> f64 {
        self.near(|s, [z1, ..]| z1 * s)
    }

    /// |z2|/|z1|^2, the median close to t*.
    pub(super) fn ratio(&self) -> f64 {
        self.near(|_, [z1, z2, _]| z2 / (z1 * z1))
    }

    fn near(&self, of: impl Fn(f64, [f64; 3]) -> f64) -> f64 {
        let close = |s: f64| (3e-6..1e-4).contains(&s);
        let mut values: Vec<f64> = self
            .steps
            .iter()
            .filter(|(t, _)| close(self.t_star - t))
            .map(|(t, sizes)| of(self.t_star - t, *sizes))
            .collect();
        ascending(&mut values);
        values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
    }

    /// Time left and the size of a mode, at some thirty steps, evenly on a logarithmic axis.
    pub(super) fn sizes(&self, mode: usize) -> impl Iterator<Item = (f64, f64)> {
        let mut next = 20.0;
        let kept = move |(s, _): &(f64, f64)| {
            let keep = *s <= next && *s > 1e-5;
            if keep {
                next = s / 1.5;
            }
            keep
        };
        self.steps.iter().map(move |(t, sizes)| (self.t_star - t, sizes[mode])).filter(kept)
    }

    /// |z1| s, |z2| s^2 and |z3| s^2 in the leading balance with |z1| = C/s.
    pub(super) fn theory(&self, c: f64) -> [f64; 3] {
        let (e11, e22) = self.e;
        [c, c * c / e11, 2.0 * c / (e11 * e22)]
    }
}
