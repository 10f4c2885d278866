//! The path of the body on a point of a branch.

use super::family::Bodies;
use super::known::moved;
use super::result::Sample;
use motiform_continuation::{Motion, OrbitPath, path as of_motion};
use motiform_dynamics::Watch;
use motiform_study::{BranchPlan, Error};

/// The path of the body over one period of a point of a branch, stable or not. `None` where Newton's method does not find the nodes that
/// the point was kept without, or the watch stops it.
///
/// # Errors
/// An unknown model or stepper; parameters that the model rejects.
pub fn path(plan: &BranchPlan, sample: &Sample, watch: &dyn Watch) -> Result<Option<OrbitPath>, Error> {
    let bodies = Bodies::new(plan)?;
    let (parameter, settings) = (sample.point.parameter, bodies.settings());
    let body = bodies.model(parameter)?;
    let motion = match &sample.point.motion {
        Motion::Orbit { nodes, .. } if nodes.is_empty() => {
            moved(&bodies, sample, parameter, &settings, watch)
        }
        motion => Some(motion.clone()),
    };
    Ok(motion.and_then(|motion| of_motion(body.as_ref(), &motion, &settings.flow, watch)))
}
