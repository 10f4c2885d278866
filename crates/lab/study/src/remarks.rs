//! Remarks on a study: settings that are allowed and probably not meant.

use crate::{Error, Study};
use motiform_dynamics::steppers::Method;
use motiform_models::amplitudes::{Definition, Equations};

/// Sentences about a study that is run with its stepper and whose parameters `varied` are varied.
///
/// # Errors
/// An unknown model, or parameters that do not follow from the others.
pub fn remarks(study: &Study, varied: &[&str]) -> Result<Vec<String>, Error> {
    let mut all = idle_ties(study, varied)?;
    all.extend(explicit_on_stiff(study)?);
    all.extend(unstated_rotations(study)?);
    Ok(all)
}

/// A sentence for each tie that has no effect where the parameters `varied` are varied.
///
/// # Errors
/// An unknown model, or parameters that do not follow from the others.
pub fn idle_ties(study: &Study, varied: &[&str]) -> Result<Vec<String>, Error> {
    let idle = study.ties.idle(study.info()?.parameters(), &study.values()?, varied);
    let sentence = |[name, formula, of]: [String; 3]| {
        format!(
            "the tie {name} = {formula} says 0 = 0 everywhere here: {of} is 0 and is not varied; \
             give it a value, such as {of}=0.5, or leave out the tie"
        )
    };
    Ok(idle.into_iter().map(sentence).collect())
}

/// A sentence about equations that are the same in every direction, and say that they are not.
fn unstated_rotations(study: &Study) -> Result<Option<String>, Error> {
    let given = study.info()?.definition().filter(|definition| definition.symmetry.is_some());
    let Some(definition) = given else { return Ok(None) };
    let symmetry = definition.symmetry.as_deref().unwrap_or_default();
    // without a word about it the terms must have the rotations
    let free = Definition { symmetry: None, ..definition.clone() };
    let more = !symmetry.starts_with("rotation") && Equations::new(&free).is_ok();
    Ok(more.then(|| {
        format!(
            "symmetry = {symmetry:?} is given, and the equations are the same in every direction: without it rotations are divided out, \
             and a steady motion is one motion instead of a family"
        )
    }))
}

/// A sentence about an explicit method with adaptive steps on stiff equations. (A fixed step is the user's choice, and an unstable one
/// is refused.)
fn explicit_on_stiff(study: &Study) -> Result<Option<String>, Error> {
    let (info, stepper) = (study.info()?, study.run.stepper.as_str());
    let is_stiff = matches!(Method::find(info.stepper), Some(Method::Exponential(_)));
    let chooses = study.run.step.is_none();
    let doubtful = is_stiff && chooses && matches!(Method::find(stepper), Some(Method::Explicit(_)));
    Ok(doubtful.then(|| {
        format!(
            "the equations of {} are stiff, and {stepper} is an explicit method: its steps must resolve the fastest decay, \
             so it may take very long; the stepper {} does not",
            info.name, info.stepper
        )
    }))
}
