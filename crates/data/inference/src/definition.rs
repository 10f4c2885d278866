//! A fit as a model: equations with named parameters, in the units of the data.

use crate::names::paper;
use crate::{Fit, Library};
use motiform_models::amplitudes::{Definition, ParameterDefinition};
use std::collections::BTreeMap;

/// The amplitude equations of a library with these coefficients (in the order of its terms; for handed models all real parts, then all
/// imaginary parts).
///
/// Parameters have the paper's names where a term has one, with the paper's factors: `b1/4*z1^2`; see [`crate::paper`].
///
/// # Checked by  `tests/all/definition.rs`: the model's vector field is the library's, to 1e-15
pub fn equations(library: &Library, handed: bool, coefficients: &[f64]) -> Definition {
    let terms = library.terms.len();
    let mut parameters = Vec::new();
    let mut equations = vec![String::new(); library.modes];
    for (i, term) in library.terms.iter().enumerate() {
        let (name, factor) = paper(term, false);
        let parameter = |name: &str, value: Option<&f64>| {
            let mut parameter = ParameterDefinition::new(name, value.copied().unwrap_or(0.0) / factor);
            parameter.text = format!("coefficient of {}", term.name());
            parameter
        };
        parameters.push(parameter(&name, coefficients.get(i)));
        let mut written = name.clone();
        if handed {
            let imaginary = paper(term, true).0;
            parameters.push(parameter(&imaginary, coefficients.get(terms + i)));
            written = format!("({name} + i*{imaginary})");
        }
        let equation = &mut equations[term.equation];
        let sign = match (equation.is_empty(), factor < 0.0) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        let size = factor.abs();
        let size = if size == 1.0 { String::new() } else { format!("{size}*") };
        *equation += &format!("{sign}{size}{written}*{}", term.expression());
    }
    for (equation, n) in equations.iter_mut().zip(1..).filter(|(equation, _)| equation.is_empty()) {
        *equation = format!("0*z{n}"); // an equation must be there, and turn as its amplitude does
    }
    let modes = (1..=library.modes as u32).collect();
    Definition { modes, velocity: None, symmetry: None, parameters, equations, noise: BTreeMap::new() }
}

impl Fit {
    /// The fitted equations as a model file has them: see [`equations()`].
    pub fn definition(&self) -> Definition {
        equations(&self.library, self.handed, &self.parameters().coefficients)
    }
}
