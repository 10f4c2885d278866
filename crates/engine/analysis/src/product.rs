//! Eigenvalues of a product of matrices, each with its own digits.

use crate::graded::scale;
use crate::multipliers::multipliers;
use nalgebra::DMatrix;

/// Times that the frames are taken around the product: they converge by the ratio of neighbouring moduli each time.
const ROUNDS: usize = 8;

/// Coupling of a group of eigenvalues to larger ones below which they are separate.
const SEPARATE: f64 = 1e-12;

/// The eigenvalues of `A_m .. A_2 A_1` (`factors` in the order in which they act), largest modulus first: `ln |m|` (minus infinity for
/// 0) and the argument of each. A modulus may be far below the smallest number.
///
/// Multiplied out, the large eigenvalues of the product would bury the small ones under their round-off. Instead orthonormal frames
/// are taken around: `A_i Q_(i-1) = Q_i R_i` with triangular `R_i`, from the last frame on again, until the frames return up to
/// rotations within groups of eigenvalues of similar modulus. The groups are then separate diagonal blocks, in every factor.
///
/// Source: the periodic QR iteration: Bojanczyk, Golub, Van Dooren (1992), Proc. SPIE 1770, 31.
pub fn logarithms_of_product(factors: &[DMatrix<f64>]) -> Option<Vec<(f64, f64)>> {
    let dim = factors.first()?.nrows();
    let Frames { before, last: frame, triangles } = frames(factors, dim)?;
    let back = before.transpose() * &frame;
    let mut values = Vec::new();
    let mut from = 0;
    while from < dim {
        let apart = |end: &usize| {
            *end == dim || back.view((*end, 0), (dim - end, *end)).iter().all(|x| x.abs() < SEPARATE)
        };
        let end = (from + 1..=dim).find(apart)?;
        let size = end - from;
        let block = |m: &DMatrix<f64>| m.view((from, from), (size, size)).into_owned();
        let (mut product, mut taken) = (DMatrix::identity(size, size), 0.0);
        for triangle in &triangles {
            product = block(triangle) * product;
            let factor = scale(product.iter());
            product *= factor;
            taken -= libm::log(factor);
        }
        let matrix = block(&back) * product;
        let columns: Vec<Vec<f64>> = matrix.column_iter().map(|c| c.iter().copied().collect()).collect();
        let logarithm = |(re, im): (f64, f64)| (libm::log(libm::hypot(re, im)) + taken, libm::atan2(im, re));
        values.extend(multipliers(&columns)?.into_iter().map(logarithm));
        from = end;
    }
    crate::linear::sort_leading(&mut values);
    Some(values)
}

/// The frames before and after the last round, and the triangles of that round.
struct Frames {
    before: DMatrix<f64>,
    last: DMatrix<f64>,
    triangles: Vec<DMatrix<f64>>,
}

/// Frames taken around the product; `None` where a number is not finite.
fn frames(factors: &[DMatrix<f64>], dim: usize) -> Option<Frames> {
    let mut frame = DMatrix::identity(dim, dim);
    let mut triangles = Vec::new();
    let mut before = frame.clone();
    for _ in 0..ROUNDS {
        before = frame.clone();
        triangles.clear();
        for factor in factors {
            let image = factor * &frame;
            if !image.iter().all(|x| x.is_finite()) {
                return None;
            }
            let (q, r) = image.qr().unpack();
            frame = q;
            triangles.push(r);
        }
    }
    Some(Frames { before, last: frame, triangles })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_eigenvalue_keeps_its_digits() {
        // similar to diag(1e9, -3, 2, 1e-9) over each factor, by a rotation of the four axes
        let (sin, cos) = (0.6, 0.8);
        let mut turn: DMatrix<f64> = DMatrix::identity(4, 4);
        for i in 0..3 {
            let mut plane: DMatrix<f64> = DMatrix::identity(4, 4);
            plane[(i, i)] = cos;
            plane[(i, i + 1)] = -sin;
            plane[(i + 1, i)] = sin;
            plane[(i + 1, i + 1)] = cos;
            turn *= &plane;
        }
        let shear = DMatrix::from_fn(4, 4, |i, j| {
            if i == j {
                1.0
            } else if i < j {
                0.5
            } else {
                0.0
            }
        });
        let to: DMatrix<f64> = &turn * shear;
        let from = to.clone().try_inverse().expect("it is well conditioned");
        let diagonal = DMatrix::from_diagonal(&nalgebra::DVector::from_vec(vec![1e9, -3.0, 2.0, 1e-3]));
        // in separate factors no digits are lost
        let factors = [from, diagonal.clone(), diagonal, to];
        let values = logarithms_of_product(&factors).expect("they are finite");
        let expected: [f64; 4] = [1e18, 9.0, 4.0, 1e-6];
        for (value, expected) in values.iter().zip(expected) {
            assert!((value.0 - expected.ln()).abs() < 1e-6 && value.1 == 0.0, "{values:?}");
        }
        // a thousand factors, whose product no number holds
        let diagonal = DMatrix::from_diagonal(&nalgebra::DVector::from_vec(vec![0.5, 1e-2]));
        let values = logarithms_of_product(&vec![diagonal; 1000]).expect("they are finite");
        for (value, expected) in values.iter().zip([0.5_f64, 1e-2]) {
            assert!((value.0 / (1000.0 * expected.ln()) - 1.0).abs() < 1e-12, "{values:?}");
        }
    }
}
