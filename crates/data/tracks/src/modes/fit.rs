//! Centre, radius and modes of an outline by weighted least squares.

use super::residual::{Equations, Unknowns};
use super::start::starts;
use serde::Serialize;

/// Steps after which a fit has not converged.
const STEPS: usize = 60;

/// Relative size of a step from which on only round-off moves.
const SMALL: f64 = 1e-15;

/// Relative size of the last step that counts as converged.
const CONVERGED: f64 = 1e-9;

/// Root mean square of the residuals, relative to R0, below which no other start is tried.
const GOOD: f64 = 0.05;

/// Centre, mean radius and modes, with their covariance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RadiusFit {
    /// X and Y: the point about which the radius has no first harmonic.
    pub centre: [f64; 2],
    /// R0, the mean of the radius over directions.
    pub r0: f64,
    /// z2, z3, ...: real and imaginary parts.
    pub z: Vec<[f64; 2]>,
    /// Noise of a vertex along each coordinate, estimated from the residuals: sigma^2 = sum w r^2/(n - p).
    pub sigma: f64,
    /// Correlation of the residuals of neighbouring vertices: about -p/n for independent noise. Well above 0,
    /// the outline has finer features than the modes, and the covariance is too small.
    pub neighbours: f64,
    /// The factor by which correlated residuals multiply the variances: `1 + 2 sum_k rho_k` over the lags k up to the
    /// first rho_k <= 0; 1 for independent noise. Not contained in the covariance: multiply it where
    /// `neighbours` is well above 0.
    pub inflation: f64,
    /// `(J^T W J)^{-1}` of (X, Y, R0, Re z2, Im z2, Re z3, ...), row by row: times sigma^2 it is the covariance.
    pub unit_covariance: Vec<f64>,
}

impl RadiusFit {
    /// Number of unknowns p = 3 + 2 (N - 1).
    pub fn unknowns(&self) -> usize {
        3 + 2 * self.z.len()
    }

    /// Covariance of unknowns j and k for this noise of a vertex; order (X, Y, R0, Re z2, Im z2, ...).
    pub fn covariance(&self, sigma: f64, j: usize, k: usize) -> f64 {
        sigma * sigma * self.unit_covariance[j * self.unknowns() + k]
    }

    /// The covariance of (X, Y, Re z2, Im z2, .., Im z_highest) for this noise of a vertex, row by row. Modes
    /// that were not fitted are left out.
    pub fn observed_covariance(&self, sigma: f64, highest: usize) -> Vec<Vec<f64>> {
        let last = (1 + 2 * highest).min(self.unknowns());
        let at = || [0, 1].into_iter().chain(3..last);
        at().map(|j| at().map(|k| self.covariance(sigma, j, k)).collect()).collect()
    }
}

/// Least squares of `r_k = |P_k - X| - R(arg(P_k - X))` with weights `w = 1/(1 + (R'/R)^2)`, by damped Gauss-Newton steps.
///
/// Noise of a vertex, equal in all directions, moves r by sigma sqrt(1 + (R'/R)^2): the weights are the
/// inverse variances. The columns of the centre are cos + (R'/r) sin and sin - (R'/r) cos. `highest` is the
/// largest n of z_n, at least 3. `None` where the points are too few, or no start converges to an outline
/// with R > 0 at every vertex.
///
/// # Checked by  tests/all/modes.rs: exact outlines (1e-13), symmetry (1e-13), pulls
pub fn fit_radius(points: &[[f64; 2]], highest: usize) -> Option<RadiusFit> {
    let unknowns = 3 + 2 * (highest.max(3) - 1);
    if points.len() <= unknowns {
        return None;
    }
    let mut best: Option<Converged> = None;
    for (centre, r0) in starts(points) {
        let end = converge(points, Unknowns::circle(centre, r0, unknowns));
        best = [best, end].into_iter().flatten().min_by(|a, b| a.misfit(points).total_cmp(&b.misfit(points)));
        if best.as_ref().is_some_and(|best| best.misfit(points) < GOOD) {
            break;
        }
    }
    best?.finish(points)
}

/// The end of the iteration.
struct Converged {
    at: Unknowns,
    cost: f64,
}

/// Plain steps, damped (Levenberg) where they do not reduce the sum of squares, until only round-off moves.
fn converge(points: &[[f64; 2]], mut at: Unknowns) -> Option<Converged> {
    let mut damping = 0.0;
    let mut now = at.equations(points, None);
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let Some(step) = now.normal.step(damping) else {
            damping = f64::max(10.0 * damping, 1e-3);
            continue;
        };
        let size = step.iter().fold(0.0, |size: f64, part| size.max(part.abs()));
        let next = at.moved(&step);
        let then = next.equations(points, Some(&now.weights));
        // where the step is small the sums differ by round-off
        let falls = then.sound && (then.compared <= now.cost || damping == 0.0 && size < 1e-6);
        if !falls {
            damping = f64::max(10.0 * damping, 1e-3);
            if damping > 1e9 {
                break;
            }
            continue;
        }
        (at, now) = (next, then);
        if damping > 0.0 {
            damping = if damping < 1e-5 { 0.0 } else { 0.1 * damping };
            continue;
        }
        let stuck = size >= last && size < 1e-12;
        last = size;
        if size < SMALL || stuck {
            break;
        }
    }
    (now.sound && last < CONVERGED).then_some(Converged { at, cost: now.cost })
}

impl Converged {
    /// Root mean square of the residuals, relative to R0.
    fn misfit(&self, points: &[[f64; 2]]) -> f64 {
        (self.cost / points.len() as f64).sqrt() / self.at.values[2].abs()
    }

    fn finish(self, points: &[[f64; 2]]) -> Option<RadiusFit> {
        let at = &self.at;
        let Equations { normal, cost, .. } = at.equations(points, None);
        let length = at.length;
        let scaled: Vec<f64> = at.values.iter().map(|value| value * length).collect();
        let free = points.len() - at.values.len();
        let (neighbours, inflation) = correlation(&residuals(at, points));
        Some(RadiusFit {
            centre: [at.origin[0] + scaled[0], at.origin[1] + scaled[1]],
            r0: scaled[2],
            z: scaled[3..].as_chunks::<2>().0.to_vec(),
            sigma: (cost / free as f64).sqrt() * length,
            neighbours,
            inflation,
            unit_covariance: normal.inverse()?,
        })
    }
}

/// Weighted residuals along the outline; none where all are round-off.
fn residuals(at: &Unknowns, points: &[[f64; 2]]) -> Vec<f64> {
    let mut row = vec![0.0; at.values.len()];
    let residual = |point| {
        let seen = at.see(point, &mut row);
        seen.weight.sqrt() * seen.residual
    };
    let residuals: Vec<f64> = points.iter().map(residual).collect();
    let squares: f64 = residuals.iter().map(|r| r * r).sum();
    if squares > 1e-28 * residuals.len() as f64 { residuals } else { Vec::new() }
}

/// Autocorrelation of residuals around the outline: at lag 1, and `1 + 2 sum_k rho_k` up to the first that is not positive.
fn correlation(residuals: &[f64]) -> (f64, f64) {
    let squares: f64 = residuals.iter().map(|r| r * r).sum();
    let at = |lag: usize| {
        let later = residuals.iter().cycle().skip(lag);
        residuals.iter().zip(later).map(|(a, b)| a * b).sum::<f64>() / squares
    };
    if residuals.is_empty() {
        return (0.0, 1.0);
    }
    let positive = (1..=residuals.len() / 4).map(at).take_while(|rho| *rho > 0.0);
    (at(1), 1.0 + 2.0 * positive.sum::<f64>())
}
