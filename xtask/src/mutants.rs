//! Mutation tests: a sample of small changes to the mathematics, each of which some test must notice.

use crate::step;
use anyhow::{Context, Result, bail};
use std::process::Command;

/// What is changed: the classifier with what it asks, and the cell's velocity and closure. All of both crates is thousands of mutants.
const FILES: [&str; 5] = [
    "crates/analysis/src/regime/*.rs",
    "crates/analysis/src/*.rs",
    "crates/models/src/cell/velocity.rs",
    "crates/models/src/cell/reduction.rs",
    "crates/models/src/tensor/**/*.rs",
];

/// The part that is tested where none is asked for: every 40th mutant, a different kind in every file.
const SHARD: &str = "0/40";

/// Runs cargo-mutants on the sample `shard` (`k/n`: every n-th mutant, from the k-th), with the tests of the two crates.
pub(crate) fn run(shard: Option<&str>) -> Result<()> {
    let shard = shard.unwrap_or(SHARD);
    if !is_shard(shard) {
        bail!("{shard:?} is no sample: give K/N with K below N, as in 3/40");
    }
    installed()?;
    let mut command = Command::new("cargo");
    command.args(["mutants", "--package", "motiform-analysis", "--package", "motiform-models"]);
    command.args(["--test-package", "motiform-analysis,motiform-models", "--baseline", "skip"]);
    command.args(["--sharding", "round-robin", "--shard", shard]);
    // a mutant that never ends is caught
    command.args(["--timeout", "900", "--build-timeout", "1800", "--output", "target/mutants"]);
    for file in FILES {
        command.args(["--file", file]);
    }
    command.args(["--", "--release"]);
    step("mutants", &mut command)
}

/// `K/N` with K below N.
fn is_shard(text: &str) -> bool {
    let numbers = text.split_once('/').and_then(|(k, n)| Some((k.parse::<u32>().ok()?, n.parse::<u32>().ok()?)));
    numbers.is_some_and(|(k, n)| k < n)
}

/// Asks for cargo-mutants, or says how to get it.
fn installed() -> Result<()> {
    let found = Command::new("cargo").args(["mutants", "--version"]).output().context("cargo")?;
    if !found.status.success() {
        bail!("cargo-mutants is missing: run `cargo install --locked cargo-mutants`");
    }
    Ok(())
}
