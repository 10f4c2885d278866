//! Tracked cells: outlines in, and out come the observed motion, the fitted equations, their regime and their place.
//!
//! [`Sample::read`] turns files into cells with modes and quality ([`motiform_tracks`]); [`FieldOfView`] says what stage and camera add
//! to all of them. [`observe()`] says how a cell moves, from its samples alone. [`fit_cell`] fits a model ([`motiform_inference`]),
//! asks what the data determine, names the motion of the models that the data allow, and places them on the paper's planes. What cannot
//! be decided is a value with its reasons, never a name.

mod bifurcations;
mod cell;
mod checks;
mod driven;
mod error;
mod field;
mod fit;
mod fitted;
mod folder;
mod names;
mod natural;
mod numbers;
mod observe;
mod one_law;
mod outlines;
mod own_axes;
mod packed;
mod population;
mod prediction;
mod provenance;
mod recorded;
mod regime;
pub mod report;
mod settled;
mod stages;
mod start;
mod summary;
mod tables;
mod units;
mod work;

pub use bifurcations::{NearBifurcation, near_bifurcations};
pub use cell::{CellTrack, Sample};
pub use checks::Checks;
pub use driven::Driven;
pub use error::{Error, Result};
pub use field::{CommonDrift, Correction, FieldOfView, Flow, Jitter, Magnification, StageJump};
pub use fit::{CellFit, FitOptions, TOGETHER, fit_cell, fit_cells, fit_together};
pub(crate) use fit::{fit_in_stages, fit_or_reason};
pub use fitted::{Fitted, PERSISTENT_WALK};
pub use folder::write_observations;
pub use names::file_names;
pub use numbers::{
    FormNumber, Forms, Numbers, OfWalk, PopulationNumber, PopulationNumbers, Row, StatedWalk, Steps,
    WalkNumbers, WalkTests, Withheld, Wobble, number_columns, numbers, population_numbers,
};
pub use observe::{
    AtLag, Finding, Memory, Motion, MotionStatistics, Observation, ObservedChaos, ObservedLegs,
    ObservedRests, ObservedSpectrum, Relatives, Rotation, SpectralPeak, observe, population_statistics,
};
pub use outlines::OutlineFile;
pub use population::{
    FittedPopulation, NameShare, ObservedPopulation, OverCells, PopulationCoefficient, fitted_population,
    observed_population, over_cells,
};
pub use prediction::{
    Agreement, Axis, Companions, Comparison, Envelope, Kind, Prediction, Record, Statistic, predict,
};
pub use recorded::{RecordedCell, RecordedFrame, recorded};
pub use regime::{FittedRegime, LEAST_SHARE, regime_of};
pub use summary::{cell_json, fits_json, observations_json};
pub use tables::{coefficient_columns, mode_columns};
pub use units::Units;
pub use work::FitWork;
