//! The sizes at which terms of a study's equations balance, from which its defaults follow.

use crate::random::Random;
use crate::scan::Axis;
use crate::{Error, Study};
use motiform_analysis::equilibrium::{Units, balance, largest_balance, prefix};
use motiform_dynamics::{Equivariant, Model};
use motiform_models::amplitudes::NAME;

/// The bodies whose scales those of a study are: one at its values or, where axes replace some of these, those at the ends of the axes.
/// None for the models of this program, whose defaults are those of their sizes.
pub(crate) struct Scales(Vec<Box<dyn Model>>);

impl Scales {
    /// Of a study whose values these axes replace.
    ///
    /// # Errors
    /// Values that the model rejects.
    pub(crate) fn of(study: &Study, axes: &[Axis]) -> Result<Self, Error> {
        let info = study.info()?;
        if info.name != NAME {
            return Ok(Self(Vec::new()));
        }
        let bodies =
            study.values_over(axes)?.iter().map(|values| info.build(values)).collect::<Result<_, _>>();
        Ok(Self(bodies?))
    }

    fn lengths(&self) -> impl Iterator<Item = f64> {
        self.0.iter().map(|body| Units::of(body.as_ref()).length)
    }

    /// The smallest unit of shapes ([`Units`]), at most 1.
    pub(crate) fn smallest(&self) -> f64 {
        self.lengths().fold(1.0, f64::min)
    }

    /// The largest unit at which terms balance, at least 1.
    pub(crate) fn largest(&self) -> f64 {
        self.0.iter().map(|body| prefix(largest_balance(body.as_ref()))).fold(1.0, f64::max)
    }

    /// The distribution of several random starts, or of one: twice the size at which terms balance, where their unit is not 1.
    pub(crate) fn starts(&self, several: bool, size: f64) -> Random {
        let bodies: Vec<&dyn Equivariant> =
            self.0.iter().map(|body| body.as_ref() as &dyn Equivariant).collect();
        match (self.lengths().all(|length| length == 1.0), several) {
            (true, true) => Random::basins(size),
            (true, false) => Random::SMALL,
            (false, true) => Random::basins(one_digit(2.0 * balance(&bodies))),
            (false, false) => Random::Within(0.01 * one_digit(2.0 * balance(&bodies))),
        }
    }
}

/// A positive number to one digit.
fn one_digit(x: f64) -> f64 {
    format!("{x:.0e}").parse().unwrap_or(x)
}
