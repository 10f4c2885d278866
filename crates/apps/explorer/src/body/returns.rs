//! Return maps: of the motion so far, and of the motion that follows, which is computed without waiting for the display.

use super::looks::{DIGITS, short};
use crate::answers::{Gone, text};
use crate::protocol::{self, Refused, ReturnsTold, Section, SectionKind};
use crate::task::{Task, Tell};
use motiform_dynamics::{InPlane, Model, Watch};
use motiform_lab::clock::Moment;
use motiform_lab::live::{Record, Stretch, crossings_of_path, maxima_of_speed};
use motiform_store::table::Table;
use motiform_study::plan::check;
use motiform_study::study::ReturnMapSettings;
use motiform_study::{Error, Plan};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Maximum number of points of a return map that are sent: the last ones.
const MOST: usize = 3000;

/// A sequence whose return map is shown.
pub(super) struct Returns {
    pub(super) values: Vec<f64>,
    /// Their name (markup), and their description.
    pub(super) symbol: &'static str,
    pub(super) what: String,
    /// The height of the line that the path crosses.
    y: Option<f64>,
    pub(super) crossings: Option<Table>,
}

impl Returns {
    /// Each value with the one before, as the page draws them.
    pub(super) fn told(&self, section: SectionKind) -> protocol::Returns {
        let pairs = self.values.windows(2).rev().take(MOST).rev();
        protocol::Returns {
            section,
            label: self.symbol.to_owned(),
            y: self.y,
            points: pairs.map(|pair| [short(pair[0], DIGITS), short(pair[1], DIGITS)]).collect(),
        }
    }
}

/// The returns of a recorded motion; `preset` is the segment of its preset, if it has one.
pub(super) fn of(
    record: &Record,
    model: &dyn Model,
    preset: Option<&ReturnMapSettings>,
    section: Section,
) -> Returns {
    if section.section == SectionKind::Speed {
        return Returns {
            values: maxima_of_speed(record),
            symbol: "*v*",
            what: "The maxima of the speed, in turn.".to_owned(),
            y: None,
            crossings: None,
        };
    }
    let settings = segment(preset, section.y);
    let (crossings, _) = crossings_of_path(record, model, &settings);
    let rising = crossings.get("rising").unwrap_or_default();
    let wanted = |place: usize| section.y.is_some() || rising.get(place) == Some(&1.0);
    let xs = crossings.get("x").unwrap_or_default().iter().enumerate();
    let values = xs.filter(|(place, _)| wanted(*place)).map(|(_, x)| *x).collect();
    let direction = if section.y.is_some() { "in either direction" } else { "upwards" };
    Returns {
        values,
        symbol: "*x*",
        what: format!(
            "*x* where the path crosses *y* = {}, {direction}; the centre of the path lies on the origin.",
            settings.y
        ),
        y: Some(settings.y),
        crossings: Some(crossings),
    }
}

/// The segment at this height, as wide as that of the preset. Without a height, the whole line through the centre of the
/// path: a circling body crosses it upwards once in each turn, and its return map is connected.
fn segment(preset: Option<&ReturnMapSettings>, y: Option<f64>) -> ReturnMapSettings {
    let whole = ReturnMapSettings { y: 0.0, x_min: -1e300, x_max: 1e300, centre: true };
    match (y, preset) {
        (None, _) => whole,
        (Some(y), None) => ReturnMapSettings { y, ..whole },
        (Some(y), Some(preset)) => ReturnMapSettings { y, centre: true, ..preset.clone() },
    }
}

/// The most returns that can be asked for, the longest time that is spent on them, and the most numbers that are kept.
const LIMITS: (u16, Duration, usize) = (2000, Duration::from_secs(30), 6_000_000);
/// Samples between two counts at first; each is for twice as many.
const FIRST: f64 = 2000.0;
/// The time of one piece of the motion, after which a job that is stale ends.
const PIECE: Duration = Duration::from_millis(50);

/// Returns to be computed, from a state on.
#[derive(Serialize, Deserialize)]
pub(crate) struct Job {
    pub(super) revision: u32,
    pub(super) plan: Plan,
    pub(super) t: f64,
    pub(super) state: Vec<f64>,
    pub(super) preset: Option<ReturnMapSettings>,
    pub(super) section: Section,
    pub(super) count: u16,
}

/// Computes returns ahead. Its report is the message to the page.
pub(crate) struct Ahead;

impl Task for Ahead {
    type Job = Job;
    type Report = String;

    const NAME: &'static str = "returns";
    /// Pictures go first.
    const NICE: i32 = 5;

    fn run(job: Job, watch: &dyn Watch, tell: Tell<'_, String>) -> Result<(), Gone> {
        match ahead(&job, watch) {
            Ok(Some(told)) => tell(text(&told.into())),
            Ok(None) => Ok(()),
            Err(error) => tell(text(&Refused { id: None, why: error.to_string() }.into())),
        }
    }
}

/// Moves a body on until there are as many returns as were asked for, or it takes too long; `None` if nobody waits any more.
fn ahead(job: &Job, watch: &dyn Watch) -> Result<Option<ReturnsTold>, Error> {
    check("count", f64::from(job.count), (1..=LIMITS.0).contains(&job.count), "give 1 to 2000 returns")?;
    let plan = &job.plan;
    let model = plan.body()?;
    let body = InPlane(model.as_ref());
    let kept = LIMITS.2 / (2 * job.state.len() + 8);
    let mut record = Record::new(model.as_ref(), &plan.computation, kept);
    let mut stretch = Stretch::new(plan, &body, job.t, &job.state, u64::from(job.revision))?;
    let wanted = usize::from(job.count);
    let (begun, mut samples) = (Moment::now(), FIRST);
    loop {
        let to = job.t + samples * plan.computation.dt_out;
        while !stretch.advance(to, PIECE, &mut record, model.as_ref()) && begun.elapsed() < LIMITS.1 {
            if watch.stopped() {
                return Ok(None);
            }
        }
        let found = of(&record, model.as_ref(), job.preset.as_ref(), job.section);
        let complete = found.values.len() > wanted;
        let over = stretch.outcome().is_some() || begun.elapsed() >= LIMITS.1 || samples >= kept as f64;
        if watch.stopped() {
            return Ok(None);
        }
        if complete || over {
            let returns = found.told(job.section.section);
            return Ok(Some(ReturnsTold { revision: job.revision, time: stretch.t(), complete, returns }));
        }
        samples = (2.0 * samples).min(kept as f64);
    }
}
