//! The tensor model: velocity v, elliptic deformation S and three-fold deformation U of one domain, with couplings determined by symmetry.
//!
//! Source: paper, eqs. (V), (S), (U); Ohta and Ohkuma (2009), Phys. Rev. Lett. 102, 154101.

pub mod fourier;
pub mod indices;
mod lanes;
pub mod outline;
mod parameters;
pub mod reduced;

pub use fourier::{Coefficients, FourierField};
pub use parameters::TensorParameters;

use crate::amplitudes::{self, Amplitudes};
use fourier::DIM;
use motiform_dynamics::equivariant::overlaps_by_rotation;
use motiform_dynamics::model::{Coordinate, Observable};
use motiform_dynamics::{
    Dual, Equivariant, Model, Outline, Scalar, Semilinear, Shape, Symmetry, System, VectorField,
};
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// Angles by which shapes are turned when they are aligned.
const GRID: usize = 32;

/// The tensor model for one set of parameters.
///
/// ```
/// use motiform_dynamics::{InPlane, Integration, Orbit, Request, StepControl, drive::drive, steppers::DOP853};
/// use motiform_models::tensor::{Tensor, TensorParameters};
///
/// // A circle with gamma = 1 accelerates to speed 1 and swims straight.
/// let body = InPlane(Tensor::new(&TensorParameters::default()));
/// let control = StepControl::Adaptive { rtol: 1e-10, atol: 1e-12 };
/// let start = [0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]; // z1, z2, z3, x, y
/// let mut orbit = Orbit::new(&body, &DOP853, control, 0.0, &start)?;
/// drive(&mut orbit, &Request::until(20.0, 8), &mut ())?;
/// assert!((orbit.state()[0] - 1.0).abs() < 1e-9);
/// # Ok::<(), motiform_dynamics::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Tensor {
    field: FourierField<f64>,
    terms: Terms,
}

/// The terms by which the rates are computed: the smallest set that the parameters need.
#[derive(Clone, Debug)]
enum Terms {
    /// [`fourier::terms::REDUCED`]
    Reduced,
    /// [`fourier::terms::PAPER`]
    Paper,
    /// [`fourier::terms::COMMON`]
    Common,
    /// All terms, as a list of products.
    Listed(Amplitudes),
}

/// Calls a method of the field with the terms that the parameters need and no others.
macro_rules! with_terms {
    ($model:expr, $field:ident => $call:expr) => {
        match &$model.terms {
            Terms::Reduced => {
                let $field = &FourierField::<f64, { fourier::terms::REDUCED }>($model.field.0);
                $call
            }
            Terms::Paper => {
                let $field = &FourierField::<f64, { fourier::terms::PAPER }>($model.field.0);
                $call
            }
            Terms::Common => {
                let $field = &FourierField::<f64, { fourier::terms::COMMON }>($model.field.0);
                $call
            }
            Terms::Listed($field) => $call,
        }
    };
}

impl Tensor {
    /// The model with these parameters.
    pub fn new(parameters: &TensorParameters) -> Self {
        let coefficients = Coefficients::from(parameters);
        let terms = match fourier::terms::enclosing(&coefficients) {
            fourier::terms::REDUCED => Terms::Reduced,
            fourier::terms::PAPER => Terms::Paper,
            fourier::terms::COMMON => Terms::Common,
            _ => Terms::Listed(amplitudes::of_tensor(parameters)),
        };
        Self { field: FourierField(coefficients), terms }
    }

    /// The shape field, for kernels over other scalars.
    pub fn field(&self) -> &FourierField<f64> {
        &self.field
    }

    /// The list of products that its rates are computed by, if it has terms that the paper's planes do not have.
    pub fn listed(&self) -> Option<&Amplitudes> {
        match &self.terms {
            Terms::Listed(list) => Some(list),
            _ => None,
        }
    }
}

/// The names of the state, in file order.
pub const COORDINATES: [Coordinate; 6] = [
    Coordinate { name: "v1", meaning: "velocity along x" },
    Coordinate { name: "v2", meaning: "velocity along y" },
    Coordinate { name: "s11", meaning: "elliptic deformation along x (S11 = -S22)" },
    Coordinate { name: "s12", meaning: "elliptic deformation along the diagonal (S12 = S21)" },
    Coordinate { name: "u111", meaning: "three-fold deformation with a corner along x (U111)" },
    Coordinate { name: "u222", meaning: "three-fold deformation with a corner along y (U222)" },
];

const OBSERVABLES: [Observable; 2] = [
    Observable {
        name: "s_norm",
        symbol: "|*S*|",
        meaning: "size of the elliptic deformation, sqrt(S_ij S_ij)",
        length: 1,
    },
    Observable {
        name: "u_norm",
        symbol: "|*U*|",
        meaning: "size of the three-fold deformation, sqrt(U_ijk U_ijk)",
        length: 1,
    },
];

impl System for Tensor {
    fn dim(&self) -> usize {
        DIM
    }
}

impl<T: Scalar<Real = f64>> VectorField<T> for Tensor {
    #[inline]
    fn eval(&self, t: f64, u: &[T], du: &mut [T]) {
        with_terms!(self, field => field.eval(t, u, du));
    }
}

impl<T: Scalar<Real = f64>> Semilinear<T> for Tensor {
    fn linear(&self, lambda: &mut [f64]) {
        Semilinear::<T>::linear(&self.field, lambda);
    }

    #[inline]
    fn nonlinear(&self, t: f64, u: &[T], du: &mut [T]) {
        with_terms!(self, field => field.nonlinear(t, u, du));
    }
}

impl<T: Scalar<Real = f64>> Shape<T> for Tensor {
    #[inline]
    fn velocity(&self, shape: &[T]) -> [T; 2] {
        self.field.velocity(shape)
    }
}

/// `-i n z_n`.
#[inline(always)]
fn spin<T: Scalar>(shape: &[T], out: &mut [T]) {
    for mode in 0..DIM / 2 {
        let n = (mode + 1) as f64;
        out[2 * mode] = shape[2 * mode + 1] * n;
        out[2 * mode + 1] = shape[2 * mode] * -n;
    }
}

impl Equivariant for Tensor {
    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }

    /// `z_n -> exp(-i n angle) z_n`.
    fn rotate(&self, angle: f64, shape: &mut [f64]) {
        for (z, n) in shape.chunks_exact_mut(2).zip(1..) {
            let (sin, cos) = libm::sincos(f64::from(n) * angle);
            (z[0], z[1]) = (cos * z[0] + sin * z[1], cos * z[1] - sin * z[0]);
        }
    }

    /// With sines and cosines computed once: an alignment of two shapes asks for the same angles every time.
    fn overlaps(&self, reference: &[f64], shape: &[f64], out: &mut [f64]) {
        static TURNS: OnceLock<Vec<[(f64, f64); DIM / 2]>> = OnceLock::new();
        let cell = TAU / GRID as f64;
        let turn = |point: usize| [1, 2, 3].map(|n| libm::sincos(f64::from(n) * (cell * point as f64)));
        let turns = TURNS.get_or_init(|| (0..GRID).map(turn).collect());
        let (Some(shape), true) = (shape.first_chunk::<DIM>(), out.len() == GRID) else {
            return overlaps_by_rotation(self, reference, shape, out);
        };
        for (overlap, turn) in out.iter_mut().zip(turns) {
            let mut turned = *shape;
            for (z, (sin, cos)) in turned.chunks_exact_mut(2).zip(turn) {
                (z[0], z[1]) = (cos * z[0] + sin * z[1], cos * z[1] - sin * z[0]);
            }
            *overlap = reference.iter().zip(&turned).map(|(a, b)| a * b).sum();
        }
    }

    /// `z_n -> conj(z_n)`.
    fn mirror(&self, shape: &mut [f64]) {
        for z in shape.chunks_exact_mut(2) {
            z[1] = -z[1];
        }
    }

    /// `-i n z_n`.
    fn spin(&self, shape: &[f64], out: &mut [f64]) {
        spin(shape, out);
    }
}

impl Model for Tensor {
    fn as_any(&self) -> Option<&dyn std::any::Any> {
        Some(self)
    }

    fn coordinates(&self) -> &[Coordinate] {
        &COORDINATES
    }

    /// `z1 = v1 - i v2`, `z2 = (S11 - i S12)/2`, `z3 = (U111 + i U222)/2`.
    fn encode(&self, c: &[f64], shape: &mut [f64]) {
        shape.copy_from_slice(&[c[0], -c[1], 0.5 * c[2], -0.5 * c[3], 0.5 * c[4], 0.5 * c[5]]);
    }

    fn decode(&self, z: &[f64], c: &mut [f64]) {
        c.copy_from_slice(&[z[0], -z[1], 2.0 * z[2], -2.0 * z[3], 2.0 * z[4], 2.0 * z[5]]);
    }

    /// v1 and v2.
    fn velocities(&self) -> usize {
        2
    }

    fn observables(&self) -> &[Observable] {
        &OBSERVABLES
    }

    /// `|S| = sqrt(8) |z2|`, `|U| = 4 |z3|`.
    fn observe(&self, z: &[f64], out: &mut [f64]) {
        out[0] = 8.0_f64.sqrt() * libm::hypot(z[2], z[3]);
        out[1] = 4.0 * libm::hypot(z[4], z[5]);
    }

    fn outline(&self, shape: &[f64], radius: f64, points: usize) -> Outline {
        outline::outline(shape, radius, points)
    }

    fn deformation(&self, shape: &[f64]) -> f64 {
        outline::deformation(shape)
    }
}

/// The field works over lanes and duals; this line fails to compile if it does not.
const _: fn() = || {
    fn takes<T: Scalar, F: VectorField<T>>() {}
    takes::<Dual<f64, 6>, Tensor>();
    takes::<motiform_dynamics::Lanes<8>, FourierField<motiform_dynamics::Lanes<8>>>();
    takes::<Dual<motiform_dynamics::Lanes<8>, 6>, FourierField<motiform_dynamics::Lanes<8>>>();
};
