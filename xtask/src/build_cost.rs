//! The wait of a newcomer: a build from an empty cargo folder to the first picture, beside that of a public
//! crate on the same machine.

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

/// The table `[ratio]` of the budgets.
struct Budget {
    /// Version of ripgrep.
    reference: String,
    seconds: f64,
    cpu_seconds: f64,
}

impl Budget {
    fn read(root: &Path) -> Result<Self> {
        let budgets: toml::Table = fs::read_to_string(root.join(BUDGETS)).context(BUDGETS)?.parse()?;
        let ratio = budgets.get("ratio").with_context(|| format!("{BUDGETS} has no table [ratio]"))?;
        let number = |key: &str| {
            let value = ratio.get(key).and_then(toml::Value::as_float);
            value.with_context(|| format!("{BUDGETS} has no number ratio.{key}"))
        };
        let reference = ratio.get("reference").and_then(toml::Value::as_str);
        let reference = reference.with_context(|| format!("{BUDGETS} has no text ratio.reference"))?;
        let (seconds, cpu_seconds) = (number("seconds")?, number("cpu_seconds")?);
        Ok(Self { reference: reference.to_owned(), seconds, cpu_seconds })
    }
}

/// A cold build, and that of the reference.
pub(crate) struct Pair {
    ours: Cost,
    reference: Cost,
}

/// Measures as often as `--runs N` says (once by default), fails where a budget is exceeded, and writes the
/// table of the last run with `--write`.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let root = root()?.canonicalize()?;
    let (budget, runs) = (Budget::read(&root)?, runs(arguments)?);
    let version = &budget.reference;
    let mut pairs = Vec::new();
    for number in 1..=runs {
        let pair = pair(&root, version)?;
        eprintln!("== run {number} of {runs}: {}", pair.sentence(version));
        pairs.push(pair);
    }
    if arguments.iter().any(|argument| argument == "--write") {
        let path = root.join(DOCUMENT);
        let document = fs::read_to_string(&path).context(DOCUMENT)?;
        fs::write(&path, table::renewed(&document, &pairs, version)?)?;
    }
    let Budget { seconds: elapsed, cpu_seconds: cpu, .. } = budget;
    for pair in &pairs {
        let [seconds, cpu_seconds] = pair.ratios();
        if seconds > elapsed || cpu_seconds > cpu {
            bail!(
                "the build costs {seconds:.1} times that of ripgrep, {cpu_seconds:.1} times in CPU seconds; \
                {BUDGETS} allows {elapsed} and {cpu}"
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
            "{:.0} s and {:.0} CPU s to the first picture; `cargo install ripgrep@{version}`: {:.0} s and \
            {:.0} CPU s; ratios {seconds:.2} and {cpu_seconds:.2}",
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
