//! The Python package: built as users build it, and tested in a separate environment.

use crate::{root, step};
use anyhow::{Result, bail};
use std::path::PathBuf;
use std::process::Command;

/// Builds the package with everything its tests need into `target/python`, and runs its tests.
pub(crate) fn test() -> Result<()> {
    let python = environment("target/python")?;
    let install =
        ["-m", "pip", "install", "--quiet", "--no-compile", "--disable-pip-version-check", ".[test]"];
    // Crates with the features that they have in the whole workspace are not built again (crates/apps/python/Cargo.toml).
    let features = "--features workspace";
    step("python package", Command::new(&python).args(install).env("MATURIN_PEP517_ARGS", features))?;
    // Files stay together: what a file prepares is prepared once.
    step(
        "python tests",
        Command::new(&python).args(["-m", "pytest", "--numprocesses", "2", "--dist", "loadfile"]),
    )
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

#[cfg(test)]
mod tests {
    use crate::cargo_command;
    use std::collections::BTreeSet;

    /// Packages of others with their versions and features, as cargo builds them for these arguments.
    fn packages(arguments: &[&str]) -> BTreeSet<String> {
        let mut tree = cargo_command();
        tree.args(["tree", "--locked", "--prefix", "none", "--format", "{p} [{f}]"]).args(arguments);
        let output = tree.output().expect("cargo starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8(output.stdout).expect("UTF-8");
        let lines = text.lines().map(|line| line.trim_end_matches(" (*)").to_owned());
        lines.filter(|line| !line.starts_with("motiform")).collect()
    }

    /// Otherwise cargo builds half of the workspace once more for the package (crates/apps/python/Cargo.toml).
    #[test]
    fn the_package_is_built_from_what_the_tests_are_built_from() {
        let workspace = packages(&["--workspace", "--edges", "normal,build,dev"]);
        let package =
            packages(&["--package", "motiform-py", "--features", "workspace", "--edges", "normal,build"]);
        let others: Vec<&String> = package.difference(&workspace).collect();
        assert!(others.is_empty(), "the feature `workspace` of crates/apps/python asks for {others:?}");
    }
}
