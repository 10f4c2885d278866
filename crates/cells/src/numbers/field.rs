//! What all cells of a field of view do together: a drift of the stage, a jitter of the images.

use super::places::Places;
use motiform_inference::Fix;
use serde::Serialize;
use std::collections::BTreeMap;

/// Fewest cells.
const LEAST_CELLS: usize = 5;
/// Significance of a common velocity.
const LEVEL: f64 = 1e-3;

/// The common motion of cells that are seen at the same times.
///
/// # Units   of the data
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FieldOfView {
    /// Cells.
    pub cells: usize,
    /// Mean over cells of each cell's mean velocity, and its standard error.
    pub velocity: [f64; 2],
    /// See `velocity`.
    pub velocity_error: [f64; 2],
    /// Probability of such a common velocity, or a larger one, of cells that go in independent directions (Hotelling's T^2).
    pub p_value: f64,
    /// Standard deviation of the displacement that all outlines of a frame have together, in each coordinate; 0 where it is below what independent cells have in common. `None`
    /// where no two frames have five cells.
    pub jitter: Option<f64>,
}

impl FieldOfView {
    /// Whether the cells drift together: by the stage, a flow, or all of them in one direction by themselves, which the places do not tell apart.
    #[must_use]
    pub fn drifts(&self) -> bool {
        self.p_value < LEVEL
    }
}

/// The common motion; `None` with fewer than five cells of two places.
///
/// With the mean velocity v_c of each of n cells, m their mean and C their covariance: T^2 = n m^T C^-1 m, and p = (1 + T^2/(n - 1))^(-(n - 2)/2), exact for normal v_c.
/// Jitter: a frame that is displaced by e moves all cells by e, and back in the next one: the covariance of the mean displacements of neighbouring intervals, without their means and without the part that each cell by
/// itself has, is -<e^2>.
///
/// Source: Hotelling (1931), Ann. Math. Stat. 2, 360.
///
/// # Checked by  tests/all/numbers.rs: walkers with and without drift and jitter
pub(super) fn field_of_view(cells: &[&Places]) -> Option<FieldOfView> {
    let velocities: Vec<[f64; 2]> = cells.iter().filter_map(|places| mean_velocity(places)).collect();
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
    Some(FieldOfView {
        cells: velocities.len(),
        velocity: mean,
        velocity_error: [(xx / n).sqrt(), (yy / n).sqrt()],
        p_value: libm::pow(1.0 + square / (n - 1.0), -0.5 * (n - 2.0)),
        jitter: jitter(cells),
    })
}

/// Displacement over time of all pieces together.
fn mean_velocity(places: &Places) -> Option<[f64; 2]> {
    let ends = places.pieces.iter().filter_map(|piece| Some((piece.first()?, piece.last()?)));
    let sums = ends.fold([0.0; 3], |sums, (a, b)| {
        [sums[0] + b.at[0] - a.at[0], sums[1] + b.at[1] - a.at[1], sums[2] + b.t - a.t]
    });
    (sums[2] > 0.0).then(|| [sums[0] / sums[2], sums[1] / sums[2]])
}

/// Two displacements in a row of a cell.
type Pair = [[f64; 2]; 2];

/// The standard deviation of the common displacement of a frame.
fn jitter(cells: &[&Places]) -> Option<f64> {
    let mut by_time: BTreeMap<u64, Vec<Pair>> = BTreeMap::new();
    for places in cells {
        let next = |a: &Fix, b: &Fix| places.lag(a.t, b.t) == 1.0;
        let Some(mean) = mean_velocity(places) else { continue };
        // without its mean velocity: what cells have in common throughout is a drift
        let step = |a: &Fix, b: &Fix| [0, 1].map(|k| b.at[k] - a.at[k] - mean[k] * (b.t - a.t));
        for three in places.pieces.iter().flat_map(|piece| piece.windows(3)) {
            if next(&three[0], &three[1]) && next(&three[1], &three[2]) {
                let pair = [step(&three[0], &three[1]), step(&three[1], &three[2])];
                by_time.entry(three[1].t.to_bits()).or_default().push(pair);
            }
        }
    }
    let (mut sum, mut count) = (0.0, 0.0);
    for pairs in by_time.values().filter(|pairs| pairs.len() >= LEAST_CELLS) {
        let n = pairs.len() as f64;
        // products of different cells alone: those of one cell are its own motion
        for k in 0..2 {
            let first: f64 = pairs.iter().map(|pair| pair[0][k]).sum();
            let second: f64 = pairs.iter().map(|pair| pair[1][k]).sum();
            let own: f64 = pairs.iter().map(|pair| pair[0][k] * pair[1][k]).sum();
            sum += (first * second - own) / (n * (n - 1.0));
            count += 1.0;
        }
    }
    (count > 0.0).then(|| (-sum / count).max(0.0).sqrt())
}
