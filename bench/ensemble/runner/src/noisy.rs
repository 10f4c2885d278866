//! The same orbits under noise: in lanes, or one after the other.

use crate::options::Options;
use crate::orbits::{Failure, Field, members_between};
use motiform_dynamics::drive::drive;
use motiform_dynamics::ensemble::{NoisyMember, NoisyQueue, NoisySpan, NoisyTrack, WithPosition, propagate_noisy};
use motiform_dynamics::simd::InstructionSet;
use motiform_dynamics::steppers::DOP853;
use motiform_dynamics::{InPlane, Noise, NoiseSteps, NoisyOrbit, Normal, Orbit, Request, StepControl};
use motiform_models::tensor::fourier::{FourierField, terms};
use serde_json::{Value, json};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// The field of the kernel, with all terms.
type General = FourierField<f64, { terms::ALL }>;

/// A member: its field, and shape and position at the start.
type Start = (Field, [f64; 8]);

struct Work {
    starts: Vec<Start>,
    span: NoisySpan,
    step: f64,
    amplitude: f64,
}

impl Work {
    /// The same amplitude on every entry of the shape.
    fn noise(&self, key: usize) -> Result<NoiseSteps, Failure> {
        let noise = Noise { amplitudes: vec![self.amplitude; 6], rates: vec![0.0; 6], step: self.step };
        Ok(NoiseSteps::new(&noise, Normal::new(1, key as u64), 0.0, 8)?)
    }

    fn alone(&self, key: usize) -> Result<[f64; 8], Failure> {
        let (field, start) = &self.starts[key];
        let body = InPlane(*field);
        let control = StepControl::Adaptive { rtol: self.span.rtol, atol: self.span.atol };
        let orbit = Orbit::new(&body, &DOP853, control, 0.0, start)?;
        let mut orbit = NoisyOrbit::of(orbit, self.noise(key)?);
        let mut rows = motiform_dynamics::Trajectory::new(8);
        let request = Request { sample_every: self.span.every, watched: 6, ..Request::until(self.span.times.1, 8) };
        drive(&mut orbit, &request, &mut rows)?;
        Ok(motiform_dynamics::Integration::state(&orbit).try_into()?)
    }

    fn in_lanes(&self, taken: &AtomicUsize, ends: &Mutex<Vec<Option<[f64; 8]>>>) {
        let mut next = || {
            let key = taken.fetch_add(1, Ordering::Relaxed);
            let (field, start) = self.starts.get(key)?;
            let noise = self.noise(key).ok()?;
            Some(NoisyMember { key, field: FourierField::<f64, { terms::ALL }>(field.0), start: *start, noise })
        };
        let mut done = |key: usize, track: Option<NoisyTrack<8>>| {
            if let Ok(mut ends) = ends.lock() {
                ends[key] = track.map(|track| track.last);
            }
        };
        let queue = NoisyQueue { next: &mut next, done: &mut done, watch: &() };
        propagate_noisy::<General, WithPosition, 8>(&self.span, queue);
    }
}

/// `form=lanes` or `form=alone`; `every` is the time between rows, `step` and `amplitude` are those of the noise.
pub fn noisy(options: &Options) -> Result<Value, Failure> {
    let members = members_between(options.get("members", 64)?, (0.45, 0.65));
    let (t, rtol): (f64, f64) = (options.get("t", 100.0)?, options.get("rtol", 1e-9)?);
    let threads: usize = options.get("threads", 1)?;
    let lanes = options.get("form", "lanes".to_owned())? == "lanes";
    let place = |(_, field, shape): (_, Field, [f64; 6])| {
        let mut start = [0.0; 8];
        start[..6].copy_from_slice(&shape);
        (field, start)
    };
    let every = Some(options.get("every", 0.1)?);
    let span = NoisySpan { times: (0.0, t), every, rtol, atol: 1e-2 * rtol, escape_norm: 1e6, max_steps: u64::MAX, set: InstructionSet::widest() };
    let (step, amplitude) = (options.get("step", 0.0625)?, options.get("amplitude", 1e-3)?);
    let work = Work { starts: members.into_iter().map(place).collect(), span, step, amplitude };
    let (taken, ends) = (AtomicUsize::new(0), Mutex::new(vec![None; work.starts.len()]));
    let one = || {
        if lanes {
            return work.in_lanes(&taken, &ends);
        }
        loop {
            let key = taken.fetch_add(1, Ordering::Relaxed);
            if key >= work.starts.len() {
                return;
            }
            let end = work.alone(key).ok();
            if let Ok(mut ends) = ends.lock() {
                ends[key] = end;
            }
        }
    };
    let clock = Instant::now();
    std::thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(one);
        }
        one();
    });
    let seconds = clock.elapsed().as_secs_f64();
    let ends: Option<Vec<[f64; 8]>> = ends.into_inner().map_err(|_| "a thread panicked")?.into_iter().collect();
    let ends = ends.ok_or("a member did not arrive, or this machine has no lanes")?;
    let check: Vec<&[f64]> = ends.iter().take(8).map(|end| &end[..6]).collect();
    Ok(json!({ "seconds": seconds, "work": ends.len() as f64 * t, "check": check }))
}
