//! The orbit of a point of a branch: where a body on it would go.

use super::Spot;
use crate::answers::{Answers, Gone};
use crate::body::short;
use crate::protocol::OrbitTold;
use crate::worker::Current;
use motiform_branching::path;
use motiform_dynamics::Watch;
use motiform_study::plan::Named;

/// Enough digits for a picture.
const DIGITS: usize = 8;

/// A body was placed on a point of a branch, at this time and place.
pub(crate) struct OrbitJob {
    pub(crate) revision: u32,
    pub(crate) spot: Spot,
    pub(crate) parameters: Named,
    pub(crate) t: f64,
    pub(crate) position: [f64; 2],
}

/// Sends the orbit.
pub(super) fn tell(job: &OrbitJob, current: &Current<'_>, answers: &Answers) -> Result<(), Gone> {
    let Spot { plan, sample } = &job.spot;
    let found = match path(plan, sample, current) {
        Ok(Some(found)) => found,
        _ if current.stopped() => return Ok(()),
        Ok(None) => {
            return answers.refused(
                None,
                "the orbit of this point cannot be computed again: choose a point next to it",
            );
        }
        Err(error) => return answers.refused(None, &error.to_string()),
    };
    answers.say(OrbitTold {
        revision: job.revision,
        parameters: job.parameters.clone(),
        unstable: sample.point.unstable,
        t: job.t,
        position: job.position,
        time: found.time,
        rotation: found.rotation,
        points: found.points.iter().map(|point| point.map(|x| short(x, DIGITS))).collect(),
    })
}
