//! Displacements that all outlines of a frame have together.

use super::grid::Grid;
use motiform_dynamics::Normal;
use motiform_dynamics::sample::mean;
use motiform_dynamics::sample::sort_by_number;
use serde::Serialize;

/// Fewest cells of a frame.
const LEAST_CELLS: usize = 3;
/// Fewest frames with so many cells.
const LEAST_FRAMES: usize = 10;
/// Random shifts in time that the common part is compared with, and their seed.
const SHIFTS: usize = 199;
const SEED: u64 = 1;
/// Significance.
const LEVEL: f64 = 0.01;
/// Most steps of the solution for the displacements, and its relative accuracy.
const MOST_STEPS: usize = 500;
const ACCURACY: f64 = 1e-8;

/// Difference between a place and the one that its neighbours in time interpolate: linearly, and by a cubic.
const STENCILS: [&[f64]; 2] = [&[-0.5, 1.0, -0.5], &[1.0 / 6.0, -2.0 / 3.0, 1.0, -2.0 / 3.0, 1.0 / 6.0]];

/// A jitter of the images.
///
/// # Units   of the data
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Jitter {
    /// Standard deviation of the displacement of a frame, in each coordinate; 0 where cells have less in common than independent ones.
    pub deviation: f64,
    /// Share of random shifts of the cells in time, among the frames that each has, with as much in common.
    pub p_value: f64,
    /// Frames with enough cells.
    pub frames: usize,
    /// Share of its variance that the displacements of the correction have.
    pub recovered: f64,
    /// The first frame, the step between frames, and the displacements.
    #[serde(skip)]
    displacements: (i64, i64, Vec<[f64; 2]>),
}

impl Jitter {
    /// `true` if there is one.
    pub fn is_seen(&self) -> bool {
        self.p_value < LEVEL && self.deviation > 0.0
    }

    /// The displacement of a frame; 0 where there is none to correct.
    pub(super) fn displacement(&self, frame: i64) -> [f64; 2] {
        let (first, step, of) = &self.displacements;
        let from = frame - first;
        let place = usize::try_from(from / step).ok().filter(|_| from % step == 0);
        place.and_then(|k| of.get(k)).copied().unwrap_or_default()
    }

    /// With the residual h of each cell from what its neighbours in time interpolate, of variance v without what is common, H = sum h/v /
    /// sum 1/v over cells has the variance g sigma^2 + 1/sum(1/v), g the sum of squares of the stencil: that gives the deviation sigma of a
    /// jitter that is white in time. The displacements e of highest posterior density minimise sum (H - A e)^2 sum 1/v + sum e^2/sigma^2, A
    /// the stencil (conjugate gradients). Of two stencils the one that leaves less of the cells' own motion is taken.
    ///
    /// The test shifts the residuals of each cell at random among the frames in which it has one, so that as many cells are in each frame,
    /// and asks how often sum H^2 sum 1/v is as large. The shifts belong to the cells in the order of their residuals, whatever their order
    /// in the file.
    pub(super) fn of(grid: &Grid) -> Option<Self> {
        let own = |residuals: &Residuals| residuals.noise() / residuals.gain();
        let best = STENCILS.into_iter().filter_map(|stencil| Residuals::of(grid, stencil));
        let residuals = best.min_by(|a, b| own(a).total_cmp(&own(b)))?;
        let variance = ((residuals.square() - residuals.noise()) / residuals.gain()).max(0.0);
        let mut found = Self {
            deviation: variance.sqrt(),
            p_value: residuals.p_value(),
            frames: residuals.common.iter().flatten().count(),
            recovered: 0.0,
            displacements: (grid.frame(0), (grid.frame(1) - grid.frame(0)).max(1), Vec::new()),
        };
        if found.is_seen() {
            let of = residuals.displacements(variance);
            let square = of.iter().flatten().map(|x| x * x).sum::<f64>();
            found.recovered = square / (2.0 * found.frames as f64 * variance);
            found.displacements.2 = of;
        }
        Some(found)
    }
}

/// Sum of the squares of the residuals of a cell.
fn size(own: &[Option<[f64; 2]>]) -> f64 {
    own.iter().flatten().map(|h| h[0] * h[0] + h[1] * h[1]).sum()
}

/// The residuals of a cell, moved by this share of them among the frames that have one.
fn shifted(own: &[Option<[f64; 2]>], share: f64) -> Vec<Option<[f64; 2]>> {
    let by = (share * own.iter().flatten().count() as f64) as usize;
    let mut moved = own.iter().flatten().cycle().skip(by);
    own.iter().map(|h| h.and_then(|_| moved.next().copied())).collect()
}

/// The common part of a frame, and the inverse of its variance by the cells' own motion.
type Common = Option<([f64; 2], f64)>;

/// Displacements of cells beside a smooth motion.
struct Residuals {
    stencil: &'static [f64],
    /// Of each cell and frame.
    own: Vec<Vec<Option<[f64; 2]>>>,
    /// Inverse variances of the cells' own residuals.
    weights: Vec<f64>,
    common: Vec<Common>,
}

impl Residuals {
    fn of(grid: &Grid, stencil: &'static [f64]) -> Option<Self> {
        let half = stencil.len() / 2;
        let residual = |places: &[Option<[f64; 2]>]| {
            let mut sum = [0.0; 2];
            for (factor, place) in stencil.iter().zip(places) {
                let place = (*place)?;
                sum = [0, 1].map(|i| sum[i] + factor * place[i]);
            }
            Some(sum)
        };
        let of_cell = |places: &Vec<Option<[f64; 2]>>| {
            let mut all = vec![None; places.len()];
            for (k, window) in places.windows(stencil.len()).enumerate() {
                all[k + half] = residual(window);
            }
            all
        };
        let mut own: Vec<_> = grid.places.iter().map(of_cell).collect();
        // in an order of their own, so that the random shifts do not depend on that of the file
        sort_by_number(&mut own, |own| size(own));
        let mut found = Self { stencil, weights: vec![1.0; own.len()], own, common: Vec::new() };
        found.common = found.together(&found.own);
        found.weights = found.inverse_variances();
        found.common = found.together(&found.own);
        (found.common.iter().flatten().count() >= LEAST_FRAMES).then_some(found)
    }

    /// The weighted means of residuals over cells.
    fn together(&self, residuals: &[Vec<Option<[f64; 2]>>]) -> Vec<Common> {
        let frames = residuals.first().map_or(0, Vec::len);
        let of_frame = |k: usize| {
            let (mut sum, mut weight, mut count) = ([0.0; 2], 0.0, 0);
            for (own, of_cell) in residuals.iter().zip(&self.weights) {
                let Some(h) = own[k] else { continue };
                sum = [0, 1].map(|i| sum[i] + of_cell * h[i]);
                weight += of_cell;
                count += 1;
            }
            (count >= LEAST_CELLS && weight > 0.0).then(|| (sum.map(|x| x / weight), weight))
        };
        (0..frames).map(of_frame).collect()
    }

    /// Of each cell's residuals without the common part, which holds a share of it.
    fn inverse_variances(&self) -> Vec<f64> {
        let all: f64 = self.weights.iter().sum();
        let of_cell = |(own, weight): (&Vec<Option<[f64; 2]>>, &f64)| {
            let (mut sum, mut count) = (0.0, 0.0);
            for (h, common) in own.iter().zip(&self.common) {
                let (Some(h), Some((common, _))) = (h, common) else { continue };
                sum += (0..2).map(|i| (h[i] - common[i]) * (h[i] - common[i])).sum::<f64>();
                count += 2.0;
            }
            let left = (1.0 - weight / all).max(0.1);
            if sum > 0.0 { count * left / sum } else { 0.0 }
        };
        self.own.iter().zip(&self.weights).map(of_cell).collect()
    }

    /// Sum of squares of the stencil.
    fn gain(&self) -> f64 {
        self.stencil.iter().map(|s| s * s).sum()
    }

    /// Mean square of the common parts, of a coordinate.
    fn square(&self) -> f64 {
        mean(self.common.iter().flatten().map(|(h, _)| 0.5 * (h[0] * h[0] + h[1] * h[1]))).unwrap_or(0.0)
    }

    /// The part of it that the cells' own motion explains.
    fn noise(&self) -> f64 {
        mean(self.common.iter().flatten().map(|(_, weight)| 1.0 / weight)).unwrap_or(0.0)
    }

    fn p_value(&self) -> f64 {
        let size = |common: &[Common]| {
            common.iter().flatten().map(|(h, weight)| weight * (h[0] * h[0] + h[1] * h[1])).sum::<f64>()
        };
        let observed = size(&self.common);
        let mut random = Normal::new(SEED, 0);
        let above = (0..SHIFTS).filter(|_| {
            let shifted: Vec<_> = self.own.iter().map(|own| shifted(own, random.uniform())).collect();
            size(&self.together(&shifted)) >= observed
        });
        (above.count() + 1) as f64 / (SHIFTS + 1) as f64
    }

    /// The displacements of all frames, of a jitter of this variance.
    fn displacements(&self, variance: f64) -> Vec<[f64; 2]> {
        let solve = |i: usize| {
            let weighted = self.common.iter().map(|common| common.map_or(0.0, |(h, weight)| weight * h[i]));
            let right = convolved(self.stencil, &weighted.collect::<Vec<f64>>());
            let matrix = |e: &[f64]| {
                let mut there = convolved(self.stencil, e);
                for (x, common) in there.iter_mut().zip(&self.common) {
                    *x *= common.map_or(0.0, |(_, weight)| weight);
                }
                let back = convolved(self.stencil, &there);
                back.iter().zip(e).map(|(a, e)| a + e / variance).collect::<Vec<f64>>()
            };
            conjugate_gradients(&matrix, &right)
        };
        let (x, y) = (solve(0), solve(1));
        x.into_iter().zip(y).map(|(x, y)| [x, y]).collect()
    }
}

/// A symmetric stencil along a series, 0 beyond its ends: its own transpose.
fn convolved(stencil: &[f64], series: &[f64]) -> Vec<f64> {
    let half = stencil.len() / 2;
    let at =
        |k: usize, j: usize| (k + j).checked_sub(half).and_then(|k| series.get(k)).copied().unwrap_or(0.0);
    (0..series.len()).map(|k| stencil.iter().enumerate().map(|(j, s)| s * at(k, j)).sum()).collect()
}

/// The solution of a symmetric positive definite system. Source: Hestenes and Stiefel (1952), J. Res. Natl. Bur. Stand. 49, 409.
fn conjugate_gradients(matrix: &dyn Fn(&[f64]) -> Vec<f64>, right: &[f64]) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (mut x, mut r) = (vec![0.0; right.len()], right.to_vec());
    let (mut p, mut square) = (r.clone(), dot(&r, &r));
    let enough = ACCURACY * ACCURACY * square;
    for _ in 0..MOST_STEPS {
        if square <= enough {
            break;
        }
        let there = matrix(&p);
        let step = square / dot(&p, &there);
        for k in 0..x.len() {
            x[k] += step * p[k];
            r[k] -= step * there[k];
        }
        let next = dot(&r, &r);
        for k in 0..p.len() {
            p[k] = r[k] + next / square * p[k];
        }
        square = next;
    }
    x
}
