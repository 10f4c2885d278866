//! Orthonormal tangent vectors, over any bundle: the frame that exponents are measured in.

use super::SplitMix;
use crate::linear;
use motiform_dynamics::{Bundle, Mask};

/// A vector that keeps less than this part of its length has lost digits: it is cleaned once more, and its rates are evaluated
/// rather than transformed.
const POOR: f64 = 1e-5;

/// Below this part a vector depends on those before it.
const NOTHING: f64 = 1e-14;

/// Makes the vectors of length `dim` orthonormal, in order, in the lanes of `due`, by modified Gram-Schmidt; the lengths that
/// were divided out, the diagonal of R, go into `lengths`. A vector that depends on the earlier ones becomes 0, with length 0: its
/// direction is lost, see [`replace_lost`].
///
/// W = Q R, and the rates `Df W = (Df Q) R` are put through the same operations: `rates` holds those of `W` before, and those of
/// `Q` after. In the lanes of the returned mask they have lost digits and must be evaluated again.
///
/// Source: Golub, Van Loan, Matrix Computations, 5.2.8; again where much was lost: Kahan, Parlett, see Giraud et al. (2005),
/// Numer. Math. 101, 87.
#[inline(always)]
pub(crate) fn orthonormalise<B: Bundle>(
    due: Mask,
    dim: usize,
    vectors: &mut [B],
    rates: &mut [B],
    lengths: &mut [B],
) -> Mask {
    let (zero, one) = (B::splat(0.0), B::splat(1.0));
    let mut lost = Mask::default();
    for k in 0..lengths.len() {
        let before = square(&vectors[dim * k..dim * (k + 1)]);
        clean(due, dim, k, vectors, rates);
        let mut after = square(&vectors[dim * k..dim * (k + 1)]);
        let poor = after.at_most(before * (POOR * POOR)) & due;
        if poor.any() {
            lost |= poor;
            clean(poor, dim, k, vectors, rates);
            after = B::select(poor, square(&vectors[dim * k..dim * (k + 1)]), after);
        }
        let kept = (before * (NOTHING * NOTHING)).less(after);
        let length = after.sqrt();
        let factor = B::select(due, B::select(kept, one / length, zero), one);
        for i in dim * k..dim * (k + 1) {
            vectors[i] = vectors[i] * factor;
            rates[i] = rates[i] * factor;
        }
        lengths[k] = B::select(kept, length, zero);
    }
    lost
}

/// Puts unit vectors in general position, orthogonal to all others, in the places of those that became 0.
#[cold]
pub(crate) fn replace_lost(dim: usize, vectors: &mut [f64], lengths: &[f64]) {
    let mut random = SplitMix(2);
    let (mut kept, mut replaced) = (Vec::new(), Vec::new());
    for (vector, &length) in vectors.chunks_exact_mut(dim).zip(lengths) {
        if length > 0.0 {
            kept.push(vector);
        } else {
            vector.fill_with(|| random.next());
            replaced.push(vector);
        }
    }
    kept.append(&mut replaced);
    linear::orthonormalise(&mut kept);
}

/// `w_k -= (w_j . w_k) w_j` for all `j < k` in the lanes of `due`, and the same with the rates.
#[inline(always)]
fn clean<B: Bundle>(due: Mask, dim: usize, k: usize, vectors: &mut [B], rates: &mut [B]) {
    let zero = B::splat(0.0);
    let (others, vector) = vectors.split_at_mut(dim * k);
    let (other_rates, rate) = rates.split_at_mut(dim * k);
    for j in 0..k {
        let other = &others[dim * j..dim * (j + 1)];
        let mut along = zero;
        for i in 0..dim {
            along = other[i].mul_add(vector[i], along);
        }
        let along = -B::select(due, along, zero);
        for i in 0..dim {
            vector[i] = other[i].mul_add(along, vector[i]);
            rate[i] = other_rates[dim * j + i].mul_add(along, rate[i]);
        }
    }
}

/// `|w|^2`.
#[inline(always)]
fn square<B: Bundle>(vector: &[B]) -> B {
    let mut sum = B::splat(0.0);
    for &x in vector {
        sum = x.mul_add(x, sum);
    }
    sum
}
