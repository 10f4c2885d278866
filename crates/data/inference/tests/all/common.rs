//! A simulator of its own: Heun's method with additive noise, observed with errors.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::{Complex, Normal};
use motiform_inference::{Fit, Observation, Selection, Settings, Track, fit, select};
use std::sync::OnceLock;

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

/// The full model with z4: driven by z2 and by z1 with z3, it acts back on both.
pub(crate) fn four() -> Equations {
    let mut equations = full(0.5, 0.1);
    equations.extend([
        term(2, 0.4, &[-2, 4]),
        term(3, -0.2, &[-1, 4]),
        term(4, -0.6, &[4]),
        term(4, 2.0, &[2, 2]),
        term(4, 0.5, &[1, 3]),
    ]);
    equations
}

/// Names of the terms of [`four`], in the order of a library.
pub(crate) const FOUR: [&str; 14] = [
    "z1: z1",
    "z1: z1* z2",
    "z1: |z1|^2 z1",
    "z2: z2",
    "z2: z1^2",
    "z2: z1* z3",
    "z2: z2* z4",
    "z3: z3",
    "z3: z1 z2",
    "z3: z1* z4",
    "z3: z1^3",
    "z4: z4",
    "z4: z1 z3",
    "z4: z2^2",
];

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

/// The covariance of independent errors.
pub(crate) fn diagonal(errors: &[f64]) -> Vec<Vec<f64>> {
    let of = |i: usize, j: usize| if i == j { (errors[i] * errors[i]).max(1e-20) } else { 0.0 };
    (0..errors.len()).map(|i| (0..errors.len()).map(|j| of(i, j)).collect()).collect()
}

const ZERO: Complex<f64> = Complex { re: 0.0, im: 0.0 };

/// z1 to z4; of models without z4 it stays 0.
type Shape = [Complex<f64>; 4];

fn rates(equations: &Equations, z: &Shape) -> Shape {
    let mut rates = [ZERO; 4];
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
    pub(crate) start: Shape,
    /// Left out at the beginning.
    pub(crate) transient: f64,
    pub(crate) interval: f64,
    pub(crate) frames: usize,
    /// Process noise of the velocity and the shape.
    pub(crate) eta: [f64; 2],
    /// Rate at which the noise of the velocity forgets, of models without z4, whose place it takes; 0: white noise.
    pub(crate) memory: f64,
    /// Change of kappa2 over the record.
    pub(crate) change: f64,
    /// Standard deviations of the errors of x and y, and of the parts of the modes.
    pub(crate) errors: [f64; 2],
    pub(crate) seed: u64,
}

/// 1 % of the radius 2 on each of 48 vertices.
pub(crate) const VERTEX_NOISE: [f64; 2] = vertex_noise(2.0);

/// Errors of the centre and of the parts of the modes for noise of 1 % of the radius on each of 48 vertices:
/// `sigma sqrt(2/48)` and `sigma/sqrt(2 48)`.
pub(crate) const fn vertex_noise(radius: f64) -> [f64; 2] {
    [0.01 * radius * 0.204_124_145, 0.01 * radius * 0.102_062_073]
}

impl Experiment {
    /// `eta` on each component of the velocity and of the tensors S and U: half of it on `z2` and `z3`.
    pub(crate) fn new(equations: Equations, eta: f64, seed: u64) -> Self {
        let start = [
            Complex::new(0.5, -0.3),
            Complex::new(-0.1, 0.05),
            Complex::new(0.02, 0.03),
            Complex::new(0.0, 0.0),
        ];
        let (interval, frames) = (0.5, 1000);
        Self {
            equations,
            start,
            transient: 100.0,
            interval,
            frames,
            eta: [eta, 0.5 * eta],
            memory: 0.0,
            change: 0.0,
            errors: VERTEX_NOISE,
            seed,
        }
    }

    pub(crate) fn track(&self) -> Track {
        let kicks = Normal::new(self.seed, 0);
        let slips = Normal::new(self.seed, 1);
        let mut kicks = [kicks, Normal::new(self.seed, 2)];
        let mut slips = [slips, Normal::new(self.seed, 3)];
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
            let now = self.changed(frame as f64 / self.frames as f64);
            for _ in 0..steps as usize {
                now.step(&mut r, &mut z, h, &mut kicks);
            }
        }
        Track(frames)
    }

    /// The law after this share of the record.
    fn changed(&self, share: f64) -> Self {
        let mut now = self.clone();
        for (_, c, _) in now.equations.iter_mut().filter(|(equation, _, of)| *equation == 2 && of == &[2]) {
            c.re -= share * self.change;
        }
        now
    }

    /// Heun's method: of second order in the drift, and the noise is additive.
    fn step(&self, r: &mut [f64; 2], z: &mut Shape, h: f64, kicks: &mut [Normal; 2]) {
        let before = *z;
        let first = self.rates(z);
        let kick: Shape = std::array::from_fn(|n| {
            let white = self.memory == 0.0;
            let size = match n {
                0 if !white => 0.0,
                3 if !white => self.memory * self.eta[0],
                _ if n == self.modes() => 0.0,
                _ => self.eta[n.min(1)],
            };
            if size == 0.0 {
                return ZERO;
            }
            let (size, normal) = (size * h.sqrt(), &mut kicks[n / 3]);
            Complex::new(size * normal.next(), size * normal.next())
        });
        let guess: Shape = std::array::from_fn(|n| before[n] + first[n] * h + kick[n]);
        let second = self.rates(&guess);
        for n in 0..4 {
            z[n] = before[n] + (first[n] + second[n]) * (0.5 * h) + kick[n];
        }
        r[0] += 0.5 * h * (before[0].re + z[0].re);
        r[1] -= 0.5 * h * (before[0].im + z[0].im);
    }

    fn rates(&self, z: &Shape) -> Shape {
        let mut rates = rates(&self.equations, z);
        if self.memory > 0.0 {
            rates[0] += z[3];
            rates[3] = z[3] * -self.memory;
        }
        rates
    }

    fn observe(&self, t: f64, r: [f64; 2], z: Shape, slips: &mut [Normal; 2]) -> Observation {
        let exact = r.into_iter().chain(z[1..self.modes()].iter().flat_map(|z| [z.re, z.im]));
        let errors: Vec<f64> = (0..2 * self.modes()).map(|i| self.errors[usize::from(i >= 2)]).collect();
        let y = exact.enumerate().map(|(i, x)| x + errors[i] * slips[i / 6].next()).collect();
        Observation { t, y, covariance: diagonal(&errors) }
    }

    /// 3, or 4 if there is an equation of z4.
    fn modes(&self) -> usize {
        self.equations.iter().map(|(equation, ..)| *equation).max().unwrap_or(0).max(3)
    }
}

/// A zigzag of Fig. 5(b) in a short record, kappa2 = 0.9, kappa3 = 0.1: its fit and its terms.
pub(crate) struct Zigzag {
    pub(crate) tracks: [Track; 1],
    pub(crate) whole: Fit,
    pub(crate) selection: Selection,
}

/// Twelve of them with 250 frames: several tests look at each.
pub(crate) fn zigzag(number: usize) -> &'static Zigzag {
    static ZIGZAGS: [OnceLock<Zigzag>; 12] = [const { OnceLock::new() }; 12];
    ZIGZAGS[number].get_or_init(|| {
        let law = Experiment::new(full(0.9, 0.1), 0.01, 300 + number as u64);
        let tracks = [Experiment { errors: vertex_noise(1.2), frames: 250, ..law }.track()];
        let whole = fit(&tracks, &Settings::default(), &()).unwrap();
        let selection = select(&tracks, &whole, &()).unwrap();
        Zigzag { tracks, whole, selection }
    })
}

/// A circle of the full model without noise and its fit: several tests look at it, and it takes long.
pub(crate) fn circle() -> &'static ([Track; 1], Fit) {
    static CIRCLE: OnceLock<([Track; 1], Fit)> = OnceLock::new();
    CIRCLE.get_or_init(|| {
        let tracks = [Experiment { frames: 60, ..Experiment::new(full(0.5, 0.3), 0.0, 7) }.track()];
        let whole = fit(&tracks, &Settings::default(), &()).unwrap();
        (tracks, whole)
    })
}
