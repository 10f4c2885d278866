//! Orbits under noise.

use crate::interpolant::DenseStep;
use crate::noise::{Diffusion, Noise, Normal};
use crate::noise_steps::NoiseSteps;
use crate::orbit::{Counters, StepFailure};
use crate::{Error, Integration};

/// A sample path of `du_i = f_i(u) dt + eta_i dW_i`, on top of any integration of `u' = f(u)`.
///
/// One step of length h from `u_n`: a kick, the flow as accurate as the integration, a kick:
///
/// `u_{n+1} = flow_h(u_n + K) + K'`,   `Var K_i = Var K'_i = eta_i^2 tanh(lambda_i h)/(2 lambda_i)`.
///
/// If the flow is linear with the rate `lambda_i` of that entry, both together give the variance `V_i(h)`, with
/// `V_i(t) = eta_i^2 (e^{2 lambda_i t} - 1)/(2 lambda_i)`: the exact law at any step, however stiff. Any other flow has weak
/// order 2 in h.
///
/// Inside a step the path is `flow_t(u_n + K) + X(t) - e^{lambda t} K`: X is the noise of the linear part alone, 0 at the
/// start and `e^{lambda h} K + K'` at the end, and in between has the law of its bridge at every single time (the deviate
/// that it needs is the combination of those of K and K' that its end does not use). Rows may therefore lie at any time: they do not
/// change the path, no slope of a kicked state enters them, and a linear flow has its exact law there, too.
///
/// Noise whose strength depends on the state ([`NoisyOrbit::with`]) is treated alike: a step of length h is
/// `e^{K_1 g_1} .. e^{K_m g_m}`, the flow, `e^{K'_m g_m} .. e^{K'_1 g_1}`, where `e^{w g}` moves a state along `g` by w and all K have the
/// variance h/2. As `E e^{K g} = e^{(h/4) g^2}`, this is the symmetric product of the parts of the generator:
/// weak order 2, also for processes that do not commute. The strong order is 1 if they commute, otherwise
/// 1/2. Inside a step the last part is done with the rest of the bridge.
///
/// It is an [`Integration`] again, so sections, escape bounds and samples work as for any orbit. A kick through a section is a
/// crossing at the time of the kick.
///
/// Source: Strang (1968), SIAM J. Numer. Anal. 5, 506; for noise along fields Ninomiya and Victoir (2008),
/// Appl. Math. Finance 15, 107; for the exact linear part Lord and Rougemont (2004), IMA J. Numer. Anal. 24,
/// 587; for the bridge of an Ornstein-Uhlenbeck process Gillespie (1996), Phys. Rev. E 54, 2084.
///
/// # Errors    [`Error::OutOfRange`] and [`Error::Shape`] from [`NoisyOrbit::new`]
/// # Not       for stiff entries whose square matters: the effect of an entry with `|lambda| h` far above 1 on the others within a step is
/// averaged too coarsely: its own law is correct, its square in their rates is not
/// # Checked by  tests/all/noise.rs: Brownian motion, Ornstein-Uhlenbeck (stiff entries, rows anywhere), weak order on a linear
/// and a nonlinear flow, rotation, seeds; tests/all/diffusion.rs: weak and strong order; lab/lab/tests/all/noise.rs: both models
pub struct NoisyOrbit<O> {
    orbit: O,
    noise: NoiseSteps,
    state: Vec<f64>,
    kicked: Vec<f64>,
}

impl<O: Integration> NoisyOrbit<O> {
    /// `orbit`, from its present time and state on, with noise drawn from `normal`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an invalid amplitude, rate or step, [`Error::Shape`] for more entries under
    /// noise than the state has, or rates of another number.
    #[allow(
        clippy::needless_pass_by_value,
        reason = "the noise belongs to this orbit, as its generator does"
    )]
    pub fn new(orbit: O, noise: Noise, normal: Normal) -> Result<Self, Error> {
        let noise = NoiseSteps::new(&noise, normal, orbit.t(), orbit.state().len())?;
        Ok(Self::of(orbit, noise))
    }

    /// `orbit` with this noise, which starts where it is.
    pub fn of(mut orbit: O, noise: NoiseSteps) -> Self {
        let (state, kicked) = (orbit.state().to_vec(), orbit.state().to_vec());
        orbit.roughen();
        Self { orbit, noise, state, kicked }
    }

    /// The same with noise that depends on the state; before the first step.
    #[must_use]
    pub fn with(mut self, diffusion: Box<dyn Diffusion>) -> Self {
        self.noise = self.noise.with(diffusion);
        self
    }

    fn follow(&mut self) {
        self.state.copy_from_slice(self.orbit.state());
        self.noise.add(self.orbit.t(), &mut self.state);
    }
}

impl<O: Integration> Integration for NoisyOrbit<O> {
    fn advance(&mut self, limit: f64) -> Result<(), StepFailure> {
        if self.orbit.t() >= self.noise.end() {
            self.kicked.copy_from_slice(&self.state);
            self.noise.begin(&mut self.kicked);
            self.orbit.restart(&self.kicked);
        }
        self.orbit.advance(limit.min(self.noise.end()))?;
        self.follow();
        Ok(())
    }

    /// The flow between the kicks: sufficient to find crossings, which [`Integration::step_to`] places on the path.
    fn dense(&mut self) -> DenseStep<'_> {
        self.orbit.dense()
    }

    fn at(&mut self, t: f64, out: &mut [f64]) {
        if t == self.orbit.t() {
            out.copy_from_slice(&self.state);
        } else {
            self.step_to(t, out);
        }
    }

    fn step_to(&mut self, t: f64, out: &mut [f64]) {
        self.orbit.step_to(t, out);
        self.noise.add(t, out);
    }

    fn end_step_at(&mut self, t: f64) {
        self.orbit.end_step_at(t);
        self.follow();
    }

    fn restart(&mut self, u: &[f64]) {
        self.kicked.copy_from_slice(u);
        self.noise.remove(self.orbit.t(), &mut self.kicked);
        self.orbit.restart(&self.kicked);
        self.state.copy_from_slice(u);
    }

    fn t(&self) -> f64 {
        self.orbit.t()
    }

    fn t_old(&self) -> f64 {
        self.orbit.t_old()
    }

    fn state(&self) -> &[f64] {
        &self.state
    }

    /// Rates of the flow between the kicks.
    fn slope(&self) -> &[f64] {
        self.orbit.slope()
    }

    fn counters(&self) -> Counters {
        self.orbit.counters()
    }
}
