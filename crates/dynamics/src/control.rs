//! How long the next step may be.

use crate::steppers::Tableau;
use crate::steppers::tableau::ErrorEstimate;
use crate::{Error, steppers::runge_kutta::Slopes};

/// The choice of step size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepControl {
    /// Every step has this size (the last may be shorter, to end at the end).
    Fixed {
        /// Step size (model time), above 0.
        step: f64,
    },
    /// The estimated error of a step stays below `atol + rtol |u|` (root mean square over the state).
    Adaptive {
        /// Relative tolerance, from 1e-14 to 0.1.
        rtol: f64,
        /// Absolute tolerance, at least 0 and finite.
        atol: f64,
    },
}

impl StepControl {
    /// Checks the numbers, and that `tableau` can do what is asked.
    ///
    /// # Errors
    /// [`Error::OutOfRange`], [`Error::NoErrorEstimate`].
    pub fn validate(&self, tableau: &Tableau) -> Result<(), Error> {
        self.validate_for(tableau.name, tableau.is_adaptive())
    }

    /// Checks the numbers, and that the method `stepper` can do what is asked.
    pub(crate) fn validate_for(&self, stepper: &'static str, is_adaptive: bool) -> Result<(), Error> {
        let in_range = |name, value: f64, ok: bool, range| {
            if ok && value.is_finite() { Ok(()) } else { Err(Error::OutOfRange { name, value, range }) }
        };
        match *self {
            Self::Fixed { step } => in_range("step", step, step > 0.0, "above 0"),
            Self::Adaptive { .. } if !is_adaptive => Err(Error::NoErrorEstimate { stepper }),
            Self::Adaptive { rtol, atol } => {
                in_range("rtol", rtol, (1e-14..=0.1).contains(&rtol), "between 1e-14 and 0.1")?;
                in_range("atol", atol, atol >= 0.0, "of at least 0")
            }
        }
    }
}

/// Proportional-integral step-size control.
///
/// `h_new = h * 0.9 * err^-(1/q - 0.75 beta) * err_old^beta`, within fixed factors; `q` is the order of the estimate
/// plus one. After a rejection the step does not grow at once.
///
/// Source: Gustafsson (1991), ACM Trans. Math. Softw. 17, 533; Hairer, Norsett, Wanner, IV.2.
#[derive(Clone, Debug)]
pub(crate) struct Controller {
    exponent: f64,
    beta: f64,
    shrink: f64,
    grow: f64,
    previous: f64,
    rejected: bool,
}

impl Controller {
    pub(crate) fn new(tableau: &Tableau) -> Self {
        let (estimate_order, beta, shrink, grow) = match tableau.error {
            ErrorEstimate::Pair { .. } => (7, 0.0, 1.0 / 3.0, 6.0),
            ErrorEstimate::Embedded { order, .. } => (order, 0.04, 0.2, 10.0),
            ErrorEstimate::None => (tableau.order, 0.0, 0.2, 10.0),
        };
        let exponent = 1.0 / f64::from(estimate_order + 1) - 0.75 * beta;
        Self { exponent, beta, shrink, grow, previous: 1e-4, rejected: false }
    }

    /// The factor for the step size after a step with this error norm; `Err` when the step must be repeated.
    pub(crate) fn judge(&mut self, error: f64) -> Result<f64, f64> {
        if !error.is_finite() {
            self.rejected = true;
            return Err(self.shrink);
        }
        let factor = 0.9 * libm::pow(error.max(1e-30), -self.exponent);
        if error > 1.0 {
            self.rejected = true;
            return Err(factor.clamp(self.shrink, 1.0));
        }
        let grow = if self.rejected { 1.0 } else { self.grow };
        self.rejected = false;
        let factor = factor * libm::pow(self.previous, self.beta);
        self.previous = error.max(1e-4);
        Ok(factor.clamp(self.shrink, grow))
    }
}

/// Error norms of one step against the tolerances.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    pub(crate) rtol: f64,
    pub(crate) atol: f64,
}

impl Tolerance {
    /// `sqrt(mean((e_i / (atol + rtol max(|u_i|, |v_i|)))^2))`. A zero over a zero counts as no error.
    pub(crate) fn norm(&self, error: &[f64], u: &[f64], v: &[f64]) -> f64 {
        let mut sum = 0.0;
        for ((&e, &a), &b) in error.iter().zip(u).zip(v) {
            if e != 0.0 {
                let scaled = e / (self.atol + self.rtol * a.abs().max(b.abs()));
                sum += scaled * scaled;
            }
        }
        (sum / error.len() as f64).sqrt()
    }

    /// The norm of a step's estimated error; `scratch` has the state's length.
    pub(crate) fn step_error(
        &self,
        tableau: &Tableau,
        slopes: &Slopes<f64>,
        h: f64,
        (u, v): (&[f64], &[f64]),
        scratch: &mut [f64],
    ) -> f64 {
        let mut norm_of = |weights| {
            slopes.combine(weights, scratch);
            self.norm(scratch, u, v)
        };
        match tableau.error {
            ErrorEstimate::None => 0.0,
            ErrorEstimate::Embedded { weights, .. } => h * norm_of(weights),
            ErrorEstimate::Pair { fifth, third } => {
                let (five, three) = (norm_of(fifth), norm_of(third));
                let denominator = (five * five + 0.01 * three * three).sqrt();
                if denominator == 0.0 { 0.0 } else { h * five * five / denominator }
            }
        }
    }
}
