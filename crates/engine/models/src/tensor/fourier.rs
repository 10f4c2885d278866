//! The tensor model in Fourier amplitudes: the form used for computation.
//!
//! With `z1 = v1 - i v2`, `z2 = (S11 - i S12)/2`, `z3 = (U111 + i U222)/2` the equations (V), (S), (U) become three
//! complex ones with real coefficients. Source: paper, 'Coupled set of equations', (Z1), (Z2), (Z3) and the table of
//! coefficients after them.

use super::TensorParameters;
use motiform_dynamics::{Bundle, Complex, Scalar, Semilinear, Shape, System, VectorField};

/// The coefficients by name, once: the struct, and what goes through all of them.
macro_rules! coefficients {
    ($($name:ident),*) => {
        /// Coefficients of (Z1), (Z2), (Z3), over the real type of the scalar: numbers, or one set per lane.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[allow(missing_docs, reason = "named as in the paper")]
        pub struct Coefficients<P> {
            $(pub $name: P,)*
        }

        impl<P: Copy> Coefficients<P> {
            /// The same coefficients in another number type: `lift` turns each into one number (or one per lane).
            #[inline(always)]
            pub fn map<Q>(&self, mut lift: impl FnMut(P) -> Q) -> Coefficients<Q> {
                Coefficients { $($name: lift(self.$name),)* }
            }
        }

        impl<B: Bundle> Coefficients<B> {
            /// Puts one orbit's coefficients into its lane.
            #[inline(always)]
            pub fn set_lane(&mut self, lane: usize, one: &Coefficients<f64>) {
                $(self.$name = self.$name.with_lane(lane, one.$name);)*
            }
        }
    };
}

coefficients!(
    gamma, kappa2, kappa3, d11, d12, d13, d21, d22, d23, d31, d32, d33, e11, e12, e13, e14, e21, e22, e23,
    e31, e32, e33
);

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

/// Sets of coupling terms: a kernel omits the terms outside its set, without a second copy of the equations.
pub mod terms {
    use super::Coefficients;

    /// The terms that only some parameter sets have, one bit each, named by their coefficient.
    macro_rules! terms {
        ($($term:ident = $bit:literal, $name:ident;)*) => {
            $(#[doc = concat!("The term of ", stringify!($name), ".")] pub const $term: u32 = 1 << $bit;)*

            /// The terms whose coefficients are not zero.
            pub fn of(c: &Coefficients<f64>) -> u32 {
                let mut terms = 0;
                $(if c.$name != 0.0 { terms |= $term; })*
                terms
            }
        };
    }

    terms! {
        D12 = 0, d12; D13 = 1, d13; D21 = 2, d21; D22 = 3, d22; D23 = 4, d23;
        D31 = 5, d31; D32 = 6, d32; D33 = 7, d33;
        E11 = 8, e11; E12 = 9, e12; E13 = 10, e13; E14 = 11, e14;
        E21 = 12, e21; E22 = 13, e22; E23 = 14, e23;
        E31 = 15, e31; E32 = 16, e32; E33 = 17, e33;
    }

    /// The reduced model (paper, Simulations I): velocity and ellipse, `a1, b1, b3`.
    pub const REDUCED: u32 = E11 | E21 | D22;
    /// The full model of the paper's Simulations II: `a1, b1, b2, d1, d2`.
    pub const PAPER: u32 = E11 | E21 | E22 | E31 | E32;
    /// Both of these, for scans over the paper's planes.
    pub const COMMON: u32 = REDUCED | PAPER;
    /// All 21 parameters.
    pub const ALL: u32 = (1 << 18) - 1;

    /// The smallest of the four sets above that contains all terms of `c`.
    pub fn enclosing(c: &Coefficients<f64>) -> u32 {
        let present = of(c);
        [REDUCED, PAPER, COMMON].into_iter().find(|set| present & !set == 0).unwrap_or(ALL)
    }
}

/// The shape field: state `(Re z1, Im z1, Re z2, Im z2, Re z3, Im z3)`. Coefficients outside `TERMS` ([`terms`]) are
/// taken as zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourierField<P, const TERMS: u32 = { terms::ALL }>(pub Coefficients<P>);

impl<P> FourierField<P> {
    /// The field with all terms.
    pub fn all(coefficients: Coefficients<P>) -> Self {
        Self(coefficients)
    }
}

/// Number of real unknowns of the shape.
pub const DIM: usize = 6;

impl<P, const TERMS: u32> System for FourierField<P, TERMS> {
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
    for (n, rate) in rates.into_iter().enumerate() {
        du[2 * n] = rate.re;
        du[2 * n + 1] = rate.im;
    }
}

/// `sum`, if there is one already, plus `term`.
macro_rules! add {
    ($sum:ident, $set:ident & $term:ident, scaled $z:expr, $c:expr) => {
        if $set & terms::$term != 0 {
            $sum = Some(match $sum {
                Some(sum) => Complex::add_scaled(sum, $z, $c),
                None => Complex::scale($z, $c),
            });
        }
    };
    ($sum:ident, $set:ident & $term:ident, product $a:expr, $b:expr) => {
        if $set & terms::$term != 0 {
            $sum = Some(match $sum {
                Some(sum) => Complex::add_product(sum, $a, $b),
                None => $a * $b,
            });
        }
    };
    ($sum:ident, $set:ident & $term:ident, real $n:expr, $c:expr) => {
        if $set & terms::$term != 0 {
            $sum = Some(match $sum {
                Some(sum) => Scalar::add_scaled(sum, $n, $c),
                None => Scalar::scale($n, $c),
            });
        }
    };
}

/// `sum + z growth`, with the growth rate that the amplitudes' squares lead to (the linear rate is in it), or else the
/// linear rate alone.
#[inline(always)]
fn damped<T: Scalar>(
    sum: Option<Complex<T>>,
    z: Complex<T>,
    growth: Option<T>,
    rate: Option<T::Real>,
) -> Complex<T> {
    match (sum, growth, rate) {
        (Some(sum), Some(growth), _) => {
            Complex::new(z.re.mul_add(growth, sum.re), z.im.mul_add(growth, sum.im))
        }
        (Some(sum), None, Some(rate)) => sum.add_scaled(z, rate),
        (Some(sum), None, None) => sum,
        (None, Some(growth), _) => z * growth,
        (None, None, Some(rate)) => z.scale(rate),
        (None, None, None) => Complex::new(z.re.zero(), z.im.zero()),
    }
}

/// The linear rate as the first term of a growth rate, if one of the terms `ANY` follows.
#[inline(always)]
fn growth<T: Scalar, const ANY: u32, const TERMS: u32>(like: T, rate: Option<T::Real>) -> Option<T> {
    match rate {
        Some(rate) if TERMS & ANY != 0 => Some(like.lift(rate)),
        _ => None,
    }
}

/// The linear rate of amplitude `n`, if there are rates.
#[inline(always)]
#[allow(clippy::manual_map, reason = "a closure would not have the vector instructions")]
fn rate_of<R: Copy>(rates: Option<[R; 3]>, n: usize) -> Option<R> {
    match rates {
        Some(rates) => Some(rates[n]),
        None => None,
    }
}

/// (Z1), (Z2), (Z3), with the linear terms where `rates` has them.
///
/// No closure in here: it would be compiled without the vector instructions of the lanes that call it, each operation a call of its own,
/// and the whole field three times slower.
#[inline(always)]
#[allow(clippy::manual_map, reason = "see above")]
fn amplitude_rates<T: Scalar, const TERMS: u32>(
    c: &Coefficients<T::Real>,
    [z1, z2, z3]: [Complex<T>; 3],
    rates: Option<[T::Real; 3]>,
) -> [Complex<T>; 3] {
    let (n1, n2, n3) = (z1.norm_sqr(), z2.norm_sqr(), z3.norm_sqr());
    let (z1c, z2c, z3c) = (z1.conj(), z2.conj(), z3.conj());
    let (z1z1, z2z2) = (z1.square(), z2.square());

    let mut damping = Some(match rates {
        Some(rate) => n1.lift(rate[0]).add_scaled(n1, c.d11), // (Z1), gamma and d11
        None => n1.scale(c.d11),
    });
    add!(damping, TERMS & D12, real n2, c.d12); // (Z1), d12
    add!(damping, TERMS & D13, real n3, c.d13); // (Z1), d13
    let mut sum = None;
    add!(sum, TERMS & E11, product z1c.scale(c.e11), z2); // (Z1), e11
    add!(sum, TERMS & E12, product(z1c * z1c).scale(c.e12), z3); // (Z1), e12
    add!(sum, TERMS & E13, product z2c.scale(c.e13), z3); // (Z1), e13
    add!(sum, TERMS & E14, product z3c.scale(c.e14), z2z2); // (Z1), e14
    let dz1 = damped(sum, z1, damping, None);

    let mut damping = growth::<T, { terms::D21 | terms::D22 | terms::D23 }, TERMS>(n1, rate_of(rates, 1)); // (Z2), -kappa2
    add!(damping, TERMS & D21, real n1, c.d21); // (Z2), d21
    add!(damping, TERMS & D22, real n2, c.d22); // (Z2), d22
    add!(damping, TERMS & D23, real n3, c.d23); // (Z2), d23
    let mut sum = None;
    add!(sum, TERMS & E21, scaled z1z1, c.e21); // (Z2), e21
    add!(sum, TERMS & E22, product z1c.scale(c.e22), z3); // (Z2), e22
    add!(sum, TERMS & E23, product(z2c * z1).scale(c.e23), z3); // (Z2), e23
    let dz2 = damped(sum, z2, damping, rate_of(rates, 1)); // (Z2), -kappa2

    // z1 (e31 z1 z1 + e32 z2), (Z3)
    let mut damping = growth::<T, { terms::D31 | terms::D32 | terms::D33 }, TERMS>(n1, rate_of(rates, 2)); // (Z3), -kappa3
    add!(damping, TERMS & D31, real n1, c.d31); // (Z3), d31
    add!(damping, TERMS & D32, real n2, c.d32); // (Z3), d32
    add!(damping, TERMS & D33, real n3, c.d33); // (Z3), d33
    let mut by_z1 = None;
    add!(by_z1, TERMS & E31, scaled z1z1, c.e31); // (Z3), e31
    add!(by_z1, TERMS & E32, scaled z2, c.e32); // (Z3), e32
    let mut sum = match by_z1 {
        Some(factor) => Some(z1 * factor),
        None => None,
    };
    add!(sum, TERMS & E33, product z1c.scale(c.e33), z2z2); // (Z3), e33
    let dz3 = damped(sum, z3, damping, rate_of(rates, 2)); // (Z3), -kappa3

    [dz1, dz2, dz3]
}

impl<T: Scalar<Real = P>, P: Scalar<Real = P>, const TERMS: u32> VectorField<T> for FourierField<P, TERMS> {
    #[inline(always)]
    fn eval(&self, _t: P, u: &[T], du: &mut [T]) {
        let c = &self.0;
        let rates = [c.gamma, -c.kappa2, -c.kappa3];
        write(amplitude_rates::<T, TERMS>(c, amplitudes(u), Some(rates)), du);
    }
}

impl<T: Scalar<Real = P>, P: Scalar<Real = P>, const TERMS: u32> Semilinear<T> for FourierField<P, TERMS> {
    fn linear(&self, lambda: &mut [P]) {
        let c = &self.0;
        for (pair, rate) in lambda.chunks_exact_mut(2).zip([c.gamma, -c.kappa2, -c.kappa3]) {
            pair.fill(rate);
        }
    }

    #[inline(always)]
    fn nonlinear(&self, _t: P, u: &[T], du: &mut [T]) {
        write(amplitude_rates::<T, TERMS>(&self.0, amplitudes(u), None), du);
    }
}

impl<T: Scalar<Real = P>, P: Scalar<Real = P>, const TERMS: u32> Shape<T> for FourierField<P, TERMS> {
    /// `z1 = conj(v)`: dx/dt = Re z1, dy/dt = -Im z1.
    #[inline(always)]
    fn velocity(&self, u: &[T]) -> [T; 2] {
        [u[0], -u[1]]
    }
}
