//! What a newcomer waits for: a build from an empty cargo folder to the first picture, beside that of a public crate on the same machine.

mod measure;
mod table;

use crate::root;
use anyhow::{Context, Result, bail};
use measure::{Cost, cold};
use std::fs;
use std::path::Path;

/// The file of budgets, and the document that shows the measurement.
const BUDGETS: &str = "budgets.toml";
const DOCUMENT: &str = "CONTRIBUTING.md";

/// A cold build, and that of the reference.
pub(crate) struct Pair {
    ours: Cost,
    reference: Cost,
}

/// Measures as often as `--runs N` says (once by default), fails where a budget is exceeded, and writes the table of the last run with `--write`.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let root = root()?.canonicalize()?;
    let budgets = fs::read_to_string(root.join(BUDGETS)).context(BUDGETS)?;
    let (version, runs) = (quoted(&budgets, "reference")?, runs(arguments)?);
    let mut pairs = Vec::new();
    for number in 1..=runs {
        let pair = pair(&root, &version)?;
        eprintln!("== run {number} of {runs}: {}", pair.sentence(&version));
        pairs.push(pair);
    }
    if arguments.iter().any(|argument| argument == "--write") {
        let path = root.join(DOCUMENT);
        let document = fs::read_to_string(&path).context(DOCUMENT)?;
        fs::write(&path, table::renewed(&document, &pairs, &version)?)?;
    }
    let [elapsed, cpu] = [number(&budgets, "seconds")?, number(&budgets, "cpu_seconds")?];
    for pair in &pairs {
        let [seconds, cpu_seconds] = pair.ratios();
        if seconds > elapsed || cpu_seconds > cpu {
            bail!(
                "the build costs {seconds:.1} times that of ripgrep, {cpu_seconds:.1} times in CPU seconds; {BUDGETS} allows {elapsed} and {cpu}"
            );
        }
    }
    Ok(())
}

impl Pair {
    /// Elapsed and CPU seconds relative to the reference.
    fn ratios(&self) -> [f64; 2] {
        [self.ours.seconds / self.reference.seconds, self.ours.cpu_seconds / self.reference.cpu_seconds]
    }

    fn sentence(&self, version: &str) -> String {
        let [seconds, cpu_seconds] = self.ratios();
        format!(
            "{:.0} s and {:.0} CPU s to the first picture; `cargo install ripgrep@{version}`: {:.0} s and {:.0} CPU s; ratios {seconds:.2} and {cpu_seconds:.2}",
            self.ours.seconds, self.ours.cpu_seconds, self.reference.seconds, self.reference.cpu_seconds
        )
    }
}

/// The reference first, then the program up to its first picture.
fn pair(root: &Path, version: &str) -> Result<Pair> {
    let crate_version = format!("ripgrep@{version}");
    let reference =
        cold(root, &["install", "--quiet", "--locked", "--root", "{}/installed", &crate_version])?;
    let picture = ["run", "--quiet", "--release", "--locked", "--timings", "--"];
    let simulate = ["simulate", "tensor", "--preset", "fig5a", "--out", "{}/picture"];
    Ok(Pair { ours: cold(root, &[&picture[..], &simulate[..]].concat())?, reference })
}

fn runs(arguments: &[String]) -> Result<usize> {
    let Some(at) = arguments.iter().position(|argument| argument == "--runs") else { return Ok(1) };
    arguments.get(at + 1).and_then(|text| text.parse().ok()).context("--runs needs a whole number")
}

/// The value of a key in the file of budgets, as text.
fn value<'b>(budgets: &'b str, key: &str) -> Result<&'b str> {
    let line = |line: &'b str| {
        let (name, rest) = line.split_once('=')?;
        (name.trim() == key).then(|| rest.split('#').next().unwrap_or_default().trim())
    };
    budgets.lines().find_map(line).with_context(|| format!("{BUDGETS} has no key {key}"))
}

fn quoted(budgets: &str, key: &str) -> Result<String> {
    Ok(value(budgets, key)?.trim_matches('"').to_owned())
}

fn number(budgets: &str, key: &str) -> Result<f64> {
    value(budgets, key)?.parse().with_context(|| format!("{key} in {BUDGETS} is no number"))
}
