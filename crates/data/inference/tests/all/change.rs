//! Handedness beside a change of the law.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Experiment, full, vertex_noise};
use crate::samples::draws;
use motiform_dynamics::Complex;
use motiform_inference::{
    CHANGED, HANDED_RATE, Settings, change, fit, handed_beside_change, handedness, select,
};

/// The p-values of the test of handedness: without a change of the law, robust, and beside such a change.
fn p_values(experiment: &Experiment) -> [f64; 3] {
    let tracks = [experiment.track()];
    let whole = fit(&tracks, &Settings::default(), &()).unwrap();
    let selection = select(&tracks, &whole, &()).unwrap();
    let test = handedness(&tracks, &selection.fit, &()).unwrap();
    let beside = handed_beside_change(&tracks, [&selection.fit, &test.fit], &()).unwrap();
    println!("p {:e}, robust {:e}, beside a change {beside:e}", test.p_value, test.robust_p_value);
    [test.p_value, test.robust_p_value, beside]
}

/// Circles of a mirror-symmetric law whose kappa2 grows from 0.3 to 0.9: the test without a change rejects real coefficients.
#[test]
fn a_change_is_no_handedness() {
    let mut rejected = 0;
    for seed in 0..draws(2, 4) {
        let law = Experiment::new(full(0.3, 0.4), 0.01, 7100 + seed);
        let [p, robust, beside] =
            p_values(&Experiment { errors: vertex_noise(0.7), frames: 300, change: 0.6, ..law });
        rejected += usize::from(p.max(robust) < HANDED_RATE);
        assert!(beside >= HANDED_RATE, "{beside:e}");
    }
    assert!(rejected >= draws(1, 2), "{rejected}"); // else the test shows nothing
}

/// Handed cells that keep their law are handed beside a change, too.
#[test]
fn handedness_is_no_change() {
    for seed in 0..3 {
        let mut law = Experiment::new(full(0.5, 0.1), 0.02, 7200 + seed);
        law.equations[0].1 = Complex::new(1.0, 0.1);
        let [.., beside] = p_values(&Experiment { frames: 400, ..law });
        assert!(beside < HANDED_RATE, "{beside:e}");
    }
}

/// Parts of the shortest records have no frames, and say nothing.
#[test]
fn short_records_have_no_handed_parts() {
    let mut law = Experiment::new(full(0.5, 0.1), 0.02, 7300);
    law.equations[0].1 = Complex::new(1.0, 0.1);
    let [.., beside] = p_values(&Experiment { frames: motiform_inference::LEAST_FRAMES, ..law });
    assert!(beside >= HANDED_RATE, "{beside:e}");
}

/// Cells of 300 frames: zigzags that keep their law, with an alarm at 1e-2 in one of 5 (of the whole sample two of 8) at most, which more
/// have with a probability of 1e-3, and chaotic cells whose kappa2 grows from 0.5 to 0.8.
#[test]
fn a_change_is_seen() {
    let p = |experiment: &Experiment| {
        let tracks = [experiment.track()];
        let whole = fit(&tracks, &Settings::default(), &()).unwrap();
        change(&tracks, &select(&tracks, &whole, &()).unwrap().fit, &()).unwrap()
    };
    let kept = |seed: u64| {
        let law = Experiment::new(full(0.9, 0.1), 0.01, 7400 + seed);
        p(&Experiment { errors: vertex_noise(1.2), frames: 300, ..law })
    };
    let changed = |seed: u64| {
        p(&Experiment { frames: 300, change: 0.3, ..Experiment::new(full(0.5, 0.1), 0.01, 7500 + seed) })
    };
    let (kept, changed): (Vec<_>, Vec<_>) =
        ((0..draws(5, 8)).map(kept).collect(), (0..draws(3, 4)).map(changed).collect());
    println!("{kept:?}\n{changed:?}");
    assert!(kept.iter().all(|p| p.is_none_or(|p| p >= CHANGED)));
    assert!(kept.iter().filter(|p| p.is_none_or(|p| p >= 0.01)).count() >= draws(4, 6));
    assert!(changed.iter().filter(|p| p.is_some_and(|p| p < CHANGED)).count() >= draws(2, 3));
}
