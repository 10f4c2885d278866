//! Legs and turns of a noisy path.

use super::super::course::place;
use super::super::measures::{Measures, Series};
use super::Finding;
use super::rests::{displacements, fast};
use motiform_analysis::symmetry::wrap;
use motiform_dynamics::sample::median;
use serde::Serialize;

/// A turn is larger than this (rad), and than this many errors of each heading.
const LEAST_TURN: f64 = 0.3;
const CLEAR: f64 = 4.0;
/// Largest error of the heading of half a fast displacement (rad).
const UNCLEAR: f64 = 0.3;

/// The legs of a record: it bends to one side, then to the other.
///
/// The unwrapped heading has extremes: it turns back by more than the least turn after each. Between two extremes is a turn; its corner
/// is where the heading first is half-way, on a straight line between two samples. A leg is the path between two corners; its length is
/// that of the chord. A path that bends to one side alone has none. Displacements whose heading is not known, as those of rests, have
/// none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ObservedLegs {
    /// Smallest turn that counts (rad): 0.3, and at least four errors of the heading of half a fast displacement.
    pub least_turn: f64,
    /// Time over which displacements are taken: the least over which four errors of the heading of half a fast displacement (95 % quantile)
    /// are below 0.3 rad; at most a twentieth of the record.
    pub step: f64,
    /// Number of corners.
    pub corners: usize,
    /// Median length of the legs; `None` below two corners.
    pub length: Option<f64>,
    /// Median duration of the legs.
    pub duration: Option<f64>,
    /// Median size of the change of heading at a corner (rad): the heading swing.
    pub swing: Option<f64>,
    /// Median size of the angle between the chords of neighbouring legs (rad), which is smaller.
    pub turn: Option<f64>,
}

pub(super) fn of(measures: &Measures) -> Finding<ObservedLegs> {
    let (series, error) = (&measures.series, measures.displacement_error);
    let most = (series.frames.len() / 20).max(1);
    // a heading over a displacement has this error over its length
    let along = error / std::f64::consts::SQRT_2;
    let half = |lag: usize| 0.5 * fast(&displacements(series, lag));
    let lag = (1..=most).find(|lag| LEAST_TURN * half(*lag) >= CLEAR * along).unwrap_or(most);
    let unclear = along / half(lag).max(f64::MIN_POSITIVE);
    if unclear > UNCLEAR {
        return Finding::missing(format!("headings have errors of {unclear:.2} rad; {UNCLEAR} is the most"));
    }
    let least_turn = LEAST_TURN.max(CLEAR * unclear);
    let known = headings(series, lag, CLEAR * along / least_turn);
    let ends = extremes(&known.iter().map(|one| one.1).collect::<Vec<_>>(), least_turn);
    let corners: Vec<f64> = ends.windows(2).map(|pair| halfway(&known[pair[0]..=pair[1]])).collect();
    let swings = ends.windows(2).map(|pair| (known[pair[1]].1 - known[pair[0]].1).abs());
    let place = |at: f64| place(&series.frames, at);
    let chord = |pair: &[f64]| [0, 1].map(|k| place(pair[1])[k] - place(pair[0])[k]);
    let legs: Vec<[f64; 2]> = corners.windows(2).map(chord).collect();
    let angle = |leg: &[f64; 2]| libm::atan2(leg[1], leg[0]);
    let turns = legs.windows(2).map(|pair| wrap(angle(&pair[1]) - angle(&pair[0])).abs());
    let length = median(legs.iter().map(|leg| libm::hypot(leg[0], leg[1])));
    if let Some(length) = length.filter(|length| *length <= CLEAR * error) {
        return Finding::missing(format!(
            "the median leg is {:.1} of its errors long; more than 4 are needed",
            length / error
        ));
    }
    Finding::Found(ObservedLegs {
        least_turn,
        step: lag as f64 * series.dt,
        corners: corners.len(),
        length,
        duration: median(corners.windows(2).map(|pair| (pair[1] - pair[0]) * series.dt)),
        swing: median(swings),
        turn: median(turns),
    })
}

/// Unwrapped headings of the displacements over `lag` frames that are `least` long, each at its middle, as a place along the frames.
fn headings(series: &Series, lag: usize, least: f64) -> Vec<(f64, f64)> {
    let mut known: Vec<(f64, f64)> = Vec::new();
    for (k, pair) in series.frames.windows(lag + 1).enumerate() {
        let [x, y] = [0, 1].map(|axis| pair[lag].y[axis] - pair[0].y[axis]);
        if libm::hypot(x, y) >= least && (x, y) != (0.0, 0.0) {
            let heading = libm::atan2(y, x);
            let unwrapped = known.last().map_or(heading, |last| last.1 + wrap(heading - last.1));
            known.push((k as f64 + 0.5 * lag as f64, unwrapped));
        }
    }
    known
}

/// Alternating maxima and minima that lie more than `least` from each other; the first and the last sample are none.
fn extremes(values: &[f64], least: f64) -> Vec<usize> {
    let mut found = Vec::new();
    let (mut low, mut high, mut rising) = (0, 0, None);
    for (i, &value) in values.iter().enumerate() {
        if value > values[high] {
            high = i;
        }
        if value < values[low] {
            low = i;
        }
        let (fell, rose) = (values[high] - value > least, value - values[low] > least);
        if fell && rising != Some(false) {
            found.extend(rising.map(|_| high));
            (rising, low) = (Some(false), i);
        } else if rose && rising != Some(true) {
            found.extend(rising.map(|_| low));
            (rising, high) = (Some(true), i);
        }
    }
    found
}

/// The place at which values first cross the middle between the first and the last of them. A turn within one sample is crossed half-way:
/// neither sample is nearer, and which one is would be a matter of round-off.
fn halfway(values: &[(f64, f64)]) -> f64 {
    let ends = [values[0].1, values[values.len() - 1].1];
    let middle = 0.5 * (ends[0] + ends[1]);
    let before = |value: f64| (value - middle) * (ends[0] - middle) > 0.0;
    let crossing = values.windows(2).find(|pair| before(pair[0].1) && !before(pair[1].1));
    crossing.map_or(values[0].0, |pair| {
        let part = (middle - pair[0].1) / (pair[1].1 - pair[0].1);
        pair[0].0 + part * (pair[1].0 - pair[0].0)
    })
}

#[cfg(test)]
mod tests {
    use super::extremes;

    #[test]
    fn extremes_are_those_that_the_values_turn_back_from() {
        let values = [0.0, 1.0, 0.9, 1.1, -1.0, -0.9, -1.2, 2.0, 1.9, 0.0];
        assert_eq!(extremes(&values, 0.5), [3, 6, 7]);
        assert_eq!(extremes(&values, 2.2), [6], "the first rise is smaller, the last fall too");
        let rising: Vec<f64> = (0..50).map(f64::from).collect();
        assert!(extremes(&rising, 0.5).is_empty());
    }
}
