//! An axis of a scan: a parameter, or a coordinate of the start, and the values it takes.

use crate::Error;
use motiform_dynamics::digits::given;
use motiform_dynamics::sample::ascending;
use motiform_models::spelling::ascii;
use motiform_models::{ModelInfo, parameters};
use serde::{Deserialize, Serialize};

/// Maximum number of values of one axis.
const MOST_VALUES: usize = 100_000;

/// A parameter or coordinate that a scan varies, with its values in the order of the cells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// The parameter, or the coordinate of the initial shape (for a map of basins).
    pub name: String,
    /// Its values, at least one, all different and finite.
    pub values: Vec<f64>,
}

impl Axis {
    /// Reads `NAME=LOW:HIGH:COUNT` (COUNT values, evenly spaced, both ends included; COUNT = 1 gives LOW) or
    /// `NAME=v1,v2,v3`.
    ///
    /// # Errors
    /// [`Error::Axis`] with the remedy.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let wrong = |problem: String| Error::Axis { text: text.to_owned(), problem };
        let form = "write NAME=LOW:HIGH:COUNT, e.g. kappa2=0.1:1.6:64, or NAME=v1,v2,v3";
        let (name, rest) = text.split_once('=').ok_or_else(|| wrong(form.to_owned()))?;
        let (name, rest) = (name.trim(), rest.trim());
        if name.is_empty() || rest.is_empty() {
            return Err(wrong(form.to_owned()));
        }
        let values = if rest.contains(':') { range(rest, form) } else { listed(rest) }.map_err(wrong)?;
        let axis = Self { name: ascii(name), values };
        axis.check()?;
        Ok(axis)
    }

    /// Returns `true` if it varies the start, and not a parameter: a coordinate of the shape of the model with these parameters.
    ///
    /// # Errors
    /// A name that is neither, with the nearest parameter.
    pub fn varies_start(&self, info: &ModelInfo, values: &[f64]) -> Result<bool, Error> {
        let unknown = parameters::index_of(info.parameters(), info.name, &self.name).err();
        let coordinate = info.coordinates(values).iter().any(|coordinate| coordinate.name == self.name);
        match unknown {
            Some(error) if !coordinate => Err(error.into()),
            unknown => Ok(unknown.is_some()),
        }
    }

    /// The text that reads back as this axis ([`Axis::parse`]), every value with all its digits.
    pub fn to_text(&self) -> String {
        let values: Vec<String> = self.values.iter().map(|value| format!("{value:?}")).collect();
        format!("{}={}", self.name, values.join(","))
    }

    /// Rejects an axis without values, with too many, or with one that is not finite or occurs twice.
    pub(super) fn check(&self) -> Result<(), Error> {
        let wrong = |problem: String| Error::Axis { text: self.name.clone(), problem };
        if self.values.is_empty() {
            return Err(wrong("it has no points: give at least one value".to_owned()));
        }
        if self.values.len() > MOST_VALUES {
            return Err(wrong(format!(
                "{} points are too many: give at most {MOST_VALUES}",
                self.values.len()
            )));
        }
        if let Some(value) = self.values.iter().find(|value| !value.is_finite()) {
            return Err(wrong(format!("{value} is not finite: give finite numbers")));
        }
        let mut sorted = self.values.clone();
        ascending(&mut sorted);
        match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(twice) => Err(wrong(format!("the value {} occurs twice: give different values", twice[0]))),
            None => Ok(()),
        }
    }
}

/// For display: `kappa2 = 0.1 to 1.6 (64 values)`, or the values if they are few.
impl std::fmt::Display for Axis {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.values.as_slice() {
            few if few.len() <= 5 => {
                let values: Vec<String> = few.iter().copied().map(given).collect();
                write!(f, "{} = {}", self.name, values.join(", "))
            }
            [first, .., last] => {
                let [first, last] = [*first, *last].map(given);
                write!(f, "{} = {first} to {last} ({} values)", self.name, self.values.len())
            }
            _ => f.write_str(&self.name),
        }
    }
}

/// The values of `LOW:HIGH:COUNT`.
fn range(text: &str, form: &str) -> Result<Vec<f64>, String> {
    let fields: Vec<&str> = text.split(':').map(str::trim).collect();
    let [low, high, count] = fields[..] else { return Err(form.to_owned()) };
    let (low, high) = (number(low)?, number(high)?);
    let count: usize = count.parse().map_err(|_| {
        format!("COUNT = {count:?} is not a whole number: give the number of points, e.g. 64")
    })?;
    if count > MOST_VALUES {
        return Err(format!("COUNT = {count} is too many: give at most {MOST_VALUES}"));
    }
    if count == 0 {
        return Err("COUNT = 0 leaves no points: give at least 1".to_owned());
    }
    if count > 1 && low == high {
        return Err(format!("LOW and HIGH are both {low}: give different ones, or COUNT = 1"));
    }
    let last = count - 1;
    // Weights of the two ends: exact at both, and no overflow between them.
    let value = |i: usize| match i {
        0 => low,
        i if i == last => high,
        i => {
            let part = i as f64 / last as f64;
            low * (1.0 - part) + high * part
        }
    };
    Ok((0..count).map(value).collect())
}

/// The values of `v1,v2,v3`.
fn listed(text: &str) -> Result<Vec<f64>, String> {
    text.split(',').map(|value| number(value.trim())).collect()
}

/// A finite number that was typed.
///
/// # Errors    in words, with the remedy
pub fn number(text: &str) -> Result<f64, String> {
    let value: f64 =
        text.parse().map_err(|_| format!("{text:?} is not a number: write it like 0.5 or 1e-9"))?;
    if value.is_finite() { Ok(value) } else { Err(format!("{text} is not finite: give a finite number")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<f64> {
        Axis::parse(text).unwrap().values
    }

    #[test]
    fn ranges_hold_both_ends_and_lists_their_order() {
        assert_eq!(
            values("kappa2=0.1:1.6:4"),
            [0.1, 0.1 * (2.0 / 3.0) + 1.6 / 3.0, values("a=0.1:1.6:4")[2], 1.6]
        );
        assert_eq!(values("kappa2 = 0 : 1 : 5"), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(values("kappa2=2:1:3"), [2.0, 1.5, 1.0]);
        assert_eq!(values("kappa2=0.3:9:1"), [0.3]);
        assert_eq!(values("kappa2=0.3,-1, 2e-3"), [0.3, -1.0, 2e-3]);
        assert_eq!(values("kappa2=0.3"), [0.3]);
        assert!(values("kappa2=-1.7e308:1.7e308:9").iter().all(|value| value.is_finite()));
    }

    #[test]
    fn what_is_no_axis_is_refused() {
        for bad in [
            "",
            "kappa2",
            "=1:2:3",
            "kappa2=",
            "kappa2=1:2",
            "kappa2=1:2:3:4",
            "kappa2=1:2:0",
            "kappa2=1:2:-1",
            "kappa2=1:2:1.5",
            "kappa2=a:2:3",
            "kappa2=1:inf:3",
            "kappa2=1,,2",
            "kappa2=1,nan",
            "kappa2=1,2,1",
            "kappa2=1:1:2",
            "kappa2=1:2:100001",
            "kappa2=0,-0",
        ] {
            assert!(Axis::parse(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn the_error_in_a_value_is_one_rounding() {
        for (i, value) in values("kappa2=0.1:1.6:64").into_iter().enumerate() {
            let exact = 0.1 + 1.5 * i as f64 / 63.0;
            assert!((value - exact).abs() <= 4.0 * f64::EPSILON * exact, "{i}"); // three operations each
        }
    }
}
