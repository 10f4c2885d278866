//! One way to do each chore: `cargo xtask test`, `cargo xtask deny`.

use anyhow::{Context, Result, bail};
use std::process::{Command, ExitCode};

const HELP: &str = "\
usage: cargo xtask COMMAND

  test     everything that must pass before a push: format, lints, documentation, all tests
  quick    the tests alone
  deny     licences, advisories and sources of the dependencies (needs `cargo install --locked cargo-deny`)";

/// Lints and documentation are checked with every feature on, so that optional parts cannot rot.
const STEPS: &[(&str, &[&str])] = &[
    ("format", &["fmt", "--all", "--check"]),
    (
        "lints",
        &["clippy", "--release", "--workspace", "--all-targets", "--all-features", "--", "-D", "warnings"],
    ),
    ("documentation", &["doc", "--release", "--workspace", "--no-deps", "--document-private-items"]),
    ("tests", TESTS),
];

const TESTS: &[&str] = &["test", "--release", "--workspace", "--no-fail-fast"];

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<()> {
    match std::env::args().nth(1).as_deref() {
        Some("test") => STEPS.iter().try_for_each(|(name, arguments)| cargo(name, arguments)),
        Some("quick") => cargo("tests", TESTS),
        Some("deny") => cargo("dependencies", &["deny", "check"]),
        _ => {
            println!("{HELP}");
            Ok(())
        }
    }
}

/// Runs cargo in the workspace, showing what it does.
fn cargo(name: &str, arguments: &[&str]) -> Result<()> {
    eprintln!("== {name}: cargo {}", arguments.join(" "));
    // From cargo at run time: a program built in another checkout must not test that one.
    let package = std::env::var("CARGO_MANIFEST_DIR").context("start this by `cargo xtask`")?;
    let root = std::path::Path::new(&package).join("..");
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(program)
        .args(arguments)
        .current_dir(root)
        .env("RUSTDOCFLAGS", "-D warnings")
        .status()
        .with_context(|| format!("cargo could not be started for {name}"))?;
    if !status.success() {
        bail!("{name} failed");
    }
    Ok(())
}
