//! A body that is simulated interactively: its motion is divided into stretches between changes.
//!
//! [`Stretch`] moves it, [`Record`] keeps the samples since the last change, and [`spectra()`], [`maxima_of_speed`],
//! [`crossings_of_path`] and [`dataset()`] evaluate them.

mod dataset;
mod record;
mod returns;
mod settled;
mod spectra;
mod stretch;

pub use dataset::dataset;
pub use record::{Record, Row};
pub use returns::{crossings_of_path, maxima_of_speed};
pub use settled::{settled, start};
pub use spectra::{Spectra, spectra};
pub use stretch::Stretch;
