//! From tracks to a fit with everything that follows from it, stage by stage.

use super::Fitted;
use super::doubts::{doubts, no_intervals};
use crate::regime::{FittedRegime, regime_of};
use crate::stages::Stages;
use crate::{Checks, FitOptions, Result};
use motiform_analysis::regime::Regime;
use motiform_dynamics::Watch;
use motiform_dynamics::distributions::student_factor;
use motiform_inference::{
    Beside, CHANGED, Fit, Ladder, PValue, Placement, Plane, Selection, Settings, Symmetry, Track, WALK_RATE,
    Warning, averaged, between_cells, carried_cells, change, drift, fit, handed_beside, handed_beside_change,
    handedness, identifiability, ladder, place_among, select, walk_p_value, warnings,
};

/// Several tracks: pieces of one record, or cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Members {
    /// Pieces of the record of one cell.
    Pieces,
    /// Cells, two at least; `true` if their field of view drifts.
    Cells(bool),
}

impl Members {
    /// The remedy for a velocity that does not turn with the cell, where the correction 'drift' was given or not. It subtracts from cells
    /// together only what their field of view shows.
    fn remedy(self, given: bool) -> &'static str {
        match (self, given) {
            (Self::Pieces | Self::Cells(true), false) => "the correction 'drift' subtracts a drift",
            (Self::Pieces, true) => {
                "the correction 'drift' was given, and no velocity that stays the same over the record explains all of it; \
                 fit a part of the record in which the stage does not change"
            }
            (Self::Cells(_), _) => {
                "the correction 'drift' subtracts from cells together only what all of the field of view have in common: fit this one by \
                 itself"
            }
        }
    }
}

/// Says the unit and the remedy of a warning where it has them.
fn explain(warning: &mut Warning, of: &str, what: &str) {
    if let Warning::Carried { unit, remedy, .. } = warning {
        (*unit, *remedy) = (of.to_owned(), what.to_owned());
    }
}

/// Fits these tracks, stage by stage; `unit`: of their velocities.
///
/// # Errors
/// [`crate::Error::Inference`]: why there is no fit; [`motiform_study::Error::Interrupted`]; stages that cannot be written.
pub(crate) fn fitted(
    tracks: &[Track],
    members: Members,
    settings: &Settings,
    options: &FitOptions,
    unit: &str,
    stages: &Stages<'_>,
    watch: &dyn Watch,
) -> Result<Box<Fitted>> {
    let mut whole = stages.get("whole", watch, |watch| Ok(fit(tracks, settings, watch)?))?;
    if matches!(members, Members::Cells(_)) {
        let between = between_cells(tracks, &whole)?;
        whole = whole.with_cells(&between, student_factor(tracks.len() - 1));
    }
    let selection = stages.get("selection", watch, |watch| Ok(select(tracks, &whole, watch)?))?;
    let handedness =
        stages.get("handedness", watch, |watch| Ok(handedness(tracks, &selection.fit, watch)?))?;
    let handed = handedness.symmetry == Symmetry::Handed;
    let model = if handed { &handedness.fit } else { &selection.fit };
    let known = identifiability(model);
    let known_of_all = identifiability(&whole);
    let drift = stages.get("drift", watch, |watch| match options.drift && model.converged() {
        true => Ok(Some(drift(tracks, model, watch)?)),
        false => Ok(None),
    })?;
    let checks = Checks::of(tracks, model)?;
    let mut warnings = warnings(tracks, model, drift.as_ref())?;
    let changed = stages.get("change", watch, |watch| match model.converged() {
        true => Ok(change(tracks, model, watch)?),
        false => Ok(None),
    })?;
    warnings.extend(changed.filter(|p| *p < CHANGED).map(|p_value| Warning::Changing { p_value }));
    let is_carried = |warning: &Warning| matches!(warning, Warning::Carried { .. });
    if let (Members::Cells(false), Some(place)) = (members, warnings.iter().position(is_carried)) {
        warnings.splice(place..=place, carried_cells(tracks, model, watch)?);
    }
    warnings.iter_mut().for_each(|warning| explain(warning, unit, members.remedy(options.stage)));
    // no stage that is kept: few cells are handed
    let beside = |what| match handed {
        true => handed_beside(what, tracks, [&selection.fit, &handedness.fit], watch).map(Some),
        false => Ok(None),
    };
    let (beside_stage, beside_stretch) = (beside(Beside::Stage)?, beside(Beside::Stretch)?);
    let beside_change = match handed {
        true => Some(handed_beside_change(tracks, [&selection.fit, &handedness.fit], watch)?),
        false => None,
    };
    let white = checks.innovations.iter().map(|one| one.p_value).min_by(f64::total_cmp);
    let mut doubts = doubts(&warnings, &handedness, [beside_stage, beside_stretch, beside_change], white);
    let mut regime = stages.get("regime", watch, |watch| {
        if !known.identifiable || !doubts.is_empty() {
            return Ok(None);
        }
        let described = Selection { subsets: selection.subsets.clone(), fit: model.clone() };
        regime_of(tracks, &whole, &described, options.draws, options.seed, watch).map(Some)
    })?;
    if regime.as_ref().is_some_and(FittedRegime::blows_up) {
        doubts.push(
            "the fitted equations blow up without noise, and a cell that was tracked did not".to_owned(),
        );
    }
    if let Some(found) = regime.as_mut().filter(|_| !handed)
        && let Some(doubt) = walk_not_excluded(tracks, &whole, &selection, found.regime, watch)?
    {
        found.regime = None;
        doubts.push(doubt);
    }
    let ladder = stages.get("ladder", watch, |watch| match options.ladder {
        true => Ok(Some(steps(tracks, &whole, watch)?)),
        false => Ok(None),
    })?;
    let averaged =
        if handed || !whole.converged() { Vec::new() } else { averaged(&whole, &selection.subsets) };
    let places = places(&whole, &selection, &unplaced(&doubts, regime.as_ref(), &warnings, handed));
    Ok(Box::new(Fitted {
        whole,
        selection,
        handedness,
        known,
        known_of_all,
        drift,
        checks,
        warnings,
        doubts,
        regime,
        places,
        averaged,
        stage: Vec::new(),
        ladder,
        beside_stage,
        beside_stretch,
        beside_change,
        between: None,
    }))
}

/// The ladder of models, or why there is none.
fn steps(tracks: &[Track], whole: &Fit, watch: &dyn Watch) -> Result<std::result::Result<Ladder, String>> {
    match ladder(tracks, whole, watch) {
        Err(error @ motiform_inference::Error::TooShort { .. }) => Ok(Err(error.to_string())),
        found => Ok(Ok(found?)),
    }
}

/// That a cell which is named after a motion may be a persistent random walk, as a doubt.
fn walk_not_excluded(
    tracks: &[Track],
    whole: &Fit,
    selection: &Selection,
    name: Option<Regime>,
    watch: &dyn Watch,
) -> Result<Option<String>> {
    if name.is_none_or(|name| name == Regime::Motionless) {
        return Ok(None);
    }
    let p = walk_p_value(tracks, whole, selection, watch)?;
    let doubt = || {
        format!(
            "a persistent random walk, whose velocity decays and is renewed by noise, is not excluded ({})",
            PValue(p)
        )
    };
    Ok((p >= WALK_RATE).then(doubt))
}

/// Why the cell has no place; empty where it may have one.
fn unplaced(
    doubts: &[String],
    regime: Option<&FittedRegime>,
    warnings: &[Warning],
    handed: bool,
) -> Vec<String> {
    let mut reasons = doubts.to_vec();
    if regime.is_some_and(FittedRegime::is_carried) {
        reasons.push("noise carries the displacement: without it the equations rest, or nearly, and the paper's planes are about \
         motion without noise".to_owned());
    }
    // a sampling that is too coarse is a doubt already
    let unstated = no_intervals(regime, warnings).filter(|_| doubts.is_empty() || regime.is_some());
    reasons.extend(unstated.map(str::to_owned));
    if handed {
        reasons.push("the cell is handed, and the paper's planes are not".to_owned());
    }
    reasons
}

fn places(whole: &Fit, selection: &Selection, reasons: &[String]) -> [Placement; 2] {
    [Plane::Full, Plane::Reduced].map(|plane| match reasons.is_empty() {
        true => place_among(whole, selection, plane),
        false => Placement::Refused { reasons: reasons.to_vec() },
    })
}
