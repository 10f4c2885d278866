//! Mutation tests: a sample of small changes to the mathematics, each of which a test must detect.

use crate::step;
use anyhow::{Context, Result, bail};
use std::process::Command;

/// Excluded: systems and oracles that only tests use, and code that lanes share with single orbits.
const LEFT_OUT: [&str; 4] = [
    "crates/engine/models/src/zoo/*.rs",
    "crates/engine/models/src/tensor/indices.rs",
    "crates/*/*/src/**/lanes.rs",
    "crates/engine/analysis/src/regime/lane_look.rs",
];

/// The default sample: every 100th of about 4,400 mutants, so some in every file.
const SAMPLE: &str = "0/100";

/// Runs cargo-mutants on a sample (`K/N`: every N-th mutant, from the K-th); `more` is passed to cargo-mutants unchanged.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let (sample, more) = match arguments.split_first() {
        Some((first, more)) if !first.starts_with('-') => (first.as_str(), more),
        _ => (SAMPLE, arguments),
    };
    if !is_sample(sample) {
        bail!("{sample:?} is no sample: give K/N with K below N, as in 3/100");
    }
    installed()?;
    let mut command = Command::new("cargo");
    command.args(["mutants", "--package", "motiform-analysis", "--package", "motiform-models"]);
    command.args(["--sharding", "round-robin", "--shard", sample, "--profile", "mutants"]);
    // a mutant that never ends is caught
    command.args(["--timeout", "900", "--build-timeout", "1800", "--output", "target"]);
    command.args(LEFT_OUT.iter().flat_map(|file| ["--exclude", file]));
    step("mutants", command.args(more))
}

/// `K/N` with K below N.
fn is_sample(text: &str) -> bool {
    let parse = |(k, n): (&str, &str)| Some((k.parse::<u32>().ok()?, n.parse::<u32>().ok()?));
    text.split_once('/').and_then(parse).is_some_and(|(k, n)| k < n)
}

/// Returns `true` if cargo-mutants is installed; otherwise reports how to install it.
fn installed() -> Result<()> {
    let found = Command::new("cargo").args(["mutants", "--version"]).output().context("cargo")?;
    if !found.status.success() {
        bail!("cargo-mutants is missing: run `cargo install --locked cargo-mutants`");
    }
    Ok(())
}
