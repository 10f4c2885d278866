//! Points around the boundary, and the waves on them.

use super::kkt::MAX_UNKNOWNS;
use motiform_dynamics::Scalar;

/// Maximum number of points of a boundary for computing velocities.
pub(super) const MAX_POINTS: usize = 512;

/// Equally spaced points `s_j` on the boundary with the values of `cos(k_n s_j)` and `sin(k_n s_j)`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Circle {
    points: usize,
    /// Row `n` holds `cos(k_n s_j)`, `n = 0 ..= order`.
    cosines: Vec<f64>,
    sines: Vec<f64>,
    /// Entry `[j][n]` holds `cos(k_n s_j)`, `n <` [`MOMENTS`].
    across: Vec<[f64; MOMENTS]>,
    across_sines: Vec<[f64; MOMENTS]>,
}

/// The number of moments that are computed at once: as many as the matrix of the closure needs.
pub(super) const MOMENTS: usize = MAX_UNKNOWNS;

impl Circle {
    /// Points that resolve `exp(i theta)` for a boundary of `modes` modes, with waves up to `order`.
    pub(super) fn new(modes: usize, order: usize) -> Self {
        let points = (4 * modes).next_power_of_two().clamp(128, MAX_POINTS);
        let turn: Vec<(f64, f64)> =
            (0..points).map(|j| libm::sincos(std::f64::consts::TAU * j as f64 / points as f64)).collect();
        let wave = |row: usize, point: usize| turn[(row * point) % points];
        let rows = (0..=order).flat_map(|row| (0..points).map(move |point| (row, point)));
        let (sines, cosines) = rows.map(|(row, point)| wave(row, point)).unzip();
        let across = |pick: fn((f64, f64)) -> f64| {
            (0..points).map(|point| std::array::from_fn(|row| pick(wave(row, point)))).collect()
        };
        Self { points, cosines, sines, across: across(|w| w.1), across_sines: across(|w| w.0) }
    }

    pub(super) fn points(&self) -> usize {
        self.points
    }

    pub(super) fn cosine(&self, n: usize) -> &[f64] {
        &self.cosines[n * self.points..(n + 1) * self.points]
    }

    pub(super) fn sine(&self, n: usize) -> &[f64] {
        &self.sines[n * self.points..(n + 1) * self.points]
    }

    /// `out_j += c cos(k_n s_j) + s sin(k_n s_j)`.
    #[inline(always)]
    pub(super) fn add_wave<T: Scalar>(&self, n: usize, [c, s]: [T; 2], out: &mut [T]) {
        for ((x, &cos), &sin) in out.iter_mut().zip(self.cosine(n)).zip(self.sine(n)) {
            *x += c * cos + s * sin;
        }
    }

    /// `f(n)` times the waves of the state `(Re phi_n, Im phi_n, ..)`: a derivative of phi at the points, added to `out`.
    #[inline(always)]
    pub(super) fn add_modes<T: Scalar>(&self, u: &[T], factor: impl Fn(f64) -> f64, out: &mut [T]) {
        for (i, mode) in u.chunks_exact(2).enumerate() {
            let weight = 2.0 * factor(i as f64 + 1.0);
            self.add_wave(i + 1, [mode[0] * weight, mode[1] * -weight], out);
        }
    }

    /// Means over the points of `f cos(k_n s)` and `f sin(k_n s)`, for all `n < count`, at once, as independent sums.
    #[inline(always)]
    pub(super) fn moments<T: Scalar>(&self, count: usize, f: &[T]) -> [[T; 2]; MOMENTS] {
        let mut sums = [[f[0].zero(); MOMENTS]; 2];
        let [cosines, sines] = &mut sums;
        for ((&x, cos), sin) in f.iter().zip(&self.across).zip(&self.across_sines) {
            for (sum, &c) in cosines[..count].iter_mut().zip(cos) {
                *sum += x * c;
            }
            for (sum, &s) in sines[..count].iter_mut().zip(sin) {
                *sum += x * s;
            }
        }
        let scale = 1.0 / self.points as f64;
        std::array::from_fn(|n| [sums[0][n] * scale, sums[1][n] * scale])
    }

    /// Mean over the points.
    #[inline(always)]
    pub(super) fn mean<T: Scalar>(&self, f: &[T]) -> T {
        let mut sum = f[0].zero();
        for &x in f {
            sum += x;
        }
        sum * (1.0 / self.points as f64)
    }
}
