//! The scales of equations, in which settings that are not given are measured.

use crate::Error;
use crate::checks::check;
use motiform_analysis::equilibrium::{Units, balance, largest_balance, prefix};
use motiform_dynamics::Equivariant;
use motiform_models::ModelInfo;
use std::ops::RangeInclusive;

/// Maximum model time of equations with rates of ordinary size: beyond it, the time has too few digits for steps of order 1.
const LONGEST: f64 = 1e9;

/// Sizes at which terms balance and beside which 0.01 is small.
pub(crate) const SMALL_BESIDE: RangeInclusive<f64> = 0.1..=10.0;

/// Sizes at which terms balance and twice of which starts up to the size 1 reach.
pub(crate) const REACHED_BY_ONE: RangeInclusive<f64> = 0.1..=0.5;

/// The scales of equations, from the sizes at which their terms balance: powers of 1000, 1 for equations of ordinary size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// The median size of shapes ([`Units::of`]).
    pub length: f64,
    /// The largest size of shapes.
    pub largest: f64,
    /// Rates of shapes of that median size.
    pub rate: f64,
}

impl Scales {
    /// The scales of a field, measured from its values alone.
    pub fn of(body: &dyn Equivariant) -> Self {
        let Units { length, rate } = Units::of(body);
        Self { length, largest: prefix(largest_balance(body)), rate }
    }

    /// Those of ordinary equations.
    pub const ORDINARY: Self = Self { length: 1.0, largest: 1.0, rate: 1.0 };

    /// The scales of a model at all of these parameters: the smallest length and rate, and the largest size.
    pub(crate) fn over(info: &ModelInfo, all: &[Vec<f64>]) -> Result<Self, Error> {
        let mut scales = all.iter().map(|values| Self::of_model(info, values));
        let first = scales.next().unwrap_or(Ok(Self::ORDINARY))?;
        scales.try_fold(first, |one, other| {
            let other = other?;
            Ok(Self {
                length: one.length.min(other.length),
                largest: one.largest.max(other.largest),
                rate: one.rate.min(other.rate),
            })
        })
    }

    /// The size of random starts of a model at all of these parameters: its own, if that is not 1, or twice the size at which terms
    /// balance. `None` where that is one of the `ordinary` ones.
    pub(crate) fn starts(
        info: &ModelInfo,
        all: &[Vec<f64>],
        ordinary: &RangeInclusive<f64>,
    ) -> Result<Option<f64>, Error> {
        if info.is_built_in() {
            return Ok(None);
        }
        if info.size != 1.0 {
            return Ok((Self::over(info, all)?.length != 1.0).then_some(info.size));
        }
        let bodies: Vec<_> = all.iter().map(|values| info.build(values)).collect::<Result<_, _>>()?;
        let bodies: Vec<&dyn Equivariant> =
            bodies.iter().map(|body| body.as_ref() as &dyn Equivariant).collect();
        let size = balance(&bodies);
        Ok((!ordinary.contains(&size)).then(|| one_digit(2.0 * size)))
    }

    /// The size of typical shapes of a model at these parameters: its own, if that is not 1, or that at which its terms balance.
    ///
    /// # Errors
    /// Values that the model rejects.
    pub fn typical(info: &ModelInfo, values: &[f64]) -> Result<f64, Error> {
        Ok(if info.size == 1.0 { Self::of_model(info, values)?.length } else { info.size })
    }

    /// The scales of a model at these parameters, in registry order. The models of this program have no dimensions: their sizes are
    /// ordinary.
    ///
    /// # Errors
    /// Values that the model rejects.
    pub fn of_model(info: &ModelInfo, values: &[f64]) -> Result<Self, Error> {
        if info.is_built_in() {
            return Ok(Self::ORDINARY);
        }
        let model = info.build(values)?;
        let noise = model.noise().amplitudes.into_iter().fold(0.0, f64::max);
        Ok(Self::of(model.as_ref()).under(noise, info.look_at(values)))
    }

    /// The absolute tolerance of equations whose shapes have the size 1, for these.
    pub fn absolute_tolerance(self, ordinary: f64) -> f64 {
        ordinary * self.length.min(1.0)
    }

    /// The norm beyond which a shape has escaped.
    pub fn escape_norm(self) -> f64 {
        1e6 * self.largest.max(1.0)
    }

    /// The same under noise of this amplitude, which leads as far as a free path in a look: linear equations have no size of their own.
    pub(crate) fn under(self, noise: f64, look: f64) -> Self {
        Self { largest: self.largest.max(prefix(noise * look.sqrt())), ..self }
    }

    /// The longest model time.
    pub fn longest(self) -> f64 {
        LONGEST / self.rate.min(1.0)
    }

    /// Rejects a time above the longest one, and one of 0 where `positive`.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the key, the value and the remedy.
    pub fn check_time(self, key: &'static str, time: f64, positive: bool) -> Result<(), Error> {
        let usable = time <= self.longest() && if positive { time > 0.0 } else { time >= 0.0 };
        let remedy = match (positive, self.rate < 1.0) {
            (true, false) => "give a time above 0, at most 1e9",
            (false, false) => "give a time from 0 to 1e9",
            (true, true) => "give a time above 0, at most 1e9 over the rate of these slow equations",
            (false, true) => "give a time from 0 to 1e9 over the rate of these slow equations",
        };
        check(key, time, usable, remedy)
    }
}

/// A positive number to one digit.
fn one_digit(x: f64) -> f64 {
    format!("{x:.0e}").parse().unwrap_or(x)
}
