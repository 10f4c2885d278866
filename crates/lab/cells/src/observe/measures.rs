//! Numbers of a record: displacements, headings, shapes, with errors from blocks.

use super::course;
use motiform_analysis::symmetry::wrap;
use motiform_dynamics::Normal;
use motiform_dynamics::sample;
use motiform_inference::{Observation, Track};
use motiform_statistics::four_digits;
use serde::Serialize;

/// Resamples of the record.
pub(super) const RESAMPLES: usize = 200;
/// Blocks of a record.
pub(super) const BLOCKS: usize = 8;
/// A displacement has a heading where it is this many times its error.
const CLEAR: f64 = 5.0;
/// Fewest samples of a stretch without gaps.
const LEAST: usize = 40;
/// Times that differ from the usual interval by at most this part are taken as evenly spaced: speeds are wrong by as much, and a steady
/// speed may scatter by a quarter.
const EVEN: f64 = 0.05;
/// The same for a frame that is no gap.
const NO_GAP: f64 = 0.5;

/// Numbers of a record (times and lengths in the units of the data).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Measures {
    /// Frames of the stretch without gaps that they are from.
    pub frames: usize,
    /// Times of its first and last frame.
    pub span: [f64; 2],
    /// Its duration.
    pub duration: f64,
    /// Sampling interval times the step over which displacements are taken: headings are clear there.
    pub step: f64,
    /// Root mean square of the displacements over a step, corrected for their errors, and the error of one displacement.
    pub displacement: f64,
    /// See `displacement`.
    pub displacement_error: f64,
    /// Root mean square distance from the mean place, in units of its errors.
    pub wandering: f64,
    /// Mean speed, by displacements over a step.
    pub speed: f64,
    /// Scatter of the speed, relative to its mean, corrected for errors.
    pub speed_scatter: f64,
    /// Change of the speed from the first to the last block of the record by a straight line, relative to its mean; 0 where that is
    /// within 4 of its errors.
    pub speed_trend: f64,
    /// Amplitude, relative to its mean, of the speed as a function of the axis along which the cell moves (twice per turn); 0 where that is
    /// within 4 of its errors.
    pub speed_axis: f64,
    /// Mean turning rate of the heading (rad per time), and its standard error from the scatter of turns over up to an eighth of the
    /// record.
    pub turning: f64,
    /// See `turning`.
    pub turning_error: f64,
    /// Scatter of the turning rate between blocks, relative to its mean, corrected for errors of the headings.
    pub turning_scatter: f64,
    /// Velocity of the place to which a turning cell comes back after each full turn (length per time), and its error from the scatter of
    /// the turns; `None` with fewer than four of them.
    pub drift: Option<[f64; 2]>,
    /// Share of the time in which the heading turns by less than a quarter of what it turns by on average: of all windows in which that is
    /// an eighth of half a turn. Near 0 on a circle, more than a half on a square.
    pub straight_share: f64,
    /// Scatter of the heading (rad).
    pub heading_scatter: f64,
    /// Scatter of |z2| and |z3|, relative to the size of both, corrected for errors.
    pub shape_scatter: f64,
    /// Changes of z2 or z3 over time, in units of their errors, along the direction in which they are clearest.
    pub shape_change: f64,
    /// Root mean square deviation of the shape (z2 and z3 together) from its mean, without that of errors (length).
    pub shape_wobble: f64,
    /// Size of the mean of z2 and z3 together (length).
    pub mean_shape: f64,
    /// Net displacement divided by the length of the path.
    pub directness: f64,
    /// Length of the path.
    pub length: f64,
    #[serde(skip)]
    pub(super) series: Series,
}

/// The series that the numbers are from: one value per step.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Series {
    pub(super) dt: f64,
    /// Its unit, after a number.
    pub(super) unit: String,
    pub(super) lag: usize,
    pub(super) frames: Vec<Observation>,
    pub(super) headings: Vec<f64>,
    pub(super) speeds: Vec<f64>,
    /// Turning rates of the blocks.
    blocks: Vec<f64>,
}

impl Measures {
    /// Of the longest stretch without gaps; `None` if it is too short.
    pub(super) fn of(track: &Track, unit: &str) -> Option<Self> {
        let dt = track.interval();
        let frames = longest(&track.0, dt, EVEN);
        if frames.len() < LEAST {
            return None;
        }
        let frames = frames.to_vec();
        let lag = step(&frames);
        let moves: Vec<[f64; 2]> = frames
            .windows(lag + 1)
            .map(|pair| [pair[lag].y[0] - pair[0].y[0], pair[lag].y[1] - pair[0].y[1]])
            .collect();
        let time = lag as f64 * dt;
        let sizes: Vec<f64> = moves.iter().map(|m| libm::hypot(m[0], m[1])).collect();
        let noise = 2.0 * mean(frames.iter().map(|f| f.covariance[0][0] + f.covariance[1][1]));
        let square = mean(sizes.iter().map(|s| s * s));
        let mut headings: Vec<f64> = Vec::with_capacity(moves.len());
        for m in &moves {
            let angle = libm::atan2(m[1], m[0]);
            headings.push(headings.last().map_or(angle, |&last| last + wrap(angle - last)));
        }
        let blocks = rates(&headings, dt);
        let (turning, spread) = (mean(blocks.iter().copied()), scatter(&blocks));
        // the part of the errors of two headings, which are those of their displacements
        let size = ((headings.len() - 1) / BLOCKS).max(1) as f64 * dt;
        let own = if square > noise { noise / (square - noise) / (size * size) } else { 0.0 };
        let ends = [frames.first()?, frames.last()?];
        let net = libm::hypot(ends[1].y[0] - ends[0].y[0], ends[1].y[1] - ends[0].y[1]);
        let length: f64 = sizes.iter().step_by(lag).sum();
        let mean_size = mean(sizes.iter().copied());
        let size_variance = (scatter(&sizes) * scatter(&sizes) - 0.5 * noise).max(0.0);
        let speeds: Vec<f64> = sizes.iter().map(|s| s / time).collect();
        Some(Self {
            frames: frames.len(),
            span: ends.map(|frame| frame.t),
            duration: (frames.len() - 1) as f64 * dt,
            step: time,
            displacement: (square - noise).max(0.0).sqrt(),
            displacement_error: noise.sqrt(),
            wandering: wandering(&frames),
            speed: mean_size / time,
            speed_scatter: size_variance.sqrt() / mean_size.max(f64::MIN_POSITIVE),
            speed_trend: course::trend(&speeds),
            speed_axis: course::axis(&speeds, &headings),
            turning,
            turning_error: course::turning_error(&headings, dt, turning),
            turning_scatter: (spread * spread - own).max(0.0).sqrt() / turning.abs().max(f64::MIN_POSITIVE),
            drift: course::drift(&frames, &headings, lag, turning, dt),
            straight_share: straight_share(&headings, turning * dt),
            heading_scatter: scatter(&headings),
            shape_scatter: shape_scatter(&frames),
            shape_change: shape_change(&frames),
            shape_wobble: shape_wobble(&frames),
            mean_shape: mean_shape(&frames),
            directness: net / length.max(f64::MIN_POSITIVE),
            length,
            series: Series { dt, unit: unit.to_owned(), lag, frames, headings, speeds, blocks },
        })
    }

    /// Error of the heading of one displacement (rad).
    pub(super) fn heading_error(&self) -> f64 {
        self.displacement_error / (std::f64::consts::SQRT_2 * self.displacement.max(f64::MIN_POSITIVE))
    }

    /// Time in which the heading forgets its direction beside the steady turn: 1/D, with the diffusion D that the error of the mean turning
    /// rate over the duration T has, `sqrt(2 D/T)`.
    pub(super) fn heading_memory(&self) -> f64 {
        2.0 / (self.turning_error * self.turning_error * self.duration).max(f64::MIN_POSITIVE)
    }

    /// The same numbers with blocks of the record drawn with replacement: turning rate and its error, scatter of the speed.
    pub(super) fn resampled(&self) -> impl Iterator<Item = Self> + '_ {
        let mut random = Normal::new(1, 0);
        // blocks side by side share errors of headings: their scatter is brought to the error of the rate
        let own = scatter(&self.series.blocks) / (self.series.blocks.len().max(1) as f64).sqrt();
        let part = if own > 0.0 { self.turning_error / own } else { 0.0 };
        let mut pick = move |n: usize| ((random.uniform() * n as f64) as usize).min(n - 1);
        (0..RESAMPLES).map(move |_| {
            let blocks = &self.series.blocks;
            let drawn: Vec<f64> = blocks.iter().map(|_| blocks[pick(blocks.len())]).collect();
            let size = (self.series.speeds.len() / BLOCKS).max(1);
            let starts: Vec<usize> = (0..BLOCKS).map(|_| pick(self.series.speeds.len() - size + 1)).collect();
            let speeds: Vec<f64> = starts
                .iter()
                .flat_map(|&start| self.series.speeds[start..start + size].iter().copied())
                .collect();
            let turning = self.turning + part * (mean(drawn.iter().copied()) - self.turning);
            let ratio = (scatter(&speeds) / mean(speeds.iter().copied()).max(f64::MIN_POSITIVE))
                / (scatter(&self.series.speeds) / self.speed).max(f64::MIN_POSITIVE);
            Self {
                turning,
                speed_scatter: self.speed_scatter * ratio,
                series: Series::default(),
                ..self.clone()
            }
        })
    }
}

/// The reason why a track has no measures: gaps, or times that are not even.
pub(super) fn without(track: &Track, frames_of_all: usize, unit: &str) -> String {
    let (frames, dt) = (&track.0, track.interval());
    if longest(frames, dt, NO_GAP).len() < LEAST {
        return format!(
            "the {} frames that count, of {frames_of_all}, are not equally spaced for long enough: gaps and frames left \
             out leave no stretch of {LEAST}",
            frames.len()
        );
    }
    let off = |pair: &[Observation]| ((pair[1].t - pair[0].t) / dt - 1.0).abs();
    let uneven: Vec<f64> = frames.windows(2).map(off).filter(|off| (EVEN..=NO_GAP).contains(off)).collect();
    format!(
        "times are uneven: {} of {} intervals differ from the usual one, {} {unit}, by more than {:.0} %, up to {:.0} %, which leaves no \
         even stretch of {LEAST} frames; if the camera was even and the stamps are not, give frame numbers and the interval instead of \
         times; a fit takes uneven times",
        uneven.len(),
        frames.len() - 1,
        four_digits(dt),
        100.0 * EVEN,
        100.0 * uneven.iter().copied().fold(0.0, f64::max)
    )
}

/// The longest run of frames at the sampling interval, within this part of it.
fn longest(frames: &[Observation], dt: f64, within: f64) -> &[Observation] {
    let mut best: &[Observation] = &[];
    let mut start = 0;
    for end in 1..=frames.len() {
        let broken = end == frames.len() || (frames[end].t - frames[end - 1].t - dt).abs() > within * dt;
        if broken {
            if end - start > best.len() {
                best = &frames[start..end];
            }
            start = end;
        }
    }
    best
}

/// The least number of frames over which most displacements have a clear heading; at most a twentieth of the record.
pub(crate) fn step(frames: &[Observation]) -> usize {
    let most = (frames.len() / 20).max(1);
    let clear = |lag: &usize| {
        let good = frames.windows(lag + 1).filter(|pair| {
            let (a, b) = (&pair[0], &pair[*lag]);
            let size = libm::hypot(b.y[0] - a.y[0], b.y[1] - a.y[1]);
            let noise = a.covariance[0][0] + a.covariance[1][1] + b.covariance[0][0] + b.covariance[1][1];
            size > CLEAR * (0.5 * noise).sqrt()
        });
        good.count() * 20 > 19 * (frames.len() - lag)
    };
    (1..=most).find(clear).unwrap_or(most)
}

/// Turning rates of equal blocks.
fn rates(headings: &[f64], dt: f64) -> Vec<f64> {
    let size = ((headings.len() - 1) / BLOCKS).max(1);
    let blocks = (0..BLOCKS).map(|block| block * size).filter(|start| start + size < headings.len());
    blocks.map(|start| (headings[start + size] - headings[start]) / (size as f64 * dt)).collect()
}

/// Mean turn of a window (rad), and the part of it below which a window is straight.
const WINDOW: f64 = std::f64::consts::FRAC_PI_8;
const STRAIGHT: f64 = 0.25;

/// Share of the windows of a mean turn of [`WINDOW`] in which the heading turns by less than a part of that, to the side of the mean turn;
/// `per_frame` is the mean turn from frame to frame. 0 where no window is that long.
fn straight_share(headings: &[f64], per_frame: f64) -> f64 {
    let frames = ((WINDOW / per_frame.abs().max(f64::MIN_POSITIVE)).round() as usize).max(1);
    let expected = per_frame * frames as f64;
    let windows = || headings.windows(frames.saturating_add(1));
    let straight = windows().filter(|window| (window[frames] - window[0]) / expected < STRAIGHT).count();
    straight as f64 / windows().count().max(1) as f64
}

/// Scatter of |z2| and |z3| relative to the size of both, without that of errors.
fn shape_scatter(frames: &[Observation]) -> f64 {
    let modulus = |frame: &Observation, at: usize| libm::hypot(frame.y[at], frame.y[at + 1]);
    let variance = |at: usize| {
        let values: Vec<f64> = frames.iter().map(|frame| modulus(frame, at)).collect();
        let noise = mean(
            frames.iter().map(|frame| 0.5 * (frame.covariance[at][at] + frame.covariance[at + 1][at + 1])),
        );
        ((scatter(&values) * scatter(&values) - noise).max(0.0), mean(values.iter().map(|v| v * v)))
    };
    let (two, three) = (variance(2), variance(4));
    ((two.0 + three.0) / (two.1 + three.1).max(f64::MIN_POSITIVE)).sqrt()
}

/// Root mean square deviation of z2 and z3 from their means, without that of errors.
fn shape_wobble(frames: &[Observation]) -> f64 {
    let part = |(square, noise)| square - noise;
    (2..6).map(|at| part(variance(frames, at))).sum::<f64>().max(0.0).sqrt()
}

/// The mean square deviation of a number of the frames from its mean, and that of its errors.
fn variance(frames: &[Observation], at: usize) -> (f64, f64) {
    let values: Vec<f64> = frames.iter().map(|frame| frame.y[at]).collect();
    (scatter(&values) * scatter(&values), mean(frames.iter().map(|frame| frame.covariance[at][at])))
}

/// Root mean square distance from the mean place, in units of its errors.
fn wandering(frames: &[Observation]) -> f64 {
    let (x, y) = (variance(frames, 0), variance(frames, 1));
    ((x.0 + y.0) / (x.1 + y.1).max(f64::MIN_POSITIVE)).sqrt()
}

/// Size of the mean shape.
fn mean_shape(frames: &[Observation]) -> f64 {
    let part = |at: usize| mean(frames.iter().map(|frame| frame.y[at]));
    (2..6).map(|at| part(at) * part(at)).sum::<f64>().sqrt()
}

/// Root mean square deviation of z2 or z3 from its mean, in units of its errors, along the direction of the complex plane in which it is
/// clearest: the axes of the images have no part in it.
fn shape_change(frames: &[Observation]) -> f64 {
    [2, 4].map(|at| clearest(frames, at)).into_iter().fold(0.0, f64::max).sqrt()
}

/// The largest ratio, over all directions, of the mean square deviation of a mode to that of its errors: the larger root of
/// det(C - ratio N) = 0, with the covariance C of the mode and that of its errors N. Where errors are 0 in a direction, the ratio of the
/// traces.
fn clearest(frames: &[Observation], at: usize) -> f64 {
    let ((c0, n0), (c1, n1)) = (variance(frames, at), variance(frames, at + 1));
    let centre = [at, at + 1].map(|k| mean(frames.iter().map(|frame| frame.y[k])));
    let across = mean(frames.iter().map(|frame| (frame.y[at] - centre[0]) * (frame.y[at + 1] - centre[1])));
    let noise = mean(frames.iter().map(|frame| frame.covariance[at][at + 1]));
    let errors = n0 * n1 - noise * noise;
    // round-off of the difference
    if errors <= 1e-12 * n0 * n1 {
        return (c0 + c1) / (n0 + n1).max(f64::MIN_POSITIVE);
    }
    let half = (0.5 * (c0 * n1 + c1 * n0) - across * noise) / errors;
    half + (half * half - (c0 * c1 - across * across) / errors).max(0.0).sqrt()
}

/// The mean; 0 of nothing.
pub(super) fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    sample::mean(values).unwrap_or(0.0)
}

/// Standard deviation.
pub(super) fn scatter(values: &[f64]) -> f64 {
    let centre = mean(values.iter().copied());
    mean(values.iter().map(|value| (value - centre) * (value - centre))).sqrt()
}
