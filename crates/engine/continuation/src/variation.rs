//! The flow with its derivatives by the start and by the parameter.

use super::family::{Neighbours, Sides};
use motiform_analysis::linear::norm;
use motiform_dynamics::{Equivariant, Semilinear, System, Tangent, VectorField};

/// `u' = f(u, p)`, `w_i' = Df w_i` for as many vectors as there are unknowns, and `w' = Df w + f(u, p + h) - f(u, p - h)` for every
/// parameter: a shape followed by vectors.
///
/// The last ones begin in the direction of the first vector, with the size of the shape; its share is subtracted in the end
/// ([`Variation::by_parameter`]). The round-off of the difference, which is not smooth, is far below the tolerance of vectors of that size
/// then. Of vectors that begin at 0, and of its quotient by 2 h, it would be far above: steps would be cut to a thousandth, in vain.
pub(super) struct Variation<'n> {
    tangent: Tangent<'n, dyn Equivariant>,
    neighbours: &'n Neighbours,
}

impl<'n> Variation<'n> {
    pub(super) fn new(neighbours: &'n Neighbours) -> Self {
        let body: &dyn Equivariant = neighbours.body.as_ref();
        Self { tangent: Tangent::new(body, body.dim() + neighbours.sides.len()), neighbours }
    }

    /// The state at the start of a part: the shape, the unit vectors in the unit of shapes, and the first of them again, in the size of the
    /// shape, for every parameter: errors of all of them are controlled alike.
    pub(super) fn start(&self, shape: &[f64], out: &mut Vec<f64>) {
        let dim = shape.len();
        out.clear();
        out.resize(dim * (dim + 1 + self.neighbours.sides.len()), 0.0);
        out[..dim].copy_from_slice(shape);
        for i in 0..dim {
            out[dim * (1 + i) + i] = self.neighbours.length;
        }
        for parameter in 0..self.neighbours.sides.len() {
            out[dim * (1 + dim + parameter)] = size(self.neighbours, shape);
        }
    }

    /// The derivatives of the end of a part by the parameters, from all its vectors and the shape at its start.
    pub(super) fn by_parameter(neighbours: &Neighbours, start: &[f64], vectors: &[f64]) -> Vec<f64> {
        let dim = start.len();
        let (first, last) = (&vectors[..dim], &vectors[dim * dim..]);
        let part = size(neighbours, start) / neighbours.length;
        let of = |(sides, vector): (&Sides, &[f64])| -> Vec<f64> {
            vector.iter().zip(first).map(|(with, own)| (with - part * own) / sides.width).collect()
        };
        neighbours.sides.iter().zip(last.chunks_exact(dim)).flat_map(of).collect()
    }

    /// Adds `f(u, p + h) - f(u, p - h)` to the rates of the last vectors.
    fn add_slope(&self, u: &[f64], du: &mut [f64]) {
        let (dim, count) = (self.neighbours.body.dim(), self.neighbours.sides.len());
        let Some(first) = du.len().checked_sub(count * dim) else { return };
        for (sides, last) in self.neighbours.sides.iter().zip(du[first..].chunks_exact_mut(dim)) {
            match dim {
                ..=8 => difference::<8>(sides, &u[..dim], last),
                9..=64 => difference::<64>(sides, &u[..dim], last),
                65..=256 => difference::<256>(sides, &u[..dim], last),
                _ => difference_in(sides, &u[..dim], &mut vec![0.0; dim], last),
            }
        }
    }
}

/// The size of a shape; that of the equations for nothing.
fn size(neighbours: &Neighbours, shape: &[f64]) -> f64 {
    let size = norm(shape);
    if size > 0.0 { size } else { neighbours.length }
}

/// `df/dp` at `u`.
pub(super) fn slope_at(sides: &Sides, u: &[f64]) -> Vec<f64> {
    let (mut rates, mut out) = (vec![0.0; u.len()], vec![0.0; u.len()]);
    difference_in(sides, u, &mut rates, &mut out);
    out.iter_mut().for_each(|rate| *rate /= sides.width);
    out
}

fn difference<const N: usize>(sides: &Sides, u: &[f64], out: &mut [f64]) {
    let mut rates = [0.0; N];
    difference_in(sides, u, &mut rates[..u.len()], out);
}

/// Adds the difference of the rates on both sides.
fn difference_in(sides: &Sides, u: &[f64], rates: &mut [f64], out: &mut [f64]) {
    for (body, sign) in [(&sides.above, 1.0), (&sides.below, -1.0)] {
        VectorField::<f64>::eval(body.as_ref(), 0.0, u, rates);
        for (to, from) in out.iter_mut().zip(&*rates) {
            *to += sign * from;
        }
    }
}

impl System for Variation<'_> {
    fn dim(&self) -> usize {
        self.tangent.dim()
    }

    fn vectors(&self) -> Option<usize> {
        Some(self.neighbours.body.dim())
    }

    fn kept(&self) -> u64 {
        self.neighbours.body.kept()
    }
}

impl VectorField<f64> for Variation<'_> {
    fn eval(&self, t: f64, u: &[f64], du: &mut [f64]) {
        self.tangent.eval(t, u, du);
        self.add_slope(u, du);
    }
}

/// The linear part is that of the body, for every vector; what the parameter changes of it is in the rest.
impl Semilinear<f64> for Variation<'_> {
    fn linear(&self, lambda: &mut [f64]) {
        Semilinear::<f64>::linear(&self.tangent, lambda);
    }

    fn nonlinear(&self, t: f64, u: &[f64], du: &mut [f64]) {
        Semilinear::<f64>::nonlinear(&self.tangent, t, u, du);
        self.add_slope(u, du);
    }
}
