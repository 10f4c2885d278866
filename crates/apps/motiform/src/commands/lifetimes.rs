//! `motiform lifetimes`.

use crate::args::LifetimesOptions;
use crate::commands::remarks::{of_scan, ties};
use crate::commands::subject;
use crate::output::{End, plain, say, warn};
use crate::progress::Progress;
use motiform_analysis::LifeLaws;
use motiform_dynamics::digits::{four_digits, given};
use motiform_lab::draw::lifetimes::draw_lifetimes;
use motiform_lab::lifetimes::{LifeAt, Lifetimes, Lives, follow_lives_kept};
use motiform_lab::scan::{Axis, ScanComputation};
use motiform_store::{Folder, Kind};
use motiform_study::quantity::statistic::LIFE;
use motiform_study::{Error, ScanPlan, Shown, counted};
use serde::Serialize;
use std::fmt::{Display, Formatter};
use std::path::Path;

/// The file of the results.
const FILE: &str = "lifetimes.json";

/// The file of the orbits, from which the work goes on.
const ORBITS: &str = "orbits.json";

pub(crate) fn run(options: &LifetimesOptions) -> anyhow::Result<End> {
    let remedy = "figures are drawn into a folder: give --out DIR, or leave it out";
    options.style.refuse_unless(options.folder.out.is_some(), remedy)?;
    let (plan, units) = plan(options)?;
    let (files, before) = open(options, &plan)?;
    let threads = options.threads.count();
    let watch = Progress::new(plan.rows() as f64, "orbits");
    let kept = |lives: &Lives| files.as_ref().map_or(Ok(()), |files| keep(files, lives));
    let lives = watch.over(|watch| follow_lives_kept(&plan, before, threads, &kept, watch));
    let lives = match lives {
        Ok(lives) => lives,
        Err(error) => {
            files.into_iter().for_each(Folder::abandon);
            return Err(error.into());
        }
    };
    if let Some(files) = &files {
        keep(files, &lives)?;
    }
    if !lives.is_complete() {
        return interrupted(files);
    }
    let found = lives.summarised(&plan, options.transient)?;
    let answer = Lived::new(&plan, &found, (options.folder.out.as_deref(), &units));
    if let Some(files) = files {
        let mut text = serde_json::to_vec_pretty(&answer)?;
        text.push(b'\n');
        files.put(FILE, &text)?;
        let pictures = draw_lifetimes(&plan, &found, &options.style.format_in(units.clone()))?;
        if pictures.is_empty() {
            warn("no figure is drawn: at no value is a life watched after the delay");
        }
        for picture in pictures {
            files.put(&picture.name, &picture.bytes)?;
        }
        files.complete()?;
        files.notes().iter().for_each(|note| warn(note));
    }
    say(&answer, options.json)?;
    let answered = !matches!(
        found.laws,
        LifeLaws::TooFew { .. } | LifeLaws::Neither { .. } | LifeLaws::NotExponential(_)
    );
    Ok(if answered { End::Done } else { End::NotAsAsked })
}

/// Writes the orbits that are finished.
fn keep(files: &Folder, lives: &Lives) -> Result<(), Error> {
    let orbits = serde_json::to_vec(lives).map_err(|error| Error::write_failed(files.shown(), error))?;
    Ok(files.put(ORBITS, &orbits)?)
}

/// Opens the output before any computing, and reads the orbits that are there.
fn open(options: &LifetimesOptions, plan: &ScanPlan) -> anyhow::Result<(Option<Folder>, Option<Lives>)> {
    let Some(out) = &options.folder.out else { return Ok((None, None)) };
    let orbits = out.join(ORBITS);
    let there = options.folder.resume && orbits.symlink_metadata().is_ok();
    let before = if there { Some(Lives::read(&orbits, plan)?) } else { None };
    let files = Folder::open(out, Kind::Lifetimes, options.folder.opening(), &[])?;
    files.check()?;
    files.notes().iter().for_each(|note| warn(note));
    Ok((Some(files), before))
}

/// Ends a run that was interrupted.
fn interrupted(files: Option<Folder>) -> anyhow::Result<End> {
    if let Some(files) = files {
        files.settle()?;
        warn(
            "interrupted: the orbits followed to their ends are kept; the same `motiform lifetimes` with --resume goes on",
        );
    } else {
        warn("interrupted: nothing is kept without --out");
    }
    Ok(End::Interrupted)
}

/// The plan that the options describe, and the units of its results: all starts are random.
fn plan(options: &LifetimesOptions) -> Result<(ScanPlan, Shown), Error> {
    let mut study = subject::study(&options.subject)?;
    subject::note_noise(&mut study);
    for (key, value) in [("until", options.until), ("transient", options.transient)] {
        if let Some(value) = value.filter(|&value| value < 0.0 || key == "until" && value == 0.0) {
            let remedy = "give a model time above 0 (the transient may be 0)";
            return Err(Error::Setting { key, value: value.to_string(), remedy });
        }
    }
    study.scan.axes = vec![Axis::parse(&options.along)?];
    study.scan.samples = options.samples;
    study.scan.budget = options.until.unwrap_or(0.0);
    study.initial.clear();
    study.random = options.random.or(study.random);
    study.random = Some(study.starts_over(2, &study.scan.axes)?); // those that sample basins, also of one start
    options.run.apply(&mut study.run)?;
    ties(&study, &of_scan(&study))?;
    let units = options.units.of(&mut study)?;
    Ok((ScanPlan::new(&study)?, units))
}

/// The lifetimes of the motions of a plan.
#[derive(Serialize)]
struct Lived<'a> {
    plan_hash: String,
    #[serde(rename = "plan")]
    computation: &'a ScanComputation,
    #[serde(flatten)]
    found: &'a Lifetimes,
    notes: Vec<String>,
    sentence: String,
    #[serde(skip)]
    plan: &'a ScanPlan,
    #[serde(skip)]
    written: Option<&'a Path>,
    #[serde(skip)]
    units: &'a Shown,
}

impl<'a> Lived<'a> {
    fn new(
        plan: &'a ScanPlan,
        found: &'a Lifetimes,
        (written, units): (Option<&'a Path>, &'a Shown),
    ) -> Self {
        Self {
            plan_hash: plan.hash(),
            computation: &plan.computation,
            found,
            notes: found.notes(),
            sentence: found.laws.words(),
            plan,
            written,
            units,
        }
    }

    /// The first lines: what was followed, and the head of the table.
    fn head(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { plan, found, units, .. } = self;
        let c = &plan.computation;
        writeln!(f, "{} ({}, {})", plan.title, c.model, plan.name)?;
        let (until, unit) = match units.is_physical() {
            true => (
                found.until_in(|time| plain(&units.words(time, LIFE.dimension, ""))),
                format!(", times in {}", plain(&units.name(LIFE.dimension, ""))),
            ),
            false => (found.until_in(given), String::new()),
        };
        let starts = format!("{} each, {}, seed {}", counted(c.samples, "start"), c.random.words(), c.seed);
        let asked = if c.budget > 0.0 && c.budget < found.until()[1] {
            ": --until in whole looks of the model"
        } else {
            ""
        };
        writeln!(f, "{starts}, followed to {until}{asked}")?;
        write!(f, "{:>12}", found.parameter)?;
        for title in ["blew up", "captured", "lasting", "delay", "events", "watched", "mean life"] {
            write!(f, " {title:>10}")?;
        }
        writeln!(f, "  95 % limits{unit}")
    }
}

impl Display for Lived<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        self.head(f)?;
        for at in &self.found.values {
            writeln!(f, "{}", row(at, self.units.factor(LIFE.dimension)))?;
        }
        for note in &self.notes {
            writeln!(f, "note      {note}")?;
        }
        let (factor, unit) = (self.units.factor(LIFE.dimension), plain(&self.units.name(LIFE.dimension, "")));
        write!(f, "law       {}", self.found.laws.words_in(factor, &unit))?;
        self.written.map_or(Ok(()), |out| write!(f, "\nwritten   {}", out.display()))
    }
}

fn row(at: &LifeAt, factor: f64) -> String {
    let life = &at.life;
    let number = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.3e}"));
    let limits = match life.upper {
        Some(upper) => format!("{:.3e} to {:.3e}", factor * life.lower, factor * upper),
        None if life.lower > 0.0 => format!("above {:.3e}", factor * life.lower),
        None => "-".to_owned(),
    };
    let (delay, watched) = (four_digits(factor * at.delay), number(Some(factor * life.watched)));
    format!(
        "{:>12} {:>10} {:>10} {:>10} {delay:>10} {:>10} {watched:>10} {:>10}  {limits}",
        given(at.value),
        at.blew_up,
        at.captured,
        at.lasting,
        life.events,
        number(life.value.map(|value| factor * value))
    )
}
