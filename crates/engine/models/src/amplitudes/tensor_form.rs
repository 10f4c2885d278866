//! Amplitude equations of modes 1, 2, 3 as the tensor model's equations.

use super::{Equations, terms};

/// A term of (Z1), (Z2), (Z3), the parameter of (V), (S), (U) that it is, and what its coefficient is multiplied by to give it.
const TERMS: [(&str, &str, f64); 22] = [
    ("z1: z1", "gamma", 1.0),
    ("z1: |z1|^2*z1", "", -1.0),
    ("z1: |z2|^2*z1", "a4", -0.125),
    ("z1: |z3|^2*z1", "a5", -0.0625),
    ("z1: conj(z1)*z2", "a1", -0.5),
    ("z1: conj(z1)^2*z3", "a2", -0.5),
    ("z1: conj(z2)*z3", "a3", -0.125),
    ("z1: z2^2*conj(z3)", "a6", 0.0625),
    ("z2: z2", "kappa2", -1.0),
    ("z2: |z1|^2*z2", "b4", -1.0),
    ("z2: |z2|^2*z2", "b3", -0.125),
    ("z2: |z3|^2*z2", "b5", -0.0625),
    ("z2: z1^2", "b1", 4.0),
    ("z2: conj(z1)*z3", "b2", 1.0),
    ("z2: z1*conj(z2)*z3", "b6", 0.5),
    ("z3: z3", "kappa3", -1.0),
    ("z3: |z1|^2*z3", "d4", -1.0),
    ("z3: |z2|^2*z3", "d5", -0.125),
    ("z3: |z3|^2*z3", "d3", -0.0625),
    ("z3: z1^3", "d1", 8.0),
    ("z3: z1*z2", "d2", 2.0),
    ("z3: conj(z1)*z2^2", "d6", 0.5),
];

/// The parameter of (V), (S), (U) that is in the coefficient of a term of (Z1), (Z2), (Z3), such as `z1: conj(z1)*z2`, and the
/// coefficient of that parameter; `None` for terms without one. Source: paper, the table of coefficients after (Z3).
pub fn tensor_parameter(term: &str) -> Option<(&'static str, f64)> {
    let &(_, name, factor) = TERMS.iter().find(|(known, name, _)| *known == term && !name.is_empty())?;
    Some((name, 1.0 / factor)) // factors are powers of 2: exact
}

/// Equations as those of the tensor model.
#[derive(Clone, Debug, PartialEq)]
pub struct TensorForm {
    /// The parameters of (V), (S), (U), those that are not 0; `v^2 v` in (V) has the factor `-saturation`.
    pub parameters: Vec<(&'static str, f64)>,
    /// The factor of `-v^2 v` in (V): 1 in the paper.
    pub saturation: f64,
    /// Terms that the tensor model does not have, with their coefficients.
    pub others: Vec<(String, [f64; 2])>,
}

/// The tensor form at these values of the parameters; `None` unless the modes are 1, 2, 3 and the velocity is `conj(z1)`.
pub fn tensor_form(equations: &Equations, parameters: &[f64]) -> Option<TensorForm> {
    let definition = equations.definition();
    if definition.modes != [1, 2, 3] || equations.velocity_mode != Some(0) || equations.sense > 0 {
        return None;
    }
    let mut form = TensorForm { parameters: Vec::new(), saturation: 0.0, others: Vec::new() };
    for (term, value) in terms(equations, parameters) {
        if value == [0.0, 0.0] {
            continue;
        }
        match (TERMS.iter().find(|(known, ..)| *known == term), value) {
            (Some((_, "", factor)), [re, 0.0]) => form.saturation = re * factor,
            (Some(&(_, name, factor)), [re, 0.0]) => form.parameters.push((name, re * factor)),
            _ => form.others.push((term, value)),
        }
    }
    let place = |name: &str| TERMS.iter().position(|(_, known, _)| *known == name);
    form.parameters.sort_by_key(|(name, _)| place(name));
    Some(form)
}
