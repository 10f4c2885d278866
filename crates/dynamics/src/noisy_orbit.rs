//! Orbits under noise.

use crate::interpolant::DenseStep;
use crate::noise::{Diffusion, Noise, Normal};
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
/// variance h/2. As `E e^{K g} = e^{(h/4) g^2}`, this is the symmetric product of the parts of the generator: weak order 2, also for processes that do not
/// commute. The strong order is 1 if they commute, otherwise 1/2. Inside a step the last part is done with the rest of the bridge.
///
/// It is an [`Integration`] again, so sections, escape bounds and samples work as for any orbit. A kick through a section is a
/// crossing at the time of the kick.
///
/// Source: Strang (1968), SIAM J. Numer. Anal. 5, 506; for noise along fields Ninomiya and Victoir (2008), Appl. Math. Finance 15, 107; for the exact linear part Lord and Rougemont (2004), IMA J. Numer.
/// Anal. 24, 587; for the bridge of an Ornstein-Uhlenbeck process Gillespie (1996), Phys. Rev. E 54, 2084.
///
/// # Errors    [`Error::OutOfRange`] and [`Error::Shape`] from [`NoisyOrbit::new`]
/// # Not       for stiff entries whose square matters: the effect of an entry with `|lambda| h` far above 1 on the others within a step is
/// averaged too coarsely: its own law is correct, its square in their rates is not
/// # Checked by  tests/all/noise.rs: Brownian motion, Ornstein-Uhlenbeck (stiff entries, rows anywhere), weak order on a linear
/// and a nonlinear flow, rotation, seeds; tests/all/diffusion.rs: weak and strong order; lab/tests/all/noise.rs: both models
pub struct NoisyOrbit<O> {
    orbit: O,
    noise: Noise,
    kicks: Vec<Kick>,
    /// Noise that depends on the state, and the increments of its processes.
    diffusion: Option<(Box<dyn Diffusion>, Vec<Kick>)>,
    normal: Normal,
    start: f64,
    /// Steps of the noise started so far.
    steps: u64,
    state: Vec<f64>,
}

/// The noise of one entry over one step.
#[derive(Clone, Copy, Debug)]
struct Kick {
    eta: f64,
    rate: f64,
    /// Standard deviations of K (and K'), and of `e^{lambda h} K + K'`.
    kick: f64,
    whole: f64,
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
        let (kick, whole) = (eta * kick.sqrt(), variance(eta, rate, h).sqrt());
        Self { eta, rate, kick, whole, growth, early: 0.0, total: 0.0, bridge: 0.0 }
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
        let (past, rest) = (variance(self.eta, self.rate, t), variance(self.eta, self.rate, h - t));
        let mean = libm::exp(self.rate * (h - t)) * past / self.whole * (self.total / self.whole);
        let spread = past.sqrt() * (rest.sqrt() / self.whole);
        mean + spread * self.bridge - libm::exp(self.rate * t) * self.early
    }
}

impl<O: Integration> NoisyOrbit<O> {
    /// `orbit`, from its present time and state on, with noise drawn from `normal`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an invalid amplitude, rate or step, [`Error::Shape`] for more entries under
    /// noise than the state has, or rates of another number.
    pub fn new(mut orbit: O, noise: Noise, normal: Normal) -> Result<Self, Error> {
        noise.validate(orbit.state().len())?;
        let entries = noise.amplitudes.iter().zip(&noise.rates);
        let kicks = entries.map(|(&eta, &rate)| Kick::new(eta, rate, noise.step)).collect();
        let (start, state) = (orbit.t(), orbit.state().to_vec());
        orbit.roughen();
        Ok(Self { orbit, noise, kicks, diffusion: None, normal, start, steps: 0, state })
    }

    /// The same with noise that depends on the state; before the first step.
    #[must_use]
    pub fn with(mut self, diffusion: Box<dyn Diffusion>) -> Self {
        let increments = vec![Kick::new(1.0, 0.0, self.noise.step); diffusion.processes()];
        self.diffusion = Some((diffusion, increments));
        self
    }

    /// End of the present step: from the number of steps, so that it carries no accumulated rounding.
    fn end(&self) -> f64 {
        self.start + self.noise.step * self.steps as f64
    }

    fn begin_step(&mut self) {
        let mut kicked = self.state.clone();
        for (kick, x) in self.kicks.iter_mut().zip(&mut kicked) {
            kick.draw(&mut self.normal);
            *x += kick.early;
        }
        if let Some((diffusion, increments)) = &mut self.diffusion {
            for (process, increment) in increments.iter_mut().enumerate() {
                increment.draw(&mut self.normal);
                diffusion.kick(process, increment.early, &mut kicked);
            }
        }
        self.orbit.restart(&kicked);
        self.steps += 1;
    }

    /// Turns a state of the flow at time `t` in the present step into that of the path (`sign` = 1), or back (-1).
    fn add_noise(&self, t: f64, sign: f64, u: &mut [f64]) {
        if self.steps == 0 {
            return;
        }
        let (h, end) = (self.noise.step, self.end());
        let t = if t == end { h } else { h - (end - t) };
        if sign > 0.0 {
            self.diffuse(t, u);
        }
        for (kick, x) in self.kicks.iter().zip(&mut *u) {
            *x += sign * kick.beside_the_flow(t, h);
        }
        if sign < 0.0 {
            self.diffuse_back(t, u);
        }
    }

    /// The second part of the noise that depends on the state, at the time `t` in the present step.
    fn diffuse(&self, t: f64, u: &mut [f64]) {
        let Some((diffusion, increments)) = &self.diffusion else { return };
        for (process, increment) in increments.iter().enumerate().rev() {
            diffusion.kick(process, increment.beside_the_flow(t, self.noise.step), u);
        }
    }

    /// Its inverse.
    fn diffuse_back(&self, t: f64, u: &mut [f64]) {
        let Some((diffusion, increments)) = &self.diffusion else { return };
        for (process, increment) in increments.iter().enumerate() {
            diffusion.kick(process, -increment.beside_the_flow(t, self.noise.step), u);
        }
    }

    fn follow(&mut self) {
        let mut state = std::mem::take(&mut self.state);
        state.copy_from_slice(self.orbit.state());
        self.add_noise(self.orbit.t(), 1.0, &mut state);
        self.state = state;
    }
}

impl<O: Integration> Integration for NoisyOrbit<O> {
    fn advance(&mut self, limit: f64) -> Result<(), StepFailure> {
        if self.orbit.t() >= self.end() {
            self.begin_step();
        }
        self.orbit.advance(limit.min(self.end()))?;
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
        self.add_noise(t, 1.0, out);
    }

    fn end_step_at(&mut self, t: f64) {
        self.orbit.end_step_at(t);
        self.follow();
    }

    fn restart(&mut self, u: &[f64]) {
        let mut flow = u.to_vec();
        self.add_noise(self.orbit.t(), -1.0, &mut flow);
        self.orbit.restart(&flow);
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
