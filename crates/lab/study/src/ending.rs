//! The end of a run, and the part in which it ended.

use motiform_dynamics::Outcome;
use serde::{Deserialize, Serialize};

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
    pub fn of_transient(outcome: Outcome, length: f64) -> Self {
        Self { outcome: outcome.later(length), during: Some(Part::Transient) }
    }

    /// Returns `true` if the run came to its end.
    pub fn is_complete(&self) -> bool {
        self.outcome.is_complete()
    }

    /// The time at which it ended.
    pub fn t_last(&self) -> f64 {
        self.outcome.t_last()
    }
}

impl From<Outcome> for Ending {
    fn from(outcome: Outcome) -> Self {
        Self { outcome, during: None }
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
