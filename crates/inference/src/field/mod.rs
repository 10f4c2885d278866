//! The vector field of a library with its first and second derivatives, over plain numbers.
//!
//! `dz_n/dt = sum_k c_k M_k(z, conj(z))`. The field is linear in the coefficients, so derivatives by them are the monomials themselves.
//! Derivatives by the amplitudes are taken by `z` and `conj(z)` as if these were independent (Wirtinger), then turned into real ones.

mod products;
mod real;

use crate::{Library, Term};
use motiform_dynamics::Complex;
use products::Products;

/// Real numbers of the shape: `(Re z1, Im z1, .., Im z3)`.
pub(crate) const SHAPE: usize = 6;

/// A coefficient: the real or the imaginary part of a term's factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    /// The term.
    pub(crate) term: usize,
    /// Whether it is the imaginary part.
    pub(crate) imaginary: bool,
}

/// The field of a library.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    products: Products,
    /// Equation of each term.
    equations: Vec<usize>,
}

/// The field at a state, with its derivatives.
#[derive(Clone, Debug)]
pub(crate) struct Values {
    /// Rates of the shape.
    pub(crate) rate: [f64; SHAPE],
    /// `jacobian[i][j]`: derivative of rate i by entry j.
    pub(crate) jacobian: [[f64; SHAPE]; SHAPE],
    /// `hessian[i][j][k]`: second derivatives of rate i.
    pub(crate) hessian: [[[f64; SHAPE]; SHAPE]; SHAPE],
    /// Each monomial.
    pub(crate) monomials: Vec<Complex<f64>>,
    /// Derivative of each monomial by each entry of the shape.
    pub(crate) gradients: Vec<[Complex<f64>; SHAPE]>,
    /// Equation of each term.
    equations: Vec<usize>,
    /// Values of the products that occur.
    scratch: Vec<Complex<f64>>,
}

impl Values {
    pub(crate) fn new(field: &Field) -> Self {
        let (zero, terms) = (Complex::new(0.0, 0.0), field.equations.len());
        Self {
            rate: [0.0; SHAPE],
            jacobian: [[0.0; SHAPE]; SHAPE],
            hessian: [[[0.0; SHAPE]; SHAPE]; SHAPE],
            monomials: vec![zero; terms],
            gradients: vec![[zero; SHAPE]; terms],
            equations: field.equations.clone(),
            scratch: vec![zero; field.products.len()],
        }
    }

    /// The equation of a term, from 0.
    #[inline(always)]
    pub(crate) fn equation(&self, term: usize) -> usize {
        self.equations[term]
    }
}

impl Field {
    pub(crate) fn new(library: &Library) -> Self {
        let products = Products::new(&library.terms);
        Self { products, equations: library.terms.iter().map(|term| term.equation).collect() }
    }

    /// The coefficients as `(term, part)`, real parts first.
    pub(crate) fn parts(terms: &[Term], handed: bool) -> Vec<Part> {
        let of = |imaginary| (0..terms.len()).map(move |term| Part { term, imaginary });
        if handed { of(false).chain(of(true)).collect() } else { of(false).collect() }
    }

    /// The rates alone.
    pub(crate) fn rate(&self, c: &[Complex<f64>], shape: &[f64; SHAPE], values: &mut Values) {
        self.products.evaluate(shape, &mut values.scratch);
        let mut rate = [Complex::new(0.0, 0.0); SHAPE / 2];
        for (term, &equation) in self.equations.iter().enumerate() {
            values.monomials[term] = self.products.value(term, &values.scratch);
            rate[equation] = rate[equation] + c[term] * values.monomials[term];
        }
        values.rate = std::array::from_fn(|i| if i % 2 == 0 { rate[i / 2].re } else { rate[i / 2].im });
    }

    /// Everything but second derivatives, which are added if `second`.
    pub(crate) fn evaluate(
        &self,
        c: &[Complex<f64>],
        shape: &[f64; SHAPE],
        second: bool,
        values: &mut Values,
    ) {
        self.rate(c, shape, values);
        let zero = Complex::new(0.0, 0.0);
        let mut first = [[zero; SHAPE]; SHAPE / 2];
        for (term, &equation) in self.equations.iter().enumerate() {
            let own = self.products.first(term, &values.scratch);
            values.gradients[term] = real::gradient(&own);
            for (sum, own) in first[equation].iter_mut().zip(own) {
                *sum = *sum + c[term] * own;
            }
        }
        for (n, first) in first.iter().enumerate() {
            for (j, by) in real::gradient(first).into_iter().enumerate() {
                values.jacobian[2 * n][j] = by.re;
                values.jacobian[2 * n + 1][j] = by.im;
            }
        }
        if second {
            self.hessian(c, values);
        }
    }

    fn hessian(&self, c: &[Complex<f64>], values: &mut Values) {
        let mut sums = [[[Complex::new(0.0, 0.0); SHAPE]; SHAPE]; SHAPE / 2];
        for (term, &equation) in self.equations.iter().enumerate() {
            for entry in self.products.second(term) {
                let by = (c[term] * values.scratch[entry.product]) * entry.factor;
                let sum = &mut sums[equation][entry.by[0]][entry.by[1]];
                *sum = *sum + by;
            }
        }
        for (n, sums) in sums.iter().enumerate() {
            let whole = real::hessian(sums);
            for j in 0..SHAPE {
                for k in 0..SHAPE {
                    values.hessian[2 * n][j][k] = whole[j][k].re;
                    values.hessian[2 * n + 1][j][k] = whole[j][k].im;
                }
            }
        }
    }
}
