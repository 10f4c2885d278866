//! Values as they are printed and stored.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_inference::{Estimate, PValue};

#[test]
fn no_p_value_is_printed_as_zero() {
    let said = [0.0, 1.26e-17, 0.0099, 0.01, 0.346, 1.0].map(|p| PValue(p).to_string());
    assert_eq!(said, ["p below 1e-300", "p = 1.3e-17", "p = 9.9e-3", "p = 0.01", "p = 0.35", "p = 1.00"]);
}

#[test]
fn ends_at_infinity_are_read_back() {
    let estimate =
        Estimate { value: 0.01, error: 5.0, robust: 2.0, interval: [f64::NEG_INFINITY, f64::INFINITY] };
    let text = serde_json::to_string(&estimate).unwrap();
    assert_eq!(serde_json::from_str::<Estimate>(&text).unwrap(), estimate);
}
