//! Any stepper by name: explicit or exponential.

use super::{EXPONENTIAL_STEPPERS, ExponentialTableau, STEPPERS, Tableau, find, find_exponential};
use crate::{Error, ExponentialOrbit, InPlane, Integration, Model, Orbit, Semilinear, StepControl};

/// A stepper of either kind, as named in a study.
#[derive(Clone, Copy, Debug)]
pub enum Method {
    /// An explicit Runge-Kutta method.
    Explicit(&'static Tableau),
    /// An exponential method, for fields with a stiff linear part.
    Exponential(&'static ExponentialTableau),
}

impl Method {
    /// The stepper of this name.
    pub fn find(name: &str) -> Option<Self> {
        find(name).map(Self::Explicit).or_else(|| find_exponential(name).map(Self::Exponential))
    }

    /// All names.
    pub fn names() -> Vec<&'static str> {
        let explicit = STEPPERS.iter().map(|tableau| tableau.name);
        explicit.chain(EXPONENTIAL_STEPPERS.iter().map(|tableau| tableau.name)).collect()
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Explicit(tableau) => tableau.name,
            Self::Exponential(tableau) => tableau.name,
        }
    }

    /// Returns `true` if the method can control its step.
    pub fn is_adaptive(self) -> bool {
        match self {
            Self::Explicit(tableau) => tableau.is_adaptive(),
            Self::Exponential(tableau) => tableau.is_adaptive(),
        }
    }

    /// Checks that the method supports `control`.
    ///
    /// # Errors
    /// As [`StepControl::validate`].
    pub fn validate(self, control: StepControl) -> Result<(), Error> {
        control.validate_for(self.name(), self.is_adaptive())
    }

    /// An orbit of a field alone, from `shape` at time `t`: for a stretch whose path is not needed.
    ///
    /// # Errors
    /// As [`Orbit::new`].
    pub fn shape_orbit<'b, F: Semilinear<f64> + ?Sized>(
        self,
        model: &'b F,
        control: StepControl,
        t: f64,
        shape: &[f64],
    ) -> Result<Box<dyn Integration + 'b>, Error> {
        Ok(match self {
            Self::Explicit(tableau) => Box::new(Orbit::new(model, tableau, control, t, shape)?),
            Self::Exponential(tableau) => Box::new(ExponentialOrbit::new(model, tableau, control, t, shape)?),
        })
    }

    /// An orbit of `body` (a model in the plane: shape, then x, y) from `u` at time `t`.
    ///
    /// # Errors
    /// As [`Orbit::new`].
    pub fn orbit<'b>(
        self,
        body: &'b InPlane<&'b dyn Model>,
        control: StepControl,
        t: f64,
        u: &[f64],
    ) -> Result<Box<dyn Integration + 'b>, Error> {
        Ok(match self {
            Self::Explicit(tableau) => Box::new(Orbit::new(body, tableau, control, t, u)?),
            Self::Exponential(tableau) => {
                Box::new(ExponentialOrbit::in_plane(body.0, tableau, control, t, u)?)
            }
        })
    }
}
