//! The motion of the centre of mass while the shape moves: speed, heading, drift.

use super::case::Case;
use super::verdict::Spread;
use crate::linear::norm;
use crate::symmetry::wrap;
use crate::{Estimate, series_mean};
use motiform_dynamics::drive::drive;
use motiform_dynamics::model::velocity;
use motiform_dynamics::{Equivariant, Request, Sink};

/// Speeds below this part of the size of the shape are round-off, where the velocity is an unknown.
const STILL: f64 = 1e-12;

/// The sense of a turn between two samples is clear up to this angle (rad).
pub(super) const CLEAR_TURN: f64 = std::f64::consts::FRAC_PI_2;

/// Factors by which a path has more samples where the sense of its turns is not clear.
const FINER: [usize; 2] = [8, 64];

/// Samples of a path, equally spaced in time; the path starts at the origin.
#[derive(Clone, Debug)]
pub(super) struct Path {
    pub(super) times: Vec<f64>,
    pub(super) positions: Vec<[f64; 2]>,
    pub(super) velocities: Vec<[f64; 2]>,
    /// The largest speed that is no more than the errors of the shapes.
    pub(super) resolution: f64,
    /// The largest size `|u|` of a shape on the way.
    pub(super) largest: f64,
}

impl Path {
    /// The path from `shape` for `time`, in `steps` steps; shorter where the run ends early, by `stop` for one, or a velocity is undefined.
    pub(super) fn follow(
        case: Case<'_>,
        shape: &[f64],
        time: f64,
        steps: usize,
    ) -> Result<Self, motiform_dynamics::Error> {
        let Case { body, settings, .. } = case;
        let errors = [settings.atol(), settings.flow().closed()];
        let mut sampler = Sampler { body, errors, path: Self::empty() };
        let mut orbit = case.orbit(shape)?;
        let request = Request { sample_every: Some(time / steps as f64), ..case.request(time) };
        drive(orbit.as_mut(), &request, &mut sampler)?;
        let mut path = sampler.path;
        let defined = path.velocities.iter().take_while(|v| v.iter().all(|x| x.is_finite())).count();
        path.times.truncate(defined);
        path.velocities.truncate(defined);
        path.integrate();
        Ok(path)
    }

    /// The path with as many samples as tell the sense in which the heading turns between them, from `steps` on: beside a stop it turns by
    /// half a turn at once.
    pub(super) fn turning_clearly<E>(
        steps: usize,
        follow: impl Fn(usize) -> Result<Self, E>,
    ) -> Result<Self, E> {
        let mut path = follow(steps)?;
        for finer in FINER {
            if path.largest_turn().is_none_or(|turn| turn <= CLEAR_TURN) {
                break;
            }
            path = follow(finer * steps)?;
        }
        Ok(path)
    }

    fn empty() -> Self {
        Self {
            times: Vec::new(),
            positions: Vec::new(),
            velocities: Vec::new(),
            resolution: 0.0,
            largest: 0.0,
        }
    }

    /// This path, and after its end another one that begins with the shape that this one ends with.
    pub(super) fn joined(mut self, next: &Self) -> Self {
        let end = self.times.last().copied().unwrap_or(0.0);
        self.times.extend(next.times.iter().skip(1).map(|t| end + t));
        self.velocities.extend(next.velocities.iter().skip(1));
        self.resolution = self.resolution.max(next.resolution);
        self.largest = self.largest.max(next.largest);
        self.integrate();
        self
    }

    /// Positions from velocities, by the trapezoidal rule.
    fn integrate(&mut self) {
        let mut at = [0.0; 2];
        self.positions = Vec::with_capacity(self.times.len());
        for (i, v) in self.velocities.iter().enumerate() {
            if let Some(before) = i.checked_sub(1) {
                let h = 0.5 * (self.times[i] - self.times[before]);
                at = [0, 1].map(|k| at[k] + h * (v[k] + self.velocities[before][k]));
            }
            self.positions.push(at);
        }
    }

    /// Speeds.
    pub(super) fn speeds(&self) -> Vec<f64> {
        self.velocities.iter().map(|v| libm::hypot(v[0], v[1])).collect()
    }

    /// Returns `true` if the body ever moves.
    pub(super) fn moves(&self) -> bool {
        self.speeds().iter().any(|&speed| speed > self.resolution.max(STILL * self.largest))
    }

    /// Mean over time, by the trapezoidal rule, and extremes of the speed. (Of a smooth speed over a whole period the rule is exact to
    /// more digits than the orbit has.)
    pub(super) fn speed(&self) -> Option<Spread> {
        let speeds = self.speeds();
        let mean = time_mean(&self.times, &speeds);
        let min = speeds.iter().copied().fold(f64::INFINITY, f64::min);
        let max = speeds.iter().copied().fold(0.0, f64::max);
        (!speeds.is_empty()).then_some(Spread { mean, min, max, error: None })
    }

    /// As [`Path::speed`] for a part of a motion that does not repeat, with the error of the mean.
    pub(super) fn sampled_speed(&self) -> Option<Spread> {
        let error = series_mean(&self.speeds()).ok().map(|mean| mean.error).filter(|error| error.is_finite());
        self.speed().map(|speed| Spread { error, ..speed })
    }

    /// The mean turning rate of such a part, with its error (infinite where the part is too short for one).
    pub(super) fn sampled_turning_rate(&self) -> Option<Estimate> {
        let (heading, value) = (self.heading()?, self.turning_rate()?);
        let steps = heading.windows(2).zip(self.times.windows(2));
        let rates: Vec<f64> = steps.map(|(angle, t)| (angle[1] - angle[0]) / (t[1] - t[0])).collect();
        let error = series_mean(&rates).map_or(f64::INFINITY, |mean| mean.error);
        Some(Estimate { value, error })
    }

    /// Mean turning rate of the heading (rad per model time); `None` where the body stops on the way.
    pub(super) fn turning_rate(&self) -> Option<f64> {
        let heading = self.heading()?;
        let time = self.times.last()? - self.times.first()?;
        Some((heading.last()? - heading.first()?) / time)
    }

    /// The heading without jumps (rad); `None` where the body stops.
    pub(super) fn heading(&self) -> Option<Vec<f64>> {
        let least = self.resolution.max(1e-6 * self.speed()?.max);
        let mut out: Vec<f64> = Vec::with_capacity(self.velocities.len());
        for v in &self.velocities {
            if libm::hypot(v[0], v[1]) <= least {
                return None;
            }
            let angle = libm::atan2(v[1], v[0]);
            out.push(out.last().map_or(angle, |&last| last + wrap(angle - last)));
        }
        Some(out)
    }

    /// Returns `true` if the velocity keeps to one line, forwards or backwards, to within `angle` (rad) of
    /// its largest value.
    pub(super) fn keeps_to_a_line(&self, angle: f64) -> bool {
        let speed = |v: &[f64; 2]| libm::hypot(v[0], v[1]);
        let fastest = self.velocities.iter().max_by(|a, b| speed(a).total_cmp(&speed(b)));
        let Some([x, y]) = fastest.copied() else { return false };
        let most = angle * (x * x + y * y);
        self.velocities.iter().all(|v| (x * v[1] - y * v[0]).abs() <= most)
    }

    /// The largest angle (rad) by which the heading turns between two samples; `None` where the body stops on the way. Beside a stop it
    /// turns by half a turn at once, and samples do not tell to which side.
    pub(super) fn largest_turn(&self) -> Option<f64> {
        let heading = self.heading()?;
        Some(heading.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max))
    }

    /// Full turns of the heading from start to end; 0 where the body stops on the way.
    pub(super) fn windings(&self) -> i32 {
        let turned = self.heading().and_then(|heading| Some(heading.last()? - heading.first()?));
        turned.map_or(0, |angle| (angle / std::f64::consts::TAU).round() as i32)
    }

    /// The displacement from start to end, 0 where it is less than the part `least` of the path: a path that closes has no direction.
    pub(super) fn displacement(&self, least: f64) -> [f64; 2] {
        let time = self.times.last().copied().unwrap_or(0.0);
        let length = self.speed().map_or(0.0, |speed| speed.mean * time);
        let end = self.positions.last().copied().unwrap_or_default();
        if self.drift() > least * length { end } else { [0.0; 2] }
    }

    /// Distance from start to end.
    pub(super) fn drift(&self) -> f64 {
        self.positions.last().map_or(0.0, |p| libm::hypot(p[0], p[1]))
    }
}

/// The mean over time of values at these times.
fn time_mean(times: &[f64], values: &[f64]) -> f64 {
    let span = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
    if span <= 0.0 {
        return values.first().copied().unwrap_or(f64::NAN);
    }
    let parts = times.windows(2).zip(values.windows(2));
    parts.map(|(t, x)| 0.5 * (t[1] - t[0]) * (x[0] + x[1])).sum::<f64>() / span
}

struct Sampler<'b> {
    body: &'b dyn Equivariant,
    /// Absolute and relative errors of the shapes.
    errors: [f64; 2],
    path: Path,
}

impl Sink for Sampler<'_> {
    fn sample(&mut self, t: f64, u: &[f64]) {
        self.path.times.push(t);
        self.path.velocities.push(velocity(self.body, u));
        let size = norm(u);
        let resolution = self.body.speed_resolution(u, self.errors[0] + self.errors[1] * size);
        self.path.resolution = self.path.resolution.max(resolution);
        self.path.largest = self.path.largest.max(size);
    }
}
