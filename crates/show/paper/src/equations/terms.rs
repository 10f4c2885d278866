//! Terms of an equation for phi(s), on a grid: derivatives and products of two of them.

use motiform_study::initial::Uniform;
use std::f64::consts::TAU;

/// Points of the grid; modes of the random functions (products stay resolved).
pub(super) const POINTS: usize = 64;
const MODES: usize = 10;

/// Highest derivative of a linear term, and the sum of both orders of a bilinear one.
const LINEAR: u32 = 6;
const BILINEAR: u32 = 5;

/// A term: the orders of its derivatives.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Term {
    Linear(u32),
    Bilinear(u32, u32),
}

/// The paper's terms, g1 to g5.
pub(super) const PAPER: [Term; 5] =
    [Term::Linear(2), Term::Linear(4), Term::Linear(6), Term::Bilinear(1, 2), Term::Bilinear(2, 3)];

impl Term {
    /// All linear and bilinear ones.
    pub(super) fn all() -> Vec<Self> {
        let linear = (0..=LINEAR).map(Self::Linear);
        let pairs = (0..=BILINEAR).flat_map(|p| (p..=BILINEAR).map(move |q| (p, q)));
        let bilinear = pairs.filter(|(p, q)| p + q <= BILINEAR).map(|(p, q)| Self::Bilinear(p, q));
        linear.chain(bilinear).collect()
    }

    /// On a function over `0..2 pi`, from its values on the grid, constants included.
    pub(super) fn of(self, phi: &[f64]) -> Vec<f64> {
        match self {
            Self::Linear(p) => derivative(phi, p),
            Self::Bilinear(p, q) => {
                derivative(phi, p).iter().zip(derivative(phi, q)).map(|(a, b)| a * b).collect()
            }
        }
    }

    /// In usual notation.
    pub(super) fn words(self) -> String {
        let one = |p: u32| match p {
            0 => "*φ*".to_owned(),
            1 => "(∂_s*φ*)".to_owned(),
            p => format!("(∂_s^{p}*φ*)"),
        };
        match self {
            Self::Linear(p) => one(p),
            Self::Bilinear(p, q) => one(p) + &one(q),
        }
    }

    /// Defects against (i), (ii), (iii), relative to the term.
    pub(super) fn defects(self) -> [f64; 3] {
        let phi = random(3);
        let term = self.of(&phi);
        let size = term.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let off =
            |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size;
        let raised: Vec<f64> = phi.iter().map(|x| x + 1.7).collect();
        let shifted = |f: &[f64]| (0..POINTS).map(|j| f[(j + 13) % POINTS]).collect::<Vec<_>>();
        let mirrored = |f: &[f64]| (0..POINTS).map(|j| -f[(POINTS - j) % POINTS]).collect::<Vec<_>>();
        [
            off(&self.of(&raised), &term),
            off(&self.of(&shifted(&phi)), &shifted(&term)),
            off(&self.of(&mirrored(&phi)), &mirrored(&term)),
        ]
    }

    /// 0 for a term that is the variation of a functional: the derivative `J` of the term is then symmetric. The difference of
    /// `<u, J w>` and `<w, J u>` over their sizes, for random u, w.
    pub(super) fn turning(self) -> f64 {
        let (phi, u, w) = (random(5), random(6), random(7));
        let along = |direction: &[f64]| {
            let moved = |sign: f64| {
                self.of(&phi.iter().zip(direction).map(|(x, d)| x + sign * d).collect::<Vec<_>>())
            };
            // exact: the term is at most quadratic
            moved(1.0).iter().zip(moved(-1.0)).map(|(a, b)| 0.5 * (a - b)).collect::<Vec<_>>()
        };
        let (one, other) = (inner(&u, &along(&w)), inner(&w, &along(&u)));
        (one - other).abs() / (one.abs() + other.abs())
    }

    /// Returns `true` if the three symmetries allow it.
    pub(super) fn is_allowed(self) -> bool {
        self.defects().iter().all(|defect| *defect < 1e-8)
    }
}

/// A random function on the grid.
pub(super) fn random(seed: u64) -> Vec<f64> {
    let mut uniform = Uniform::new(seed, 0);
    let modes: Vec<[f64; 2]> = (0..MODES).map(|_| [uniform.draw(), uniform.draw()]).collect();
    let at = |j: usize| {
        let wave = |(n, [c, s]): (usize, &[f64; 2])| {
            let (sin, cos) = libm::sincos(TAU * (n * j) as f64 / POINTS as f64);
            c * cos + s * sin
        };
        (1..).zip(&modes).map(wave).sum()
    };
    (0..POINTS).map(at).collect()
}

/// `sum_j a_j b_j`.
pub(super) fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The derivative of order `p`, by a Fourier transform written out; the waves are those of `0..2 pi`.
pub(super) fn derivative(f: &[f64], p: u32) -> Vec<f64> {
    let angle = |n: usize, j: usize| TAU * ((n * j) % POINTS) as f64 / POINTS as f64;
    let part = |n: usize, of: fn(f64) -> f64| {
        2.0 / POINTS as f64 * f.iter().enumerate().map(|(j, x)| x * of(angle(n, j))).sum::<f64>()
    };
    let waves: Vec<(f64, f64)> = (0..POINTS / 2).map(|n| (part(n, libm::cos), part(n, libm::sin))).collect();
    let at = |j: usize| {
        let wave = |(n, (c, s)): (usize, &(f64, f64))| {
            let (sin, cos) = libm::sincos(angle(n, j));
            let (even, odd) = ([c * cos + s * sin, s * cos - c * sin], (p % 2) as usize);
            let sign = if p % 4 < 2 { 1.0 } else { -1.0 };
            let half = if n == 0 { 0.5 } else { 1.0 };
            half * sign * (n as f64).powi(p.cast_signed()) * even[odd]
        };
        waves.iter().enumerate().map(wave).sum()
    };
    (0..POINTS).map(at).collect()
}
