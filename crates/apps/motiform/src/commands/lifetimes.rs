//! `motiform lifetimes`.

use crate::args::LifetimesOptions;
use crate::commands::remarks::{of_scan, ties};
use crate::commands::subject;
use crate::output::{End, print, say, warn};
use crate::progress::Progress;
use motiform_analysis::LifeLaws;
use motiform_lab::answers::Lived;
use motiform_lab::lifetimes::{ask, follow_into, open, write};
use motiform_lab::scan::Axis;
use motiform_study::{Error, ScanPlan, Shown};

pub(crate) fn run(options: &LifetimesOptions) -> anyhow::Result<End> {
    let remedy = "figures are drawn into a folder: give --out DIR, or leave it out";
    options.style.refuse_unless(options.folder.out.is_some(), remedy)?;
    let (plan, units) = plan(options)?;
    let place = options.folder.out.as_deref().map(|out| open(out, options.folder.opening(), &plan));
    let place = place.transpose()?;
    place.iter().flat_map(|(files, _)| files.notes()).for_each(|note| warn(&note));
    let watch = Progress::new(plan.rows() as f64, "orbits");
    let threads = options.threads.count();
    let (lives, files) = watch.over(|watch| follow_into(&plan, place, threads, watch))?;
    if !lives.is_complete() {
        warn(if files.is_some() {
            "interrupted: the orbits followed to their ends are kept; the same `motiform lifetimes` with --resume goes on"
        } else {
            "interrupted: nothing is kept without --out"
        });
        return Ok(End::Interrupted);
    }
    let found = lives.summarised(&plan, options.transient)?;
    let answer = Lived::new(&plan, &found, &units);
    if let Some(files) = &files {
        if !write(&answer, files, &options.style.format_in(units.clone()))? {
            warn("no figure is drawn: at no value is a life watched after the delay");
        }
        files.notes().iter().for_each(|note| warn(note));
    }
    say(&answer, options.json)?;
    if let Some(out) = options.folder.out.as_ref().filter(|_| !options.json) {
        print(&format!("written   {}", out.display()))?;
    }
    let answered = !matches!(
        found.laws,
        LifeLaws::TooFew { .. } | LifeLaws::Neither { .. } | LifeLaws::NotExponential(_)
    );
    Ok(if answered { End::Done } else { End::NotAsAsked })
}

/// The plan that the options describe, and the units of its results: all starts are random.
fn plan(options: &LifetimesOptions) -> Result<(ScanPlan, Shown), Error> {
    let mut study = subject::study(&options.subject)?;
    subject::note_noise(&mut study);
    study.random = options.random.or(study.random);
    let axis = Axis::parse(&options.along)?;
    ask(&mut study, axis, options.samples, [options.until, options.transient])?;
    options.run.apply(&mut study.run)?;
    ties(&study, &of_scan(&study))?;
    let units = options.units.of(&mut study)?;
    Ok((ScanPlan::new(&study)?, units))
}
