//! The fit of one cell, with everything that follows from it.

use crate::fitted::{Members, fitted};
use crate::one_law::{doubted, no_law};
use crate::stages::Stages;
use crate::{
    CellTrack, Companions, Error, Fitted, NearBifurcation, Prediction, Result, near_bifurcations, predict,
};
use motiform_dynamics::{StopOnly, Watch};
use motiform_inference::{
    LEAST_FRAMES, Library, Settings, Track, Warning, between_cells, senses, with_stage,
};
use motiform_lab::pool;
use motiform_study::{Dimension, counted};
use serde::{Deserialize, Serialize};

/// Most fits after a velocity of the stage was subtracted.
const MOST_ROUNDS: usize = 4;

/// Why a cell is not called handed in a flow.
const TURNED: &str =
    "it is handed, or turned by what makes velocities differ from place to place in the field of view";

/// Settings of a fit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FitOptions {
    /// Highest order of the terms: 3 or 5.
    pub order: u32,
    /// Amplitudes of the model: 2, 3, or 4 with z4. Of 3 the third is left out of cells whose z3 does not exceed its errors.
    #[serde(default = "three")]
    pub modes: usize,
    /// Most models drawn from the estimate; fewer where the first ones decide on the motion.
    pub draws: usize,
    /// Seed of the draws and of the simulated cells.
    pub seed: u64,
    /// Most cells simulated by the fit, to be compared with the observed one; 0 for none.
    pub simulations: usize,
    /// `true` if the nearest bifurcations are looked for.
    pub bifurcations: bool,
    /// `true` if the fit is repeated on every second and every fourth frame.
    pub drift: bool,
    /// One fit of all cells instead of one of each.
    #[serde(default)]
    pub together: bool,
    /// `true` if a velocity of the stage that a cell shows is fitted and subtracted.
    #[serde(default)]
    pub stage: bool,
    /// `true` if models from a random walk on are compared by frames that their fits did not see.
    #[serde(default)]
    pub ladder: bool,
}

/// The value in folders of fits that do not say.
fn three() -> usize {
    3
}

impl FitOptions {
    /// The terms that are fitted.
    ///
    /// # Errors
    /// [`motiform_inference::Error::Setting`] for an order or a number of modes out of range.
    pub fn library(&self) -> Result<Library> {
        Ok(Library::new(self.modes, self.order)?)
    }
}

impl Default for FitOptions {
    fn default() -> Self {
        Self {
            order: 3,
            modes: 3,
            draws: 160,
            seed: 1,
            simulations: 199,
            bifurcations: false,
            drift: true,
            together: false,
            stage: false,
            ladder: false,
        }
    }
}

/// A cell and its fit, or why there is none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CellFit {
    /// Name of the cell.
    pub name: String,
    /// Frames that count.
    pub frames: usize,
    /// The fit; an error says why there is none.
    pub fitted: std::result::Result<Box<Fitted>, String>,
    /// Cells simulated by the fit beside the observed one; `None` without a fit, with too few frames, and for several cells together.
    pub prediction: Option<Prediction>,
    /// The nearest bifurcations, if they were asked for and the motion can be followed.
    pub bifurcations: Vec<NearBifurcation>,
}

impl CellFit {
    /// Reasons to doubt the fit, in sentences.
    pub fn warnings(&self) -> Vec<String> {
        let of_fit = self.fitted.iter().flat_map(|fitted| fitted.warnings.iter().map(ToString::to_string));
        of_fit.chain(self.prediction.as_ref().and_then(Prediction::warning)).collect()
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
    options.library()?;
    let answer = |cell: &&CellTrack| fit_or_reason(cell, options, &StopOnly(watch));
    Ok(pool::as_far_as(cells, threads, watch, answer)?)
}

/// The fit of a cell, or why there is none; `None` where the watch stopped it.
pub(crate) fn fit_or_reason(
    cell: &CellTrack,
    options: &FitOptions,
    watch: &dyn Watch,
) -> std::result::Result<Option<CellFit>, motiform_study::Error> {
    match fit_cell(cell, options, watch) {
        Ok(fit) => Ok(Some(fit)),
        Err(Error::Study(motiform_study::Error::Interrupted)) => Ok(None),
        // Equations that are no model, or that cannot be analysed, are this cell's matter; other errors of studies, such as files that
        // cannot be written, end the work.
        Err(Error::Study(motiform_study::Error::Models(error))) => Ok(Some(without_fit(cell, &error))),
        Err(Error::Study(motiform_study::Error::Analysis(error))) => Ok(Some(without_fit(cell, &error))),
        Err(Error::Study(error)) => Err(error),
        Err(other) => Ok(Some(without_fit(cell, &other))),
    }
}

/// A cell that cannot be fitted, and why.
fn without_fit(cell: &CellTrack, why: &dyn std::fmt::Display) -> CellFit {
    refused(&cell.name, cell.frames(), why.to_string())
}

fn refused(name: &str, frames: usize, why: String) -> CellFit {
    CellFit { name: name.to_owned(), frames, fitted: Err(why), prediction: None, bifurcations: Vec::new() }
}

/// Fits a cell. What the data cannot give is in the result, with reasons.
///
/// # Errors
/// Settings that cannot be used; [`motiform_study::Error::Interrupted`].
pub fn fit_cell(cell: &CellTrack, options: &FitOptions, watch: &dyn Watch) -> Result<CellFit> {
    let library = options.library()?;
    let pieces = cell.pieces();
    if let Some(reason) = cell.modes.inconsistent() {
        return Ok(without_fit(cell, &reason));
    }
    if cell.has_no_outlines() {
        return Ok(without_fit(cell, &"there are positions and no outlines, which a fit needs"));
    }
    if pieces.is_empty() {
        let long = if cell.breaks.is_empty() { "" } else { " between jumps of the stage" };
        let why = format!("{} frames count, and a fit needs at least {LEAST_FRAMES}{long}", cell.frames());
        return Ok(without_fit(cell, &why));
    }
    let settings = Settings { library: library.seen(&pieces), ..Settings::default() };
    let unit = cell.units.unit(Dimension::SPEED);
    let (mut fitted, path) = match on_stage(pieces, cell.path(), &settings, options, &unit, watch) {
        Err(Error::Inference(error)) => return Ok(without_fit(cell, &error)),
        found => found?,
    };
    if fitted.is_handed() && cell.drift.is_some() {
        fitted.doubt("it is handed, or carried by the drift that all cells of the field of view have; the correction 'drift' subtracts it");
    }
    if fitted.is_handed() && cell.flows {
        fitted.doubt(TURNED);
    }
    let companions = Companions { count: options.simulations, seed: options.seed };
    let prediction =
        (options.simulations > 0).then(|| predict(&path, fitted.model(), companions, watch)).flatten();
    if watch.stopped() {
        return Err(motiform_study::Error::Interrupted.into());
    }
    if let Some(reason) = prediction.as_ref().and_then(Prediction::contradiction) {
        fitted.doubt(&reason);
    }
    let bifurcations = if options.bifurcations { near_bifurcations(&fitted, watch)? } else { Vec::new() };
    Ok(CellFit {
        name: cell.name.clone(),
        frames: cell.frames(),
        fitted: Ok(fitted),
        prediction,
        bifurcations,
    })
}

/// The fit of the pieces of a record, and the path that it describes: with [`FitOptions::stage`] both without the velocity of the
/// stage, where there is one. The terms that are chosen depend on what was subtracted, so this is repeated while one is seen.
fn on_stage(
    pieces: Vec<Track>,
    path: Track,
    settings: &Settings,
    options: &FitOptions,
    unit: &str,
    watch: &dyn Watch,
) -> Result<(Box<Fitted>, Track)> {
    let fit = |tracks: &[Track]| {
        fitted(tracks, Members::Pieces, settings, options, unit, &Stages::default(), watch)
    };
    let (mut found, mut tracks) = (fit(&pieces)?, pieces);
    for _ in 0..MOST_ROUNDS {
        if !(options.stage && found.shows_stage()) {
            break;
        }
        let still = with_stage(&tracks, found.model_beside_stage(), watch)?;
        if still.velocities.iter().flatten().all(|v| *v == 0.0) {
            break;
        }
        let before = found.stage.iter().copied().chain(std::iter::repeat([0.0; 2]));
        let sum = before.zip(&still.velocities).map(|(a, b)| [0, 1].map(|k| a[k] + b[k])).collect();
        tracks = still.tracks;
        found = fit(&tracks)?;
        found.stage = sum;
    }
    if found.stage.is_empty() {
        return Ok((found, path));
    }
    let longest = tracks.into_iter().max_by_key(|piece| piece.0.len());
    Ok((found, longest.unwrap_or(path)))
}

/// Name of the fit of several cells together.
pub const TOGETHER: &str = "together";

/// Fits one set of coefficients to several cells; errors between cells come from the differences between them.
///
/// # Errors
/// As [`fit_cell`]; [`motiform_inference::Error`] where fewer than two cells have enough frames.
pub fn fit_together(cells: &[&CellTrack], options: &FitOptions, watch: &dyn Watch) -> Result<CellFit> {
    fit_in_stages(cells, options, &Stages::default(), watch)
}

/// [`fit_together`], with stages that may be kept.
pub(crate) fn fit_in_stages(
    cells: &[&CellTrack],
    options: &FitOptions,
    stages: &Stages<'_>,
    watch: &dyn Watch,
) -> Result<CellFit> {
    let library = options.library()?;
    if let Some((cell, reason)) = cells.iter().find_map(|cell| Some((cell, cell.modes.inconsistent()?))) {
        return Ok(refused(TOGETHER, 0, format!("cell {}: {reason}", cell.name)));
    }
    let paths = cells.iter().map(|cell| (cell.name.as_str(), cell.path()));
    let (names, tracks): (Vec<&str>, Vec<Track>) =
        paths.filter(|(_, path)| path.0.len() >= LEAST_FRAMES).unzip();
    let frames = tracks.iter().map(|track| track.0.len()).sum();
    if tracks.len() < 2 {
        let why = match cells.iter().find(|cell| cell.has_no_outlines()) {
            Some(cell) => format!("cell {} has positions and no outlines, which a fit needs", cell.name),
            None => format!(
                "{} with {LEAST_FRAMES} frames or more that count; a fit of all together needs two at least",
                counted(tracks.len(), "cell")
            ),
        };
        return Ok(refused(TOGETHER, frames, why));
    }
    let settings = Settings { library: library.seen(&tracks), ..Settings::default() };
    let unit = cells[0].units.unit(Dimension::SPEED);
    let members = Members::Cells(cells.iter().any(|cell| cell.drift.is_some()));
    let mut fitted = match fitted(&tracks, members, &settings, options, &unit, stages, watch) {
        Err(Error::Inference(error)) => return Ok(refused(TOGETHER, frames, error.to_string())),
        found => found?,
    };
    let model = &fitted.selection.fit;
    let found = stages.get("senses", watch, |watch| Ok(senses(&tracks, model, watch)?))?;
    let joint = fitted.handedness.symmetry;
    if let Some(why) = no_law(&found, &names, joint) {
        return Ok(refused(TOGETHER, frames, why));
    }
    if let Some(doubt) = doubted(&found, joint) {
        fitted.doubt(&doubt);
    }
    if fitted.is_handed() && cells.iter().any(|cell| cell.flows) {
        fitted.doubt(TURNED);
    }
    let between = between_cells(&tracks, fitted.model())?;
    let differing = between.differing(fitted.model());
    if let Some(p_value) = differing.iter().map(|one| one.1).reduce(f64::min) {
        let names = differing.into_iter().map(|one| one.0).collect();
        fitted.warnings.push(Warning::CellsDiffer { names, p_value });
    }
    fitted.between = Some(between);
    Ok(CellFit {
        name: TOGETHER.to_owned(),
        frames,
        fitted: Ok(fitted),
        prediction: None,
        bifurcations: Vec::new(),
    })
}
