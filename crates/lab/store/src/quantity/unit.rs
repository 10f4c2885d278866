//! Units of length and time that are known by their names.

use super::Dimension;

/// A unit of length or time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Its one spelling in files: `um`, `min`.
    pub name: &'static str,
    /// Others, in lower case.
    spellings: &'static [&'static str],
    /// A length or a time.
    pub dimension: Dimension,
    /// Its size in metres or seconds.
    pub size: f64,
}

const fn length(name: &'static str, size: f64, spellings: &'static [&'static str]) -> Unit {
    Unit { name, spellings, dimension: Dimension::LENGTH, size }
}

const fn time(name: &'static str, size: f64, spellings: &'static [&'static str]) -> Unit {
    Unit { name, spellings, dimension: Dimension::TIME, size }
}

const MICROMETRES: &[&str] =
    &["µm", "μm", "micron", "microns", "micrometer", "micrometers", "micrometre", "micrometres"];

/// All of them.
const UNITS: [Unit; 13] = [
    length("nm", 1e-9, &["nanometer", "nanometers", "nanometre", "nanometres"]),
    length("um", 1e-6, MICROMETRES),
    length("mm", 1e-3, &["millimeter", "millimeters", "millimetre", "millimetres"]),
    length("cm", 1e-2, &["centimeter", "centimeters", "centimetre", "centimetres"]),
    length("m", 1.0, &["meter", "meters", "metre", "metres"]),
    length("km", 1e3, &[]),
    time("ns", 1e-9, &["nanosecond", "nanoseconds"]),
    time("us", 1e-6, &["µs", "μs", "microsecond", "microseconds"]),
    time("ms", 1e-3, &["millisecond", "milliseconds"]),
    time("s", 1.0, &["sec", "secs", "second", "seconds"]),
    time("min", 60.0, &["mins", "minute", "minutes"]),
    time("h", 3600.0, &["hr", "hrs", "hour", "hours"]),
    time("d", 86400.0, &["day", "days"]),
];

impl Unit {
    /// The unit of a name in any of its spellings; `None` where it is not known.
    pub fn named(name: &str) -> Option<&'static Self> {
        let lower = name.trim().to_lowercase();
        UNITS.iter().find(|unit| unit.name == lower || unit.spellings.contains(&&*lower))
    }

    /// One unit in terms of another; `None` where they are not known to measure the same.
    pub fn ratio(one: &str, other: &str) -> Option<f64> {
        if one == other {
            return Some(1.0);
        }
        let (one, other) = (Self::named(one)?, Self::named(other)?);
        (one.dimension == other.dimension).then_some(one.size / other.size)
    }

    /// A name as pages and figures show it: `um` as `µm`; others stay as they are.
    pub fn typeset(name: &str) -> String {
        match name {
            "um" => "µm".to_owned(),
            "us" => "µs".to_owned(),
            other => other.to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Dimension, UNITS, Unit};

    #[test]
    fn each_spelling_is_of_one_unit() {
        for unit in &UNITS {
            let all = unit.spellings.iter().chain([&unit.name]);
            for name in all {
                let count = UNITS.iter().filter(|u| u.name == *name || u.spellings.contains(name)).count();
                assert_eq!((count, Unit::named(name)), (1, Some(unit)), "{name}");
            }
        }
        assert_eq!(Unit::named(" Microns ").map(|unit| unit.name), Some("um"));
        assert_eq!(Unit::named("pears"), None);
        assert_eq!(Unit::typeset("um"), "µm");
    }

    #[test]
    fn ratios_are_those_of_one_dimension() {
        let near = |ratio: Option<f64>, wanted: f64| ratio.is_some_and(|r| (r / wanted - 1.0).abs() < 1e-12);
        assert!(near(Unit::ratio("mm", "µm"), 1e3) && near(Unit::ratio("d", "min"), 1440.0));
        assert_eq!((Unit::ratio("m", "s"), Unit::ratio("pears", "pears")), (None, Some(1.0)));
        assert!(UNITS.iter().all(|unit| [Dimension::LENGTH, Dimension::TIME].contains(&unit.dimension)));
    }
}
