//! The noise of one orbit, step by step: drawn, added to states of the flow, and removed from them.

use crate::Error;
use crate::noise::{Diffusion, Noise, Normal};

/// The noise of one entry over one step.
#[derive(Clone, Copy, Debug)]
struct Kick {
    eta: f64,
    rate: f64,
    /// Standard deviations of K (and K'), and of `e^{lambda h} K + K'`; the variance of the noise over a step by the latter.
    kick: f64,
    whole: f64,
    past: f64,
    /// `e^{lambda h}`.
    growth: f64,
    /// The present K, the present X(h), and the deviate of the bridge.
    early: f64,
    total: f64,
    bridge: f64,
}

/// `V(t)`.
fn variance(eta: f64, rate: f64, t: f64) -> f64 {
    let x = 2.0 * rate * t;
    eta * eta * t * if x == 0.0 { 1.0 } else { libm::expm1(x) / x }
}

impl Kick {
    fn new(eta: f64, rate: f64, h: f64) -> Self {
        let growth = libm::exp(rate * h);
        let kick = if rate == 0.0 { 0.5 * h } else { 0.5 * libm::tanh(rate * h) / rate };
        let variance = variance(eta, rate, h);
        let (kick, whole) = (eta * kick.sqrt(), variance.sqrt());
        let past = if whole > 0.0 { variance / whole } else { 0.0 };
        Self { eta, rate, kick, whole, past, growth, early: 0.0, total: 0.0, bridge: 0.0 }
    }

    /// The kicks of a new step.
    fn draw(&mut self, normal: &mut Normal) {
        let (first, second) = (self.kick * normal.next(), self.kick * normal.next());
        self.early = first;
        self.total = self.growth * first + second;
        self.bridge = if self.whole > 0.0 { (first - self.growth * second) / self.whole } else { 0.0 };
    }

    /// `X(t) - e^{lambda t} K` at the time t in a step of length h.
    fn beside_the_flow(&self, t: f64, h: f64) -> f64 {
        if self.whole == 0.0 {
            return 0.0;
        }
        if t == h {
            // what follows, without its exponentials: nothing of the bridge is left
            return self.past * (self.total / self.whole) - self.growth * self.early;
        }
        let (past, rest) = (variance(self.eta, self.rate, t), variance(self.eta, self.rate, h - t));
        let mean = libm::exp(self.rate * (h - t)) * past / self.whole * (self.total / self.whole);
        let spread = past.sqrt() * (rest.sqrt() / self.whole);
        mean + spread * self.bridge - libm::exp(self.rate * t) * self.early
    }
}

/// The noise of one orbit, as [`crate::NoisyOrbit`] describes it: the steps of the noise, and the present
/// one's kicks. It knows no integration, so orbits alone and in lanes have the same bits.
pub struct NoiseSteps {
    step: f64,
    kicks: Vec<Kick>,
    /// Noise that depends on the state, and the increments of its processes.
    diffusion: Option<(Box<dyn Diffusion>, Vec<Kick>)>,
    normal: Normal,
    start: f64,
    /// Steps of the noise started so far.
    steps: u64,
}

impl NoiseSteps {
    /// The noise of an orbit that starts at time `t` with `dim` entries, drawn from `normal`.
    ///
    /// # Errors
    /// As [`crate::NoisyOrbit::new`].
    pub fn new(noise: &Noise, normal: Normal, t: f64, dim: usize) -> Result<Self, Error> {
        noise.validate(dim)?;
        let entries = noise.amplitudes.iter().zip(&noise.rates);
        let kicks = entries.map(|(&eta, &rate)| Kick::new(eta, rate, noise.step)).collect();
        Ok(Self { step: noise.step, kicks, diffusion: None, normal, start: t, steps: 0 })
    }

    /// The same with noise that depends on the state; before the first step.
    #[must_use]
    pub fn with(mut self, diffusion: Box<dyn Diffusion>) -> Self {
        let increments = vec![Kick::new(1.0, 0.0, self.step); diffusion.processes()];
        self.diffusion = Some((diffusion, increments));
        self
    }

    /// End of the present step; the start, before the first one. From the number of steps, so that it carries no accumulated rounding.
    pub fn end(&self) -> f64 {
        self.start + self.step * self.steps as f64
    }

    /// Begins the next step at a state of the path, which becomes that of the flow.
    pub fn begin(&mut self, u: &mut [f64]) {
        for (kick, x) in self.kicks.iter_mut().zip(&mut *u) {
            kick.draw(&mut self.normal);
            *x += kick.early;
        }
        if let Some((diffusion, increments)) = &mut self.diffusion {
            for (process, increment) in increments.iter_mut().enumerate() {
                increment.draw(&mut self.normal);
                diffusion.kick(process, increment.early, u);
            }
        }
        self.steps += 1;
    }

    /// The time `t` within the present step of length h.
    fn within(&self, t: f64) -> f64 {
        let (h, end) = (self.step, self.end());
        if t == end { h } else { h - (end - t) }
    }

    /// Turns a state of the flow at time `t` in the present step into that of the path.
    pub fn add(&self, t: f64, u: &mut [f64]) {
        if self.steps == 0 {
            return;
        }
        let (h, t) = (self.step, self.within(t));
        if let Some((diffusion, increments)) = &self.diffusion {
            for (process, increment) in increments.iter().enumerate().rev() {
                diffusion.kick(process, increment.beside_the_flow(t, h), u);
            }
        }
        for (kick, x) in self.kicks.iter().zip(u) {
            *x += kick.beside_the_flow(t, h);
        }
    }

    /// The inverse of [`NoiseSteps::add`].
    pub fn remove(&self, t: f64, u: &mut [f64]) {
        if self.steps == 0 {
            return;
        }
        let (h, t) = (self.step, self.within(t));
        for (kick, x) in self.kicks.iter().zip(&mut *u) {
            *x -= kick.beside_the_flow(t, h);
        }
        if let Some((diffusion, increments)) = &self.diffusion {
            for (process, increment) in increments.iter().enumerate() {
                diffusion.kick(process, -increment.beside_the_flow(t, h), u);
            }
        }
    }
}
