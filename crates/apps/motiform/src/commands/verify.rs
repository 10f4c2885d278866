//! `motiform verify`.

use crate::args::VerifyOptions;
use crate::output::{End, print};
use crate::progress::Progress;
use motiform_diagrams::Verification;
use std::fmt::Write;

pub(crate) fn run(options: &VerifyOptions) -> anyhow::Result<End> {
    let watch = Progress::new(1.0, "of the numbers");
    let found = Verification::of(&options.folder, options.all, &watch);
    watch.finish();
    let Some(found) = found? else { return Ok(End::Interrupted) };
    print(&if options.json { found.json().to_string() } else { text(options, &found)? })?;
    Ok(if found.is_intact() { End::Done } else { End::NotAsAsked })
}

fn text(options: &VerifyOptions, found: &Verification) -> anyhow::Result<String> {
    let (audit, inventory) = (&found.audit, &found.audit.inventory);
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
    write!(text, "numbers   {}", found.checked)?;
    if found.found.rows > 0 {
        write!(text, ": {} rows", found.found.rows)?;
    }
    for line in &found.found.different {
        write!(text, "\ndiffers   {line}")?;
    }
    write!(text, "\nverdict   {}", if found.is_intact() { "intact" } else { "not intact" })?;
    Ok(text)
}
