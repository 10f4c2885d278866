//! Warnings about a study that is allowed, and probably not what is meant.

use crate::output::warn;
use motiform_study::{Error, Study, idle_ties, remarks};

/// Warnings for a study that is run with its stepper and whose parameters `varied` are varied.
pub(crate) fn remark(study: &Study, varied: &[&str]) -> Result<(), Error> {
    remarks(study, varied)?.iter().for_each(|text| warn(text));
    Ok(())
}

/// A warning for each tie that has no effect where the parameters `varied` are varied.
pub(crate) fn ties(study: &Study, varied: &[&str]) -> Result<(), Error> {
    idle_ties(study, varied)?.iter().for_each(|text| warn(text));
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
