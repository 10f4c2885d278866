//! Long tables as CSV: one vertex per row.

use super::{Found, stem};
use crate::gather::{Gather, Key};
use crate::header::{Header, names, needed, separator};
use crate::input::{Input, number, whole};
use crate::split::split;
use crate::{Error, Options, Place, Result};
use std::borrow::Cow;

/// What to do where several cells have one name.
pub(super) const REMEDY: &str =
    "name the column of the cell: --column cell=HEADER, in Python columns={'cell': HEADER}";

/// Rows `cell, frame, i, x, y` in any order; without a cell there is one, without i the order of the rows is that of the vertices.
pub(super) fn read(mut input: Input, options: &Options) -> Result<Found> {
    let file = input.place.path().to_owned();
    let mut first = String::new();
    input.line(&mut first)?;
    let names = names(&first);
    let header = Header::find(&names, &options.columns, &file)?;
    let at = |at, wanted| needed(at, wanted, &names, &file);
    let [frame, x, y] = [at(header.frame, "frame")?, at(header.x, "x")?, at(header.y, "y")?];
    let separator = separator(&first);
    let alone = stem(&file);
    let mut gather = Gather::new(options.limits);
    let mut line = String::new();
    while input.line(&mut line)? {
        if line.trim().is_empty() {
            continue;
        }
        let place = input.here();
        let mut fields = Vec::with_capacity(names.len());
        split(&line, separator, &mut fields);
        if fields.len() != names.len() {
            return Err(width(&place, fields.len(), names.len(), separator));
        }
        let cell: Cow<'_, str> =
            header.cell.map_or(Cow::Borrowed(alone.as_str()), |at| Cow::Borrowed(fields[at].trim()));
        let i = header.i.map(|at| whole(&fields[at], "i", &place)).transpose()?;
        let point = [number(&fields[x], "x", &place)?, number(&fields[y], "y", &place)?];
        let frame = whole(&fields[frame], "frame", &place)?;
        gather.row(Key { cell: &cell, frame }, i, point, &place)?;
    }
    let (cells, notes) = gather.finish(&input.place, REMEDY)?;
    Ok(Found { cells, notes, ..Found::default() })
}

fn width(place: &Place, got: usize, expected: usize, separator: u8) -> Error {
    let decimal = if separator == b',' && got > expected { " (decimal commas?)" } else { "" };
    Error::structure(
        place,
        format!("{got} fields{decimal}"),
        format!("one for each of the {expected} columns of the header"),
    )
}
