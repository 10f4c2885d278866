//! The arguments of the likelihood: frames in natural units and the parameters.

use super::{LONGEST_GAP, LONGEST_STRIDE};
use crate::field::{Field, Part};
use motiform_dynamics::Complex;
use motiform_dynamics::order::ascending;

/// Parameters of the noise: see [`Theta::logs`].
pub(crate) const NOISES: usize = 4;

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
    /// Number of terms.
    pub(crate) terms: usize,
    /// Frames of each stretch without a long gap.
    pub(crate) stretches: Vec<Vec<Frame>>,
    /// Variances of the process noise of `z1, z2, ..` for amplitudes 1, in natural units.
    pub(crate) noise: Vec<f64>,
    /// Mean variance of a coordinate of the centre, as stated, in natural units: the unit of the centre's own noise.
    pub(crate) centre: f64,
}

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
        let mut c = vec![Complex::new(0.0, 0.0); self.terms];
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
        let [_, v, shape, _] = theta.logs.map(|log| libm::exp(2.0 * log));
        std::array::from_fn(|i| match i {
            0 | 1 => 0.0,
            2 | 3 => self.noise[0] * v,
            _ => self.noise[i / 2 - 1] * shape,
        })
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
