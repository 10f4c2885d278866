//! The registry is complete, consistent and helpful.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_models::spelling::{ascii, canonical};
use motiform_models::{Error, MODELS, ModelInfo, nearest};
use std::collections::HashSet;

#[test]
fn every_model_builds_from_its_defaults_and_agrees_with_its_names() {
    for info in MODELS {
        let specs = info.parameters();
        let names: HashSet<_> = specs.iter().map(|spec| spec.name).collect();
        assert_eq!(names.len(), specs.len(), "{}: a name twice", info.name);
        for spec in specs {
            assert!(spec.range.0 <= spec.default && spec.default <= spec.range.1, "{}", spec.name);
            assert!(spec.allowed.0 <= spec.range.0 && spec.range.1 <= spec.allowed.1, "{}", spec.name);
            assert!(spec.meaning.ends_with('.') && info.equations.contains(spec.name), "{}", spec.name);
        }
        let defaults: Vec<f64> = specs.iter().map(|spec| spec.default).collect();
        let model = info.build(&defaults).unwrap();
        assert_eq!(model.coordinates(), info.coordinates(&defaults));
        assert_eq!(model.coordinates().len(), model.dim());
    }
}

#[test]
fn slips_of_the_finger_get_the_nearest_name() {
    let tensor = ModelInfo::find("tensor").unwrap();
    assert!(matches!(ModelInfo::find("tenser"), Err(Error::UnknownModel { nearest: Some("tensor"), .. })));
    assert!(matches!(
        tensor.coordinate(&[], "S11x"),
        Err(Error::UnknownCoordinate { nearest: Some("s11"), .. })
    ));
    assert_eq!(nearest("kapa2", tensor.parameters().iter().map(|p| p.name)), Some("kappa2"));
    assert_eq!(nearest("viscosity", tensor.parameters().iter().map(|p| p.name)), None);
    assert_eq!(tensor.coordinate(&[], "y").unwrap(), 7);
}

#[test]
fn values_that_cannot_be_computed_with_are_refused() {
    let tensor = ModelInfo::find("tensor").unwrap();
    let mut values: Vec<f64> = tensor.parameters().iter().map(|spec| spec.default).collect();
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        values[0] = bad;
        assert!(matches!(tensor.build(&values), Err(Error::OutOfRange { ref name, .. }) if name == "gamma"));
    }
}

/// Values that were missing had their defaults, and those beyond the last parameter were dropped.
#[test]
fn a_body_needs_one_value_for_each_parameter() {
    for info in MODELS {
        let values: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
        info.build(&values).expect("a body");
        for wrong in [&values[1..], &[values.clone(), vec![0.0]].concat()] {
            let message = info.build(wrong).map(drop).unwrap_err().to_string();
            let (got, model, expected) = (wrong.len(), info.name, values.len());
            assert!(
                message.contains(&format!("values = {got} numbers: model {model} has {expected} parameters")),
                "{message}"
            );
        }
    }
}

#[test]
fn greek_letters_are_spelled_and_symbols_are_known() {
    for typed in ["κ2", "κ₂", "κ_2", "kappa2"] {
        assert_eq!(ascii(typed), "kappa2");
    }
    assert_eq!(ascii("alpha3_per_length"), "alpha3_per_length");
    let cell = ModelInfo::find("cell").expect("a model").parameters();
    assert_eq!(canonical(cell, "L"), "length");
    assert_eq!(canonical(cell, "length"), "length");
    assert_eq!(canonical(cell, "Lx"), "Lx");
}

/// Property of [`Model::encode`] that rates in coordinates need: both maps are linear, and inverse to each other.
#[test]
fn coordinates_are_linear_in_the_state() {
    for info in MODELS {
        let values: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
        let model = info.build(&values).unwrap();
        let dim = model.dim();
        let a: Vec<f64> = (0..dim).map(|i| 0.3 + i as f64).collect();
        let b: Vec<f64> = (0..dim).map(|i| 1.7 - 0.5 * i as f64).collect();
        let sum: Vec<f64> = a.iter().zip(&b).map(|(a, b)| 2.0 * a + b).collect();
        let read = |state: &[f64]| model.decoded(state);
        for ((a, b), sum) in read(&a).iter().zip(read(&b)).zip(read(&sum)) {
            assert!((2.0 * a + b - sum).abs() < 1e-12 * sum.abs().max(1.0), "{}", info.name);
        }
        let back = model.encoded(&read(&a));
        assert!(back.iter().zip(&a).all(|(x, y)| (x - y).abs() < 1e-13 * y.abs().max(1.0)));
    }
}
