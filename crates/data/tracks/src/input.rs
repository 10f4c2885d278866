//! Bytes of a file, decompressed where it is a gzip file, and never more than the limits allow.

use crate::{Error, Limits, Place, Result, Setting};
use flate2::read::MultiGzDecoder;
use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

/// A file's text or bytes.
pub(crate) struct Input {
    reader: BufReader<Box<dyn Read>>,
    pub(crate) place: Place,
    limits: Limits,
    read: u64,
    lines: u64,
}

/// An error of the file system, with the file.
pub(crate) fn io(file: &Path) -> impl Fn(io::Error) -> Error {
    let file = file.to_owned();
    move |reason| Error::Io { file: file.clone(), reason }
}

impl Input {
    pub(crate) fn open(path: &Path, limits: Limits) -> Result<Self> {
        let metadata = path.metadata().map_err(io(path))?;
        if !metadata.is_file() {
            let (found, setting) = match metadata.is_dir() {
                true => ("a folder, which only holds label masks", Some(Setting::Masks)),
                false => ("not a file", None),
            };
            return Err(Error::UnknownFormat { file: path.to_owned(), found: found.to_owned(), setting });
        }
        let mut file = BufReader::new(File::open(path).map_err(io(path))?);
        let packed = file.fill_buf().map_err(io(path))?.starts_with(&[0x1f, 0x8b]);
        let reader: Box<dyn Read> = if packed { Box::new(MultiGzDecoder::new(file)) } else { Box::new(file) };
        let reader = BufReader::with_capacity(1 << 16, reader);
        Ok(Self { reader, place: Place::file(path), limits, read: 0, lines: 0 })
    }

    /// The first bytes, at most `most`.
    pub(crate) fn head(path: &Path, limits: Limits, most: u64) -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let input = Self::open(path, limits)?;
        input.reader.take(most).read_to_end(&mut bytes).map_err(io(path))?;
        Ok(bytes)
    }

    /// The next line into `line`, without its end; `false` at the end of the file. What is not UTF-8 is read as Latin-1.
    pub(crate) fn line(&mut self, line: &mut String) -> Result<bool> {
        let mut bytes = Vec::new();
        let piece = self.limits.piece;
        let got = self.reader.by_ref().take(piece + 1).read_until(b'\n', &mut bytes);
        let got = got.map_err(io(self.place.path()))? as u64;
        self.lines += u64::from(got > 0);
        self.read += got;
        if got > piece {
            return Err(self.limit("bytes in a line", piece, "piece"));
        }
        if self.read > self.limits.file {
            return Err(self.limit("bytes", self.limits.file, "file"));
        }
        line.clear();
        line.push_str(text(&bytes).trim_end_matches(['\n', '\r']));
        if self.lines == 1 && line.starts_with('\u{feff}') {
            line.remove(0);
        }
        Ok(got > 0)
    }

    /// The line that was read last.
    pub(crate) fn here(&self) -> Place {
        self.place.line(self.lines)
    }

    /// The reader itself, bounded by the limit of a file.
    pub(crate) fn into_reader(self) -> impl BufRead {
        self.reader.take(self.limits.file)
    }

    fn limit(&self, what: &'static str, limit: u64, key: &'static str) -> Error {
        Error::Limit { place: self.here(), what, limit, key }
    }
}

/// UTF-8, or else Latin-1, in which every byte is a character: older programs write `µ` and names with accents so.
pub(crate) fn text(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().copied().map(char::from).collect()),
    }
}

/// [`number`], also with a decimal comma: for columns that no comma separates.
pub(crate) fn decimal(text: &str, what: &str, place: &Place) -> Result<f64> {
    if text.contains(',') && !text.contains('.') && text.matches(',').count() == 1 {
        return number(&text.replace(',', "."), what, place);
    }
    number(text, what, place)
}

/// A number of a text, or an error that names it.
pub(crate) fn number(text: &str, what: &str, place: &Place) -> Result<f64> {
    let text = text.trim();
    if text.is_empty() {
        return Ok(f64::NAN);
    }
    text.parse().map_err(|_| {
        let found = shorten(text);
        Error::structure(place, format!("{what} is {found:?}"), "a number (with a decimal point)")
    })
}

/// Seconds of a time in parts, `1:02:03.5`, with so many seconds in each: below 60 but for the first part, whole but for the last.
pub(crate) fn seconds(text: &str, parts: &[f64], place: &Place) -> Result<f64> {
    let (sign, digits) = text.trim().strip_prefix('-').map_or((1.0, text.trim()), |digits| (-1.0, digits));
    let values: Option<Vec<f64>> =
        digits.replace(',', ".").split(':').map(|part| part.parse().ok()).collect();
    let last = parts.len().saturating_sub(1);
    let sound = |(at, value): (usize, &f64)| {
        (0.0..if at == 0 { f64::INFINITY } else { 60.0 }).contains(value)
            && (at == last || *value == value.trunc())
    };
    match values.filter(|values| values.len() == parts.len() && values.iter().enumerate().all(sound)) {
        Some(values) => Ok(sign * values.iter().zip(parts).map(|(value, part)| value * part).sum::<f64>()),
        None => Err(Error::structure(
            place,
            format!("time is {:?}", shorten(text)),
            "a number, h:m:s in all rows, or the parts that the header names, as time [mm:ss],",
        )),
    }
}

/// A whole number of a text, also written as `3.0`.
pub(crate) fn whole(text: &str, what: &str, place: &Place) -> Result<i64> {
    if let Ok(value) = text.trim().parse::<i64>() {
        return Ok(value);
    }
    integer(number(text, what, place)?)
        .ok_or_else(|| Error::structure(place, format!("{what} is {:?}", shorten(text)), "a whole number"))
}

/// The whole number that this is.
pub(crate) fn integer(value: f64) -> Option<i64> {
    let whole = value == value.trunc() && value.abs() < 9.0e15;
    whole.then_some(value as i64)
}

/// The beginning of a text, for a message.
pub(crate) fn shorten(text: &str) -> String {
    let mut short: String = text.chars().take(40).collect();
    if short.len() < text.len() {
        short.push_str("...");
    }
    short
}
