//! Development tasks: `cargo xtask test`, `cargo xtask deny`.

mod beside;
mod book;
mod browser;
mod build_cost;
mod checks;
mod dist;
mod emulated;
mod explorer;
mod harness;
mod mutants;
mod parts;
mod python;
mod validate;
mod web;

use anyhow::{Context, Result, bail};
use beside::Beside;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Command, ExitCode, Stdio};

const HELP: &str = "\
usage: cargo xtask COMMAND

  test     everything that must pass before a push: format, lints, documentation, all tests, also those of Python
           and those in a browser
  quick    the Rust tests alone
  checks   lints and documentation
  explorer the page of `motiform explore`: builds it, compares it with the committed one, tests it in Chromium, and in part in
           Firefox
  firefox  all tests of the page in Firefox
  web      the page without a server: the WebAssembly module (needs `rustup target add wasm32-unknown-unknown`), the folder
           docs/site for any static host, and the page as one file, target/motiform.html; none of them is committed
  book     the book: docs/ as pages for a browser, in target/book; a broken link is an error
  documents  every command of README.md and docs/, also those that take minutes, and the pictures that they make, compared
  pictures the same, and the pictures of README.md and docs/ are written again
  python   the Python package: builds it into target/python and runs its tests there
  dist     a wheel, a stripped program and the page without a server, with checksums, in target/dist; the wheel is installed and tried
           where no cargo is
  faults   [N]: every N-th call that changes the file system fails, or is the last one, in every command that writes (1: every call)
  invariances: each motion is asked for as it is and after changes that cannot matter; writes docs/records/invariances.md
  kills    [N]: every command that writes is killed N times at random moments (1000)
  fuzz     [N]: N damaged inputs of each kind (100000)
  samples  all Rust tests, with the whole of every statistical sample
  emulated the tests of lanes under qemu-user, as a processor without vector registers to speak of and as one with AVX2
           (needs qemu-user)
  build-cost [--runs N] [--write]: a build from an empty cargo folder to the first picture, beside `cargo install ripgrep`, compared
           with budgets.toml; --write renews the table in CONTRIBUTING.md. Needs a quiet machine: six minutes for each run
  validate [--list] [RUN..]: the science runs of minutes to hours, of which every push has a sample; each writes its result to validation/
  mutants  [K/N] [OPTION..]: changes the mathematics in small ways, every N-th possible one from the K-th (0/100), and asks
           the tests to notice; see docs/records/mutants.md (needs `cargo install --locked cargo-mutants`)
  deny     licences, advisories and sources of the dependencies (needs `cargo install --locked cargo-deny`)";

const BEFORE: &[(&str, &[&str])] = &[
    ("format", &["fmt", "--all", "--check"]),
    ("build of the tests", &["test", "--release", "--workspace", "--no-run"]),
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
        Some("test") => with_parts(everything()),
        Some("quick") => cargo("tests", TESTS),
        Some("checks") => with_parts(checks::run()),
        // Steps of `test`, begun by it.
        Some("beside-tests") => with_parts(explorer::build().and_then(|()| python::test())),
        Some("firefox-part") => with_parts(explorer::test_part_in_firefox()),
        Some("explorer") => explorer::test(),
        Some("firefox") => explorer::test_in_firefox(),
        Some("python") => with_parts(python::test()),
        Some("web") => web::run(),
        Some("book") => book::build(),
        Some("documents") => book::documents(),
        Some("pictures") => book::pictures(),
        Some("mutants") => mutants::run(&std::env::args().skip(2).collect::<Vec<_>>()),
        Some("dist") => dist::run(),
        Some("emulated") => emulated::run(),
        Some("build-cost") => build_cost::run(&std::env::args().skip(2).collect::<Vec<_>>()),
        Some("validate") => validate::run(&std::env::args().skip(2).collect::<Vec<_>>()),
        Some("deny") => cargo("dependencies", &["deny", "check"]),
        Some(name) => harness::run(name, &std::env::args().skip(2).collect::<Vec<_>>()).unwrap_or_else(help),
        None => help(),
    }
}

/// Prints how long the parts of a task took, also of one that failed.
fn with_parts(done: Result<()>) -> Result<()> {
    parts::print();
    done
}

fn all(steps: &[(&str, &[&str])]) -> Result<()> {
    steps.iter().try_for_each(|(name, arguments)| cargo(name, arguments))
}

fn everything() -> Result<()> {
    all(BEFORE)?;
    tests_beside_builds()?;
    // Browsers wait for most of their time, which lints and documentation may have.
    let (firefox, checks) = (Beside::begin("firefox-part")?, Beside::begin_idly("checks")?);
    let page = explorer::test_in_chromium(); // of the program that the tests built
    firefox.end()?;
    checks.end()?;
    page?;
    book::build() // in the environment of the Python tests
}

/// The tests leave a quarter of two processors idle, because each binary ends with its longest test: the page and the Python package are
/// built meanwhile, and the package is tested, as soon as cargo is done with building, which only one cargo can do at a time.
fn tests_beside_builds() -> Result<()> {
    let mut builds = None;
    let tests = parts::timed("tests", || -> Result<_> {
        eprintln!("== tests: cargo {}", TESTS.join(" "));
        let mut tests = cargo_command();
        tests.args(TESTS).env("RUSTDOCFLAGS", "-D warnings").current_dir(root()?).stderr(Stdio::piped());
        let mut child = tests.spawn().context("tests")?;
        for line in child.stderr.take().map(BufReader::new).into_iter().flat_map(BufRead::lines) {
            let line = line?;
            eprintln!("{line}");
            if builds.is_none() && line.trim_start().starts_with("Running ") {
                builds = Some(Beside::begin("beside-tests")?);
            }
        }
        Ok(child.wait()?)
    })?;
    builds.map_or(Ok(()), Beside::end)?;
    if tests.success() { Ok(()) } else { bail!("tests failed") }
}

fn help() -> Result<()> {
    println!("{HELP}");
    Ok(())
}

/// The checkout. From cargo at run time: a program built in another checkout must not test that one.
fn root() -> Result<PathBuf> {
    let package = std::env::var("CARGO_MANIFEST_DIR").context("start this by `cargo xtask`")?;
    Ok(PathBuf::from(package).join(".."))
}

/// The folder of the toolchain.
fn sysroot() -> Result<PathBuf> {
    let output =
        Command::new("rustc").args(["--print", "sysroot"]).output().context("rustc could not be started")?;
    Ok(PathBuf::from(String::from_utf8(output.stdout)?.trim()))
}

/// Runs cargo in the workspace, showing what it does.
fn cargo(name: &str, arguments: &[&str]) -> Result<()> {
    step(name, cargo_command().args(arguments).env("RUSTDOCFLAGS", "-D warnings"))
}

/// The cargo that runs this.
fn cargo_command() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Runs a command in the checkout, showing what it does.
fn step(name: &str, command: &mut Command) -> Result<()> {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    let words: Vec<String> = words.map(|word| word.to_string_lossy().into_owned()).collect();
    eprintln!("== {name}: {}", words.join(" "));
    let folder = root()?;
    let status = parts::timed(name, || command.current_dir(folder).status());
    if !status.with_context(|| format!("{} could not be started for {name}", words[0]))?.success() {
        bail!("{name} failed");
    }
    Ok(())
}
