//! Long tables as Parquet: one vertex per row.

use super::{Found, stem};
use crate::gather::{Gather, Key};
use crate::header::{Header, needed};
use crate::input::{integer, io};
use crate::{Apart, Error, Options, Place, Result};
use motiform_store::table::parquet_input::{Read, read as read_file, values, wrong};
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, RowGroupReader};
use std::path::Path;

/// The compressions that can be read: for others the parquet library reports a disabled feature.
const COMPRESSIONS: &str = "a Parquet file with zstd, snappy, gzip or lz4 compression, or none";

/// Columns cell, frame, i, x and y as in CSV, of integers, floats or (cell) text; read by row groups.
pub(super) fn read(path: &Path, options: &Options) -> Result<Found> {
    path.metadata().map_err(io(path))?;
    let place = Place::file(path);
    let mut refused = None;
    let done = read_file(path, |file| {
        let result = rows(file, options, &place);
        result.map_err(|error| match error {
            Wrong::Table(error) => {
                refused = Some(error);
                wrong("")
            }
            Wrong::File(error) => error,
        })
    });
    if let Some(error) = refused {
        return Err(error);
    }
    let gather = done.map_err(|error| {
        let packed = error.to_string().contains("Disabled feature");
        let expected = if packed { COMPRESSIONS } else { "a sound Parquet file" };
        Error::structure(&place, error.to_string(), expected)
    })?;
    let (cells, notes) = gather.finish(&place, Apart::Column)?;
    Ok(Found { cells, notes, ..Found::default() })
}

enum Wrong {
    Table(Error),
    File(ParquetError),
}

impl From<Error> for Wrong {
    fn from(error: Error) -> Self {
        Self::Table(error)
    }
}

impl From<ParquetError> for Wrong {
    fn from(error: ParquetError) -> Self {
        Self::File(error)
    }
}

fn rows(file: &dyn FileReader, options: &Options, place: &Place) -> std::result::Result<Gather, Wrong> {
    let metadata = file.metadata();
    let total = u64::try_from(metadata.file_metadata().num_rows()).unwrap_or(0);
    let limit = options.limits.vertices;
    if total > limit {
        return Err(Error::Limit { place: place.clone(), what: "vertices", limit, key: "vertices" }.into());
    }
    let columns = metadata.file_metadata().schema_descr().columns();
    let names: Vec<String> = columns.iter().map(|column| column.name().to_owned()).collect();
    let header = Header::find(&names, &options.columns, place.path())?;
    let at = |at, wanted| needed(at, wanted, &names, place.path());
    let wanted = [at(header.frame, "frame")?, at(header.x, "x")?, at(header.y, "y")?];
    let mut gather = Gather::new(options.limits);
    let mut first = 0;
    for group in 0..file.num_row_groups() {
        let group = file.get_row_group(group)?;
        block(&*group, &header, wanted, (&mut gather, place, first))?;
        first += u64::try_from(group.metadata().num_rows()).unwrap_or(0);
    }
    Ok(gather)
}

/// One row group.
fn block(
    group: &dyn RowGroupReader,
    header: &Header,
    [frame, x, y]: [usize; 3],
    (gather, place, first): (&mut Gather, &Place, u64),
) -> std::result::Result<(), Wrong> {
    let alone = stem(place.path());
    let count = |at: usize| match values(group, at)? {
        Read::Number(numbers) => Ok(numbers),
        Read::Whole(numbers) => Ok(numbers.into_iter().map(|number| number as f64).collect()),
        Read::Text(_) => Err(wrong(&format!("column {} is text, not numbers", at + 1))),
    };
    let [frames, xs, ys] = [count(frame)?, count(x)?, count(y)?];
    let order = header.i.map(count).transpose()?;
    let cells = header.cell.map(|at| values(group, at)).transpose()?;
    for (k, (x, y)) in xs.iter().zip(&ys).enumerate() {
        let place = place.row(first + k as u64);
        let whole = |value: f64, what: &str| {
            integer(value)
                .ok_or_else(|| Error::structure(&place, format!("{what} = {value}"), "a whole number"))
        };
        let frame = whole(frames[k], "frame")?;
        let i = order.as_ref().map(|order| whole(order[k], "i")).transpose()?;
        let name = cells.as_ref().map_or_else(|| alone.clone(), |cells| name(cells, k));
        gather.row(Key { cell: &name, frame }, i, [*x, *y], &place)?;
    }
    Ok(())
}

fn name(cells: &Read, row: usize) -> String {
    match cells {
        Read::Whole(numbers) => numbers[row].to_string(),
        Read::Number(numbers) => numbers[row].to_string(),
        Read::Text(texts) => texts[row]
            .as_ref()
            .map_or_else(String::new, |text| String::from_utf8_lossy(text.data()).into_owned()),
    }
}
