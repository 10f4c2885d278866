//! Least squares by orthogonal columns.

/// The coefficients x that make `sum_j x_j columns_j` closest to `right`, and the largest entry of what is left over.
///
/// Modified Gram-Schmidt, twice, then back substitution: accurate to the condition number times round-off.
pub(super) fn least_squares(columns: &[Vec<f64>], right: &[f64]) -> (Vec<f64>, f64) {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let n = columns.len();
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(n);
    let mut upper = vec![vec![0.0; n]; n];
    for (j, column) in columns.iter().enumerate() {
        let mut vector = column.clone();
        for _ in 0..2 {
            for (i, other) in basis.iter().enumerate() {
                let along = dot(other, &vector);
                upper[i][j] += along;
                vector.iter_mut().zip(other).for_each(|(x, y)| *x -= along * y);
            }
        }
        let length = dot(&vector, &vector).sqrt();
        upper[j][j] = length;
        vector.iter_mut().for_each(|x| *x /= length);
        basis.push(vector);
    }
    let mut rest = right.to_vec();
    let mut x = vec![0.0; n];
    for (i, vector) in basis.iter().enumerate() {
        x[i] = dot(vector, &rest);
        rest.iter_mut().zip(vector).for_each(|(r, v)| *r -= x[i] * v);
    }
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| upper[i][j] * x[j]).sum();
        x[i] = (x[i] - known) / upper[i][i];
    }
    (x, rest.iter().fold(0.0, |m: f64, r| m.max(r.abs())))
}

#[cfg(test)]
mod tests {
    use super::least_squares;

    /// A parabola through noiseless points, and a right side that no column explains.
    #[test]
    fn finds_a_parabola_and_what_it_leaves() {
        let t: Vec<f64> = (0..20).map(|i| f64::from(i) / 10.0 - 1.0).collect();
        let columns: Vec<Vec<f64>> = (0..3).map(|p| t.iter().map(|t| t.powi(p)).collect()).collect();
        let right: Vec<f64> = t.iter().map(|t| 2.0 - 3.0 * t + 0.5 * t * t).collect();
        let (x, rest) = least_squares(&columns, &right);
        assert!(x.iter().zip([2.0, -3.0, 0.5]).all(|(a, b)| (a - b).abs() < 1e-13), "{x:?}");
        assert!(rest < 1e-14);
        let cubic: Vec<f64> = t.iter().map(|t| t * t * t).collect();
        assert!(least_squares(&columns, &cubic).1 > 0.1);
    }
}
