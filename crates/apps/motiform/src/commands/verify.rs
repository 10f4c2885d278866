//! `motiform verify`.

use crate::args::VerifyOptions;
use crate::output::{End, say};
use crate::progress::Progress;
use motiform_diagrams::Verification;
use serde::{Serialize, Serializer};
use std::fmt::{Display, Formatter};
use std::path::Path;

pub(crate) fn run(options: &VerifyOptions) -> anyhow::Result<End> {
    let watch = Progress::new(1.0, "of the numbers");
    let found = watch.over(|watch| Verification::of(&options.folder, options.all, watch));
    let Some(found) = found? else { return Ok(End::Interrupted) };
    say(&Verified { folder: &options.folder, found: &found }, options.json)?;
    Ok(if found.is_intact() { End::Done } else { End::NotAsAsked })
}

/// The findings about a folder.
struct Verified<'a> {
    folder: &'a Path,
    found: &'a Verification,
}

impl Serialize for Verified<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.found.json().serialize(serializer)
    }
}

impl Display for Verified<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { folder, found } = self;
        let (audit, inventory) = (&found.audit, &found.audit.inventory);
        let state = if inventory.complete { "" } else { ", not complete" };
        writeln!(f, "{}: {} of motiform {}{state}", folder.display(), inventory.words(), inventory.version)?;
        writeln!(f, "files     {} unchanged", audit.unchanged.len())?;
        let lists = [("changed", &audit.changed), ("missing", &audit.missing), ("others'", &audit.foreign)];
        for (what, names) in lists.into_iter().filter(|(_, names)| !names.is_empty()) {
            writeln!(f, "{what:<9} {}", names.join(", "))?;
        }
        write!(f, "numbers   {}", found.checked)?;
        if found.found.rows > 0 {
            write!(f, ": {} rows", found.found.rows)?;
        }
        for line in &found.found.different {
            write!(f, "\ndiffers   {line}")?;
        }
        write!(f, "\nverdict   {}", if found.is_intact() { "intact" } else { "not intact" })
    }
}
