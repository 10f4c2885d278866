//! Units in the header of a table.

use crate::header::{TIME, X, Y, letters};
use crate::scale::unit;
use crate::{Error, FRAME, PIXEL, Result};
use std::path::Path;

/// Units of lengths and of times that are known in a header.
pub(crate) const LENGTHS: &[&str] = &["nm", "um", "mm", "cm", "m", PIXEL];
pub(crate) const TIMES: &[&str] = &["ms", "s", "min", "h", "d", FRAME];

/// The header of a column in its parts.
pub(crate) struct Divided<'a> {
    /// The name without the unit.
    pub(crate) name: &'a str,
    /// The unit, in its one spelling; as it is written where it is not known.
    unit: Option<String>,
}

/// A name and the unit behind it, in brackets, or as the last word of a place or a time: `x_um`, but not `x_min`, which is a smallest x.
pub(crate) fn divided(name: &str) -> Divided<'_> {
    let named = |&(before, _): &(&str, &str)| before.contains(char::is_alphanumeric);
    if let Some((before, rest)) = name.split_once(['[', '(']).filter(named) {
        let word = rest.trim_end().trim_end_matches([']', ')']).trim();
        return Divided { name: before, unit: (!word.is_empty()).then(|| unit(word)) };
    }
    let alone = Divided { name, unit: None };
    let Some((before, word)) = name.trim_end().rsplit_once(['_', ' ', '.', '/', '-']).filter(named) else {
        return alone;
    };
    let (bare, unit) = (letters(before), unit(word));
    // x_m may be a mean
    let is_of = |usual: &[&str], units: &[&str]| {
        usual.contains(&&*bare) && units.contains(&&*unit) && !matches!(&*unit, "m" | "cm")
    };
    let fits = is_of(X, LENGTHS) || is_of(Y, LENGTHS) || is_of(TIME, TIMES);
    if fits && !word.is_empty() { Divided { name: before, unit: Some(unit) } } else { alone }
}

/// The unit of a column, if it has one of these.
///
/// # Errors
/// [`Error::HeaderUnit`] if it has another one.
fn known(name: &str, units: &[&str], file: &Path) -> Result<Option<String>> {
    match divided(name).unit {
        Some(unit) if !units.contains(&&*unit) => Err(Error::HeaderUnit {
            file: file.to_owned(),
            found: format!("the unit {unit:?} of the column {name:?} is not one of {}", units.join(", ")),
            remedy: "write one of these in the header, or none and give the option",
        }),
        unit => Ok(unit),
    }
}

/// The unit of the columns x and y.
///
/// # Errors
/// [`Error::HeaderUnit`] if it is not known, or not the same for both.
pub(crate) fn lengths(names: [&str; 2], file: &Path) -> Result<Option<String>> {
    let [x, y] = [known(names[0], LENGTHS, file)?, known(names[1], LENGTHS, file)?];
    if x == y {
        return Ok(x);
    }
    let [a, b] = [x, y].map(|unit| unit.unwrap_or_else(|| "none".to_owned()));
    Err(Error::HeaderUnit {
        file: file.to_owned(),
        found: format!("the columns {:?} and {:?} have different units, {a} and {b}", names[0], names[1]),
        remedy: "convert one of them, and write the same unit in both",
    })
}

/// The unit of a column of times.
///
/// # Errors
/// [`Error::HeaderUnit`] if it is not known.
pub(crate) fn time(name: &str, file: &Path) -> Result<Option<String>> {
    known(name, TIMES, file)
}

/// Seconds in each part of the times of a column whose unit names parts, `time [h:m:s]`, `time (mm:ss)`.
pub(crate) fn parts(name: &str) -> Option<Vec<f64>> {
    let unit = divided(name).unit.filter(|unit| unit.contains(':'))?;
    let seconds = |part: &str| match part.trim().to_lowercase().as_str() {
        "h" | "hh" => Some(3600.0),
        "m" | "mm" | "min" => Some(60.0),
        "s" | "ss" | "sec" => Some(1.0),
        _ => None,
    };
    let parts: Option<Vec<f64>> = unit.split(':').map(seconds).collect();
    parts.filter(|parts| parts.windows(2).all(|pair| pair[0] == 60.0 * pair[1]))
}

/// Refuses a column of frames with a unit of time.
///
/// # Errors
/// [`Error::HeaderUnit`] if it has one.
pub(crate) fn no_time(name: &str, file: &Path) -> Result<()> {
    match divided(name).unit {
        Some(unit) if unit != FRAME && TIMES.contains(&&*unit) => Err(Error::HeaderUnit {
            file: file.to_owned(),
            found: format!(
                "the column {name:?} has a unit of time, {unit}, and is named as one of frames, which are counts"
            ),
            remedy: "name it time if it holds times, or take the unit out of the header",
        }),
        _ => Ok(()),
    }
}
