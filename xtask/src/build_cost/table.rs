//! The measurement as a part of CONTRIBUTING.md, between two markers.

use super::Pair;
use anyhow::{Context, Result};
use std::fmt::Write as _;

const BEGIN: &str = "<!-- by cargo xtask build-cost --write -->\n";
const END: &str = "<!-- end -->\n";

/// Rows of the table.
const ROWS: usize = 12;

/// The document with this measurement.
pub(super) fn renewed(document: &str, pairs: &[Pair], version: &str) -> Result<String> {
    let (before, rest) = document.split_once(BEGIN).context("the document has no place for the table")?;
    let (_, after) = rest.split_once(END).context("the table in the document has no end")?;
    Ok(format!("{before}{BEGIN}{}{END}{after}", text(pairs, version)))
}

fn text(pairs: &[Pair], version: &str) -> String {
    let mut text = String::new();
    for pair in pairs {
        let _ = writeln!(text, "* {}", pair.sentence(version));
    }
    let Some(last) = pairs.last() else { return text };
    let units = &last.ours.units;
    let (sum, ours) = units.iter().fold((0.0, 0.0), |(sum, ours), (name, seconds)| {
        (sum + seconds, if name.starts_with("motiform") { ours + seconds } else { ours })
    });
    let _ = writeln!(
        text,
        "\nThe {} units of the last run, {sum:.0} s in all, {ours:.0} s of it the crates of this repository; the longest, in seconds:\n",
        units.len()
    );
    text.push_str("| unit | seconds | | unit | seconds |\n| --- | --- | --- | --- | --- |\n");
    for row in 0..ROWS {
        let cell = |at: usize| units.get(at).map_or(String::new(), |(name, s)| format!("{name} | {s:.0}"));
        let _ = writeln!(text, "| {} | | {} |", cell(row), cell(row + ROWS));
    }
    text
}
