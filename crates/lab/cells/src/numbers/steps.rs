//! Displacements from frame to frame: speed, path, directionality, turning.

use super::places::Places;
use super::{SIZE, averaged};
use motiform_dynamics::sample;
use motiform_inference::{Bounded, Fix};
use motiform_statistics::Measured;
use serde::Serialize;

/// Turning angles are counted in so many equal parts of the full turn.
const PARTS: usize = 12;
/// A step is of one sampling interval if its time differs from that by at most this part.
const ALIKE: f64 = 0.25;
/// A number with no bounds of its own.
const SIGNED: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
/// Longest step without a gap, in sampling intervals.
const NO_GAP: f64 = 1.5;

/// Numbers of the displacements.
///
/// # Units   of the data; angles in rad
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Steps {
    /// Displacements over one sampling interval, within a quarter of it.
    pub count: usize,
    /// Their mean length per time: the speed as it is seen at this sampling. Errors of the places raise it, turns between frames lower it.
    pub speed: Option<Measured>,
    /// Root mean square of the same, with the part of the errors, 4 sigma^2, subtracted (added where places are means over an exposure);
    /// the interval holds the error of both. `None` where no walk says how large these are.
    pub rms_speed: Option<Measured>,
    /// Length of the path, straight across gaps; of all pieces.
    pub path: f64,
    /// Net displacement, the sum over pieces.
    pub net: f64,
    /// Net displacement over path, between 0 and 1; it falls with the length of the record. `None` where nothing moved.
    pub directionality: Option<f64>,
    /// Mean cosine of the angle between displacements in a row, each over one sampling interval: 1 straight on, 0 no memory,
    /// below 0 back (errors of the places do that).
    pub turning_cosine: Option<Measured>,
    /// Mean turning rate of the displacements (rad per time), anticlockwise in the coordinates of the data: each angle over its own time.
    /// Of all steps up to one and a half sampling intervals.
    pub turning_rate: Option<Measured>,
    /// Turning angles over one sampling interval, counted in twelve equal parts from -pi to pi.
    pub turning_angles: Vec<usize>,
}

impl Steps {
    /// `error`: variance of a coordinate's error, if it is known. `None` without a displacement.
    pub(super) fn of(places: &Places, error: Option<Bounded>) -> Option<Self> {
        let pairs = || places.pieces.iter().flat_map(|piece| piece.windows(2));
        pairs().next()?;
        let path: f64 = pairs().map(|pair| length(step(&pair[0], &pair[1]))).sum();
        let ends = places.pieces.iter().filter_map(|piece| Some(length(step(piece.first()?, piece.last()?))));
        let net = ends.sum();
        let rate = |pair: &[Fix]| length(step(&pair[0], &pair[1])) / (pair[1].t - pair[0].t);
        let whole = || pairs().filter(|pair| is_whole(places, pair));
        let rates: Vec<f64> = whole().map(rate).collect();
        let squares: Vec<f64> = rates.iter().map(|rate| rate * rate).collect();
        let own = |error: Bounded| {
            let inverse = sample::mean(whole().map(|pair| (pair[1].t - pair[0].t).powi(-2)))?;
            Some(less(averaged(&squares, SIZE)?, error, 4.0 * inverse))
        };
        let no_gap = |pair: &[Fix]| pair[1].t - pair[0].t <= NO_GAP * places.interval;
        let (mut way, mut time) = (0.0, 0.0);
        for pair in pairs().filter(|pair| no_gap(pair)) {
            (way, time) = (way + length(step(&pair[0], &pair[1])), time + pair[1].t - pair[0].t);
        }
        // the directions of two displacements are those at their middles
        let turning: Vec<f64> = turns(places, no_gap).map(|(angle, time)| angle / (0.5 * time)).collect();
        let angles: Vec<f64> = turns(places, |pair| is_whole(places, pair)).map(|(angle, _)| angle).collect();
        let cosines: Vec<f64> = angles.iter().map(|angle| libm::cos(*angle)).collect();
        let mut counts = vec![0; PARTS];
        for angle in &angles {
            let part = (angle / std::f64::consts::TAU + 0.5) * PARTS as f64;
            counts[(part as usize).min(PARTS - 1)] += 1;
        }
        Some(Self {
            count: rates.len(),
            speed: averaged(&rates, SIZE).map(|speed| holding(speed, way / time)),
            rms_speed: error.and_then(own),
            path,
            net,
            directionality: (path > 0.0).then(|| net / path),
            turning_cosine: averaged(&cosines, [-1.0, 1.0]),
            turning_rate: averaged(&turning, SIGNED),
            turning_angles: counts,
        })
    }
}

/// The root of a mean square without `times` the variance of an error; no interval where that of the error has an open end.
fn less(square: Measured, error: Bounded, times: f64) -> Measured {
    let value = square.value - times * error.value;
    let end = |[low, high]: [f64; 2]| {
        let down = libm::hypot(square.value - low, times * (error.high? - error.value));
        let up = libm::hypot(high - square.value, times * (error.value - error.low?));
        Some([value - down, value + up])
    };
    let root = |square: f64| square.max(0.0).sqrt();
    Measured { value, interval: square.interval.and_then(end) }.map(root)
}

/// The mean with an interval that also holds the path over its time, which errors of the times between frames do not change: these raise
/// the mean of quotients, and choose the steps of one sampling interval. At even times both are the same.
fn holding(mean: Measured, other: f64) -> Measured {
    let wider = |[low, high]: [f64; 2]| {
        if other.is_finite() { [low.min(other), high.max(other)] } else { [low, high] }
    };
    Measured { interval: mean.interval.map(wider), ..mean }
}

fn step(from: &Fix, to: &Fix) -> [f64; 2] {
    [to.at[0] - from.at[0], to.at[1] - from.at[1]]
}

fn length(step: [f64; 2]) -> f64 {
    libm::hypot(step[0], step[1])
}

/// `true` of a step of one sampling interval.
fn is_whole(places: &Places, pair: &[Fix]) -> bool {
    ((pair[1].t - pair[0].t) / places.interval - 1.0).abs() <= ALIKE
}

/// Angles between displacements in a row, both of such steps, and the time of both together; displacements of length 0 have none.
fn turns(places: &Places, is_meant: impl Fn(&[Fix]) -> bool) -> impl Iterator<Item = (f64, f64)> {
    let one = move |pair: &[Fix]| is_meant(pair) && pair[0].at != pair[1].at;
    let triples = places.pieces.iter().flat_map(|piece| piece.windows(3));
    triples.filter(move |three| one(&three[..2]) && one(&three[1..])).map(|three| {
        let (a, b) = (step(&three[0], &three[1]), step(&three[1], &three[2]));
        let angle = libm::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
        (angle, three[2].t - three[0].t)
    })
}
