//! Chaotic saddles, and what is none: Lorenz's equations below and within the transient chaos, and above it.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_lab::saddle::{Saddle, saddle};
use motiform_study::{RunPlan, Study};

fn found(r: f64, t_end: f64) -> Saddle {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/all/models/lorenz.toml"))
        .unwrap();
    let study = Study::parse(&text.replace("r = 28", &format!("r = {r:?}")), "text", "test").unwrap();
    saddle(&RunPlan::new(&study).unwrap(), 24, (Some(10.0), Some(t_end)), 2, &()).unwrap().unwrap()
}

#[test]
fn the_exponent_of_a_focus_or_of_an_attractor_is_not_that_of_a_saddle() {
    let focus = found(10.0, 200.0);
    assert!(focus.exponent.is_none() && !focus.is_one(), "{focus:?}");
    assert!(focus.captured == 24 && focus.missing.starts_with("no chaotic saddle"), "{focus:?}");
    assert!(!focus.to_string().contains("of the chaotic saddle"), "{focus}");
    let attractor = found(28.0, 200.0);
    assert!((attractor.exponent.unwrap().value - 0.906).abs() < 0.02, "{attractor:?}");
    assert!(!attractor.is_one() && attractor.to_string().contains("no run left"), "{attractor}");
}

/// Transient chaos of about 0.8 below r = 24.06.
#[test]
fn a_capture_leaves_the_saddle() {
    let saddle = found(22.0, 400.0);
    assert!(saddle.is_one() && saddle.captured > 0, "{saddle:?}");
    assert!((0.4..1.0).contains(&saddle.exponent.unwrap().value), "{saddle:?}");
}
