//! The tangent flow: an orbit together with small displacements from it, exactly.

use crate::{Dual, Obstacle, Semilinear, System, VectorField};

/// `u' = f(u)`, `w_i' = Df(u) w_i`: a field and `count` tangent vectors, as one system.
///
/// The state is `(u, w_1, .., w_count)`. Derivatives are those of dual numbers, exact to round-off; the linear part of a
/// semilinear field acts on the tangent vectors as it does on the state. The field's own corrections
/// ([`System::project`]) are not followed: the tangent flow is that of `f` alone.
#[derive(Clone, Copy, Debug)]
pub struct Tangent<'f, F: ?Sized> {
    field: &'f F,
    count: usize,
}

type Number = Dual<f64, 1>;

impl<'f, F: System + ?Sized> Tangent<'f, F> {
    /// The tangent flow of `field` with `count` vectors.
    #[must_use]
    pub fn new(field: &'f F, count: usize) -> Self {
        Self { field, count }
    }

    /// The field that the vectors are tangent to.
    #[must_use]
    pub fn field(&self) -> &'f F {
        self.field
    }

    /// Calls `eval(lifted state, rates)` once for every tangent vector and sorts what it writes into `du`.
    fn lift(&self, u: &[f64], du: &mut [f64], eval: impl Fn(&[Number], &mut [Number])) {
        match self.field.dim() {
            ..=8 => self.lift_on_stack::<8>(u, du, eval),
            9..=64 => self.lift_on_stack::<64>(u, du, eval),
            65..=256 => self.lift_on_stack::<256>(u, du, eval),
            dim => {
                let mut room = vec![Number::constant_of(0.0); 2 * dim];
                let (lifted, rates) = room.split_at_mut(dim);
                self.lift_in(lifted, rates, u, du, eval);
            }
        }
    }

    #[inline(always)]
    fn lift_on_stack<const N: usize>(
        &self,
        u: &[f64],
        du: &mut [f64],
        eval: impl Fn(&[Number], &mut [Number]),
    ) {
        let (mut lifted, mut rates) = ([Number::constant_of(0.0); N], [Number::constant_of(0.0); N]);
        let dim = self.field.dim();
        self.lift_in(&mut lifted[..dim], &mut rates[..dim], u, du, eval);
    }

    #[inline(always)]
    fn lift_in(
        &self,
        lifted: &mut [Number],
        rates: &mut [Number],
        u: &[f64],
        du: &mut [f64],
        eval: impl Fn(&[Number], &mut [Number]),
    ) {
        let (state, vectors) = u.split_at(lifted.len());
        let (rate, vector_rates) = du.split_at_mut(lifted.len());
        let zero = &[][..];
        let mut vectors = vectors.chunks_exact(lifted.len().max(1));
        let mut vector_rates = vector_rates.chunks_exact_mut(lifted.len().max(1));
        for direction in 0..self.count.max(1) {
            let vector = vectors.next().unwrap_or(zero);
            for (i, (x, &value)) in lifted.iter_mut().zip(state).enumerate() {
                *x = Dual { value, derivative: [vector.get(i).copied().unwrap_or(0.0)] };
            }
            eval(lifted, rates);
            if direction == 0 {
                for (to, from) in rate.iter_mut().zip(&*rates) {
                    *to = from.value;
                }
            }
            for (to, from) in vector_rates.next().into_iter().flatten().zip(&*rates) {
                *to = from.derivative[0];
            }
        }
    }
}

impl<F: System + ?Sized> System for Tangent<'_, F> {
    fn dim(&self) -> usize {
        self.field.dim() * (1 + self.count)
    }

    fn obstacle(&self, u: &[f64]) -> Option<Obstacle> {
        self.field.obstacle(&u[..self.field.dim()])
    }

    fn vectors(&self) -> Option<usize> {
        Some(self.field.dim())
    }
}

impl<F: VectorField<Number> + ?Sized> VectorField<f64> for Tangent<'_, F> {
    fn eval(&self, t: f64, u: &[f64], du: &mut [f64]) {
        self.lift(u, du, |lifted, rates| self.field.eval(t, lifted, rates));
    }
}

impl<F: Semilinear<Number> + ?Sized> Semilinear<f64> for Tangent<'_, F> {
    fn linear(&self, lambda: &mut [f64]) {
        let dim = self.field.dim();
        let (first, rest) = lambda.split_at_mut(dim);
        self.field.linear(first);
        for part in rest.chunks_exact_mut(dim.max(1)) {
            part.copy_from_slice(first);
        }
    }

    fn nonlinear(&self, t: f64, u: &[f64], du: &mut [f64]) {
        self.lift(u, du, |lifted, rates| self.field.nonlinear(t, lifted, rates));
    }
}

/// The Jacobian `Df(u)`, column by column: entry `(i, j)` is at `j * dim + i`.
#[must_use]
pub fn jacobian<F: VectorField<Number> + ?Sized>(field: &F, u: &[f64]) -> Vec<f64> {
    let dim = u.len();
    let mut state = vec![0.0; dim * (1 + dim)];
    state[..dim].copy_from_slice(u);
    for i in 0..dim {
        state[dim * (1 + i) + i] = 1.0;
    }
    let mut rates = vec![0.0; state.len()];
    Tangent::new(field, dim).eval(0.0, &state, &mut rates);
    rates.split_off(dim)
}
