//! Coordinates that an orbit has lost near a saddle: they became too small for a number, and no longer grow.

use super::{RelativeEquilibrium, linearisation};
use crate::linear::eigenvalues;
use motiform_dynamics::Equivariant;

/// Least size of a coordinate at the start, and largest size of one that has been lost.
const SIZES: [f64; 2] = [1e-200, 1e-300];

impl RelativeEquilibrium {
    /// Returns `true` if coordinates that were not 0 at the start are too small for a number now (below 1e-300), and would grow from
    /// here: then the orbit stays because of that alone. Between saddles, in a heteroclinic cycle, its rests lengthen until this happens.
    pub(crate) fn holds_what_was_lost(&self, body: &dyn Equivariant, start: &[f64], now: &[f64]) -> bool {
        let lost = |i: &usize| start[*i].abs() > SIZES[0] && now[*i].abs() < SIZES[1];
        let lost: Vec<usize> = (0..now.len()).filter(lost).collect();
        if lost.is_empty() {
            return false;
        }
        let matrix = linearisation(body, &self.shape, self.turning_rate);
        let within: Vec<Vec<f64>> =
            lost.iter().map(|&j| lost.iter().map(|&i| matrix[j][i]).collect()).collect();
        eigenvalues(&within).is_some_and(|values| values.iter().any(|value| value.0 > 0.0))
    }
}
