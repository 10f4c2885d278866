//! Exponents and the diffusion coefficient from the curve alone, without a model of the motion.

use crate::jackknife::leave_out;
use crate::{Answer, MeanSquare, four_digits};

/// An exponent over the last octaves above which the motion does not yet diffuse.
const EXPONENT: f64 = 1.35;

/// Relative difference of the slopes over the last two octaves that is still one slope.
const SAME: f64 = 0.1;

/// Half widths of 95 % intervals that are three standard errors: a difference beyond is none of chance.
const CHANCE: f64 = 1.53;

/// The exponent d ln MSD / d ln lag at the shortest lag (`first`) or over the last octave.
///
/// # Checked by  tests/all/displacement.rs
#[must_use]
pub fn local_exponent(curve: &MeanSquare, first: bool) -> Answer {
    let last = curve.len().saturating_sub(1);
    let (from, to) = if first { (0, 1.min(last)) } else { (place(curve, 0.5), last) };
    let slope = |left_out| curve.slope(from, to, left_out);
    if from == to || !slope(None).is_finite() {
        return Answer::unknown("nothing moved, or there is only one lag");
    }
    Answer::Known(leave_out(curve.groups(), slope, false))
}

/// The diffusion coefficient as a quarter of the late slope of the mean-square displacement:
///
/// D = (MSD(T) - MSD(T/2)) / (4 (T - T/2)),  T the longest lag.
///
/// What the curve lost or gained before T/2 drops out, so D holds for any motion that diffuses in the end (persistent, chiral, oscillating).
/// Not reached: the exponent over the last two octaves is above 1.35, or the slopes of these octaves differ by more than 10 % and
/// three standard errors, or the curve does not rise.
///
/// # Checked by  tests/all/displacement.rs: active Brownian (chiral and not), circle, line
#[must_use]
pub fn late_diffusion(curve: &MeanSquare) -> Answer {
    if curve.len() < 4 {
        return Answer::unknown("there are too few lags");
    }
    let (quarter, half, last) = (place(curve, 0.25), place(curve, 0.5), curve.len() - 1);
    let rise = |from: usize, to: usize, without| {
        (curve.value(to, without) - curve.value(from, without)) / (4.0 * (curve.lag(to) - curve.lag(from)))
    };
    let measured = leave_out(curve.groups(), |without| rise(half, last, without), false);
    let change =
        leave_out(curve.groups(), |without| rise(half, last, without) - rise(quarter, half, without), false);
    let exponent = curve.slope(quarter, last, None);
    let reached = format!("at the longest lag {}", four_digits(curve.lag(last)));
    if measured.value <= 0.0 || !exponent.is_finite() {
        return Answer::unknown(format!("the mean-square displacement does not rise {reached}"));
    }
    let differ = change.value.abs() > (SAME * measured.value).max(CHANCE * change.half_width());
    if exponent > EXPONENT || differ {
        return Answer::unknown(format!(
            "not reached: {reached} the mean-square displacement is not yet a straight line (exponent {exponent:.2}); record longer"
        ));
    }
    Answer::Known(measured)
}

/// The place whose lag is nearest to a part of the longest one.
fn place(curve: &MeanSquare, part: f64) -> usize {
    let aim = part * curve.lag(curve.len() - 1);
    let far = |place: &usize| (curve.lag(*place) - aim).abs();
    (0..curve.len()).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0)
}
