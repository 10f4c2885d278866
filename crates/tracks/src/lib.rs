//! Outlines of tracked cells: files of other programs in, shape modes with their errors out.
//!
//! [`read`] turns files into [`Tracks`]: cells with one closed polygon per frame, in one unit of length and one of time. What is wrong with the
//! data is an [`Error`] or a [`Note`]. Formats, units and definitions: docs/cells.md.

mod after;
mod detect;
mod error;
mod format;
mod formats;
mod gather;
mod geometry;
mod header;
mod input;
pub mod modes;
mod note;
mod options;
mod place;
mod read;
mod resolve;
mod scale;
pub mod synthetic;
mod tracks;
mod write;

pub use detect::detect;
pub use error::{Error, Result};
pub use format::Format;
pub use geometry::{area, centroid, perimeter};
pub use note::Note;
pub use options::{Columns, Limits, Options};
pub use place::Place;
pub use read::read;
pub use tracks::{Cell, FRAME, Outline, PIXEL, Tracks};
pub use write::{write_amoepy, write_csv};
