//! The symmetry of a motion, and what it makes of deviations: even ones keep the mirror axis, odd ones do not.

use motiform_analysis::linear::{add, apply, basis, complement, dot, norm};
use motiform_analysis::{Isotropy, mean_over_rotations};
use motiform_dynamics::Equivariant;

/// The part of its size up to which a shape counts as equal to its image at a turning point, which Newton's method places less well across
/// the branch than along it.
pub(super) const GAINED: f64 = 1e-4;

/// The symmetry that all shapes of a branch have in common.
#[derive(Clone, Debug)]
pub(super) struct Classes {
    /// Order of the rotations that leave the shapes unchanged.
    pub(super) folds: usize,
    /// `true` if every rotation leaves them unchanged.
    pub(super) circle: bool,
    /// The angle of `R(angle) M`, which leaves the shapes unchanged, if they have a mirror axis.
    pub(super) axis: Option<f64>,
    /// Orthonormal bases: even and odd deviations, or all of them.
    pub(super) bases: Vec<Vec<Vec<f64>>>,
}

impl Classes {
    /// The symmetry of the shapes `nodes`: that of all of them.
    pub(super) fn of(body: &dyn Equivariant, nodes: &[&[f64]]) -> Self {
        Self::within(body, nodes, Isotropy::SAME)
    }

    /// The same, with images that differ by up to the part `same` of a shape.
    pub(super) fn within(body: &dyn Equivariant, nodes: &[&[f64]], same: f64) -> Self {
        let Some(&first) = nodes.first() else { return Self::none(body.dim()) };
        let Isotropy { mut folds, mut circle, mut mirror } = Isotropy::of(body, first, same);
        for node in &nodes[1..] {
            let other = Isotropy::of(body, node, same);
            circle &= other.circle;
            if other.folds != folds {
                folds = 1;
            }
            mirror = mirror.filter(|&axis| {
                let mut image = reflected(body, axis, node);
                add(&mut image, -1.0, node);
                norm(&image) <= same * norm(node)
            });
        }
        let bases = match mirror {
            Some(axis) => vec![half(body, axis, 1.0), half(body, axis, -1.0)],
            None => Self::none(body.dim()).bases,
        };
        Self { folds, circle, axis: mirror, bases }
    }

    fn none(dim: usize) -> Self {
        Self { folds: 1, circle: false, axis: None, bases: vec![complement(&[], dim)] }
    }

    /// Makes the symmetry of a shape exact.
    pub(super) fn tidy(&self, body: &dyn Equivariant, shape: &mut [f64]) {
        if let Some(axis) = self.axis {
            let image = reflected(body, axis, shape);
            shape.iter_mut().for_each(|x| *x *= 0.5);
            add(shape, 0.5, &image);
        }
        if self.folds > 1 || self.circle {
            let mean = self.mean(body, shape);
            shape.copy_from_slice(&mean);
        }
    }

    /// Column `j` of `A P + rest (1 - P)`, with `P` the projection on the deviations that keep all symmetry; `A` itself where there is
    /// none.
    pub(super) fn kept(&self, body: &dyn Equivariant, matrix: &[f64], j: usize, rest: f64) -> Vec<f64> {
        let dim = body.dim();
        if self.axis.is_none() && self.folds == 1 && !self.circle {
            return matrix[j * dim..(j + 1) * dim].to_vec();
        }
        let mut unit = vec![0.0; dim];
        unit[j] = 1.0;
        let mut kept = unit.clone();
        self.tidy(body, &mut kept);
        let mut out = apply(matrix, &kept);
        add(&mut out, -rest, &kept);
        add(&mut out, rest, &unit);
        out
    }

    /// Returns `true` if a deviation breaks rotations of the shape.
    pub(super) fn breaks_rotations(&self, body: &dyn Equivariant, deviation: &[f64]) -> bool {
        if self.circle {
            return true;
        }
        let mut rest = self.mean(body, deviation);
        add(&mut rest, -1.0, deviation);
        norm(&rest) > 1e-3 * norm(deviation)
    }

    /// Bases of the classes without the directions `neutral`, which are orthonormal and lie within the classes.
    pub(super) fn without(&self, neutral: &[Vec<f64>]) -> Vec<Vec<Vec<f64>>> {
        let free = |class: &Vec<Vec<f64>>| {
            let coordinates = |v: &Vec<f64>| class.iter().map(|c| dot(c, v)).collect::<Vec<_>>();
            let within = neutral.iter().map(coordinates).filter(|fixed| norm(fixed) > 0.5);
            let within: Vec<Vec<f64>> = within.collect();
            let fixed = basis(&within.iter().map(Vec::as_slice).collect::<Vec<_>>(), 1e-6);
            complement(&fixed, class.len()).iter().map(|part| combined(class, part)).collect()
        };
        self.bases.iter().map(free).collect()
    }

    /// The mean over the rotations that leave the shape unchanged.
    fn mean(&self, body: &dyn Equivariant, x: &[f64]) -> Vec<f64> {
        // for a circle more turns than there are modes: what is left is what no rotation changes
        let folds = if self.circle { x.len() + 1 } else { self.folds };
        mean_over_rotations(body, x, folds)
    }
}

/// `sum_i parts_i vectors_i`.
fn combined(vectors: &[Vec<f64>], parts: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; vectors.first().map_or(0, Vec::len)];
    vectors.iter().zip(parts).for_each(|(vector, part)| add(&mut sum, *part, vector));
    sum
}

/// `R(axis) M shape`.
fn reflected(body: &dyn Equivariant, axis: f64, shape: &[f64]) -> Vec<f64> {
    let mut image = shape.to_vec();
    body.mirror(&mut image);
    body.rotate(axis, &mut image);
    image
}

/// An orthonormal basis of the deviations with `R(axis) M x = sign x`.
fn half(body: &dyn Equivariant, axis: f64, sign: f64) -> Vec<Vec<f64>> {
    let part = |unit: &Vec<f64>| {
        let mut out = reflected(body, axis, unit);
        out.iter_mut().for_each(|x| *x *= 0.5 * sign);
        add(&mut out, 0.5, unit);
        out
    };
    let images: Vec<Vec<f64>> =
        complement(&[], body.dim()).iter().map(part).filter(|x| norm(x) > 1e-3).collect();
    basis(&images.iter().map(Vec::as_slice).collect::<Vec<_>>(), 1e-6)
}
