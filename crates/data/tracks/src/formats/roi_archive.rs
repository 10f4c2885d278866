//! ImageJ regions: one file, or a zip archive of them.

use super::roi::decode;
use super::roi_name::named;
use super::{Found, stem};
use crate::gather::{Gather, Key};
use crate::input::{Input, io};
use crate::{Apart, Error, Options, Place, Result};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;
use zip::ZipArchive;

const REMEDY: Apart = Apart::Names("name the entries FRAME-CELL.roi");

/// One `.roi`: one outline.
pub(super) fn read_one(input: Input, options: &Options) -> Result<Found> {
    let place = input.place.clone();
    let bytes = bounded(input.into_reader(), options.limits.piece, &place)?;
    let roi = decode(&bytes, &place)?;
    let entry = place.path().file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let alone = stem(place.path());
    let named = named(&entry, roi.position);
    let mut gather = Gather::new(options.limits);
    let frame = named.frame.ok_or_else(|| Error::NoFrame { place: place.clone() })?;
    let key = Key { cell: named.cell.unwrap_or(&alone), frame };
    gather.outline(key, None, &roi.points, &place)?;
    let (cells, notes) = gather.finish(&place, REMEDY)?;
    Ok(Found { cells, notes, ..Found::default() })
}

/// An archive: one outline per entry. Entries that are folders are passed over; others that are no regions are errors.
pub(super) fn read(path: &Path, options: &Options) -> Result<Found> {
    let whole = Place::file(path);
    let damaged = |error: zip::result::ZipError| match error {
        zip::result::ZipError::Io(reason) if reason.kind() != std::io::ErrorKind::UnexpectedEof => {
            Error::Io { file: path.to_owned(), reason }
        }
        error => Error::structure(&whole, format!("a damaged archive ({error})"), "a zip of .roi files"),
    };
    let file = BufReader::new(File::open(path).map_err(io(path))?);
    let mut archive = ZipArchive::new(file).map_err(damaged)?;
    if archive.is_empty() {
        return Err(Error::NoOutlines { file: path.to_owned(), reason: "the archive is empty".to_owned() });
    }
    let alone = stem(path);
    let mut gather = Gather::new(options.limits);
    let mut total = 0;
    for at in 0..archive.len() {
        let mut entry = archive.by_index(at).map_err(damaged)?;
        if entry.is_dir() {
            continue;
        }
        let name = entry.name().to_owned();
        let place = whole.entry(&name);
        let bytes = bounded(&mut entry, options.limits.piece, &place)?;
        total += bytes.len() as u64;
        if total > options.limits.file {
            return Err(Error::Limit { place, what: "bytes", limit: options.limits.file, key: "file" });
        }
        let roi = decode(&bytes, &place)?;
        let named = named(&name, roi.position);
        let frame = named.frame.ok_or_else(|| Error::NoFrame { place: place.clone() })?;
        gather.outline(Key { cell: named.cell.unwrap_or(&alone), frame }, None, &roi.points, &place)?;
    }
    let (cells, notes) = gather.finish(&whole, REMEDY)?;
    Ok(Found { cells, notes, ..Found::default() })
}

/// All bytes, or an error where there are more than the limit: an entry may unpack to far more than the archive.
fn bounded(reader: impl Read, limit: u64, place: &Place) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let damaged = |error: std::io::Error| {
        Error::structure(place, format!("data that cannot be unpacked ({error})"), "an ImageJ region")
    };
    reader.take(limit + 1).read_to_end(&mut bytes).map_err(damaged)?;
    if bytes.len() as u64 > limit {
        return Err(Error::Limit { place: place.clone(), what: "bytes in an entry", limit, key: "piece" });
    }
    Ok(bytes)
}
