//! Legs and turns of a noisy path.

use super::super::measures::{Measures, Series};
use super::{Finding, middles};
use motiform_analysis::symmetry::wrap;
use motiform_dynamics::sample::median;
use serde::Serialize;

/// A turn is larger than this (rad), and than this many errors of the heading.
const LEAST_TURN: f64 = 0.3;
const CLEAR: f64 = 4.0;
/// Largest error of a heading (rad).
const UNCLEAR: f64 = 0.3;

/// The legs of a record: it bends to one side, then to the other.
///
/// The unwrapped heading has extremes: it turns back by more than the least turn after each. Between two extremes is a turn; its corner
/// is where the heading is half-way. A leg is the path between two corners; its length is that of the chord. A path that bends to one
/// side alone has none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ObservedLegs {
    /// Smallest turn that counts (rad): 0.3, and at least four errors of the heading.
    pub least_turn: f64,
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
    let series = &measures.series;
    let error = measures.heading_error();
    if error > UNCLEAR {
        return Finding::missing(format!("headings have errors of {error:.2} rad; {UNCLEAR} is the most"));
    }
    let least_turn = LEAST_TURN.max(CLEAR * error);
    let ends = extremes(&series.headings, least_turn);
    let corners: Vec<usize> =
        ends.windows(2).map(|pair| halfway(&series.headings, pair[0], pair[1])).collect();
    let swings = ends.windows(2).map(|pair| (series.headings[pair[1]] - series.headings[pair[0]]).abs());
    let legs: Vec<[f64; 2]> = corners.windows(2).map(|pair| chord(series, pair[0], pair[1])).collect();
    let angle = |leg: &[f64; 2]| libm::atan2(leg[1], leg[0]);
    let turns = legs.windows(2).map(|pair| wrap(angle(&pair[1]) - angle(&pair[0])).abs());
    Finding::Found(ObservedLegs {
        least_turn,
        corners: corners.len(),
        length: median(legs.iter().map(|leg| libm::hypot(leg[0], leg[1]))),
        duration: median(corners.windows(2).map(|pair| (pair[1] - pair[0]) as f64 * series.dt)),
        swing: median(swings),
        turn: median(turns),
    })
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

/// The sample between two at which the value is nearest to the middle of theirs.
fn halfway(values: &[f64], from: usize, to: usize) -> usize {
    let middle = 0.5 * (values[from] + values[to]);
    let distance = |i: &usize| (values[*i] - middle).abs();
    (from..=to).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(from)
}

fn chord(series: &Series, from: usize, to: usize) -> [f64; 2] {
    let frames = middles(series);
    [0, 1].map(|k| frames[to].y[k] - frames[from].y[k])
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
