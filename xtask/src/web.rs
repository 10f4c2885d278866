//! The page without a server: the WebAssembly module, the folder `docs/site` for any static host, and the
//! page as one file. All of it is built, for a release and for the tests, and nothing of it is committed.

use crate::explorer::{node, npm};
use crate::{cargo_command, root, step, sysroot};
use anyhow::{Result, bail};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";

/// The remedy where the module cannot be built.
const REMEDY: &str = "the module needs Rust's standard library for WebAssembly: run `rustup target add wasm32-unknown-unknown`";

/// The path of the page as one file, in the checkout.
pub(crate) const ONE_FILE: &str = "target/motiform.html";

/// The folder for a static host, in the checkout.
pub(crate) const SITE: &str = "docs/site";

/// Builds all of it.
pub(crate) fn run() -> Result<()> {
    let root = root()?.canonicalize()?;
    let web = root.join("crates/apps/explorer/web");
    if !is_installed()? {
        bail!(REMEDY);
    }
    let node = node(&root)?;
    npm("page dependencies", &node, &web, &["ci", "--no-audit", "--no-fund"])?;
    let module = site(&node, &root, &web, "web")?;
    let (site, file) = (root.join(SITE), root.join(ONE_FILE));
    tool(&node, &web, "file", [&site, &file])?;
    for path in [&module, &site.join("motiform.wasm.gz"), &file] {
        eprintln!("{}: {} bytes", path.display(), path.metadata()?.len());
    }
    Ok(())
}

/// Builds the folder for the tests, in the profile of the program, which takes less time than that of what is given away. Says so where
/// this machine cannot.
pub(crate) fn for_tests(node: &Path, root: &Path, web: &Path) -> Result<()> {
    if is_installed()? {
        site(node, root, web, "release")?;
    } else {
        eprintln!("== page without a server: NOT TESTED; {REMEDY}");
    }
    Ok(())
}

/// Builds the folder; the module that is in it, compressed.
fn site(node: &Path, root: &Path, web: &Path, profile: &str) -> Result<PathBuf> {
    let (module, site) = (module(root, profile)?, root.join(SITE));
    page(node, web, &site)?;
    tool(node, web, "pack", [&module, &site])?;
    Ok(module)
}

/// Returns `true` if the standard library for WebAssembly is installed.
pub(crate) fn is_installed() -> Result<bool> {
    Ok(sysroot()?.join("lib/rustlib").join(TARGET).join("lib").is_dir())
}

/// Builds the module. No path of this machine is in it: its bytes do not depend on where the sources lie.
fn module(root: &Path, profile: &str) -> Result<PathBuf> {
    let home = std::env::home_dir().unwrap_or_default();
    let cargo = std::env::var_os("CARGO_HOME").map_or_else(|| home.join(".cargo"), PathBuf::from);
    let target = root.join("target");
    let mut flags = OsString::new();
    // Of several prefixes the last one that fits is taken. A folder of the registry is named by its host.
    let mut prefixes = vec![(root.to_owned(), "motiform"), (cargo.clone(), "cargo")];
    for folder in fs::read_dir(cargo.join("registry/src"))? {
        prefixes.push((folder?.path(), "registry"));
    }
    for (path, name) in prefixes {
        flags.push("--remap-path-prefix=");
        flags.push(path);
        flags.push(format!("={name}\x1f"));
    }
    flags.push("-Ctarget-feature=+simd128");
    let mut build = cargo_command();
    build.args([
        "rustc",
        "--profile",
        profile,
        "--target",
        TARGET,
        "-p",
        "motiform-explorer",
        "--no-default-features",
    ]);
    build.args(["--lib", "--crate-type", "cdylib"]);
    build.env("CARGO_ENCODED_RUSTFLAGS", flags).env("CARGO_TARGET_DIR", &target);
    step("module", &mut build)?;
    Ok(target.join(TARGET).join(profile).join("motiform_explorer.wasm"))
}

/// Builds the page without a server into a folder.
fn page(node: &Path, web: &Path, folder: &Path) -> Result<()> {
    let mut vite = Command::new(node);
    vite.arg(web.join("node_modules/vite/bin/vite.js")).arg("build").arg(web);
    vite.arg("--config").arg(web.join("vite.site.config.js"));
    step("page without a server", vite.arg("--outDir").arg(folder).arg("--emptyOutDir"))
}

fn tool(node: &Path, web: &Path, task: &str, arguments: [&PathBuf; 2]) -> Result<()> {
    step(task, Command::new(node).arg(web.join("site.mjs")).arg(task).args(arguments))
}
