//! Settings of the continuation of branches: steps, tolerance, sides, with orbits or without.

use crate::Error;
use crate::plan::check;
use serde::{Deserialize, Serialize};

motiform_dynamics::named! {
    /// The sides to which a start is followed.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Towards by name {
        /// Larger values of the parameter.
        Up = "up",
        /// Smaller values.
        Down = "down",
        /// Both.
        #[default]
        Both = "both",
    }
}

impl Towards {
    /// The sides of this name.
    ///
    /// # Errors
    /// [`Error::UnknownName`].
    pub fn parse(name: &str) -> Result<Self, Error> {
        let known = Self::ALL.map(Self::name);
        let choice = "give up, down or both".to_owned();
        Self::find(name).ok_or_else(|| Error::unknown("direction", name, &known, choice))
    }

    /// Returns `true` if larger values are among them.
    pub const fn is_up(self) -> bool {
        !matches!(self, Self::Down)
    }

    /// Returns `true` if smaller values are among them.
    pub const fn is_down(self) -> bool {
        !matches!(self, Self::Up)
    }
}

/// Steps, tolerance, sides and kinds of motion; what is `None` is left to the numerics.
///
/// # Units    lengths along a branch: 1 is the width of the range, the size of the first shape, or a period
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Stride {
    /// First step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_step: Option<f64>,
    /// Longest step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub branch_step: Option<f64>,
    /// Newton's method has converged with a step shorter than this.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// The sides to which the start is followed. What begins on its branch is followed to all of its own.
    #[serde(default, skip_serializing_if = "is_both")]
    pub direction: Towards,
    /// Follow steady motions alone, not the orbits that begin at Hopf points.
    #[serde(default, skip_serializing_if = "is_false")]
    pub steady: bool,
    /// Of the orbits follow those alone that begin where a stable motion loses its stability.
    #[serde(default, skip_serializing_if = "is_false")]
    pub from_stable: bool,
    /// Doublings of the period in a row that are followed, by default [`DOUBLINGS`]: in a cascade each branch takes twice as long as the
    /// one before, in a range that is 4.7 times shorter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doublings: Option<u64>,
}

/// Doublings in a row: three make one ratio of neighbouring intervals, which tells a cascade.
pub const DOUBLINGS: u64 = 3;

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
const fn is_false(value: &bool) -> bool {
    !*value
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_both(towards: &Towards) -> bool {
    *towards == Towards::Both
}

/// The default of the longest step, which a first step must not exceed.
const BRANCH_STEP: f64 = 0.02;

/// Shortest and longest steps that can be asked for.
const STEPS: (f64, f64) = (1e-6, 1.0);

/// Tightest and loosest tolerance. Newton's method converges quadratically, so a looser one saves nothing; where branches meet it converges
/// slowly, and would leave points beside them.
const TOLERANCES: (f64, f64) = (1e-13, 1e-7);

impl Stride {
    /// Returns `true` if everything is left to the numerics.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Checks the numbers, and that there is a side to follow a start to that lies at `value` of the range.
    pub(crate) fn check(&self, value: f64, (from, to): (f64, f64)) -> Result<(), Error> {
        let within = |x: f64, (least, most): (f64, f64)| (least..=most).contains(&x);
        if let Some(step) = self.branch_step {
            check("branch_step", step, within(step, STEPS), "give a part of the range, from 1e-6 to 1")?;
        }
        if let Some(first) = self.first_step {
            let most = self.branch_step.unwrap_or(BRANCH_STEP);
            let remedy = "give a part of the range, from 1e-6 to branch_step (0.02, if not given)";
            check("first_step", first, within(first, (STEPS.0, most)), remedy)?;
        }
        if let Some(tolerance) = self.tolerance {
            let remedy = "give a number from 1e-13 to 1e-7";
            check("tolerance", tolerance, within(tolerance, TOLERANCES), remedy)?;
        }
        let nothing = |remedy| {
            Err(Error::Setting { key: "direction", value: self.direction.name().to_owned(), remedy })
        };
        match self.direction {
            Towards::Up if value >= to => nothing(
                "the start lies at the upper end of the range: give a range that reaches beyond it, or down",
            ),
            Towards::Down if value <= from => nothing(
                "the start lies at the lower end of the range: give a range that reaches beyond it, or up",
            ),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_out_of_range_and_empty_sides_are_refused() {
        let check = |stride: Stride, value: f64| stride.check(value, (0.0, 1.0));
        assert!(check(Stride::default(), 0.0).is_ok());
        let fine = Stride { first_step: Some(0.1), branch_step: Some(0.1), ..Stride::default() };
        assert!(check(fine, 0.5).is_ok());
        for stride in [
            Stride { branch_step: Some(0.0), ..Stride::default() },
            Stride { branch_step: Some(f64::NAN), ..Stride::default() },
            Stride { first_step: Some(0.03), ..Stride::default() },
            Stride { tolerance: Some(1e-3), ..Stride::default() },
            Stride { first_step: Some(1e-4), branch_step: Some(1e-5), ..Stride::default() },
        ] {
            assert!(check(stride, 0.5).is_err(), "{stride:?}");
        }
        for (direction, value) in [(Towards::Up, 1.0), (Towards::Down, 0.0)] {
            let stride = Stride { direction, ..Stride::default() };
            assert!(check(stride, value).is_err() && check(stride, 0.5).is_ok());
        }
    }

    #[test]
    fn the_default_is_not_written() {
        assert_eq!(serde_json::to_string(&Stride::default()).ok().as_deref(), Some("{}"));
        assert_eq!(serde_json::from_str::<Stride>("{}").ok(), Some(Stride::default()));
    }
}
