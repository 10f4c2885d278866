//! A velocity that all cells have.

use super::grid::Grid;
use serde::Serialize;

/// Fewest cells: two velocities have no distribution in the plane.
const LEAST_CELLS: usize = 3;
/// Significance.
const LEVEL: f64 = 1e-3;

/// The common velocity of cells: of the stage, of a flow, or of a direction that all of them prefer, which places do not tell apart.
///
/// # Units   of the data
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CommonDrift {
    /// Mean over cells of each cell's mean velocity, and its standard error.
    pub velocity: [f64; 2],
    /// See `velocity`.
    pub velocity_error: [f64; 2],
    /// Probability of such a common velocity, or a larger one, of cells that go in independent directions (Hotelling's T^2).
    pub p_value: f64,
    /// Time from which the displacement counts.
    #[serde(skip)]
    pub(super) since: f64,
}

impl CommonDrift {
    /// `true` if the cells drift together.
    pub fn is_seen(&self) -> bool {
        self.p_value < LEVEL
    }

    /// With the mean velocity v_c of each of n cells, m their mean and C their covariance: T^2 = n m^T C^-1 m, and p = (1 + T^2/(n -
    /// 1))^(-(n - 2)/2), exact for normal v_c.
    ///
    /// Source: Hotelling (1931), Ann. Math. Stat. 2, 360.
    pub(super) fn of(grid: &Grid) -> Option<Self> {
        let velocities: Vec<[f64; 2]> =
            (0..grid.cells()).filter_map(|cell| grid.mean_velocity(cell, 0)).collect();
        let n = velocities.len() as f64;
        if velocities.len() < LEAST_CELLS {
            return None;
        }
        let mean = [0, 1].map(|k| velocities.iter().map(|v| v[k]).sum::<f64>() / n);
        let covariance = |i: usize, j: usize| {
            velocities.iter().map(|v| (v[i] - mean[i]) * (v[j] - mean[j])).sum::<f64>() / (n - 1.0)
        };
        let (xx, xy, yy) = (covariance(0, 0), covariance(0, 1), covariance(1, 1));
        let determinant = xx * yy - xy * xy;
        let square = if determinant > 0.0 {
            n * (yy * mean[0] * mean[0] - 2.0 * xy * mean[0] * mean[1] + xx * mean[1] * mean[1]) / determinant
        } else {
            0.0
        };
        Some(Self {
            velocity: mean,
            velocity_error: [(xx / n).sqrt(), (yy / n).sqrt()],
            p_value: libm::pow(1.0 + square / (n - 1.0), -0.5 * (n - 2.0)),
            since: grid.times[0],
        })
    }
}
