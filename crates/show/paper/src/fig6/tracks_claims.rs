//! The statements of the paper about Fig. 6(a) to (d).

use super::super::claims::{claim, differs};
use super::super::context::Context;
use super::exponents::Exponents;
use super::tracks::Track;
use motiform_analysis::Regime;
use motiform_analysis::symmetry::wrap;
use motiform_figures::report::Claim;

/// Tolerance in degrees of an angle measured in a picture.
const ANGLE: f64 = 6.0;

pub(super) fn claims(context: &Context<'_>, tracks: &[Track], exponents: &Exponents) -> Vec<Claim> {
    let [a, b, c, d] = tracks else { return Vec::new() };
    let mut claims = vec![
        irregular(a, exponents),
        broad(context, a, b),
        quasi_periodic(b, exponents),
        reversing(c),
        net(d),
    ];
    claims.extend(super::boundary::claims(tracks));
    claims
}

fn irregular(a: &Track, exponents: &Exponents) -> Claim {
    let Some(found) = exponents.at(21.6) else {
        return claim(&[146, 177], "Fig. 6(a): *L* = 21.6 is chaotic.", "no exponent", "*λ*_1", false);
    };
    claim(
        &[146, 177],
        "Fig. 6(a), *L* = 21.6: the motion is apparently chaotic.",
        format!("*λ*_1 = {:.4} ± {:.4}; the classifier says: {}", found.value, found.error, a.verdict.regime),
        "Largest Lyapunov exponent from the exact tangent flow, 95 % error; chaotic if it excludes 0.",
        found.value > found.error && a.verdict.regime == Regime::Chaotic,
    )
}

fn broad(context: &Context<'_>, a: &Track, b: &Track) -> Claim {
    let (here, there) = (a.flatness().unwrap_or(f64::NAN), b.flatness().unwrap_or(f64::NAN));
    let here = context.number(here);
    claim(
        &[147, 178],
        "Its power spectrum is broad.",
        format!(
            "flatness {here:.3}, against {there:.3} for the lines of the quasi-periodic motion at *L* = 21.8"
        ),
        "Geometric over arithmetic mean of the power of 2|*φ_n*|, *n* = 2 to 4, below frequency 0.05 (one \
        Hann window over the recording); broad: over twice that of the line spectrum.",
        here > 2.0 * there,
    )
}

fn quasi_periodic(b: &Track, exponents: &Exponents) -> Claim {
    let v = &b.verdict;
    let (period, rotation) = (v.period.unwrap_or(f64::NAN), v.net_rotation.unwrap_or(f64::NAN));
    let lambda = exponents.at(21.8);
    let words = lambda.map_or(String::new(), |l| format!("; *λ*_1 = {:.4} ± {:.4}", l.value, l.error));
    claim(
        &[148, 179],
        "Fig. 6(b), *L* = 21.8: the motion is quasi-periodic.",
        format!(
            "the shape repeats after {period:.1}, turned by {:.2} degrees, which is no simple part of a turn{words}",
            rotation.to_degrees()
        ),
        "Newton's method on the return of the reduced shape; stable by its multipliers; net rotation per period not 0.",
        v.regime == Regime::QuasiPeriodic && lambda.is_none_or(|l| l.value.abs() < l.error.max(1e-3)),
    )
}

fn listed(track: &Track) -> String {
    let turns: Vec<String> = track.turns().iter().map(|turn| format!("{turn:.1}")).collect();
    format!(
        "{}; turns of {} degrees to either side, period {:.1}, drift {:.3} per period",
        track.verdict.regime,
        turns.join(" and "),
        track.verdict.period.unwrap_or(f64::NAN),
        track.verdict.drift.unwrap_or(f64::NAN)
    )
}

/// Returns `true` if the turns are exactly these.
fn turns_are(track: &Track, wanted: &[f64]) -> bool {
    let turns = track.turns();
    turns.len() == wanted.len() && turns.iter().zip(wanted).all(|(a, b)| (a - b).abs() < ANGLE)
}

/// The sums of two consecutive turns, in degrees.
fn pairs(track: &Track) -> Vec<f64> {
    track.verdict.legs.windows(2).map(|pair| wrap(pair[0] + pair[1]).to_degrees().abs()).collect()
}

fn reversing(c: &Track) -> Claim {
    let (pairs, turns) = (pairs(c), c.turns());
    let nets: Vec<String> = pairs.iter().map(|net| format!("{net:.1}")).collect();
    let [aside, back] = turns[..] else {
        let says = "Fig. 6(c), *L* = 29.2: turns of 180 and 45 degrees.";
        return claim(&[149, 150, 180], says, listed(c), "Change of heading from leg to leg.", false);
    };
    differs(
        &[149, 150, 180],
        "Fig. 6(c), *L* = 29.2: the orderly turns have almost 180° ± 45°; thus this is a kind of zigzag.",
        format!("{}; two consecutive turns together: {} degrees", listed(c), nets.join(", ")),
        "Change of heading at top speed from leg to leg (the body stops in between). 180° ± 45° of one turn \
        would be 135 degrees to either side; found must be turns of 180 and of 45 degrees, each within 6 \
        degrees, as read off a figure, and 135 for two together, within twice that",
        &format!(
            "it is a zigzag, but no single turn is 180° ± 45°: turns of {back:.0}° alternate with turns of \
            {aside:.0}° to the left or to the right. If the sentence means the sum of two consecutive \
            turns, it holds: {back:.0}° ± {aside:.0}°"
        ),
        c.verdict.regime == Regime::Zigzag
            && turns_are(c, &[45.0, 180.0])
            && !pairs.is_empty()
            && pairs.iter().all(|net| (net - 135.0).abs() < 2.0 * ANGLE),
    )
}

fn net(d: &Track) -> Claim {
    let pairs = pairs(d);
    let nets: Vec<String> = pairs.iter().map(|net| format!("{net:.1}")).collect();
    claim(
        &[149, 152, 182, 183],
        "Fig. 6(d), *L* = 29.6: on the whole the path turns by 45 degrees to either side.",
        format!("{}; two turns together: {} degrees", listed(d), nets.join(", ")),
        "As before; two consecutive turns added. 180 and 135 degrees together are the 45 degrees of the coarse-grained path.",
        d.verdict.regime == Regime::Zigzag
            && turns_are(d, &[135.0, 180.0])
            && !pairs.is_empty()
            && pairs.iter().all(|net| (net - 45.0).abs() < ANGLE),
    )
}
