//! Classification of the present motion and computation of its Lyapunov exponents, as long as it is the present one.

use crate::answers::{Answers, Gone};
use crate::map::numbers;
use crate::protocol::{Exponent, Exponents, MotionNamed, NamingBegun};
use crate::worker::{Current, Worker, lock};
use motiform_analysis::Estimate;
use motiform_analysis::regime::Regime;
use motiform_dynamics::Watch;
use motiform_lab::analyse;
use motiform_lab::scan::Row;
use motiform_study::Plan;
use std::sync::{Arc, Mutex};

/// Pictures go first.
const NICE: i32 = 3;

/// Exponents that are followed.
const COUNT: usize = 3;

/// They are averaged over this many looks of the model after some initial ones, and reported at this many times.
const LOOKS: (f64, f64) = (2.0, 40.0);
const POINTS: f64 = 200.0;

/// A motion: the plan whose start is the state of the body, without noise.
pub(crate) struct Motion {
    pub(crate) revision: u32,
    pub(crate) plan: Plan,
    /// Classified before, but the body has moved on since: repeat the classification.
    pub(crate) again: bool,
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
    worker: Worker<Motion>,
    known: Arc<Mutex<Known>>,
}

impl Naming {
    pub(crate) fn new(answers: Answers) -> std::io::Result<Self> {
        let known = Arc::new(Mutex::new(Known::default()));
        let shared = Arc::clone(&known);
        let worker = Worker::new("naming", NICE, move |motion: Motion, current| {
            // A page that has gone takes its session along.
            let _ = Work { motion: &motion, current, answers: &answers, known: &shared }.run();
        })?;
        Ok(Self { worker, known })
    }

    /// Classifies this motion, replacing an earlier one.
    pub(crate) fn name(&self, motion: Motion) {
        self.worker.put(motion);
    }

    /// Stops: the body has changed.
    pub(crate) fn stop(&self) {
        self.worker.clear();
        *lock(&self.known) = Known::default();
    }

    /// The model time used to classify the motion of this revision, if it is classified and has its exponents.
    pub(crate) fn took(&self, revision: u32) -> Option<f64> {
        let known = lock(&self.known);
        known.name.filter(|name| known.complete && name.0 == revision).map(|name| name.2)
    }

    /// The exponents of the present motion so far.
    pub(crate) fn history(&self) -> History {
        lock(&self.known).history.clone()
    }
}

/// One motion to be classified.
struct Work<'w> {
    motion: &'w Motion,
    current: &'w Current<'w>,
    answers: &'w Answers,
    known: &'w Mutex<Known>,
}

impl Work<'_> {
    fn run(&self) -> Result<(), Gone> {
        let before = lock(self.known).name.map(|known| known.1);
        lock(self.known).complete = false;
        let Some(regime) = self.name()? else { return Ok(()) };
        // A name that has not changed has the same exponents.
        if !(self.motion.again && before == Some(regime)) {
            self.follow()?;
        }
        lock(self.known).complete = !self.current.stopped();
        Ok(())
    }

    /// Classifies the motion; `None` if the result is no longer needed.
    fn name(&self) -> Result<Option<Regime>, Gone> {
        let revision = self.motion.revision;
        if !self.motion.again {
            self.answers.say(NamingBegun { revision })?;
        }
        let verdict = analyse::classify(&self.motion.plan, 0.0, self.current);
        let Some(row) = Row::of_evaluation(0, 0, verdict).filter(|_| !self.current.stopped()) else {
            return Ok(None);
        };
        lock(self.known).name = Some((revision, row.regime, row.number("time").unwrap_or(0.0)));
        let numbers = numbers(&row);
        self.answers.say(MotionNamed { revision, regime: row.regime.name(), why: row.why, numbers })?;
        Ok(Some(row.regime))
    }

    /// Follows the exponents until their average is complete.
    fn follow(&self) -> Result<(), Gone> {
        let Ok(info) = self.motion.plan.info() else { return Ok(()) };
        let count = COUNT.min(self.motion.plan.computation.initial.0.len() - 2);
        let span = LOOKS.1 * info.look;
        lock(self.known).history.clear();
        let (mut next, mut gone) = (0.0, Ok(()));
        let mut tell = |time: f64, exponents: Vec<Estimate>, done: bool| {
            if !self.current.stopped() && gone.is_ok() {
                gone = self.answers.say(message(self.motion.revision, time, &exponents, done));
                lock(self.known).history.push((time, exponents));
            }
        };
        // One behind: the last point is that of the whole average.
        let mut last = None;
        let times = (Some(LOOKS.0 * info.look), Some(span));
        let result =
            analyse::lyapunov_followed(&self.motion.plan, count, times, self.current, &mut |so_far| {
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

fn message(revision: u32, time: f64, exponents: &[Estimate], done: bool) -> Exponents {
    // An error that is not known yet is not a number: null.
    let known =
        |e: &Estimate| Exponent { value: e.value, error: Some(e.error).filter(|error| error.is_finite()) };
    Exponents { revision, time, exponents: exponents.iter().map(known).collect(), done }
}
