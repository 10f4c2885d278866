//! First-passage times out of discs.

use crate::survival::{Duration, MeanTime, mean_time};
use crate::{MeanSquare, Tracks};
use serde::Serialize;

/// Starting times per unit, evenly spaced.
const STARTS: usize = 64;

/// Number of radii that are chosen.
const RADII: usize = 6;

/// The time to leave a disc.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Passage {
    /// Radius of the disc.
    pub radius: f64,
    /// The mean time.
    #[serde(flatten)]
    pub time: MeanTime,
}

/// Radii for which there is something to see: from the root-mean-square displacement of four samples to that
/// of a quarter of the longest lag, with equal ratios; none where nothing moved.
pub fn radii(curve: &MeanSquare) -> Vec<f64> {
    let last = curve.len().saturating_sub(1);
    let at = |part: f64| {
        let aim = part * curve.lag(last);
        let place = (0..=last).find(|&place| curve.lag(place) >= aim).unwrap_or(last);
        curve.measured(place).value.sqrt()
    };
    if curve.is_empty() || curve.measured(0).value <= 0.0 {
        return Vec::new();
    }
    let (least, most) = (curve.measured(3.min(last)).value.sqrt(), at(0.25));
    if most <= 1.05 * least {
        return vec![least];
    }
    let step = libm::log(most / least) / (RADII - 1) as f64;
    (0..RADII).map(|k| least * libm::exp(step * k as f64)).collect()
}

/// Times until a body is first farther than r from where it was, for each radius r (increasing), from 64 starting times along each unit.
///
/// Between two samples the path is taken as straight. A body that is rough between samples (diffusion) is seen to leave too late: for
/// Brownian motion as if the disc were larger by 0.583 sqrt(2 D dt) (Chernoff and Petkau 1976). Starting times near the end of a unit
/// or before a gap are watched for less long, which [`mean_time`] accounts for.
///
/// # Checked by  tests/all/passage.rs: Brownian motion, r^2/(4 D); straight and circular motion
pub fn first_passages(tracks: &Tracks, radii: &[f64]) -> Vec<Passage> {
    let mut found: Vec<Vec<Duration>> = vec![Vec::new(); radii.len()];
    for (unit, track) in tracks.units().iter().enumerate() {
        let path = &track.position;
        let starts = STARTS.min(path.len() / 2);
        for k in 0..starts {
            let start = k * (path.len() - 1) / starts;
            let watched = path[start..].iter().take_while(|p| !p[0].is_nan() && !p[1].is_nan()).count();
            if watched < 2 {
                continue;
            }
            let group = tracks.group(unit);
            for (durations, (steps, ended)) in
                found.iter_mut().zip(leave(&path[start..start + watched], radii))
            {
                durations.push(Duration { time: steps * tracks.dt(), ended, group });
            }
        }
    }
    let mean = |(&radius, durations): (&f64, &Vec<Duration>)| {
        Some(Passage { radius, time: mean_time(durations, tracks.groups())? })
    };
    radii.iter().zip(&found).filter_map(mean).collect()
}

/// The times, in samples, at which a path first leaves each disc about its start, and `false` with the length
/// of the path where it does not.
fn leave(path: &[[f64; 2]], radii: &[f64]) -> Vec<(f64, bool)> {
    let mut left = Vec::with_capacity(radii.len());
    for place in 1..path.len() {
        while let Some(&radius) = radii.get(left.len()) {
            let Some(part) = crossing(path[0], [path[place - 1], path[place]], radius) else { break };
            left.push(((place - 1) as f64 + part, true));
        }
        if left.len() == radii.len() {
            return left;
        }
    }
    left.resize(radii.len(), ((path.len() - 1) as f64, false));
    left
}

/// The part of a step from inside a circle at which it is crossed outwards; `None` if the step ends inside.
fn crossing(centre: [f64; 2], step: [[f64; 2]; 2], radius: f64) -> Option<f64> {
    let [a, b] = step.map(|p| [p[0] - centre[0], p[1] - centre[1]]);
    if b[0] * b[0] + b[1] * b[1] <= radius * radius {
        return None;
    }
    let d = [b[0] - a[0], b[1] - a[1]];
    // |a + s d|^2 = r^2
    let (square, half) = (d[0] * d[0] + d[1] * d[1], a[0] * d[0] + a[1] * d[1]);
    let rest = a[0] * a[0] + a[1] * a[1] - radius * radius;
    let root = (half * half - square * rest).max(0.0).sqrt();
    Some(((root - half) / square).clamp(0.0, 1.0))
}
