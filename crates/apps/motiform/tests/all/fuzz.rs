//! A sample of damaged command lines, each given to the program itself: it ends with a word and a known exit code. Far more of them are
//! parsed in the process (`src/args/fuzz.rs`).

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;
#[path = "../../../../lab/lab/tests/all/common/mutate.rs"]
mod mutate;

use common::Folder;
use mutate::{Mutator, cases};
use std::time::{Duration, Instant};

/// None of them computes for long, nor do their mutations: `check` and `models` compute nothing, and runs are short.
const LINES: [&str; 10] = [
    "check fig1.toml",
    "check tensor --preset fig4",
    "models tensor",
    "models --json",
    "simulate tensor --preset fig5a --t-end 1 --transient 0 --max-steps 100 --json",
    "simulate cell --set length=14 --t-end 0.1 --transient 0 --max-steps 10 --json",
    "classify tensor --set gamma=0.5 --budget 1 --json",
    "lyapunov tensor --preset fig5b --count 1 --transient 0 --t-end 0.1 --json",
    "figure nothing",
    "merge a b --out c",
];

#[test]
fn command_lines() {
    let folder = Folder::new();
    let mut random = Mutator::new(30);
    let count = cases(600).min(2000); // each starts a process
    for case in 0..count {
        let line =
            String::from_utf8_lossy(&random.mutate(LINES[case % LINES.len()].as_bytes())).replace('\0', " ");
        if line.len() > 100_000 || line.split_whitespace().next().is_none_or(|word| word.starts_with('e')) {
            continue; // longer than the system allows; `explore` serves until it is told to stop
        }
        let begun = Instant::now();
        let done = folder.run(&line);
        assert!(matches!(done.code, Some(0..=2)), "{line:?}: {:?} {}", done.code, done.stderr);
        assert!(!done.stderr.contains("panicked"), "{line:?}: {}", done.stderr);
        assert!(begun.elapsed() < Duration::from_secs(60), "{line:?} took {:?}", begun.elapsed());
    }
    let stray: Vec<String> = folder.names().into_iter().filter(|name| name.starts_with('.')).collect();
    assert!(stray.is_empty(), "{stray:?}");
}
