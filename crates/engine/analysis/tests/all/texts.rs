//! Names of motions whose equations are given as text and whose paths are known exactly.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{ORDINARY, named, near};
use motiform_analysis::regime::{Attractor, Form};
use motiform_analysis::{Regime, Settings, Verdict};
use motiform_models::ModelInfo;
use motiform_models::amplitudes::{self, Definition, ParameterDefinition};
use std::f64::consts::TAU;

/// Equations of these modes, with a symmetry where one is given.
fn text(modes: &[u32], velocity: &str, symmetry: Option<&str>, equations: &[&str]) -> &'static ModelInfo {
    amplitudes::info(&Definition {
        modes: modes.to_vec(),
        velocity: Some(velocity.to_owned()),
        symmetry: symmetry.map(str::to_owned),
        parameters: vec![ParameterDefinition::new("unused", 1.0)],
        equations: equations.iter().map(|&one| one.to_owned()).collect(),
        noise: std::collections::BTreeMap::new(),
    })
    .unwrap()
}

fn seen(info: &ModelInfo, start: &[f64], settings: &Settings) -> Verdict {
    named(info.build(&[1.0]).unwrap().as_ref(), start, settings)
}

/// Two uncoupled circles, `z1` and `z2` of constant size at the rates w1, w2: the shape is back after `2 pi/|2 w1 - w2|`, turned by `w1`
/// times that. Its size has no extremes but round-off, so a look may find no return at all; a multiple of the period is no period.
#[test]
fn shapes_of_constant_size_have_their_shortest_period() {
    let mut named = 0;
    for (w1, w2) in [(-0.3_f64, 0.5_f64), (-0.3, 0.3), (-0.3, 0.35), (-1.0, 1.0)] {
        let equations = [format!("(1+i*({w1})-|z1|^2)*z1"), format!("(1+i*({w2})-|z2|^2)*z2")];
        let info = text(&[1, 2], "conj(z1)", None, &[&equations[0], &equations[1]]);
        for start in [[0.5, 0.2, 0.3, -0.4], [-0.1, 0.9, 1.2, 0.1]] {
            let verdict = seen(info, &start, &ORDINARY);
            println!("{w1} {w2}: {} {:?} {}", verdict.regime, verdict.period, verdict.why);
            if verdict.regime != Regime::Undetermined {
                assert_eq!(verdict.regime, Regime::QuasiPeriodic, "{w1} {w2} {start:?}: {}", verdict.why);
                near(verdict.period.unwrap(), TAU / (2.0 * w1 - w2).abs(), 1e-5);
                named += 1;
            }
        }
    }
    assert!(named >= 3, "{named} of 8");
}

/// Two oscillators that do not act on each other (Lorenz 1984, Tellus 36A, 98, at F = 3, G = 1) are back after the period of one, whatever
/// return of the pair is seen first: the period of the first one alone is the reference. Their phase difference is a family.
#[test]
fn two_copies_of_an_oscillator_have_the_period_of_one() {
    let of = |[x, y, z]: [&str; 3]| {
        [
            format!("(0.75 - 0.25*{x} - {y}^2 - {z}^2)"),
            format!("({x}*{y} - 4*{x}*{z} - {y} + 1)"),
            format!("(4*{x}*{y} + {x}*{z} - {z})"),
        ]
    };
    let first = of(["re(z1)", "im(z1)", "re(z2)"]);
    let second = of(["im(z2)", "re(z3)", "im(z3)"]);
    let joined = |x: &str, y: &str| format!("{x} + i*{y}");
    let head = joined(&first[0], &first[1]);
    let one = text(&[1, 2], "z1", Some("none"), &[&head, &joined(&first[2], "(-im(z2))")]);
    let rest = [joined(&first[2], &second[0]), joined(&second[1], &second[2])];
    let two = text(&[1, 2, 3], "z1", Some("none"), &[&head, &rest[0], &rest[1]]);
    let start = [1.0, 0.3, 0.2, 1.013, 0.3039, 0.2026];
    let alone = seen(one, &start[..4], &ORDINARY);
    for look in [5.0, 100.0] {
        let pair = seen(two, &start, &Settings { first_look: look, ..ORDINARY });
        near(pair.period.unwrap(), alone.period.unwrap(), 1e-6);
    }
}

/// The orbits of `x'' = -x - x^3` have an energy, and no orbit attracts; far from the origin a shift along one of them, which is bent, is
/// no step to another one that does the same.
#[test]
fn an_oscillator_with_an_energy_attracts_nothing_wherever_the_origin_is() {
    let (x, y) = ("(re(z1)-30)", "(im(z1)-20)");
    let info = text(&[1], &format!("{x}+i*{y}"), Some("none"), &[&format!("{y} + i*(-{x}-{x}^3)")]);
    let verdict = seen(info, &[30.4, 20.2], &Settings { budget: 500.0, ..ORDINARY });
    assert_eq!(verdict.regime, Regime::Undetermined, "{}", verdict.why);
}

/// Two steady motions meet where the saddle-node `x' = -x^2` and the crossing `x' = -x (x + y)` have no rate: rest is approached from one
/// side alone, and beside another origin too nothing says that it is stable.
#[test]
fn where_steady_motions_meet_none_is_stable_wherever_the_origin_is() {
    for (a, b) in [(0.0, 0.0), (2.0, -1.0), (-2.25, 4.0), (1.5, 3.0), (100.0, 64.0)] {
        let (x, y) = (format!("(re(z1)-({a}))"), format!("(im(z1)-({b}))"));
        for equations in [format!("-{x}^2 - i*{y}"), format!("-{x}*({x}+{y}) + i*({x}^2-{y})")] {
            let info = text(&[1], &format!("{x}+i*{y}"), Some("none"), &[&equations]);
            let verdict = seen(info, &[a + 0.4, b + 0.2], &ORDINARY);
            assert_eq!(verdict.regime, Regime::Undetermined, "{a} {b} {equations}: {}", verdict.why);
        }
    }
}

/// Two coupled oscillators of van der Pol whose beats last 10.247 and 10.007 turns, close to 41/4 and 10: a thousand returns in a row are a
/// few arcs of the curve, and the next ones lie beside them. The exponents are 0, 0, -0.076 and -0.102 at the first.
#[test]
fn a_torus_close_to_a_resonance_is_one() {
    for k in [0.05, 0.06] {
        let equations = [
            format!("im(z1) + i*(0.1*(1-re(z1)^2)*im(z1) - re(z1) + {k}*(re(z2)-re(z1)))"),
            format!("im(z2) + i*(0.1*(1-re(z2)^2)*im(z2) - 1.2*re(z2) + {k}*(re(z1)-re(z2)))"),
        ];
        let info = text(&[1, 2], "z1", Some("none"), &[&equations[0], &equations[1]]);
        let verdict = seen(info, &[0.5, 0.2, 0.3, -0.4], &Settings { budget: 8e4, ..ORDINARY });
        assert_eq!(verdict.attractor, Attractor::Torus, "{k}: {}", verdict.why);
    }
}

/// A heading that turns through a full circle in a period is no zigzag, whether rotations are divided out or not.
#[test]
fn loops_that_drift_are_circular_in_every_frame() {
    let equations = ["(1-|z1|^2)*z1+0.1*(conj(z2)*z1^2+conj(z1)^2*z2)*z1", "(1-i-|z2|^2)*z2"];
    for symmetry in [None, Some("none")] {
        let info = text(&[1, 2], "conj(z1)+2*z1*conj(z2)", symmetry, &equations);
        let verdict = seen(info, &[0.8, 0.1, 0.5, 0.3], &ORDINARY);
        let form = (verdict.regime, verdict.form);
        assert_eq!(form, (Regime::Circular, Some(Form::DriftingCircular)), "{symmetry:?}: {}", verdict.why);
        near(verdict.turning_rate.unwrap(), 1.0, 1e-6);
    }
}

/// A velocity that vanishes on the cycle by cancellation: what is left of it are errors of the steps, and it has no heading.
#[test]
fn a_velocity_of_round_off_is_none() {
    let cycle = "(1+i-|z2|^2)*z2";
    for velocity in ["z2*(|z2|^2-1)", "|z2|^2-1"] {
        let info = text(&[2], velocity, Some("none"), &[cycle]);
        for rtol in [1e-7, 1e-9, 1e-12] {
            let control = motiform_dynamics::StepControl::Adaptive { rtol, atol: 1e-3 * rtol };
            let verdict = seen(info, &[0.5, 0.2], &Settings { control, ..ORDINARY });
            let form = (verdict.regime, verdict.form);
            assert_eq!(
                form,
                (Regime::Motionless, Some(Form::PulsatingAtRest)),
                "{velocity} {rtol}: {}",
                verdict.why
            );
        }
    }
    // a speed of a millionth of the shape is one
    let info = text(&[2], "z2*(|z2|^2-1+0.000001)", Some("none"), &[cycle]);
    assert_eq!(seen(info, &[0.5, 0.2], &ORDINARY).regime, Regime::Circular);
}

/// `v = e^(i t) + b e^(-2 i t)`: the heading turns once forwards for b < 1 and twice backwards for b > 1; beside b = 1 the body nearly
/// stops, and samples do not tell to which side it turns there.
#[test]
fn the_sense_of_turning_beside_a_cusp_is_not_guessed() {
    let equations = ["(1+i-|z2|^2)*z2", "(1-2*i-|z3|^2)*z3"];
    for (b, turns) in [(0.9, Some(1.0)), (1.1, Some(-2.0)), (0.99999, None), (1.00001, None)] {
        let info = text(&[2, 3], &format!("z2+{b}*z3"), Some("none"), &equations);
        let verdict = seen(info, &[0.5, 0.2, 0.7, 0.1], &ORDINARY);
        match turns {
            Some(rate) => near(verdict.turning_rate.unwrap(), rate, 1e-6),
            None => assert_eq!(
                (verdict.regime, verdict.course),
                (Regime::Undetermined, None),
                "{b}: {}",
                verdict.why
            ),
        }
    }
}
