//! The Python package: built as users build it, and tested in a separate environment.

use crate::{root, step};
use anyhow::{Result, bail};
use std::path::PathBuf;
use std::process::Command;

/// Builds the package with everything its tests need into `target/python`, and runs them.
pub(crate) fn test() -> Result<()> {
    let python = environment("target/python")?;
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", ".[test]"];
    // Crates with the features that they have in the whole workspace are not built again (crates/python/Cargo.toml).
    let features = "--features workspace";
    step("python package", Command::new(&python).args(install).env("MATURIN_PEP517_ARGS", features))?;
    step("python tests", Command::new(&python).args(["-m", "pytest"]))
}

/// The interpreter of a virtual environment in this folder, created if it does not exist.
pub(crate) fn environment(folder: &str) -> Result<PathBuf> {
    let environment = root()?.canonicalize()?.join(folder);
    let python = environment.join("bin/python");
    if !python.exists() {
        let interpreter = interpreter()?;
        step("python environment", Command::new(interpreter).args(["-m", "venv"]).arg(&environment))?;
    }
    Ok(python)
}

/// A Python of version 3.10 or later: that of `PYTHON`, or `python3`.
fn interpreter() -> Result<String> {
    let name = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let check = "import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 10))";
    let found = Command::new(&name).args(["-c", check]).status();
    if !found.is_ok_and(|status| status.success()) {
        bail!("{name} is no Python of 3.10 or later with venv: install python3-venv, or name one in PYTHON");
    }
    Ok(name)
}
