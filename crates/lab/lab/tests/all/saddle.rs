//! No chaotic saddle: Lorenz's equations below the chaos, and where it lasts.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_lab::saddle::{Saddle, saddle};
use motiform_study::{RunPlan, Study};

fn found(r: f64, transient: f64) -> Saddle {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/all/models/lorenz.toml"))
        .unwrap();
    let study = Study::parse(&text.replace("r = 28", &format!("r = {r:?}")), "text", "test").unwrap();
    saddle(&RunPlan::new(&study).unwrap(), 24, (Some(transient), Some(200.0)), 2, &()).unwrap().unwrap()
}

#[test]
fn the_exponent_of_a_focus_or_of_an_attractor_is_not_that_of_a_saddle() {
    let focus = found(22.0, 10.0);
    assert!(focus.exponent.is_none() && !focus.is_one(), "{focus:?}");
    assert!(focus.captured == 24 && focus.missing.starts_with("no chaotic saddle"), "{focus:?}");
    assert!(!focus.to_string().contains("of the chaotic saddle"), "{focus}");
    let attractor = found(28.0, 100.0);
    assert!((attractor.exponent.unwrap().value - 0.906).abs() < 0.02, "{attractor:?}");
    assert!(!attractor.is_one() && attractor.to_string().contains("no run left"), "{attractor}");
}
