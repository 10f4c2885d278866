//! Errors from the study file to the figure.

use motiform_models::{hint, nearest};
use motiform_store::Kind;
use std::path::{Path, PathBuf};

/// An input that cannot be used, or a file that cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each message says what its fields are")]
pub enum Error {
    /// The numerics rejected an input.
    #[error(transparent)]
    Dynamics(#[from] motiform_dynamics::Error),
    /// An analysis rejected its input.
    #[error(transparent)]
    Analysis(#[from] motiform_analysis::Error),
    /// The caller stopped the computation.
    #[error("interrupted")]
    Interrupted,
    /// More exponents than there are, or none.
    #[error("count = {count}: this model has {dim} exponents; give a count from 1 to {dim}")]
    Count { count: usize, dim: usize },
    /// A result on disk is not written, replaced or continued.
    #[error(transparent)]
    Store(#[from] motiform_store::Error),
    /// A parameter cannot follow from others like this.
    #[error("tie {name} = {formula}: {problem}")]
    Tie { name: String, formula: String, problem: String },
    /// The models rejected a name or a value.
    #[error(transparent)]
    Models(#[from] motiform_models::Error),
    /// A study file has an error.
    #[error("{file}:{line}:{column}: {problem}\n{excerpt}")]
    Study {
        file: String,
        line: usize,
        column: usize,
        problem: String,
        /// The line, with the place marked below it.
        excerpt: String,
    },
    /// A name that is none of those that are known.
    #[error("unknown {kind} {name:?}{}: {choice}", hint(.nearest))]
    UnknownName { kind: &'static str, name: String, nearest: Option<&'static str>, choice: String },
    /// No preset has this name.
    #[error("unknown preset {name:?} of model {model}{}: the presets are {}", hint(.nearest), .known.join(", "))]
    UnknownPreset {
        name: String,
        model: &'static str,
        nearest: Option<&'static str>,
        known: Vec<&'static str>,
    },
    /// Neither a model nor a preset has this name, and a study file has another one.
    #[error(
        "{name:?} is no model, no preset and no study file{}: the models are {}, the presets {}; the name of a study file ends in .toml",
        hint(.nearest), .models.join(", "), .presets.join(", ")
    )]
    UnknownSubject {
        name: String,
        nearest: Option<&'static str>,
        models: Vec<&'static str>,
        presets: Vec<&'static str>,
    },
    /// An invalid setting.
    #[error("{key} = {value}: {remedy}")]
    Setting { key: &'static str, value: String, remedy: &'static str },
    /// Bodies that all end before their run does.
    #[error(
        "no body completed its run, of {count} (seed {seed}: {outcome}): give a shorter t_end, or other parameters"
    )]
    NoBody { count: usize, seed: u64, outcome: String },
    /// An axis of a scan that cannot be used.
    #[error("axis {text:?}: {problem}")]
    Axis { text: String, problem: String },
    /// A range to follow a motion along that cannot be used.
    #[error("along {text}: {problem}")]
    Along { text: String, problem: String },
    /// A point of an earlier result that cannot be a start.
    #[error("start {text}: {problem}")]
    StartPoint { text: String, problem: String },
    /// Branches without a parameter to follow a motion along.
    #[error("nothing to follow: give the parameter to vary, with its range")]
    NoAlong,
    /// A plane of two parameters that cannot be used.
    #[error("plane {text}: {problem}")]
    Plane { text: String, problem: String },
    /// The motion that a start settles on is not one to begin with.
    #[error("the start settles on {found} motion ({why}), {problem}")]
    Start { found: &'static str, why: String, problem: String },
    /// A scan without an axis.
    #[error(
        "nothing to vary: a scan needs one or two axes, each with values of a parameter of the model{free}"
    )]
    NoAxis { free: String },
    /// A folder without the result that is asked for.
    #[error("{} contains no {}: {reason}", .path.display(), .kind.name())]
    NoResult { path: PathBuf, kind: Kind, reason: String },
    /// A folder whose result is not finished.
    #[error("{} contains {} that is not finished", .path.display(), .kind.words())]
    Unfinished { path: PathBuf, kind: Kind },
    /// A folder that contains the result of another plan.
    #[error("{} contains the {} of another plan ({differences})", .path.display(), .kind.name())]
    OtherPlan {
        path: PathBuf,
        kind: Kind,
        /// The differences: each key with its value in the folder and the requested value.
        differences: String,
    },
    /// Folders of different scans cannot be merged.
    #[error("{} and {} contain different scans ({differences}): merge the shards of one scan", .first.display(), .second.display())]
    Unmergeable { first: PathBuf, second: PathBuf, differences: String },
    /// Two folders contain the same part with different numbers.
    #[error(
        "{} and {} contain different numbers for the same rows: one of them comes from another version of motiform; leave one folder out",
        .first.display(), .second.display()
    )]
    Conflict { first: PathBuf, second: PathBuf },
    /// Writing a part failed (for example because of a full disk).
    #[error("writing {} failed: {reason}; complete parts are kept; {}", .path.display(), motiform_store::advice(.reason))]
    PartFailed { path: PathBuf, reason: String },
    /// Rows that are not those of a part.
    #[error("these are not the rows of part {part}, in order: give one row per cell and initial state")]
    OtherRows { part: usize },
    /// A fixed step at which an explicit method is unstable for this model.
    #[error(
        "step = {step:?}: {stepper} is unstable above {largest:.1e} for this model; give a smaller step, or use an \
         exponential stepper (krogstad4)"
    )]
    UnstableStep { step: f64, stepper: &'static str, largest: f64 },
    /// Rates so fast that an explicit method would need too many steps.
    #[error(
        "the fastest rate of this model is {rate:.1e}: {stepper} would need about {:.0e} steps for a time of {time:.0}; \
         use the exponential stepper krogstad4, or smaller parameters",
        rate * time / 5.0
    )]
    Stiff { rate: f64, time: f64, stepper: &'static str },
    /// An initial state whose boundary cannot be closed.
    #[error(
        "the initial values do not describe a closed boundary (the gap is {residual:.1e} of its length): give \
         smaller ones, or another prior or closure_modes"
    )]
    NotClosed {
        /// The residual of the closing condition, relative to the length of the boundary.
        residual: f64,
    },
    /// Something other than a file is in the place of a file.
    #[error("{} is not a file, but a part of the scan belongs there: remove it and resume the scan", .path.display())]
    InTheWay { path: PathBuf },
    /// A figure could not be drawn.
    #[error("{0}")]
    Figure(String),
}

impl Error {
    /// Returns `true` if the input was valid but the machine failed.
    pub fn is_machine_failure(&self) -> bool {
        match self {
            Self::Store(error) => error.is_machine_failure(),
            _ => matches!(self, Self::PartFailed { .. } | Self::Figure(_)),
        }
    }

    /// A name that is none of `known`, which `choice` lists in words.
    pub(crate) fn unknown(kind: &'static str, name: &str, known: &[&'static str], choice: String) -> Self {
        Self::UnknownName { kind, name: name.to_owned(), nearest: nearest_of(name, known), choice }
    }

    /// A file that cannot be read, with the reason as text.
    pub fn unreadable(path: &Path, reason: impl std::fmt::Display) -> Self {
        motiform_store::Error::unreadable(path, reason).into()
    }

    /// A file that cannot be written, with the reason as text.
    pub fn write_failed(path: &Path, reason: impl std::fmt::Display) -> Self {
        motiform_store::Error::write_failed(path, reason).into()
    }
}

/// The registered name most similar to `name`.
pub(crate) fn nearest_of(name: &str, known: &[&'static str]) -> Option<&'static str> {
    nearest(name, known.iter().copied())
}
