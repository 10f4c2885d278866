//! Noise: normal deviates with the same bits on every machine, and the law of the noise added to an orbit.

use crate::{Error, Model, Semilinear};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::f64::consts::TAU;

/// Independent standard normal deviates, addressed by (seed, stream).
///
/// x = sqrt(-2 ln p) cos(2 pi q), y = sqrt(-2 ln p) sin(2 pi q); p in (0, 1], q in [0, 1) with 53 random bits each.
///
/// Source: Box and Muller (1958), Ann. Math. Stat. 29, 610; bits from ChaCha8 (key = seed), logarithm and sine from
/// `libm`: the same on every machine. Different streams of one seed are independent. No deviate exceeds 8.58.
///
/// # Checked by  tests/all/noise.rs: moments, tails, independence, bits
#[derive(Clone, Debug)]
pub struct Normal {
    bits: ChaCha8Rng,
    /// The second deviate of the last pair.
    spare: Option<f64>,
}

impl Normal {
    /// The deviates number 0, 1, 2, ... of this seed and stream.
    pub fn new(seed: u64, stream: u64) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        let mut bits = ChaCha8Rng::from_seed(key);
        bits.set_stream(stream);
        Self { bits, spare: None }
    }

    /// The next deviate.
    #[allow(clippy::should_implement_trait, reason = "it never ends, so it is no iterator over options")]
    pub fn next(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        let p = 1.0 - self.uniform();
        let (sin, cos) = libm::sincos(TAU * self.uniform());
        let radius = (-2.0 * libm::log(p)).sqrt();
        self.spare = Some(radius * sin);
        radius * cos
    }

    /// The next number of the generator, uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        (self.bits.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Noise whose strength depends on the state, in the reading of Stratonovich: `du = f(u) dt + sum_p g_p(u) o dW_p`.
pub trait Diffusion: Send + Sync {
    /// Number of independent Wiener processes `W_p`.
    fn processes(&self) -> usize;

    /// Moves `u` along `du/dw = g_p(u)` by `w`, to an error of order `w^5` or less.
    fn kick(&self, process: usize, w: f64, u: &mut [f64]);

    /// The rate (inverse model time) at which it changes states of size 1; it limits the step of the noise.
    fn rate(&self) -> f64;

    /// Returns `true` if it changes this entry of the state.
    fn moves(&self, entry: usize) -> bool;
}

/// The noise that belongs to a model, beside that of a run.
#[derive(Default)]
pub struct ModelNoise {
    /// Additive noise: `eta_i` of each entry of the shape, as in [`Noise::amplitudes`]; empty if there is none.
    pub amplitudes: Vec<f64>,
    /// Noise whose strength depends on the state.
    pub diffusion: Option<Box<dyn Diffusion>>,
}

impl ModelNoise {
    /// Returns `true` if there is no noise.
    pub fn is_none(&self) -> bool {
        self.diffusion.is_none() && self.amplitudes.iter().all(|amplitude| *amplitude == 0.0)
    }
}

/// Additive white noise on a flow: `du_i = f_i(u) dt + eta_i dW_i`, with independent Wiener processes `W_i`.
///
/// `f` has the linear part `lambda_i u_i` ([`Semilinear`]), which is treated exactly (see [`crate::NoisyOrbit`]). As the noise does not
/// depend on the state, the readings of Ito and Stratonovich are one.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// `eta_i`, at least 0, of the leading entries of the state (a position is not kicked).
    ///
    /// # Units   unit of the entry / sqrt(model time): without the flow its variance would be `eta_i^2 t`
    pub amplitudes: Vec<f64>,
    /// `lambda_i` of the same entries (inverse model time): 0 if unknown.
    pub rates: Vec<f64>,
    /// Model time `h` of one step of the noise, above 0 ([`Noise::step_for`]).
    pub step: f64,
}

impl Noise {
    /// The noise that gives every coordinate of `model` ([`Model::coordinates`]) the same strength: `velocity` to those that are the
    /// velocity itself ([`Model::velocities`]), `shape` to all others; and the additive noise of the model
    /// itself. The plane's rotations turn pairs of coordinates, so its law does not change with them.
    ///
    /// # Checked by  engine/models/tests/all/noise.rs: rotation invariance, for both models
    pub fn on<M: Model + ?Sized>(model: &M, velocity: f64, shape: f64, step: f64) -> Self {
        let dim = model.dim();
        let (mut rates, mut variances) = (vec![0.0; dim], vec![0.0; dim]);
        Semilinear::<f64>::linear(model, &mut rates);
        let (mut unit, mut image) = (vec![0.0; dim], vec![0.0; dim]);
        for coordinate in 0..dim {
            unit[coordinate] = if coordinate < model.velocities() { velocity } else { shape };
            model.encode(&unit, &mut image);
            unit[coordinate] = 0.0;
            for (variance, x) in variances.iter_mut().zip(&image) {
                *variance += x * x;
            }
        }
        for (variance, own) in variances.iter_mut().zip(model.noise().amplitudes) {
            *variance += own * own;
        }
        Self { amplitudes: variances.into_iter().map(f64::sqrt).collect(), rates, step }
    }

    /// A step that resolves a flow with these linear rates whose slow motion has the time scale `slow` (model time):
    ///
    /// `h = 2^floor(log2 min(slow/100, 0.1/rho))`,   `rho = min(max_i |lambda_i|, 20 max(max_i lambda_i, 5/slow))`.
    ///
    /// Growth is always resolved, decay up to twenty times faster than that; faster decay is left to the exact
    /// linear part. A power of 2, so that times carry no rounding.
    pub fn step_for(rates: &[f64], slow: f64) -> f64 {
        let fastest = rates.iter().fold(0.0, |fastest: f64, rate| fastest.max(rate.abs()));
        let growth = rates.iter().fold(5.0 / slow, |growth, &rate| growth.max(rate));
        let longest = (0.01 * slow).min(0.1 / fastest.min(20.0 * growth));
        libm::exp2(libm::log2(longest).floor())
    }

    pub(crate) fn validate(&self, dim: usize) -> Result<(), Error> {
        let check = |name, value: f64, ok: bool, range| {
            if ok && value.is_finite() { Ok(()) } else { Err(Error::OutOfRange { name, value, range }) }
        };
        for &amplitude in &self.amplitudes {
            check("noise amplitude", amplitude, amplitude >= 0.0, "of at least 0")?;
        }
        for &rate in &self.rates {
            check("rate under noise", rate, true, "that is finite")?;
        }
        check("step of the noise", self.step, self.step > 0.0, "above 0")?;
        let entries = self.amplitudes.len();
        if entries > dim {
            return Err(Error::Shape { what: "the part under noise", expected: dim, got: entries });
        }
        if self.rates.len() != entries {
            let got = self.rates.len();
            return Err(Error::Shape { what: "the rates under noise", expected: entries, got });
        }
        Ok(())
    }
}
