//! The tensor model in Fourier amplitudes: the form that is computed.
//!
//! With `z1 = v1 - i v2`, `z2 = (S11 - i S12)/2`, `z3 = (U111 + i U222)/2` the equations (V), (S), (U) become three
//! complex ones with real coefficients. Source: paper, 'Coupled set of equations', (Z1), (Z2), (Z3) and the table of
//! coefficients after them.

use super::TensorParameters;
use motiform_dynamics::{Complex, Scalar, Semilinear, Shape, System, VectorField};

/// Coefficients of (Z1), (Z2), (Z3), over the real type of the scalar: numbers, or one set per lane.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "named as in the paper")]
pub struct Coefficients<P> {
    pub gamma: P,
    pub kappa2: P,
    pub kappa3: P,
    pub d11: P,
    pub d12: P,
    pub d13: P,
    pub d21: P,
    pub d22: P,
    pub d23: P,
    pub d31: P,
    pub d32: P,
    pub d33: P,
    pub e11: P,
    pub e12: P,
    pub e13: P,
    pub e14: P,
    pub e21: P,
    pub e22: P,
    pub e23: P,
    pub e31: P,
    pub e32: P,
    pub e33: P,
}

impl From<&TensorParameters> for Coefficients<f64> {
    /// The paper's table of coefficients.
    fn from(p: &TensorParameters) -> Self {
        Self {
            gamma: p.gamma,
            kappa2: p.kappa2,
            kappa3: p.kappa3,
            d11: -1.0,
            d12: -8.0 * p.a4,
            d13: -16.0 * p.a5,
            d21: -p.b4,
            d22: -8.0 * p.b3,
            d23: -16.0 * p.b5,
            d31: -p.d4,
            d32: -8.0 * p.d5,
            d33: -16.0 * p.d3,
            e11: -2.0 * p.a1,
            e12: -2.0 * p.a2,
            e13: -8.0 * p.a3,
            e14: 16.0 * p.a6,
            e21: p.b1 / 4.0,
            e22: p.b2,
            e23: 2.0 * p.b6,
            e31: p.d1 / 8.0,
            e32: p.d2 / 2.0,
            e33: 2.0 * p.d6,
        }
    }
}

impl<P: Copy> Coefficients<P> {
    /// The same coefficients in another number type: `lift` turns each into one number (or one per lane).
    pub fn map<Q>(&self, mut lift: impl FnMut(P) -> Q) -> Coefficients<Q> {
        Coefficients {
            gamma: lift(self.gamma),
            kappa2: lift(self.kappa2),
            kappa3: lift(self.kappa3),
            d11: lift(self.d11),
            d12: lift(self.d12),
            d13: lift(self.d13),
            d21: lift(self.d21),
            d22: lift(self.d22),
            d23: lift(self.d23),
            d31: lift(self.d31),
            d32: lift(self.d32),
            d33: lift(self.d33),
            e11: lift(self.e11),
            e12: lift(self.e12),
            e13: lift(self.e13),
            e14: lift(self.e14),
            e21: lift(self.e21),
            e22: lift(self.e22),
            e23: lift(self.e23),
            e31: lift(self.e31),
            e32: lift(self.e32),
            e33: lift(self.e33),
        }
    }
}

/// The shape field: state `(Re z1, Im z1, Re z2, Im z2, Re z3, Im z3)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourierField<P>(pub Coefficients<P>);

/// Number of real unknowns of the shape.
pub const DIM: usize = 6;

impl<P> System for FourierField<P> {
    fn dim(&self) -> usize {
        DIM
    }
}

/// The three amplitudes of a state.
#[inline(always)]
fn amplitudes<T: Scalar>(u: &[T]) -> [Complex<T>; 3] {
    [Complex::new(u[0], u[1]), Complex::new(u[2], u[3]), Complex::new(u[4], u[5])]
}

#[inline(always)]
fn write<T: Scalar>(rates: [Complex<T>; 3], du: &mut [T]) {
    for (pair, rate) in du.chunks_exact_mut(2).zip(rates) {
        pair[0] = rate.re;
        pair[1] = rate.im;
    }
}

/// The nonlinear terms of (Z1), (Z2), (Z3), in the paper's order.
#[inline(always)]
fn couplings<T: Scalar>(c: &Coefficients<T::Real>, [z1, z2, z3]: [Complex<T>; 3]) -> [Complex<T>; 3] {
    let (n1, n2, n3) = (z1.norm_sqr(), z2.norm_sqr(), z3.norm_sqr());
    let (z1c, z2c, z3c) = (z1.conj(), z2.conj(), z3.conj());
    let (z1z1, z2z2) = (z1 * z1, z2 * z2);

    let mut dz1 = z1 * (n1.scale(c.d11) + n2.scale(c.d12) + n3.scale(c.d13)); // (Z1), d11, d12, d13
    dz1 += (z1c * z2).scale(c.e11); // (Z1), e11
    dz1 += (z1c * z1c * z3).scale(c.e12); // (Z1), e12
    dz1 += (z2c * z3).scale(c.e13); // (Z1), e13
    dz1 += (z3c * z2z2).scale(c.e14); // (Z1), e14

    let mut dz2 = z2 * (n1.scale(c.d21) + n2.scale(c.d22) + n3.scale(c.d23)); // (Z2), d21, d22, d23
    dz2 += z1z1.scale(c.e21); // (Z2), e21
    dz2 += (z1c * z3).scale(c.e22); // (Z2), e22
    dz2 += (z2c * z3 * z1).scale(c.e23); // (Z2), e23

    let mut dz3 = z3 * (n1.scale(c.d31) + n2.scale(c.d32) + n3.scale(c.d33)); // (Z3), d31, d32, d33
    dz3 += (z1z1 * z1).scale(c.e31); // (Z3), e31
    dz3 += (z1 * z2).scale(c.e32); // (Z3), e32
    dz3 += (z1c * z2z2).scale(c.e33); // (Z3), e33

    [dz1, dz2, dz3]
}

impl<T: Scalar<Real = P>, P: Copy> VectorField<T> for FourierField<P> {
    #[inline]
    fn eval(&self, _t: P, u: &[T], du: &mut [T]) {
        let c = &self.0;
        let z = amplitudes(u);
        let [mut dz1, mut dz2, mut dz3] = couplings(c, z);
        dz1 += z[0].scale(c.gamma); // (Z1), gamma
        dz2 += -z[1].scale(c.kappa2); // (Z2), -kappa2
        dz3 += -z[2].scale(c.kappa3); // (Z3), -kappa3
        write([dz1, dz2, dz3], du);
    }
}

impl<T: Scalar<Real = P>, P: Scalar<Real = P>> Semilinear<T> for FourierField<P> {
    fn linear(&self, lambda: &mut [P]) {
        let c = &self.0;
        for (pair, rate) in lambda.chunks_exact_mut(2).zip([c.gamma, -c.kappa2, -c.kappa3]) {
            pair.fill(rate);
        }
    }

    fn nonlinear(&self, _t: P, u: &[T], du: &mut [T]) {
        write(couplings(&self.0, amplitudes(u)), du);
    }
}

impl<T: Scalar<Real = P>, P: Copy> Shape<T> for FourierField<P> {
    /// `z1 = conj(v)`: dx/dt = Re z1, dy/dt = -Im z1.
    #[inline(always)]
    fn velocity(&self, u: &[T]) -> [T; 2] {
        [u[0], -u[1]]
    }
}
