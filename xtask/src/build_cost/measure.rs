//! Cargo in empty folders, and what it costs.

use crate::cargo_command;
use anyhow::{Context, Result, bail};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The cost of a build.
pub(crate) struct Cost {
    /// Elapsed.
    pub(crate) seconds: f64,
    /// Of all its processes.
    pub(crate) cpu_seconds: f64,
    /// Its units with their seconds, the longest first; none if it was not asked for them.
    pub(crate) units: Vec<(String, f64)>,
}

/// Ticks per second of the process table on Linux.
const TICKS: f64 = 100.0;

/// Runs cargo from an empty cargo folder into an empty target folder, both removed afterwards. `{}` in an
/// argument is a folder for its output.
pub(crate) fn cold(root: &Path, arguments: &[&str]) -> Result<Cost> {
    let folder = std::env::temp_dir().join(format!("motiform-build-cost-{}", std::process::id()));
    fs::create_dir(&folder).with_context(|| format!("{} must not exist", folder.display()))?;
    let cost = cold_in(root, &folder, arguments);
    fs::remove_dir_all(&folder)?;
    cost
}

fn cold_in(root: &Path, folder: &Path, arguments: &[&str]) -> Result<Cost> {
    let [home, target] = ["cargo", "target"].map(|name| folder.join(name));
    fs::create_dir(&home)?;
    // Registries that this machine is told to use.
    for name in ["config.toml", "credentials.toml"] {
        let own = cargo_home().join(name);
        if own.is_file() {
            fs::copy(own, home.join(name))?;
        }
    }
    let place = folder.display().to_string();
    let mut command = cargo_command();
    command.args(arguments.iter().map(|argument| argument.replace("{}", &place)));
    command
        .env("CARGO_HOME", &home)
        .env("CARGO_TARGET_DIR", &target)
        .env_remove("RUSTFLAGS")
        .current_dir(root);
    let (begin, before) = (Instant::now(), cpu_of_children()?);
    if !command.status()?.success() {
        bail!("cargo {} failed", arguments.join(" "));
    }
    let (seconds, cpu_seconds) = (begin.elapsed().as_secs_f64(), cpu_of_children()? - before);
    Ok(Cost { seconds, cpu_seconds, units: units(&target.join("cargo-timings/cargo-timing.html"))? })
}

/// The cargo folder of this user.
fn cargo_home() -> PathBuf {
    let home = || std::env::home_dir().unwrap_or_default().join(".cargo");
    std::env::var_os("CARGO_HOME").map_or_else(home, PathBuf::from)
}

/// CPU seconds, user and system, of all processes that this one has waited for, with theirs.
fn cpu_of_children() -> Result<f64> {
    let path = "/proc/self/stat";
    let stat = fs::read_to_string(path).context("CPU seconds are read on Linux only")?;
    // After the name, which may contain anything, in brackets: state, and eleven numbers before utime, stime, cutime, cstime.
    let (_, rest) = stat.rsplit_once(')').context(path)?;
    let ticks: Option<f64> =
        rest.split_whitespace().skip(13).take(2).map(|text| text.parse::<f64>().ok()).sum();
    Ok(ticks.context(path)? / TICKS)
}

/// The units of a build from cargo's own report; none if there is no report.
fn units(report: &Path) -> Result<Vec<(String, f64)>> {
    let Ok(page) = fs::read_to_string(report) else { return Ok(Vec::new()) };
    let marker = "const UNIT_DATA = ";
    let (_, rest) = page.split_once(marker).context("cargo's report of timings has another form")?;
    let json = rest.split_once("];").context("cargo's report of timings has another form")?.0;
    let data: Vec<serde_json::Value> = serde_json::from_str(&format!("{json}]"))?;
    let unit = |unit: &serde_json::Value| {
        let target = unit["target"].as_str().unwrap_or_default();
        let version = unit["version"].as_str().unwrap_or_default();
        let name = unit["name"].as_str()?;
        let name = if name.starts_with("motiform") { name.to_owned() } else { format!("{name} {version}") };
        Some((format!("{name}{target}"), unit["duration"].as_f64()?))
    };
    let mut units: Vec<_> = data.iter().filter_map(unit).collect();
    units.sort_by(|a, b| b.1.total_cmp(&a.1));
    Ok(units)
}
