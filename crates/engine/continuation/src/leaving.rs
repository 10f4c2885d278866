//! The directions in which branches leave a pitchfork of a steady shape.

use super::correct::{product, scaled};
use motiform_analysis::Isotropy;
use motiform_analysis::linear::{add, norm};
use motiform_dynamics::Equivariant;
use std::f64::consts::TAU;

/// Two directions that differ by less than this part are one.
const SAME: f64 = 1e-3;

/// The directions in which branches leave a pitchfork, up to the symmetry of the shape: one of each kind.
///
/// A branch has a mirror axis of the shape, or none where the shape has none. The critical directions `critical` (one, or two that the
/// rotations of the shape mix) contain one direction for each mirror axis, which branches may leave to both sides. For a shape with `n`
/// axes and two critical directions there are two kinds of branches, where `n` is odd on the two sides of one axis, where it is
/// even along two axes that no rotation of the shape connects; for a circle, or one critical direction, there is one.
///
/// Source: Golubitsky, Stewart, Schaeffer (1988), Singularities and Groups in Bifurcation Theory II, chapter XIII, section 5: the
/// equivariant branching lemma for `D_n` and `O(2)`.
pub(super) fn leaving(
    body: &dyn Equivariant,
    shape: &[f64],
    critical: &[Vec<f64>],
    weights: &[f64],
) -> Vec<Vec<f64>> {
    let isotropy = Isotropy::of(body, shape, super::classes::GAINED);
    let group = Group { body, dim: shape.len(), isotropy };
    let axes = if isotropy.circle { 1 } else { 2.min(isotropy.folds) };
    let along: Vec<Vec<f64>> =
        (0..axes).filter_map(|axis| group.along_axis(axis, critical, weights)).collect();
    let lines = if along.is_empty() { critical.iter().take(1).cloned().collect() } else { along };
    let mut found: Vec<Vec<f64>> = Vec::new();
    for line in lines {
        let opposite: Vec<f64> = line.iter().map(|x| -x).collect();
        for direction in [line, opposite] {
            if !isotropy.circle || found.is_empty() {
                let is_new = found.iter().all(|other| !group.has_image(other, &direction));
                found.extend(is_new.then_some(direction));
            }
        }
    }
    found
}

/// The rotations and mirrors that leave a shape unchanged, acting on unknowns whose first `dim` are a shape.
struct Group<'b> {
    body: &'b dyn Equivariant,
    dim: usize,
    isotropy: Isotropy,
}

impl Group<'_> {
    /// Angle of the rotation number `k`.
    fn angle(&self, k: usize) -> f64 {
        TAU * k as f64 / self.isotropy.folds as f64
    }

    fn rotated(&self, k: usize, x: &[f64]) -> Vec<f64> {
        let mut out = x.to_vec();
        self.body.rotate(self.angle(k), &mut out[..self.dim]);
        out
    }

    /// The image under the mirror number `k`; `None` where the shape has no mirror axis. A mirror reverses the turning rate, which follows
    /// the shape.
    fn reflected(&self, k: usize, x: &[f64]) -> Option<Vec<f64>> {
        let mut out = x.to_vec();
        self.body.mirror(&mut out[..self.dim]);
        self.body.rotate(self.isotropy.mirror? + self.angle(k), &mut out[..self.dim]);
        out[self.dim] = -out[self.dim];
        Some(out)
    }

    /// The combination of the critical directions that the mirror number `k` leaves unchanged.
    fn along_axis(&self, k: usize, critical: &[Vec<f64>], weights: &[f64]) -> Option<Vec<f64>> {
        let even = |direction: &Vec<f64>| {
            let mut sum = self.reflected(k, direction)?;
            add(&mut sum, 1.0, direction);
            Some(sum)
        };
        let all: Vec<Vec<f64>> = critical.iter().filter_map(even).collect();
        let length = |v: &Vec<f64>| product(weights, v, v);
        let longest = all.into_iter().max_by(|a, b| length(a).total_cmp(&length(b)))?;
        (length(&longest) > SAME).then(|| scaled(longest, weights)).flatten()
    }

    /// Returns `true` if a rotation or mirror of the shape takes `a` to `b`.
    fn has_image(&self, a: &[f64], b: &[f64]) -> bool {
        let is = |image: &[f64]| {
            let mut rest = image[..self.dim].to_vec();
            add(&mut rest, -1.0, &b[..self.dim]);
            norm(&rest) < SAME * norm(&b[..self.dim])
        };
        let mut all = (0..self.isotropy.folds).map(|k| (self.rotated(k, a), self.reflected(k, a)));
        all.any(|(rotated, reflected)| is(&rotated) || reflected.is_some_and(|image| is(&image)))
    }
}
