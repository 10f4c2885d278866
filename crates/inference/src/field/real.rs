//! Derivatives by `z` and `conj(z)` as derivatives by real and imaginary parts.
//!
//! `d/dRe = d/dz + d/dz*`,  `d/dIm = i (d/dz - d/dz*)`.

use super::SHAPE;
use motiform_dynamics::Complex;

fn times_i(z: Complex<f64>) -> Complex<f64> {
    Complex::new(-z.im, z.re)
}

/// First derivatives.
pub(super) fn gradient(by: &[Complex<f64>; SHAPE]) -> [Complex<f64>; SHAPE] {
    let mut real = *by;
    for pair in real.chunks_exact_mut(2) {
        let (z, conj) = (pair[0], pair[1]);
        pair[0] = z + conj;
        pair[1] = times_i(Complex::new(z.re - conj.re, z.im - conj.im));
    }
    real
}

/// Second derivatives.
pub(super) fn hessian(by: &[[Complex<f64>; SHAPE]; SHAPE]) -> [[Complex<f64>; SHAPE]; SHAPE] {
    let rows = by.map(|row| gradient(&row));
    let mut whole = rows;
    for j in 0..SHAPE {
        let column = gradient(&std::array::from_fn(|i| rows[i][j]));
        for (row, value) in whole.iter_mut().zip(column) {
            row[j] = value;
        }
    }
    whole
}
