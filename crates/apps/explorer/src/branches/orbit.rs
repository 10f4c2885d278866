//! The orbit of a point of a branch: where a body on it would go.

use super::Spot;
use crate::answers::{Gone, text};
use crate::body::short;
use crate::protocol::{OrbitTold, Refused};
use crate::task::{Task, Tell};
use motiform_diagrams::path;
use motiform_dynamics::Watch;
use motiform_study::plan::Named;
use serde::{Deserialize, Serialize};

/// Enough digits for a picture.
const DIGITS: usize = 8;

/// A body was placed on a point of a branch, at this time and place.
#[derive(Serialize, Deserialize)]
pub(crate) struct OrbitJob {
    pub(crate) revision: u32,
    pub(crate) spot: Spot,
    pub(crate) parameters: Named,
    pub(crate) t: f64,
    pub(crate) position: [f64; 2],
}

/// Computes the orbit. Its report is the message to the page.
pub(crate) struct Path;

impl Task for Path {
    type Job = OrbitJob;
    type Report = String;

    const NAME: &'static str = "orbit";
    /// The orbit of a point that was clicked is waited for.
    const NICE: i32 = 3;

    fn run(job: OrbitJob, watch: &dyn Watch, tell: Tell<'_, String>) -> Result<(), Gone> {
        let refused = |why: &str| tell(text(&Refused { id: None, why: why.to_owned() }.into()));
        let Spot { plan, sample } = &job.spot;
        let found = match path(plan, sample, watch) {
            Ok(Some(found)) => found,
            _ if watch.stopped() => return Ok(()),
            Ok(None) => {
                return refused(
                    "the orbit of this point cannot be computed again: choose a point next to it",
                );
            }
            Err(error) => return refused(&error.to_string()),
        };
        let told = OrbitTold {
            revision: job.revision,
            parameters: job.parameters,
            unstable: sample.point.unstable,
            t: job.t,
            position: job.position,
            time: found.time,
            rotation: found.rotation,
            points: found.points.iter().map(|point| point.map(|x| short(x, DIGITS))).collect(),
        };
        tell(text(&told.into()))
    }
}
