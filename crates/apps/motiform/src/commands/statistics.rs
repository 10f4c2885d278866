//! `motiform statistics`.

use crate::args::{StatisticsOptions, SubjectOptions};
use crate::commands::remarks::remark;
use crate::commands::subject;
use crate::output::{End, plain, say, warn};
use crate::progress::Progress;
use motiform_dynamics::Watch;
use motiform_lab::statistics::{
    Measurement, SIMULATED, coarser_than_own, read, samples_apart, sentences, simulated_kept, summary, write,
};
use motiform_statistics::Settings;
use motiform_store::{Folder, Journal};
use motiform_study::{Error, RunPlan, Shown, Study};
use serde::{Serialize, Serializer};
use std::fmt::{Display, Formatter};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Bodies, if their number is not given.
const BODIES: u64 = 100;

pub(crate) fn run(options: &StatisticsOptions) -> anyhow::Result<End> {
    let remedy = "figures are drawn into a folder: give --out DIR, or leave it out";
    options.style.refuse_unless(options.folder.out.is_some(), remedy)?;
    let datasets = !options.subjects.is_empty() && options.subjects.iter().all(|path| is_dataset(path));
    let mut units = options.units.or("")?;
    let (folder, found) = if datasets {
        (open(options, None)?, recorded(options).map(Some))
    } else {
        let (mut study, count) = (study(options)?, options.bodies.unwrap_or(BODIES));
        units = options.units.of(&mut study)?;
        let folder = open(options, Some((&RunPlan::new(&study)?, count)))?;
        let found = bodies(options, &study, count, folder.as_ref());
        (folder, found)
    };
    let found = match found {
        Ok(Some(found)) => found,
        Ok(None) => {
            folder.iter().try_for_each(Folder::settle)?;
            warn("interrupted: no body was finished");
            return Ok(End::Interrupted);
        }
        Err(error) => {
            folder.into_iter().for_each(Folder::abandon);
            return Err(error);
        }
    };
    if let Some(folder) = &folder {
        write(&found, &options.style.format_in(units.clone()), folder).map_err(plain_error)?;
        folder.notes().iter().for_each(|note| warn(note));
        if !found.complete {
            warn(
                "interrupted: the finished bodies are kept; the same `motiform statistics` with --resume goes on",
            );
        }
    }
    let written = folder.as_ref().map(Folder::shown);
    say(&Measured { found: &found, written, units: &units }, options.json)?;
    found.notes.iter().for_each(|note| warn(note));
    Ok(if found.complete { End::Done } else { End::Interrupted })
}

fn is_dataset(path: &Path) -> bool {
    path.is_dir()
}

/// The bodies of dataset folders.
fn recorded(options: &StatisticsOptions) -> anyhow::Result<Measurement> {
    let given = [
        ("--bodies", options.bodies.is_some()),
        ("--preset", options.preset.is_some()),
        ("--set", !options.parameters.set.is_empty()),
        ("--tie", !options.parameters.ties.is_empty()),
        ("--initial", !options.method.initial.is_empty()),
        ("--random", options.method.random.is_some()),
        ("--resume", options.folder.resume),
    ];
    let option = given.into_iter().find(|(_, given)| *given).map(|(key, _)| key);
    let mut settings_given = options.run.names().chain(options.method.run.names());
    if let Some(key) = option.or_else(|| settings_given.find(|name| *name != "transient")) {
        let remedy = "datasets are recorded already: leave it out, or give a model or a study";
        return Err(Error::Setting { key, value: "given".into(), remedy }.into());
    }
    let transient = options.run.get("transient").and_then(serde_json::Value::as_f64).unwrap_or(0.0);
    read(&options.subjects, transient, &settings(options)).map_err(plain_error)
}

/// Opens the output before any computing.
fn open(options: &StatisticsOptions, bodies: Option<(&RunPlan, u64)>) -> Result<Option<Folder>, Error> {
    let Some(out) = &options.folder.out else { return Ok(None) };
    let folder = motiform_lab::statistics::open(out, options.folder.opening(), bodies)?;
    folder.notes().iter().for_each(|note| warn(note));
    Ok(Some(folder))
}

/// Bodies that are simulated; `None` if none was finished before an interruption.
fn bodies(
    options: &StatisticsOptions,
    study: &Study,
    count: u64,
    folder: Option<&Folder>,
) -> anyhow::Result<Option<Measurement>> {
    let threads = options.threads.count();
    let journal: &dyn Journal = folder.map_or(&(), |folder| folder);
    let watch = Stages::begin();
    let found = simulated_kept(study, usize::try_from(count)?, &settings(options), threads, journal, &watch);
    watch.progress.finish();
    match found {
        Err(motiform_lab::statistics::Error::Study(Error::Interrupted)) => Ok(None),
        found => found.map(Some).map_err(plain_error),
    }
}

/// The progress of the bodies, then of their statistics.
struct Stages {
    progress: Progress,
    /// `true` from when the bodies are computed.
    measuring: AtomicBool,
}

impl Stages {
    fn begin() -> Self {
        let progress = Progress::staged(2);
        progress.stage("bodies", [0.0, SIMULATED], "done", true);
        Self { progress, measuring: AtomicBool::new(false) }
    }
}

impl Watch for Stages {
    fn progress(&self, done: f64) {
        if done > SIMULATED && !self.measuring.swap(true, Ordering::Relaxed) {
            self.progress.stage("statistics", [SIMULATED, 1.0], "done", true);
        }
        self.progress.progress(done);
    }

    fn stopped(&self) -> bool {
        self.progress.stopped()
    }

    fn note(&self, text: &str) {
        self.progress.note(text);
    }
}

fn study(options: &StatisticsOptions) -> Result<Study, Error> {
    let ([] | [_]) = &options.subjects[..] else {
        let list: Vec<_> = options.subjects.iter().map(|path| path.display().to_string()).collect();
        let remedy = "give one model or study, or only folders written by `motiform simulate`";
        return Err(Error::Setting { key: "subject", value: list.join(" "), remedy });
    };
    let subject = options.subjects.first().map(|path| path.to_string_lossy().into_owned());
    let (preset, parameters) = (options.preset.clone(), options.parameters.clone());
    let subject = SubjectOptions { subject, preset, parameters };
    let mut study = subject::study(&subject)?;
    subject::apply(&options.method, &mut study)?;
    let own = study.run.clone();
    options.run.record(&mut study.run)?;
    if options.run.get("t_end").is_some() && options.run.get("dt_out").is_none() {
        study.run.dt_out = samples_apart(&own, study.run.t_end, options.bodies.unwrap_or(BODIES));
        coarser_than_own(&own, study.run.dt_out).iter().for_each(|note| warn(note));
    }
    remark(&study, &[])?;
    Ok(study)
}

fn settings(options: &StatisticsOptions) -> Settings {
    Settings { radii: options.radius.clone(), threshold: options.threshold.clone() }
}

/// The statistics of a motion.
struct Measured<'a> {
    found: &'a Measurement,
    written: Option<&'a Path>,
    units: &'a Shown,
}

impl Serialize for Measured<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        summary(self.found).serialize(serializer)
    }
}

impl Display for Measured<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.write_str(&plain(&self.found.title))?;
        for (label, sentence) in sentences(self.found, self.units) {
            write!(f, "\n{label:<12} {sentence}")?;
        }
        self.written.map_or(Ok(()), |written| write!(f, "\n{:<12} {}", "written", written.display()))
    }
}

/// The error itself, so that remedies and exit codes are those of every command.
fn plain_error(error: motiform_lab::statistics::Error) -> anyhow::Error {
    match error {
        motiform_lab::statistics::Error::Study(error) => error.into(),
        other => other.into(),
    }
}
