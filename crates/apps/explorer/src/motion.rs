//! Classification of the present motion and computation of its Lyapunov exponents, as long as it is the present one.

use crate::answers::{Answers, Gone, text};
use crate::map::numbers;
use crate::protocol::{Exponent, Exponents, MotionNamed, NamingBegun, Said};
use crate::task::{Crew, Task, Tell, Worker, lock};
use motiform_analysis::Estimate;
use motiform_analysis::regime::Regime;
use motiform_dynamics::Watch;
use motiform_lab::analyse::{self, Spans};
use motiform_lab::scan::Row;
use motiform_study::Plan;
use serde::{Deserialize, Serialize};
use std::sync::{Arc, Mutex};

/// Exponents that are followed.
const COUNT: usize = 3;

/// They are averaged over this many looks of the model ([`motiform_models::ModelInfo::look_at`]) after some
/// initial ones, and reported at this many times.
const LOOKS: (f64, f64) = (2.0, 40.0);
const POINTS: f64 = 200.0;

/// The subject of the evidence of a noisy body.
pub(crate) const WITHOUT_NOISE: &str = "the equations without noise";

/// A motion to be classified: the plan whose start is the state of the body, without noise.
#[derive(Serialize, Deserialize)]
pub(crate) struct Motion {
    pub(crate) revision: u32,
    pub(crate) plan: Plan,
    /// The body has noise: its name is that of the equations without it.
    pub(crate) noisy: bool,
    /// Classified before, but the body has moved on since: repeat the classification.
    pub(crate) again: bool,
    /// Its name as known before: the worker adds it.
    pub(crate) before: Option<Regime>,
}

/// The exponents so far, by averaging time.
pub(crate) type History = Vec<(f64, Vec<Estimate>)>;

/// The results on the present motion.
#[derive(Default)]
struct Known {
    /// Its revision, its name, and the model time that it took to find that.
    name: Option<(u32, Regime, f64)>,
    history: History,
    /// No further results will follow.
    complete: bool,
}

/// The worker that classifies motions.
pub(crate) struct Naming {
    pub(crate) worker: Worker<Classification>,
    heard: Arc<Heard>,
}

/// The results known so far, and the page that receives them.
struct Heard {
    known: Mutex<Known>,
    answers: Answers,
}

impl Naming {
    pub(crate) fn new(answers: Answers, crew: &Crew) -> std::io::Result<Self> {
        let heard = Arc::new(Heard { known: Mutex::default(), answers });
        let shared = Arc::clone(&heard);
        let worker = Worker::new(crew, move |found, _: &dyn Watch| shared.take(found))?;
        Ok(Self { worker, heard })
    }

    /// Classifies this motion, replacing an earlier one.
    pub(crate) fn name(&self, motion: Motion) {
        let mut known = lock(&self.heard.known);
        known.complete = false;
        let before = known.name.map(|name| name.1).filter(|_| motion.again);
        drop(known);
        self.worker.put(Motion { before, ..motion });
    }

    /// Stops: the body has changed.
    pub(crate) fn stop(&self) {
        self.worker.clear();
        *lock(&self.heard.known) = Known::default();
    }

    /// The model time used to classify the motion of this revision, if it is classified and has its exponents.
    pub(crate) fn took(&self, revision: u32) -> Option<f64> {
        let known = lock(&self.heard.known);
        known.name.filter(|name| known.complete && name.0 == revision).map(|name| name.2)
    }

    /// The exponents of the present motion so far.
    pub(crate) fn history(&self) -> History {
        lock(&self.heard.known).history.clone()
    }
}

impl Heard {
    fn take(&self, found: Found) -> Result<(), Gone> {
        let mut known = lock(&self.known);
        match found {
            Found::Begun { .. } => {}
            Found::Named { revision, regime, time, .. } => known.name = Some((revision, regime, time)),
            Found::Followed => known.history.clear(),
            Found::Exponents { time, ref exponents, .. } => known.history.push((time, exponents.clone())),
            Found::Complete => known.complete = true,
        }
        drop(known);
        found.text().map_or(Ok(()), |text| self.answers.text(text))
    }
}

/// The results about a motion, in this order.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Found {
    /// It is being classified.
    Begun { text: String },
    /// Its name, and the model time that it took to find that.
    Named { revision: u32, regime: Regime, time: f64, text: String },
    /// Its exponents begin.
    Followed,
    /// The exponents up to a time.
    Exponents { time: f64, exponents: Vec<Estimate>, text: String },
    /// No further results will follow.
    Complete,
}

impl Found {
    /// The message to the page.
    fn text(self) -> Option<String> {
        match self {
            Self::Begun { text } | Self::Named { text, .. } | Self::Exponents { text, .. } => Some(text),
            Self::Followed | Self::Complete => None,
        }
    }
}

/// Classifies motions.
pub(crate) struct Classification;

impl Task for Classification {
    type Job = Motion;
    type Report = Found;

    const NAME: &'static str = "naming";
    /// Pictures go first.
    const NICE: i32 = 3;

    fn run(job: Motion, watch: &dyn Watch, tell: Tell<'_, Found>) -> Result<(), Gone> {
        NamingJob { job: &job, watch, tell }.run()
    }
}

/// One motion to be classified.
struct NamingJob<'w> {
    job: &'w Motion,
    watch: &'w dyn Watch,
    tell: Tell<'w, Found>,
}

impl NamingJob<'_> {
    fn run(&self) -> Result<(), Gone> {
        let Some(regime) = self.name()? else { return Ok(()) };
        // A name that has not changed has the same exponents.
        if !(self.job.again && self.job.before == Some(regime)) {
            self.follow()?;
        }
        if self.watch.stopped() { Ok(()) } else { (self.tell)(Found::Complete) }
    }

    /// Classifies the motion; `None` if the result is no longer needed.
    fn name(&self) -> Result<Option<Regime>, Gone> {
        let revision = self.job.revision;
        if !self.job.again {
            (self.tell)(Found::Begun { text: said(NamingBegun { revision }) })?;
        }
        let verdict = analyse::classify(&self.job.plan, 0.0, self.watch);
        let Some(row) = Row::of_evaluation(0, 0, verdict).filter(|_| !self.watch.stopped()) else {
            return Ok(None);
        };
        let (regime, numbers) = (row.regime, numbers(&row));
        let time = row.number("time").unwrap_or(0.0);
        let why = if self.job.noisy { format!("{WITHOUT_NOISE}: {}", row.why) } else { row.why };
        let text = said(MotionNamed { revision, regime: regime.name(), why, numbers });
        (self.tell)(Found::Named { revision, regime, time, text })?;
        Ok(Some(regime))
    }

    /// Follows the exponents until their average is complete.
    fn follow(&self) -> Result<(), Gone> {
        let Ok(look) = self.job.plan.look() else { return Ok(()) };
        let count = COUNT.min(self.job.plan.computation.initial.0.len() - 2);
        let span = LOOKS.1 * look;
        (self.tell)(Found::Followed)?;
        let (mut next, mut gone) = (0.0, Ok(()));
        let mut tell = |time: f64, exponents: Vec<Estimate>, done: bool| {
            if !self.watch.stopped() && gone.is_ok() {
                let text = said(message(self.job.revision, time, &exponents, done));
                gone = (self.tell)(Found::Exponents { time, exponents, text });
            }
        };
        // One behind: the last point is that of the whole average.
        let mut last = None;
        let times = Spans { transient: Some(LOOKS.0 * look), t_end: Some(span) };
        let result = analyse::lyapunov_followed(&self.job.plan, count, times, self.watch, &mut |so_far| {
            if so_far.time() < next {
                return;
            }
            if let Some(exponents) = so_far.exponents() {
                next = so_far.time() + span / POINTS;
                if let Some((time, exponents)) = last.replace((so_far.time(), exponents)) {
                    tell(time, exponents, false);
                }
            }
        });
        // A motion that escapes has no exponents; what the numerics refuse was said by the name.
        match result {
            Ok(result) if !result.exponents.is_empty() => tell(result.time, result.exponents, true),
            _ => {}
        }
        gone
    }
}

fn said(message: impl Into<Said>) -> String {
    text(&message.into())
}

fn message(revision: u32, time: f64, exponents: &[Estimate], done: bool) -> Exponents {
    // An error that is not known yet is not a number: null.
    let known =
        |e: &Estimate| Exponent { value: e.value, error: Some(e.error).filter(|error| error.is_finite()) };
    Exponents { revision, time, exponents: exponents.iter().map(known).collect(), done }
}
