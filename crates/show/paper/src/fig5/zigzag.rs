//! (a) The zigzag.

use super::super::claims::claim;
use super::super::context::Context;
use super::drawings;
use motiform_analysis::{Regime, Verdict};
use motiform_figures::report::{Claim, Section};
use motiform_study::{Dataset, Error};

/// The angle that the paper gives, and what 'about' may mean (degrees).
const ANGLE: (f64, f64) = (60.0, 3.0);

pub(super) fn add(context: &Context<'_>, section: &mut Section) -> Result<(), Error> {
    let study = context.preset("fig5a", |_| Ok(()))?;
    let dataset = context.simulate(&study)?;
    let verdict = context.classify(&study)?;
    section.figures.extend(drawings(
        context,
        "5(a)",
        &dataset,
        &[
            (
                "path",
                "**Fig. 5(a), computed.** The path from left to right, with outlines at equal distances.",
            ),
            ("series", "(a) Speed, turning rate and the two deformations against time."),
            ("motion", "(a) The motion, animated."),
        ],
    )?);
    section.claims.extend([mirrored(&verdict), rightwards(&dataset), angle(&verdict)]);
    section.claims.extend(triangle(context)?);
    Ok(())
}

fn mirrored(verdict: &Verdict) -> Claim {
    let number = |value: Option<f64>| value.unwrap_or(f64::NAN);
    claim(
        &[117, 118, 165],
        "A zig-zag motion is observed at κ_2 = 0.9, κ_3 = 0.1.",
        format!(
            "{}: after half of the period {:.5} the shape is its own mirror image, so the net rotation per period is exactly \
             {}; it travels {:.3} per period. Its slowest perturbation decays at the rate {:.4}.",
            verdict.regime,
            number(verdict.period),
            number(verdict.net_rotation),
            number(verdict.drift),
            slowest(verdict)
        ),
        "Newton's method on the mirrored return; stable by its multipliers; measured before: period about 45",
        verdict.regime == Regime::Zigzag
            && verdict.net_rotation == Some(0.0)
            && verdict.period.is_some_and(|period| (period - 45.0).abs() < 1.0),
    )
}

/// The largest exponent that is not neutral.
fn slowest(verdict: &Verdict) -> f64 {
    verdict.exponents.iter().map(|e| e.value).filter(|value| *value < 0.0).fold(f64::NEG_INFINITY, f64::max)
}

fn rightwards(dataset: &Dataset) -> Claim {
    let moved = |name: &str| {
        let column = dataset.trajectory.get(name).unwrap_or(&[]);
        column.last().copied().unwrap_or(0.0) - column.first().copied().unwrap_or(0.0)
    };
    let (x, y) = (moved("x"), moved("y"));
    claim(
        &[119, 166],
        "The domain is travelling from the left to the right.",
        format!(
            "It moves by ({x:.1}, {y:.1}) within the {:.0} time units shown, at {:.0}° to the x axis.",
            dataset.manifest.outcome.outcome.t(),
            libm::atan2(y, x).to_degrees()
        ),
        "the displacement over the recording, more to the right than sideways by a factor of 2; any direction is a \
         solution, and the start chooses one",
        x > 0.0 && y.abs() < 0.5 * x,
    )
}

fn angle(verdict: &Verdict) -> Claim {
    let turns: Vec<f64> = verdict.legs.iter().map(|turn| turn.to_degrees()).collect();
    let swing = verdict.swing.map_or(f64::NAN, f64::to_degrees);
    let list: Vec<String> = turns.iter().map(|turn| format!("{turn:+.2}°")).collect();
    claim(
        &[120],
        "The angle of the zig-zag motion is about 60°.",
        format!(
            "From leg to leg the path turns by {}. The heading itself swings by {swing:.2}° from peak to peak.",
            list.join(" and ")
        ),
        "leg: the chord between consecutive corners (largest turning rate); turn: change of direction from leg to leg. It is the \
         angle that one reads off a picture, and must lie within 3° of 60°; the velocity swings further, since it overshoots \
         the chords",
        turns.len() == 2
            && turns.iter().all(|turn| (turn.abs() - ANGLE.0).abs() < ANGLE.1)
            && swing > ANGLE.0,
    )
}

/// Without the couplings to the triangle, one by one and all together.
fn triangle(context: &Context<'_>) -> Result<Vec<Claim>, Error> {
    let without = |names: &[&str]| -> Result<Regime, Error> {
        let study =
            context.preset("fig5a", |study| names.iter().try_for_each(|name| study.set(name, 0.0)))?;
        Ok(context.classify(&study)?.regime)
    };
    let all = without(&["d1", "d2", "b2"])?;
    let (d1, d2, b2) = (without(&["d1"])?, without(&["d2"])?, without(&["b2"])?);
    Ok(vec![claim(
        &[194],
        "The zig-zag is a motion of the full set of equations: the three-fold deformation matters.",
        format!(
            "Without the couplings d_1 = d_2 = b_2 = 0 the same start ends in {all} motion. Alone, d_2 = 0 gives {d2} motion, \
             b_2 = 0 {b2} motion, d_1 = 0 still {d1}: the zigzag needs the loop velocity × ellipse → triangle → ellipse \
             (d_2, b_2), not the direct drive d_1."
        ),
        "classification with these coefficients set to 0, all others kept",
        all != Regime::Zigzag && d2 != Regime::Zigzag && b2 != Regime::Zigzag && d1 == Regime::Zigzag,
    )])
}
