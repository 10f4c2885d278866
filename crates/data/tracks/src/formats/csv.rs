//! Long tables as CSV: one vertex per row.

use super::times::Times;
use super::{Found, stem};
use crate::gather::{Gather, Key};
use crate::header::{Header, names, needed, separator};
use crate::input::{Input, decimal, number, seconds, whole};
use crate::scale::{Said, Scale};
use crate::split::split;
use crate::units::{lengths, no_time, parts, time};
use crate::{Apart, Error, Note, Options, Place, Result};
use std::borrow::Cow;

/// Rows `cell, frame, i, x, y` in any order; without a cell there is one, without i the order of the rows is that of the vertices.
///
/// A column of times stands for that of frames, or gives their times; frames that are not whole numbers are
/// times too. Units in the header (`x [um]`) are those of the values. Times may be in parts, `0:01:30`. Where no
/// comma separates columns it may be the decimal one.
pub(super) fn read(mut input: Input, options: &Options) -> Result<Found> {
    let file = input.place.path().to_owned();
    let mut first = String::new();
    input.line(&mut first)?;
    let mut table = Table::new(&first, options, &input.place)?;
    let alone = stem(&file);
    let mut gather = Gather::new(options.limits);
    let mut times = Times::new(table.frame.is_some() && options.columns.frame.is_some());
    let mut line = String::new();
    while input.line(&mut line)? {
        // spreadsheets write rows of separators alone below a table
        if line.chars().all(|c| c.is_whitespace() || c == char::from(table.separator)) {
            continue;
        }
        let place = input.here();
        let mut fields = Vec::with_capacity(table.width);
        split(&line, table.separator, &mut fields);
        if fields.len() != table.width {
            return Err(width(&place, fields.len(), table.width, table.separator));
        }
        let cell: Cow<'_, str> =
            table.header.cell.map_or(Cow::Borrowed(alone.as_str()), |at| Cow::Borrowed(fields[at].trim()));
        let i = table.header.i.map(|at| whole(&fields[at], "i", &place)).transpose()?;
        let value = |at: usize, what: &str| table.number(&fields[at], what, &place);
        let point = [value(table.x, "x")?, value(table.y, "y")?];
        let frame = table.frame.map(|at| value(at, "frame")).transpose()?;
        let time = table.time.map(|at| table.moment(&fields[at], &place)).transpose()?;
        let frame = times.frame(frame, time, &place)?;
        gather.row(Key { cell: &cell, frame }, i, point, &place)?;
    }
    let finished = gather.finish(&input.place, Apart::Column);
    let (mut cells, mut notes) = finished.map_err(|error| times.in_words(error))?;
    let rounded = times.even_clock(&cells);
    notes.extend(rounded.map(|[interval, unit]| Note::RoundedTimes {
        file: file.display().to_string(),
        interval,
        unit,
    }));
    let said = table.time(times.interval(&cells));
    let given = table.frame.is_some() && options.interval.is_some();
    if given && (said.step.is_none() || said.unit.is_none() && times.repeats_frames()) {
        times.forget();
    }
    let unit = said.unit.is_some() || options.time_unit.is_some() && options.interval.is_none();
    let timed = times.apply(&mut cells, &mut notes, unit)?;
    let time = if timed { said } else { Said::default() };
    let scale = Scale { length: table.length(), time };
    Ok(Found { cells, notes, scale, image: None })
}

/// The columns of a table.
struct Table {
    header: Header,
    separator: u8,
    width: usize,
    frame: Option<usize>,
    time: Option<usize>,
    x: usize,
    y: usize,
    /// The units of the header.
    lengths: Option<String>,
    unit_of_time: Option<String>,
    /// Seconds in each part of a time, none where times are numbers; `None` until the first one is read.
    parts: Option<Vec<f64>>,
}

impl Table {
    fn new(first: &str, options: &Options, place: &Place) -> Result<Self> {
        let (names, file) = (names(first), place.path());
        let header = Header::find(&names, &options.columns, file)?;
        let x = needed(header.x, "x", &names, file)?;
        let y = needed(header.y, "y", &names, file)?;
        let frame = match header.time {
            Some(_) => header.frame,
            None => Some(needed(header.frame, "frame", &names, file)?),
        };
        let lengths = lengths([&names[x], &names[y]], file)?;
        let parts = header.time.and_then(|at| parts(&names[at]));
        let unit_of_time = match (&parts, header.time) {
            (Some(_), _) => Some("s".to_owned()),
            (None, Some(at)) => time(&names[at], file)?,
            (None, None) => None,
        };
        header.frame.map_or(Ok(()), |at| no_time(&names[at], file))?;
        Ok(Self {
            time: header.time,
            header,
            separator: separator(first),
            width: names.len(),
            frame,
            x,
            y,
            lengths,
            unit_of_time,
            parts,
        })
    }

    /// A time in seconds, or a number. The first one of a column without a unit says whether all are in hours, minutes and seconds.
    fn moment(&mut self, text: &str, place: &Place) -> Result<f64> {
        if text.trim().is_empty() {
            return self.number(text, "time", place);
        }
        let unit = &mut self.unit_of_time;
        let parts = self.parts.get_or_insert_with(|| {
            let clock = parts("time [h:m:s]").filter(|_| unit.is_none() && text.matches(':').count() == 2);
            *unit = unit.take().or_else(|| clock.as_ref().map(|_| "s".to_owned()));
            clock.unwrap_or_default()
        });
        if parts.is_empty() && !text.contains(':') {
            return self.number(text, "time", place);
        }
        seconds(text, parts, place)
    }

    fn number(&self, text: &str, what: &str, place: &Place) -> Result<f64> {
        if self.separator == b',' { number(text, what, place) } else { decimal(text, what, place) }
    }

    /// The unit of lengths according to the header.
    fn length(&self) -> Said {
        self.lengths.clone().map_or_else(Said::default, |unit| Said {
            step: None,
            unit: Some(unit),
            applied: true,
        })
    }

    /// The statement of the table about times: their interval where they stand for frames, and their unit where the header has one.
    fn time(&self, step: Option<f64>) -> Said {
        Said { step, unit: self.unit_of_time.clone(), applied: self.time.is_some() }
    }
}

fn width(place: &Place, got: usize, expected: usize, separator: u8) -> Error {
    let decimal = if separator == b',' && got > expected { " (decimal commas?)" } else { "" };
    Error::structure(
        place,
        format!("{got} fields{decimal}"),
        format!("one for each of the {expected} columns of the header"),
    )
}
