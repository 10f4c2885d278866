//! Singular values and vectors that are checked.

use super::linear::{complement, dot, norm};
use nalgebra::{DMatrix, DVector, Dyn, SVD};

/// Largest part of a matrix that its singular values and vectors may leave of it, for each of its dimensions.
const LEFT: f64 = 1e-14;

/// Iterations for each singular value.
const STEPS: usize = 1000;

/// Times that all pairs of columns are turned, at most: 6 to 10 are enough.
const SWEEPS: usize = 60;

/// The singular values of a matrix, in falling order, with both sets of vectors: `A = U S V^T` to round-off. `None` where a number is not
/// finite.
///
/// The library's iteration ends now and then with values and vectors of another matrix: where singular values are equal by several per
/// cent, and where one is close to 0 by 1e-9 (nalgebra issues 983 and 1172). So the product is compared with the matrix. Where it differs
/// the columns are turned in pairs until all are orthogonal (Jacobi), which is exact for such matrices, and slower for large ones.
///
/// Source: Hestenes (1958), J. SIAM 6, 51; Demmel and Veselic (1992), SIAM J. Matrix Anal. Appl. 13, 1204.
///
/// # Checked by  unit tests: matrices of which the library gives another one's vectors; equal and vanishing values
pub fn svd(matrix: DMatrix<f64>) -> Option<SVD<f64, Dyn, Dyn>> {
    if !matrix.iter().all(|x| x.is_finite()) {
        return None;
    }
    let first = once(matrix.clone()).filter(|found| holds(&matrix, found));
    Some(first.unwrap_or_else(|| jacobi(matrix)))
}

#[expect(clippy::disallowed_methods, reason = "its result is compared with the matrix")]
fn once(matrix: DMatrix<f64>) -> Option<SVD<f64, Dyn, Dyn>> {
    let most = STEPS * matrix.nrows().max(matrix.ncols()).max(1);
    matrix.try_svd(true, true, f64::EPSILON, most)
}

/// Returns `true` if these are the singular values and vectors of this matrix.
fn holds(matrix: &DMatrix<f64>, found: &SVD<f64, Dyn, Dyn>) -> bool {
    let (Some(u), Some(v_t)) = (&found.u, &found.v_t) else { return false };
    let mut rest = u.clone();
    for (mut column, value) in rest.column_iter_mut().zip(found.singular_values.iter()) {
        column *= *value;
    }
    let rest = rest * v_t - matrix;
    let dimensions = matrix.nrows().max(matrix.ncols()) as f64;
    rest.norm() <= LEFT * dimensions * matrix.norm()
}

/// The decomposition by turning pairs of columns until all are orthogonal.
fn jacobi(matrix: DMatrix<f64>) -> SVD<f64, Dyn, Dyn> {
    if matrix.nrows() < matrix.ncols() {
        let SVD { u, v_t, singular_values } = jacobi(matrix.transpose());
        return SVD { u: v_t.map(|m| m.transpose()), v_t: u.map(|m| m.transpose()), singular_values };
    }
    let columns = matrix.ncols();
    let (mut w, mut v) = (matrix, DMatrix::identity(columns, columns));
    for _ in 0..SWEEPS {
        let mut turned = false;
        for i in 0..columns {
            for j in i + 1..columns {
                turned |= turn(&mut w, &mut v, i, j);
            }
        }
        if !turned {
            break;
        }
    }
    sorted(&w, &v)
}

/// Turns two columns so that they are orthogonal; `false` if they are.
fn turn(w: &mut DMatrix<f64>, v: &mut DMatrix<f64>, i: usize, j: usize) -> bool {
    let column = |k: usize| &w.as_slice()[k * w.nrows()..(k + 1) * w.nrows()];
    let (a, b, c) = (dot(column(i), column(i)), dot(column(j), column(j)), dot(column(i), column(j)));
    if c.abs() <= f64::EPSILON * w.nrows() as f64 * (a * b).sqrt() {
        return false;
    }
    let zeta = (b - a) / (2.0 * c);
    let tangent = 1.0_f64.copysign(zeta) / (zeta.abs() + zeta.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    let sine = cosine * tangent;
    for matrix in [w, v] {
        for row in 0..matrix.nrows() {
            let (x, y) = (matrix[(row, i)], matrix[(row, j)]);
            matrix[(row, i)] = cosine * x - sine * y;
            matrix[(row, j)] = sine * x + cosine * y;
        }
    }
    true
}

/// The lengths of orthogonal columns in falling order, their directions, and those of `v` with them. Columns that are round-off have no
/// direction: any that is orthogonal to the others.
fn sorted(w: &DMatrix<f64>, v: &DMatrix<f64>) -> SVD<f64, Dyn, Dyn> {
    let (rows, columns) = w.shape();
    let column = |k: usize| &w.as_slice()[k * rows..(k + 1) * rows];
    let mut order: Vec<(f64, usize)> = (0..columns).map(|k| (norm(column(k)), k)).collect();
    order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let least = f64::EPSILON * rows as f64 * order.first().map_or(0.0, |first| first.0);
    let seen = order.iter().take_while(|(length, _)| *length > least);
    let mut left: Vec<Vec<f64>> =
        seen.map(|&(length, k)| column(k).iter().map(|x| x / length).collect()).collect();
    let others = complement(&left, rows);
    left.extend(others.into_iter().take(columns - left.len()));
    SVD {
        u: Some(DMatrix::from_fn(rows, columns, |i, k| left[k][i])),
        v_t: Some(DMatrix::from_fn(columns, columns, |k, i| v[(i, order[k].1)])),
        singular_values: DVector::from_iterator(columns, order.iter().map(|one| one.0)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(matrix: &DMatrix<f64>) -> SVD<f64, Dyn, Dyn> {
        let found = svd(matrix.clone()).expect("it is finite");
        assert!(holds(matrix, &found) && holds(matrix, &jacobi(matrix.clone())));
        let (u, v_t) = (found.u.as_ref().expect("u"), found.v_t.as_ref().expect("v"));
        for gram in [u.transpose() * u, v_t * v_t.transpose()] {
            let off = (&gram - DMatrix::identity(gram.nrows(), gram.ncols())).amax();
            assert!(off < 1e-12, "not orthonormal: {off}");
        }
        assert!(found.singular_values.as_slice().is_sorted_by(|a, b| a >= b));
        found
    }

    /// The equations of straight motion where it begins to turn (two modes, turned by some angle), each row in its own unit: `J - omega G`,
    /// `-G u` and the phase.
    fn straight(angle: f64) -> DMatrix<f64> {
        let [x, y] = [0.5 * libm::cos(angle), 0.5 * libm::sin(angle)];
        let [c, s] = [0.25 * libm::cos(2.0 * angle), 0.25 * libm::sin(2.0 * angle)];
        let phase = [-y, x, -2.0 * s, 2.0 * c].map(|g| g / libm::sqrt(0.5));
        let rows = [
            [0.5 - 3.0 * x * x - y * y - c, -2.0 * x * y - s, -x, -y, y],
            [-2.0 * x * y - s, 0.5 - x * x - 3.0 * y * y + c, y, -x, -x],
            [x, -y, -0.5, 0.0, 2.0 * s],
            [y, x, 0.0, -0.5, -2.0 * c],
            [phase[0], phase[1], phase[2], phase[3], 0.0],
        ];
        DMatrix::from_fn(5, 5, |i, j| {
            let largest = rows[i].iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
            rows[i][j] / largest
        })
    }

    /// Without the check a hundred of these have another matrix's vectors: the coefficient of what begins there was 0.4 to 16 % off.
    #[test]
    fn the_vectors_are_those_of_the_matrix() {
        let mut wrong = 0;
        for k in 0..4000 {
            let matrix = straight(0.001 * f64::from(k));
            wrong += usize::from(!once(matrix.clone()).is_some_and(|found| holds(&matrix, &found)));
            let found = check(&matrix);
            assert!(found.singular_values[4] < 1e-12);
        }
        println!("{wrong} of 4000 are wrong without the check");
        assert!(wrong > 0, "the library does not need the check any more");
    }

    /// Straight motion whose heading no symmetry is declared for: the library's values are off by up to 3e-9 where one is 1e-10.
    #[test]
    fn small_values_leave_the_others_exact() {
        let wide =
            |small: f64| {
                let base = straight(0.4);
                DMatrix::from_fn(4, 5, |i, j| {
                    if j < 4 { base[(i, j)] + if i == j { small } else { 0.0 } } else { 0.0 }
                })
            };
        for k in 0..60 {
            let small = libm::pow(10.0, -0.25 * f64::from(k));
            let found = check(&wide(small));
            // against the eigenvalues of A A^T
            let mut squares: Vec<f64> =
                (wide(small) * wide(small).transpose()).symmetric_eigenvalues().iter().copied().collect();
            squares.sort_by(|a, b| b.total_cmp(a));
            for (value, square) in found.singular_values.iter().zip(&squares) {
                assert!((value * value - square).abs() < 1e-14, "{small}: {value} {square}");
            }
        }
    }

    #[test]
    fn equal_and_vanishing_values_have_orthonormal_vectors() {
        let entry = |i: usize, j: usize, k: usize| libm::sin((i * i * j + 5 * i + 3 * j + 7 * k + 1) as f64);
        for (rows, columns) in [(1, 1), (4, 4), (6, 3), (3, 6), (20, 20)] {
            for k in 0..20 {
                check(&DMatrix::from_fn(rows, columns, |i, j| entry(i, j, k)));
                // of rank one, and a multiple of an orthogonal matrix
                let one = DMatrix::from_fn(rows, columns, |i, j| entry(i, 1, k) * entry(1, j, k));
                let left = found_rank(&svd(one.clone()).expect("it is finite"));
                assert_eq!(left, 1);
                let normal = DVector::from_fn(columns, |i, _| entry(i, 2, k)).normalize();
                check(&((DMatrix::identity(columns, columns) - &normal * normal.transpose() * 2.0) * 3.0));
            }
        }
        assert!(svd(DMatrix::from_element(2, 2, f64::NAN)).is_none());
        assert!(check(&DMatrix::zeros(3, 3)).singular_values.amax() == 0.0);
    }

    fn found_rank(found: &SVD<f64, Dyn, Dyn>) -> usize {
        let largest = found.singular_values.amax();
        found.singular_values.iter().filter(|value| **value > 1e-10 * largest).count()
    }
}
