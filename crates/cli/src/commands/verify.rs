//! `motiform verify`.

use crate::args::VerifyOptions;
use crate::output::{End, print};
use crate::progress::Progress;
use motiform_branching::BranchFolder;
use motiform_branching::curves::CurveFolder;
use motiform_files::Kind;
use motiform_files::store::Audit;
use motiform_lab::verify::{Repeated, verify_dataset, verify_scan};
use serde_json::json;
use std::fmt::Write;

/// What was found of the numbers.
struct Numbers {
    /// What was done, in a sentence.
    how: &'static str,
    found: Repeated,
}

pub(crate) fn run(options: &VerifyOptions) -> anyhow::Result<End> {
    let audit = Audit::of(&options.folder)?;
    let watch = Progress::new(1.0, "of the numbers");
    let numbers = numbers(options, &audit, &watch);
    watch.finish();
    let Some(numbers) = numbers? else { return Ok(End::Interrupted) };
    let intact = audit.changed.is_empty() && audit.missing.is_empty() && numbers.found.different.is_empty();
    print(&if options.json {
        json(&audit, &numbers, intact)
    } else {
        text(options, &audit, &numbers, intact)?
    })?;
    Ok(if intact { End::Done } else { End::NotAsAsked })
}

/// Checks plan hashes, and computes numbers again where this costs no more than computing them did. `None` if it was stopped.
fn numbers(options: &VerifyOptions, audit: &Audit, watch: &Progress) -> anyhow::Result<Option<Numbers>> {
    let folder = &options.folder;
    let repeated = |how, found: Option<Repeated>| Ok(found.map(|found| Numbers { how, found }));
    let checked = |how, error: Option<String>| {
        Ok(Some(Numbers { how, found: Repeated { rows: 0, different: error.into_iter().collect() } }))
    };
    let damaged = |error: motiform_study::Error| match error {
        error @ motiform_study::Error::Interrupted => Err(error),
        error => Ok(Some(Repeated { rows: 0, different: vec![error.to_string()] })),
    };
    match Kind::of_name(&audit.inventory.kind) {
        Some(Kind::Dataset) => {
            let found = verify_dataset(folder, options.all, watch).or_else(damaged)?;
            repeated("plan hash; rows of the trajectory computed again", found)
        }
        Some(Kind::Scan) => {
            let found = verify_scan(folder, options.all, watch).or_else(damaged)?;
            repeated("plan hash, digests inside the parts; rows computed again", found)
        }
        Some(Kind::Branches) => checked(
            "plan hash; points are not computed again",
            BranchFolder::read(folder).err().map(|e| e.to_string()),
        ),
        Some(Kind::Curves) => checked(
            "plan hash; points are not computed again",
            CurveFolder::read(folder).err().map(|e| e.to_string()),
        ),
        _ => checked("digests only: numbers of this kind are not computed again", None),
    }
}

fn json(audit: &Audit, numbers: &Numbers, intact: bool) -> String {
    json!({
        "intact": intact,
        "kind": audit.inventory.kind,
        "motiform": audit.inventory.version,
        "complete": audit.inventory.complete,
        "unchanged": audit.unchanged.len(),
        "changed": audit.changed,
        "missing": audit.missing,
        "foreign": audit.foreign,
        "checked": numbers.how,
        "rows": numbers.found.rows,
        "different": numbers.found.different,
    })
    .to_string()
}

fn text(options: &VerifyOptions, audit: &Audit, numbers: &Numbers, intact: bool) -> anyhow::Result<String> {
    let inventory = &audit.inventory;
    let state = if inventory.complete { "" } else { ", not complete" };
    let mut text = format!(
        "{}: {} of motiform {}{state}\n",
        options.folder.display(),
        inventory.words(),
        inventory.version
    );
    writeln!(text, "files     {} unchanged", audit.unchanged.len())?;
    let lists = [("changed", &audit.changed), ("missing", &audit.missing), ("others'", &audit.foreign)];
    for (what, names) in lists.into_iter().filter(|(_, names)| !names.is_empty()) {
        writeln!(text, "{what:<9} {}", names.join(", "))?;
    }
    write!(text, "numbers   {}", numbers.how)?;
    if numbers.found.rows > 0 {
        write!(text, ": {} rows", numbers.found.rows)?;
    }
    for line in &numbers.found.different {
        write!(text, "\ndiffers   {line}")?;
    }
    write!(text, "\nverdict   {}", if intact { "intact" } else { "not intact" })?;
    Ok(text)
}
