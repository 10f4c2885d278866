//! Bodies that depend on one parameter or two.

use super::allowance::Allowance;
use super::correct::TIGHT;
use super::problem::Failure;
use motiform_analysis::equilibrium::prefix;
use motiform_analysis::{Error, Result};
use motiform_dynamics::Equivariant;

/// A body for every value of a parameter.
///
/// Any closure of this shape is one:
///
/// ```
/// use motiform_continuation::Family;
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

    /// The allowance for orbits of these bodies; `None`: whatever it takes.
    fn allowance(&self) -> Option<&Allowance> {
        None
    }
}

impl<F: Fn(f64) -> Result<Box<dyn Equivariant>> + Sync> Family for F {
    fn at(&self, parameter: f64) -> Result<Box<dyn Equivariant>> {
        self(parameter)
    }
}

/// A body for every pair of values of two parameters. Any closure of this shape is one; what holds of a [`Family`] holds here.
pub trait Family2: Sync {
    /// The body for these values.
    ///
    /// # Errors
    /// [`Error::NoBody`] where there is none, with the reason.
    fn at(&self, parameters: [f64; 2]) -> Result<Box<dyn Equivariant>>;

    /// As [`Family::allowance`].
    fn allowance(&self) -> Option<&Allowance> {
        None
    }
}

impl<F: Fn([f64; 2]) -> Result<Box<dyn Equivariant>> + Sync> Family2 for F {
    fn at(&self, parameters: [f64; 2]) -> Result<Box<dyn Equivariant>> {
        self(parameters)
    }
}

/// Bodies over one parameter or two.
#[derive(Clone, Copy)]
pub(super) enum Bodies<'f> {
    /// Over one.
    One(&'f dyn Family),
    /// Over two.
    Two(&'f dyn Family2),
}

impl<'f> Bodies<'f> {
    /// The allowance for orbits.
    pub(super) fn allowance(self) -> Option<&'f Allowance> {
        match self {
            Self::One(family) => family.allowance(),
            Self::Two(family) => family.allowance(),
        }
    }

    /// Number of parameters.
    pub(super) const fn count(self) -> usize {
        match self {
            Self::One(_) => 1,
            Self::Two(_) => 2,
        }
    }

    /// The body whose parameters are the last of the unknowns `x`.
    pub(super) fn at(self, x: &[f64]) -> Result<Box<dyn Equivariant>> {
        match (self, x) {
            (Self::One(family), [.., p]) => family.at(*p),
            (Self::Two(family), [.., p, q]) => family.at([*p, *q]),
            _ => Err(Error::Shape { what: "the list of parameters", expected: self.count(), got: x.len() }),
        }
    }
}

/// Distance of the bodies whose differences are derivatives, in widths of the parameters.
const APART: f64 = 1e-5;

/// Distance of the bodies whose units are compared, in widths of the parameters.
const BESIDE: f64 = 0.05;

impl Bodies<'_> {
    /// The bodies at values beside these parameters. At a bifurcation a growth rate is zero, and the equations at that value alone would
    /// give a wrong unit.
    pub(super) fn beside(self, parameters: &[f64], widths: &[f64]) -> Vec<Box<dyn Equivariant>> {
        let mut beside = Vec::new();
        for (i, width) in widths.iter().enumerate() {
            for side in [-BESIDE, BESIDE] {
                let mut moved = parameters.to_vec();
                moved[i] += side * width;
                beside.extend(self.at(&moved));
            }
        }
        beside
    }
}

/// The distance at which errors of differences by round-off and by terms of third order are alike; `usual` where round-off is below the
/// tolerance of Newton's method, as it is where terms do not cancel.
pub(super) fn apart(usual: f64, round_off: f64) -> f64 {
    if round_off > TIGHT { usual.max(libm::cbrt(round_off)) } else { usual }
}

/// A body and its neighbours, whose differences are the derivatives by the parameters.
pub(super) struct Neighbours {
    /// The body itself.
    pub(super) body: Box<dyn Equivariant>,
    /// Those on both sides, for each parameter.
    pub(super) sides: Vec<Sides>,
    /// The unit of shapes.
    pub(super) length: f64,
}

/// Two neighbours of a body along one parameter.
pub(super) struct Sides {
    /// The body beyond it.
    pub(super) above: Box<dyn Equivariant>,
    /// The body before it.
    pub(super) below: Box<dyn Equivariant>,
    /// Difference of their parameters.
    pub(super) width: f64,
}

impl Neighbours {
    /// The body whose parameters are the last of `x`, varied over these widths, for shapes of this unit, with neighbours so close that the
    /// central difference has about ten digits: more than a Newton step needs, whose residual is exact. Equations with a larger `round_off`
    /// have neighbours farther apart. At the end of what the model allows the difference is one-sided.
    pub(super) fn of(
        bodies: Bodies<'_>,
        x: &[f64],
        widths: &[f64],
        (length, round_off): (f64, f64),
    ) -> std::result::Result<Self, Failure> {
        let parameters = &x[x.len() - bodies.count()..];
        let body = bodies.at(parameters)?;
        let mut sides = Vec::new();
        for (i, (&parameter, &width)) in parameters.iter().zip(widths).enumerate() {
            let step = apart(APART, round_off) * (prefix(width) + parameter.abs());
            let at = |value: f64| {
                let mut moved = parameters.to_vec();
                moved[i] = value;
                bodies.at(&moved).map(|body| (value, body))
            };
            let (high, above) = at(parameter + step).or_else(|_: Error| at(parameter))?;
            let (low, below) = at(parameter - step).or_else(|_: Error| at(parameter))?;
            sides.push(Sides { above, below, width: high - low });
        }
        Ok(Self { body, sides, length })
    }
}
