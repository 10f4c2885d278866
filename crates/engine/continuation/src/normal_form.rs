//! The leading coefficient of a normal form, as far as it is known.

use super::special::Special;
use serde::{Deserialize, Serialize};

/// A sign is that of a value of so many errors: an error that is read off two results may be too small.
const CLEAR: f64 = 3.0;

/// A coefficient and its error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Coefficient {
    /// Its value.
    pub value: f64,
    /// Bound of its error: the difference of two results with steps of different size.
    pub error: f64,
}

impl Coefficient {
    /// Returns `Some(true)` if it is below 0; `None` where it is not three times its error.
    pub fn is_negative(self) -> Option<bool> {
        (self.value.abs() > CLEAR * self.error).then_some(self.value < 0.0)
    }
}

/// Why a coefficient is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Undetermined {
    /// More than one direction is critical: motions of several kinds may begin.
    Directions,
    /// The critical direction is in a Jordan block with another one.
    Nilpotent,
    /// No direction is critical to within a part of 1000 of the others.
    NotCritical,
    /// Terms of second order do not vanish where those of third order should decide.
    Quadratic,
    /// The equations could not be solved near the point.
    Obstructed,
}

impl std::fmt::Display for Undetermined {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Directions => "more than one direction is critical",
            Self::Nilpotent => "the critical direction is in a Jordan block with another one",
            Self::NotCritical => "no direction is critical enough",
            Self::Quadratic => "the terms of second order do not vanish",
            Self::Obstructed => "the equations could not be solved near the point",
        })
    }
}

/// The leading coefficient, as far as it is known, of the normal form `xi' = c xi^n` at a special point, with time in the model's units
/// and `xi` the size of the critical deviation normal to the group: the Euclidean norm of the shape, of an orbit its root mean square over
/// the period, normal to the flow too. `n` is 2 at folds and where branches cross (3 if the coefficient of second order vanishes), 3
/// where a symmetry is broken. At a doubling of the period (or of half the period) the deviation is that of the orbit of twice the time;
/// multiplied by that time, `c` is the coefficient of its return map. For `n = 2` the sign of `xi`, and so that of `c`, is free: `c` is
/// positive. For `n = 3` what begins is stable in the critical direction where `c` is negative.
///
/// Source: Kuznetsov (2004), sections 5.4 and 7.3; per time as in Kuznetsov, Govaerts, Doedel and Dhooge (2005), SIAM J. Numer. Anal. 43,
/// 1407.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NormalForm {
    /// The coefficient.
    Coefficient(Coefficient),
    /// The coefficient of third order where branches cross and that of second order vanishes: a pitchfork of a symmetry that the model
    /// does not state.
    Cubic(Coefficient),
    /// Why there is none.
    Undetermined(Undetermined),
}

impl NormalForm {
    /// The coefficient, where it is known.
    pub const fn coefficient(self) -> Option<Coefficient> {
        match self {
            Self::Coefficient(coefficient) | Self::Cubic(coefficient) => Some(coefficient),
            Self::Undetermined(_) => None,
        }
    }
}

impl NormalForm {
    /// The same coefficient with a larger error.
    pub(super) fn widened(self, by: f64) -> Self {
        let wider = |found: Coefficient| Coefficient { error: found.error + by, ..found };
        match self {
            Self::Coefficient(found) => Self::Coefficient(wider(found)),
            Self::Cubic(found) => Self::Cubic(wider(found)),
            Self::Undetermined(_) => self,
        }
    }
}

impl From<Result<Coefficient, Undetermined>> for NormalForm {
    fn from(found: Result<Coefficient, Undetermined>) -> Self {
        found.map_or_else(Self::Undetermined, Self::Coefficient)
    }
}

/// The order of the leading term, and whether it is that of orbits of twice the time, at a special point; `None` where no coefficient is
/// computed here.
pub(super) const fn asked(special: Special) -> Option<(Order, bool)> {
    match special {
        Special::Fold => Some((Order::Second, false)),
        Special::BranchPoint => Some((Order::Lowest, false)),
        Special::Pitchfork { .. } => Some((Order::Third, false)),
        Special::PeriodDoubling | Special::SymmetryBreaking => Some((Order::Third, true)),
        _ => None,
    }
}

/// The order of the leading term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    /// At folds.
    Second,
    /// At crossings: the second one, unless it vanishes and the third one does not.
    Lowest,
    /// Where a symmetry is broken.
    Third,
}
