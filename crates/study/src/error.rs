//! What can go wrong between a study file and a figure.

use motiform_models::nearest;
use std::path::{Path, PathBuf};

/// An input that cannot be used, or a file that cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The numerics refused an input.
    #[error(transparent)]
    Dynamics(#[from] motiform_dynamics::Error),
    /// An analysis refused its input.
    #[error(transparent)]
    Analysis(#[from] motiform_analysis::Error),
    /// No part of the paper of this name.
    #[error("unknown figure {name:?}: what can be reproduced is {}", .known.join(", "))]
    UnknownFigure {
        /// The name given.
        name: String,
        /// What there is.
        known: Vec<&'static str>,
    },
    /// The system gives no threads.
    #[error("threads = {threads}: {reason}; give a smaller --threads")]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// The system's reason.
        reason: String,
    },
    /// The caller asked to stop.
    #[error("interrupted")]
    Interrupted,
    /// More exponents than there are, or none.
    #[error("count = {count}: this model has {dim} exponents; ask for 1 to {dim}")]
    Count {
        /// The number asked for.
        count: usize,
        /// Dimension of the shape.
        dim: usize,
    },
    /// The models refused a name or a value.
    #[error(transparent)]
    Models(#[from] motiform_models::Error),
    /// A study file is wrong at a place.
    #[error("{file}:{line}:{column}: {problem}\n{excerpt}")]
    Study {
        /// The file, or the preset.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong and how to mend it.
        problem: String,
        /// The line with a mark under the place.
        excerpt: String,
    },
    /// No preset of this name.
    #[error("unknown preset {name:?} of model {model}{}: the presets are {}", hint(.nearest), .known.join(", "))]
    UnknownPreset {
        /// The name given.
        name: String,
        /// The model.
        model: &'static str,
        /// The most similar name.
        nearest: Option<&'static str>,
        /// All presets of the model.
        known: Vec<&'static str>,
    },
    /// No stepper of this name.
    #[error("unknown stepper {name:?}{}: the steppers are {}", hint(.nearest), .known.join(", "))]
    UnknownStepper {
        /// The name given.
        name: String,
        /// The most similar name.
        nearest: Option<&'static str>,
        /// All steppers.
        known: Vec<&'static str>,
    },
    /// A setting that does not fit.
    #[error("{key} = {value}: {remedy}")]
    Setting {
        /// The key.
        key: &'static str,
        /// Its value, as text.
        value: String,
        /// What would be right.
        remedy: &'static str,
    },
    /// An axis of a scan that cannot be used.
    #[error("axis {text:?}: {problem}")]
    Axis {
        /// The axis as given, or its parameter.
        text: String,
        /// What is wrong and how to mend it.
        problem: String,
    },
    /// A range to follow a motion along that cannot be used.
    #[error("along {text}: {problem}")]
    Along {
        /// The range as given.
        text: String,
        /// What is wrong and how to mend it.
        problem: String,
    },
    /// No motion of this name can be followed.
    #[error("unknown start {name:?}{}: the motions that can be followed are {}", hint(.nearest), .known.join(", "))]
    Origin {
        /// The name given.
        name: String,
        /// The most similar name.
        nearest: Option<&'static str>,
        /// The motions.
        known: Vec<&'static str>,
    },
    /// The motion that a start settles on is not one to begin with.
    #[error("the start settles on {found} motion ({why}), {problem}")]
    Start {
        /// The regime found.
        found: &'static str,
        /// Its evidence.
        why: String,
        /// Why it cannot be followed, and the remedy.
        problem: String,
    },
    /// A folder that holds other branches.
    #[error("{} holds other branches than those asked for: choose another --out, or --force to replace it", .path.display())]
    OtherBranches {
        /// The folder.
        path: PathBuf,
    },
    /// A scan without an axis.
    #[error(
        "nothing to vary: give --axis NAME=LOW:HIGH:COUNT with a parameter of the model{free}, or axes in [scan]"
    )]
    NoAxis {
        /// The parameters that the study leaves free, in brackets.
        free: String,
    },
    /// A scan folder that is there already.
    #[error(
        "{} exists: --resume goes on with the scan in it, --force replaces it; or choose another --out", .path.display()
    )]
    ScanExists {
        /// The folder.
        path: PathBuf,
    },
    /// A folder that is no scan.
    #[error("{} holds no scan: {reason}; give a folder written by `motiform scan`", .path.display())]
    NoScan {
        /// The folder.
        path: PathBuf,
        /// Why not.
        reason: String,
    },
    /// A folder that holds the scan of another plan.
    #[error(
        "{} holds another scan than the one asked for ({differences}): choose another --out, or --force to replace it",
        .path.display()
    )]
    OtherScan {
        /// The folder.
        path: PathBuf,
        /// What differs: each key with the value there and the value asked for.
        differences: String,
    },
    /// Another process computes in the folder.
    #[error("another motiform computes in {}: wait until it is done, or choose another --out", .path.display())]
    Busy {
        /// The folder.
        path: PathBuf,
    },
    /// Folders of different scans cannot be merged.
    #[error("{} and {} hold different scans ({differences}): merge the shards of one scan", .first.display(), .second.display())]
    Unmergeable {
        /// A folder.
        first: PathBuf,
        /// Another one.
        second: PathBuf,
        /// What differs.
        differences: String,
    },
    /// Two folders hold the same part with different numbers.
    #[error(
        "{} and {} hold different numbers for the same rows: one of them comes from another version of motiform; leave          one folder out",
        .first.display(), .second.display()
    )]
    Conflict {
        /// A part.
        first: PathBuf,
        /// The other one.
        second: PathBuf,
    },
    /// Writing a part broke off (a full disk, say).
    #[error("writing {} failed: {reason}; whole parts are kept: make room, and --resume goes on", .path.display())]
    PartFailed {
        /// The part.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
    /// Rows that are not those of a part.
    #[error("these are not the rows of part {part}, in order: hand over one row per cell and initial state")]
    OtherRows {
        /// The part.
        part: usize,
    },
    /// A fixed step that an explicit method cannot take on this model.
    #[error(
        "step = {step:?}: {stepper} is unstable above {largest:.1e} for this model; give a smaller step, or take an \
         exponential stepper (krogstad4)"
    )]
    UnstableStep {
        /// The step.
        step: f64,
        /// The stepper.
        stepper: &'static str,
        /// The largest step that it can take.
        largest: f64,
    },
    /// Rates so fast that an explicit method would never end.
    #[error(
        "the fastest rate of this model is {rate:.1e}: {stepper} would need some {:.0e} steps for a time of {time:.0}; take the exponential \
         stepper krogstad4, or smaller parameters",
        rate * time / 5.0
    )]
    Stiff {
        /// The fastest rate of the linear part.
        rate: f64,
        /// The model time.
        time: f64,
        /// The stepper.
        stepper: &'static str,
    },
    /// A start whose boundary cannot be closed.
    #[error(
        "the initial values describe no closed boundary (closing it leaves {residual:.1e} of its length): give \
         smaller ones, or another prior or closure_modes"
    )]
    NotClosed {
        /// What is left of the closing condition, relative to the boundary's length.
        residual: f64,
    },
    /// The output exists.
    #[error("{} exists: choose another --out, or --force to replace it", .path.display())]
    Exists {
        /// The path.
        path: PathBuf,
    },
    /// The output exists and is not one of ours.
    #[error("{} exists and is no motiform dataset: --force does not replace it, choose another --out", .path.display())]
    NotOurs {
        /// The path.
        path: PathBuf,
    },
    /// A folder that cannot be written into.
    #[error("cannot write {}: {reason}; choose an --out in a folder that exists and that you may write to", .path.display())]
    Unwritable {
        /// The path.
        path: PathBuf,
        /// The system's reason. (Not a `source`: the message says it already, and once is enough.)
        reason: std::io::Error,
    },
    /// Writing broke off (a full disk, say). Nothing half-written is left.
    #[error("writing {} failed: {reason}; nothing was left behind, make room and run again", .path.display())]
    WriteFailed {
        /// The path.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
    /// Something that is no file is where a file of ours belongs.
    #[error("{} is no file, and a part of the scan belongs there: remove it, and --resume goes on", .path.display())]
    InTheWay {
        /// The path.
        path: PathBuf,
    },
    /// A file that cannot be read.
    #[error("cannot read {}: {reason}", .path.display())]
    Unreadable {
        /// The path.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
    /// A figure could not be drawn.
    #[error("{0}")]
    Figure(String),
}

impl Error {
    /// Whether the input was fine and the machine failed (exit code 1 rather than 2).
    #[must_use]
    pub fn is_machine_failure(&self) -> bool {
        matches!(self, Self::WriteFailed { .. } | Self::PartFailed { .. } | Self::Figure(_))
    }

    /// [`Error::Unreadable`] of a path, with the reason in words.
    #[must_use]
    pub fn unreadable(path: &Path, reason: impl std::fmt::Display) -> Self {
        Self::Unreadable { path: path.to_owned(), reason: reason.to_string() }
    }

    /// [`Error::WriteFailed`] of a path, with the reason in words.
    #[must_use]
    pub fn write_failed(path: &Path, reason: impl std::fmt::Display) -> Self {
        Self::WriteFailed { path: path.to_owned(), reason: reason.to_string() }
    }
}

/// ` (did you mean NAME?)`, where there is one.
pub(crate) fn hint(nearest: &Option<&'static str>) -> String {
    nearest.map_or_else(String::new, |name| format!(" (did you mean {name}?)"))
}

/// The registered name most similar to `name`.
pub(crate) fn nearest_of(name: &str, known: &[&'static str]) -> Option<&'static str> {
    nearest(name, known.iter().copied())
}
