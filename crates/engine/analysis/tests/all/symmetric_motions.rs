//! Verdicts about motions and starts of special symmetry: a body at rest is not chaotic, a straight path is no zigzag, a set
//! that shrinks is no torus.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Random, cell, full, named, near, reduced, settings};
use motiform_analysis::regime::Form;
use motiform_analysis::{Attractor, Regime, RelativeEquilibrium, Verdict};
use motiform_dynamics::{Model, System};

/// The unstable state that the verdict speaks of, by its growth rate.
fn stays(verdict: &Verdict, regime: Regime, growth: f64) {
    assert_eq!((verdict.regime, verdict.attractor), (regime, Attractor::Unstable), "{}", verdict.why);
    near(verdict.exponents[0].value, growth, 1e-6 * growth);
    assert!(verdict.margin.is_none() && verdict.why.contains("a typical start leaves it"), "{}", verdict.why);
}

/// Fig. 1 with the velocity alone, at rest, and as an exact ellipse. Growth rates: gamma of the circle, gamma + 2 r2 of the ellipse.
#[test]
fn a_body_at_rest_at_an_unstable_shape_is_not_chaotic() {
    let settings = settings("tensor");
    let (kappa2, gamma) = (-0.1_f64, -0.04);
    let ellipse = (-kappa2 / 8.0).sqrt();
    let body = reduced(kappa2, gamma);
    for start in [
        [0.0, 0.0, 2.0 * ellipse, 0.0, 0.0, 0.0],
        [0.3, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.1, 0.3, 0.2, 0.0],
    ] {
        stays(&named(&body, &start, &settings), Regime::Motionless, gamma + 2.0 * ellipse);
    }
    stays(&named(&body, &[0.0; 6], &settings), Regime::Motionless, 0.1); // -kappa2
    // the same body from a general start
    assert_eq!(named(&body, &Random(1).state(6, 0.01), &settings).regime, Regime::Rectangular);
}

#[test]
fn straight_motion_that_is_unstable_is_named_so() {
    let body = full(0.5, 0.1);
    let start = [-1.0, 0.0, 0.5, 0.0, 1.0, 0.0];
    let verdict = named(&body, &start, &settings("tensor"));
    let found = RelativeEquilibrium::find(&body, &[-0.57, 0.0, 0.3, 0.0, 0.1, 0.0]).unwrap();
    assert!(found.growth() > 0.0);
    assert_eq!(
        (verdict.regime, verdict.attractor),
        (Regime::Straight, Attractor::Unstable),
        "{}",
        verdict.why
    );
    assert!(verdict.exponents[0].value > 0.1);
}

#[test]
fn a_cell_that_begins_as_a_circle_stays_one() {
    let body = cell(13.2, 16);
    let growth = |n: f64| {
        let k = std::f64::consts::TAU * n / 13.2;
        k.powi(4) - k.powi(6)
    };
    let verdict = named(&body, &vec![0.0; body.dim()], &settings("cell"));
    stays(&verdict, Regime::Motionless, growth(1.0).max(growth(2.0)));
}

/// The orbit is mirror symmetric at every moment: one period is 228.16, not twice that. Source: an independent program, 228.156
/// at its own tolerance.
#[test]
fn pulsating_straight_motion_is_no_zigzag() {
    let verdict = named(&reduced(-0.02, -0.044), &Random(5).state(6, 0.01), &settings("tensor"));
    assert_eq!((verdict.regime, verdict.form), (Regime::PulsatingStraight, Some(Form::PulsatingStraight)));
    near(verdict.period.unwrap(), 228.16, 0.02);
    let speed = verdict.speed.unwrap();
    near(speed.min, 0.00793, 1e-5);
    near(speed.max, 0.1001, 1e-4);
    assert_eq!(verdict.turning_rate, Some(0.0));
    assert!(verdict.legs.is_empty() && verdict.swing.is_none());
    // straight: the distance travelled is the mean speed times the period
    near(verdict.drift.unwrap(), speed.mean * verdict.period.unwrap(), 1e-2);
}

/// At the symmetry breaking of the zigzag its returns approach it as n^(-1/2): along a curve, but no torus.
#[test]
fn critical_slowing_down_is_no_torus() {
    let verdict = named(&full(1.148, 0.1), &Random(2010).state(6, 0.01), &settings("tensor"));
    println!("{}: {}", verdict.regime, verdict.why);
    assert!(matches!(verdict.regime, Regime::Undetermined | Regime::Zigzag), "{}", verdict.why);
}

#[test]
fn periodic_motions_are_told_apart_by_their_symmetry() {
    let settings = settings("tensor");
    let form = |body: &dyn Model| named(body, &Random(3).state(6, 0.01), &settings).form;
    assert_eq!(form(&full(0.9, 0.1)), Some(Form::MirrorZigzag));
    assert_eq!(form(&full(0.75, 0.1)), Some(Form::RotatingZigzag)); // left of the symmetry breaking at .7835
    assert_eq!(form(&reduced(-0.1, 0.02)), Some(Form::PulsatingCircular));
    for form in Form::ALL {
        assert_eq!(serde_json::to_value(form).unwrap(), form.name());
    }
}

/// Weak chaos that the 0-1 test takes for order, lambda_1 = .0100 (2); and rests of some 600 time units in a heteroclinic cycle,
/// whose exponent is that of the saddle.
#[test]
fn weak_chaos_is_decided_and_long_rests_are_not_chaos() {
    let settings = settings("tensor");
    let weak = named(&full(1.119, 0.1068), &Random(1).state(6, 0.01), &settings);
    assert_eq!(weak.regime, Regime::Chaotic, "{}", weak.why);
    assert!(weak.exponents[0].covers(0.0100), "{:?}", weak.exponents);
    assert!(weak.lasted.is_some_and(|time| time > 1000.0));
    let body = reduced(-0.0055, -0.0109);
    for seed in 1..6 {
        let slow = named(&body, &Random(seed).state(6, 0.01), &settings);
        assert!(matches!(slow.regime, Regime::Rectangular | Regime::Undetermined), "{}", slow.why);
    }
}
