//! Velocities of cells that depend on their places.

use super::grid::Grid;
use motiform_dynamics::Normal;
use motiform_dynamics::sample::sort_by_number;
use serde::Serialize;

/// Fewest cells: four numbers of a gradient and two of a mean velocity leave something to tell them from.
const LEAST_CELLS: usize = 6;
/// Significance.
const LEVEL: f64 = 1e-3;
/// Random turns of single velocities, their seed, and the share of them that may show as much.
const TURNS: usize = 1000;
const SEED: u64 = 1;
const SHARE: f64 = 0.01;
/// Steps towards the median of the velocities.
const STEPS: usize = 30;

/// The change of the velocity of cells with their place: of a flow that shears, a colony that spreads, walls all around, a field of view
/// that turns or changes its magnification.
///
/// # Units   of the data
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Flow {
    /// The derivatives of each coordinate of the velocity by both coordinates of the place.
    pub gradient: [[f64; 2]; 2],
    /// Probability of such a gradient, or a clearer one, of cells whose velocities do not depend on where they begin (Wilks' Lambda; where
    /// turns at random of single velocities show as much in 1 % and more, their share).
    pub p_value: f64,
}

impl Flow {
    /// `true` if velocities differ from place to place.
    pub fn is_seen(&self) -> bool {
        self.p_value < LEVEL
    }

    /// Least squares of the mean velocity v_c of each of n cells, from the second frame on, on its place in the first one, whose error is
    /// not in v_c. With the squares E that are left and T of all, w = sqrt(det E/det T) has the distribution Beta(n - 4, 2) for normal
    /// v_c, and p = (n - 3) w^(n - 4) - (n - 4) w^(n - 3), exact. Cells that come later come from the sides, and go inwards: they do not
    /// count. One fast cell far from slow ones is no flow, which the test of one variance does not know: where velocities less their
    /// median, each turned by a random angle, have such a w in 1 % of the draws and more, p is that share.
    ///
    /// Source: Wilks (1932), Biometrika 24, 471.
    pub(super) fn of(grid: &Grid) -> Option<Self> {
        let one = |cell: usize| Some((grid.places[cell][0]?, grid.mean_velocity(cell, 1)?));
        let mut all: Vec<([f64; 2], [f64; 2])> = (0..grid.cells()).filter_map(one).collect();
        if all.len() < LEAST_CELLS {
            return None;
        }
        // in an order of their own: random turns depend neither on that of the file nor on the axes
        let centre = mean(&all.iter().map(|cell| cell.0).collect::<Vec<_>>());
        sort_by_number(&mut all, |cell| distance(cell.0, centre));
        let n = all.len() as f64;
        let (places, velocities): (Vec<_>, Vec<_>) = all.into_iter().unzip();
        let (gradient, w) = regression(&places, &velocities);
        let p_value = (n - 3.0) * libm::pow(w, n - 4.0) - (n - 4.0) * libm::pow(w, n - 3.0);
        let share = if p_value < LEVEL { share_of_turns(&places, &velocities, w) } else { 0.0 };
        let p_value = if share < SHARE { p_value } else { share };
        p_value.is_finite().then_some(Self { gradient, p_value })
    }
}

/// The gradient of velocities over places by least squares, and w (see [`Flow::of`]).
fn regression(places: &[[f64; 2]], velocities: &[[f64; 2]]) -> ([[f64; 2]; 2], f64) {
    let (squares, moved) = (products(places, places), products(velocities, places));
    let det = |m: [[f64; 2]; 2]| m[0][0] * m[1][1] - m[0][1] * m[1][0];
    let inverse = [[squares[1][1], -squares[0][1]], [-squares[1][0], squares[0][0]]];
    let gradient = [0, 1]
        .map(|i| [0, 1].map(|j| (moved[i][0] * inverse[0][j] + moved[i][1] * inverse[1][j]) / det(squares)));
    let whole = products(velocities, velocities);
    let left = [0, 1]
        .map(|i| [0, 1].map(|j| whole[i][j] - gradient[i][0] * moved[j][0] - gradient[i][1] * moved[j][1]));
    (gradient, (det(left) / det(whole)).clamp(0.0, 1.0).sqrt())
}

/// Share of the draws whose w is at most this one, of velocities less their median, each turned by an angle of its own; each draw and its
/// mirror image.
fn share_of_turns(places: &[[f64; 2]], velocities: &[[f64; 2]], w: f64) -> f64 {
    let middle = middle(velocities);
    let mut random = Normal::new(SEED, 0);
    let mut as_clear = 0;
    for _draw in 0..TURNS / 2 {
        let turns: Vec<(f64, f64)> =
            velocities.iter().map(|_| libm::sincos(std::f64::consts::TAU * random.uniform())).collect();
        for sense in [1.0, -1.0] {
            let turned = velocities.iter().zip(&turns).map(|(v, (s, c))| {
                let [x, y] = [v[0] - middle[0], v[1] - middle[1]];
                [c * x - sense * s * y, sense * s * x + c * y]
            });
            as_clear += usize::from(regression(places, &turned.collect::<Vec<_>>()).1 <= w);
        }
    }
    as_clear as f64 / TURNS as f64
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

fn mean(all: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|k| all.iter().map(|x| x[k]).sum::<f64>() / all.len() as f64)
}

/// The median of points in the plane, which turns with them: the point whose mean distance from all is least, by Weiszfeld's steps.
fn middle(all: &[[f64; 2]]) -> [f64; 2] {
    let mut middle = mean(all);
    let size = all.iter().map(|x| distance(*x, middle)).fold(0.0, f64::max);
    for _step in 0..STEPS {
        let weights: Vec<f64> = all.iter().map(|x| 1.0 / distance(*x, middle).max(1e-6 * size)).collect();
        let sum: f64 = weights.iter().sum();
        middle = [0, 1].map(|k| all.iter().zip(&weights).map(|(x, weight)| weight * x[k]).sum::<f64>() / sum);
    }
    middle
}

/// Sums over cells of the products of deviations from the means.
fn products(a: &[[f64; 2]], b: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let (u, v) = (mean(a), mean(b));
    [0, 1].map(|i| [0, 1].map(|j| a.iter().zip(b).map(|(a, b)| (a[i] - u[i]) * (b[j] - v[j])).sum()))
}
