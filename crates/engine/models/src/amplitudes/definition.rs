//! Amplitude equations as they are typed.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A model of amplitude equations: everything that a user gives. [`super::Equations::new`] checks it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Definition {
    /// Angular index n of each complex amplitude `z_n`: a rotation of the plane by `angle` multiplies it by `exp(-i n angle)`.
    pub modes: Vec<u32>,
    /// The velocity `v1 + i v2` as a polynomial; by default `conj(z1)`, so that `z1 = v1 - i v2` as in the paper.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<String>,
    /// The symmetry, if it is not to be found: see [`super::Symmetry`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub symmetry: Option<String>,
    /// The parameters, in the order of the file.
    pub parameters: Vec<ParameterDefinition>,
    /// The right-hand side of `dz_n/dt`, in the order of `modes`.
    pub equations: Vec<String>,
    /// The strength of complex white noise on some amplitudes, by angular index: `dz_n = .. dt + g_n o dW_n`
    /// (Stratonovich), with independent real and imaginary parts of `W_n`, each of variance t.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty", with = "by_name")]
    pub noise: BTreeMap<u32, String>,
}

/// Amplitudes by name: numbers as keys do not survive where a plan holds a model of either kind.
mod by_name {
    use serde::de::{Deserialize, Deserializer, Error};
    use serde::{Serialize, Serializer};
    use std::collections::BTreeMap;

    pub(super) fn serialize<S: Serializer>(noise: &BTreeMap<u32, String>, to: S) -> Result<S::Ok, S::Error> {
        let named: BTreeMap<String, &String> =
            noise.iter().map(|(n, text)| (format!("z{n}"), text)).collect();
        named.serialize(to)
    }

    pub(super) fn deserialize<'d, D: Deserializer<'d>>(from: D) -> Result<BTreeMap<u32, String>, D::Error> {
        let named = BTreeMap::<String, String>::deserialize(from)?;
        let numbered = |(name, text): (String, String)| {
            let n = name.strip_prefix('z').and_then(|n| n.parse().ok());
            n.map(|n| (n, text)).ok_or_else(|| D::Error::custom(format!("{name} is no amplitude")))
        };
        named.into_iter().map(numbered).collect()
    }
}

/// A parameter of a [`Definition`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ParameterDefinition {
    /// Name in the equations.
    pub name: String,
    /// Default value.
    pub default: f64,
    /// Range of interest, for axes and sliders.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    /// Notation in figures.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub symbol: String,
    /// Its meaning.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub text: String,
}

impl ParameterDefinition {
    /// A parameter with nothing but a value.
    pub fn new(name: &str, default: f64) -> Self {
        Self { name: name.to_owned(), default, range: None, symbol: String::new(), text: String::new() }
    }
}

/// The part of a definition that an error is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// `modes`.
    Modes,
    /// `velocity`.
    Velocity,
    /// `symmetry`.
    Symmetry,
    /// The parameter of this number.
    Parameter(usize),
    /// The equation of this number.
    Equation(usize),
    /// The noise of the amplitude with this angular index.
    Noise(u32),
}

/// A definition that is no model: where, and what to write instead.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{problem}")]
pub struct DefinitionError {
    /// The part.
    pub part: Part,
    /// Bytes of its text, where it has one.
    pub span: std::ops::Range<usize>,
    /// The problem, and the remedy.
    pub problem: String,
}
