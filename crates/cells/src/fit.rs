//! The fit of one cell, with everything that follows from it.

use crate::regime::{FittedRegime, regime_of};
use crate::{CellTrack, Error, Result};
use motiform_dynamics::{StopOnly, Watch};
use motiform_inference::{
    Drift, Fit, Handedness, Identifiability, LEAST_FRAMES, Library, Placement, Plane, Selection, Settings,
    Symmetry, Warning, drift, fit, handedness, identifiability, place_among, select, warnings,
};
use motiform_lab::pool;
use motiform_models::amplitudes::info;
use motiform_study::Study;

/// What is fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct FitOptions {
    /// Highest order of the terms: 3 or 5.
    pub order: u32,
    /// Models drawn from the estimate.
    pub draws: usize,
    /// Seed of the draws.
    pub seed: u64,
    /// Whether the fit is repeated on every second and every fourth frame.
    pub drift: bool,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self { order: 3, draws: 40, seed: 1, drift: true }
    }
}

/// A cell and its fit, or why there is none.
#[derive(Debug)]
pub struct CellFit {
    /// Name of the cell.
    pub name: String,
    /// Frames that count.
    pub frames: usize,
    /// The fit; an error says why there is none.
    pub fitted: std::result::Result<Box<Fitted>, String>,
}

/// The fit of a cell, and what it means.
#[derive(Debug)]
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
    /// What makes the fit doubtful.
    pub warnings: Vec<Warning>,
    /// The motion; `None` where the coefficients are not determined.
    pub regime: Option<FittedRegime>,
    /// Places on the planes of Fig. 4 and Fig. 1.
    pub places: [Placement; 2],
}

impl Fitted {
    /// The model that describes the cell: handed if real coefficients are rejected.
    #[must_use]
    pub fn model(&self) -> &Fit {
        if self.is_handed() { &self.handedness.fit } else { &self.selection.fit }
    }

    /// Whether real coefficients are rejected.
    #[must_use]
    pub fn is_handed(&self) -> bool {
        self.handedness.symmetry == Symmetry::Handed
    }

    /// Whether the data determine the coefficients of the model.
    #[must_use]
    pub fn is_identifiable(&self) -> bool {
        self.known.identifiable
    }

    /// The model as a study, in the units of the data, with its noise.
    ///
    /// # Errors
    /// Equations that are no model.
    pub fn study(&self, cell: &str) -> Result<Study> {
        let fit = self.model();
        let info = info(&fit.definition())
            .map_err(|error| motiform_models::Error::Equations { problem: error.to_string() })
            .map_err(motiform_study::Error::from)?;
        let mut study = Study::of_model(info);
        study.title = format!("Cell {cell}");
        study.about = format!(
            "Fitted to {} frames by maximum likelihood; lengths and times in the units of the data.",
            fit.frames
        );
        study.run.noise = fit.noise.eta_shape.value;
        study.run.noise_velocity = Some(fit.noise.eta_v.value);
        Ok(study)
    }
}

/// Fits cells on `threads` threads, in their order; `None` for those that the watch left out. The result does not depend on the threads.
///
/// # Errors
/// As [`fit_cell`].
pub fn fit_cells(
    cells: &[&CellTrack],
    options: &FitOptions,
    threads: usize,
    watch: &dyn Watch,
) -> Result<Vec<Option<CellFit>>> {
    // Errors of settings come before any work, and those of data are in the results: what is left is a study's.
    Library::new(3, options.order)?;
    let answer = |cell: &&CellTrack| match fit_cell(cell, options, &StopOnly(watch)) {
        Ok(fit) => Ok(Some(fit)),
        Err(Error::Study(motiform_study::Error::Interrupted)) => Ok(None),
        Err(Error::Study(error)) => Err(error),
        Err(other) => {
            let fitted = Err(other.to_string());
            Ok(Some(CellFit { name: cell.name.clone(), frames: cell.frames(), fitted }))
        }
    };
    Ok(pool::as_far_as(cells, threads, watch, answer)?)
}

/// Fits a cell. What the data cannot give is in the result, with reasons.
///
/// # Errors
/// Settings that cannot be used; [`motiform_study::Error::Interrupted`].
pub fn fit_cell(cell: &CellTrack, options: &FitOptions, watch: &dyn Watch) -> Result<CellFit> {
    let settings = Settings { library: Library::new(3, options.order)?, ..Settings::default() };
    let fitted = if cell.frames() < LEAST_FRAMES {
        Err(format!("{} frames count, and a fit needs at least {LEAST_FRAMES}", cell.frames()))
    } else {
        fitted(cell, &settings, options, watch)?
    };
    Ok(CellFit { name: cell.name.clone(), frames: cell.frames(), fitted })
}

fn fitted(
    cell: &CellTrack,
    settings: &Settings,
    options: &FitOptions,
    watch: &dyn Watch,
) -> Result<std::result::Result<Box<Fitted>, String>> {
    let tracks = std::slice::from_ref(&cell.track);
    let whole = match fit(tracks, settings) {
        Ok(whole) => whole,
        Err(error) => return Ok(Err(error.to_string())),
    };
    let selection = select(tracks, &whole)?;
    let handedness = handedness(tracks, &selection.fit)?;
    let handed = handedness.symmetry == Symmetry::Handed;
    let model = if handed { &handedness.fit } else { &selection.fit };
    let known = identifiability(model);
    let known_of_all = identifiability(&whole);
    let drift = if options.drift { drift(tracks, &selection.fit).ok() } else { None };
    let warnings = warnings(tracks, &selection.fit, drift.as_ref())?;
    let serious = |warning: &Warning| {
        matches!(
            warning,
            Warning::Unbounded { .. } | Warning::NotConverged { .. } | Warning::CoarseSampling { .. }
        )
    };
    let mut doubts: Vec<String> = warnings.iter().filter(|w| serious(w)).map(ToString::to_string).collect();
    let regime = if known.identifiable && doubts.is_empty() {
        let described = Selection { subsets: selection.subsets.clone(), fit: model.clone() };
        Some(regime_of(tracks, &whole, &described, (options.draws, options.seed), watch)?)
    } else {
        None
    };
    if handed {
        doubts.push("the cell is handed, and the paper's planes are not".to_owned());
    }
    let places = [Plane::Full, Plane::Reduced].map(|plane| match doubts.is_empty() {
        true => place_among(&whole, &selection, plane),
        false => Placement::Refused { reasons: doubts.clone() },
    });
    Ok(Ok(Box::new(Fitted {
        whole,
        selection,
        handedness,
        known,
        known_of_all,
        drift,
        warnings,
        regime,
        places,
    })))
}
