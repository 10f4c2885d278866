//! Physical units for the units of length and time of a model.

use crate::Error;
use crate::titles::number;
use motiform_store::quantity::Unit;
use motiform_store::{Dimension, Quantity};
use serde::{Deserialize, Serialize};

/// Settings of the figures of a result whose figures have nothing else to set.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct UnitSettings {
    /// As in [`Shown::parse`].
    #[serde(skip_serializing_if = "String::is_empty")]
    pub units: String,
}

/// A size and its unit.
#[derive(Clone, Debug, PartialEq)]
struct Size {
    size: f64,
    name: String,
}

/// The units in which results are shown: physical ones of length and time, such as 20 µm and 1 min, or those of the model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown(Option<[Size; 2]>);

impl Shown {
    /// Reads `20um,1min`; those of the model from an empty text.
    ///
    /// # Errors
    /// [`Error::Setting`].
    pub fn parse(text: &str) -> Result<Self, Error> {
        if text.is_empty() {
            return Ok(Self::default());
        }
        let both = text.split_once(',').and_then(|(length, time)| {
            Some([Size::parse(length, Dimension::LENGTH)?, Size::parse(time, Dimension::TIME)?])
        });
        let remedy = "write what a unit of length is (nm, um, mm, cm, m, km) and then one of time (ns, us, ms, s, min, h, d), such as \
                      20um,1min";
        both.map(|both| Self(Some(both))).ok_or_else(|| Error::Setting {
            key: "units",
            value: text.to_owned(),
            remedy,
        })
    }

    /// Returns `true` if they are physical.
    pub fn is_physical(&self) -> bool {
        self.0.is_some()
    }

    /// The factor from model units.
    pub fn factor(&self, dimension: Dimension) -> f64 {
        self.0.as_ref().map_or(1.0, |[length, time]| dimension.factor([length.size, time.size]))
    }

    /// The name of a unit (markup): µm/min, 1/min, µm^2; `plain` for one of the model.
    pub fn name(&self, dimension: Dimension, plain: &str) -> String {
        self.0.as_ref().map_or_else(|| plain.to_owned(), |[l, t]| dimension.unit([&l.name, &t.name]))
    }

    /// The label of an axis with its unit, which numbers and model units have not; radians always have.
    pub fn label(&self, label: &str, dimension: Dimension) -> String {
        let unit = match dimension {
            Dimension::ANGLE => "rad".to_owned(),
            Dimension::MIXED if self.is_physical() => "model units".to_owned(),
            _ => self.name(dimension, ""),
        };
        if unit.is_empty() { label.to_owned() } else { format!("{label} ({unit})") }
    }

    /// The label of the axis of a quantity.
    pub fn axis(&self, quantity: &Quantity) -> String {
        self.label(quantity.symbol, quantity.dimension)
    }

    /// A value in model units as words with its unit; `plain` stands for it where that is of the model.
    pub fn words(&self, value: f64, dimension: Dimension, plain: &str) -> String {
        let shown = number(value * self.factor(dimension));
        match self.is_physical() {
            true => format!("{shown} {}", self.name(dimension, "")),
            false => format!("{shown}{plain}"),
        }
    }

    /// Their sentence in a caption, after the name of the model.
    pub fn caption(&self) -> String {
        match self.0 {
            Some(_) => {
                format!(
                    ", unit of length {}, of time {}",
                    self.words(1.0, Dimension::LENGTH, ""),
                    self.words(1.0, Dimension::TIME, "")
                )
            }
            None => ", in model units".to_owned(),
        }
    }
}

impl Size {
    /// A number above 0 and a known name of this dimension.
    fn parse(text: &str, dimension: Dimension) -> Option<Self> {
        let number = text.trim().trim_end_matches(char::is_alphabetic);
        let unit = Unit::named(&text.trim()[number.len()..]).filter(|unit| unit.dimension == dimension)?;
        let size: f64 = number.trim().parse().ok()?;
        (size > 0.0 && size.is_finite()).then(|| Self { size, name: Unit::typeset(unit.name) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_store::quantity::motion::{MARGIN, NET_ROTATION, SIZE, SPEED};

    #[test]
    fn units_have_sizes_and_names() {
        let (physical, model) = (Shown::parse("20 um, 1e-1min").unwrap(), Shown::parse("").unwrap());
        assert_eq!(
            (physical.factor(Dimension::SPEED), physical.name(Dimension::SPEED, "")),
            (200.0, "µm/min".into())
        );
        let labels = |shown: &Shown| [&SPEED, &MARGIN, &NET_ROTATION, &SIZE].map(|one| shown.axis(one));
        let [speed, margin, rotation, size] =
            ["mean speed", "margin", "net rotation per period (rad)", "largest size |*u*| of the shape"];
        assert_eq!(labels(&model), [speed, margin, rotation, size]);
        let (speed, size) = (format!("{speed} (µm/min)"), format!("{size} (model units)"));
        assert_eq!(labels(&physical), [speed.as_str(), margin, rotation, size.as_str()]);
        assert_eq!(
            (physical.words(3.0, Dimension::TIME, ""), model.words(3.0, Dimension::TIME, " time")),
            ("0.3 min".into(), "3 time".into())
        );
        assert_eq!(physical.caption(), ", unit of length 20 µm, of time 0.1 min");
        for bad in
            ["20um", "20,1", "um,min", "-1um,1min", "0um,1min", "infum,1s", "1min,20um", "1h,1d", "20um,1mm"]
        {
            assert!(Shown::parse(bad).is_err(), "{bad}");
        }
        for bad in ["20kg,1min", "20mn,1hour", "20pears,1min", "20um,3moons"] {
            let told = Shown::parse(bad).unwrap_err().to_string();
            assert!(
                told.contains("(nm, um, mm, cm, m, km)") && told.contains("(ns, us, ms, s, min, h, d)"),
                "{told}"
            );
        }
        let hour = Shown::parse("3microns,1hour").unwrap();
        assert_eq!(hour.name(Dimension::SPEED, ""), "µm/h");
    }
}
