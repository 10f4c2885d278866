//! A simulator of its own: Heun's method with additive noise, observed with errors.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::{Complex, Normal};
use motiform_inference::{Observation, Track};

/// `(equation, coefficient, factors)`: each factor an amplitude from 1, negative for its conjugate.
pub(crate) type Equations = Vec<(usize, Complex<f64>, Vec<i32>)>;

fn term(equation: usize, re: f64, factors: &[i32]) -> (usize, Complex<f64>, Vec<i32>) {
    (equation, Complex::new(re, 0.0), factors.to_vec())
}

/// The paper's full model (presets fig5a, fig5b).
pub(crate) fn full(kappa2: f64, kappa3: f64) -> Equations {
    vec![
        term(1, 1.0, &[1]),
        term(1, 2.0, &[-1, 2]),
        term(1, -1.0, &[1, 1, -1]),
        term(2, -kappa2, &[2]),
        term(2, -0.125, &[1, 1]),
        term(2, 0.3, &[-1, 3]),
        term(3, -kappa3, &[3]),
        term(3, 0.4, &[1, 2]),
        term(3, 0.0125, &[1, 1, 1]),
    ]
}

/// The paper's quasi-periodic motion (preset fig3): slow, with a z3 that only noise moves.
pub(crate) fn quasi_periodic() -> Equations {
    vec![
        term(1, 0.02, &[1]),
        term(1, -2.0, &[-1, 2]),
        term(1, -1.0, &[1, 1, -1]),
        term(2, 0.06, &[2]),
        term(2, 0.125, &[1, 1]),
        term(2, -8.0, &[2, 2, -2]),
        term(3, -1.0, &[3]),
    ]
}

/// Names of the terms of [`full`], in the same order.
pub(crate) const FULL: [&str; 9] = [
    "z1: z1",
    "z1: z1* z2",
    "z1: |z1|^2 z1",
    "z2: z2",
    "z2: z1^2",
    "z2: z1* z3",
    "z3: z3",
    "z3: z1 z2",
    "z3: z1^3",
];

pub(crate) fn rates(equations: &Equations, z: &[Complex<f64>; 3]) -> [Complex<f64>; 3] {
    let mut rates = [Complex::new(0.0, 0.0); 3];
    for (equation, c, factors) in equations {
        let mut product = *c;
        for &factor in factors {
            let z = z[factor.unsigned_abs() as usize - 1];
            product = product * if factor > 0 { z } else { z.conj() };
        }
        rates[equation - 1] += product;
    }
    rates
}

/// A simulated experiment.
#[derive(Clone, Debug)]
pub(crate) struct Experiment {
    pub(crate) equations: Equations,
    pub(crate) start: [Complex<f64>; 3],
    /// Left out at the beginning.
    pub(crate) transient: f64,
    pub(crate) interval: f64,
    pub(crate) frames: usize,
    /// Process noise of the velocity and the shape.
    pub(crate) eta: [f64; 2],
    /// Standard deviations of the errors of x and y, and of the parts of the modes.
    pub(crate) errors: [f64; 2],
    pub(crate) seed: u64,
}

/// 1 % of the radius 2 on each of 48 vertices.
pub(crate) const VERTEX_NOISE: [f64; 2] = vertex_noise(2.0);

/// Errors of the centre and of the parts of the modes for noise of 1 % of the radius on each of 48 vertices: `sigma sqrt(2/48)` and `sigma/sqrt(2 48)`.
pub(crate) const fn vertex_noise(radius: f64) -> [f64; 2] {
    [0.01 * radius * 0.204_124_145, 0.01 * radius * 0.102_062_073]
}

impl Experiment {
    /// `eta` on each component of the velocity and of the tensors S and U: half of it on `z2` and `z3`.
    pub(crate) fn new(equations: Equations, eta: f64, seed: u64) -> Self {
        let start = [Complex::new(0.5, -0.3), Complex::new(-0.1, 0.05), Complex::new(0.02, 0.03)];
        let (interval, frames) = (0.5, 1000);
        Self {
            equations,
            start,
            transient: 100.0,
            interval,
            frames,
            eta: [eta, 0.5 * eta],
            errors: VERTEX_NOISE,
            seed,
        }
    }

    pub(crate) fn track(&self) -> Track {
        let mut kicks = Normal::new(self.seed, 0);
        let mut slips = Normal::new(self.seed, 1);
        let (mut r, mut z) = ([0.0; 2], self.start);
        let steps = (self.interval / 0.01).ceil();
        let h = self.interval / steps;
        let mut frames = Vec::new();
        for _ in 0..(self.transient / h) as usize {
            self.step(&mut r, &mut z, h, &mut kicks);
        }
        r = [0.0; 2];
        for frame in 0..self.frames {
            frames.push(self.observe(frame as f64 * self.interval, r, z, &mut slips));
            for _ in 0..steps as usize {
                self.step(&mut r, &mut z, h, &mut kicks);
            }
        }
        Track(frames)
    }

    /// Heun's method: of second order in the drift, and the noise is additive.
    fn step(&self, r: &mut [f64; 2], z: &mut [Complex<f64>; 3], h: f64, kicks: &mut Normal) {
        let before = *z;
        let first = rates(&self.equations, z);
        let kick: [Complex<f64>; 3] = std::array::from_fn(|n| {
            let size = self.eta[n.min(1)] * h.sqrt();
            Complex::new(size * kicks.next(), size * kicks.next())
        });
        let guess: [Complex<f64>; 3] = std::array::from_fn(|n| before[n] + first[n] * h + kick[n]);
        let second = rates(&self.equations, &guess);
        for n in 0..3 {
            z[n] = before[n] + (first[n] + second[n]) * (0.5 * h) + kick[n];
        }
        r[0] += 0.5 * h * (before[0].re + z[0].re);
        r[1] -= 0.5 * h * (before[0].im + z[0].im);
    }

    fn observe(&self, t: f64, r: [f64; 2], z: [Complex<f64>; 3], slips: &mut Normal) -> Observation {
        let exact = [r[0], r[1], z[1].re, z[1].im, z[2].re, z[2].im];
        let error = |i: usize| self.errors[usize::from(i >= 2)];
        let y = std::array::from_fn(|i| exact[i] + error(i) * slips.next());
        let covariance = std::array::from_fn(|i| {
            std::array::from_fn(|j| if i == j { (error(i) * error(i)).max(1e-20) } else { 0.0 })
        });
        Observation { t, y, covariance }
    }
}
