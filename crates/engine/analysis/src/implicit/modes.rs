//! The eigenvectors of the inverse matrix of Radau IIA.

use super::tableau::{STAGES, Tableau};
use nalgebra::{Complex, DMatrix, DVector};
use std::sync::OnceLock;

/// Roughly the eigenvalues: the real one, and of each pair the one above the real axis.
const NEAR: [Complex<f64>; 3] =
    [Complex::new(6.2867, 0.0), Complex::new(5.7010, 3.2103), Complex::new(3.6557, 6.5437)];

/// Steps of Newton's method from there: the digits double in each.
const STEPS: usize = 8;

/// An eigenvalue of `A^-1` with its vectors: `A^-1 v = lambda v`, `l A^-1 = lambda l`, `l v = 1`.
pub(super) struct Mode {
    pub(super) value: Complex<f64>,
    pub(super) right: [Complex<f64>; STAGES],
    pub(super) left: [Complex<f64>; STAGES],
}

impl Mode {
    /// The real one, then one of each pair.
    pub(super) fn all() -> &'static [Self; 3] {
        static MODES: OnceLock<[Mode; 3]> = OnceLock::new();
        MODES.get_or_init(|| NEAR.map(Self::near))
    }

    fn near(guess: Complex<f64>) -> Self {
        let value = (0..STEPS).fold(guess, |z, _| z - quotient(z));
        let inverse = &Tableau::get().inverse;
        let right = null(|i, j| inverse[i][j], value);
        let left = null(|i, j| inverse[j][i], value);
        let product: Complex<f64> = left.iter().zip(&right).map(|(l, v)| l * v).sum();
        Self { value, right, left: left.map(|l| l / product) }
    }
}

/// `Q / Q'` of the denominator `Q` of the Padé approximant of `exp` with degrees `s - 1` and `s`, whose zeros are the eigenvalues:
/// `Q = sum_j (-z)^j s! (2s - 1 - j)! / (j! (s - j)! (2s - 1)!)`.
fn quotient(z: Complex<f64>) -> Complex<f64> {
    let s = STAGES as f64;
    let (mut power, mut factor) = (Complex::new(1.0, 0.0), 1.0);
    let (mut sum, mut slope) = (power, Complex::new(0.0, 0.0));
    for j in 1..=STAGES {
        let n = j as f64;
        factor *= -(s - n + 1.0) / (n * (2.0 * s - n));
        slope += power * (factor * n);
        power *= z;
        sum += power * factor;
    }
    sum / slope
}

/// The vector with `sum_j matrix(i, j) v_j = value v_i` whose last entry is 1.
fn null(matrix: impl Fn(usize, usize) -> f64, value: Complex<f64>) -> [Complex<f64>; STAGES] {
    const FREE: usize = STAGES - 1;
    let entry = |i: usize, j: usize| if i == j { matrix(i, j) - value } else { matrix(i, j).into() };
    let rest = DMatrix::from_fn(FREE, FREE, entry);
    let side = DVector::from_fn(FREE, |i, _| -entry(i, FREE));
    let found = rest.lu().solve(&side).unwrap_or_else(|| DVector::zeros(FREE));
    std::array::from_fn(|i| if i < FREE { found[i] } else { 1.0.into() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_matrix_is_the_sum_of_its_modes() {
        let inverse = &Tableau::get().inverse;
        let modes = Mode::all();
        let trace: f64 = modes.iter().zip([1.0, 2.0, 2.0]).map(|(mode, count)| count * mode.value.re).sum();
        // the sum of the zeros of Q, by its two leading coefficients
        assert!((trace - 25.0).abs() < 1e-12, "{trace}");
        for i in 0..STAGES {
            for j in 0..STAGES {
                let part = |mode: &Mode| mode.right[i] * mode.value * mode.left[j];
                let sum = part(&modes[0]).re + 2.0 * (part(&modes[1]).re + part(&modes[2]).re);
                assert!((sum - inverse[i][j]).abs() < 1e-11, "{i} {j}: {sum} {}", inverse[i][j]);
            }
        }
    }
}
