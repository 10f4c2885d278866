//! `motiform doctor`.

use crate::args::DoctorOptions;
use crate::output::{End, say};
use crate::progress::Progress;
use motiform_dynamics::simd::InstructionSet;
use motiform_lab::pool::all_cores;
use motiform_lab::samples::{self, Samples};
use motiform_models::ModelInfo;
use motiform_study::{Random, RunPlan, presets};
use serde::{Serialize, Serializer};
use serde_json::{Value, json};
use std::fmt::{Display, Formatter};
use std::process::{Command, Stdio};
use std::time::Instant;

/// Random starts of the preset that is timed.
const STARTS: usize = 1024;

/// A program that some commands call.
struct Helper {
    name: &'static str,
    programs: &'static [&'static str],
    arguments: &'static [&'static str],
    without: &'static str,
}

const HELPERS: [Helper; 3] = [
    Helper {
        name: "ffmpeg",
        programs: &["ffmpeg"],
        arguments: &["-version"],
        without: "not found: --film is not possible; animations are PNG (Debian: apt-get install ffmpeg)",
    },
    Helper {
        name: "browser",
        programs: &["xdg-open", "chromium", "firefox", "firefox-esr", "google-chrome"],
        arguments: &["--version"],
        without: "not found: `motiform explore` prints an address to open elsewhere on this machine",
    },
    Helper {
        name: "python",
        programs: &["python3", "python"],
        arguments: &["-c", "import motiform"],
        without: "the package motiform is not installed for it: `pip install .` in the clone",
    },
];

/// Says what this machine has, and times it.
pub(crate) fn run(options: &DoctorOptions) -> anyhow::Result<End> {
    let threads = all_cores();
    let Some(rates) = rates(threads)? else { return Ok(End::Interrupted) };
    let found = HELPERS.map(|helper| (helper.start(), helper));
    let (lanes, cores) = (lanes(), std::env::consts::ARCH);
    let helpers =
        found.iter().map(|(found, helper)| (helper.name, found.unwrap_or(helper.without))).collect();
    let programs = found.iter().map(|(found, helper)| (helper.name.to_owned(), json!(found))).collect();
    let [one_thread, all_threads] = rates;
    let motions_per_second = Rates { one_thread, all_threads };
    let version = env!("CARGO_PKG_VERSION");
    say(
        &Machine { version, processor: cores, lanes, threads, programs, motions_per_second, helpers },
        options.json,
    )?;
    Ok(End::Done)
}

/// The equipment of a machine.
#[derive(Serialize)]
struct Machine {
    version: &'static str,
    processor: &'static str,
    #[serde(serialize_with = "count")]
    lanes: (&'static str, u32),
    threads: usize,
    programs: serde_json::Map<String, Value>,
    motions_per_second: Rates,
    /// Helpers, and where they are or what is missing without them.
    #[serde(skip)]
    helpers: Vec<(&'static str, &'static str)>,
}

/// Motions named per second.
#[derive(Serialize)]
struct Rates {
    one_thread: f64,
    all_threads: f64,
}

/// The number of lanes alone.
fn count<S: Serializer>(lanes: &(&'static str, u32), serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_u32(lanes.1)
}

impl Display for Machine {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { version, processor, lanes: (name, lanes), threads, .. } = self;
        writeln!(f, "motiform    {version}")?;
        writeln!(f, "processor   {processor}, {name}: {lanes} orbits side by side; {threads} threads")?;
        for (name, what) in &self.helpers {
            writeln!(f, "{name:<11} {what}")?;
        }
        let Rates { one_thread, all_threads } = self.motions_per_second;
        write!(
            f,
            "speed       {one_thread:.0} motions named a second on one thread, {all_threads:.0} on all ({STARTS} random \
             starts of preset fig4)"
        )
    }
}

/// The instruction set of lanes, in words, and its number of lanes.
fn lanes() -> (&'static str, u32) {
    match InstructionSet::widest() {
        InstructionSet::Avx512 => ("AVX-512", 8),
        InstructionSet::Avx2 => ("AVX2", 4),
        InstructionSet::Neon => ("NEON", 4),
        InstructionSet::Simd128 => ("SIMD128", 4),
        InstructionSet::Portable => ("no vector instructions that are used", 1),
    }
}

/// Motions named per second on one thread and on all; `None` if it was stopped.
fn rates(threads: usize) -> anyhow::Result<Option<[f64; 2]>> {
    let plan = RunPlan::new(&presets::find(ModelInfo::find("tensor")?, "fig4")?)?;
    let watch = Progress::new(2.0 * STARTS as f64, "motions");
    let mut rates = [0.0; 2];
    for (rate, threads) in rates.iter_mut().zip([1, threads]) {
        let samples =
            Samples { count: STARTS, random: Random::basins(plan.info()?.size), given: false, threads };
        let began = Instant::now();
        if samples::classify(&plan, samples, 0.0, &watch)?.is_none() {
            return Ok(None);
        }
        *rate = STARTS as f64 / began.elapsed().as_secs_f64();
    }
    watch.finish();
    Ok(Some(rates))
}

impl Helper {
    /// The first of its programs that starts and does what is asked.
    fn start(&self) -> Option<&'static str> {
        let works = |program: &&&str| {
            let mut command = Command::new(program);
            command.args(self.arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
            command.status().is_ok_and(|status| status.success())
        };
        self.programs.iter().find(works).copied()
    }
}
