//! Every model by name: what the front ends list, and how a model is made from named values.

use crate::error::{Error, nearest};
use crate::parameters::{ParameterSpec, Parameters};
use crate::tensor::{self, Tensor, TensorParameters};
use motiform_dynamics::Model;
use motiform_dynamics::model::Coordinate;

/// A model as the front ends see it.
#[derive(Debug)]
pub struct ModelInfo {
    /// Name on the command line.
    pub name: &'static str,
    /// One line that says what it is.
    pub title: &'static str,
    /// The equations, as text.
    pub equations: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// The names of its shape state.
    pub coordinates: &'static [Coordinate],
    parameters: fn() -> &'static [ParameterSpec],
    build: fn(&[f64]) -> Box<dyn Model>,
}

/// All models.
pub static MODELS: &[ModelInfo] = &[ModelInfo {
    name: "tensor",
    title: "velocity, ellipse and triangle of one domain, coupled by symmetry (6 unknowns, 21 parameters)",
    equations: TENSOR_EQUATIONS,
    source: "Hiraiwa, Ohkuma, Ohta, Matsuo, Sano, EPL (2010), eqs. (V), (S), (U)",
    coordinates: &tensor::COORDINATES,
    parameters: TensorParameters::specs,
    build: |values| {
        let mut parameters = TensorParameters::default();
        for (index, &value) in values.iter().enumerate() {
            parameters.set_at(index, value);
        }
        Box::new(Tensor::new(&parameters))
    },
}];

const TENSOR_EQUATIONS: &str = "\
(V) dv/dt = gamma v - v^2 v - a1 S v - a2 U v v - a3 U S - a4 (S:S) v - a5 (U:U) v + a6 S S U
(S) dS/dt = -kappa2 S + b1 (v v - v^2/2) + b2 U v - b3 (S:S) S - b4 v^2 S - b5 (U:U) S + b6 U S v
(U) dU/dt = -kappa3 U + d1 [v v v] + d2 [S v] - d3 (U:U) U - d4 v^2 U - d5 (S:S) U + 2 d6 [S S v]
    dx/dt = v;   [..] is the symmetric traceless part
    outline: R(theta) = R0 + S_ij n_i n_j + U_ijk n_i n_j n_k";

impl ModelInfo {
    /// The model of this name.
    ///
    /// # Errors
    /// [`Error::UnknownModel`] with the nearest name.
    pub fn find(name: &str) -> Result<&'static Self, Error> {
        let known: Vec<&'static str> = MODELS.iter().map(|model| model.name).collect();
        MODELS.iter().find(|model| model.name == name).ok_or_else(|| Error::UnknownModel {
            name: name.to_owned(),
            nearest: nearest(name, known.iter().copied()),
            known,
        })
    }

    /// Its registry of parameters.
    #[must_use]
    pub fn parameters(&self) -> &'static [ParameterSpec] {
        (self.parameters)()
    }

    /// Place of a coordinate (`x` and `y` come after the shape's own).
    ///
    /// # Errors
    /// [`Error::UnknownCoordinate`] with the nearest name.
    pub fn coordinate(&self, name: &str) -> Result<usize, Error> {
        let known: Vec<&'static str> = self.coordinates.iter().map(|c| c.name).chain(["x", "y"]).collect();
        known.iter().position(|&c| c == name).ok_or_else(|| Error::UnknownCoordinate {
            name: name.to_owned(),
            model: self.name,
            nearest: nearest(name, known.iter().copied()),
            known,
        })
    }

    /// The model with these values, in registry order.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a value the model cannot be computed with (or that is not finite).
    pub fn build(&self, values: &[f64]) -> Result<Box<dyn Model>, Error> {
        for (spec, &value) in self.parameters().iter().zip(values) {
            let (min, max) = spec.allowed;
            if !(min..=max).contains(&value) {
                return Err(Error::OutOfRange { name: spec.name.to_owned(), value, min, max });
            }
        }
        Ok((self.build)(values))
    }
}
