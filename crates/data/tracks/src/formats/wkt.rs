//! Outlines as well-known text: a column of a CSV table, or lines `cell, frame, POLYGON (...)`.

use super::rings::outer_ring;
use super::{Found, stem};
use crate::gather::{Gather, Key};
use crate::header::{Header, names, needed, polygon, separator};
use crate::input::{Input, whole};
use crate::split::split;
use crate::{Apart, Error, Options, Place, Result};
use std::borrow::Cow;

/// With a header: columns cell, frame and wkt. Without: lines of `POLYGON (...)`, before it nothing, the frame, or cell and frame.
pub(super) fn read(mut input: Input, options: &Options) -> Result<Found> {
    let file = input.place.path().to_owned();
    let mut gather = Gather::new(options.limits);
    let mut line = String::new();
    input.line(&mut line)?;
    let mut bare = Bare { alone: stem(&file), next: 0 };
    let table = match polygon(&line) {
        Some(_) => {
            bare.line(&line, &input.here(), &mut gather)?;
            None
        }
        None => Some(Table::new(&line, options, &input.place)?),
    };
    while input.line(&mut line)? {
        if line.trim().is_empty() {
            continue;
        }
        match &table {
            Some(table) => table.line(&line, &input.here(), &mut gather)?,
            None => bare.line(&line, &input.here(), &mut gather)?,
        }
    }
    let (cells, notes) = gather.finish(&input.place, Apart::Column)?;
    Ok(Found { cells, notes, ..Found::default() })
}

struct Table {
    separator: u8,
    header: Header,
    frame: usize,
    wkt: usize,
    alone: String,
}

impl Table {
    fn new(line: &str, options: &Options, place: &Place) -> Result<Self> {
        let (file, names) = (place.path(), names(line));
        let header = Header::find(&names, &options.columns, file)?;
        let frame = needed(header.frame, "frame", &names, file)?;
        let wkt = needed(header.wkt, "wkt", &names, file)?;
        Ok(Self { separator: separator(line), header, frame, wkt, alone: stem(file) })
    }

    fn line(&self, line: &str, place: &Place, gather: &mut Gather) -> Result<()> {
        let mut fields = Vec::new();
        split(line, self.separator, &mut fields);
        let get = |at: usize| {
            let none =
                || Error::structure(place, format!("{} fields", fields.len()), "all columns of the header");
            fields.get(at).map(|field| field.trim()).ok_or_else(none)
        };
        let cell: Cow<'_, str> = match self.header.cell {
            Some(at) => Cow::Borrowed(get(at)?),
            None => Cow::Borrowed(&self.alone),
        };
        let frame = whole(get(self.frame)?, "frame", place)?;
        gather.outline(Key { cell: &cell, frame }, None, &outer_ring(get(self.wkt)?, place)?, place)
    }
}

/// Lines without a header.
struct Bare {
    alone: String,
    next: i64,
}

impl Bare {
    fn line(&mut self, line: &str, place: &Place, gather: &mut Gather) -> Result<()> {
        let at =
            polygon(line).ok_or_else(|| Error::structure(place, "no POLYGON", "one outline per line"))?;
        let (before, text) = line.split_at(at);
        let blank = |c: char| c.is_whitespace() || ",;\"".contains(c);
        let words: Vec<&str> = before.split(blank).filter(|word| !word.is_empty()).collect();
        let (cell, frame) = match words.as_slice() {
            [] => (self.alone.as_str(), self.next),
            [frame] => (self.alone.as_str(), whole(frame, "frame", place)?),
            [cell, frame] => (*cell, whole(frame, "frame", place)?),
            more => {
                let found = format!("{} words before POLYGON", more.len());
                return Err(Error::structure(place, found, "nothing, the frame, or cell and frame"));
            }
        };
        self.next += 1;
        gather.outline(Key { cell, frame }, None, &outer_ring(text, place)?, place)
    }
}
