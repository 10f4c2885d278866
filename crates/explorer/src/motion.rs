//! Naming the present motion, then its Lyapunov exponents, for as long as it is the present one.

use crate::answers::{Answers, Gone};
use crate::desk::{Current, Desk};
use crate::map::numbers;
use motiform_analysis::Estimate;
use motiform_study::scan::Row;
use motiform_study::simulate::Monitor;
use motiform_study::{Plan, analyse};
use serde_json::{Value, json};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Exponents that are followed.
const COUNT: usize = 3;

/// They are averaged over this many looks of the model after some others, and told this often.
const LOOKS: (f64, f64) = (2.0, 40.0);
const EVERY: Duration = Duration::from_millis(200);

/// Points that are kept of their history; beyond, every second one goes.
const MOST_POINTS: usize = 400;

/// A motion: the plan whose start is its state at the last change, without noise.
pub(crate) struct Motion {
    pub(crate) revision: u32,
    pub(crate) plan: Plan,
}

/// The exponents so far, by averaging time.
pub(crate) type History = Vec<(f64, Vec<Estimate>)>;

/// The desk at which motions are named.
pub(crate) struct Naming {
    desk: Desk<Motion>,
    history: Arc<Mutex<History>>,
}

impl Naming {
    pub(crate) fn new(answers: Answers) -> std::io::Result<Self> {
        let history = Arc::new(Mutex::new(History::new()));
        let kept = Arc::clone(&history);
        let desk = Desk::new("naming", move |motion: Motion, current| {
            // A page that has gone takes its session along.
            let _ = name(&motion, current, &answers).and_then(|()| follow(&motion, current, &answers, &kept));
        })?;
        Ok(Self { desk, history })
    }

    /// Names this motion, in place of an earlier one.
    pub(crate) fn name(&self, motion: Motion) {
        self.desk.put(motion);
    }

    /// Stops: the body has changed.
    pub(crate) fn stop(&self) {
        self.desk.clear();
        lock(&self.history).clear();
    }

    /// The exponents of the present motion so far.
    pub(crate) fn history(&self) -> History {
        lock(&self.history).clone()
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn name(motion: &Motion, current: &Current<'_>, answers: &Answers) -> Result<(), Gone> {
    let revision = motion.revision;
    answers.json(&json!({ "is": "naming", "revision": revision }))?;
    let verdict = analyse::classify(&motion.plan, 0.0, current);
    let Some(row) = Row::of_evaluation(0, 0, verdict).filter(|_| !current.stopped()) else { return Ok(()) };
    answers.json(&json!({
        "is": "named",
        "revision": revision,
        "regime": row.regime.name(),
        "why": row.why,
        "numbers": numbers(&row),
    }))
}

fn follow(
    motion: &Motion,
    current: &Current<'_>,
    answers: &Answers,
    history: &Mutex<History>,
) -> Result<(), Gone> {
    let Ok(info) = motion.plan.info() else { return Ok(()) };
    let count = COUNT.min(motion.plan.computation.initial.0.len() - 2);
    let times = (Some(LOOKS.0 * info.look), Some(LOOKS.1 * info.look));
    lock(history).clear();
    let (mut told, mut gone) = (Instant::now(), Ok(()));
    let mut tell = |time: f64, exponents: Option<Vec<Estimate>>, done: bool| {
        let Some(exponents) = exponents.filter(|_| !current.stopped()) else { return };
        gone = answers.json(&message(motion.revision, time, &exponents, done));
        keep(&mut lock(history), time, exponents);
    };
    let result = analyse::lyapunov_followed(&motion.plan, count, times, current, &mut |so_far| {
        if told.elapsed() >= EVERY {
            told = Instant::now();
            tell(so_far.time(), so_far.exponents(), false);
        }
    });
    // A motion that escapes has no exponents; what the numerics refuse was said by the name.
    if let Ok(result) = result {
        tell(result.time, Some(result.exponents).filter(|all| !all.is_empty()), true);
    }
    gone
}

fn keep(history: &mut History, time: f64, exponents: Vec<Estimate>) {
    history.push((time, exponents));
    if history.len() > MOST_POINTS {
        let mut place = 0;
        history.retain(|_| {
            place += 1;
            place % 2 == 1
        });
    }
}

fn message(revision: u32, time: f64, exponents: &[Estimate], done: bool) -> Value {
    // An error that is not known yet is not a number: null.
    let exponents: Vec<Value> =
        exponents.iter().map(|e| json!({ "value": e.value, "error": e.error })).collect();
    json!({ "is": "exponents", "revision": revision, "time": time, "exponents": exponents, "done": done })
}
