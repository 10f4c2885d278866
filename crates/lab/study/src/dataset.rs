//! The result of a run: tables, the outcome, and the provenance.

use crate::Ending;
use crate::plan::{Named, Plan};
use motiform_store::Table;
use serde::{Deserialize, Serialize};

/// The result of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset {
    /// The plan, and how the run ended.
    pub manifest: Manifest,
    /// The recorded motion: `t, x, y`, the coordinates of the shape, `speed`, `turning_rate`, observables.
    pub trajectory: Table,
    /// The crossings of the return map's segment: `t, x, y, rising`.
    pub crossings: Option<Table>,
}

/// Provenance: everything needed to reproduce the same bits. Contains no host, user or time of day.
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
    /// The end of the run.
    pub outcome: Ending,
    /// The regime of the motion, if a short integration from its end was conclusive.
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
    /// Measures of the boundary at the end (length, area, ...).
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub measures: Named,
    /// For fixed steps: the change of the last shape if one more step is made in two halves, relative to its size.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step_error: Option<f64>,
    /// The centre that was shifted to the origin, if the return map required it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre: Option<[f64; 2]>,
}

/// The version of this program.
pub const VERSION: &str = motiform_store::VERSION;
