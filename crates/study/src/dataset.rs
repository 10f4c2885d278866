//! What a run gave: tables, the outcome, and where it came from.

use crate::Ending;
use crate::plan::{Named, Plan};
use crate::table::Table;
use serde::{Deserialize, Serialize};

/// The result of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset {
    /// What was asked, how it ended.
    pub manifest: Manifest,
    /// The recorded motion: `t, x, y`, the coordinates of the shape, `speed`, `turning_rate`, observables.
    pub trajectory: Table,
    /// The crossings of the return map's segment: `t, x, y, rising`.
    pub crossings: Option<Table>,
}

/// Provenance: enough to compute the same bits again. Knows no host, no user, no time of day.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of motiform that computed this.
    pub motiform: String,
    /// The plan.
    pub plan: Plan,
    /// SHA-256 of the plan's computation.
    pub plan_hash: String,
    /// The seed (also in the plan).
    pub seed: u64,
    /// How the run ended.
    pub outcome: Ending,
    /// The regime that the motion was named with, where a short look from its end decided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub regime: Option<String>,
    /// Accepted steps of the recorded part (of the transient, if the run ended there).
    pub steps: u64,
    /// Rejected steps of the same part.
    pub rejected_steps: u64,
    /// The shape at the end, in the model's coordinates.
    pub state: Named,
    /// The position at the end.
    pub position: [f64; 2],
    /// The velocity at the end.
    pub velocity: [f64; 2],
    /// What the model measures of its boundary at the end (length, area, ...).
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub measures: Named,
    /// For fixed steps: how far the last shape moves when one more step is made in two halves, relative to its size.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step_error: Option<f64>,
    /// The centre that was put on the origin, where the return map asked for that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre: Option<[f64; 2]>,
}

/// The version of this program.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
