//! Coordinates that rest beside a motion.

use super::SplitMix;
use crate::linear::{eigenvalues, norm};
use motiform_dynamics::Equivariant;
use motiform_dynamics::tangent::jacobian;

/// A coordinate rests where it is below this part of the shape, and is not acted on where a derivative is below this part of the largest.
const STILL: f64 = 1e-9;

/// Shapes at which the derivatives are compared.
const SHAPES: usize = 3;

/// Rates (inverse model time) at which deviations of the coordinates decay or grow in which the motion rests, and on which the others do
/// not act: what was added to equations and takes no part in the motion. None where these rates change with the others.
///
/// In these coordinates the tangent flow is one of its own, so its exponents are among those of the whole.
///
/// # Checked by  apps/motiform/tests/all/equations.rs: the dimension of Lorenz-63 beside decaying coordinates
pub(super) fn silent_rates(body: &dyn Equivariant, shape: &[f64]) -> Vec<f64> {
    let (dim, size) = (shape.len(), norm(shape));
    let mut rests: Vec<bool> = shape.iter().map(|x| x.abs() <= STILL * size).collect();
    if size == 0.0 || !size.is_finite() || !rests.contains(&true) || !rests.contains(&false) {
        return Vec::new();
    }
    let mut random = SplitMix(5);
    let mut moved = |rests: &[bool]| -> Vec<f64> {
        let beside = |(x, rests): (&f64, &bool)| if *rests { *x } else { x + 0.3 * size * random.next() };
        shape.iter().zip(rests).map(beside).collect()
    };
    let others: Vec<Vec<f64>> = (1..SHAPES).map(|_| moved(&rests)).collect();
    let matrices: Vec<Vec<f64>> =
        std::iter::once(shape).chain(others.iter().map(Vec::as_slice)).map(|u| jacobian(body, u)).collect();
    let largest = matrices.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    if !matrices.iter().flatten().all(|x| x.is_finite()) {
        return Vec::new();
    }
    let entry = |matrix: &Vec<f64>, i: usize, j: usize| matrix[j * dim + i];
    let acts = |i: usize, j: usize| matrices.iter().any(|m| entry(m, i, j).abs() > STILL * largest);
    left_alone(&mut rests, acts);
    let silent: Vec<usize> = (0..dim).filter(|&i| rests[i]).collect();
    let pairs = || silent.iter().flat_map(|&j| silent.iter().map(move |&i| (i, j)));
    let changes = |m: &Vec<f64>| {
        pairs().any(|(i, j)| (entry(m, i, j) - entry(&matrices[0], i, j)).abs() > STILL * largest)
    };
    if silent.is_empty() || matrices.iter().any(changes) {
        return Vec::new();
    }
    let columns: Vec<Vec<f64>> =
        silent.iter().map(|&j| silent.iter().map(|&i| entry(&matrices[0], i, j)).collect()).collect();
    eigenvalues(&columns).unwrap_or_default().iter().map(|value| value.0).collect()
}

/// Of coordinates that rest keeps those on which the others do not act: `acts(i, j)` says whether coordinate j acts on coordinate i. The
/// deviations of those that are kept say nothing about the motion, and the motion nothing about them.
pub fn left_alone(rests: &mut [bool], acts: impl Fn(usize, usize) -> bool) {
    let acted_on = |rests: &[bool], i: usize| (0..rests.len()).any(|j| !rests[j] && acts(i, j));
    while let Some(i) = (0..rests.len()).find(|&i| rests[i] && acted_on(rests, i)) {
        rests[i] = false;
    }
}
