//! Lyapunov exponents, from the exact tangent flow.

mod bounds;
mod dimension;
mod frame;
mod lanes;
mod renormalisation;
mod separation;
mod silent;

use crate::equilibrium::{RelativeEquilibrium, along_group_and_flow};
use crate::linear::norm;
use crate::series_mean::{FEWEST_INDEPENDENT, independent_samples, mean_over};
use crate::symmetry::reduced_speed;
use crate::{Estimate, Result, sort_by_number};
pub(crate) use bounds::with_unseen;
pub use lanes::{TangentMember, lyapunov_in_lanes, runs_in_lanes};
use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Equivariant, Mask, Outcome, Request, StepControl, StopOnly, Tangent, Watch};
use renormalisation::{Renormalisation, Stretch};
pub(crate) use separation::{GROWN, SECULAR};
pub use separation::{power_of_time, separates};
pub use silent::left_alone;

/// The settings of the computation of exponents.
#[derive(Clone, Copy, Debug)]
pub struct LyapunovSettings {
    /// Number of exponents, from the largest.
    pub count: usize,
    /// Stepper of orbit and tangent vectors.
    pub method: Method,
    /// Its control.
    pub control: StepControl,
    /// Time before the averages begin, in which the orbit reaches its attractor and the vectors their directions.
    pub transient: f64,
    /// Time averaged over.
    pub span: f64,
    /// A shape beyond this norm has escaped.
    pub escape_norm: f64,
    /// Most steps.
    pub max_steps: u64,
}

/// Exponents of one orbit. An orbit that did not last has none.
#[derive(Clone, Debug, PartialEq)]
pub struct Lyapunov {
    /// The exponents, largest first (inverse model time), each with its 95 % error; empty unless the run completed. The error is
    /// infinite where the run is too short for one ([`Lyapunov::without_error`] says why).
    pub exponents: Vec<Estimate>,
    /// `true` if exponents that must be zero are further from it than the scatter of their averages lets expect: all errors are then at
    /// least twice that.
    pub widened: bool,
    /// Number of exponents that must be zero on the motion that the run ended on: those of the flow's own
    /// direction, of the rotations, and along a family of steady motions.
    pub neutral: usize,
    /// Rates of coordinates in which the motion rests and on which the others do not act: among the exponents, but no part of the motion.
    pub silent: Vec<f64>,
    /// Growth rates over the intervals of the run: end times, and for each interval one rate per vector.
    pub history: Vec<(f64, Vec<f64>)>,
    /// The rate of change of the reduced shape at the end of each interval.
    pub reduced_speeds: Vec<f64>,
    /// Time averaged over.
    pub time: f64,
    /// Time before that.
    pub transient: f64,
    /// The end of the run.
    pub outcome: Outcome,
    /// The shape at the end.
    pub shape: Vec<f64>,
}

impl Lyapunov {
    /// The exponents that must be zero, as computed: those closest to zero. A self-check of the run.
    pub fn zeros(&self) -> Vec<Estimate> {
        let mut all = self.exponents.clone();
        sort_by_number(&mut all, |a| a.value.abs());
        all.truncate(self.neutral);
        all
    }

    /// The reason why exponents of this run have no error; `None` if all have one.
    pub fn without_error(&self) -> Option<String> {
        if self.exponents.iter().all(Estimate::has_error) {
            return None;
        }
        let durations = durations(&self.history, self.transient);
        let worth = |k| independent_samples(&rates(&self.history, k), &durations);
        let fewest = (0..self.exponents.len()).map(worth).fold(f64::INFINITY, f64::min);
        Some(if fewest < FEWEST_INDEPENDENT {
            format!(
                "too short for an error: the growth rates over a time of {:?} are worth {fewest:.0} independent ones, and \
                 {FEWEST_INDEPENDENT} are needed; average over a longer time",
                self.time
            )
        } else {
            format!("too short for an error: the body hardly moves within a time of {:?}", self.time)
        })
    }
}

impl Lyapunov {
    /// The same run without the rests it began and ended in: intervals at whose end the reduced shape changed slower than
    /// `fraction` of its fastest. In a rest at a saddle neighbouring orbits separate at the saddle's rate; the approach, in which
    /// they came together, must be averaged over as well. `None` where less than half of the run, or too little for an error,
    /// remains.
    pub fn moving(&self, fraction: f64) -> Option<Self> {
        let fastest = self.reduced_speeds.iter().copied().fold(0.0, f64::max);
        let moves = |speed: &f64| *speed >= fraction * fastest;
        let first = self.reduced_speeds.iter().position(moves)?;
        let last = self.reduced_speeds.iter().rposition(moves)?;
        if first == 0 && last + 1 == self.history.len() {
            return Some(self.clone());
        }
        let before = if first == 0 { self.transient } else { self.history[first - 1].0 };
        let history = self.history[first..=last].to_vec();
        let time = history.last()?.0 - before;
        if time < 0.5 * self.time {
            return None;
        }
        let leading = self.exponents.first()?;
        // Half of a run that was long enough is.
        let pace = if leading.has_error() { f64::INFINITY } else { 0.0 };
        let exponents = means(&history, before, leading.error.min(1e-12), pace).ok()?;
        let reduced_speeds = self.reduced_speeds[first..=last].to_vec();
        Some(Self { exponents, history, reduced_speeds, time, ..self.clone() })
    }
}

/// Largest Lyapunov exponents by QR of the tangent flow.
///
/// lambda_i = lim 1/T sum ln R_ii
///
/// The vectors are made orthonormal whenever the fastest and the slowest have separated by a factor of about e^8: the interval is
/// chosen in the transient and kept, and a stretch ends with the first step that reaches the end of its interval. Errors are
/// 95 % half widths for correlated rates ([`crate::series_mean()`]), at least the growth that the steps' own tolerance leaves
/// undetermined. They are infinite where the rates are worth fewer than 16 independent ones, and where the run is shorter than
/// 20 of the motion's fastest times: such a run says nothing about its error.
///
/// A neutral exponent (of the flow's direction, of the rotations) is exactly 0, and the growth along it is
/// that of a bounded length: what is computed is the difference of two ends over T. Its error is no 95 %
/// statement but a bound, two to three times that difference, and shrinks like 1/T.
///
/// Source: Benettin, Galgani, Giorgilli, Strelcyn (1980), Meccanica 15, 9.
///
/// # Shapes    `start`: n = body.dim(); `settings.count` at most n
/// # Units     inverse model time
/// # Errors    what the numerics refuse; a run that escapes is an [`Outcome`] without exponents
/// # Not       not for noise-driven orbits; corrections of the state between steps (feedback of the cell) are not followed
/// # Checked by  tests/all/lyapunov.rs: linear flow (exact), Lorenz-63 (published), coverage of the errors, both models
pub fn lyapunov(
    body: &dyn Equivariant,
    start: &[f64],
    settings: &LyapunovSettings,
    watch: &dyn Watch,
) -> Result<Lyapunov> {
    lyapunov_followed(body, start, settings, watch, &mut |_| {})
}

/// The exponents of a run that is still going on.
#[derive(Clone, Copy, Debug)]
pub struct SoFar<'r> {
    history: &'r [(f64, Vec<f64>)],
    begun: f64,
    pace: f64,
}

impl SoFar<'_> {
    /// Time averaged over.
    pub fn time(&self) -> f64 {
        self.history.last().map_or(0.0, |last| last.0 - self.begun)
    }

    /// The exponents with their errors, as in [`Lyapunov::bounded`]; `None` while there are too few intervals for an error.
    pub fn exponents(&self) -> Option<Vec<Estimate>> {
        let mut all = means(self.history, self.begun, 0.0, self.pace).ok().filter(|all| !all.is_empty())?;
        bounds::bound(&mut all, self.history, self.time());
        Some(all)
    }
}

/// As [`lyapunov`], the same numbers; `follow` is shown after every interval of the average what they are so far.
///
/// # Errors
/// As [`lyapunov`].
pub fn lyapunov_followed(
    body: &dyn Equivariant,
    start: &[f64],
    settings: &LyapunovSettings,
    watch: &dyn Watch,
    follow: &mut dyn FnMut(SoFar<'_>),
) -> Result<Lyapunov> {
    let tangent = Tangent::new(body, settings.count);
    let mut renormalisation = Renormalisation::new(settings, start);
    let state = first_state(start, settings.count);
    let mut lengths = vec![0.0; settings.count];
    let mut orbit = settings.method.shape_orbit(&tangent, settings.control, 0.0, &state)?;
    let mut stretch = renormalisation.begin(orbit.t());
    let mut outcome = Outcome::Completed { t: orbit.t() };
    while let Some(Stretch { stop, limit }) = stretch {
        let request = Request {
            max_steps: settings.max_steps,
            escape_norm: settings.escape_norm,
            watched: start.len(),
            stop_after: stop,
            watch: &StopOnly(watch),
            ..Request::until(limit, start.len())
        };
        outcome = drive(orbit.as_mut(), &request, &mut ())?;
        if !outcome.is_complete() {
            break;
        }
        let (mut state, mut rates) = (orbit.state().to_vec(), orbit.slope().to_vec());
        let (shape, vectors) = state.split_at_mut(start.len());
        let (rate, vector_rates) = rates.split_at_mut(start.len());
        let lost = frame::orthonormalise(Mask::only(0), start.len(), vectors, vector_rates, &mut lengths);
        if lengths.contains(&0.0) {
            frame::replace_lost(start.len(), vectors, &lengths);
        }
        let speed = reduced_speed(body, shape, rate);
        stretch = renormalisation.stretched(orbit.t(), &lengths, speed, orbit.counters().steps);
        if let Some(so_far) = renormalisation.so_far(pace(shape, rate)) {
            follow(so_far);
        }
        watch.progress(orbit.t() / (settings.transient + settings.span));
        if watch.stopped() {
            outcome = Outcome::Interrupted { t: orbit.t() };
            break;
        }
        if lost.any() { orbit.restart(&state) } else { orbit.restart_with(&state, &rates) }
    }
    let steps = orbit.counters().steps;
    renormalisation.result(body, &orbit.state()[..start.len()], outcome, steps)
}

/// A start with `count` orthonormal tangent vectors in general position.
pub(crate) fn first_state(start: &[f64], count: usize) -> Vec<f64> {
    let dim = start.len();
    let mut state = start.to_vec();
    let mut random = SplitMix(1);
    state.extend((0..dim * count).map(|_| random.next()));
    let mut rates = vec![0.0; dim * count];
    frame::orthonormalise(Mask::only(0), dim, &mut state[dim..], &mut rates, &mut vec![0.0; count]);
    state
}

/// Number of neutral directions of the motion that a run ended on, from the shape at its end and the size of
/// its first one: that of the rotations, that of the flow unless the body is at a steady motion, and those of
/// a family of steady motions.
fn neutral_directions(body: &dyn Equivariant, shape: &[f64], size: f64) -> usize {
    match RelativeEquilibrium::reached(body, shape, size) {
        Some(found) => found.neutral + found.family_dimension(body),
        None => along_group_and_flow(body, shape).len(),
    }
}

/// An average over less than so many of the motion's fastest times has no error, however smooth it is.
const SHORTEST: f64 = 20.0;

/// The rate of change of a shape, against its size: `|rate|/|shape|`.
fn pace(shape: &[f64], rate: &[f64]) -> f64 {
    let size = norm(shape);
    if size > 0.0 { norm(rate) / size } else { 0.0 }
}

/// Means over time of the rates in a history that begins at `start`, largest first. Their errors are at least `numerical`, the
/// accuracy of the rates: where these differ by less, they are the same. `pace`: how fast the shape changes.
fn means(history: &[(f64, Vec<f64>)], start: f64, numerical: f64, pace: f64) -> Result<Vec<Estimate>> {
    let durations = durations(history, start);
    let count = history.first().map_or(0, |entry| entry.1.len());
    let fastest = history.iter().flat_map(|entry| &entry.1).fold(pace, |most, rate| most.max(rate.abs()));
    let long = durations.iter().sum::<f64>() * fastest >= SHORTEST;
    let exponent = |k: usize| {
        let rates = rates(history, k);
        let mean = mean_over(&rates, &durations)?;
        let error = match (long, rates.iter().all(|rate| (rate - mean.value).abs() <= numerical)) {
            (false, _) => f64::INFINITY,
            (true, true) => numerical,
            (true, false) => mean.error.max(numerical),
        };
        Ok(Estimate { value: mean.value, error })
    };
    let mut exponents = (0..count).map(exponent).collect::<Result<Vec<_>>>()?;
    sort_by_number(&mut exponents, |a| -a.value);
    Ok(exponents)
}

/// The lengths of the intervals of a history that begins at `start`.
pub(crate) fn durations(history: &[(f64, Vec<f64>)], start: f64) -> Vec<f64> {
    let starts = std::iter::once(start).chain(history.iter().map(|entry| entry.0));
    history.iter().zip(starts).map(|(entry, start)| entry.0 - start).collect()
}

/// The rates of one vector.
pub(crate) fn rates(history: &[(f64, Vec<f64>)], vector: usize) -> Vec<f64> {
    history.iter().map(|entry| entry.1[vector]).collect()
}

/// Numbers in -1..1 in general position: Steele, Lea, Flood (2014), OOPSLA, 453.
pub(crate) struct SplitMix(pub(crate) u64);

impl SplitMix {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
