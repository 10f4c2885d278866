//! Warnings about a study that is allowed, and probably not what is meant.

use crate::output::warn;
use motiform_dynamics::steppers::Method;
use motiform_study::{Error, Study};

/// Warnings for a study that is run with its stepper and whose parameters `varied` are varied.
pub(crate) fn remark(study: &Study, varied: &[&str]) -> Result<(), Error> {
    ties(study, varied)?;
    explicit_on_stiff(study)
}

/// A warning for each tie that has no effect where the parameters `varied` are varied.
pub(crate) fn ties(study: &Study, varied: &[&str]) -> Result<(), Error> {
    let specs = study.info()?.parameters();
    for [name, formula, of] in study.ties.idle(specs, &study.values()?, varied) {
        warn(&format!(
            "the tie {name} = {formula} says 0 = 0 everywhere here: {of} is 0 and is not varied; give it a value, such as --set {of}=0.5, or leave out the tie"
        ));
    }
    Ok(())
}

/// A warning for an explicit method with adaptive steps on stiff equations. (A fixed step is the user's choice, and an unstable one is refused.)
fn explicit_on_stiff(study: &Study) -> Result<(), Error> {
    let (info, stepper) = (study.info()?, study.run.stepper.as_str());
    let is_stiff = matches!(Method::find(info.stepper), Some(Method::Exponential(_)));
    let chooses = study.run.step.is_none();
    if is_stiff && chooses && matches!(Method::find(stepper), Some(Method::Explicit(_))) {
        warn(&format!(
            "the equations of {} are stiff, and {stepper} is an explicit method: its steps must resolve the fastest decay, so it may take very long; --stepper {} does not",
            info.name, info.stepper
        ));
    }
    Ok(())
}

/// The parameters that the scan of a study varies.
pub(crate) fn of_scan(study: &Study) -> Vec<&str> {
    study.scan.axes.iter().map(|axis| axis.name.as_str()).collect()
}

/// The parameters that the branches and curves of a study vary.
pub(crate) fn of_branches(study: &Study) -> Vec<&str> {
    let along = study.follow.along.iter().map(|along| along.name.as_str());
    let plane = study.follow.plane.iter().flat_map(|plane| plane.0.iter().map(|side| side.0.as_str()));
    along.chain(plane).collect()
}
