//! The bodies, settings and random numbers that the tests of this layer share.

#![allow(dead_code, clippy::unwrap_used, reason = "each test uses a part of it, and may fail")]

use motiform_analysis::{Regime, Settings, Verdict, classify};
use motiform_dynamics::steppers::{DOP853, Method};
use motiform_dynamics::{Equivariant, StepControl};
use motiform_models::ModelInfo;
use motiform_models::cell::{Cell, CellParameters};
use motiform_models::tensor::{Tensor, TensorParameters};

/// The reduced model of the paper's Simulations I (physics: b3 = 1, kappa3 = 1).
pub(crate) fn reduced(kappa2: f64, gamma: f64) -> Tensor {
    let others = TensorParameters::default();
    Tensor::new(&TensorParameters { gamma, kappa2, kappa3: 1.0, a1: 1.0, b1: 0.5, b3: 1.0, ..others })
}

/// The full model of the paper's Simulations II.
pub(crate) fn full(kappa2: f64, kappa3: f64) -> Tensor {
    Tensor::new(&TensorParameters::full(kappa2, kappa3))
}

/// The active cell of this length.
pub(crate) fn cell(length: f64, modes: u32) -> Cell {
    Cell::new(&CellParameters { length, modes: f64::from(modes), ..CellParameters::default() }).unwrap()
}

/// For fields whose time scales are of order 1 to 10.
pub(crate) const ORDINARY: Settings = Settings {
    method: Method::Explicit(&DOP853),
    control: StepControl::Adaptive { rtol: 1e-9, atol: 1e-12 },
    first_look: 100.0,
    budget: 2e4,
    escape_norm: 1e6,
    max_steps: 100_000_000,
};

/// The default settings of the classification of a model's motions.
pub(crate) fn settings(model: &str) -> Settings {
    let info = ModelInfo::find(model).unwrap();
    let (rtol, atol) = (info.rtol, info.absolute_tolerance(info.rtol));
    Settings {
        method: Method::find(info.stepper).unwrap(),
        control: StepControl::Adaptive { rtol, atol },
        first_look: info.look,
        budget: info.budget,
        escape_norm: 1e6,
        max_steps: 1_000_000_000,
    }
}

/// Names the motion from `start`.
pub(crate) fn named(body: &dyn Equivariant, start: &[f64], settings: &Settings) -> Verdict {
    classify(body, start, settings, &()).unwrap().unwrap()
}

/// One letter per regime, as in the tables of the measured motions.
pub(crate) fn letter(regime: Regime) -> char {
    match regime {
        Regime::Motionless => '.',
        Regime::Straight => 's',
        Regime::PulsatingStraight => 'p',
        Regime::Circular => 'c',
        Regime::Spinning => 'o',
        Regime::Rectangular => 'R',
        Regime::QuasiPeriodic => 'q',
        Regime::Zigzag => 'z',
        Regime::Chaotic => '*',
        Regime::BlowUp => 'B',
        Regime::Undetermined => '?',
    }
}

/// Numbers in -1..1: Steele, Lea, Flood (2014), OOPSLA, 453.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + 0.5 * (high - low) * (1.0 + self.next())
    }

    /// A state of this size in general position.
    pub(crate) fn state(&mut self, dim: usize, size: f64) -> Vec<f64> {
        (0..dim).map(|_| size * self.next()).collect()
    }
}

/// Asserts that `actual` lies within `tolerance` of `expected`.
pub(crate) fn near(actual: f64, expected: f64, tolerance: f64) {
    assert!((actual - expected).abs() <= tolerance, "{actual} is not {expected} +- {tolerance}");
}
