//! The tensor model as equations given as text: (Z1), (Z2), (Z3) with the paper's table of coefficients.

use super::{Amplitudes, Definition, Equations, Known, ParameterDefinition};
use crate::Parameters;
use crate::registry::ModelInfo;
use crate::tensor::TensorParameters;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// A parameter, and the term that it multiplies.
type Term = (&'static str, &'static str);

const Z1: &[Term] = &[
    ("gamma", "gamma*z1"),
    ("", "- |z1|^2*z1"),
    ("a1", "- 2*a1*conj(z1)*z2"),
    ("a2", "- 2*a2*conj(z1)^2*z3"),
    ("a3", "- 8*a3*conj(z2)*z3"),
    ("a4", "- 8*a4*|z2|^2*z1"),
    ("a5", "- 16*a5*|z3|^2*z1"),
    ("a6", "+ 16*a6*conj(z3)*z2^2"),
];
const Z2: &[Term] = &[
    ("kappa2", "-kappa2*z2"),
    ("b1", "+ b1/4*z1^2"),
    ("b2", "+ b2*conj(z1)*z3"),
    ("b3", "- 8*b3*|z2|^2*z2"),
    ("b4", "- b4*|z1|^2*z2"),
    ("b5", "- 16*b5*|z3|^2*z2"),
    ("b6", "+ 2*b6*z1*conj(z2)*z3"),
];
const Z3: &[Term] = &[
    ("kappa3", "-kappa3*z3"),
    ("d1", "+ d1/8*z1^3"),
    ("d2", "+ d2/2*z1*z2"),
    ("d3", "- 16*d3*|z3|^2*z3"),
    ("d4", "- d4*|z1|^2*z3"),
    ("d5", "- 8*d5*|z2|^2*z3"),
    ("d6", "+ 2*d6*conj(z1)*z2^2"),
];

/// Parameters that stay although they are zero.
const ALWAYS: [&str; 3] = ["gamma", "kappa2", "kappa3"];

/// The equations of a model with these values of its parameters as defaults: its own, or those of the tensor model without the
/// couplings that are zero. `None` for the cell model, whose equations are not a few polynomials.
pub fn of_model(info: &ModelInfo, values: &[f64]) -> Option<Definition> {
    if let Some(definition) = info.definition() {
        let mut definition = definition.clone();
        for (parameter, &value) in definition.parameters.iter_mut().zip(values) {
            parameter.default = value;
        }
        return Some(definition);
    }
    (info.name == "tensor").then(|| tensor(values, false))
}

/// The tensor model with these 21 values; with `all` its terms, or without those whose coupling is zero.
pub fn tensor(values: &[f64], all: bool) -> Definition {
    let specs = || TensorParameters::specs().iter().zip(values.iter().copied());
    let kept = |name: &str, value: f64| all || value != 0.0 || ALWAYS.contains(&name);
    let present =
        |name: &str| name.is_empty() || specs().any(|(spec, value)| spec.name == name && kept(name, value));
    let equation = |terms: &[Term]| {
        let texts: Vec<&str> = terms.iter().filter(|term| present(term.0)).map(|term| term.1).collect();
        texts.join(" ")
    };
    let parameters = specs().filter(|(spec, value)| kept(spec.name, *value)).map(|(spec, value)| {
        let (low, high) = spec.range;
        ParameterDefinition {
            range: Some([low.min(value), high.max(value)]),
            text: spec.meaning.to_owned(),
            ..ParameterDefinition::new(spec.name, value)
        }
    });
    Definition {
        modes: vec![1, 2, 3],
        velocity: None,
        symmetry: None,
        parameters: parameters.collect(),
        equations: [Z1, Z2, Z3].map(equation).to_vec(),
        noise: BTreeMap::new(),
    }
}

/// The tensor model with all its terms, as a list of products.
///
/// Its equations are those of [`tensor`]; the list and the evaluation in lanes are those of every text.
pub(crate) fn of_tensor(parameters: &TensorParameters) -> Amplitudes {
    static ALL: LazyLock<Known> = LazyLock::new(|| {
        let equations = Equations::new(&tensor(&TensorParameters::default().values(), true));
        Known::new(equations.expect("the equations of the tensor model can be read"))
    });
    Amplitudes::new(&ALL, &parameters.values())
}
