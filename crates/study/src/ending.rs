//! How a run ended, and in which part.

use motiform_dynamics::Outcome;
use serde::{Deserialize, Serialize};
use std::ops::Deref;

/// The outcome of a run, with a note if it ended during its transient. Times are model times since the start of
/// the recording or, for a run that ended during the transient, since the start of the transient. They are never negative.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ending {
    /// The outcome; files contain its `kind` and `t` next to `during`.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// The part of the run, unless it is the recording.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub during: Option<Part>,
}

/// A part of a run that is not its recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Part {
    /// Before the recording.
    Transient,
}

impl Ending {
    /// The end of a transient that began at the time `-length`, counted from there.
    #[must_use]
    pub fn of_transient(outcome: Outcome, length: f64) -> Self {
        Self { outcome: outcome.later(length), during: Some(Part::Transient) }
    }
}

impl From<Outcome> for Ending {
    fn from(outcome: Outcome) -> Self {
        Self { outcome, during: None }
    }
}

impl Deref for Ending {
    type Target = Outcome;

    fn deref(&self) -> &Outcome {
        &self.outcome
    }
}

impl std::fmt::Display for Ending {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.outcome.fmt(f)?;
        match self.during {
            Some(Part::Transient) => f.write_str(", during the transient"),
            None => Ok(()),
        }
    }
}
