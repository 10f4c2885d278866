//! Jumps of the stage.

use super::grid::Grid;
use motiform_dynamics::sample::median;
use motiform_tracks::modes::{CellModes, Flag};
use serde::Serialize;

/// Multiple of the usual common displacement of a frame, and of its error, that a jump exceeds.
const CLEAR: f64 = 8.0;
/// Significance of a jump, over all frames that stand out.
const LEVEL: f64 = 0.01;

/// A displacement that all outlines have from one frame on.
///
/// # Units   of the data
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StageJump {
    /// The first frame after it.
    pub frame: i64,
    /// The displacement.
    pub displacement: [f64; 2],
    /// Its standard error in each coordinate, by the scatter over cells and by the jitter of the images; `None` of one cell alone.
    pub error: Option<f64>,
    /// Cells that show it.
    pub cells: usize,
    /// Variance of the displacement by a jitter of unit variance, in each coordinate: frames next to the jump are in it.
    #[serde(skip)]
    of_jitter: f64,
}

impl StageJump {
    /// Adds the jitter of this standard deviation to the error.
    pub(super) fn add_jitter(&mut self, deviation: f64) {
        let variance = self.of_jitter * deviation * deviation;
        self.error = self.error.map(|error| (error * error + variance).sqrt());
    }
}

/// Variance of the displacement of these cells by a jitter of unit variance, which all share: that of the mean of their sums over four
/// frames, the jump between the second and the third; of each cell it is known whether the displacements before and after are subtracted.
fn jitter_variance(beside: &[[bool; 2]]) -> f64 {
    let mut sum = [0.0; 4];
    for [before, after] in beside {
        let share = 1.0 / f64::from(u8::from(*before) + u8::from(*after)).max(1.0);
        let [a, b] = [before, after].map(|known| if *known { share } else { 0.0 });
        let own = [a, -1.0 - a, 1.0 + b, -b];
        sum = [0, 1, 2, 3].map(|i| sum[i] + own[i]);
    }
    sum.iter().map(|x| x * x).sum::<f64>() / (beside.len() * beside.len()) as f64
}

/// The jumps, in the order of their frames.
///
/// Of two cells and more that are seen on both sides: their mean displacement differs from the median over all frames by more than 8
/// times the usual difference (1.4826 times the median one), and what exceeds the displacements before and after, with its scatter over
/// cells, by more than 8 times its error, and by more than cells that step at times of their own have in common. Of one cell alone:
/// where its outline is at another place and its shape goes on ([`Flag::StageJump`]).
pub(super) fn find(grid: &Grid, cells: &[CellModes]) -> Vec<StageJump> {
    let means: Vec<Option<[f64; 2]>> = (0..grid.times.len()).map(|k| mean_displacement(grid, k)).collect();
    let middle = [0, 1].map(|i| median(means.iter().flatten().map(|d| d[i])).unwrap_or(0.0));
    let off = |d: &[f64; 2]| libm::hypot(d[0] - middle[0], d[1] - middle[1]);
    let usual = 1.4826 * median(means.iter().flatten().map(off)).unwrap_or(0.0);
    let stands_out = |k: usize| means.get(k).copied().flatten().is_some_and(|d| off(&d) > CLEAR * usual);
    // two cells that rest between steps go the same way now and then
    let tests = (0..means.len()).filter(|k| stands_out(*k)).count() as f64;
    (1..grid.times.len())
        .filter_map(|k| {
            let found = excess(grid, k, &stands_out)?;
            let length = libm::hypot(found.displacement[0], found.displacement[1]);
            let clear = match found.error {
                Some(error) => {
                    stands_out(k)
                        && length > CLEAR * error
                        && tests * p_value(length / error, found.cells) < LEVEL
                }
                None => is_flagged(cells, found.frame),
            };
            clear.then_some(found)
        })
        .collect()
}

/// Probability of a mean of so many times its error, or more, of cells with independent Gaussian displacements: of F = r^2/2 with 2 and
/// 2 (n - 1) degrees of freedom.
fn p_value(ratio: f64, cells: usize) -> f64 {
    let freedom = cells as f64 - 1.0;
    libm::pow(1.0 + ratio * ratio / (2.0 * freedom), -freedom)
}

/// The excess of the displacements to this frame over those before and after, over the cells that are seen.
fn excess(grid: &Grid, k: usize, stands_out: &dyn Fn(usize) -> bool) -> Option<StageJump> {
    let (found, beside): (Vec<[f64; 2]>, Vec<[bool; 2]>) = (0..grid.cells())
        .filter_map(|cell| {
            let here = grid.displacement(cell, k)?;
            let beside =
                [k - 1, k + 1].map(|j| (!stands_out(j)).then(|| grid.displacement(cell, j)).flatten());
            let known: Vec<[f64; 2]> = beside.into_iter().flatten().collect();
            let mean = |i: usize| known.iter().map(|d| d[i]).sum::<f64>() / known.len().max(1) as f64;
            Some(([0, 1].map(|i| here[i] - mean(i)), beside.map(|one| one.is_some())))
        })
        .unzip();
    let n = found.len() as f64;
    if found.is_empty() {
        return None;
    }
    let mean = [0, 1].map(|i| found.iter().map(|d| d[i]).sum::<f64>() / n);
    let squares: f64 =
        found.iter().map(|d| (0..2).map(|i| (d[i] - mean[i]) * (d[i] - mean[i])).sum::<f64>()).sum();
    let error = (found.len() > 1).then(|| (0.5 * squares / (n * (n - 1.0))).sqrt());
    let of_jitter = jitter_variance(&beside);
    Some(StageJump { frame: grid.frame(k), displacement: mean, error, cells: found.len(), of_jitter })
}

fn mean_displacement(grid: &Grid, k: usize) -> Option<[f64; 2]> {
    let all: Vec<[f64; 2]> = (0..grid.cells()).filter_map(|cell| grid.displacement(cell, k)).collect();
    let mean = |i: usize| all.iter().map(|d| d[i]).sum::<f64>() / all.len() as f64;
    (!all.is_empty()).then(|| [mean(0), mean(1)])
}

fn is_flagged(cells: &[CellModes], frame: i64) -> bool {
    let jumps = |flag: &Flag| matches!(flag, Flag::StageJump { .. });
    cells.iter().flat_map(|cell| &cell.frames).any(|one| one.frame == frame && one.flags.iter().any(jumps))
}
