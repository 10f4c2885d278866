//! The surface of motions over two parameters: its cuts and its directions.

use super::correct::{directions, normal, product, scaled};
use super::elimination::newton_step;
use super::problem::{Equations, Failure, Linear};
use motiform_dynamics::Watch;

/// The motions over two parameters in a plane: `F(x) = 0` and `row . (x - centre) = 0`. They are a line.
pub(super) struct Section<'s, E> {
    pub(super) equations: &'s E,
    pub(super) row: Vec<f64>,
    pub(super) centre: Vec<f64>,
}

/// The equations at one place, without the plane and with it.
pub(super) struct Cut<L> {
    pub(super) inner: L,
    linear: Linear,
}

impl<E: Equations> Equations for Section<'_, E> {
    type Local = Cut<E::Local>;

    fn local(&self, x: &[f64], watch: &dyn Watch) -> Result<Self::Local, Failure> {
        let inner = self.equations.local(x, watch)?;
        let off: f64 = self.row.iter().zip(x).zip(&self.centre).map(|((r, x), c)| r * (x - c)).sum();
        let linear = bordered(self.equations.linear(&inner), &self.row, off);
        Ok(Cut { inner, linear })
    }

    fn linear<'l>(&self, local: &'l Self::Local) -> &'l Linear {
        &local.linear
    }

    fn weights(&self, x: &[f64]) -> Vec<f64> {
        self.equations.weights(x)
    }

    fn resolution(&self) -> f64 {
        self.equations.resolution()
    }

    fn tidy(&self, x: &mut [f64]) {
        self.equations.tidy(x);
    }

    fn is_sound(&self, x: &[f64]) -> bool {
        self.equations.is_sound(x)
    }
}

/// The equations with one more.
fn bordered(linear: &Linear, row: &[f64], rest: f64) -> Linear {
    let rows = linear.matrix.nrows();
    let mut matrix = linear.matrix.clone().resize_vertically(rows + 1, 0.0);
    row.iter().enumerate().for_each(|(j, value)| matrix[(rows, j)] = *value);
    let mut residual = linear.residual.clone();
    residual.push(rest);
    Linear { residual, matrix, family: Vec::new() }
}

/// Two directions of length 1 in a surface, normal to each other.
#[derive(Clone)]
pub(super) struct Frame {
    /// Along the curve.
    pub(super) along: Vec<f64>,
    /// Across it.
    pub(super) across: Vec<f64>,
}

impl Frame {
    /// To the other side.
    pub(super) fn turn(&mut self) {
        self.along.iter_mut().for_each(|t| *t = -*t);
    }

    /// Any two directions of the surface.
    pub(super) fn any(linear: &Linear, weights: &[f64]) -> Option<Self> {
        let mut null = directions(linear, weights).into_iter();
        Some(Self { along: null.next()?, across: null.next()? })
    }

    /// The directions of the surface near these; those of a frame may have come out of it by errors of its differences.
    pub(super) fn within(&self, linear: &Linear, weights: &[f64]) -> Option<Self> {
        let (row, other) = (normal(&self.along, weights), normal(&self.across, weights));
        let (_, mut along) = newton_step(&bordered(linear, &other, 0.0), &row)?;
        let (_, mut across) = newton_step(&bordered(linear, &row, 0.0), &other)?;
        let lean = product(weights, &self.along, &self.across);
        along.iter_mut().zip(&across).for_each(|(a, b)| *a += lean * b);
        let along = scaled(along, weights)?;
        let part = product(weights, &along, &across);
        across.iter_mut().zip(&along).for_each(|(b, a)| *b -= part * a);
        Some(Self { across: scaled(across, weights)?, along })
    }

    /// The frame turned so that a function with the slopes `a` and `b` along its directions does not change along the first of the new
    /// ones; its slope along the second.
    pub(super) fn level(&self, a: f64, b: f64) -> Option<(Self, f64)> {
        let steep = libm::hypot(a, b);
        if !(steep > 0.0 && steep.is_finite()) {
            return None;
        }
        let mix = |p: f64, q: f64| -> Vec<f64> {
            self.along.iter().zip(&self.across).map(|(x, y)| (p * x + q * y) / steep).collect()
        };
        Some((Self { along: mix(-b, a), across: mix(a, b) }, steep))
    }
}
