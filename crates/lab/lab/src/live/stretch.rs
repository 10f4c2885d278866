//! A stretch of motion: from one change to the next.

use super::Record;
use crate::clock::Moment;
use crate::simulate::noisy;
use motiform_dynamics::drive::Run;
use motiform_dynamics::{InPlane, Integration, Model, Outcome, Request, Sink};
use motiform_study::{Error, Plan};
use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::time::Duration;

/// A model time beyond any practical use.
const FOREVER: f64 = 1e15;

/// A body in motion with fixed parameters. It takes whole steps of its method, whatever time is requested, so the motion does not
/// depend on how often it is displayed; the displayed state lies inside the last step.
///
/// # Checked by  live/tests.rs: the samples of `simulate`, to the bit, however one looks
pub struct Stretch<'b> {
    orbit: Box<dyn Integration + 'b>,
    run: Run,
    request: Request<'static>,
    ahead: Ahead,
    outcome: Option<Outcome>,
    /// The displayed time, and the state `(shape, x, y)` at that time.
    shown: f64,
    state: Vec<f64>,
    /// The sample to be added to the record.
    sample: Vec<f64>,
}

/// Samples that are computed and not displayed yet: time and state, one after the other.
struct Ahead {
    width: usize,
    numbers: VecDeque<f64>,
}

impl Sink for Ahead {
    fn sample(&mut self, t: f64, u: &[f64]) {
        self.numbers.push_back(t);
        self.numbers.extend(u);
    }
}

impl<'b> Stretch<'b> {
    /// The motion of `body`, the plan's model, from `state` (shape, then x and y) at time `t` by the plan's method and noise,
    /// sampled every `dt_out` from `t` on. Stretches of one seed need different `number`s for independent noise.
    ///
    /// # Errors
    /// An unknown stepper; a state that is not a number, or of another length.
    pub fn new(
        plan: &Plan,
        body: &'b InPlane<&'b dyn Model>,
        t: f64,
        state: &[f64],
        number: u64,
    ) -> Result<Self, Error> {
        let c = &plan.computation;
        let orbit = plan.method()?.orbit(body, c.control.into(), t, state)?;
        let orbit = noisy(c, orbit, body.0, 2 + number)?; // 0 and 1 are those of a plan's own run
        let request = Request {
            sample_every: Some(c.dt_out),
            escape_norm: c.escape_norm,
            watched: body.0.dim(),
            ..Request::until(FOREVER, state.len())
        };
        let mut ahead = Ahead { width: 1 + state.len(), numbers: VecDeque::new() };
        let run = Run::new(orbit.as_ref(), &request, &mut ahead)?;
        Ok(Self {
            orbit,
            run,
            request,
            ahead,
            outcome: None,
            shown: t,
            state: state.to_vec(),
            sample: Vec::new(),
        })
    }

    /// Advances to time `to`, as far as `within` allows, and adds the samples up to there to `record`. Returns whether the time
    /// was reached, or the motion has ended ([`Stretch::outcome`]).
    pub fn advance(&mut self, to: f64, within: Duration, record: &mut Record, model: &dyn Model) -> bool {
        let begun = Moment::now();
        let mut in_time = true;
        while self.orbit.t() < to && self.outcome.is_none() && in_time {
            if let ControlFlow::Break(outcome) =
                self.run.step(self.orbit.as_mut(), &self.request, &mut self.ahead)
            {
                self.outcome = Some(outcome);
            }
            in_time = begun.elapsed() < within;
        }
        self.show(to.min(self.orbit.t()));
        while self.ahead.numbers.front().is_some_and(|&t| t <= self.shown) {
            self.sample.clear();
            self.sample.extend(self.ahead.numbers.drain(..self.ahead.width));
            record.push(model, &self.sample);
        }
        self.shown >= to || self.outcome.is_some()
    }

    fn show(&mut self, t: f64) {
        if t <= self.shown {
            return;
        }
        self.shown = t;
        if t < self.orbit.t() {
            self.orbit.at(t, &mut self.state);
        } else {
            self.state.copy_from_slice(self.orbit.state());
        }
    }

    /// The displayed time.
    pub fn t(&self) -> f64 {
        self.shown
    }

    /// The displayed state: the shape in the model's representation, then x and y.
    pub fn state(&self) -> &[f64] {
        &self.state
    }

    /// The end of the motion, if it has ended: it does not continue.
    pub fn outcome(&self) -> Option<Outcome> {
        self.outcome
    }
}
