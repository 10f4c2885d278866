//! Errors from the study file to the figure.

use motiform_models::nearest;
use motiform_store::Kind;
use std::path::{Path, PathBuf};

/// An input that cannot be used, or a file that cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
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
    Count {
        /// The requested number.
        count: usize,
        /// Dimension of the shape.
        dim: usize,
    },
    /// A result on disk is not written, replaced or continued.
    #[error(transparent)]
    Store(#[from] motiform_store::Error),
    /// A parameter cannot follow from others like this.
    #[error("tie {name} = {formula}: {problem}")]
    Tie {
        /// The tied parameter.
        name: String,
        /// The expression given.
        formula: String,
        /// The problem and its remedy.
        problem: String,
    },
    /// The models rejected a name or a value.
    #[error(transparent)]
    Models(#[from] motiform_models::Error),
    /// A study file has an error.
    #[error("{file}:{line}:{column}: {problem}\n{excerpt}")]
    Study {
        /// The file, or the preset.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// The error and its remedy.
        problem: String,
        /// The line, with the place marked below it.
        excerpt: String,
    },
    /// A name that is none of those that are known.
    #[error("unknown {kind} {name:?}{}: {choice}", hint(.nearest))]
    UnknownName {
        /// The kind of thing that is named.
        kind: &'static str,
        /// The name given.
        name: String,
        /// The most similar name.
        nearest: Option<&'static str>,
        /// The known names, in words.
        choice: String,
    },
    /// No preset has this name.
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
    /// Neither a model nor a preset has this name, and a study file has another one.
    #[error(
        "{name:?} is no model, no preset and no study file{}: the models are {}, the presets {}; the name of a study file ends in .toml",
        hint(.nearest), .models.join(", "), .presets.join(", ")
    )]
    UnknownSubject {
        /// The name given.
        name: String,
        /// The most similar name.
        nearest: Option<&'static str>,
        /// All models.
        models: Vec<&'static str>,
        /// All presets.
        presets: Vec<&'static str>,
    },
    /// An invalid setting.
    #[error("{key} = {value}: {remedy}")]
    Setting {
        /// The key.
        key: &'static str,
        /// Its value, as text.
        value: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// Bodies that all end before their run does.
    #[error(
        "no body completed its run, of {count} (seed {seed}: {outcome}): give a shorter t_end, or other parameters"
    )]
    NoBody {
        /// Number of bodies.
        count: usize,
        /// The seed of the first one.
        seed: u64,
        /// The outcome of its run, in words.
        outcome: String,
    },
    /// An axis of a scan that cannot be used.
    #[error("axis {text:?}: {problem}")]
    Axis {
        /// The axis as given, or its parameter.
        text: String,
        /// The error and its remedy.
        problem: String,
    },
    /// A range to follow a motion along that cannot be used.
    #[error("along {text}: {problem}")]
    Along {
        /// The range as given.
        text: String,
        /// The mistake and its remedy.
        problem: String,
    },
    /// A point of an earlier result that cannot be a start.
    #[error("start {text}: {problem}")]
    StartPoint {
        /// The point as given.
        text: String,
        /// The mistake and its remedy.
        problem: String,
    },
    /// Branches without a parameter to follow a motion along.
    #[error("nothing to follow: give the parameter to vary, with its range")]
    NoAlong,
    /// A plane of two parameters that cannot be used.
    #[error("plane {text}: {problem}")]
    Plane {
        /// The plane as given.
        text: String,
        /// The mistake and its remedy.
        problem: String,
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
    /// A scan without an axis.
    #[error(
        "nothing to vary: a scan needs one or two axes, each with values of a parameter of the model{free}"
    )]
    NoAxis {
        /// The parameters that the study leaves free, in brackets.
        free: String,
    },
    /// A folder without the result that is asked for.
    #[error("{} contains no {}: {reason}", .path.display(), .kind.name())]
    NoResult {
        /// The folder.
        path: PathBuf,
        /// The kind of result.
        kind: Kind,
        /// The reason.
        reason: String,
    },
    /// A folder whose result is not finished.
    #[error("{} contains {} that is not finished", .path.display(), .kind.words())]
    Unfinished {
        /// The folder.
        path: PathBuf,
        /// The kind of result.
        kind: Kind,
    },
    /// A folder that contains the result of another plan.
    #[error("{} contains the {} of another plan ({differences})", .path.display(), .kind.name())]
    OtherPlan {
        /// The folder.
        path: PathBuf,
        /// The kind of result.
        kind: Kind,
        /// The differences: each key with its value in the folder and the requested value.
        differences: String,
    },
    /// Folders of different scans cannot be merged.
    #[error("{} and {} contain different scans ({differences}): merge the shards of one scan", .first.display(), .second.display())]
    Unmergeable {
        /// A folder.
        first: PathBuf,
        /// Another one.
        second: PathBuf,
        /// The differences.
        differences: String,
    },
    /// Two folders contain the same part with different numbers.
    #[error(
        "{} and {} contain different numbers for the same rows: one of them comes from another version of motiform; leave one folder out",
        .first.display(), .second.display()
    )]
    Conflict {
        /// A part.
        first: PathBuf,
        /// The other one.
        second: PathBuf,
    },
    /// Writing a part failed (for example because of a full disk).
    #[error("writing {} failed: {reason}; complete parts are kept; {}", .path.display(), motiform_store::advice(.reason))]
    PartFailed {
        /// The part.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
    /// Rows that are not those of a part.
    #[error("these are not the rows of part {part}, in order: give one row per cell and initial state")]
    OtherRows {
        /// The part.
        part: usize,
    },
    /// A fixed step at which an explicit method is unstable for this model.
    #[error(
        "step = {step:?}: {stepper} is unstable above {largest:.1e} for this model; give a smaller step, or use an \
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
    /// Rates so fast that an explicit method would need too many steps.
    #[error(
        "the fastest rate of this model is {rate:.1e}: {stepper} would need about {:.0e} steps for a time of {time:.0}; \
         use the exponential stepper krogstad4, or smaller parameters",
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
    InTheWay {
        /// The path.
        path: PathBuf,
    },
    /// A figure could not be drawn.
    #[error("{0}")]
    Figure(String),
}

impl Error {
    /// Returns `true` if the input was valid but the machine failed.
    #[must_use]
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
    #[must_use]
    pub fn unreadable(path: &Path, reason: impl std::fmt::Display) -> Self {
        motiform_store::Error::unreadable(path, reason).into()
    }

    /// A file that cannot be written, with the reason as text.
    #[must_use]
    pub fn write_failed(path: &Path, reason: impl std::fmt::Display) -> Self {
        motiform_store::Error::write_failed(path, reason).into()
    }
}

/// ` (did you mean NAME?)`, if there is a similar name.
pub(crate) fn hint(nearest: &Option<&'static str>) -> String {
    nearest.map_or_else(String::new, |name| format!(" (did you mean {name}?)"))
}

/// The registered name most similar to `name`.
pub(crate) fn nearest_of(name: &str, known: &[&'static str]) -> Option<&'static str> {
    nearest(name, known.iter().copied())
}
