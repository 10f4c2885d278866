//! Orbits of the full tensor model, kappa3 = 0.1, kappa2 from 0.45 to 0.65: chaotic ones.

use crate::options::Options;
use motiform_dynamics::StepControl;
use motiform_dynamics::ensemble::{Member, Propagation, propagate};
use motiform_dynamics::simd::InstructionSet;
use motiform_dynamics::steppers::{self, DOP853, RK4};
use motiform_models::tensor::fourier::{Coefficients, FourierField, terms};
use motiform_models::tensor::TensorParameters;
use serde_json::{Value, json};
use std::time::Instant;

type Field = FourierField<f64, { terms::PAPER }>;
pub type Failure = Box<dyn std::error::Error>;

/// The members that all programs compute.
pub fn members(count: usize, t_end: f64) -> Vec<Member<Field, 6>> {
    members_between(count, t_end, (0.45, 0.65)).into_iter().map(|(_, member)| member).collect()
}

/// The same with other ends of kappa2, and with their parameters.
pub fn members_between(
    count: usize,
    t_end: f64,
    (low, high): (f64, f64),
) -> Vec<(TensorParameters, Member<Field, 6>)> {
    let base = [0.5, 0.1, 0.1, -0.2, 0.05, 0.1];
    let member = |i: usize| {
        let p = TensorParameters::full(low + (high - low) * i as f64 / (count - 1).max(1) as f64, 0.1);
        let field = FourierField(Coefficients::from(&p));
        let start = std::array::from_fn(|j| {
            base[j] * (1.0 + 0.1 * (1.0 + i as f64 * 0.7 + j as f64 * 1.3).sin())
        });
        (p, Member { field, start, t_end })
    };
    (0..count).map(member).collect()
}

pub fn rk4(options: &Options) -> Result<Value, Failure> {
    let (count, steps, dt) = (options.get("members", 16)?, options.get("steps", 100_000_u64)?, options.get("dt", 0.01)?);
    let how = Propagation {
        method: &RK4,
        control: StepControl::Fixed { step: dt },
        arithmetic: options.arithmetic()?,
        instructions: InstructionSet::widest(),
        escape_norm: 1e6,
        threads: options.get("threads", 1)?,
    };
    run(&members(count, dt * steps as f64), &how, |ends| ends as f64 * steps as f64)
}

pub fn adaptive(options: &Options, task: &str) -> Result<Value, Failure> {
    let short = task == "short";
    let t = options.get("t", if short { 10.0 } else { 1000.0 })?;
    let rtol: f64 = options.get("rtol", 1e-9)?;
    let method = steppers::find(options.word("method", DOP853.name)).ok_or("no such method")?;
    let how = Propagation {
        method,
        control: StepControl::Adaptive { rtol, atol: 1e-2 * rtol },
        arithmetic: options.arithmetic()?,
        instructions: InstructionSet::widest(),
        escape_norm: 1e6,
        threads: options.get("threads", 1)?,
    };
    let members = members(options.get("members", 64)?, t);
    run(&members, &how, |ends| if short { ends as f64 } else { ends as f64 * t })
}

/// Times one propagation; `work` of the number of members.
fn run(members: &[Member<Field, 6>], how: &Propagation, work: impl Fn(usize) -> f64) -> Result<Value, Failure> {
    let clock = Instant::now();
    let ends = propagate(members, how)?;
    let seconds = clock.elapsed().as_secs_f64();
    if let Some(end) = ends.iter().find(|end| !end.outcome.is_complete()) {
        return Err(format!("a member did not arrive: {}", end.outcome).into());
    }
    let (steps, rejected) =
        ends.iter().fold((0, 0), |(steps, rejected), end| (steps + end.steps, rejected + end.rejected));
    let check: Vec<_> = ends.iter().take(8).map(|end| end.u).collect();
    Ok(json!({ "seconds": seconds, "work": work(ends.len()), "steps": steps, "rejected": rejected, "check": check }))
}
