//! Outlines of tracked cells: files of other programs in, shape modes with their errors out.
//!
//! [`read()`] turns files into [`Tracks`]: cells with one closed polygon per frame, in one unit of length and
//! one of time. What is wrong with the data is an [`Error`] or a [`Note`]. [`modes::modes`] turns tracks into
//! centre and modes, with flags of quality. Formats, units and definitions: docs/cells.md.
//!
//! ```
//! use motiform_tracks::modes::{ModeOptions, modes};
//! use motiform_tracks::{Options, read};
//!
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("cells.txt");
//! # let round = motiform_tracks::synthetic::Synthetic { centre: [3.0, 4.0], r0: 2.0, z: vec![[0.2, 0.1]] };
//! # let line = |t: f64| format!("{t} {}\n", round.vertices(40, 0.1).iter().flatten().map(f64::to_string).collect::<Vec<_>>().join(" "));
//! # std::fs::write(&path, [0.0, 1.5].map(line).concat())?;
//! let tracks = read(&[path], &Options::default())?;
//! for cell in modes(&tracks, &ModeOptions::default()) {
//!     for frame in cell.used() {
//!         let Some(fit) = &frame.radius else { continue };
//!         let error = fit.covariance(fit.sigma, 3, 3).sqrt();
//!         println!("{} {}: z2 = {:?} {}, error {error}", cell.name, frame.t, fit.z[0], tracks.length_unit);
//!         # assert!((fit.z[0][0] - 0.2).abs() < 1e-14 && (fit.centre[1] - 4.0).abs() < 1e-14);
//!     }
//!     # assert_eq!(cell.used().count(), 1); // the second repeats the first
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod after;
mod cracks;
mod detect;
mod error;
mod form;
mod format;
mod formats;
mod gather;
mod geometry;
mod given;
mod header;
mod input;
mod masks;
pub mod modes;
mod note;
mod numbering;
mod options;
mod place;
mod read;
mod resolve;
mod scale;
mod split;
pub mod synthetic;
mod tracks;
mod units;
mod write;

pub use detect::detect;
pub use error::{Apart, Error, Result, Setting};
pub use form::{Form, form};
pub use format::Format;
pub use geometry::{area, centroid, perimeter};
pub use given::{Given, given};
pub use note::Note;
pub use options::{Columns, Limits, Options};
pub use place::Place;
pub use read::read;
pub use tracks::{Cell, FRAME, Image, Outline, PIXEL, Tracks};
pub use write::{write_amoepy, write_csv};
