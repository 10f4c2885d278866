//! The Kalman filter of a persistent random walk whose velocity has unit variance in each coordinate.

use super::Fix;
use std::f64::consts::TAU;

/// The sums that the likelihood of a walk depends on.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Sums {
    /// Innovations: two for each step.
    pub(super) count: f64,
    /// Sum of the logarithms of their variances, for unit variance of the velocity.
    pub(super) logarithms: f64,
    /// Sum of their squares divided by these variances.
    pub(super) squares: f64,
}

impl Sums {
    /// The variance of the velocity of highest likelihood.
    pub(super) fn scale(&self) -> f64 {
        self.squares / self.count
    }

    /// Log-likelihood where the velocity has this variance in each coordinate.
    pub(super) fn log_likelihood(&self, variance: f64) -> f64 {
        if self.logarithms == f64::INFINITY {
            return f64::NEG_INFINITY;
        }
        -0.5 * (self.count * libm::log(TAU * variance) + self.logarithms + self.squares / variance)
    }
}

/// A walk whose velocity has unit variance in each coordinate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Law {
    /// Persistence time.
    pub(super) persistence: f64,
    /// The part of independent errors of a place in the variance of a coordinate; below 0 where places are means over a time.
    pub(super) error: f64,
    /// The part of additional diffusion in the variance of a displacement, per time.
    pub(super) diffusion: f64,
}

/// The transition of mean and covariance over an interval: x += g v, v *= a, and the noise.
#[derive(Debug, Clone, Copy)]
struct Transition {
    a: f64,
    g: f64,
    q: [f64; 3],
}

impl Transition {
    fn new(interval: f64, law: Law) -> Self {
        let p = law.persistence;
        let h = interval / p;
        let (a, lost) = (libm::exp(-h), -libm::expm1(-h));
        let place = p * p * spread(h) + law.diffusion * interval;
        Self { a, g: p * lost, q: [place, p * lost * lost, lost * (1.0 + a)] }
    }
}

/// 2 h - 3 + 4 e^-h - e^-2h, by its series where that cancels.
pub(super) fn spread(h: f64) -> f64 {
    if h > 0.2 {
        return 2.0 * h - 3.0 + 4.0 * libm::exp(-h) - libm::exp(-2.0 * h);
    }
    // sum over k from 3 of (-h)^k (4 - 2^k)/k!
    let (mut sum, mut power, mut double) = (0.0, -h * h * h / 6.0, 8.0);
    for k in 4..=14 {
        sum += power * (4.0 - double);
        power *= -h / f64::from(k);
        double *= 2.0;
    }
    sum
}

/// The state of both coordinates, and the covariance of each (they have the same).
struct State {
    x: [f64; 2],
    v: [f64; 2],
    c: [f64; 3],
}

impl State {
    fn forecast(&mut self, by: &Transition) {
        let Transition { a, g, q } = *by;
        for k in 0..2 {
            self.x[k] += g * self.v[k];
            self.v[k] *= a;
        }
        let [xx, xv, vv] = self.c;
        self.c = [xx + 2.0 * g * xv + g * g * vv + q[0], a * (xv + g * vv) + q[1], a * a * vv + q[2]];
    }

    /// Corrects by a place; its innovations and their variance.
    fn correct(&mut self, at: [f64; 2], error: f64) -> ([f64; 2], f64) {
        let [xx, xv, vv] = self.c;
        let variance = xx + error;
        let (gain, turn) = (xx / variance, xv / variance);
        let new = [at[0] - self.x[0], at[1] - self.x[1]];
        for k in 0..2 {
            self.x[k] += gain * new[k];
            self.v[k] += turn * new[k];
        }
        self.c = [error * gain, error * turn, vv - turn * xv];
        (new, variance)
    }
}

/// One step of the filter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    pub(super) piece: usize,
    /// The velocity that is expected before the step.
    pub(super) velocity: [f64; 2],
    /// The innovation; standardised in the results of [`steps`].
    pub(super) innovation: [f64; 2],
    /// Its variance, before it is standardised, for unit variance of the velocity.
    pub(super) variance: f64,
}

/// Each step, piece by piece. The first place of a piece starts it: no velocity is known.
fn run(pieces: &[Vec<Fix>], law: Law, mut each: impl FnMut(Step)) {
    let error = law.error;
    for (number, piece) in pieces.iter().enumerate() {
        let Some(first) = piece.first() else { continue };
        let mut state = State { x: first.at, v: [0.0; 2], c: [error, 0.0, 1.0] };
        let mut known: Option<(f64, Transition)> = None;
        for pair in piece.windows(2) {
            let interval = pair[1].t - pair[0].t;
            let by = match known {
                Some((same, by)) if same == interval => by,
                _ => Transition::new(interval, law),
            };
            known = Some((interval, by));
            let velocity = state.v;
            state.forecast(&by);
            let (innovation, variance) = state.correct(pair[1].at, error);
            each(Step { piece: number, velocity, innovation, variance });
        }
    }
}

/// Sums of a walk; an error below 0 that no path has leaves no likelihood.
pub(super) fn sums(pieces: &[Vec<Fix>], law: Law) -> Sums {
    let mut sums = Sums::default();
    run(pieces, law, |Step { innovation: [x, y], variance, .. }| {
        sums.count += 2.0;
        sums.logarithms += if variance > 0.0 { 2.0 * libm::log(variance) } else { f64::INFINITY };
        sums.squares += (x * x + y * y) / variance;
    });
    sums
}

/// The steps, innovations as they are.
pub(super) fn raw_steps(pieces: &[Vec<Fix>], law: Law) -> Vec<Step> {
    let mut all = Vec::new();
    run(pieces, law, |step| all.push(step));
    all
}

/// The steps with standardised innovations.
pub(super) fn steps(pieces: &[Vec<Fix>], law: Law) -> Vec<Step> {
    let unit =
        |step: Step| Step { innovation: step.innovation.map(|new| new / step.variance.sqrt()), ..step };
    raw_steps(pieces, law).into_iter().map(unit).collect()
}

/// The innovations of each coordinate of each piece.
pub(super) fn by_coordinate(steps: &[Step], pieces: usize) -> Vec<Vec<f64>> {
    let mut series = vec![Vec::new(); 2 * pieces];
    for step in steps {
        for k in 0..2 {
            series[2 * step.piece + k].push(step.innovation[k]);
        }
    }
    series
}
