//! Eigenvalues of small matrices.

/// Steps that each eigenvalue or pair may take.
const STEPS: u32 = 60;

/// After so many steps without an eigenvalue a step has another shift, and an entry below the round-off of the whole matrix is 0.
const SLOW: u32 = 10;

/// The eigenvalues `(re, im)` of a matrix given by its columns, conjugates next to one another. `None` where an entry is not finite.
///
/// Steps of the QR method with two shifts. The first column of a step is taken from differences of the diagonal, so that equal eigenvalues
/// converge as others do: `a^2 - (a + b) a + a b` is round-off where `a` and `b` are nearly equal.
///
/// Source: Martin, Peters, Wilkinson (1970), Numer. Math. 14, 219 (procedure hqr).
pub fn eigenvalues(columns: &[Vec<f64>]) -> Option<Vec<(f64, f64)>> {
    if !columns.iter().flatten().all(|x| x.is_finite()) {
        return None;
    }
    let largest = columns.iter().flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if largest == 0.0 {
        return Some(vec![(0.0, 0.0); columns.len()]);
    }
    let scaled = |i: usize| columns.iter().map(|column| column[i] / largest).collect();
    let mut h: Vec<Vec<f64>> = (0..columns.len()).map(scaled).collect();
    for k in 0..h.len().saturating_sub(2) {
        let below: Vec<f64> = h[k + 1..].iter().map(|row| row[k]).collect();
        reflect(&mut h, k + 1, below);
        h[k + 2..].iter_mut().for_each(|row| row[k] = 0.0);
    }
    let mut out = Vec::with_capacity(h.len());
    let (mut count, mut steps) = (h.len(), 0);
    while let Some(last) = count.checked_sub(1) {
        let is_zero = |i: &usize| {
            let beside = h[*i][*i].abs() + h[i - 1][i - 1].abs();
            let all = if steps < SLOW { beside } else { beside.max(1.0) };
            h[*i][i - 1].abs() <= f64::EPSILON * all
        };
        let first = (1..count).rev().find(is_zero).unwrap_or(0);
        match last - first {
            0 => out.push((h[last][last], 0.0)),
            1 => out.extend(pair([h[first][first], h[first][last], h[last][first], h[last][last]])),
            _ if steps == STEPS => return None,
            _ => {
                step(&mut h, first, last, steps % SLOW == SLOW - 1);
                steps += 1;
                continue;
            }
        }
        (count, steps) = (first, 0);
    }
    out.iter_mut().for_each(|value| *value = (value.0 * largest, value.1 * largest));
    Some(out)
}

/// One step on the rows and columns `first..=last`, with the eigenvalues of the last two rows as its shifts, or with `other` ones.
fn step(h: &mut [Vec<f64>], first: usize, last: usize, other: bool) {
    let (mut x, mut y, mut w) = (h[last][last], h[last - 1][last - 1], h[last][last - 1] * h[last - 1][last]);
    if other {
        let size = h[last][last - 1].abs() + h[last - 1][last - 2].abs();
        (x, y, w) = (x + 0.75 * size, x + 0.75 * size, -0.4375 * size * size);
    }
    let z = h[first][first];
    let below = h[first + 1][first];
    let head = ((x - z) * (y - z) - w) / below + h[first][first + 1];
    let mut bulge = vec![head, h[first + 1][first + 1] - z - (x - z) - (y - z), h[first + 2][first + 1]];
    for k in first..last {
        if k > first {
            bulge = (k..=last.min(k + 2)).map(|i| h[i][k - 1]).collect();
        }
        reflect(h, k, std::mem::take(&mut bulge));
        if k > first {
            (k + 1..=last.min(k + 2)).for_each(|i| h[i][k - 1] = 0.0);
        }
    }
}

/// `H A H` with the reflection of the rows from `start` on that turns `vector` into the first of them.
fn reflect(h: &mut [Vec<f64>], start: usize, mut vector: Vec<f64>) {
    let largest = vector.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if largest == 0.0 {
        return;
    }
    vector.iter_mut().for_each(|x| *x /= largest);
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt().copysign(vector[0]);
    vector[0] += length;
    let factor = 1.0 / (length * vector[0]);
    for j in 0..h.len() {
        let along = factor * vector.iter().enumerate().map(|(i, v)| v * h[start + i][j]).sum::<f64>();
        vector.iter().enumerate().for_each(|(i, v)| h[start + i][j] -= along * v);
    }
    for row in h {
        let along = factor * vector.iter().zip(&row[start..]).map(|(v, x)| v * x).sum::<f64>();
        vector.iter().zip(&mut row[start..]).for_each(|(v, x)| *x -= along * v);
    }
}

/// The eigenvalues of `[[a, b], [c, d]]`.
fn pair([a, b, c, d]: [f64; 4]) -> [(f64, f64); 2] {
    let half = 0.5 * (a - d);
    let square = half * half + b * c;
    let root = square.abs().sqrt();
    if square < 0.0 {
        return [(d + half, root), (d + half, -root)];
    }
    let far = half + root.copysign(half);
    [(d + far, 0.0), (if far == 0.0 { d } else { d - b * c / far }, 0.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest distance of an eigenvalue of the matrix from the nearest of those expected, each taken once.
    fn off(columns: &[Vec<f64>], expected: &[(f64, f64)]) -> f64 {
        let mut left = expected.to_vec();
        let found = eigenvalues(columns).expect("they converge");
        assert_eq!(found.len(), left.len());
        let distance = |a: (f64, f64), b: (f64, f64)| libm::hypot(a.0 - b.0, a.1 - b.1);
        let nearest = |value: (f64, f64)| {
            let by = |&i: &usize, &j: &usize| distance(left[i], value).total_cmp(&distance(left[j], value));
            let at = (0..left.len()).min_by(by).expect("as many are left");
            distance(left.swap_remove(at), value)
        };
        found.into_iter().map(nearest).fold(0.0, f64::max)
    }

    /// `Q D Q^T` with a rotation `Q` of all pairs of axes, by angles that `seed` says.
    fn turned(blocks: &[Vec<f64>], seed: usize) -> Vec<Vec<f64>> {
        let mut matrix = blocks.to_vec();
        for (i, j) in (0..matrix.len()).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let (sin, cos) = libm::sincos((1 + seed + 3 * i + 7 * i * j) as f64);
            for row in &mut matrix {
                (row[i], row[j]) = (cos * row[i] - sin * row[j], sin * row[i] + cos * row[j]);
            }
            let (a, b) = (matrix[i].clone(), matrix[j].clone());
            matrix[i] = a.iter().zip(&b).map(|(a, b)| cos * a - sin * b).collect();
            matrix[j] = a.iter().zip(&b).map(|(a, b)| sin * a + cos * b).collect();
        }
        matrix
    }

    /// Normal matrices: eigenvalues move by no more than the entries do. All equal, in groups, and in pairs; with noise of every size.
    #[test]
    fn equal_eigenvalues_are_found_whatever_the_noise() {
        let groups = |values: &[f64]| -> Vec<Vec<f64>> {
            let entry = |i: usize, j: usize| if i == j { values[i] } else { 0.0 };
            (0..values.len()).map(|j| (0..values.len()).map(|i| entry(i, j)).collect()).collect()
        };
        let mut pairs = groups(&[0.5; 6]);
        for i in [0, 2, 4] {
            (pairs[i][i + 1], pairs[i + 1][i]) = (0.3, -0.3);
        }
        let turns: Vec<(f64, f64)> = [0.3, -0.3].repeat(3).iter().map(|im| (0.5, *im)).collect();
        let real = |values: &[f64]| values.iter().map(|x| (*x, 0.0)).collect();
        let (one, two) = ([0.043; 5], [1.0, 1.0, 1.0, -2.0, -2.0, -2.0, 1e-9]);
        let cases: [(_, Vec<(f64, f64)>); 3] =
            [(groups(&one), real(&one)), (groups(&two), real(&two)), (pairs, turns)];
        for (blocks, expected) in &cases {
            for (seed, noise) in (0..300).map(|seed| (seed, libm::pow(10.0, -((2 + seed % 30) as f64)))) {
                let mut matrix = turned(blocks, seed);
                let mut random = 0.5 + seed as f64;
                for x in matrix.iter_mut().flatten() {
                    random = (random * 9301.0 + 49297.0) % 233_280.0;
                    *x += noise * (random / 233_280.0 - 0.5);
                }
                let off = off(&matrix, expected);
                assert!(off < 7.0 * noise + 1e-13, "{seed} {noise:e}: {off:e}");
            }
        }
    }

    /// Roots of unity: without a change of shifts nothing converges. A Jordan block; a graded matrix; sizes near the ends of numbers.
    #[test]
    fn special_matrices_have_their_eigenvalues() {
        for size in 1..9 {
            let cycle = |j: usize| (0..size).map(|i| f64::from(u8::from(i == (j + 1) % size))).collect();
            let root = |k: usize| std::f64::consts::TAU * k as f64 / size as f64;
            let roots: Vec<(f64, f64)> =
                (0..size).map(|k| (libm::cos(root(k)), libm::sin(root(k)))).collect();
            assert!(off(&(0..size).map(cycle).collect::<Vec<_>>(), &roots) < 1e-14, "{size}");
        }
        let jordan = [vec![2.0, 0.0, 0.0], vec![1.0, 2.0, 0.0], vec![0.0, 1.0, 2.0]];
        assert!(off(&jordan, &[(2.0, 0.0); 3]) < 1e-14);
        for scale in [1e-300, 1.0, 1e300] {
            let graded =
                [vec![scale, 0.0, 0.0], vec![scale, 1e-8 * scale, 0.0], vec![0.0, scale, 1e-16 * scale]];
            let found = eigenvalues(&graded).expect("they converge");
            assert!(
                found.iter().all(|value| value.1 == 0.0)
                    && off(&graded, &[(scale, 0.0), (1e-8 * scale, 0.0), (1e-16 * scale, 0.0)])
                        < 1e-15 * scale,
                "{found:?}"
            );
        }
        assert_eq!(eigenvalues(&[vec![0.0; 2], vec![0.0; 2]]), Some(vec![(0.0, 0.0); 2]));
        assert_eq!(eigenvalues(&[vec![f64::NAN]]), None);
        assert_eq!(eigenvalues(&[]), Some(Vec::new()));
    }
}
