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
use crate::{Error, Fit, Library, MOST_MODES, Result, Scales, Term, Track};
use motiform_dynamics::{Complex, Watch};

/// Rates `k` from which the search begins, in natural units.
const STARTS: [f64; 2] = [0.7, 4.0];
/// Most first steps from each of them.
const FIRST: usize = 12;

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
    /// # Checked by  `tests/all/ladder.rs`; the likelihood: `tests/all/filter.rs`
    pub(crate) fn of(tracks: &[Track], fit: &Fit, watch: &dyn Watch) -> Result<Self> {
        let problem = problem_of(tracks, fit);
        let from = |k: f64| climb(&problem, &start(fit, k), 1.0, FIRST, watch);
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
        let problem = problem_of(tracks, &self.fit);
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
fn problem_of(tracks: &[Track], fit: &Fit) -> Problem {
    let settings = Settings { library: fit.library.clone(), handed: fit.handed, starts: Vec::new() };
    problem_with_memory(tracks, &settings, &fit.scales)
}

/// The problem with w as its last amplitude, and `-k` as its last coefficient.
pub(super) fn problem_with_memory(tracks: &[Track], settings: &Settings, scales: &Scales) -> Problem {
    let library = &settings.library;
    let mut made = problem(tracks, settings, scales);
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
