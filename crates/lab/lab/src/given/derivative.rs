//! Derivatives of a given function along directions: by its Jacobian, or by differences.

use super::Flow;
use crate::pool::held;
use motiform_dynamics::{Dual, Equivariant, Semilinear, Shape, VectorField};

/// Offset of the differences, relative to the largest coordinate: the fifth root of the precision of numbers.
const OFFSET: f64 = 7e-4;

/// Room for one evaluation.
pub(super) struct Room {
    state: Vec<f64>,
    moved: Vec<f64>,
    rates: Vec<f64>,
    slope: Vec<f64>,
    matrix: Vec<f64>,
}

impl Room {
    pub(super) fn new(dim: usize) -> Self {
        let row = || vec![0.0; dim];
        Self { state: row(), moved: row(), rates: row(), slope: row(), matrix: vec![0.0; dim * dim] }
    }
}

impl Flow<'_> {
    /// `Df(x) d` into `room.slope` for the state in `room.state`, without a Jacobian:
    ///
    /// `(8 (f(x + e d) - f(x - e d)) - (f(x + 2 e d) - f(x - 2 e d)))/(12 e)`,   `e |d| = 7e-4 max_i |x_i|`.
    ///
    /// Its relative error is about 1e-12 where `f` is smooth on the scale of its coordinates.
    fn difference(&self, t: f64, direction: impl Fn(usize) -> f64, room: &mut Room) {
        let Room { state, moved, rates, slope, .. } = room;
        slope.fill(0.0);
        let largest = |all: &mut dyn Iterator<Item = f64>| all.fold(0.0, |most: f64, x| most.max(x.abs()));
        let length = largest(&mut (0..state.len()).map(&direction));
        if length == 0.0 {
            return;
        }
        let size = largest(&mut state.iter().copied());
        let e = OFFSET * if size > 0.0 { size } else { 1.0 } / length;
        for (steps, weight) in [(1.0, 8.0), (-1.0, -8.0), (2.0, -1.0), (-2.0, 1.0)] {
            for (place, (to, x)) in moved.iter_mut().zip(&*state).enumerate() {
                *to = x + steps * e * direction(place);
            }
            rates.fill(f64::NAN);
            self.rates(t, moved, rates);
            for (sum, rate) in slope.iter_mut().zip(&*rates) {
                *sum += weight / (12.0 * e) * rate;
            }
        }
    }

    /// `Df(x) d` into `room.slope`, by the Jacobian in `room.matrix`.
    fn product(direction: impl Fn(usize) -> f64, room: &mut Room) {
        let Room { slope, matrix, .. } = room;
        let dim = slope.len();
        for (to, row) in slope.iter_mut().zip(matrix.chunks_exact(dim)) {
            *to = row.iter().enumerate().map(|(place, entry)| entry * direction(place)).sum();
        }
    }
}

impl<const K: usize> VectorField<Dual<f64, K>> for Flow<'_> {
    fn eval(&self, t: f64, u: &[Dual<f64, K>], du: &mut [Dual<f64, K>]) {
        let room = &mut *held(&self.room);
        for (to, from) in room.state.iter_mut().zip(u) {
            *to = from.value;
        }
        room.rates.fill(f64::NAN);
        self.rates(t, &room.state, &mut room.rates);
        for (to, rate) in du.iter_mut().zip(&room.rates) {
            to.value = *rate;
        }
        let known = self.given.jacobian(t, &room.state, &self.parameters, &mut room.matrix);
        for k in 0..K {
            let direction = |place: usize| u[place].derivative[k];
            if known {
                Self::product(direction, room);
            } else {
                self.difference(t, direction, room);
            }
            for (to, slope) in du.iter_mut().zip(&room.slope) {
                to.derivative[k] = *slope;
            }
        }
    }
}

impl Semilinear<f64> for Flow<'_> {
    fn linear(&self, lambda: &mut [f64]) {
        lambda.fill(0.0);
    }

    fn nonlinear(&self, t: f64, u: &[f64], du: &mut [f64]) {
        VectorField::<f64>::eval(self, t, u, du);
    }
}

impl<const K: usize> Semilinear<Dual<f64, K>> for Flow<'_> {
    fn linear(&self, lambda: &mut [f64]) {
        lambda.fill(0.0);
    }

    fn nonlinear(&self, t: f64, u: &[Dual<f64, K>], du: &mut [Dual<f64, K>]) {
        VectorField::<Dual<f64, K>>::eval(self, t, u, du);
    }
}

/// A given function says nothing of a position: its state never moves in the plane.
impl Shape<f64> for Flow<'_> {
    fn velocity(&self, _shape: &[f64]) -> [f64; 2] {
        [0.0; 2]
    }
}

impl<const K: usize> Shape<Dual<f64, K>> for Flow<'_> {
    fn velocity(&self, _shape: &[Dual<f64, K>]) -> [Dual<f64, K>; 2] {
        [Dual { value: 0.0, derivative: [0.0; K] }; 2]
    }
}

/// No symmetry is known.
impl Equivariant for Flow<'_> {}
