//! All six exponents of the same members.

use crate::options::Options;
use crate::orbits::{Failure, members_between};
use motiform_analysis::lyapunov::{LyapunovSettings, TangentMember, lyapunov_in_lanes};
use motiform_analysis::{Lyapunov, Result as Analysed};
use motiform_dynamics::steppers::{DOP853, Method};
use motiform_dynamics::{Equivariant, StepControl, Tolerance};
use motiform_models::tensor::Tensor;
use serde_json::{Value, json};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Time in which the intervals between orthonormalisations find their length; it is timed, and counts as work.
const TRANSIENT: f64 = 64.0;

/// A body that several threads may hold.
struct Body(Tensor);

impl AsRef<dyn Equivariant> for Body {
    fn as_ref(&self) -> &(dyn Equivariant + 'static) {
        &self.0
    }
}

pub fn spectra(options: &Options) -> Result<Value, Failure> {
    let (count, t) = (options.get("members", 64)?, options.get("t", 1000.0)?);
    let rtol: f64 = options.get("rtol", 1e-9)?;
    let tolerance = Tolerance { rtol, atol: 1e-2 * rtol };
    let range = (options.get("kappa2_low", 0.45)?, options.get("kappa2_high", 0.65)?);
    let threads: usize = options.get("threads", 1)?;
    let settings = LyapunovSettings {
        count: 6,
        method: Method::Explicit(&DOP853),
        control: StepControl::Adaptive { rtol, atol: tolerance.atol },
        transient: TRANSIENT,
        span: t,
        escape_norm: 1e6,
        max_steps: 1_000_000_000,
    };
    let members = members_between(count, range);
    let (taken, runs) = (AtomicUsize::new(0), Mutex::new(vec![None; count]));
    let work = || {
        let mut next = || {
            let key = taken.fetch_add(1, Ordering::Relaxed);
            let (parameters, field, start) = members.get(key)?;
            Some(TangentMember {
                key,
                body: Body(Tensor::new(parameters)),
                field: *field,
                start: *start,
                settings,
            })
        };
        let mut done = |key: usize, run: Analysed<Lyapunov>| {
            if let Ok(mut runs) = runs.lock() {
                runs[key] = run.ok();
            }
        };
        lyapunov_in_lanes::<_, _, 6, 6, 42>(tolerance, &mut next, &mut done, &());
    };
    let clock = Instant::now();
    std::thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(work);
        }
        work();
    });
    let seconds = clock.elapsed().as_secs_f64();
    let runs = runs.into_inner().map_err(|_| "a thread panicked")?;
    let runs: Option<Vec<Lyapunov>> = runs.into_iter().collect();
    let runs = runs.ok_or("a run failed")?;
    if let Some(run) = runs.iter().find(|run| run.exponents.len() != 6) {
        return Err(format!("no exponents: {}", run.outcome).into());
    }
    let check: Vec<Vec<f64>> = runs
        .iter()
        .take(8)
        .map(|run| run.exponents.iter().map(|exponent| exponent.value).collect())
        .collect();
    Ok(json!({ "seconds": seconds, "work": count as f64 * (t + TRANSIENT), "check": check }))
}
