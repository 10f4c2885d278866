//! The folder of lifetimes: the answer with its figure, and the orbits from which the work goes on.

use super::{Lives, follow_lives_kept};
use crate::answers::Lived;
use crate::draw::FigureFormat;
use crate::draw::lifetimes::draw_lifetimes;
use motiform_dynamics::Watch;
use motiform_store::{Folder, Kind, Opening};
use motiform_study::plan::pretty;
use motiform_study::{Error, ScanPlan};
use std::path::Path;

/// The file of the results.
const FILE: &str = "lifetimes.json";

/// The file of the orbits, from which the work goes on.
const ORBITS: &str = "orbits.json";

/// Opens the folder before any computing, and reads the orbits that are there.
///
/// # Errors
/// [`Error::OtherPlan`] where they are of another plan; [`Error::Store`] where the folder exists, is not ours, is used by others or cannot
/// be written.
pub fn open(path: &Path, opening: Opening, plan: &ScanPlan) -> Result<(Folder, Option<Lives>), Error> {
    let orbits = path.join(ORBITS);
    let there = opening == Opening::Resume && orbits.symlink_metadata().is_ok();
    let before = if there { Some(Lives::read(&orbits, plan)?) } else { None };
    let files = Folder::open(path, Kind::Lifetimes, opening, &[])?;
    files.check()?;
    Ok((files, before))
}

/// Follows the orbits of a plan that the folder, if there is one, does not hold, and keeps them there. Where the watch stopped it, some are
/// still missing, and the folder is settled.
///
/// # Errors
/// As [`lifetimes`](super::lifetimes()), and those of writing.
pub fn follow_into(
    plan: &ScanPlan,
    place: Option<(Folder, Option<Lives>)>,
    threads: usize,
    watch: &dyn Watch,
) -> Result<(Lives, Option<Folder>), Error> {
    let (files, before) = place.map_or((None, None), |(files, before)| (Some(files), before));
    let kept = |lives: &Lives| files.as_ref().map_or(Ok(()), |files| keep(files, lives));
    let lives = match follow_lives_kept(plan, before, threads, &kept, watch) {
        Ok(lives) => lives,
        Err(error) => {
            files.into_iter().for_each(Folder::abandon);
            return Err(error);
        }
    };
    kept(&lives)?;
    if let Some(files) = files.as_ref().filter(|_| !lives.is_complete()) {
        files.settle()?;
    }
    Ok((lives, files))
}

/// Writes the orbits that are finished.
fn keep(files: &Folder, lives: &Lives) -> Result<(), Error> {
    let orbits = serde_json::to_vec(lives).map_err(|error| Error::write_failed(files.shown(), error))?;
    Ok(files.put(ORBITS, &orbits)?)
}

/// Writes the answer and its figure; `false` where there is nothing to draw.
///
/// # Errors
/// Numbers that do not fit on an axis; files that cannot be written.
pub fn write(answer: &Lived<'_>, files: &Folder, format: &FigureFormat) -> Result<bool, Error> {
    files.put(FILE, &pretty(answer, files.shown())?)?;
    let pictures = draw_lifetimes(answer.plan, answer.found, format)?;
    for picture in &pictures {
        files.put(&picture.name, &picture.bytes)?;
    }
    files.complete()?;
    Ok(!pictures.is_empty())
}
