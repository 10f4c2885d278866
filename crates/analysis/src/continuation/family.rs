//! Bodies that depend on one parameter.

use super::problem::Failure;
use crate::{Error, Result};
use motiform_dynamics::Equivariant;

/// A body for every value of a parameter.
///
/// Any closure of this shape is one:
///
/// ```
/// use motiform_analysis::continuation::Family;
/// use motiform_dynamics::Equivariant;
/// use motiform_models::zoo::Hopf;
/// let family = |mu: f64| Ok(Box::new(Hopf { mu, omega: 2.0 }) as Box<dyn Equivariant>);
/// assert_eq!(family.at(0.25)?.dim(), 2);
/// # Ok::<(), motiform_analysis::Error>(())
/// ```
///
/// The field must depend smoothly on the parameter. All bodies of a family have the same dimension and the same symmetry.
pub trait Family: Sync {
    /// The body for this value.
    ///
    /// # Errors
    /// [`Error::NoBody`] where there is none, with the reason.
    fn at(&self, parameter: f64) -> Result<Box<dyn Equivariant>>;
}

impl<F: Fn(f64) -> Result<Box<dyn Equivariant>> + Sync> Family for F {
    fn at(&self, parameter: f64) -> Result<Box<dyn Equivariant>> {
        self(parameter)
    }
}

/// A body and its two neighbours, whose difference is the derivative by the parameter.
pub(super) struct Neighbours {
    /// The body itself.
    pub(super) body: Box<dyn Equivariant>,
    /// The body beyond it.
    pub(super) above: Box<dyn Equivariant>,
    /// The body before it.
    pub(super) below: Box<dyn Equivariant>,
    /// Difference of their parameters.
    pub(super) width: f64,
}

impl Neighbours {
    /// The body at `parameter`, with neighbours so close that the central difference has about ten digits: more than a Newton step
    /// needs, whose residual is exact. At the end of what the model allows the difference is one-sided.
    pub(super) fn of(family: &dyn Family, parameter: f64) -> std::result::Result<Self, Failure> {
        let step = 1e-5 * (1.0 + parameter.abs());
        let at = |value: f64| family.at(value).map(|body| (value, body));
        let (_, body) = at(parameter)?;
        let (high, above) = at(parameter + step).or_else(|_: Error| at(parameter))?;
        let (low, below) = at(parameter - step).or_else(|_: Error| at(parameter))?;
        Ok(Self { body, above, below, width: high - low })
    }
}
