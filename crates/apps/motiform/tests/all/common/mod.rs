//! The program, run in a fresh folder.
#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part")]
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

pub const PROGRAM: &str = env!("CARGO_BIN_EXE_motiform");

/// A folder of its own for each test, removed at the end.
pub struct Folder(TempDir);

/// The end of a run of the program.
pub struct Done {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Folder {
    pub fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    /// `motiform` with these words (no spaces in them), in this folder.
    pub fn command(&self, words: &str) -> Command {
        let mut command = Command::new(PROGRAM);
        command.args(words.split_whitespace()).current_dir(self.0.path());
        command.env_remove("CLICOLOR_FORCE").env_remove("COLUMNS"); // texts as they are in a file
        command
    }

    pub fn run(&self, words: &str) -> Done {
        self.command(words).output().unwrap().into()
    }

    /// Runs a line of bash in this folder, in which `$motiform` is the program.
    pub fn bash(&self, line: &str) -> Done {
        let mut bash = Command::new("bash");
        bash.args(["-c", line]).env("motiform", PROGRAM).current_dir(self.0.path());
        bash.output().unwrap().into()
    }

    /// Everything in the folder, hidden things too, sorted.
    pub fn names(&self) -> Vec<String> {
        names(self.0.path())
    }
}

/// Everything in a folder, hidden things too, sorted.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

impl From<Output> for Done {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

impl Done {
    /// Standard output as JSON, which must be the whole of it.
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap()
    }

    /// Checks the exit code; shows what the program said if it is another one.
    pub fn expect(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "stdout: {}\nstderr: {}", self.stdout, self.stderr);
        self
    }

    /// An error as people should meet it: said in one clear text on stderr, nothing on stdout, no trace of a panic.
    pub fn expect_error(self, code: i32) -> Self {
        let done = self.expect(code);
        assert!(done.stderr.starts_with("error: "), "{}", done.stderr);
        assert_eq!(done.stdout, "", "{}", done.stderr);
        for trace in ["panicked", "RUST_BACKTRACE", "stack backtrace"] {
            assert!(!done.stderr.contains(trace), "{}", done.stderr);
        }
        done
    }
}

/// The names of a JSON object's entries, in their order.
pub fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

/// A JSON file.
pub fn read_json(path: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}
