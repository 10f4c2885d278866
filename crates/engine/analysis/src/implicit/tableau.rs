//! The coefficients of Radau IIA methods.

use super::product::inverse;
use nalgebra::{DMatrix, DVector};
use std::sync::OnceLock;

/// Number of stages.
pub(super) const STAGES: usize = 5;

/// Radau IIA with 5 stages: of order 9, L-stable; the last stage is the end of the step.
///
/// Source: Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.5.
pub(super) struct Tableau {
    /// `c_i`: times of the stages, in steps.
    pub(super) nodes: [f64; STAGES],
    /// `a_ij`: the integral of the `j`-th Lagrange polynomial from 0 to `c_i`.
    pub(super) weights: [[f64; STAGES]; STAGES],
    /// The inverse of the matrix of the weights.
    pub(super) inverse: [[f64; STAGES]; STAGES],
    /// The coefficient of the fifth power in the polynomial through the start and the stages, from these six values.
    pub(super) leading: [f64; STAGES + 1],
}

impl Tableau {
    /// The coefficients, computed at the first use.
    pub(super) fn get() -> &'static Self {
        static TABLEAU: OnceLock<Tableau> = OnceLock::new();
        TABLEAU.get_or_init(Self::compute)
    }

    fn compute() -> Self {
        let nodes = nodes();
        // sum_j a_ij c_j^(k-1) = c_i^k / k
        let powers = DMatrix::from_fn(STAGES, STAGES, |k, j| power(nodes[j], k)).lu();
        let row = |c: f64| {
            let rhs = DVector::from_fn(STAGES, |k, _| power(c, k + 1) / (k + 1) as f64);
            let row = powers.solve(&rhs).unwrap_or_else(|| DVector::zeros(STAGES));
            std::array::from_fn(|j| row[j])
        };
        let all = with_start(&nodes);
        let leading = std::array::from_fn(|j| 1.0 / differences(&all, j, all[j]));
        let weights = nodes.map(row);
        let matrix = DMatrix::from_fn(STAGES, STAGES, |i, j| weights[i][j]);
        let inverse = inverse(matrix).unwrap_or_else(|| DMatrix::zeros(STAGES, STAGES));
        let inverse = std::array::from_fn(|i| std::array::from_fn(|j| inverse[(i, j)]));
        Self { weights, inverse, leading, nodes }
    }

    /// The values at time `c` (in steps) of the Lagrange polynomials that belong to the start and the stages.
    pub(super) fn lagrange(&self, c: f64) -> [f64; STAGES + 1] {
        let all = with_start(&self.nodes);
        std::array::from_fn(|j| differences(&all, j, c) * self.leading[j])
    }
}

fn power(c: f64, k: usize) -> f64 {
    std::iter::repeat_n(c, k).product()
}

fn with_start(nodes: &[f64; STAGES]) -> [f64; STAGES + 1] {
    std::array::from_fn(|j| if j == 0 { 0.0 } else { nodes[j - 1] })
}

/// `prod (c - c_k)` over all `k` but `j`.
fn differences(nodes: &[f64; STAGES + 1], j: usize, c: f64) -> f64 {
    nodes.iter().enumerate().filter(|(k, _)| *k != j).map(|(_, node)| c - node).product()
}

/// The zeros of `P_s(2c - 1) - P_(s-1)(2c - 1)`, in ascending order; the last one is 1.
fn nodes() -> [f64; STAGES] {
    const CELLS: usize = 64;
    let mut out = [1.0; STAGES];
    let at = |i: usize| i as f64 / CELLS as f64;
    let crossed = (0..CELLS - 1).filter(|&i| radau(at(i)) * radau(at(i + 1)) < 0.0);
    for (node, i) in out.iter_mut().zip(crossed) {
        *node = bisect(at(i), at(i + 1));
    }
    out
}

fn bisect(mut low: f64, mut high: f64) -> f64 {
    let sign = radau(low).signum();
    for _ in 0..64 {
        let middle = 0.5 * (low + high);
        if radau(middle) * sign > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

fn radau(c: f64) -> f64 {
    let x = 2.0 * c - 1.0;
    let (mut before, mut now) = (1.0, x);
    for n in 1..STAGES {
        let n = n as f64;
        (before, now) = (now, ((2.0 * n + 1.0) * x * now - n * before) / (n + 1.0));
    }
    now - before
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_of_a_step_is_of_order_9_and_its_stages_of_order_5() {
        let tableau = Tableau::get();
        assert_eq!(tableau.nodes[STAGES - 1], 1.0);
        for k in 1..=9 {
            let sum: f64 =
                (0..STAGES).map(|j| tableau.weights[STAGES - 1][j] * tableau.nodes[j].powi(k - 1)).sum();
            assert!((sum - 1.0 / f64::from(k)).abs() < 1e-14, "{k}: {sum}");
        }
        for (c, row) in tableau.nodes.iter().zip(&tableau.weights) {
            for k in 1..=5 {
                let sum: f64 = (0..STAGES).map(|j| row[j] * tableau.nodes[j].powi(k - 1)).sum();
                assert!((sum - c.powi(k) / f64::from(k)).abs() < 1e-14);
            }
        }
        assert!(tableau.weights[STAGES - 1].iter().all(|&b| b > 0.0));
    }

    #[test]
    fn the_inverse_of_the_weights_undoes_them() {
        let tableau = Tableau::get();
        for (i, row) in tableau.weights.iter().enumerate() {
            for k in 0..STAGES {
                let sum: f64 = (0..STAGES).map(|j| row[j] * tableau.inverse[j][k]).sum();
                assert!((sum - f64::from(u8::from(i == k))).abs() < 1e-13, "{i} {k}: {sum}");
            }
        }
    }

    #[test]
    fn polynomials_are_continued() {
        let tableau = Tableau::get();
        let all = with_start(&tableau.nodes);
        for k in 0..=5 {
            let sum: f64 = tableau.lagrange(1.7).iter().zip(&all).map(|(l, c)| l * c.powi(k)).sum();
            assert!((sum - 1.7_f64.powi(k)).abs() < 1e-11 * 1.7_f64.powi(k));
            let fifth: f64 = tableau.leading.iter().zip(&all).map(|(l, c)| l * c.powi(k)).sum();
            assert!((fifth - if k == 5 { 1.0 } else { 0.0 }).abs() < 1e-11);
        }
    }
}
