//! Corners, legs and turning angles of a path: the angles that people read off a picture, defined.

mod corners;
mod path;

use crate::{Error, Result};
use corners::{REST, bends, headings, stops, top_speed};
pub use path::{Ends, PathSample};
use path::{check, continued, place, wrapped};

/// Periods that are looked at for one. Its corners are those of the second; a single corner needs its leg to the third and
/// that one's leg to the fourth, and a stop at the end of the fourth is known to be one only when the body moves again.
const COPIES: usize = 5;

/// The cause of the corners of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CornerKind {
    /// The body stops and goes.
    Stop,
    /// The body keeps its speed and turns.
    Bend,
}

/// The path between two consecutive corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leg {
    /// Time of the corner it begins at.
    pub t_start: f64,
    /// Time of the corner it ends at.
    pub t_end: f64,
    /// Distance of the corners (the chord).
    pub length: f64,
    /// Direction of the chord, rad in (-pi, pi].
    pub direction: f64,
    /// Heading where the speed is largest, rad in (-pi, pi].
    pub heading: f64,
}

/// The corners and legs of a path.
#[derive(Debug, Clone, PartialEq)]
pub struct Legs {
    /// Peak to peak of the unwrapped heading, rad.
    pub swing: f64,
    /// The cause of its corners; `None` if there are none.
    pub kind: Option<CornerKind>,
    /// Times of the corners, growing.
    pub corners: Vec<f64>,
    /// Between consecutive corners; for a period as many as corners, else one less.
    pub legs: Vec<Leg>,
    /// Change of direction from each leg to the next one, rad in (-pi, pi]; for a period as many as legs, else one less.
    pub turns: Vec<f64>,
    /// Change of heading between the speed maxima of each leg and the next one; only for stops.
    pub heading_turns: Vec<f64>,
}

/// Turning angles and legs of a path.
///
/// * *Heading*: angle of the velocity. *Heading swing*: peak to peak of the unwrapped heading over the stretch. Where the
///   body reverses (the heading jumps by more than 3 pi/4 between two samples) the sense of the jump is round-off: it is
///   taken back into the range of headings seen so far, so that going to and fro has the swing pi however long it goes on.
/// * *Corner*: a minimum of the speed below half of the smaller of the adjacent maxima (stop and go). Where the
///   speed has none: the largest |turning rate| between two zeros of the turning rate (below 1 % of its maximum it is
///   zero). Motion on a circle has no corner.
/// * *Leg*: path between consecutive corners. *Direction*: that of its chord. *Turn*: signed change of direction from one
///   leg to the next, counter-clockwise positive. *Heading turn*, for stops: change of the heading at top speed, which is
///   the angle the paper gives for turns.
///
/// The zigzag of a sine-like path with heading amplitude A has the swing 2 A, and turns that are smaller: the slope of
/// the chord against that of the path. That is why angles read off a picture differ from the swing.
///
/// Source: definitions of motiform (the paper gives angles without one).
///
/// # Shapes    at least 8 samples; some 100 per leg make angles good to about 1e-4 rad
/// # Units     angles in rad, lengths and times those of the samples
/// # Errors    [`Error::TooFew`], [`Error::Order`], [`Error::NotFinite`], [`Error::OutOfRange`] for the input;
/// [`Error::AtRest`] without any motion; [`Error::ClosedLeg`] for a leg that ends where it began
/// # Not       for noisy velocities: every wiggle of the turning rate is a bend
/// # Checked by  tests/all/legs.rs: square with stops, triangle wave, sinusoidal heading (Bessel function), reversal, rotated
/// input, periods with net rotation
pub fn legs(path: &[PathSample], ends: Ends) -> Result<Legs> {
    check(path, ends)?;
    let swing = swing(path);
    let (whole, period) = match ends {
        Ends::Open => (path.to_vec(), None),
        Ends::Periodic { rotation } => {
            (continued(path, rotation, COPIES), Some(path[path.len() - 1].t - path[0].t))
        }
    };
    let mut times = stops(&whole);
    let mut kind = Some(CornerKind::Stop);
    if times.is_empty() {
        times = bends(&whole);
        kind = (!times.is_empty()).then_some(CornerKind::Bend);
    }
    let count = match period {
        None => times.len(),
        Some(period) => one_period(&mut times, path[0].t, period),
    };
    let mut legs = legs_between(&whole, &times)?;
    let turn = |angle: fn(&Leg) -> f64| {
        legs.windows(2).map(|pair| wrapped(angle(&pair[1]) - angle(&pair[0]))).collect()
    };
    let turns = turn(|leg| leg.direction);
    let heading_turns = if kind == Some(CornerKind::Stop) { turn(|leg| leg.heading) } else { Vec::new() };
    times.truncate(count);
    if let Some(period) = period {
        legs.truncate(count);
        shift(&mut times, &mut legs, period);
    }
    Ok(Legs { swing, kind: kind.filter(|_| !times.is_empty()), corners: times, legs, turns, heading_turns })
}

/// Peak to peak of the unwrapped heading.
fn swing(path: &[PathSample]) -> f64 {
    let headings = headings(path);
    let ends = headings.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), h| (a.min(h.1), b.max(h.1)));
    ends.1 - ends.0
}

/// Keeps the corners of the second period and the two after it (for the last leg and its turn); the number of the former.
fn one_period(times: &mut Vec<f64>, start: f64, period: f64) -> usize {
    let first = times.partition_point(|&t| t < start + period * (1.0 - 1e-9));
    times.drain(..first);
    let Some(&begin) = times.first() else { return 0 };
    // a corner and the same one a period later differ by rounding
    let count = times.partition_point(|&t| t < begin + period * (1.0 - 1e-6));
    times.truncate(count + 2);
    count
}

fn shift(times: &mut [f64], legs: &mut [Leg], period: f64) {
    for t in times {
        *t -= period;
    }
    for leg in legs {
        leg.t_start -= period;
        leg.t_end -= period;
    }
}

fn legs_between(path: &[PathSample], times: &[f64]) -> Result<Vec<Leg>> {
    let leg = |pair: &[f64]| {
        let (t_start, t_end) = (pair[0], pair[1]);
        let ([x0, y0], [x1, y1]) = (place(path, t_start), place(path, t_end));
        let (dx, dy) = (x1 - x0, y1 - y0);
        let inside = path.iter().filter(|sample| sample.t > t_start && sample.t < t_end);
        let fastest = inside.max_by(|a, b| a.speed().total_cmp(&b.speed()));
        let length = libm::hypot(dx, dy);
        match fastest {
            Some(top) if length > REST * top_speed(path) * (t_end - t_start) => {
                Ok(Leg { t_start, t_end, length, direction: libm::atan2(dy, dx), heading: top.heading() })
            }
            _ => Err(Error::ClosedLeg { t_start, t_end }),
        }
    };
    times.windows(2).map(leg).collect()
}
