//! The exponent of the mean-square displacement, without a model of the motion.

use crate::jackknife::leave_out;
use crate::{Answer, MeanSquare};

/// The exponent d ln MSD / d ln lag at the shortest lag (`first`) or over the last octave.
///
/// # Checked by  tests/all/displacement.rs
pub fn local_exponent(curve: &MeanSquare, first: bool) -> Answer {
    let last = curve.len().saturating_sub(1);
    let (from, to) = if first { (0, 1.min(last)) } else { (place(curve, 0.5), last) };
    let slope = |left_out| curve.slope(from, to, left_out);
    if from == to || !slope(None).is_finite() {
        return Answer::unknown("nothing moved, or there is only one lag");
    }
    let found = leave_out(&curve.sizes(to), &slope, false);
    match found.interval {
        Some(_) => Answer::Known(found),
        None => Answer::unknown(
            "fewer than 7 bodies are watched over the longest lags; more of that length are needed",
        ),
    }
}

/// The place whose lag is nearest to a part of the longest one.
fn place(curve: &MeanSquare, part: f64) -> usize {
    let aim = part * curve.lag(curve.len() - 1);
    let far = |place: &usize| (curve.lag(*place) - aim).abs();
    (0..curve.len()).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0)
}
