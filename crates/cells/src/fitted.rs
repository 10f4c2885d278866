//! A fit, and what follows from it: what the data determine, the motion, the places.

use crate::regime::{FittedRegime, begin, regime_of};
use crate::stages::Stages;
use crate::{Checks, Error, FitOptions, Result};
use motiform_dynamics::Watch;
use motiform_inference::{
    Averaged, BetweenCells, Drift, Fit, HANDED_RATE, Handedness, Identifiability, Placement, Plane,
    Selection, Settings, Stretch, Symmetry, Track, Warning, averaged, drift, fit, handedness,
    identifiability, place_among, refit_with, select, stage_velocity, warnings,
};
use motiform_models::amplitudes::info;
use motiform_study::Study;
use motiform_study::scan::Axis;
use serde::{Deserialize, Serialize};

/// Samples of the explorer in a natural time.
const SAMPLES: f64 = 20.0;
/// Natural times that the explorer shows in a second.
const PER_SECOND: f64 = 3.0;

/// The name of motions that noise carries.
pub const PERSISTENT_WALK: &str = "persistent-random-walk";

/// The fit of a cell, and what it means.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fitted {
    /// All terms of the library, real coefficients.
    pub whole: Fit,
    /// The terms that the data ask for.
    pub selection: Selection,
    /// Real against complex coefficients.
    pub handedness: Handedness,
    /// What the motion determines, among the selected terms.
    pub known: Identifiability,
    /// What the motion determines, among all terms.
    pub known_of_all: Identifiability,
    /// The same terms at other sampling intervals.
    pub drift: Option<Drift>,
    /// Another estimate of the model's coefficients, and what the model leaves unexplained.
    pub checks: Checks,
    /// What makes the fit doubtful.
    pub warnings: Vec<Warning>,
    /// Why there is neither motion nor place nor a symmetry: serious warnings, handedness that is not decided, blow-up, simulated cells that are unlike the observed one.
    pub doubts: Vec<String>,
    /// The motion; `None` where the coefficients are not determined.
    pub regime: Option<FittedRegime>,
    /// Places on the planes of Fig. 4 and Fig. 1.
    pub places: [Placement; 2],
    /// The coefficients over all sets of terms that the data do not tell apart, with intervals that hold the choice of terms; none of a handed model.
    #[serde(default)]
    pub averaged: Vec<Averaged>,
    /// Of several cells together: errors of the model's coefficients from the differences between cells.
    pub between: Option<BetweenCells>,
}

impl Fitted {
    /// The model that describes the cell: handed if real coefficients are rejected.
    #[must_use]
    pub fn model(&self) -> &Fit {
        if self.rejects_real() { &self.handedness.fit } else { &self.selection.fit }
    }

    /// Whether real coefficients are rejected: the model then has complex ones.
    fn rejects_real(&self) -> bool {
        self.handedness.symmetry == Symmetry::Handed
    }

    /// The symmetry of the cell: not decided where the fit is doubtful.
    #[must_use]
    pub fn symmetry(&self) -> Symmetry {
        if self.doubts.is_empty() { self.handedness.symmetry } else { Symmetry::Undecided }
    }

    /// The motion in a word: that of the equations, [`PERSISTENT_WALK`] where these rest without their noise and the cell moves, or `undecided`.
    #[must_use]
    pub fn motion_name(&self) -> &'static str {
        if self.is_walk() {
            return PERSISTENT_WALK;
        }
        self.regime.as_ref().and_then(|found| found.regime).map_or("undecided", |regime| regime.name())
    }

    /// Whether noise carries all of the displacement: the models that the data allow rest without it, while the speed exceeds its errors of observation.
    #[must_use]
    pub fn is_walk(&self) -> bool {
        self.doubts.is_empty() && self.regime.as_ref().is_some_and(FittedRegime::is_carried)
    }

    /// What acts on the velocity of such a walk, in words: whether its shape takes part.
    #[must_use]
    pub fn walk_in_words(&self) -> String {
        let pulled = self.model().coefficients.iter().filter(|c| c.term.equation == 0);
        let shape: Vec<&str> = pulled
            .filter(|c| c.name.contains("z2") || c.name.contains("z3"))
            .map(|c| c.name.as_str())
            .collect();
        let acts = if shape.is_empty() {
            "the shape does not act on the velocity (passive shape)".to_owned()
        } else {
            format!("the shape acts on the velocity (polar shape: {})", shape.join(", "))
        };
        format!(
            "without their noise the equations rest: noise carries 100 % of the displacement, a persistent random walk; {acts}"
        )
    }

    /// Whether the cell is handed.
    #[must_use]
    pub fn is_handed(&self) -> bool {
        self.symmetry() == Symmetry::Handed
    }

    /// Whether the data determine the coefficients of the model.
    #[must_use]
    pub fn is_identifiable(&self) -> bool {
        self.known.identifiable
    }

    /// A coefficient over all tied sets.
    #[must_use]
    pub fn over_sets(&self, name: &str) -> Option<&Averaged> {
        self.averaged.iter().find(|one| one.name == name)
    }

    /// Coefficients that are not in the best set, but in one that is as good.
    pub fn in_other_sets(&self) -> impl Iterator<Item = &Averaged> {
        let best = &self.selection.fit;
        self.averaged.iter().filter(|one| best.coefficient(&one.name).is_none())
    }

    /// Takes name and places back, for a reason that was found after the fit.
    pub(crate) fn doubt(&mut self, reason: &str) {
        self.doubts.push(reason.to_owned());
        if let Some(found) = &mut self.regime {
            found.regime = None;
        }
        for place in &mut self.places {
            *place = Placement::Refused { reasons: self.doubts.clone() };
        }
    }

    /// The model as a study, in the units of the data, with its noise, from a state of the cell where its motion was looked at. It is drawn with the radius of the
    /// cell, and shown at a speed that suits its rates.
    ///
    /// # Errors
    /// Equations that are no model.
    pub fn study(&self, cell: &str, radius: f64) -> Result<Study> {
        let fit = self.model();
        let info = info(&fit.definition())
            .map_err(|error| motiform_models::Error::Equations { problem: error.to_string() })
            .map_err(motiform_study::Error::from)?;
        let mut study = Study::of_model(info);
        if let Some(found) = &self.regime {
            let sizes = fit.scales.amplitudes.iter().flat_map(|size| [size; 2]);
            let start = found.start.iter().zip(sizes).map(|(own, size)| rounded(own * size));
            begin(&mut study, start)?;
        }
        study.title = format!("Cell {cell}");
        study.about = format!(
            "Fitted to {} frames by maximum likelihood; lengths and times in the units of the data.",
            fit.frames
        );
        study.display.plane = plane(&study);
        study.figure.radius = radius;
        study.display.sample = two_digits(fit.scales.time / SAMPLES);
        study.display.speed = two_digits(fit.scales.time * PER_SECOND);
        study.run.noise = fit.noise.eta_shape.value;
        study.run.noise_velocity = Some(fit.noise.eta_v.value);
        Ok(study)
    }
}

/// Fits these tracks, stage by stage; the inner error says why there is no fit.
///
/// # Errors
/// [`motiform_study::Error::Interrupted`]; stages that cannot be written.
pub(crate) fn fitted(
    tracks: &[Track],
    (settings, options): (&Settings, &FitOptions),
    stages: &Stages<'_>,
    watch: &dyn Watch,
) -> Result<std::result::Result<Box<Fitted>, String>> {
    let whole = match stages.get("whole", watch, |watch| Ok(fit(tracks, settings, watch)?)) {
        Ok(whole) => whole,
        Err(Error::Inference(error)) => return Ok(Err(error.to_string())),
        Err(other) => return Err(other),
    };
    let selection = stages.get("selection", watch, |watch| Ok(select(tracks, &whole, watch)?))?;
    let handedness =
        stages.get("handedness", watch, |watch| Ok(handedness(tracks, &selection.fit, watch)?))?;
    let handed = handedness.symmetry == Symmetry::Handed;
    let model = if handed { &handedness.fit } else { &selection.fit };
    let known = identifiability(model);
    let known_of_all = identifiability(&whole);
    let drift = stages.get("drift", watch, |watch| match options.drift && selection.fit.converged() {
        true => Ok(Some(drift(tracks, &selection.fit, watch)?)),
        false => Ok(None),
    })?;
    let checks = Checks::of(tracks, model);
    let warnings = warnings(tracks, model, drift.as_ref())?;
    let mut doubts: Vec<String> = warnings.iter().filter(|w| serious(w)).map(ToString::to_string).collect();
    if handedness.is_doubted() && !handed {
        doubts.push(format!(
            "whether the cell is handed is not decided: a mirror-symmetric one has such a likelihood ratio with p = {:.1e}",
            handedness.p_value
        ));
    }
    // no stage that is kept: few cells are handed
    if handed
        && let Some(p) = without_stage(tracks, &whole, &selection, watch)?
        && p >= HANDED_RATE
    {
        doubts.push(format!("it is handed, or the stage drifts: without the velocity that does not turn with the cell, a mirror-symmetric one has such a likelihood ratio with p = {p:.1e}"));
    }
    let unclear = |found: Stretch| found.is_possible(tracks.len()) && !found.is_clear(tracks.len());
    if handed && tracks.iter().filter_map(Stretch::of).any(unclear) {
        doubts.push("it is handed, or the images are stretched: the cell keeps to a few directions, which does not tell one from the other".to_owned());
    }
    let regime = stages.get("regime", watch, |watch| {
        if !known.identifiable || !doubts.is_empty() {
            return Ok(None);
        }
        let described = Selection { subsets: selection.subsets.clone(), fit: model.clone() };
        regime_of(tracks, &whole, &described, (options.draws, options.seed), watch).map(Some)
    })?;
    if regime.as_ref().is_some_and(FittedRegime::blows_up) {
        doubts.push(
            "the fitted equations blow up without noise, and a cell that was tracked did not".to_owned(),
        );
    }
    let mut reasons = doubts.clone();
    if regime.as_ref().is_some_and(FittedRegime::is_carried) {
        reasons.push("noise carries the displacement: without it the equations rest, and the paper's planes are about motion without noise".to_owned());
    }
    if handed {
        reasons.push("the cell is handed, and the paper's planes are not".to_owned());
    }
    let averaged =
        if handed || !whole.converged() { Vec::new() } else { averaged(&whole, &selection.subsets) };
    let places = [Plane::Full, Plane::Reduced].map(|plane| match reasons.is_empty() {
        true => place_among(&whole, &selection, plane),
        false => Placement::Refused { reasons: reasons.clone() },
    });
    Ok(Ok(Box::new(Fitted {
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
        between: None,
    })))
}

/// The p-value of the test of handedness without the velocity of the stage, where that can be told from the motion of every cell; `None` elsewhere.
fn without_stage(
    tracks: &[Track],
    whole: &Fit,
    selection: &Selection,
    watch: &dyn Watch,
) -> Result<Option<f64>> {
    let still: Option<Vec<Track>> =
        tracks.iter().map(|track| Some(track.without_velocity(stage_velocity(track)?))).collect();
    let (Some(still), Some(set)) = (still, selection.subsets.ties.first()) else { return Ok(None) };
    let real = refit_with(&still, whole, &set.kept, watch)?;
    Ok(Some(handedness(&still, &real, watch)?.p_value))
}

/// The plane about the cell: kappa2 with kappa3 or gamma, as in the paper's diagrams, each from 0 to twice its value; that of the model where it has none of
/// these.
fn plane(study: &Study) -> Vec<Axis> {
    let named = |name: &str| {
        let place = study.info().ok()?.parameters().iter().position(|spec| spec.name == name)?;
        study.values().ok()?.get(place).copied()
    };
    let side = |name: &str| {
        let value = named(name).filter(|value| *value != 0.0)?;
        let ends = [0.0, two_digits(2.0 * value)];
        Some(Axis { name: name.to_owned(), values: vec![ends[0].min(ends[1]), ends[0].max(ends[1])] })
    };
    let sides = [side("kappa2"), side("kappa3").or_else(|| side("gamma"))];
    match sides {
        [Some(x), Some(y)] => vec![x, y],
        _ => study.display.plane.clone(),
    }
}

/// A number with five digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.4e}").parse().unwrap_or(x)
}

/// A number with two digits.
fn two_digits(x: f64) -> f64 {
    format!("{x:.1e}").parse().unwrap_or(x)
}

/// Significance below which innovations that are not white leave a cell without motion and place.
const COLOURED: f64 = 1e-6;

/// Whether there is no motion and no place with this warning.
fn serious(warning: &Warning) -> bool {
    match warning {
        Warning::Unbounded { .. }
        | Warning::NotConverged { .. }
        | Warning::CoarseSampling { .. }
        | Warning::Stretched { .. } => true,
        Warning::Coloured { channels } => channels.iter().any(|channel| channel.p_value < COLOURED),
        _ => false,
    }
}
