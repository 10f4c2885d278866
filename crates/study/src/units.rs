//! What a unit of length and a unit of time of a model are in the laboratory.

use crate::Error;

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
        for bad in ["20um", "20,1", "um,min", "-1um,1min", "0um,1min", "infum,1s"] {
            assert!(Units::parse(bad).is_err(), "{bad}");
        }
    }
}
