//! Models whose equations are data: polynomials in complex amplitudes, given as text.
//!
//! `dz_n/dt = P_n(z, conj(z))` for a few angular indices n, with coefficients that are expressions of named parameters; the velocity is
//! `v1 + i v2 = conj(z1)` unless it is given. The state is `(Re z_n, Im z_n)` in the order of the modes. The tensor model is the special
//! case of modes 1, 2, 3 (paper, eqs. (Z1), (Z2), (Z3)).

mod built_in;
mod coefficient;
mod definition;
mod equations;
mod evaluation;
mod formula;
mod lanes;
mod names;
mod noise;
mod paper;
mod parser;
mod polynomial;
mod program;
mod real_parts;
mod reserved;
mod tensor_form;
mod tokens;

pub(crate) use built_in::of_tensor;
pub use built_in::{of_model, tensor as tensor_as_text};
pub use definition::{Definition, DefinitionError, ParameterDefinition, Part};
pub use equations::{Equations, check_modes};
pub use formula::Formula;
pub use lanes::AmplitudesField;
pub(crate) use names::{Known, look};
pub use names::{NAME, info, terms};
pub use parser::RESERVED;
pub use polynomial::{MOST_MODES, MOST_ORDER, Monomial};
pub use reserved::meaning as reserved;
pub use tensor_form::{TensorForm, tensor_form, tensor_parameter};

use crate::polar::{self, Mode};
use coefficient::Value;
use motiform_dynamics::model::{Coordinate, Observable};
use motiform_dynamics::{
    Equivariant, Model, ModelNoise, Outline, Scalar, Semilinear, Shape, Symmetry, System, VectorField,
};

/// Amplitude equations for one set of parameters.
#[derive(Clone, Debug)]
pub struct Amplitudes {
    known: &'static Known,
    /// Coefficients of the rates.
    rates: Box<[Value]>,
    /// The same without the real linear rates.
    nonlinear: Box<[Value]>,
    /// The real linear rate of each unknown (inverse model time).
    linear: Box<[f64]>,
    /// Coefficients of the velocity.
    velocity: Box<[Value]>,
    /// Coefficients of the noise.
    noise: Box<[Value]>,
}

impl Amplitudes {
    fn new(known: &'static Known, parameters: &[f64]) -> Self {
        let equations = &known.equations;
        let values = equations.tape.evaluate(parameters);
        let rates = equations.program.coefficients(&values);
        let mut nonlinear = rates.clone();
        let mut linear = Vec::new();
        for n in 0..equations.definition().modes.len() {
            linear.extend(equations.program.take_linear(n, &mut nonlinear));
        }
        let linear = linear.into();
        let velocity = equations.velocity_program.coefficients(&values);
        let noise = equations.noise.program.coefficients(&values);
        Self { known, rates, nonlinear, linear, velocity, noise }
    }

    /// The equations that were read.
    pub fn equations(&self) -> &'static Equations {
        &self.known.equations
    }

    fn modes(&self) -> &'static [u32] {
        &self.known.equations.definition().modes
    }

    /// The amplitudes that deform the outline, in the convention `R = R0 + sum 2 Re(z_n e^{i n theta})`.
    fn outline_modes<'s>(&self, shape: &'s [f64]) -> impl Iterator<Item = Mode> + Clone + use<'s> {
        let sign = if self.known.equations.sense > 0 { -1.0 } else { 1.0 };
        let modes = self.modes().iter().zip(shape.chunks_exact(2));
        modes.filter(|(n, _)| **n > 1).map(move |(&n, z)| (n, [z[0], sign * z[1]]))
    }
}

impl System for Amplitudes {
    fn dim(&self) -> usize {
        2 * self.modes().len()
    }

    fn kept(&self) -> u64 {
        self.known.equations.kept
    }
}

impl<T: Scalar<Real = f64>> VectorField<T> for Amplitudes {
    #[inline]
    fn eval(&self, _t: f64, u: &[T], du: &mut [T]) {
        self.known.equations.program.eval(&self.rates, u, du);
    }
}

impl<T: Scalar<Real = f64>> Semilinear<T> for Amplitudes {
    fn linear(&self, lambda: &mut [f64]) {
        lambda.copy_from_slice(&self.linear);
    }

    #[inline]
    fn nonlinear(&self, _t: f64, u: &[T], du: &mut [T]) {
        self.known.equations.program.eval(&self.nonlinear, u, du);
    }
}

impl<T: Scalar<Real = f64>> Shape<T> for Amplitudes {
    #[inline]
    fn velocity(&self, shape: &[T]) -> [T; 2] {
        self.known.velocity(&self.velocity, shape)
    }
}

impl Equivariant for Amplitudes {
    fn symmetry(&self) -> Symmetry {
        self.known.equations.symmetry
    }

    /// Every term has an index that differs from that of its equation by an even number.
    fn half_turn(&self) -> bool {
        self.known.equations.half_turn
    }

    /// `z_n -> exp(-i n angle) z_n`, or with a plus for a velocity like `z1`.
    fn rotate(&self, angle: f64, shape: &mut [f64]) {
        if !self.symmetry().rotations {
            return;
        }
        let sense = f64::from(self.known.equations.sense);
        for (z, &n) in shape.chunks_exact_mut(2).zip(self.modes()) {
            let (sin, cos) = libm::sincos(sense * f64::from(n) * angle);
            (z[0], z[1]) = (cos * z[0] - sin * z[1], cos * z[1] + sin * z[0]);
        }
    }

    fn spin(&self, shape: &[f64], out: &mut [f64]) {
        self.known.spin(shape, out);
    }

    /// `z_n -> conj(z_n)`.
    fn mirror(&self, shape: &mut [f64]) {
        if self.symmetry().mirror {
            shape.chunks_exact_mut(2).for_each(|z| z[1] = -z[1]);
        }
    }

    fn highest_mode(&self) -> usize {
        self.modes().iter().copied().max().unwrap_or(0) as usize
    }

    /// The residue of a velocity that vanishes by cancellation: from rounding (1e-13) and from amplitudes
    /// known to `atol`.
    fn speed_resolution(&self, shape: &[f64], atol: f64) -> f64 {
        if self.known.equations.velocity_mode.is_some() {
            return 0.0;
        }
        let size = shape.iter().map(|x| x * x).sum::<f64>().sqrt();
        let order = f64::from(self.known.velocity_order);
        let whole: f64 = self.velocity.iter().map(|[re, im]| libm::hypot(*re, *im)).sum();
        let relative = if size > 0.0 { 1e-13 + order * atol / size } else { 0.0 };
        relative * whole * libm::pow(size, order)
    }
}

impl Model for Amplitudes {
    fn as_any(&self) -> Option<&dyn std::any::Any> {
        Some(self)
    }

    fn coordinates(&self) -> &[Coordinate] {
        &self.known.coordinates
    }

    /// That of the table `noise`.
    fn noise(&self) -> ModelNoise {
        self.known.equations.noise.of_model(&self.noise, self.dim())
    }

    /// `v1, v2` where the velocity is `conj(z1)` or `z1`, otherwise real and imaginary parts.
    fn encode(&self, coordinates: &[f64], shape: &mut [f64]) {
        for (place, &from) in self.known.order.iter().enumerate() {
            shape[from] = self.known.signs[place] * coordinates[place];
        }
    }

    fn decode(&self, shape: &[f64], coordinates: &mut [f64]) {
        for (place, &from) in self.known.order.iter().enumerate() {
            coordinates[place] = self.known.signs[place] * shape[from];
        }
    }

    fn velocities(&self) -> usize {
        if self.known.equations.velocity_mode.is_some() { 2 } else { 0 }
    }

    fn observables(&self) -> &[Observable] {
        &self.known.observables
    }

    /// `|z_n|` of every amplitude that is not the velocity.
    fn observe(&self, shape: &[f64], out: &mut [f64]) {
        for (place, out) in self.known.observed.iter().zip(out) {
            *out = libm::hypot(shape[2 * place], shape[2 * place + 1]);
        }
    }

    fn outline(&self, shape: &[f64], radius: f64, points: usize) -> Outline {
        polar::outline(&self.outline_modes(shape), radius, points)
    }

    fn deformation(&self, shape: &[f64]) -> f64 {
        polar::deformation(self.outline_modes(shape))
    }
}
