//! Estimates given that some coefficients are 0.

use nalgebra::{DMatrix, DVector};

/// Estimates and covariance under the condition that the dropped coefficients are 0.
#[derive(Clone, Debug)]
pub(crate) struct Conditional {
    /// Estimates; 0 for those dropped.
    pub(crate) estimates: DVector<f64>,
    /// Their covariance.
    pub(crate) covariance: DMatrix<f64>,
    /// `theta_z^T (C_zz)^-1 theta_z` of those dropped: twice the fall of the log-likelihood.
    pub(crate) cost: f64,
}

impl Conditional {
    pub(crate) fn new(estimates: &[f64], covariance: DMatrix<f64>) -> Self {
        Self { estimates: DVector::from_column_slice(estimates), covariance, cost: 0.0 }
    }

    /// Of some coefficients alone.
    pub(crate) fn of(&self, places: &[usize]) -> Self {
        let n = places.len();
        Self {
            estimates: DVector::from_fn(n, |i, _| self.estimates[places[i]]),
            covariance: DMatrix::from_fn(n, n, |i, j| self.covariance[(places[i], places[j])]),
            cost: 0.0,
        }
    }

    /// The same with these coefficients set to 0, too.
    pub(crate) fn without(&self, dropped: impl Iterator<Item = usize>) -> Self {
        let mut rest = self.clone();
        dropped.for_each(|i| rest.drop(i));
        rest
    }

    /// Sets one more coefficient to 0. One that the others determine already costs nothing.
    pub(crate) fn drop(&mut self, i: usize) {
        let variance = self.covariance[(i, i)];
        if variance > 0.0 {
            let estimate = self.estimates[i];
            let column: DVector<f64> = self.covariance.column(i).into_owned();
            self.cost += estimate * estimate / variance;
            self.estimates.axpy(-estimate / variance, &column, 1.0);
            self.covariance.ger(-1.0 / variance, &column, &column, 1.0);
        }
        self.estimates[i] = 0.0;
        self.covariance.row_mut(i).fill(0.0);
        self.covariance.column_mut(i).fill(0.0);
    }
}
