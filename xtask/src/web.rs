//! The page without a server: the WebAssembly module, the folder `docs/site` for any static host, and the page as one file.

use crate::explorer::{contents, node, npm};
use crate::{cargo_command, root, step};
use anyhow::{Context, Result, bail};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";

/// The compiler that built the committed module: another one gives other bytes.
const COMPILER: &str = "compiler.txt";

/// Builds all of it.
pub(crate) fn run() -> Result<()> {
    let root = root()?.canonicalize()?;
    let web = root.join("crates/explorer/web");
    if !is_installed()? {
        bail!("the module needs Rust's standard library for WebAssembly: run `rustup target add {TARGET}`");
    }
    let node = node(&root)?;
    npm("page dependencies", &node, &web, &["ci", "--no-audit", "--no-fund"])?;
    let module = module(&root)?;
    let site = root.join("docs/site");
    page(&node, &web, &site)?;
    tool(&node, &web, "pack", [&module, &site])?;
    fs::write(site.join(COMPILER), compiler()?)?;
    let file = root.join("target/motiform.html");
    tool(&node, &web, "file", [&site, &file])?;
    for path in [&module, &site.join("motiform.wasm.gz"), &file] {
        eprintln!("{}: {} bytes", path.display(), path.metadata()?.len());
    }
    Ok(())
}

/// Compares the committed folder with its sources: the page always, the module where this machine can build it with the same compiler.
pub(crate) fn compare(node: &Path, root: &Path, web: &Path) -> Result<()> {
    let (site, built) = (root.join("docs/site"), root.join("target/site"));
    page(node, web, &built)?;
    let ours =
        |(path, _): &(PathBuf, Vec<u8>)| path != Path::new("motiform.wasm.gz") && path != Path::new(COMPILER);
    let committed: Vec<_> = contents(&site)?.into_iter().filter(ours).collect();
    if contents(&built)? != committed {
        bail!("the page in docs/site is not what its sources give: run `cargo xtask web` and commit");
    }
    let (here, there) = (compiler()?, fs::read_to_string(site.join(COMPILER))?);
    if !is_installed()? {
        eprintln!("== module: not compared, {TARGET} is not installed (`rustup target add {TARGET}`)");
    } else if here != there {
        eprintln!("== module: not compared, it was built by {}, this is {}", there.trim(), here.trim());
    } else {
        let module = module(root)?;
        tool(node, web, "same", [&module, &site])?;
    }
    Ok(())
}

/// Whether the standard library for WebAssembly is there.
fn is_installed() -> Result<bool> {
    let sysroot = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    Ok(Path::new(sysroot.trim()).join("lib/rustlib").join(TARGET).join("lib").is_dir())
}

/// The compiler, as it names itself.
fn compiler() -> Result<String> {
    output(Command::new("rustc").arg("--version"))
}

fn output(command: &mut Command) -> Result<String> {
    let output = command.output().context("rustc could not be started")?;
    Ok(String::from_utf8(output.stdout)?)
}

/// Builds the module. No path of this machine is in it: its bytes do not depend on where the sources lie.
fn module(root: &Path) -> Result<PathBuf> {
    let home = std::env::home_dir().unwrap_or_default();
    let cargo = std::env::var_os("CARGO_HOME").map_or_else(|| home.join(".cargo"), PathBuf::from);
    let target = root.join("target/web");
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
    build.args(["build", "--profile", "web", "--target", TARGET, "-p", "motiform-web"]);
    build.env("CARGO_ENCODED_RUSTFLAGS", flags).env("CARGO_TARGET_DIR", &target);
    step("module", &mut build)?;
    Ok(target.join(TARGET).join("web/motiform_web.wasm"))
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
