//! The symmetry of a steady motion, read off its amplitudes, and the equations in the coordinates that it leaves.

use super::text::Text;
use nalgebra::{DMatrix, DVector, Schur};

/// The symmetry that all motions of a branch have in common.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Frame {
    /// Order of the rotations that leave the shapes unchanged; 0 for a circle.
    pub(super) folds: u32,
    /// `true` if all amplitudes are real.
    pub(super) mirror: bool,
    /// The coordinates that may be other than 0.
    pub(super) kept: Vec<usize>,
}

/// The symmetry of `u` up to the size `room`, and `u` turned so that its axis is the real one.
pub(super) fn upright(text: &Text, u: &DVector<f64>, room: f64) -> (Frame, DVector<f64>) {
    let count = text.modes.len();
    let size = |k: usize| u[2 * k].hypot(u[2 * k + 1]);
    let present: Vec<usize> = (0..count).filter(|&k| size(k) > room).collect();
    let folds = if text.rotates() { present.iter().fold(0, |all, &k| gcd(all, text.modes[k])) } else { 1 };
    let is_real = |u: &DVector<f64>| (0..count).all(|k| u[2 * k + 1].abs() <= room);
    let mut turned = u.clone();
    if let (true, Some(&k)) = (text.rotates() && text.mirrors(), present.first()) {
        let n = f64::from(text.modes[k]);
        let angle = |j: u32| (u[2 * k + 1].atan2(u[2 * k]) + f64::from(j) * std::f64::consts::PI) / n;
        let mut turns = (0..2 * text.modes[k]).map(|j| text.turned(u, angle(j)));
        turned = turns.find(is_real).unwrap_or(turned);
    }
    let mirror = text.mirrors() && is_real(&turned);
    let has = |k: usize| folds == 1 || folds > 1 && text.modes[k].is_multiple_of(folds);
    let kept: Vec<usize> = (0..2 * count).filter(|&i| has(i / 2) && !(mirror && i % 2 == 1)).collect();
    for i in (0..2 * count).filter(|i| !kept.contains(i)) {
        turned[i] = 0.0;
    }
    (Frame { folds, mirror, kept }, turned)
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The equations of steady motions of one symmetry: unknowns `(kept coordinates, omega, p)`.
pub(super) struct Steady<'t> {
    pub(super) text: &'t Text,
    pub(super) frame: Frame,
}

impl Steady<'_> {
    pub(super) fn count(&self) -> usize {
        self.frame.kept.len() + 2
    }

    /// Returns `true` if omega is an unknown.
    fn turns(&self) -> bool {
        self.text.rotates() && !self.frame.mirror && self.frame.folds > 0
    }

    pub(super) fn state(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut u = DVector::zeros(self.text.dim());
        for (place, &i) in self.frame.kept.iter().enumerate() {
            u[i] = x[place];
        }
        u
    }

    pub(super) fn unknowns(&self, u: &DVector<f64>, omega: f64, p: f64) -> DVector<f64> {
        let kept = self.frame.kept.iter().map(|&i| u[i]);
        DVector::from_iterator(self.count(), kept.chain([omega, p]))
    }

    /// `f - omega G u` and `G u . (u - before)`, or omega where nothing turns, with their derivatives.
    pub(super) fn equations(&self, x: &DVector<f64>, before: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let kept = &self.frame.kept;
        let (n, u) = (kept.len(), self.state(x));
        let (rate, by_u, by_p) = self.text.rate(&u, x[n + 1]);
        let spin = self.text.spin(&u);
        let shift = self.operator(&by_u, x[n]);
        let (mut left, mut all) = (DVector::zeros(n + 1), DMatrix::zeros(n + 1, n + 2));
        for (row, &i) in kept.iter().enumerate() {
            left[row] = rate[i] - x[n] * spin[i];
            for (column, &j) in kept.iter().enumerate() {
                all[(row, column)] = shift[(i, j)];
            }
            (all[(row, n)], all[(row, n + 1)]) = (-spin[i], by_p[i]);
        }
        if self.turns() {
            let phase = self.text.spin(&self.state(before));
            for (column, &j) in kept.iter().enumerate() {
                all[(n, column)] = phase[j];
                left[n] += phase[j] * (x[column] - before[column]);
            }
        } else {
            (left[n], all[(n, n)]) = (x[n], 1.0);
        }
        (left, all)
    }

    /// `Df - omega G`.
    fn operator(&self, by_u: &DMatrix<f64>, omega: f64) -> DMatrix<f64> {
        let mut out = by_u.clone();
        for j in 0..self.text.dim() {
            let mut unit = DVector::zeros(self.text.dim());
            unit[j] = 1.0;
            out.set_column(j, &(out.column(j) - omega * self.text.spin(&unit)));
        }
        out
    }

    /// The linearisation without the neutral direction, of deviations that keep the symmetry and of the others, with bases of both.
    pub(super) fn blocks(&self, x: &DVector<f64>) -> [(DMatrix<f64>, DMatrix<f64>); 2] {
        let (n, u) = (self.frame.kept.len(), self.state(x));
        let (_, by_u, _) = self.text.rate(&u, x[n + 1]);
        let operator = self.operator(&by_u, x[n]);
        let spin = self.text.spin(&u);
        [true, false].map(|keeps| {
            let dim = self.text.dim();
            let places: Vec<usize> = (0..dim).filter(|i| self.frame.kept.contains(i) == keeps).collect();
            let along = DVector::from_fn(dim, |i, _| if places.contains(&i) { spin[i] } else { 0.0 });
            let basis = complement(&places, &[along]);
            (basis.transpose() * &operator * &basis, basis)
        })
    }
}

/// An orthonormal basis of the coordinates `places` without the directions `along`, where they are some.
pub(super) fn complement(places: &[usize], along: &[DVector<f64>]) -> DMatrix<f64> {
    let dim = along[0].len();
    let mut all: Vec<DVector<f64>> = Vec::new();
    for direction in along {
        let mut rest = direction.clone();
        for other in &all {
            rest -= other * other.dot(&rest);
        }
        if rest.norm() > 1e-9 {
            all.push(rest.normalize());
        }
    }
    let neutral = all.len();
    for &i in places {
        let mut unit = DVector::zeros(dim);
        unit[i] = 1.0;
        for _ in 0..2 {
            for other in &all {
                unit -= other * other.dot(&unit);
            }
        }
        if all.len() < places.len() && unit.norm() > 1e-3 / dim as f64 {
            all.push(unit.normalize());
        }
    }
    DMatrix::from_fn(dim, all.len() - neutral, |i, j| all[neutral + j][i])
}

/// Eigenvalues `(re, im)`. (Shifted by the matrix's size: what couples entries of 0 is then small beside them. The method may stall: then
/// the same matrix in other coordinates is tried.)
pub(super) fn eigenvalues(matrix: &DMatrix<f64>) -> Vec<(f64, f64)> {
    spectrum(matrix).expect("eigenvalues")
}

/// The same; `None` where the method stalls in all of them.
pub(super) fn spectrum(matrix: &DMatrix<f64>) -> Option<Vec<(f64, f64)>> {
    let n = matrix.nrows();
    if n == 0 {
        return Some(Vec::new());
    }
    let shift = matrix.norm();
    let mut moved = matrix + shift * DMatrix::identity(n, n);
    let found = [1e-15, 1e-15, 1e-14, 1e-14, 1e-13, 1e-13, 1e-12].into_iter().find_map(|room| {
        let schur = Schur::try_new(moved.clone(), room, 500);
        let normal = DVector::from_fn(n, |i, _| 1.0 + (i as f64 * room * 1e15).sin()).normalize();
        let turn = DMatrix::identity(n, n) - 2.0 * &normal * normal.transpose();
        moved = (&turn * &moved * &turn).transpose();
        schur
    });
    let values = found?.complex_eigenvalues();
    Some(values.iter().map(|value| (value.re - shift, value.im)).collect())
}
