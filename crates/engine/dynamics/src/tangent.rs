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
    follow: bool,
}

type Number = Dual<f64, 1>;

/// Several directions at once: one evaluation of the field for up to six of them.
type Wide = Dual<f64, 6>;

/// A field that tangent vectors can be followed in, one at a time and six at once. Every field that is
/// written once over all scalars is one.
pub trait Differentiable: VectorField<Dual<f64, 1>> + VectorField<Dual<f64, 6>> {}

impl<F: VectorField<Dual<f64, 1>> + VectorField<Dual<f64, 6>> + ?Sized> Differentiable for F {}

impl<'f, F: System + ?Sized> Tangent<'f, F> {
    /// The tangent flow of `field` with `count` vectors.
    pub fn new(field: &'f F, count: usize) -> Self {
        Self { field, count, follow: false }
    }

    /// As [`Tangent::new`], but the orbit alone controls the steps of exponential methods: the same steps as without tangent vectors.
    ///
    /// The vectors then are as accurate as those steps make them, which Newton's method does not mind. Vectors that have grown by a large
    /// factor would ask for the digits of their smallest entries, in steps a hundred times shorter.
    pub fn following(field: &'f F, count: usize) -> Self {
        Self { field, count, follow: true }
    }

    /// Calls `eval(lifted state, rates)` once for every `K` tangent vectors and sorts what it writes into `du`.
    fn lift<const K: usize>(
        &self,
        u: &[f64],
        du: &mut [f64],
        eval: impl Fn(&[Dual<f64, K>], &mut [Dual<f64, K>]),
    ) {
        match (self.field.dim(), self.count == K) {
            (2, true) => Self::lift_exactly::<2, K>(u, du, eval),
            (4, true) => Self::lift_exactly::<4, K>(u, du, eval),
            (6, true) => Self::lift_exactly::<6, K>(u, du, eval),
            (8, true) => Self::lift_exactly::<8, K>(u, du, eval),
            (..=8, _) => self.lift_on_stack::<8, K>(u, du, eval),
            (9..=16, _) => self.lift_on_stack::<16, K>(u, du, eval),
            (17..=48, _) => self.lift_on_stack::<48, K>(u, du, eval),
            (49..=256, _) => self.lift_on_stack::<256, K>(u, du, eval),
            (dim, _) => {
                let mut room = vec![Dual::constant_of(0.0); 2 * dim];
                let (lifted, rates) = room.split_at_mut(dim);
                self.lift_in(lifted, rates, u, du, eval);
            }
        }
    }

    /// `K` vectors of `N` numbers, both known to the compiler: copies without loops. (Loops over them took
    /// twice the time of the field of six numbers.)
    #[inline(never)]
    fn lift_exactly<const N: usize, const K: usize>(
        u: &[f64],
        du: &mut [f64],
        eval: impl Fn(&[Dual<f64, K>], &mut [Dual<f64, K>]),
    ) {
        let (state, vectors) = u[..N * (1 + K)].split_at(N);
        let derivative = |i: usize| std::array::from_fn(|k| vectors[k * N + i]);
        let lifted: [_; N] = std::array::from_fn(|i| Dual { value: state[i], derivative: derivative(i) });
        let mut rates = [Dual::constant_of(0.0); N];
        eval(&lifted, &mut rates);
        let (rate, vector_rates) = du[..N * (1 + K)].split_at_mut(N);
        for i in 0..N {
            rate[i] = rates[i].value;
            for k in 0..K {
                vector_rates[k * N + i] = rates[i].derivative[k];
            }
        }
    }

    #[inline(never)]
    fn lift_on_stack<const N: usize, const K: usize>(
        &self,
        u: &[f64],
        du: &mut [f64],
        eval: impl Fn(&[Dual<f64, K>], &mut [Dual<f64, K>]),
    ) {
        // two statements: a pair would be built elsewhere and copied
        let mut lifted = [Dual::constant_of(0.0); N];
        let mut rates = [Dual::constant_of(0.0); N];
        let dim = self.field.dim();
        self.lift_in(&mut lifted[..dim], &mut rates[..dim], u, du, eval);
    }

    #[inline(always)]
    fn lift_in<const K: usize>(
        &self,
        lifted: &mut [Dual<f64, K>],
        rates: &mut [Dual<f64, K>],
        u: &[f64],
        du: &mut [f64],
        eval: impl Fn(&[Dual<f64, K>], &mut [Dual<f64, K>]),
    ) {
        let dim = lifted.len();
        let (state, vectors) = u.split_at(dim);
        let (rate, vector_rates) = du.split_at_mut(dim);
        for first in (0..self.count.max(1)).step_by(K) {
            let directions = K.min(self.count - first.min(self.count));
            let of = &vectors[first * dim..][..directions * dim];
            if directions == 1 {
                for ((x, &value), &d) in lifted.iter_mut().zip(state).zip(of) {
                    let mut derivative = [0.0; K];
                    derivative[0] = d;
                    *x = Dual { value, derivative };
                }
            } else {
                for (x, &value) in lifted.iter_mut().zip(state) {
                    *x = Dual { value, derivative: [0.0; K] };
                }
                for (k, vector) in of.chunks_exact(dim.max(1)).enumerate() {
                    lifted.iter_mut().zip(vector).for_each(|(x, &d)| x.derivative[k] = d);
                }
            }
            eval(lifted, rates);
            if first == 0 {
                for (to, from) in rate.iter_mut().zip(&*rates) {
                    *to = from.value;
                }
            }
            for k in 0..directions {
                let vector_rate = &mut vector_rates[(first + k) * dim..][..dim];
                vector_rate.iter_mut().zip(&*rates).for_each(|(to, from)| *to = from.derivative[k]);
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

    fn controlling(&self) -> usize {
        if self.follow { self.field.dim() } else { self.dim() }
    }

    fn vectors(&self) -> Option<usize> {
        Some(self.field.dim())
    }

    fn kept(&self) -> u64 {
        self.field.kept()
    }
}

impl<F: Differentiable + ?Sized> VectorField<f64> for Tangent<'_, F> {
    fn eval(&self, t: f64, u: &[f64], du: &mut [f64]) {
        if self.count > 2 {
            self.lift(u, du, |lifted: &[Wide], rates: &mut [Wide]| self.field.eval(t, lifted, rates));
        } else {
            self.lift(u, du, |lifted: &[Number], rates: &mut [Number]| self.field.eval(t, lifted, rates));
        }
    }
}

impl<F: Semilinear<Number> + Differentiable + ?Sized> Semilinear<f64> for Tangent<'_, F> {
    fn linear(&self, lambda: &mut [f64]) {
        let dim = self.field.dim();
        let (first, rest) = lambda.split_at_mut(dim);
        self.field.linear(first);
        for part in rest.chunks_exact_mut(dim.max(1)) {
            part.copy_from_slice(first);
        }
    }

    fn nonlinear(&self, t: f64, u: &[f64], du: &mut [f64]) {
        self.lift(u, du, |lifted: &[Number], rates: &mut [Number]| self.field.nonlinear(t, lifted, rates));
    }
}

/// The Jacobian `Df(u)`, column by column: entry `(i, j)` is at `j * dim + i`.
pub fn jacobian<F: Differentiable + ?Sized>(field: &F, u: &[f64]) -> Vec<f64> {
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
