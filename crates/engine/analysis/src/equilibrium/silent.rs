//! Modes whose phase nothing fixes: they break symmetries of the shape, but none of what the others do.

use super::uncertainty::residual;
use super::{RelativeEquilibrium, linearisation};
use crate::linear::norm;
use motiform_dynamics::Equivariant;

/// A change below this part of the largest rate is none: the shape is known to about that.
const SAME: f64 = 1e-8;

/// The angle by which a mode is turned alone (rad): no angle of a symmetric body.
const TURN: f64 = 1.0;

impl RelativeEquilibrium {
    /// For each unknown, whether it belongs to a mode whose phase nothing fixes: where that mode is turned alone, the shape stays an
    /// equilibrium, and the linearisation of the other unknowns stays as it is. All `false` where no eigenvalue vanishes: such a phase is
    /// a neutral direction beside that of the rotations.
    ///
    /// # Checked by  apps/motiform/tests/all/free_phases.rs
    pub(super) fn silent(&self, body: &dyn Equivariant) -> Vec<bool> {
        let dim = self.shape.len();
        let mut silent = vec![false; dim];
        if !body.symmetry().rotations || self.vanishing_count() == 0 {
            return silent;
        }
        let matrix = linearisation(body, &self.shape, self.turning_rate);
        for mode in modes(body, dim) {
            let own: Vec<f64> = (0..dim).map(|i| if mode[i] { self.shape[i] } else { 0.0 }).collect();
            if norm(&own) <= SAME * norm(&self.shape) {
                continue;
            }
            let mut turned = own;
            body.rotate(TURN, &mut turned);
            let shape: Vec<f64> = (0..dim).map(|i| if mode[i] { turned[i] } else { self.shape[i] }).collect();
            if self.acts_alike(body, &matrix, &mode, &shape) {
                silent.iter_mut().zip(&mode).for_each(|(silent, &inside)| *silent |= inside);
            }
        }
        silent
    }

    /// Returns `true` if another shape is an equilibrium too, with the same linearisation of the unknowns
    /// outside of `mode`.
    fn acts_alike(&self, body: &dyn Equivariant, matrix: &[Vec<f64>], mode: &[bool], shape: &[f64]) -> bool {
        let moved = linearisation(body, shape, self.turning_rate);
        let columns = matrix.iter().zip(&moved).zip(mode).filter(|(_, inside)| !**inside);
        let mut entries =
            columns.flat_map(|((a, b), _)| a.iter().zip(b).zip(mode)).filter(|(_, inside)| !**inside);
        let rest = norm(&residual(body, shape, self.turning_rate));
        rest <= SAME * self.scale * norm(shape)
            && entries.all(|((a, b), _)| (a - b).abs() <= SAME * self.scale)
    }
}

/// The sets of unknowns that rotations mix, each as a mask; without rotations every unknown is one.
pub fn modes(body: &dyn Equivariant, dim: usize) -> Vec<Vec<bool>> {
    let mut label: Vec<usize> = (0..dim).collect();
    let (mut unit, mut spin) = (vec![0.0; dim], vec![0.0; dim]);
    for j in 0..dim {
        unit.fill(0.0);
        unit[j] = 1.0;
        body.spin(&unit, &mut spin);
        for i in (0..dim).filter(|&i| spin[i] != 0.0) {
            let (kept, other) = (label[j], label[i]);
            label.iter_mut().filter(|label| **label == other).for_each(|label| *label = kept);
        }
    }
    let first = (0..dim).filter(|&i| label[..i].iter().all(|other| *other != label[i]));
    first.map(|i| label.iter().map(|other| *other == label[i]).collect()).collect()
}
