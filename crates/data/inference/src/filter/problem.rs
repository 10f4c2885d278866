//! The arguments of the likelihood: frames in natural units and the parameters.

use super::{Evaluation, LONGEST_GAP, LONGEST_STRIDE};
use crate::field::{Field, Part};
use motiform_dynamics::Complex;
use motiform_dynamics::sample::ascending;

/// Parameters of the noise: see [`Theta::logs`].
pub(crate) const NOISES: usize = 4;

/// Variance, in natural units, of the errors of numbers that say nothing: 1e-8 of the information of errors of 1.
pub(crate) const UNSEEN: f64 = 1e8;

/// The least logarithm of the centre's own noise: there it is 0.
pub(crate) const NO_CENTRE_NOISE: f64 = -std::f64::consts::LN_10;

/// A frame in natural units: what is observed of the modes that are fitted.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) t: f64,
    pub(crate) y: Vec<f64>,
    pub(crate) covariance: Vec<Vec<f64>>,
}

/// Tracks and a library, in natural units.
#[derive(Clone, Debug)]
pub(crate) struct Problem {
    pub(crate) field: Field,
    /// The coefficients that are parameters.
    pub(crate) parts: Vec<Part>,
    /// Coefficients of all terms, 0 where they are parameters.
    pub(crate) given: Vec<Complex<f64>>,
    /// Frames of each stretch without a long gap.
    pub(crate) stretches: Vec<Vec<Frame>>,
    /// The process noise of `z1, z2, ..`.
    pub(crate) noise: Vec<ProcessNoise>,
    /// Mean variance of a coordinate of the centre, as stated, in natural units: the unit of the centre's own noise.
    pub(crate) centre: f64,
    /// Numbers of each frame, its last ones, that say nothing: their errors are [`UNSEEN`].
    pub(crate) unseen: usize,
}

/// The process noise of an amplitude.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ProcessNoise {
    /// The parameter that it is in proportion to: the place in [`Theta::logs`].
    pub(crate) by: usize,
    /// Its variance, per natural time, where that parameter is 1.
    pub(crate) variance: f64,
}

/// The place of `eta_v` in [`Theta::logs`].
pub(crate) const ETA_V: usize = 1;
/// The place of `eta_shape`.
pub(crate) const ETA_SHAPE: usize = 2;

/// Values of the parameters.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Theta {
    /// In the order of [`Problem::parts`], natural units.
    pub(crate) coefficients: Vec<f64>,
    /// Logarithms of `s`, `eta_v`, `eta_shape`, and `l` of the centre's own noise ([`Problem::own_noise`]).
    pub(crate) logs: [f64; NOISES],
}

impl Theta {
    /// The parameters after a step.
    pub(crate) fn stepped(&self, step: &[f64]) -> Self {
        let n = self.coefficients.len();
        let coefficients = self.coefficients.iter().zip(step).map(|(c, d)| c + d).collect();
        Self { coefficients, logs: std::array::from_fn(|i| self.logs[i] + step[n + i]) }
    }
}

impl Problem {
    /// Number of parameters.
    pub(crate) fn len(&self) -> usize {
        self.parts.len() + NOISES
    }

    /// Number of frames that have a likelihood: all but the first of each stretch.
    pub(crate) fn frames(&self) -> usize {
        self.stretches.iter().map(|stretch| stretch.len() - 1).sum()
    }

    /// The first half of each stretch, if there are as many frames as `long`.
    pub(crate) fn head(&self, long: usize) -> Option<Self> {
        let half = |stretch: &Vec<Frame>| stretch[..stretch.len().div_ceil(2).max(2)].to_vec();
        let stretches = || self.stretches.iter().map(half).collect();
        (self.frames() >= long).then(|| Self { stretches: stretches(), ..self.clone() })
    }

    /// Complex coefficients of all terms.
    pub(crate) fn complex(&self, theta: &Theta) -> Vec<Complex<f64>> {
        let mut c = self.given.clone();
        for (part, &value) in self.parts.iter().zip(&theta.coefficients) {
            let place = if part.imaginary { &mut c[part.term].im } else { &mut c[part.term].re };
            *place = value;
        }
        c
    }

    /// Number of amplitudes.
    pub(crate) fn modes(&self) -> usize {
        self.noise.len()
    }

    /// Variances of the process noise, per natural time, of the entries of the state.
    pub(crate) fn process<const STATE: usize>(&self, theta: &Theta) -> [f64; STATE] {
        let squares = theta.logs.map(|log| libm::exp(2.0 * log));
        let of = |noise: &ProcessNoise| noise.variance * squares[noise.by];
        std::array::from_fn(|i| if i < 2 { 0.0 } else { of(&self.noise[i / 2 - 1]) })
    }

    /// Takes the part of the numbers that say nothing out of an evaluation: `- ln(2 pi s^2 U)/2` for each with its variance `U`.
    pub(crate) fn without_unseen(&self, theta: &Theta, found: &mut Evaluation) {
        let count = (self.unseen * self.frames()) as f64;
        let s = self.parts.len();
        found.value += count * (0.5 * libm::log(std::f64::consts::TAU * UNSEEN) + theta.logs[0]);
        if !found.gradient.is_empty() {
            found.gradient[s] += count;
            found.information[(s, s)] -= 2.0 * count;
        }
    }

    /// Variance of a coordinate's error that all outlines of a frame may have beside that of the contour, and its derivative by `l`:
    ///
    /// `c (exp(2 l) - exp(2 l0))` with the stated variance `c` and the least `l0`, where it is 0: cells
    /// without such noise are fitted as if it were not there.
    pub(crate) fn own_noise(&self, theta: &Theta) -> [f64; 2] {
        let square = libm::exp(2.0 * theta.logs[3]);
        let least = libm::exp(2.0 * NO_CENTRE_NOISE);
        [self.centre * (square - least).max(0.0), 2.0 * self.centre * square]
    }

    /// The `l` of a standard deviation of the centre's own noise, in natural units.
    pub(crate) fn log_of_own_noise(&self, deviation: f64) -> f64 {
        0.5 * libm::log(deviation * deviation / self.centre + libm::exp(2.0 * NO_CENTRE_NOISE))
    }

    /// The longest gap that the filter goes on through, where frames usually follow each other after `usual`.
    pub(crate) fn longest_gap(usual: f64) -> f64 {
        LONGEST_GAP.max(LONGEST_STRIDE * usual)
    }

    /// Cuts frames where they are too far apart; stretches of fewer than three frames are left out.
    pub(crate) fn cut(frames: Vec<Frame>) -> Vec<Vec<Frame>> {
        let mut stretches: Vec<Vec<Frame>> = Vec::new();
        let mut last = f64::NEG_INFINITY;
        let mut steps: Vec<f64> = frames.windows(2).map(|pair| pair[1].t - pair[0].t).collect();
        ascending(&mut steps);
        let usual = steps.get(steps.len() / 2).copied().unwrap_or(0.0);
        let longest = Self::longest_gap(usual);
        for frame in frames {
            if frame.t - last > longest || stretches.is_empty() {
                stretches.push(Vec::new());
            }
            last = frame.t;
            if let Some(stretch) = stretches.last_mut() {
                stretch.push(frame);
            }
        }
        stretches.retain(|stretch| stretch.len() >= 3);
        stretches
    }
}
