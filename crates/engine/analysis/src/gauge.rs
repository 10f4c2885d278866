//! The section that reduced orbits are watched on.

use crate::linear::{dot, norm};
use motiform_dynamics::Equivariant;

/// A size of the reduced shape, whose extremes are the section that reduced orbits are watched on.
///
/// Where rotations are divided out `|u|`, which no rotation and no mirror changes. Otherwise `l . u` with a fixed vector `l` in general
/// position, for `|u|` may be constant on an orbit; with a mirror M averaged with that of the mirror image, `l . (u + M u)/2`, which is
/// `l' . u` with another vector. Two shapes differ in it by no more than their distance.
#[derive(Clone, Debug, PartialEq)]
pub struct Gauge {
    /// The vector; `None` where the size is the norm.
    form: Option<Vec<f64>>,
}

impl Gauge {
    /// That of a body.
    pub fn of(body: &dyn Equivariant) -> Self {
        Self { form: (!body.symmetry().rotations).then(|| general(body)) }
    }

    /// The size.
    pub fn size(&self, shape: &[f64]) -> f64 {
        self.form.as_ref().map_or_else(|| norm(shape), |form| dot(form, shape))
    }

    /// A function that vanishes where the size of an orbit has its extremes, smooth everywhere: `u . f(u)`, or `l . f(u)`.
    pub fn rate(&self, body: &dyn Equivariant, shape: &[f64]) -> f64 {
        let rate = body.rates(shape);
        dot(self.form.as_deref().unwrap_or(shape), &rate)
    }

    /// The vector, if the size is not the norm.
    pub(crate) fn form(&self) -> Option<&[f64]> {
        self.form.as_deref()
    }
}

/// `l_i` proportional to `1/(1 + 0.618 i)`, of unit length; with a mirror the mean of `l` and `M^T l`.
fn general(body: &dyn Equivariant) -> Vec<f64> {
    let weights: Vec<f64> = (0..body.dim()).map(|i| 1.0 / (1.0 + 0.618 * i as f64)).collect();
    let length = norm(&weights);
    let unit: Vec<f64> = weights.iter().map(|weight| weight / length).collect();
    if !body.symmetry().mirror {
        return unit;
    }
    let mirrored = |i: usize| {
        let mut image = vec![0.0; unit.len()];
        image[i] = 1.0;
        body.mirror(&mut image);
        0.5 * (unit[i] + dot(&unit, &image))
    };
    (0..unit.len()).map(mirrored).collect()
}
