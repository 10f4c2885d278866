//! The decision: one question after the other, from the cheapest and surest evidence to the dearest.
//!
//! 1. Did the orbit leave every bound?                         blow-up
//! 2. Does it approach a stable relative equilibrium?           motionless, straight, circular
//! 3. Does it rest near saddles that attract as a cycle?        rectangular
//! 4. Does its shape come back, stably?                         zigzag, quasi-periodic
//! 5. Do neighbours part exponentially?                         chaotic
//! 6. Do its returns lie on a curve, without chaos?             quasi-periodic (a torus of shapes)
//!
//! If nothing is decided the next look is twice as long, until the budget is spent.

use super::heteroclinic::cycle;
use super::look::{Look, RESTS, Rest};
use super::recurrence::periodic;
use super::settings::{Settings, ended};
use super::verdict::{Attractor, Regime, Verdict};
use super::{chaos, words};
use crate::equilibrium::RelativeEquilibrium;
use crate::linear::norm;
use crate::{Estimate, Result};
use motiform_dynamics::{Equivariant, Integration, Outcome, Sink};

/// Classifies the motion that starts from `start`; `None` if `stop` broke off.
///
/// The evidence and its numbers are in the verdict. Thresholds: an equilibrium counts as reached at 1e-3 of the shape's
/// size if it is stable by its eigenvalues and the orbit comes closer at the rate they say; a shape comes back if Newton's
/// method finds a stable orbit within 3 % of the motion's diameter; chaos needs lambda_1 above twice its 95 % error and
/// growth by more than e^10, in two consecutive looks, and no veto of the 0-1 test (K < 0.3).
///
/// # Errors
/// What the numerics refuse (a start of the wrong length, say). Everything that happens to the orbit is a verdict.
///
/// # Checked by  tests/regimes.rs (tensor: the analytic lines; cell: the known windows), tests/zoo.rs (known answers)
pub fn classify<B: Equivariant + ?Sized>(
    body: &B,
    start: &[f64],
    settings: &Settings,
    stop: &mut dyn Sink,
) -> Result<Option<Verdict>> {
    let mut search = Search {
        body,
        settings,
        stop,
        time: 0.0,
        fastest: 0.0,
        largest: norm(start),
        rests: Vec::new(),
        parted: Vec::new(),
        missing: "no motion had established itself".to_owned(),
    };
    let mut orbit = settings.method.shape_orbit(body, settings.control, 0.0, start)?;
    let mut span = settings.first_look.min(settings.budget);
    let mut first = true;
    while search.time < settings.budget {
        match search.look(orbit.as_mut(), span, first)? {
            Step::Decided(verdict) => return Ok(Some(*verdict)),
            Step::Interrupted => return Ok(None),
            Step::Open => {}
        }
        first = false;
        span = (2.0 * span).min((settings.budget - search.time).max(settings.first_look));
    }
    let why = format!("{} within the budget of {:.0}", search.missing, settings.budget);
    let mut verdict = Verdict::new(Regime::Undetermined, Attractor::Unknown, why, search.time);
    words::along(&mut verdict, body, orbit.state(), span.min(settings.first_look), settings)?;
    Ok(Some(verdict))
}

/// What a look led to.
enum Step {
    Decided(Box<Verdict>),
    Open,
    Interrupted,
}

impl From<Verdict> for Step {
    fn from(verdict: Verdict) -> Self {
        Self::Decided(Box::new(verdict))
    }
}

struct Search<'s, B: ?Sized> {
    body: &'s B,
    settings: &'s Settings,
    stop: &'s mut dyn Sink,
    /// Model time spent.
    time: f64,
    /// Fastest change of the reduced shape so far.
    fastest: f64,
    /// Largest `|u|` so far: what distances are small against, for a circle has no size of its own.
    largest: f64,
    /// Complete rests of all looks.
    rests: Vec<Rest>,
    /// The exponents of the last looks, as far back as neighbours parted in them.
    parted: Vec<Estimate>,
    /// What kept the last look from deciding.
    missing: String,
}

impl<B: Equivariant + ?Sized> Search<'_, B> {
    /// One look at the orbit, and the questions in their order.
    fn look(&mut self, orbit: &mut dyn Integration, span: f64, first: bool) -> Result<Step> {
        let request = self.settings.request(orbit.t() + span, self.body.dim());
        let mut look = Look::take(self.body, orbit, span, &request, self.stop)?;
        if let Some(outcome) = ended(&look.outcome) {
            return Ok(self.ended(&outcome, look.start));
        }
        self.time += look.end - look.start;
        if let Some(step) = self.equilibrium(orbit, &look)? {
            return Ok(step);
        }
        self.rests.append(&mut look.rests);
        if let Some(cycle) = cycle(self.body, &self.rests, self.settings) {
            return Ok(words::rectangular(self.body, &cycle, orbit.state(), self.settings, self.time)?.into());
        }
        if let Some((found, recurrence)) = periodic(self.body, &look, self.settings) {
            return Ok(words::periodic(self.body, &found, &recurrence, self.settings, self.time)?.into());
        }
        if first {
            return Ok(Step::Open);
        }
        self.exponent(orbit, &look, span)
    }

    /// The verdict, or the interruption, that a run ended with; the run's own clock showed `start` at its start.
    fn ended(&mut self, outcome: &Outcome, start: f64) -> Step {
        let before = self.time;
        match *outcome {
            Outcome::Interrupted { .. } => Step::Interrupted,
            Outcome::Escaped { t, singular, t_last, .. } => {
                words::blow_up(singular, before + t - start, before + t_last - start).into()
            }
            _ => {
                let why = format!("the run ended early: {outcome}");
                let time = before + outcome.t() - start;
                Verdict::new(Regime::Undetermined, Attractor::Unknown, why, time).into()
            }
        }
    }

    /// Is the orbit about to reach a stable relative equilibrium?
    fn equilibrium(&mut self, orbit: &mut dyn Integration, look: &Look) -> Result<Option<Step>> {
        self.fastest = self.fastest.max(look.fastest);
        self.largest = self.largest.max(look.sizes.1);
        if look.last_speed > 0.05 * self.fastest {
            return Ok(None);
        }
        let Some(found) = RelativeEquilibrium::find(self.body, orbit.state()) else {
            "no equilibrium was found where the orbit rests".clone_into(&mut self.missing);
            return Ok(None);
        };
        let size = norm(&found.shape).max(self.largest);
        let before = found.distance(self.body, orbit.state());
        if found.growth() > -found.resolution() {
            self.missing =
                format!("the orbit rests at an unstable shape (growth rate {:.2e})", found.growth());
            return Ok(None);
        }
        if before > CLOSE * size {
            self.missing = "the orbit was still on its way to an equilibrium".to_owned();
            return Ok(None);
        }
        let mut after = before;
        let reached = (self.settings.hovering() * size).max(100.0 * self.settings.atol());
        if before > reached {
            let wait = (-1.0 / found.growth()).min(self.settings.budget);
            let request = self.settings.request(orbit.t() + wait, self.body.dim());
            let look = Look::take(self.body, orbit, wait, &request, self.stop)?;
            if let Some(outcome) = ended(&look.outcome) {
                return Ok(Some(self.ended(&outcome, look.start)));
            }
            self.time += look.end - look.start;
            after = found.distance(self.body, orbit.state());
        }
        if after > reached && after > 0.7 * before {
            self.missing = "the orbit did not come closer to the equilibrium beside it".to_owned();
            return Ok(None);
        }
        Ok(Some(words::equilibrium(self.body, &found, after / size, self.settings, self.time).into()))
    }

    /// Do neighbours part? Runs the tangent flow on, as long again as the look.
    fn exponent(&mut self, orbit: &mut dyn Integration, look: &Look, span: f64) -> Result<Step> {
        let run = chaos::exponent(self.body, orbit.state(), span, self.settings, self.stop)?;
        if let Some(outcome) = ended(&run.outcome) {
            return Ok(self.ended(&outcome, 0.0));
        }
        self.time += run.time + run.transient;
        orbit.restart(&run.shape);
        let Some(run) = run.awake(RESTS) else {
            // At a saddle neighbours part at its own rate: that is no chaos, however long it lasts.
            "the orbit rested at a saddle while the exponent was measured".clone_into(&mut self.missing);
            return Ok(Step::Open);
        };
        let witness = chaos::Witness::of(look);
        match chaos::parts(&run) {
            Some(exponent) => self.parted.push(exponent),
            None => self.parted.clear(),
        }
        if let Some(verdict) = chaos::chaotic(&self.parted, &run, &witness, self.time) {
            return Ok(self.described(verdict, orbit, look)?.into());
        }
        if let Some(verdict) = chaos::torus(&run, &witness, self.time) {
            return Ok(self.described(verdict, orbit, look)?.into());
        }
        self.missing = chaos::missing(&run, &witness);
        Ok(Step::Open)
    }

    fn described(&self, mut verdict: Verdict, orbit: &dyn Integration, look: &Look) -> Result<Verdict> {
        let span = (look.end - look.start).min(self.settings.first_look);
        words::along(&mut verdict, self.body, orbit.state(), span, self.settings)?;
        Ok(verdict)
    }
}

/// An equilibrium this near (against the size of the shape) may be where the orbit goes.
const CLOSE: f64 = 1e-3;
