//! Lints and documentation, with all features enabled, so that optional parts are checked too.

use crate::{cargo, cargo_command, step, sysroot};
use anyhow::Result;
use std::path::PathBuf;

const OPTIONS: [&str; 3] = ["--release", "--workspace", "--all-features"];

/// Both. Documentation needs every crate checked, which the lints did: with their compiler and arguments cargo takes what they left.
pub(crate) fn run() -> Result<()> {
    cargo("lints", &[&["clippy"], &OPTIONS[..], &["--all-targets", "--", "-D", "warnings"]].concat())?;
    let mut documentation = cargo_command();
    documentation.arg("doc").args(OPTIONS).args(["--no-deps", "--document-private-items"]);
    documentation.env("RUSTDOCFLAGS", "-D warnings");
    if let Some(compiler) = lints()? {
        // the arguments as `cargo clippy` hands them over; others only make it check once more
        documentation.env("RUSTC_WORKSPACE_WRAPPER", compiler);
        documentation.env("CLIPPY_ARGS", "-D__CLIPPY_HACKERY__warnings__CLIPPY_HACKERY__");
    }
    step("documentation", &mut documentation)
}

/// The compiler of the lints, if it is where rustup puts it.
fn lints() -> Result<Option<PathBuf>> {
    Ok(Some(sysroot()?.join("bin").join(format!("clippy-driver{}", std::env::consts::EXE_SUFFIX)))
        .filter(|path| path.is_file()))
}
