//! Cells that follow a law, with noise that need not be white, and coefficients that need not stay: a simulator of its own, by Heun's
//! method.

use motiform_dynamics::{Complex, Normal};
use motiform_tracks::synthetic::Synthetic;

/// A term: its name in a library, its equation from 1, its coefficient, and its factors: each an amplitude from 1, negative for its
/// conjugate.
#[derive(Clone)]
pub(super) struct Term {
    pub(super) name: &'static str,
    equation: usize,
    pub(super) value: Complex<f64>,
    factors: &'static [i32],
}

/// A law and how it is seen.
#[derive(Clone)]
pub(super) struct Law {
    /// Name of the motion without noise; `None` where it has no name that a fit could give (handed laws).
    pub(super) motion: Option<&'static str>,
    pub(super) terms: Vec<Term>,
    /// Radius of the circle that is deformed.
    pub(super) radius: f64,
    /// Process noise of the velocity; the modes have half of it.
    pub(super) noise: f64,
    /// Correlation time of the noise; 0: white.
    pub(super) memory: f64,
    /// Relative change of the linear rates of the shape over the record.
    pub(super) ramp: f64,
    /// Relative size of five oscillations of the linear rate of the velocity over the record.
    pub(super) rhythm: f64,
    /// z4 as a part of z2^2, which no model of three modes has.
    pub(super) fourth: f64,
}

fn term(name: &'static str, equation: usize, re: f64, factors: &'static [i32]) -> Term {
    Term { name, equation, value: Complex::new(re, 0.0), factors }
}

/// The paper's full model (presets fig4, fig5a, fig5b).
pub(super) fn full(motion: &'static str, kappa2: f64, kappa3: f64, radius: f64) -> Law {
    let terms = vec![
        term("z1: z1", 1, 1.0, &[1]),
        term("z1: z1* z2", 1, 2.0, &[-1, 2]),
        term("z1: |z1|^2 z1", 1, -1.0, &[1, 1, -1]),
        term("z2: z2", 2, -kappa2, &[2]),
        term("z2: z1^2", 2, -0.125, &[1, 1]),
        term("z2: z1* z3", 2, 0.3, &[-1, 3]),
        term("z3: z3", 3, -kappa3, &[3]),
        term("z3: z1 z2", 3, 0.4, &[1, 2]),
        term("z3: z1^3", 3, 0.0125, &[1, 1, 1]),
    ];
    Law { motion: Some(motion), terms, radius, noise: 0.01, memory: 0.0, ramp: 0.0, rhythm: 0.0, fourth: 0.0 }
}

/// The paper's reduced model (presets fig1, fig3), with a z3 that only noise moves.
pub(super) fn reduced(motion: &'static str, gamma: f64, kappa2: f64) -> Law {
    let terms = vec![
        term("z1: z1", 1, gamma, &[1]),
        term("z1: z1* z2", 1, -2.0, &[-1, 2]),
        term("z1: |z1|^2 z1", 1, -1.0, &[1, 1, -1]),
        term("z2: z2", 2, -kappa2, &[2]),
        term("z2: z1^2", 2, 0.125, &[1, 1]),
        term("z2: |z2|^2 z2", 2, -8.0, &[2, 2, -2]),
        term("z3: z3", 3, -1.0, &[3]),
    ];
    Law {
        motion: Some(motion),
        terms,
        radius: 0.35,
        noise: 0.002,
        memory: 0.0,
        ramp: 0.0,
        rhythm: 0.0,
        fourth: 0.0,
    }
}

impl Law {
    /// The same with an imaginary part of a term: a handed law.
    pub(super) fn handed(mut self, name: &str, imaginary: f64) -> Self {
        for term in self.terms.iter_mut().filter(|term| term.name == name) {
            term.value.im = imaginary;
        }
        Self { motion: None, ..self }
    }

    pub(super) fn is_handed(&self) -> bool {
        self.terms.iter().any(|term| term.value.im != 0.0)
    }

    /// The body at `frames` times `dt` apart, after a transient; `None` where it blows up.
    pub(super) fn bodies(&self, (dt, frames): (f64, usize), seed: u64) -> Option<Vec<Synthetic>> {
        let mut run = Run::new(self, seed);
        let steps = (dt / 0.01).ceil();
        let h = dt / steps;
        (0..(150.0 / h) as usize).for_each(|_| run.step(h, 0.0));
        run.centre = [0.0; 2];
        let mut seen = Vec::with_capacity(frames);
        for frame in 0..frames {
            seen.push(run.body());
            let part = frame as f64 / frames as f64;
            (0..steps as usize).for_each(|_| run.step(h, part));
        }
        run.z.iter().all(|z| z.re.is_finite() && z.im.is_finite()).then_some(seen)
    }
}

struct Run<'a> {
    law: &'a Law,
    random: Normal,
    centre: [f64; 2],
    z: [Complex<f64>; 3],
    coloured: [Complex<f64>; 3],
}

impl<'a> Run<'a> {
    fn new(law: &'a Law, seed: u64) -> Self {
        let z = [Complex::new(0.3, -0.2), Complex::new(-0.1, 0.05), Complex::new(0.02, 0.03)];
        Self {
            law,
            random: Normal::new(seed, 11),
            centre: [0.0; 2],
            z,
            coloured: [Complex::new(0.0, 0.0); 3],
        }
    }

    fn rates(&self, z: &[Complex<f64>; 3], part: f64) -> [Complex<f64>; 3] {
        let mut rates = self.coloured;
        for Term { equation, value, factors, .. } in &self.law.terms {
            let mut product = *value;
            if *equation == 2 && factors.len() == 1 {
                product = product * (1.0 + self.law.ramp * part);
            }
            if *equation == 1 && factors.len() == 1 {
                product = product * (1.0 + self.law.rhythm * libm::sin(5.0 * std::f64::consts::TAU * part));
            }
            for &factor in *factors {
                let z = z[factor.unsigned_abs() as usize - 1];
                product = product * if factor > 0 { z } else { z.conj() };
            }
            rates[equation - 1] += product;
        }
        rates
    }

    /// Heun's method; noise with a memory has the spectrum of white noise at frequency 0.
    fn step(&mut self, h: f64, part: f64) {
        let kick: [Complex<f64>; 3] = std::array::from_fn(|n| {
            let size = self.law.noise * if n == 0 { 1.0 } else { 0.5 } * h.sqrt();
            Complex::new(size * self.random.next(), size * self.random.next())
        });
        let memory = self.law.memory;
        let white = if memory > 0.0 { [Complex::new(0.0, 0.0); 3] } else { kick };
        let before = self.z;
        let first = self.rates(&before, part);
        let guess = std::array::from_fn(|n| before[n] + first[n] * h + white[n]);
        let second = self.rates(&guess, part);
        for n in 0..3 {
            self.z[n] = before[n] + (first[n] + second[n]) * (0.5 * h) + white[n];
            if memory > 0.0 {
                self.coloured[n] += (kick[n] + self.coloured[n] * -h) * memory.recip();
            }
        }
        self.centre[0] += 0.5 * h * (before[0].re + self.z[0].re);
        self.centre[1] -= 0.5 * h * (before[0].im + self.z[0].im);
    }

    fn body(&self) -> Synthetic {
        let [_, z2, z3] = self.z;
        let z4 = z2 * z2 * (self.law.fourth / self.law.radius);
        Synthetic { centre: self.centre, r0: self.law.radius, z: [z2, z3, z4].map(|z| [z.re, z.im]).to_vec() }
    }
}
