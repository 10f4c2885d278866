//! Merging of folders with shards of one scan.

use super::folder::{ScanFolder, ScanManifest};
use super::part::PartError;
use super::rows::same_rows;
use super::{Parts, ScanPlan, read_part};
use motiform_store::Error as StoreError;
use motiform_store::{Kind, Staged};
use motiform_study::scan::ScanComputation;
use motiform_study::{Error, Question as _};
use std::path::{Path, PathBuf};

/// The result of a merge.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Merged {
    /// Parts that no folder contains.
    pub missing: usize,
    /// Damaged parts, each with a description; they were omitted.
    pub damaged: Vec<String>,
    /// Remarks on the destination, in sentences: leftovers of killed merges, files that stay.
    pub notes: Vec<String>,
}

/// Merges the parts of `folders` into a new folder at `out`, which is created atomically. Missing parts are not an
/// error: the new folder can be resumed.
///
/// # Errors
/// [`Error::Unmergeable`] for folders of different scans, [`Error::Conflict`] for a part that two folders contain with
/// different numbers, [`Error::NoResult`], and errors of writing.
pub fn merge(folders: &[PathBuf], out: &Path, force: bool) -> Result<Merged, Error> {
    let folders = folders.iter().map(|path| ScanFolder::read(path)).collect::<Result<Vec<_>, _>>()?;
    let Some((first, others)) = folders.split_first() else {
        return Ok(Merged { missing: 0, damaged: Vec::new(), notes: Vec::new() });
    };
    for other in others {
        if other.manifest().plan_hash != first.manifest().plan_hash {
            return Err(Error::Unmergeable {
                first: other.path().to_owned(),
                second: first.path().to_owned(),
                differences: other.plan().differences(first.plan()),
            });
        }
    }
    let plan = first.plan();
    if !force && out.exists() {
        return Err(StoreError::Exists { path: out.to_owned() }.into());
    }
    let staged = Staged::new(out, Kind::Scan, force)?;
    staged.write(ScanComputation::MANIFEST, &ScanManifest::new(plan, None).encode(out)?)?;
    let sources: Vec<Parts> = folders.iter().map(ScanFolder::parts).collect();
    let mut merged = Merged { missing: 0, damaged: Vec::new(), notes: staged.notes().to_vec() };
    for part in 0..plan.parts() {
        let Some(source) = choose(plan, &sources, part, &mut merged.damaged)? else {
            merged.missing += 1;
            continue;
        };
        let path = source.path(part);
        let bytes = std::fs::read(&path).map_err(|error| Error::unreadable(&path, error))?;
        staged.write(&source.name(part), &bytes)?;
    }
    merged.notes.extend(staged.commit()?.1);
    Ok(merged)
}

/// The first folder that contains an undamaged part; all that do must contain the same numbers.
fn choose<'p>(
    plan: &ScanPlan,
    sources: &'p [Parts],
    part: usize,
    damaged: &mut Vec<String>,
) -> Result<Option<&'p Parts>, Error> {
    let mut chosen: Option<(&Parts, String)> = None;
    for source in sources {
        match (source.check(part), &chosen) {
            (Err(PartError::Missing), _) => {}
            (Err(PartError::Damaged(how)), _) => damaged.push(how),
            (Err(PartError::InTheWay(path)), _) => damaged.push(format!("{} is not a file", path.display())),
            (Ok(digest), None) => chosen = Some((source, digest)),
            (Ok(digest), Some((first, known))) => {
                // Other bytes may hold the same numbers: written by another version, say.
                let same = digest == *known
                    || same_rows(&read_part(plan, first, part)?, &read_part(plan, source, part)?);
                if !same {
                    return Err(Error::Conflict { first: first.path(part), second: source.path(part) });
                }
            }
        }
    }
    Ok(chosen.map(|found| found.0))
}
