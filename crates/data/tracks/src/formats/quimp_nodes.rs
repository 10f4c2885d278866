//! QuimP's `.snQP`: `#Frame N`, the count of nodes, then that many lines `position x y ...`.

use super::quimp_parameters::beside;
use super::{Found, stem};
use crate::detect::block;
use crate::gather::{Gather, Key};
use crate::input::{Input, number, whole};
use crate::{Apart, Error, Options, Place, Result};

/// The outlines in pixels, with the scale of the `.paQP` beside the file.
pub(super) fn read(mut input: Input, options: &Options) -> Result<Found> {
    let path = input.place.path().to_owned();
    let cell = stem(&path);
    let mut gather = Gather::new(options.limits);
    let mut line = String::new();
    let mut points = Vec::new();
    let mut frame = None;
    while input.line(&mut line)? {
        if let Some(number) = block(&line) {
            frame = Some(whole(number, "the frame", &input.here())?);
            continue;
        }
        if line.starts_with('#') || line.trim().is_empty() {
            continue;
        }
        let place = input.here();
        let wrong = || Error::structure(&place, "nodes", "a line #Frame N before them");
        let frame = frame.take().ok_or_else(wrong)?;
        let count = whole(&line, "the count of nodes", &place)?;
        nodes(&mut input, count, &mut points)?;
        gather.outline(Key { cell: &cell, frame }, None, &points, &place)?;
    }
    let (cells, notes) = gather.finish(&input.place, Apart::Names("write one cell per file"))?;
    Ok(Found { cells, notes, scale: beside(&path, options)?, image: None })
}

fn nodes(input: &mut Input, count: i64, points: &mut Vec<[f64; 2]>) -> Result<()> {
    points.clear();
    let mut line = String::new();
    for k in 0..count {
        let missing = || format!("node {} of {count}", k + 1);
        if !input.line(&mut line)? {
            return Err(Error::Truncated { place: input.here(), missing: missing() });
        }
        if line.starts_with('#') {
            return Err(Error::structure(&input.here(), "a comment", missing()));
        }
        points.push(node(&line, &input.here())?);
    }
    Ok(())
}

fn node(line: &str, place: &Place) -> Result<[f64; 2]> {
    let mut fields = line.split_ascii_whitespace().skip(1);
    let (Some(x), Some(y)) = (fields.next(), fields.next()) else {
        return Err(Error::structure(place, "a short line", "position x y"));
    };
    Ok([number(x, "x", place)?, number(y, "y", place)?])
}
