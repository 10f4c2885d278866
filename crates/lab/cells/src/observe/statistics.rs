//! Common statistics of tracked cells: mean-square displacement, persistence, autocorrelations of velocity and shape, with errors.

use super::measures::Series;
use crate::numbers::{WalkNumbers, by_place};
use motiform_inference::{Observation, Scales};
use motiform_statistics::{
    Answer, Autocorrelation, Errors, MeanSquare, Measured, Quantity, Track, Tracks, autocorrelation,
    mean_square,
};
use serde::Serialize;

/// A value at a lag.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AtLag {
    /// The lag (unit of time).
    pub lag: f64,
    /// The value with its 95 % interval.
    #[serde(flatten)]
    pub value: Measured,
}

/// An autocorrelation, and how long it lasts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Memory {
    /// Velocity, z2 or z3.
    pub quantity: String,
    /// rho at lags from 0.
    pub correlation: Vec<AtLag>,
    /// The integral correlation time, or why there is none.
    pub time: Answer,
}

/// Statistics of one record or of a population. Definitions: docs/statistics.md.
///
/// # Units   of the data
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MotionStatistics {
    /// The units that intervals refer to: blocks of the record, or cells.
    pub errors: Errors,
    /// Mean-square displacement, the part of the measurement errors subtracted.
    pub displacement: Vec<AtLag>,
    /// The persistent random walk, where it describes the paths: that of the numbers without a model.
    pub walk: WalkNumbers,
    /// Autocorrelations of velocity, z2 and z3; errors of measurement lower them by their share of the variance.
    pub memories: Vec<Memory>,
}

/// Statistics of records at one sampling interval, whatever their order; `None` where they are too short.
pub(super) fn of_records<'s>(
    records: impl Iterator<Item = &'s Series>,
    walk: WalkNumbers,
) -> Option<MotionStatistics> {
    let mut records: Vec<&Series> = records.collect();
    let place = |series: &Series| series.frames.first().map_or([0.0; 2], |frame| [frame.y[0], frame.y[1]]);
    records.sort_by(|a, b| a.frames.len().cmp(&b.frames.len()).then_with(|| by_place(place(a), place(b))));
    let Series { dt, unit, .. } = records.first()?;
    let dt = *dt;
    let noise: Vec<f64> = records.iter().flat_map(|series| series.frames.iter().map(variance)).collect();
    let bodies = records.iter().map(|series| track(series)).collect();
    let tracks =
        Tracks::of_records(dt, ["z2", "z3"].map(str::to_owned).to_vec(), bodies).ok()?.with_times_in(unit);
    let square = mean_square(&tracks).less(2.0 * noise.iter().sum::<f64>() / noise.len() as f64);
    let wanted = |quantity: &Quantity| matches!(quantity, Quantity::Velocity | Quantity::Mode(..));
    let memories = tracks.quantities().into_iter().filter(wanted);
    let extent = extent(&records);
    let seen: Vec<_> =
        records.iter().map(|series| motiform_inference::Track(series.frames.clone())).collect();
    let signal = Scales::of(&seen, 3).signal;
    let known = |quantity: Quantity| {
        let found = memory(autocorrelation(&tracks, &quantity).ok()?);
        let varies = tracks.bodies().iter().any(|body| {
            let unit = if quantity == Quantity::Velocity { dt } else { 1.0 };
            quantity.size(body).iter().any(|size| size * unit > ROUND_OFF * extent)
        });
        let time = match quantity {
            _ if !varies => Answer::unknown("it does not vary beyond round-off"),
            Quantity::Mode(number, _) if signal[number + 1] < 1.0 => {
                Answer::unknown("it does not exceed the errors of the outlines")
            }
            _ => found.time,
        };
        Some(Memory { time, ..found })
    };
    let memories: Option<Vec<Memory>> = memories.map(known).collect();
    Some(MotionStatistics {
        errors: tracks.errors(),
        displacement: points(&square),
        walk,
        memories: memories?,
    })
}

/// Part of the largest coordinate below which displacements and modes are those of round-off.
const ROUND_OFF: f64 = 1e-10;

/// The largest coordinate.
fn extent(records: &[&Series]) -> f64 {
    let frames = records.iter().flat_map(|series| &series.frames);
    frames.flat_map(|frame| [frame.y[0].abs(), frame.y[1].abs()]).fold(0.0, f64::max)
}

/// Variance of the position, both coordinates.
fn variance(frame: &Observation) -> f64 {
    frame.covariance[0][0] + frame.covariance[1][1]
}

/// Velocities by displacements over the record's step, positions and modes at their middle.
fn track(series: &Series) -> Track {
    let count = series.speeds.len();
    let middle = &series.frames[series.lag / 2..][..count];
    let velocity = series.speeds.iter().zip(&series.headings);
    let pair = |at: usize| middle.iter().map(|frame| [frame.y[at], frame.y[at + 1]]).collect::<Vec<_>>();
    Track {
        position: pair(0),
        velocity: velocity.map(|(v, angle)| [v * libm::cos(*angle), v * libm::sin(*angle)]).collect(),
        modes: vec![pair(2), pair(4)],
        rates: Vec::new(),
    }
}

fn points(curve: &MeanSquare) -> Vec<AtLag> {
    let point = |place| AtLag { lag: curve.lag(place), value: curve.measured(place) };
    (0..curve.len()).map(point).collect()
}

fn memory(found: Autocorrelation) -> Memory {
    let pairs = found.lags.into_iter().zip(found.correlation);
    Memory {
        quantity: found.quantity.name().to_owned(),
        correlation: pairs.map(|(lag, value)| AtLag { lag, value }).collect(),
        time: found.time,
    }
}
