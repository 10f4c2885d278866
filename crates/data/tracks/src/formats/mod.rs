//! One reader per format: bytes -> cells in the units of the file.

mod amoepy;
mod clock;
mod csv;
mod parquet;
mod quimp_nodes;
mod quimp_parameters;
mod quimp_table;
mod rings;
mod roi;
mod roi_archive;
mod roi_name;
mod times;
mod trackmate;
mod wkt;

use crate::input::Input;
use crate::scale::Scale;
use crate::{Cell, Format, Image, Note, Options, Result, masks};
use std::path::Path;

/// The content of a file.
#[derive(Default)]
pub(crate) struct Found {
    pub(crate) cells: Vec<Cell>,
    pub(crate) notes: Vec<Note>,
    pub(crate) scale: Scale,
    /// The images, in the unit of the coordinates.
    pub(crate) image: Option<Image>,
}

/// Reads a file of this format.
pub(crate) fn read(path: &Path, format: Format, options: &Options) -> Result<Found> {
    let input = || Input::open(path, options.limits);
    match format {
        Format::Csv => csv::read(input()?, options),
        Format::Parquet => parquet::read(path, options),
        Format::TrackMate => trackmate::read(input()?, options),
        Format::QuimpTable => quimp_table::read(input()?, options),
        Format::QuimpNodes => quimp_nodes::read(input()?, options),
        Format::AmoePy => amoepy::read(input()?, options),
        Format::Roi => roi_archive::read_one(input()?, options),
        Format::RoiZip => roi_archive::read(path, options),
        Format::Wkt => wkt::read(input()?, options),
        Format::Masks => masks::read(path, options),
    }
}

/// The name of a file without its extension: the name of a cell where the file has none.
pub(crate) fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "cell".to_owned(), |stem| stem.to_string_lossy().into_owned())
}
