//! Amplitude equations, each body with its own coefficients.

use crate::single::{Body, checked, how};
use motiform_models::ModelInfo;
use motiform_models::amplitudes::{Definition, ParameterDefinition, info};

/// Three modes with handed, constant-free terms up to order 7: every kind of group.
pub(crate) fn three() -> &'static ModelInfo {
    let equations = [
        "(a + i*w - |z1|^2 - |z2|^2)*z1 - 2*b*conj(z1)*z2 + exp(i*w)*conj(z2)*z3*|z1|^4",
        "(-1 - |z2|^2)*z2 + b/4*z1^2 + i*w*conj(z1)*z3*|z3|^2",
        "-0.7*z3 + a*z1*z2 + b*z1^3*|z2|^4",
    ];
    let parameters = [("a", 0.5), ("b", -0.3), ("w", 0.2)];
    let definition = Definition {
        modes: vec![1, 2, 3],
        velocity: None,
        symmetry: None,
        parameters: parameters.map(|(name, value)| ParameterDefinition::new(name, value)).to_vec(),
        equations: equations.map(str::to_owned).to_vec(),
        noise: std::collections::BTreeMap::new(),
    };
    info(&definition).unwrap()
}

#[test]
fn orbits_in_lanes_have_the_bits_of_single_ones() {
    let body = |member: usize| -> Body {
        let x = member as f64;
        let values = [0.5 + 0.05 * (1.1 * x).sin(), -0.3 + 0.1 * (0.7 * x).cos(), 0.02 * x];
        let start = (0..8).map(|i| 0.4 * (1.0 + x * 0.7 + f64::from(i) * 1.3).sin()).collect();
        (three().build(&values).unwrap(), start)
    };
    let bodies: Vec<Body> = (0..21).map(body).collect();
    let states = checked(&bodies, &how(&[0.0, 1.5, 40.0], 1e-9));
    assert!(states.iter().all(Option::is_some));
}
