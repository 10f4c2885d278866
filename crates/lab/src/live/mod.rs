//! A body that moves while somebody looks on: its motion in stretches, between the changes that are made to it.
//!
//! [`Stretch`] moves it, [`Record`] keeps what was seen since the last change, and [`spectra()`], [`maxima_of_speed`],
//! [`crossings_of_path`] and [`dataset()`] say what can be read off that.

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

#[cfg(test)]
mod tests;
