//! The page of `motiform explore`: comparison of the committed page with its sources, and tests in real browsers.

use crate::browser::{Browser, Environment};
use crate::{cargo, root, step, web};
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The oldest Node that builds and tests the page, as in `package.json`.
const NODE: (u32, u32) = (20, 19);

const CHROMIUM: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

const FIREFOX: [&str; 2] = ["firefox-esr", "firefox"];

/// The tests of the page without a server, and of its module.
const OF_MODULE: [&str; 2] = ["alone.test.mjs", "module.test.mjs"];

/// The tests that run in Firefox, too: the page without a server, and swarms. `cargo xtask firefox` runs all
/// files there.
const IN_FIREFOX: [&str; 2] = ["alone.test.mjs", "swarm.test.mjs"];

/// The page: the checkout, its folder there, and the Node that builds and tests it.
struct Page {
    root: PathBuf,
    folder: PathBuf,
    node: PathBuf,
}

impl Page {
    fn new() -> Result<Self> {
        let root = root()?.canonicalize()?;
        Ok(Self { folder: root.join("crates/apps/explorer/web"), node: node(&root)?, root })
    }

    /// Builds the page, compares it with the committed one, and builds the page without a server.
    fn build(&self) -> Result<()> {
        npm("page dependencies", &self.node, &self.folder, &["ci", "--no-audit", "--no-fund"])?;
        compare(&self.node, &self.root, &self.folder)?;
        web::for_tests(&self.node, &self.root, &self.folder)
    }

    /// Runs these test files, as far as they can be run, in a browser.
    fn test(&self, browser: Environment, is_wanted: impl Fn(&Path) -> bool) -> Result<()> {
        let mut files = files(&self.folder.join("tests"), web::is_installed()?)?;
        files.retain(|file| is_wanted(file));
        Browser::new(&self.node, browser, binary(&self.root)).test(&files)
    }
}

/// Builds the program and its page, and tests the page in Chromium, and in part in Firefox.
pub(crate) fn test() -> Result<()> {
    cargo("program", &["build", "--release", "--workspace"])?;
    build()?;
    test_in_chromium()?;
    test_part_in_firefox()
}

/// Builds the page, compares it with the committed one, and builds the page without a server.
pub(crate) fn build() -> Result<()> {
    Page::new()?.build()
}

/// Tests the page that was built last, of the program that was built last.
pub(crate) fn test_in_chromium() -> Result<()> {
    Page::new()?.test(chromium()?, |_| true)
}

/// The same in Firefox, with the files of which each push runs the tests there.
pub(crate) fn test_part_in_firefox() -> Result<()> {
    Page::new()?.test(firefox()?, |file| IN_FIREFOX.iter().any(|name| file.ends_with(name)))
}

/// Builds all, and runs all tests of the page in Firefox; those that ask for what Firefox does not offer its drivers are skipped, with the
/// reason.
pub(crate) fn test_in_firefox() -> Result<()> {
    cargo("program", &["build", "--release", "--workspace"])?;
    build()?;
    Page::new()?.test(firefox()?, |_| true)
}

fn chromium() -> Result<Environment> {
    Ok([("BROWSER", "chromium".into()), ("CHROMIUM", browser("CHROMIUM", "Chromium", &CHROMIUM)?)])
}

fn firefox() -> Result<Environment> {
    Ok([("BROWSER", "firefox".into()), ("FIREFOX", browser("FIREFOX", "Firefox", &FIREFOX)?)])
}

/// Builds the page beside the committed one: they must agree byte by byte, since programs are built without Node.
fn compare(node: &Path, root: &Path, web: &Path) -> Result<()> {
    npm("page types", node, web, &["run", "check"])?;
    let built = root.join("target/page");
    let mut vite = Command::new(node);
    vite.arg(web.join("node_modules/vite/bin/vite.js")).arg("build").arg(web);
    step("page", vite.arg("--outDir").arg(&built).arg("--emptyOutDir"))?;
    let committed = root.join("crates/apps/explorer/page");
    if contents(&built)? != contents(&committed)? {
        bail!(
            "the page in crates/apps/explorer/page is not what web/ gives: \
             run `npm run build` in crates/apps/explorer/web and commit"
        );
    }
    Ok(())
}

/// Names and bytes of the files of a folder, sorted.
fn contents(folder: &Path) -> Result<Vec<(PathBuf, Vec<u8>)>> {
    let mut all = Vec::new();
    for path in list(folder)? {
        let bytes = std::fs::read(&path).with_context(|| path.display().to_string())?;
        all.push((path.file_name().unwrap_or_default().into(), bytes));
    }
    all.sort();
    Ok(all)
}

/// The test files, sorted: Node 20 does not support patterns. Those of the page without a server only where it is there.
fn files(folder: &Path, alone: bool) -> Result<Vec<PathBuf>> {
    let mut all = list(folder)?;
    all.retain(|path| path.to_string_lossy().ends_with(".test.mjs"));
    all.retain(|path| alone || !OF_MODULE.iter().any(|name| path.ends_with(name)));
    all.sort();
    Ok(all)
}

fn list(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    entries.map(|entry| Ok(entry?.path())).collect()
}

/// The program that was just built, also if `CARGO_TARGET_DIR` points elsewhere.
fn binary(root: &Path) -> PathBuf {
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |dir| root.join(dir));
    target.join("release").join(format!("motiform{}", std::env::consts::EXE_SUFFIX))
}

/// Runs npm with this Node, in the folder of the page.
pub(crate) fn npm(name: &str, node: &Path, web: &Path, arguments: &[&str]) -> Result<()> {
    let mut path = node.parent().map(Path::to_path_buf).into_iter().collect::<Vec<_>>();
    path.extend(std::env::split_paths(&std::env::var_os("PATH").unwrap_or_default()));
    let mut command = Command::new("npm");
    command.arg("--prefix").arg(web).args(arguments).env("PATH", std::env::join_paths(path)?);
    step(name, &mut command)
}

/// A Node that is new enough: that of the path or of the system's packages, or one that npm brings.
pub(crate) fn node(root: &Path) -> Result<PathBuf> {
    if !works("node") || !works("npm") {
        install(&["nodejs", "npm"], "Node 20.19 or later with npm")?;
    }
    let prefix = root.join("target/node");
    let own = prefix.join("node_modules/node/bin/node");
    if let Some(found) = recent(Path::new("node")).or_else(|| recent(&own)) {
        return Ok(found);
    }
    let arguments = ["install", "--no-save", "--no-audit", "--no-fund", "node@22"];
    step("node", Command::new("npm").arg("--prefix").arg(&prefix).args(arguments))?;
    recent(&own).context("Node 20.19 or later is needed: install it from nodejs.org")
}

/// The full path of this Node, if it is new enough.
fn recent(node: &Path) -> Option<PathBuf> {
    let script = "console.log(process.version.slice(1) + ' ' + process.execPath)";
    let output = Command::new(node).args(["-e", script]).stderr(Stdio::null()).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let (version, path) = text.trim().split_once(' ')?;
    let mut numbers = version.split('.').map(str::parse::<u32>);
    let found = (numbers.next()?.ok()?, numbers.next()?.ok()?);
    (found >= NODE).then(|| path.into())
}

/// A browser: that of its variable, of the path, or of the system's packages.
fn browser(variable: &str, what: &str, names: &[&str]) -> Result<PathBuf> {
    if let Some(given) = std::env::var_os(variable) {
        return Ok(given.into());
    }
    let known = || names.iter().find_map(|name| on_path(name));
    if let Some(found) = known() {
        return Ok(found);
    }
    install(&names[..1], what)?;
    known().with_context(|| format!("{what} is needed: install it, or name it in {variable}"))
}

/// The file that a bare name starts.
fn on_path(name: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|folder| folder.join(name)).find(|file| file.is_file())
}

/// Returns `true` if a program can be started at all.
fn works(name: &str) -> bool {
    let mut command = Command::new(name);
    command.arg("--version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// Installs Debian packages as root; otherwise, or on other systems, reports what is missing.
fn install(packages: &[&str], what: &str) -> Result<()> {
    let root = Command::new("id").arg("-u").output().is_ok_and(|output| output.stdout == b"0\n");
    if !root || !works("apt-get") {
        bail!(
            "{what} is needed for the tests of the page: install it (Debian: apt-get install {})",
            packages.join(" ")
        );
    }
    step("package lists", Command::new("apt-get").arg("update"))?;
    let arguments = ["install", "-y", "--no-install-recommends"];
    step("packages", Command::new("apt-get").args(arguments).args(packages))
}
