//! Velocities of cells that depend on their places.

use super::grid::Grid;
use serde::Serialize;

/// Fewest cells: four numbers of a gradient and two of a mean velocity leave something to tell them from.
const LEAST_CELLS: usize = 6;
/// Significance.
const LEVEL: f64 = 1e-3;

/// The change of the velocity of cells with their place: of a flow that shears, a colony that spreads, walls all around, a field of view
/// that turns or changes its magnification.
///
/// # Units   of the data
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Flow {
    /// The derivatives of each coordinate of the velocity by both coordinates of the place.
    pub gradient: [[f64; 2]; 2],
    /// Probability of such a gradient, or a clearer one, of cells whose velocities do not depend on where they begin (Wilks' Lambda).
    pub p_value: f64,
}

impl Flow {
    /// `true` if velocities differ from place to place.
    #[must_use]
    pub fn is_seen(&self) -> bool {
        self.p_value < LEVEL
    }

    /// Least squares of the mean velocity v_c of each of n cells, from the second frame on, on its place in the first one, whose error is
    /// not in v_c. With the squares E that are left and T of all, w = sqrt(det E/det T) has the distribution Beta(n - 4, 2) for normal
    /// v_c, and p = (n - 3) w^(n - 4) - (n - 4) w^(n - 3), exact. Cells that come later come from the sides, and go inwards: they do not
    /// count.
    ///
    /// Source: Wilks (1932), Biometrika 24, 471.
    pub(super) fn of(grid: &Grid) -> Option<Self> {
        let one = |cell: usize| Some((grid.places[cell][0]?, grid.mean_velocity(cell, 1)?));
        let all: Vec<([f64; 2], [f64; 2])> = (0..grid.cells()).filter_map(one).collect();
        if all.len() < LEAST_CELLS {
            return None;
        }
        let n = all.len() as f64;
        let (places, velocities): (Vec<_>, Vec<_>) = all.into_iter().unzip();
        let squares = products(&places, &places);
        let moved = products(&velocities, &places);
        let det = |m: [[f64; 2]; 2]| m[0][0] * m[1][1] - m[0][1] * m[1][0];
        let inverse = [[squares[1][1], -squares[0][1]], [-squares[1][0], squares[0][0]]];
        let gradient = [0, 1].map(|i| {
            [0, 1].map(|j| (moved[i][0] * inverse[0][j] + moved[i][1] * inverse[1][j]) / det(squares))
        });
        let whole = products(&velocities, &velocities);
        let left = [0, 1].map(|i| {
            [0, 1].map(|j| whole[i][j] - gradient[i][0] * moved[j][0] - gradient[i][1] * moved[j][1])
        });
        let w = (det(left) / det(whole)).clamp(0.0, 1.0).sqrt();
        let p_value = (n - 3.0) * libm::pow(w, n - 4.0) - (n - 4.0) * libm::pow(w, n - 3.0);
        p_value.is_finite().then_some(Self { gradient, p_value })
    }
}

/// Sums over cells of the products of deviations from the means.
fn products(a: &[[f64; 2]], b: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let mean = |of: &[[f64; 2]], k: usize| of.iter().map(|x| x[k]).sum::<f64>() / of.len() as f64;
    [0, 1].map(|i| {
        [0, 1].map(|j| {
            let (u, v) = (mean(a, i), mean(b, j));
            a.iter().zip(b).map(|(a, b)| (a[i] - u) * (b[j] - v)).sum()
        })
    })
}
