//! The documents: their commands and pictures, and the book that is built from them.

use crate::python::environment;
use crate::{cargo_command, step};
use anyhow::Result;
use std::process::Command;

/// The folder in which the book is built.
const BOOK: &str = "target/book";

/// Runs every command of the documents, also the slow ones, and compares the pictures.
pub(crate) fn documents() -> Result<()> {
    step("documents", test().args(["--", "--nocapture"]).env("MOTIFORM_DOCUMENTS", "1"))
}

/// Runs every command of the documents, and renews the pictures that they make.
pub(crate) fn pictures() -> Result<()> {
    let mut test = test();
    test.args(["--", "--nocapture"]).env("MOTIFORM_DOCUMENTS", "1").env("MOTIFORM_UPDATE", "1");
    step("pictures", &mut test)
}

fn test() -> Command {
    let mut test = cargo_command();
    test.args(["test", "--release", "--package", "motiform", "--test", "all", "documents::"]);
    test
}

/// Builds the book; a page outside the table of contents, a broken link or anchor is an error.
pub(crate) fn build() -> Result<()> {
    let python = environment("target/python")?;
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "mkdocs>=1.6,<2"];
    step("book builder", Command::new(&python).args(install))?;
    let build = ["-m", "mkdocs", "build", "--quiet", "--strict", "--site-dir", BOOK];
    step("book", Command::new(&python).args(build))
}
