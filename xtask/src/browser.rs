//! The tests of the page in a real browser: all files at once, and those with a failed test once more, one after the other.
//!
//! A browser, a server and a map on two busy processors can be too slow for a test in one run. What fails twice has failed; what
//! failed once is named in the output.

use crate::step;
use anyhow::{Context, Result};
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The variables that name the browser and its path.
pub(crate) type Environment = [(&'static str, PathBuf); 2];

/// The command that starts the tests in a browser.
pub(crate) struct Browser<'a> {
    node: &'a Path,
    environment: Environment,
    program: PathBuf,
    /// The path of the list of results.
    results: PathBuf,
}

impl<'a> Browser<'a> {
    /// The tests of this program in this browser.
    pub(crate) fn new(node: &'a Path, environment: Environment, program: PathBuf) -> Self {
        let results = program.with_file_name(format!("{}.tap", environment[0].1.display()));
        Self { node, environment, program, results }
    }

    /// Runs the tests of these files.
    pub(crate) fn test(&self, files: &[PathBuf]) -> Result<()> {
        let Err(error) = step(&format!("tests in {}", self.name()), &mut self.command(files, 2)) else {
            return Ok(());
        };
        let results = std::fs::read_to_string(&self.results).context("the results of the browser tests")?;
        let (tests, failed) = failed(&results);
        if failed.is_empty() {
            return Err(error); // nothing that could be run once more
        }
        eprintln!("== failed once: {}", tests.join("; "));
        step(&format!("tests in {} with a failure, once more", self.name()), &mut self.command(&failed, 1))?;
        eprintln!("== passed the second time: {}", tests.join("; "));
        Ok(())
    }

    fn name(&self) -> std::borrow::Cow<'_, str> {
        self.environment[0].1.to_string_lossy()
    }

    fn command(&self, files: &[PathBuf], at_once: usize) -> Command {
        let mut results = OsString::from("--test-reporter-destination=");
        results.push(&self.results);
        let mut command = Command::new(self.node);
        command.args(["--test", &format!("--test-concurrency={at_once}")]);
        command.args(["--test-reporter=spec", "--test-reporter-destination=stdout", "--test-reporter=tap"]);
        command.arg(results).args(files);
        command.env("MOTIFORM", &self.program);
        for (name, value) in &self.environment {
            command.env(name, value);
        }
        command
    }
}

/// The names of the failed tests in a list of results (TAP 13 as Node writes it), and their files, sorted.
fn failed(results: &str) -> (Vec<String>, Vec<PathBuf>) {
    let (mut tests, mut files) = (Vec::new(), BTreeSet::new());
    let mut open = false;
    for line in results.lines() {
        if let Some(name) = line.trim_start().strip_prefix("not ok ") {
            tests.push(name.split_once(" - ").map_or(name, |(_, name)| name).to_owned());
            open = true;
        } else if let Some(place) = line.trim_start().strip_prefix("location: '").filter(|_| open) {
            // file:line:column'
            files.extend(place.trim_end_matches('\'').rsplitn(3, ':').nth(2).map(PathBuf::from));
            open = false;
        }
    }
    (tests, files.into_iter().collect())
}

#[cfg(test)]
mod tests {
    use super::failed;
    use std::path::Path;

    #[test]
    fn failures_are_read_from_results() {
        let results = "TAP version 13\n# Subtest: a\nok 1 - a\n  ---\n  location: '/w/a.test.mjs:3:1'\n  ...\n\
                       not ok 2 - b - c\n  ---\n  duration_ms: 8\n  location: '/w/b.test.mjs:129:1'\n  ...\n";
        let (tests, files) = failed(results);
        assert_eq!(tests, ["b - c"]);
        assert_eq!(files, [Path::new("/w/b.test.mjs")]);
    }
}
