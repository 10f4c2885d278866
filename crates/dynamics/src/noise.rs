//! Noise: normal deviates with the same bits on every machine, and orbits that it kicks.

use crate::interpolant::DenseStep;
use crate::orbit::{Counters, StepFailure};
use crate::{Error, Integration};
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
/// # Checked by  tests/noise.rs: moments, tails, independence, bits
#[derive(Clone, Debug)]
pub struct Normal {
    bits: ChaCha8Rng,
    /// The second deviate of the last pair.
    spare: Option<f64>,
}

impl Normal {
    /// The deviates number 0, 1, 2, ... of this seed and stream.
    #[must_use]
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

    /// Uniform in [0, 1).
    fn uniform(&mut self) -> f64 {
        (self.bits.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Additive isotropic white noise: u' = f(t, u) + eta xi(t), <xi_i(t) xi_j(s)> = delta_ij delta(t - s).
///
/// Every one of the leading `entries` of the state gets independent noise of the same strength: the noise is isotropic
/// in the Euclidean norm of those entries, so that a symmetry which rotates pairs of them leaves its law unchanged. As
/// it does not depend on the state, the readings of Ito and Stratonovich are one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// eta, at least 0. Without the flow an entry's variance grows by eta^2 per model time.
    ///
    /// # Units   unit of the state / sqrt(model time)
    pub amplitude: f64,
    /// Model time between two kicks, above 0.
    pub every: f64,
    /// How many leading entries of the state are kicked (the shape; a position is not).
    pub entries: usize,
}

impl Noise {
    fn validate(&self, dim: usize) -> Result<(), Error> {
        let check = |name, value: f64, ok: bool, range| {
            if ok && value.is_finite() { Ok(()) } else { Err(Error::OutOfRange { name, value, range }) }
        };
        check("noise amplitude", self.amplitude, self.amplitude >= 0.0, "of at least 0")?;
        check("time between kicks", self.every, self.every > 0.0, "above 0")?;
        if self.entries > dim {
            return Err(Error::Shape { what: "the part under noise", expected: dim, got: self.entries });
        }
        Ok(())
    }
}

/// A stochastic orbit: any integration, kicked at even times.
///
/// Half a flow, a kick, half a flow (Strang splitting), with h = `every`:
///
/// u(t + h) = flow_{h/2}( flow_{h/2}(u(t)) + eta sqrt(h) xi ),   xi_i independent standard normal.
///
/// Kicks come at t0 + (n + 1/2) h. At t0 + n h, n = 0, 1, ..., the law of the state has weak order 2 in h, whatever
/// steps the integration takes in between: sample there. (At other times it is of order 1: up to half a kick of
/// variance more or less.) The flow itself is as accurate as the integration; a fixed step equal to `every` makes one
/// step per kick.
///
/// It is an [`Integration`] again, so sections, escape bounds and samples work as for any orbit: between kicks the path
/// is smooth; a kick is a jump at the start of a step, and a kick through a section is a crossing at the time of the kick.
/// A step that fails right after a kick leaves the kicked state.
///
/// Source: Strang (1968), SIAM J. Numer. Anal. 5, 506; for Langevin equations Leimkuhler and Matthews (2013), Appl.
/// Math. Res. eXpress 2013, 34.
///
/// # Errors    [`Error::OutOfRange`] and [`Error::Shape`] from [`NoisyOrbit::new`]
/// # Not       for multiplicative noise; not for noise far above the flow's own size per `every`
/// # Checked by  tests/noise.rs: Brownian motion, Ornstein-Uhlenbeck (variance, autocorrelation, the exact variance at
/// large h), the same with an exponential method, rotation, seeds
pub struct NoisyOrbit<O> {
    orbit: O,
    noise: Noise,
    normal: Normal,
    start: f64,
    kicks: u64,
    state: Vec<f64>,
}

impl<O: Integration> NoisyOrbit<O> {
    /// `orbit`, from its present time and state on, with noise drawn from `normal`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an amplitude or interval that makes no sense, [`Error::Shape`] for more entries under
    /// noise than the state has.
    pub fn new(orbit: O, noise: Noise, normal: Normal) -> Result<Self, Error> {
        noise.validate(orbit.state().len())?;
        let (start, state) = (orbit.t(), orbit.state().to_vec());
        Ok(Self { orbit, noise, normal, start, kicks: 0, state })
    }

    /// Time of the next kick: from the number of kicks, so that it carries no accumulated rounding.
    fn next_kick(&self) -> f64 {
        self.start + self.noise.every * (self.kicks as f64 + 0.5)
    }

    fn kick(&mut self) {
        self.state.copy_from_slice(self.orbit.state());
        let size = self.noise.amplitude * self.noise.every.sqrt();
        for x in &mut self.state[..self.noise.entries] {
            *x += size * self.normal.next();
        }
        self.orbit.restart(&self.state);
        self.kicks += 1;
    }
}

impl<O: Integration> Integration for NoisyOrbit<O> {
    fn advance(&mut self, limit: f64) -> Result<(), StepFailure> {
        if self.orbit.t() >= self.next_kick() {
            self.kick();
        }
        self.orbit.advance(limit.min(self.next_kick()))
    }

    fn dense(&mut self) -> DenseStep<'_> {
        self.orbit.dense()
    }

    fn step_to(&mut self, t: f64, out: &mut [f64]) {
        self.orbit.step_to(t, out);
    }

    fn end_step_at(&mut self, t: f64) {
        self.orbit.end_step_at(t);
    }

    fn restart(&mut self, u: &[f64]) {
        self.orbit.restart(u);
    }

    fn t(&self) -> f64 {
        self.orbit.t()
    }

    fn t_old(&self) -> f64 {
        self.orbit.t_old()
    }

    fn state(&self) -> &[f64] {
        self.orbit.state()
    }

    fn slope(&self) -> &[f64] {
        self.orbit.slope()
    }

    fn counters(&self) -> Counters {
        self.orbit.counters()
    }
}
