//! A fit, and what follows from it: what the data determine, the motion, the places.

mod doubts;
mod make;
mod noise;
mod study;

pub(crate) use make::{Members, fitted};

use crate::Checks;
use crate::regime::FittedRegime;
use motiform_dynamics::in_words;
use motiform_inference::{
    Averaged, BetweenCells, Drift, Fit, HANDED_RATE, Handedness, Identifiability, Ladder, PValue, Placement,
    Selection, Symmetry, Warning,
};
use serde::{Deserialize, Serialize};

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
    /// The combinations that the motion determines, among the selected terms.
    pub known: Identifiability,
    /// The combinations that the motion determines, among all terms of the library with real coefficients.
    pub known_of_all: Identifiability,
    /// The same coefficients at other sampling intervals.
    pub drift: Option<Drift>,
    /// Another estimate of the model's coefficients, and what the model leaves unexplained.
    pub checks: Checks,
    /// Reasons to doubt the fit.
    pub warnings: Vec<Warning>,
    /// Why there is neither motion nor place nor a symmetry: serious warnings, handedness that is not decided, blow-up, simulated cells
    /// that are unlike the observed one.
    pub doubts: Vec<String>,
    /// The motion; `None` where the coefficients are not determined.
    pub regime: Option<FittedRegime>,
    /// Places on the planes of Fig. 4 and Fig. 1.
    pub places: [Placement; 2],
    /// The coefficients of all terms over all sets that the data do not tell apart, with intervals that hold the choice of terms; none of a
    /// handed model.
    #[serde(default)]
    pub averaged: Vec<Averaged>,
    /// Velocities of the stage that were subtracted before the fit, one for each piece of the record; none without `--correct drift`, or
    /// where none is seen.
    #[serde(default)]
    pub stage: Vec<[f64; 2]>,
    /// Of a cell that its likelihood calls handed: the p-value of the same test beside a velocity of the stage.
    #[serde(default)]
    pub beside_stage: Option<f64>,
    /// The same beside a small strain of the path and a constant elongation of the outlines, as images have that are stretched.
    #[serde(default)]
    pub beside_stretch: Option<f64>,
    /// The same where parts of the record have coefficients of their own, as those of a cell that changes.
    #[serde(default)]
    pub beside_change: Option<f64>,
    /// Models from a random walk on, compared by frames that their fits did not see, or why they are not; `None` where this was not
    /// asked for.
    #[serde(default)]
    pub ladder: Option<Result<Ladder, String>>,
    /// Of several cells together: errors of the model's coefficients from the differences between cells.
    pub between: Option<BetweenCells>,
}

impl Fitted {
    /// The model that describes the cell: handed if real coefficients are rejected.
    pub fn model(&self) -> &Fit {
        if self.rejects_real() { &self.handedness.fit } else { &self.selection.fit }
    }

    /// The test of handedness; `None` beside a fit that did not converge, where it decides nothing.
    pub fn handed_test(&self) -> Option<&Handedness> {
        self.selection.fit.converged().then_some(&self.handedness)
    }

    /// The outcome of the test, as a clause.
    pub fn handed_test_in_words(&self) -> String {
        self.handed_test().map_or_else(
            || "the fit did not converge".to_owned(),
            |test| format!("{}; {}", PValue(test.p_value), test.excluded_parts()),
        )
    }

    /// `true` if real coefficients are rejected: the model then has complex ones.
    fn rejects_real(&self) -> bool {
        self.handedness.symmetry == Symmetry::Handed
    }

    /// The combinations that the data determine, and of which coefficients: of all terms, or of a handed model's own, as real coefficients
    /// of all terms are rejected. Where errors do not hold, their texts have those of the fit all the same, which says how well it
    /// determines one beside another.
    pub fn determined(&self) -> (&Identifiability, String) {
        let (known, of) = match self.rejects_real() {
            true => (&self.known, "of the terms of the handed model"),
            false => (&self.known_of_all, "of all terms"),
        };
        let beside = if self.has_errors() { "" } else { "; no intervals follow from these errors" };
        (known, format!("{of}{beside}"))
    }

    /// The symmetry of the cell: not decided where the fit is doubtful.
    pub fn symmetry(&self) -> Symmetry {
        if self.doubts.is_empty() { self.handedness.symmetry } else { Symmetry::Undecided }
    }

    /// The motion in a word: that of the equations, [`PERSISTENT_WALK`] where noise carries a cell that moves, or
    /// `undecided`.
    pub fn motion_name(&self) -> &'static str {
        if self.is_walk() {
            return PERSISTENT_WALK;
        }
        self.regime.as_ref().and_then(|found| found.regime).map_or("undecided", |regime| regime.name())
    }

    /// The same in words.
    pub fn motion_words(&self) -> String {
        in_words(self.motion_name())
    }

    /// `true` if noise carries the displacement ([`FittedRegime::is_carried`]), while the speed exceeds its errors of observation.
    pub fn is_walk(&self) -> bool {
        self.doubts.is_empty() && self.regime.as_ref().is_some_and(FittedRegime::is_carried)
    }

    /// The terms that act on the velocity of such a walk, in words: whether its shape takes part.
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
        let rest = "without their noise the equations rest, or keep a fifth of the mean square speed at most: noise carries the \
                    displacement, a persistent random walk";
        format!("{rest}; {acts}")
    }

    /// `true` if the cell is handed.
    pub fn is_handed(&self) -> bool {
        self.symmetry() == Symmetry::Handed
    }

    /// `true` if the data determine the coefficients of the model.
    pub fn is_identifiable(&self) -> bool {
        self.known.identifiable
    }

    /// Why the intervals of the coefficients are not stated: [`FittedRegime::no_intervals`], a bias by the sampling, a model that is in
    /// doubt, or coefficients that the motion does not determine. Of the last two the motion, which says whether intervals hold, is not
    /// known.
    pub fn no_intervals(&self) -> Option<&'static str> {
        let reason = doubts::no_intervals(self.regime.as_ref(), &self.warnings);
        let doubted = || {
            (!self.doubts.is_empty()).then_some("the fit is doubtful, and intervals would rest on its model")
        };
        let free = || {
            (!self.is_identifiable()).then_some("the motion does not determine all coefficients of the model")
        };
        reason.or_else(doubted).or_else(free)
    }

    /// Why there is a place on neither plane, where the reasons are the same.
    pub fn no_place(&self) -> Option<&[String]> {
        match &self.places {
            [Placement::Refused { reasons }, Placement::Refused { reasons: others }] if reasons == others => {
                Some(reasons)
            }
            _ => None,
        }
    }

    /// `true` if the errors of the coefficients hold: a search that did not converge ended at no maximum, and where no interval is stated
    /// an error would be read as one.
    pub fn has_errors(&self) -> bool {
        self.model().converged() && self.no_intervals().is_none()
    }

    /// A coefficient over all tied sets.
    pub fn over_sets(&self, name: &str) -> Option<&Averaged> {
        self.averaged.iter().find(|one| one.name == name)
    }

    /// Coefficients that are not in the best set, but in one that is as good.
    pub fn in_other_sets(&self) -> impl Iterator<Item = &Averaged> {
        let best = &self.selection.fit;
        self.averaged.iter().filter(|one| one.weight > 0.0 && best.coefficient(&one.name).is_none())
    }

    /// `true` if the stage drifts, or may be what makes the cell handed.
    pub(crate) fn shows_stage(&self) -> bool {
        let carried = |warning: &Warning| matches!(warning, Warning::Carried { .. });
        self.warnings.iter().any(carried) || self.beside_stage.is_some_and(|p| p >= HANDED_RATE)
    }

    /// The model that is fitted together with a velocity of the stage: the handed one where real coefficients are rejected even with such a
    /// velocity.
    pub(crate) fn model_beside_stage(&self) -> &Fit {
        match self.beside_stage {
            Some(p) if p < HANDED_RATE => &self.handedness.fit,
            _ => &self.selection.fit,
        }
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
}
