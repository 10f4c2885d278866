//! The vector field of a library with its first and second derivatives, over plain numbers.
//!
//! `dz_n/dt = sum_k c_k M_k(z, conj(z))`. The field is linear in the coefficients, so derivatives by them are the monomials themselves.
//! Derivatives by the amplitudes are taken by `z` and `conj(z)` as if these were independent (Wirtinger):
//! `d/dRe = d/dz + d/dz*`,  `d/dIm = i (d/dz - d/dz*)`.

mod products;

use crate::{Library, Term};
use motiform_dynamics::Complex;
use products::Products;

const ZERO: Complex<f64> = Complex { re: 0.0, im: 0.0 };

/// A coefficient: the real or the imaginary part of a term's factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    /// The term.
    pub(crate) term: usize,
    /// `true` if it is the imaginary part.
    pub(crate) imaginary: bool,
}

/// The field of a library.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    products: Products,
    /// Equation of each term.
    equations: Vec<usize>,
}

/// The field at a state `(Re z1, Im z1, ..)` of `SHAPE` real numbers, with its derivatives.
#[derive(Clone, Debug)]
pub(crate) struct Values<const SHAPE: usize> {
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
    /// Values of the products that occur.
    scratch: Vec<Complex<f64>>,
}

impl<const SHAPE: usize> Values<SHAPE> {
    pub(crate) fn new(field: &Field) -> Self {
        let terms = field.equations.len();
        Self {
            rate: [0.0; SHAPE],
            jacobian: [[0.0; SHAPE]; SHAPE],
            hessian: [[[0.0; SHAPE]; SHAPE]; SHAPE],
            monomials: vec![ZERO; terms],
            gradients: vec![[ZERO; SHAPE]; terms],
            scratch: vec![ZERO; field.products.steps.len()],
        }
    }
}

#[inline(always)]
fn times_i(z: Complex<f64>) -> Complex<f64> {
    Complex::new(-z.im, z.re)
}

#[inline(always)]
fn minus(a: Complex<f64>, b: Complex<f64>) -> Complex<f64> {
    Complex::new(a.re - b.re, a.im - b.im)
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

    /// The equation of a term, from 0.
    #[inline(always)]
    pub(crate) fn equation(&self, term: usize) -> usize {
        self.equations[term]
    }

    /// The rates alone.
    #[inline(always)]
    pub(crate) fn rate<const SHAPE: usize>(
        &self,
        c: &[Complex<f64>],
        shape: &[f64; SHAPE],
        values: &mut Values<SHAPE>,
    ) {
        self.products.evaluate(shape, &mut values.scratch);
        values.rate = [0.0; SHAPE];
        for (term, &equation) in self.equations.iter().enumerate() {
            let monomial = values.scratch[self.products.terms[term]];
            values.monomials[term] = monomial;
            let rate = c[term] * monomial;
            values.rate[2 * equation] += rate.re;
            values.rate[2 * equation + 1] += rate.im;
        }
    }

    /// Rates and first derivatives; second ones if `second`.
    #[inline(always)]
    pub(crate) fn evaluate<const SHAPE: usize>(
        &self,
        c: &[Complex<f64>],
        shape: &[f64; SHAPE],
        second: bool,
        values: &mut Values<SHAPE>,
    ) {
        self.rate(c, shape, values);
        values.jacobian = [[0.0; SHAPE]; SHAPE];
        for first in &self.products.first {
            let by = values.scratch[first.z.1] * first.z.0;
            let by_conj = values.scratch[first.conj.1] * first.conj.0;
            let columns = [by + by_conj, times_i(minus(by, by_conj))];
            for (half, column) in columns.into_iter().enumerate() {
                let (j, row) = (2 * first.amplitude + half, 2 * first.equation);
                values.gradients[first.term][j] = column;
                let rate = c[first.term] * column;
                values.jacobian[row][j] += rate.re;
                values.jacobian[row + 1][j] += rate.im;
            }
        }
        if second {
            self.hessian(c, values);
        }
    }

    #[inline(always)]
    fn hessian<const SHAPE: usize>(&self, c: &[Complex<f64>], values: &mut Values<SHAPE>) {
        let mut sums = [[[ZERO; SHAPE]; SHAPE]; SHAPE]; // the first half is used: SHAPE / 2 is no length of an array yet
        for entry in &self.products.second {
            let by = (c[entry.term] * values.scratch[entry.product]) * entry.factor;
            let sum = &mut sums[entry.equation][entry.by[0]][entry.by[1]];
            *sum += by;
        }
        for n in 0..SHAPE / 2 {
            let of = &sums[n];
            for a in 0..SHAPE / 2 {
                for b in a..SHAPE / 2 {
                    let (zz, zc) = (of[2 * a][2 * b], of[2 * a][2 * b + 1]);
                    let cz = if a == b { zc } else { of[2 * a + 1][2 * b] };
                    let cc = of[2 * a + 1][2 * b + 1];
                    let block = [
                        [(zz + zc) + (cz + cc), times_i(minus(zz + cz, zc + cc))],
                        [times_i(minus(zz + zc, cz + cc)), minus(zc + cz, zz + cc)],
                    ];
                    for i in 0..2 {
                        for j in 0..2 {
                            let (row, column, z) = (2 * a + i, 2 * b + j, block[i][j]);
                            values.hessian[2 * n][row][column] = z.re;
                            values.hessian[2 * n][column][row] = z.re;
                            values.hessian[2 * n + 1][row][column] = z.im;
                            values.hessian[2 * n + 1][column][row] = z.im;
                        }
                    }
                }
            }
        }
    }
}
