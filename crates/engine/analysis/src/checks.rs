//! The requirements that every analysis makes of its samples.

use crate::{Error, Result};

/// Every sample is a finite number.
pub(crate) fn finite(samples: &[f64]) -> Result<()> {
    match samples.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(Error::NotFinite { index, value: samples[index] }),
        None => Ok(()),
    }
}

/// Every point has `expected` coordinates, all of them finite numbers.
pub(crate) fn points<'p>(points: impl Iterator<Item = &'p Vec<f64>>, expected: usize) -> Result<()> {
    for (index, point) in points.enumerate() {
        if point.len() != expected {
            return Err(Error::Shape { what: "a point", expected, got: point.len() });
        }
        if let Some(value) = point.iter().copied().find(|x| !x.is_finite()) {
            return Err(Error::NotFinite { index, value });
        }
    }
    Ok(())
}

/// There are enough of them.
pub(crate) fn at_least(what: &'static str, least: usize, got: usize) -> Result<()> {
    if got < least { Err(Error::TooFew { what, least, got }) } else { Ok(()) }
}

/// An argument is a finite number for which `ok` holds.
pub(crate) fn argument(name: &'static str, value: f64, ok: bool, range: &'static str) -> Result<()> {
    if ok && value.is_finite() { Ok(()) } else { Err(Error::OutOfRange { name, value, range }) }
}

/// Times are finite and each is after the one before it.
pub(crate) fn growing(times: &[f64]) -> Result<()> {
    finite(times)?;
    match times.windows(2).position(|pair| pair[1] <= pair[0]) {
        Some(before) => Err(Error::Order { index: before + 1, t: times[before + 1] }),
        None => Ok(()),
    }
}

/// The error of samples too large to square.
pub(crate) fn overflow(samples: &[f64]) -> Error {
    Error::Overflow { largest: samples.iter().fold(0.0, |m, x| x.abs().max(m)) }
}
