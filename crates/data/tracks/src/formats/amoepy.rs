//! AmoePy's text: a line for each frame, `t x0 y0 x1 y1 ...`, in seconds and micrometres.

use super::{Found, stem};
use crate::gather::{Gather, Key};
use crate::input::Input;
use crate::numbering::{median_difference, numbers};
use crate::scale::{Said, Scale};
use crate::{Apart, Cell, Error, Note, Options, Place, Result};

/// Frames are counted in intervals, the interval being the median of the differences; uneven times are numbered in order, with a note.
pub(super) fn read(mut input: Input, options: &Options) -> Result<Found> {
    let cell = stem(input.place.path());
    let mut gather = Gather::new(options.limits);
    let (mut times, mut frame) = (Vec::new(), 0);
    let mut line = String::new();
    while input.line(&mut line)? {
        if line.starts_with('#') || line.trim().is_empty() {
            continue;
        }
        let place = input.here();
        let (t, points) = one_frame(&line, &place)?;
        if times.last().is_some_and(|&before| t <= before) {
            return Err(Error::structure(
                &place,
                format!("time {t}"),
                "a time after that of the line before",
            ));
        }
        gather.outline(Key { cell: &cell, frame }, Some(t), &points, &place)?;
        times.push(t);
        frame += 1;
    }
    let (mut cells, mut notes) = gather.finish(&input.place, Apart::Names("write one cell per file"))?;
    let interval = median_difference(&times);
    match numbers(&times, interval) {
        Some(numbers) => renumber(&mut cells, &mut notes, &numbers),
        None => notes.push(Note::UnevenTimes { cell }),
    }
    let length = Said { step: None, unit: Some("um".to_owned()), applied: true };
    let time = Said { step: interval, unit: Some("s".to_owned()), applied: true };
    Ok(Found { cells, notes, scale: Scale { length, time }, image: None })
}

/// Frames in the order of the file become frames in intervals.
fn renumber(cells: &mut [Cell], notes: &mut [Note], numbers: &[i64]) {
    let number = |frame: &mut i64| *frame = numbers.get(*frame as usize).copied().unwrap_or(*frame);
    cells.iter_mut().flat_map(|cell| &mut cell.frames).for_each(|outline| number(&mut outline.frame));
    for note in notes {
        if let Note::MissingVertices { frames, .. } = note {
            frames.iter_mut().for_each(number);
        }
    }
}

fn one_frame(line: &str, place: &Place) -> Result<(f64, Vec<[f64; 2]>)> {
    let mut values = Vec::new();
    for word in line.split_ascii_whitespace() {
        values.push(crate::input::number(word, "a value", place)?);
    }
    let [t, rest @ ..] = values.as_slice() else {
        return Err(Error::structure(place, "nothing", "t x0 y0 x1 y1 ..."));
    };
    let (points, odd) = rest.as_chunks::<2>();
    if !odd.is_empty() || !t.is_finite() {
        let found = format!("time {t} and {} values", rest.len());
        return Err(Error::structure(place, found, "a finite time and pairs of x and y"));
    }
    Ok((*t, points.to_vec()))
}
