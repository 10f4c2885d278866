//! Tracked cells: outlines in, and out come the observed motion, the fitted equations, their regime and their place.
//!
//! [`Sample::read`] turns files into cells with modes and quality ([`motiform_tracks`]). [`observe()`] says how a cell moves, from its samples
//! alone. [`fit_cell`] fits a model ([`motiform_inference`]), asks what the data determine, names the motion of the models that the data
//! allow, and places them on the paper's planes. What cannot be decided is a value with its reasons, never a name.

mod cell;
mod error;
mod fit;
mod folder;
mod observe;
mod regime;
mod summary;
mod tables;

pub use cell::{CellTrack, Sample};
pub use error::{Error, Result};
pub use fit::{CellFit, FitOptions, Fitted, fit_cell, fit_cells};
pub use folder::{FitFolder, write_fits, write_observations};
pub use observe::{Motion, Observation, observe};
pub use regime::{FittedRegime, LEAST_SHARE, regime_of};
pub use summary::{cell_json, fits_json, observations_json};
pub use tables::{coefficient_columns, mode_columns};
