//! Errors of a joint fit from the differences between cells.
//!
//! The errors of [`crate::Fit`] assume that all cells follow one law and that frames are independent given
//! the state. Where each cell has its own law, they are too small. Here whole cells are the units: with the
//! score `s_c` of each cell at the estimate and the covariance `C` of the estimates, leaving cell c out moves
//! the estimate by `-C s_c` to first order, and
//!
//! ```text
//! covariance = K/(K - 1) sum_c (C s_c)(C s_c)^T,      K cells
//! ```
//!
//! is the infinitesimal jackknife: what resampling whole cells gives for many cells, without fitting again.
//!
//! Source: Jaeckel (1972), Bell Labs memorandum MM 72-1215-11; Efron (1982), The Jackknife, the Bootstrap and
//! Other Resampling Plans, ch. 6.

use crate::filter::{Want, evaluate};
use crate::fit::problem;
use crate::{CellScatter, Error, Fit, Result, Settings, Track, observation};
use motiform_dynamics::distributions::chi_square_tail;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Fewest cells between which differences are measured.
const LEAST: usize = 2;

/// Standard errors of the coefficients of one law, from how the estimates change when each cell is left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BetweenCells {
    /// Number of cells.
    pub cells: usize,
    /// Standard error of each coefficient, in the order of [`Fit::coefficients`] and the units of the data.
    pub errors: Vec<f64>,
    /// The shift of each coefficient by each cell: estimate with it less that without it, to first order.
    pub shifts: Vec<Vec<f64>>,
}

/// Significance of the differences between cells in a coefficient.
pub(crate) const DIFFER: f64 = 0.01;

impl BetweenCells {
    /// The coefficients in which cells differ by more than one law with its errors lets them, each with its p-value: of
    /// `(K - 1) (error between cells)^2/(error of one law)^2` against chi-square with K - 1 degrees of freedom, the larger one of the
    /// expected and the robust error. Significant are those below 1 % over their number.
    pub fn differing(&self, fit: &Fit) -> Vec<(String, f64)> {
        let p = |(between, one): (&f64, &crate::Coefficient)| {
            let law = one.estimate.error.max(one.estimate.robust);
            (one.name.clone(), differ(between * between, law * law, self.cells))
        };
        let level = DIFFER / fit.coefficients.len() as f64;
        self.errors.iter().zip(&fit.coefficients).map(p).filter(|one| one.1 < level).collect()
    }
}

/// The p-value of a variance between this many cells where one law has the other one.
pub(crate) fn differ(between: f64, law: f64, cells: usize) -> f64 {
    let freedom = cells.saturating_sub(1);
    if law > 0.0 { chi_square_tail(freedom as f64 * between / law, freedom as f64) } else { 1.0 }
}

impl Fit {
    /// The fit with the differences between its cells: intervals over sets of terms, and of places in the planes, then hold where each cell
    /// has its own law. Their errors are the largest one of the expected, the robust, and that between cells; the last one is multiplied by
    /// `factor` where cells differ significantly, since it comes from few of them (the quotient of Student's and the normal quantile).
    #[must_use]
    pub fn with_cells(mut self, between: &BetweenCells, factor: f64) -> Self {
        let units: Vec<f64> = self.coefficients.iter().map(|c| self.scales.coefficient(&c.term)).collect();
        let n = units.len();
        let share = between.cells as f64 / (between.cells as f64 - 1.0);
        let entry = |i: usize, j: usize| {
            let products = between.shifts.iter().map(|shift| shift[i] / units[i] * shift[j] / units[j]);
            share * products.sum::<f64>()
        };
        let covariance = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
        self.natural.cells = Some(CellScatter { cells: between.cells, covariance, factor });
        self
    }
}

/// The errors of a joint fit from the differences between its cells.
///
/// # Errors    of the input; [`Error::Setting`] for fewer than two cells
/// # Checked by  `tests/all/together.rs`: fits with each cell left out, and the scatter of joint fits of cells that differ
pub fn between_cells(tracks: &[Track], fit: &Fit) -> Result<BetweenCells> {
    observation::check(tracks, fit.library.modes)?;
    let cells = tracks.len();
    if cells < LEAST {
        return Err(Error::Setting { key: "cells", value: cells as f64, remedy: "give two cells or more" });
    }
    let settings = Settings { library: fit.library.clone(), handed: fit.handed, starts: Vec::new() };
    let theta = fit.theta();
    let n = fit.natural.covariance.len();
    let covariance = DMatrix::from_fn(n, n, |i, j| fit.natural.covariance[i][j]);
    let score = |track: &Track| {
        evaluate(&problem(std::slice::from_ref(track), &settings, &fit.scales), &theta, Want::Exact, false)
            .gradient
    };
    let scores: Vec<DVector<f64>> = tracks.iter().map(score).collect();
    // The prior's part of the gradient, which makes the sum 0, is shared; so is what the search left over.
    let mean = scores.iter().fold(DVector::zeros(n), |sum, score| sum + score) / cells as f64;
    let moved: Vec<DVector<f64>> = scores.iter().map(|score| &covariance * (score - &mean)).collect();
    let units: Vec<f64> = fit.coefficients.iter().map(|c| fit.scales.coefficient(&c.term)).collect();
    let factor = cells as f64 / (cells - 1) as f64;
    let error = |(i, unit): (usize, &f64)| {
        let squares: f64 = moved.iter().map(|shift| shift[i] * shift[i]).sum();
        unit * (factor * squares).sqrt()
    };
    let shifts = |shift: &DVector<f64>| units.iter().enumerate().map(|(i, unit)| unit * shift[i]).collect();
    Ok(BetweenCells {
        cells,
        errors: units.iter().enumerate().map(error).collect(),
        shifts: moved.iter().map(shifts).collect(),
    })
}
