//! All models by name, for the front ends, and construction of a model from named values.

use crate::amplitudes::{self, Definition, Known};
use crate::cell::{Cell, CellParameters};
use crate::error::{Error, nearest};
use crate::own::{self, Own};
use crate::parameters::{ParameterSpec, Parameters};
use crate::tensor::{self, Tensor, TensorParameters};
use motiform_dynamics::Model;
use motiform_dynamics::model::Coordinate;

/// A model as presented to the front ends.
#[derive(Debug)]
pub struct ModelInfo {
    /// Name on the command line.
    pub name: &'static str,
    /// One-line description.
    pub title: &'static str,
    /// The equations, as text.
    pub equations: &'static str,
    /// Its source.
    pub source: &'static str,
    /// The stepper to use by default.
    pub stepper: &'static str,
    /// The relative tolerance to use by default.
    pub rtol: f64,
    /// Ratio of relative to absolute tolerance, if only the former is given: the inverse of the size below
    /// which an entry of the state counts as small.
    pub tolerance_ratio: f64,
    /// The length of a look at the default parameters, the unit in which times of observation are given: some tens of the model's slowest
    /// ordinary time scale (model time). The first look at a motion is as long as this; see [`ModelInfo::look_at`].
    pub look: f64,
    /// Default maximum model time for classifying a motion.
    pub budget: f64,
    /// Typical size of its shapes: the norm of their coordinates on the paper's motions, to one digit.
    pub size: f64,
    /// The initial display of its bodies.
    pub display: Display,
    /// Size of coordinates in random shapes, by their index.
    pub weight: fn(usize) -> f64,
    /// The parameter that says how finely the body is resolved, if there is one.
    pub resolution: Option<&'static str>,
    pub(crate) inner: Source,
}

/// The origin of a model's names and of its construction.
#[derive(Debug)]
pub(crate) enum Source {
    /// From code.
    BuiltIn {
        /// Its registry of parameters.
        parameters: fn() -> &'static [ParameterSpec],
        /// The names of its state, for parameters with these values.
        coordinates: fn(&[f64]) -> &'static [Coordinate],
        /// The model.
        build: Build,
    },
    /// From equations given as text.
    Amplitudes(&'static Known),
    /// From code of others.
    Own(&'static Own),
}

/// The initial display of the bodies of a model, unless a preset specifies another.
#[derive(Clone, Copy, Debug)]
pub struct Display {
    /// Model time between samples.
    pub sample: f64,
    /// Model time per second.
    pub speed: f64,
    /// Sides of the map, one or two: parameter, lowest and highest value.
    pub plane: &'static [(&'static str, f64, f64)],
}

/// Makes a model from parameter values in registry order.
type Build = fn(&[f64]) -> Result<Box<dyn Model>, Error>;

/// All models.
pub static MODELS: &[ModelInfo] = &[
    ModelInfo {
        name: "tensor",
        title: "velocity, ellipse and triangle of one domain, coupled by symmetry (6 unknowns, 21 parameters)",
        equations: TENSOR_EQUATIONS,
        source: "Hiraiwa, Ohkuma, Ohta, Matsuo, Sano, EPL (2010), eqs. (V), (S), (U)",
        stepper: "dop853",
        rtol: 1e-9,
        tolerance_ratio: 1e3,
        look: 200.0,
        budget: 4e4,
        size: 1.0,
        display: Display {
            sample: 0.05,
            speed: 8.0,
            plane: &[("kappa2", 0.05, 1.65), ("kappa3", 0.05, 1.05)],
        },
        weight: |_| 1.0,
        resolution: None,
        inner: Source::BuiltIn {
            parameters: TensorParameters::specs,
            coordinates: |_| &tensor::COORDINATES,
            build: |values| Ok(Box::new(Tensor::new(&from_values::<TensorParameters>(values)))),
        },
    },
    ModelInfo {
        name: "cell",
        title: "active cell: a closed boundary that deforms by itself and moves by its deformation",
        equations: CELL_EQUATIONS,
        source: "Hiraiwa, Ohkuma, Ohta, Matsuo, Sano, EPL (2010), eqs. (C), (VEL), (CLOSE)",
        stepper: "krogstad4",
        rtol: 1e-6,
        tolerance_ratio: 10.0, // high modes are tiny: their digits do not matter
        look: 1500.0,
        budget: 1e5,
        size: 4.0,
        display: Display { sample: 0.5, speed: 80.0, plane: &[("length", 6.0, 32.0)] },
        weight: |place| 1.0 / ((place / 2 + 1) * (place / 2 + 1)) as f64, // mode n: as smooth as a boundary whose slope jumps
        resolution: Some("modes"),
        inner: Source::BuiltIn {
            parameters: CellParameters::specs,
            coordinates: |values| from_values::<CellParameters>(values).coordinates(),
            build: |values| Ok(Box::new(Cell::new(&from_values::<CellParameters>(values))?)),
        },
    },
];

/// The parameters with these values, in registry order; omitted ones have their defaults.
pub(crate) fn from_values<P: Parameters>(values: &[f64]) -> P {
    let mut parameters = P::default();
    for (index, &value) in values.iter().enumerate() {
        parameters.set_at(index, value);
    }
    parameters
}

const CELL_EQUATIONS: &str = "\
(C)     phi_t = g1 phi_ss + g2 phi_ssss + g3 phi_ssssss + g4 phi_s phi_ss + g5 phi_ss phi_sss
        on 0 <= s < length, Fourier components 1 .. modes; normal angle (2 pi / length) (s + phi)
(VEL)   v = ((2 pi)^2 / length^3) int (alpha2 phi_s^2 + A phi_ss^2) n ds,   A = alpha3 + alpha3_per_length length
(CLOSE) int n ds = 0, by the most likely error function: components n = 1 .. closure_modes, widths n^-prior
        feedback = 1 adds it to phi after every step
        dx/dt = v";

const TENSOR_EQUATIONS: &str = "\
(V) dv_i/dt = gamma v_i - v^2 v_i - a1 S_ij v_j - a2 U_ijk v_j v_k - a3 U_ijk S_jk - a4 S^2 v_i - a5 U^2 v_i + a6 S_ij S_kl U_jkl
(S) dS_ij/dt = -kappa2 S_ij + b1 (v_i v_j - v^2 delta_ij/2) + b2 U_ijk v_k - b3 S^2 S_ij - b4 v^2 S_ij - b5 U^2 S_ij + b6 U_ijk S_kl v_l
(U) dU_ijk/dt = -kappa3 U_ijk + d1 [v_i v_j v_k] + d2 [S_ij v_k] - d3 U^2 U_ijk - d4 v^2 U_ijk - d5 S^2 U_ijk + 2 d6 [S_ij S_kl v_l]
    dx_i/dt = v_i;   v^2 = v_i v_i,   S^2 = S_ij S_ij,   U^2 = U_ijk U_ijk
    [..] is the part that is symmetric and traceless in i, j, k; sums over repeated indices
    outline: R(theta) = R0 + S_ij n_i n_j + U_ijk n_i n_j n_k";

impl ModelInfo {
    /// The model of this name.
    ///
    /// # Errors
    /// [`Error::UnknownModel`] with the nearest name.
    pub fn find(name: &str) -> Result<&'static Self, Error> {
        if name == amplitudes::NAME {
            return Err(Error::NoEquations);
        }
        let built_in = MODELS.iter().find(|model| model.name == name);
        built_in.or_else(|| own::find(name)).ok_or_else(|| {
            let known: Vec<&'static str> = Self::all().map(|model| model.name).collect();
            Error::UnknownModel {
                name: name.to_owned(),
                nearest: nearest(name, known.iter().copied()),
                known,
            }
        })
    }

    /// The look of a body with these parameters, in registry order: that of equations given as text follows their rates.
    pub fn look_at(&self, values: &[f64]) -> f64 {
        match self.inner {
            Source::Amplitudes(known) => amplitudes::look(known, values),
            Source::BuiltIn { .. } | Source::Own(_) => self.look,
        }
    }

    /// Default maximum model time for classifying the motion of a body with these parameters.
    pub fn budget_at(&self, values: &[f64]) -> f64 {
        self.budget / self.look * self.look_at(values)
    }

    /// The models that are built in, then those of one's own ([`register`](crate::register)).
    pub fn all() -> impl Iterator<Item = &'static Self> {
        MODELS.iter().chain(own::all())
    }

    /// The absolute tolerance for a relative one, if none is given: `rtol / tolerance_ratio`. Thus `rtol` alone sets the accuracy
    /// of a run.
    ///
    /// # Checked by  lab/lab/tests/all/tolerances.rs: the global error against the request, for both models
    pub fn absolute_tolerance(&self, rtol: f64) -> f64 {
        rtol / self.tolerance_ratio
    }

    /// Its registry of parameters.
    pub fn parameters(&self) -> &'static [ParameterSpec] {
        match self.inner {
            Source::BuiltIn { parameters, .. } => parameters(),
            Source::Amplitudes(known) => known.parameters(),
            Source::Own(own) => own.parameters,
        }
    }

    /// The names of its shape state, for parameters with these values (in registry order; the number of modes is one).
    pub fn coordinates(&self, values: &[f64]) -> &'static [Coordinate] {
        match self.inner {
            Source::BuiltIn { coordinates, .. } => coordinates(values),
            Source::Amplitudes(known) => known.coordinates(),
            Source::Own(own) => &own.coordinates,
        }
    }

    /// Place of a coordinate (`x` and `y` come after the shape's own), for parameters with these values.
    ///
    /// # Errors
    /// [`Error::UnknownCoordinate`] with the nearest name.
    pub fn coordinate(&self, values: &[f64], name: &str) -> Result<usize, Error> {
        let names = self.coordinates(values).iter().map(|c| c.name);
        let known: Vec<&'static str> = names.chain(["x", "y"]).collect();
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
    /// [`Error::ValueCount`]; [`Error::OutOfRange`] for a value the model cannot be computed with (or that is not finite), and what the
    /// model itself rejects.
    pub fn build(&self, values: &[f64]) -> Result<Box<dyn Model>, Error> {
        let (model, expected, got) = (self.name, self.parameters().len(), values.len());
        if got != expected {
            return Err(Error::ValueCount { model, expected, got });
        }
        for (spec, &value) in self.parameters().iter().zip(values) {
            let (min, max) = spec.allowed;
            if !(min..=max).contains(&value) {
                return Err(Error::OutOfRange { name: spec.name.to_owned(), value, min, max });
            }
        }
        match self.inner {
            Source::BuiltIn { build, .. } => build(values),
            Source::Amplitudes(known) => known.build(values),
            Source::Own(own) => own.build(values),
        }
    }

    /// `true` for the models of this library.
    pub fn is_built_in(&self) -> bool {
        matches!(self.inner, Source::BuiltIn { .. })
    }

    /// The equations, if they were given as text.
    pub fn definition(&self) -> Option<&'static Definition> {
        match self.inner {
            Source::BuiltIn { .. } | Source::Own(_) => None,
            Source::Amplitudes(known) => Some(known.definition()),
        }
    }

    /// Digits that change with the equations of a model of one's own; `None` for others, whose equations have the version of this library.
    pub fn field(&self) -> Option<&'static str> {
        match self.inner {
            Source::Own(own) => Some(&own.field),
            Source::BuiltIn { .. } | Source::Amplitudes(_) => None,
        }
    }
}
