//! A measured number with its interval, or the reason why there is none.

use serde::Serialize;

/// A value with its 95 % confidence interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// Ends of the interval; `None` where the units ([`crate::Errors`]) that contribute are too few.
    #[serde(flatten, serialize_with = "ends")]
    pub interval: Option<[f64; 2]>,
}

/// `lower` and `upper`, or nothing.
fn ends<S: serde::Serializer>(interval: &Option<[f64; 2]>, serializer: S) -> Result<S::Ok, S::Error> {
    use serde::ser::SerializeMap;
    let mut map = serializer.serialize_map(None)?;
    if let Some([lower, upper]) = interval {
        map.serialize_entry("lower", lower)?;
        map.serialize_entry("upper", upper)?;
    }
    map.end()
}

impl Measured {
    /// The value and the ends as functions of them, for one that increases.
    #[must_use]
    pub fn map(self, rising: impl Fn(f64) -> f64) -> Self {
        Self { value: rising(self.value), interval: self.interval.map(|ends| ends.map(rising)) }
    }

    /// Lower end; NaN without an interval (an empty field in tables).
    pub fn lower(&self) -> f64 {
        self.interval.map_or(f64::NAN, |ends| ends[0])
    }

    /// Upper end; NaN without an interval.
    pub fn upper(&self) -> f64 {
        self.interval.map_or(f64::NAN, |ends| ends[1])
    }

    /// Half the width of the interval; 0 without one.
    pub fn half_width(&self) -> f64 {
        self.interval.map_or(0.0, |[lower, upper]| 0.5 * (upper - lower))
    }
}

/// A measured value, or why there is none.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Answer {
    /// The value.
    Known(Measured),
    /// The samples do not show it.
    Unknown {
        /// The reason, in a sentence.
        reason: String,
    },
}

impl Answer {
    /// No value, for this reason.
    pub fn unknown(reason: impl Into<String>) -> Self {
        Self::Unknown { reason: reason.into() }
    }

    /// The value, if there is one.
    pub fn known(&self) -> Option<Measured> {
        match self {
            Self::Known(measured) => Some(*measured),
            Self::Unknown { .. } => None,
        }
    }

    /// The same with an interval that reaches at least so far to both sides of the value, if it has one.
    pub(crate) fn at_least(self, half_width: f64) -> Self {
        let Self::Known(Measured { value, interval }) = self else { return self };
        let interval =
            interval.map(|[low, high]| [low.min(value - half_width), high.max(value + half_width)]);
        Self::Known(Measured { value, interval })
    }

    /// The same with an interval on the logarithm that also holds an independent change by this factor, if it has one.
    pub(crate) fn or_by_the_factor(self, factor: f64) -> Self {
        let Self::Known(Measured { value, interval }) = self else { return self };
        let wider = |end: f64| libm::exp(libm::hypot(libm::log(end / value), libm::log(factor)));
        let interval = interval.map(|[low, high]| [value / wider(low), value * wider(high)]);
        Self::Known(Measured { value, interval })
    }

    /// The same without a value, where there is a reason.
    pub(crate) fn unless(self, reason: Option<String>) -> Self {
        match reason {
            Some(reason) if self.known().is_some() => Self::Unknown { reason },
            _ => self,
        }
    }

    /// The answer; where it is unknown because the record is too short, this reason replaces the advice to record longer.
    pub(crate) fn unreachable_since(self, why: &str) -> Self {
        match self {
            Self::Unknown { reason } if reason.starts_with("not reached") => Self::unknown(why),
            other => other,
        }
    }

    /// The reason why there is no value, if there is none.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Known(_) => None,
            Self::Unknown { reason } => Some(reason),
        }
    }
}
