//! Everything that commands print and write, to the byte: `golden/*.txt` lists commands and the digest of each of their outputs. A
//! change that moves one is named in CHANGELOG.md; `MOTIFORM_UPDATE=1 cargo test --release -p motiform --test all golden` renews the
//! digests.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(target_os = "linux")]

use crate::common::Folder;
use crate::ownership::tree;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

/// The commands that belong to one subject.
fn list(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("tests/all/golden/{name}.txt"))
}

/// FNV-1a.
fn digest(bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

/// The commands of a line, one after another in one folder, and the digests of what they print and of what is there at the end.
fn outputs(line: &str) -> String {
    let folder = Folder::new();
    folder.write("cells.csv", &crate::fits::outlines(1));
    folder.write("cells.xml", include_str!("../../../../../examples/cells.xml"));
    let before = tree(&folder.path(""));
    let mut text = format!("{line}\n");
    for words in line.split(" && ") {
        let done = folder.run(words);
        writeln!(text, "  {:016x} {:?}", digest(done.stdout.as_bytes()), done.code.unwrap()).unwrap();
    }
    for (path, (_, bytes)) in tree(&folder.path("")) {
        if !before.contains_key(&path) {
            writeln!(text, "  {:016x} {}", digest(&bytes), path.display()).unwrap();
        }
    }
    text
}

/// Runs the commands of a list, and compares or renews it.
fn compare(name: &str) {
    let path = list(name);
    let recorded = fs::read_to_string(&path).unwrap();
    let commands = recorded.lines().filter(|line| !line.starts_with(' '));
    let found: String = commands.map(outputs).collect();
    if std::env::var_os("MOTIFORM_UPDATE").is_some() {
        return fs::write(path, found).unwrap();
    }
    let moved = difference(&recorded, &found);
    assert!(moved.is_empty(), "outputs moved:\n{}", moved.join("\n"));
}

/// The lines of either text that the other has not below the same command, with the command before them.
fn difference(recorded: &str, found: &str) -> Vec<String> {
    let [recorded, found] = [recorded, found].map(blocks);
    let lacks = |lines: &[&str], line: &&&str| !lines.contains(*line);
    let mut moved = Vec::new();
    for ((command, before), (_, after)) in recorded.iter().zip(&found) {
        let gone = before.iter().filter(|line| lacks(after, line)).map(|line| format!("  recorded {line}"));
        let new = after.iter().filter(|line| lacks(before, line)).map(|line| format!("  found    {line}"));
        let lines: Vec<String> = gone.chain(new).collect();
        if !lines.is_empty() {
            moved.push((*command).to_owned());
            moved.extend(lines);
        }
    }
    moved
}

/// Commands with the lines below each.
fn blocks(text: &str) -> Vec<(&str, Vec<&str>)> {
    let mut blocks: Vec<(&str, Vec<&str>)> = Vec::new();
    for line in text.lines() {
        match (line.strip_prefix("  "), blocks.last_mut()) {
            (Some(output), Some((_, outputs))) => outputs.push(output),
            _ => blocks.push((line, Vec::new())),
        }
    }
    blocks
}

#[test]
fn outputs_of_simulations_are_those_recorded() {
    compare("simulations");
}

#[test]
fn outputs_of_names_are_those_recorded() {
    compare("names");
}

#[test]
fn outputs_of_studies_are_those_recorded() {
    compare("studies");
}

#[test]
fn outputs_of_cells_are_those_recorded() {
    compare("cells");
}

#[test]
fn a_digest_that_moved_is_named() {
    let recorded = "simulate a\n  01 0\n  02 path.svg\nmodels\n  03 0\n";
    let found = "simulate a\n  01 0\n  04 path.svg\nmodels\n  03 0\n";
    assert_eq!(
        difference(recorded, found),
        ["simulate a", "  recorded 02 path.svg", "  found    04 path.svg"]
    );
    assert!(difference(recorded, recorded).is_empty());
}
