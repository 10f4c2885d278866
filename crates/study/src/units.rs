//! What a unit of length and a unit of time of a model are in the laboratory.

use crate::Error;
use crate::titles::number;

/// Powers of length and time.
pub type Dimension = [i8; 2];

/// A size and its unit.
#[derive(Clone, Debug, PartialEq)]
struct Unit {
    size: f64,
    name: String,
}

/// A unit of length and one of time, such as 20 µm and 1 min.
#[derive(Clone, Debug, PartialEq)]
pub struct Units([Unit; 2]);

impl Units {
    /// Reads `20um,1min`; nothing from an empty text.
    ///
    /// # Errors
    /// [`Error::Setting`].
    pub fn parse(text: &str) -> Result<Option<Self>, Error> {
        if text.is_empty() {
            return Ok(None);
        }
        let both = text
            .split_once(',')
            .and_then(|(length, time)| Some(Self([Unit::parse(length)?, Unit::parse(time)?])));
        both.map(Some).ok_or_else(|| Error::Setting {
            key: "figure.units",
            value: text.to_owned(),
            remedy: "write what a unit of length and one of time are, such as 20um,1min",
        })
    }

    /// The factor from model units.
    #[must_use]
    pub fn factor(&self, dimension: Dimension) -> f64 {
        self.0.iter().zip(dimension).map(|(unit, power)| unit.size.powi(power.into())).product()
    }

    /// The name of a unit (markup): µm/min, 1/min, µm^2.
    #[must_use]
    pub fn name(&self, dimension: Dimension) -> String {
        let power = |(unit, power): (&Unit, i8)| match power {
            1 => unit.name.clone(),
            _ => format!("{}^{{{power}}}", unit.name),
        };
        let part = |sign: i8| {
            let powers =
                self.0.iter().zip(dimension.map(|power| sign * power)).filter(|(_, power)| *power > 0);
            powers.map(power).collect::<Vec<_>>().join("\u{a0}")
        };
        match (part(1), part(-1)) {
            (above, below) if below.is_empty() => above,
            (above, below) if above.is_empty() => format!("1/{below}"),
            (above, below) => format!("{above}/{below}"),
        }
    }
}

/// The units in which results are shown: physical ones, or those of the model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown(Option<Units>);

impl Shown {
    /// Physical units as [`Units::parse`] reads them; those of the model from an empty text.
    ///
    /// # Errors
    /// [`Error::Setting`].
    pub fn parse(text: &str) -> Result<Self, Error> {
        Units::parse(text).map(Self)
    }

    /// Whether they are physical.
    #[must_use]
    pub fn is_physical(&self) -> bool {
        self.0.is_some()
    }

    /// The factor from model units.
    #[must_use]
    pub fn factor(&self, dimension: Dimension) -> f64 {
        self.0.as_ref().map_or(1.0, |units| units.factor(dimension))
    }

    /// The name of a unit (markup); `plain` for one of the model.
    #[must_use]
    pub fn name(&self, dimension: Dimension, plain: &str) -> String {
        self.0.as_ref().map_or_else(|| plain.to_owned(), |units| units.name(dimension))
    }

    /// The label of an axis with its unit, which numbers and model units have not.
    #[must_use]
    pub fn label(&self, quantity: &str, dimension: Dimension) -> String {
        let unit = self.0.as_ref().filter(|_| dimension != [0, 0]);
        unit.map_or_else(|| quantity.to_owned(), |units| format!("{quantity} ({})", units.name(dimension)))
    }

    /// A value in model units as words with its unit; `plain` stands for it where that is of the model.
    #[must_use]
    pub fn words(&self, value: f64, dimension: Dimension, plain: &str) -> String {
        let shown = number(value * self.factor(dimension));
        self.0
            .as_ref()
            .map_or_else(|| format!("{shown}{plain}"), |units| format!("{shown} {}", units.name(dimension)))
    }

    /// What a caption says of them, after the name of the model.
    #[must_use]
    pub fn caption(&self) -> String {
        match self.0 {
            Some(_) => {
                format!(
                    ", unit of length {}, of time {}",
                    self.words(1.0, LENGTH, ""),
                    self.words(1.0, TIME, "")
                )
            }
            None => ", in model units".to_owned(),
        }
    }
}

/// The dimension of a length.
pub const LENGTH: Dimension = [1, 0];
/// The dimension of a time.
pub const TIME: Dimension = [0, 1];
/// The dimension of a speed.
pub const SPEED: Dimension = [1, -1];
/// The dimension of a rate.
pub const RATE: Dimension = [0, -1];

impl Unit {
    fn parse(text: &str) -> Option<Self> {
        let number = text.trim().trim_end_matches(char::is_alphabetic);
        let name = text.trim()[number.len()..].to_owned();
        let size: f64 = number.trim().parse().ok()?;
        let name = if name == "um" { "µm".to_owned() } else { name };
        (size > 0.0 && size.is_finite() && !name.is_empty()).then_some(Self { size, name })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_have_sizes_and_names() {
        let units = Units::parse("20 um, 1e-1min").unwrap().unwrap();
        assert_eq!(units.factor([1, -1]), 200.0);
        let names = [[1, 0], [1, -1], [0, -1], [2, 1]].map(|dimension| units.name(dimension));
        assert_eq!(names, ["µm", "µm/min", "1/min", "µm^{2}\u{a0}min"]);
        assert_eq!(Units::parse("").unwrap(), None);
        let (physical, model) = (Shown(Some(units)), Shown::default());
        assert_eq!(physical.label("speed", SPEED), "speed (µm/min)");
        assert_eq!(physical.label("angle", [0, 0]), "angle");
        assert_eq!(model.label("speed", SPEED), "speed");
        assert_eq!(
            (physical.words(3.0, TIME, ""), model.words(3.0, TIME, " time")),
            ("0.3 min".into(), "3 time".into())
        );
        assert_eq!(physical.caption(), ", unit of length 20 µm, of time 0.1 min");
        for bad in ["20um", "20,1", "um,min", "-1um,1min", "0um,1min", "infum,1s"] {
            assert!(Units::parse(bad).is_err(), "{bad}");
        }
    }
}
