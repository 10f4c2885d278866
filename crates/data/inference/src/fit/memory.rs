//! Noise of the velocity with a memory.
//!
//! ```text
//! z1' = f(z) + w,    w' = -k w + eta W',    W two independent Wiener processes
//! ```
//!
//! w is an Ornstein-Uhlenbeck process with the correlation time 1/k that turns with the plane as z1 does, and takes the place of the white
//! noise of z1: that is its limit for large k with `eta/k` kept. For the filter w is one more amplitude, which is never seen: each frame
//! has a value 0 for it with an error so large that it says nothing ([`UNSEEN`]), whose part of the likelihood is taken out again
//! ([`Problem::without_unseen`]).
//!
//! Source: Uhlenbeck and Ornstein (1930), Phys. Rev. 36, 823; states that are not seen, for noise that is not white: Bryson and Johansen
//! (1965), IEEE Trans. Autom. Control 10, 4.

use super::ascend::polish;
use super::optimise::{Point, climb};
use super::{Settings, problem};
use crate::field::{Field, Part};
use crate::filter::{ETA_V, Frame, Problem, ProcessNoise, Theta, UNSEEN, Want, evaluate};
use crate::{Error, Fit, Library, MOST_MODES, Result, Term, Track};
use motiform_dynamics::{Complex, Watch};

/// Rates `k` from which the search begins, in natural units.
const STARTS: [f64; 2] = [0.7, 4.0];
/// First steps from each of them.
const FIRST: (f64, usize) = (1.0, 12);

/// Terms of a fit whose noise of the velocity has a memory.
pub(crate) struct WithMemory {
    theta: Theta,
    /// The terms, and the units.
    fit: Fit,
}

impl WithMemory {
    /// The estimates of highest likelihood for these tracks, with the terms of a fit of at most three amplitudes.
    ///
    /// # Errors    [`Error::Interrupted`]
    /// # Checked by  `tests/all/ladder.rs`; the likelihood: the tests below
    pub(crate) fn of(tracks: &[Track], fit: &Fit, watch: &dyn Watch) -> Result<Self> {
        let problem = problem_with_memory(tracks, fit);
        let from = |k: f64| climb(&problem, &start(fit, k), FIRST, watch);
        let [slow, fast]: [Point; 2] = STARTS.map(from);
        let better = if fast.evaluation.value > slow.evaluation.value { fast } else { slow };
        let Point { theta, .. } = polish(&problem, &better.theta, fit.scales.time, watch);
        if watch.stopped() {
            return Err(Error::Interrupted);
        }
        Ok(Self { theta, fit: fit.clone() })
    }

    /// Number of coefficients, the rate `k` among them.
    pub(crate) fn coefficients(&self) -> usize {
        self.theta.coefficients.len()
    }

    /// The log-likelihood of tracks in the units of the data, and the number of frames that have one.
    pub(crate) fn likelihood(&self, tracks: &[Track]) -> (f64, usize) {
        let problem = problem_with_memory(tracks, &self.fit);
        let frames = problem.frames();
        let value = evaluate(&problem, &self.theta, Want::Value, false).value;
        (value + frames as f64 * self.fit.scales.log_density(), frames)
    }
}

/// The estimates of a fit, and noise of rate `k` that spreads the velocity as its white noise does in a long time.
fn start(fit: &Fit, k: f64) -> Theta {
    let Theta { mut coefficients, mut logs } = fit.theta();
    coefficients.push(-k);
    logs[ETA_V] += libm::log(k);
    Theta { coefficients, logs }
}

/// The problem of a fit with w as its last amplitude.
fn problem_with_memory(tracks: &[Track], fit: &Fit) -> Problem {
    let Fit { library, handed, .. } = fit;
    let settings = Settings { library: library.clone(), handed: *handed, starts: Vec::new() };
    let mut made = problem(tracks, &settings, &fit.scales);
    let (own, w) = (library.terms.len(), library.modes);
    let terms = library.terms.iter().cloned().chain([0, w].map(|equation| linear(equation, w)));
    made.field = Field::new(&Library { modes: w + 1, terms: terms.collect() });
    made.given.extend([1.0, 0.0].map(|factor| Complex::new(factor, 0.0)));
    made.parts.push(Part { term: own + 1, imaginary: false });
    made.noise[0].variance = 0.0;
    made.noise.push(ProcessNoise { by: ETA_V, variance: 1.0 });
    made.unseen = 2;
    for stretch in &mut made.stretches {
        let variances = std::iter::once(1.0).chain(std::iter::repeat(UNSEEN)); // w is about 1 at the first frame
        stretch.iter_mut().zip(variances).for_each(|(frame, variance)| extend(frame, variance));
    }
    made
}

/// The term that is this amplitude, in an equation; both from 0.
fn linear(equation: usize, amplitude: usize) -> Term {
    let mut powers = [[0; 2]; MOST_MODES];
    powers[amplitude][0] = 1;
    Term { equation, powers }
}

/// Two more numbers of a frame: 0, with errors of this variance.
fn extend(frame: &mut Frame, variance: f64) {
    let n = frame.y.len();
    frame.y.extend([0.0; 2]);
    frame.covariance.iter_mut().for_each(|row| row.extend([0.0; 2]));
    for i in n..n + 2 {
        let mut row = vec![0.0; n + 2];
        row[i] = variance;
        frame.covariance.push(row);
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may fail")]
mod tests {
    use super::*;
    use crate::{Observation, fit};
    use motiform_dynamics::Normal;

    const ERROR: f64 = 0.02;

    /// A walk beside a shape of one mode that fluctuates.
    fn track(frames: usize) -> Track {
        let (mut normal, dt) = (Normal::new(7, 0), 0.5_f64);
        let mut state = [0.0; 6];
        let frame = |number: usize| {
            for i in 2..6 {
                state[i] += -0.5 * dt * state[i] + 0.3 * dt.sqrt() * normal.next();
            }
            state[0] += dt * state[2];
            state[1] -= dt * state[3];
            let y = [0, 1, 4, 5].map(|i| state[i] + ERROR * normal.next()).to_vec();
            let row = |i: usize| (0..4).map(|j| if i == j { ERROR * ERROR } else { 0.0 }).collect();
            Observation { t: number as f64 * dt, y, covariance: (0..4).map(row).collect() }
        };
        Track((0..frames).map(frame).collect())
    }

    fn fitted(track: &Track) -> Fit {
        let terms = (0..2).map(|n| linear(n, n)).collect();
        let settings = Settings { library: Library { modes: 2, terms }, ..Settings::default() };
        fit(std::slice::from_ref(track), &settings, &()).unwrap()
    }

    #[test]
    fn gradients_are_those_of_differences() {
        let tracks = [track(40)];
        let fit = fitted(&tracks[0]);
        let (problem, theta) = (problem_with_memory(&tracks, &fit), start(&fit, 1.5));
        let exact = evaluate(&problem, &theta, Want::Exact, false);
        for i in 0..problem.len() - 1 {
            let at = |by: f64| {
                let step: Vec<f64> = (0..problem.len()).map(|j| if i == j { by } else { 0.0 }).collect();
                evaluate(&problem, &theta.stepped(&step), Want::Value, false).value
            };
            let difference = (at(1e-4) - at(-1e-4)) / 2e-4;
            assert!(
                (difference - exact.gradient[i]).abs() < 1e-4 * (1.0 + difference.abs()),
                "{i}: {difference}"
            );
        }
    }

    /// The limit of white noise: the likelihood of the fit itself, with an error of first order in 1/k.
    #[test]
    fn a_short_memory_is_white_noise() {
        let tracks = [track(40)];
        let fit = fitted(&tracks[0]);
        let settings = Settings { library: fit.library.clone(), ..Settings::default() };
        let white =
            evaluate(&problem(&tracks, &settings, &fit.scales), &fit.theta(), Want::Value, false).value;
        let with = |k: f64| {
            let there = problem_with_memory(&tracks, &fit);
            evaluate(&there, &start(&fit, k), Want::Value, false).value
        };
        let [far, near] = [32.0, 64.0].map(|k| with(k) - white);
        println!("{white} {far} {near}");
        assert!(near.abs() < 0.3 && (1.6..2.6).contains(&(far / near)), "{far} {near}");
    }
}
