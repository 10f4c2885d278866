//! `motiform lifetimes`.

use crate::args::LifetimesOptions;
use crate::commands::remarks::{of_scan, ties};
use crate::commands::subject;
use crate::output::{End, plain, print, warn};
use crate::progress::Progress;
use motiform_analysis::LifeLaws;
use motiform_lab::draw::lifetimes::draw_lifetimes;
use motiform_lab::lifetimes::{LifeAt, Lifetimes, Lives, follow_lives_kept};
use motiform_lab::scan::Axis;
use motiform_store::{Folder, Kind, Opening};
use motiform_study::quantity::statistic::LIFE;
use motiform_study::{Error, Random, ScanPlan, Shown};
use serde_json::json;
use std::fmt::Write;

/// The file of the results.
const FILE: &str = "lifetimes.json";

/// The file of the orbits, from which the work goes on.
const ORBITS: &str = "orbits.json";

pub(crate) fn run(options: &LifetimesOptions) -> anyhow::Result<End> {
    let remedy = "figures are drawn into a folder: give --out DIR, or leave it out";
    options.style.refuse_unless(options.out.is_some(), remedy)?;
    let (plan, units) = plan(options)?;
    let (files, before) = open(options, &plan)?;
    let threads = options.threads.count();
    let watch = Progress::new(plan.rows() as f64, "orbits");
    let kept = |lives: &Lives| files.as_ref().map_or(Ok(()), |files| keep(files, lives));
    let lives = follow_lives_kept(&plan, before, threads, &kept, &watch);
    watch.finish();
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
    if let Some(files) = files {
        let mut text = serde_json::to_vec_pretty(&json(&plan, &found)?)?;
        text.push(b'\n');
        files.put(FILE, &text)?;
        for picture in draw_lifetimes(&plan, &found, &options.style.format_in(units.clone()))? {
            files.put(&picture.name, &picture.bytes)?;
        }
        files.complete()?;
        files.notes().iter().for_each(|note| warn(note));
    }
    print(&if options.json {
        json(&plan, &found)?.to_string()
    } else {
        summary(&plan, &found, (options, &units))?
    })?;
    let answered = !matches!(found.laws, LifeLaws::TooFew { .. } | LifeLaws::Neither { .. });
    Ok(if answered { End::Done } else { End::NotAsAsked })
}

/// Writes the orbits that are finished.
fn keep(files: &Folder, lives: &Lives) -> Result<(), Error> {
    let orbits = serde_json::to_vec(lives).map_err(|error| Error::write_failed(files.shown(), error))?;
    Ok(files.put(ORBITS, &orbits)?)
}

/// Opens the output before any computing, and reads the orbits that are there.
fn open(options: &LifetimesOptions, plan: &ScanPlan) -> anyhow::Result<(Option<Folder>, Option<Lives>)> {
    let Some(out) = &options.out else { return Ok((None, None)) };
    let orbits = out.join(ORBITS);
    let there = options.resume && orbits.symlink_metadata().is_ok();
    let before = if there { Some(Lives::read(&orbits, plan)?) } else { None };
    let files = Folder::open(out, Kind::Lifetimes, Opening::of(options.resume, options.force), &[])?;
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
    study.random = Some(options.random.or(study.random).unwrap_or(Random::basins(study.info()?)));
    options.run.apply(&mut study.run)?;
    ties(&study, &of_scan(&study))?;
    Ok((ScanPlan::new(&study)?, options.units.of(Some(&study))?))
}

fn json(plan: &ScanPlan, found: &Lifetimes) -> anyhow::Result<serde_json::Value> {
    let mut object = json!({ "plan_hash": plan.hash(), "plan": plan.computation });
    if let (Some(object), serde_json::Value::Object(entries)) =
        (object.as_object_mut(), serde_json::to_value(found)?)
    {
        object.extend(entries);
        object.insert("notes".to_owned(), found.notes().into());
        object.insert("sentence".to_owned(), found.laws.words().into());
    }
    Ok(object)
}

fn summary(
    plan: &ScanPlan,
    found: &Lifetimes,
    (options, units): (&LifetimesOptions, &Shown),
) -> anyhow::Result<String> {
    let c = &plan.computation;
    let mut text = format!("{} ({}, {})\n", plan.title, c.model, plan.name);
    let starts = format!("{} starts each, {}, seed {}", c.samples, c.random.words(), c.seed);
    let until = if units.is_physical() {
        plain(&units.words(found.until, LIFE.dimension, ""))
    } else {
        found.until.to_string()
    };
    writeln!(text, "{starts}, followed to {until}")?;
    let head = ["blew up", "captured", "lasting", "delay", "events", "watched", "mean life"];
    let unit = if units.is_physical() {
        format!(", times in {}", plain(&units.name(LIFE.dimension, "")))
    } else {
        String::new()
    };
    write!(text, "{:>12}", found.parameter)?;
    for title in head {
        write!(text, " {title:>10}")?;
    }
    writeln!(text, "  95 % limits{unit}")?;
    for at in &found.values {
        writeln!(text, "{}", row(at, units.factor(LIFE.dimension)))?;
    }
    for note in found.notes() {
        writeln!(text, "note      {note}")?;
    }
    write!(text, "law       {}", found.laws.words())?;
    if let Some(out) = &options.out {
        write!(text, "\nwritten   {}", out.display())?;
    }
    Ok(text)
}

fn row(at: &LifeAt, factor: f64) -> String {
    let life = &at.life;
    let number = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.3e}"));
    let limits = match life.upper {
        Some(upper) => format!("{:.3e} to {:.3e}", factor * life.lower, factor * upper),
        None if life.lower > 0.0 => format!("above {:.3e}", factor * life.lower),
        None => "-".to_owned(),
    };
    let value = format!("{:.9e}", at.value).parse().unwrap_or(at.value); // without the last digits of an evenly spaced axis
    let (delay, watched) = (factor * at.delay, number(Some(factor * life.watched)));
    format!(
        "{value:>12} {:>10} {:>10} {:>10} {delay:>10.0} {:>10} {watched:>10} {:>10}  {limits}",
        at.blew_up,
        at.captured,
        at.lasting,
        life.events,
        number(life.value.map(|value| factor * value))
    )
}
