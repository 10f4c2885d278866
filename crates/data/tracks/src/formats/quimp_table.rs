//! QuimP's tables `_snake.csv` and `_outline.csv`: tab separated, a header, blocks headed `#frame N`, pixels.

use super::{Found, stem};
use crate::detect::block;
use crate::gather::{Gather, Key};
use crate::header::{Header, is_table, names, needed, separator};
use crate::input::{Input, number, whole};
use crate::split::split;
use crate::{Apart, Error, Options, Place, Result};
use std::path::Path;

/// Columns are found by the header, which may begin with `#` and be repeated.
pub(super) fn read(mut input: Input, options: &Options) -> Result<Found> {
    let file = input.place.path().to_owned();
    let cell = stem(&file);
    let mut gather = Gather::new(options.limits);
    let mut line = String::new();
    let (mut frame, mut table) = (None, None);
    while input.line(&mut line)? {
        let place = input.here();
        if let Some(number) = block(&line) {
            frame = Some(whole(number, "the frame", &place)?);
            continue;
        }
        if line.trim().is_empty() {
            continue;
        }
        if let Some(found) = header(&line, options, &file)? {
            table = Some(found);
            continue;
        }
        if line.starts_with('#') {
            continue;
        }
        let no_header = "a header with columns such as node_x and node_y before them";
        let table = table.as_ref().ok_or_else(|| Error::structure(&place, "values", no_header))?;
        let frame = frame.ok_or_else(|| Error::structure(&place, "values", "a line #frame N before them"))?;
        gather.row(Key { cell: &cell, frame }, None, point(&line, table, &place)?, &place)?;
    }
    let (cells, notes) = gather.finish(&input.place, Apart::Names("write one cell per file"))?;
    Ok(Found { cells, notes, ..Found::default() })
}

/// Separator, columns of x and y, and the count of columns.
type Table = (u8, [usize; 2], usize);

/// The columns, if the line is a header: its fields are not numbers.
fn header(line: &str, options: &Options, file: &Path) -> Result<Option<Table>> {
    let comment = line.starts_with('#');
    let line = line.trim_start_matches('#').trim();
    if comment && !is_table(line, &options.columns) {
        return Ok(None);
    }
    let first = line.split(['\t', ',', ';']).next().unwrap_or_default().trim();
    if line.is_empty() || first.is_empty() || first.parse::<f64>().is_ok() || !line.contains(['\t', ',', ';'])
    {
        return Ok(None);
    }
    let names = names(line);
    let header = Header::find(&names, &options.columns, file)?;
    let x = needed(header.x, "x", &names, file)?;
    let y = needed(header.y, "y", &names, file)?;
    Ok(Some((separator(line), [x, y], names.len())))
}

fn point(line: &str, (separator, at, width): &Table, place: &Place) -> Result<[f64; 2]> {
    let mut fields = Vec::new();
    split(line, *separator, &mut fields);
    let get = |at: usize, what| {
        let short = || {
            Error::structure(place, format!("{} fields", fields.len()), format!("{width} as in the header"))
        };
        number(fields.get(at).ok_or_else(short)?, what, place)
    };
    Ok([get(at[0], "x")?, get(at[1], "y")?])
}
