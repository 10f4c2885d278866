//! Orbits of the full tensor model, kappa3 = 0.1, kappa2 from 0.45 to 0.65: chaotic ones.

use crate::options::Options;
use motiform_dynamics::ensemble::{InLanes, Member, Propagation, Queue, propagate};
use motiform_dynamics::simd::InstructionSet;
use motiform_models::tensor::TensorParameters;
use motiform_models::tensor::fourier::{Coefficients, FourierField, terms};
use serde_json::{Value, json};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

pub type Field = FourierField<f64, { terms::PAPER }>;
pub type Failure = Box<dyn std::error::Error>;

/// The members that all programs compute, with these ends of kappa2: parameters, field and shape at the start.
pub fn members_between(count: usize, (low, high): (f64, f64)) -> Vec<(TensorParameters, Field, [f64; 6])> {
    let base = [0.5, 0.1, 0.1, -0.2, 0.05, 0.1];
    let member = |i: usize| {
        let p = TensorParameters::full(low + (high - low) * i as f64 / (count - 1).max(1) as f64, 0.1);
        let start =
            std::array::from_fn(|j| base[j] * (1.0 + 0.1 * (1.0 + i as f64 * 0.7 + j as f64 * 1.3).sin()));
        (p, FourierField(Coefficients::from(&p)), start)
    };
    (0..count).map(member).collect()
}

/// Shapes and positions at the end: what `motiform.ensemble` computes.
pub fn adaptive(options: &Options, task: &str) -> Result<Value, Failure> {
    let members = members_between(options.get("members", 64)?, (0.45, 0.65));
    let members: Vec<_> = members.into_iter().map(|(_, field, start)| (field, start)).collect();
    propagated(options, task == "short", &members)
}

/// The members' fields and shapes at the start, in lanes.
pub fn propagated<F: InLanes + Clone>(
    options: &Options,
    short: bool,
    members: &[(F, [f64; 6])],
) -> Result<Value, Failure> {
    let t = options.get("t", if short { 10.0 } else { 1000.0 })?;
    let rtol: f64 = options.get("rtol", 1e-9)?;
    let threads: usize = options.get("threads", 1)?;
    let times = [t];
    let how = Propagation { times: &times, rtol, atol: 1e-2 * rtol, escape_norm: 1e6, set: InstructionSet::widest() };
    let (taken, ends) = (AtomicUsize::new(0), Mutex::new(vec![None; members.len()]));
    let work = || {
        let mut next = || {
            let key = taken.fetch_add(1, Ordering::Relaxed);
            let (field, shape) = members.get(key)?;
            let mut start = [0.0; 8];
            start[..6].copy_from_slice(shape);
            Some(Member { key, field: field.clone(), start })
        };
        let mut done = |key: usize, states: Option<Vec<[f64; 8]>>| {
            if let Ok(mut ends) = ends.lock() {
                ends[key] = states.map(|states| states[0]);
            }
        };
        propagate(&how, Queue { next: &mut next, done: &mut done, watch: &() });
    };
    let clock = Instant::now();
    std::thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(work);
        }
        work();
    });
    let seconds = clock.elapsed().as_secs_f64();
    let ends: Option<Vec<[f64; 8]>> =
        ends.into_inner().map_err(|_| "a thread panicked")?.into_iter().collect();
    let ends = ends.ok_or("a member did not arrive, or this machine has no lanes")?;
    let check: Vec<&[f64]> = ends.iter().take(8).map(|end| &end[..6]).collect();
    let work = ends.len() as f64 * if short { 1.0 } else { t };
    Ok(json!({ "seconds": seconds, "work": work, "check": check }))
}
