//! Lyapunov exponents, from the exact tangent flow.

use crate::linear::{basis, norm, orthonormalise};
use crate::symmetry::reduced_speed;
use crate::{Estimate, Result, batch_means};
use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{
    Equivariant, Integration, Outcome, Request, Sink, StepControl, System, Tangent, VectorField,
};

/// How to compute exponents.
#[derive(Clone, Copy, Debug)]
pub struct LyapunovSettings {
    /// How many exponents, from the largest.
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
    /// The exponents, largest first (inverse model time), each with its 95 % error; empty unless the run completed.
    pub exponents: Vec<Estimate>,
    /// How many exponents must be zero: the flow's own direction, and the rotations'.
    pub neutral: usize,
    /// Growth rates over the intervals of the run: end times, and for each interval one rate per vector.
    pub history: Vec<(f64, Vec<f64>)>,
    /// How fast the reduced shape changed at the end of each interval.
    pub reduced_speeds: Vec<f64>,
    /// Time averaged over.
    pub time: f64,
    /// Time before that.
    pub transient: f64,
    /// How the run ended.
    pub outcome: Outcome,
    /// The shape at the end.
    pub shape: Vec<f64>,
}

impl Lyapunov {
    /// The exponents that must be zero, as computed: those closest to zero. A self-check of the run.
    #[must_use]
    pub fn zeros(&self) -> Vec<Estimate> {
        let mut all = self.exponents.clone();
        all.sort_by(|a, b| a.value.abs().total_cmp(&b.value.abs()));
        all.truncate(self.neutral);
        all
    }
}

impl Lyapunov {
    /// The same run without the rests it began and ended in: intervals at whose end the reduced shape changed slower than
    /// `fraction` of its fastest. In a rest at a saddle neighbours part at the saddle's rate; the approach, in which they came
    /// together, must be averaged over as well. `None` where less than half of the run, or too little for an error, remains.
    #[must_use]
    pub fn awake(&self, fraction: f64) -> Option<Self> {
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
        let exponents = means(&history, self.exponents.first()?.error.min(1e-12)).ok()?;
        let reduced_speeds = self.reduced_speeds[first..=last].to_vec();
        Some(Self { exponents, history, reduced_speeds, time, ..self.clone() })
    }
}

/// Largest Lyapunov exponents by QR of the tangent flow.
///
/// lambda_i = lim 1/T sum ln R_ii
///
/// The vectors are made orthonormal whenever the fastest and the slowest have parted by a factor of about e^8: the interval is
/// chosen in the transient and kept. Errors are 95 % half widths from batch means (honest for correlated rates), at
/// least the growth that the steps' own tolerance leaves undetermined.
///
/// Source: Benettin, Galgani, Giorgilli, Strelcyn (1980), Meccanica 15, 9.
///
/// # Shapes    `start`: n = body.dim(); `settings.count` at most n
/// # Units     inverse model time
/// # Errors    what the numerics refuse; a run that escapes is an [`Outcome`] without exponents
/// # Not       not for noise-driven orbits; corrections of the state between steps (feedback of the cell) are not followed
/// # Checked by  tests/lyapunov.rs: linear flow (exact), Lorenz-63 (published), coverage of the errors, both models
pub fn lyapunov<B: Equivariant + ?Sized>(
    body: &B,
    start: &[f64],
    settings: &LyapunovSettings,
    watch: &mut dyn Sink,
) -> Result<Lyapunov> {
    let tangent = Tangent::new(body, settings.count);
    let mut run = TangentRun::new(&tangent, start, settings)?;
    let transient = run.settle(settings.transient, watch)?;
    let outcome = match transient {
        Outcome::Completed { .. } => run.average(settings.span, watch)?,
        ended => ended,
    };
    let complete = outcome.is_complete();
    let exponents = if complete { run.exponents()? } else { Vec::new() };
    let shape = run.shape().to_vec();
    Ok(Lyapunov {
        exponents,
        neutral: neutral_directions(body, &shape),
        time: run.time(),
        transient: settings.transient,
        reduced_speeds: run.reduced_speeds,
        history: run.history,
        outcome,
        shape,
    })
}

/// How many independent neutral directions the flow has at a shape: `f(u)` and the rotation `Gu`.
fn neutral_directions<B: Equivariant + ?Sized>(body: &B, shape: &[f64]) -> usize {
    let (mut rate, mut spin) = (shape.to_vec(), shape.to_vec());
    VectorField::<f64>::eval(body, 0.0, shape, &mut rate);
    body.spin(shape, &mut spin);
    let size = norm(shape);
    let moving = [&rate[..], &spin[..]].into_iter().filter(|x| norm(x) > 1e-9 * size).collect::<Vec<_>>();
    basis(&moving, 1e-6).len()
}

/// The reduced speed of a body at a shape.
type SpeedOf<'f> = Box<dyn Fn(&[f64]) -> f64 + 'f>;

/// A tangent flow under way: orbit, vectors and what they have grown.
pub(crate) struct TangentRun<'f> {
    orbit: Box<dyn Integration + 'f>,
    dim: usize,
    interval: f64,
    rtol: f64,
    escape_norm: f64,
    max_steps: u64,
    steps_before: u64,
    pub(crate) history: Vec<(f64, Vec<f64>)>,
    durations: Vec<f64>,
    reduced_speeds: Vec<f64>,
    /// The reduced speed of the body at a state.
    speed: SpeedOf<'f>,
}

/// Vectors are made orthonormal when they have parted by this factor (natural logarithm).
const PARTED: f64 = 8.0;

impl<'f> TangentRun<'f> {
    /// Starts with `settings.count` orthonormal vectors in general position.
    pub(crate) fn new<B: Equivariant + ?Sized>(
        tangent: &'f Tangent<'f, B>,
        start: &[f64],
        settings: &LyapunovSettings,
    ) -> Result<Self> {
        let dim = start.len();
        let mut state = start.to_vec();
        let mut random = SplitMix(1);
        state.extend((0..tangent.dim().saturating_sub(dim)).map(|_| random.next()));
        orthonormalise(&mut state[dim..].chunks_exact_mut(dim.max(1)).collect::<Vec<_>>());
        let orbit = settings.method.shape_orbit(tangent, settings.control, 0.0, &state)?;
        let rtol = match settings.control {
            StepControl::Adaptive { rtol, .. } => rtol,
            StepControl::Fixed { .. } => 0.0,
        };
        Ok(Self {
            orbit,
            dim,
            interval: 1.0,
            rtol,
            escape_norm: settings.escape_norm,
            max_steps: settings.max_steps,
            steps_before: 0,
            history: Vec::new(),
            durations: Vec::new(),
            reduced_speeds: Vec::new(),
            speed: Box::new(|shape| {
                let mut rate = shape.to_vec();
                VectorField::<f64>::eval(tangent.field(), 0.0, shape, &mut rate);
                reduced_speed(tangent.field(), shape, &rate)
            }),
        })
    }

    /// The shape reached.
    pub(crate) fn shape(&self) -> &[f64] {
        &self.orbit.state()[..self.dim]
    }

    /// Time averaged over so far.
    pub(crate) fn time(&self) -> f64 {
        self.durations.iter().sum()
    }

    /// Runs for `time` without averaging; finds the interval on the way.
    pub(crate) fn settle(&mut self, time: f64, watch: &mut dyn Sink) -> Result<Outcome> {
        let end = self.orbit.t() + time;
        let mut outcome = Outcome::Completed { t: self.orbit.t() };
        while self.orbit.t() < end {
            let (ended, growth) = self.stretch(end, watch)?;
            outcome = ended;
            if !outcome.is_complete() {
                break;
            }
            let most = growth.iter().copied().fold(0.0, f64::max);
            let least = growth.iter().copied().fold(0.0, f64::min);
            if most - least > PARTED {
                self.interval *= 0.5;
            } else if most - least < 0.25 * PARTED {
                self.interval = (2.0 * self.interval).min((time / 8.0).max(1.0));
            }
        }
        let work = self.orbit.counters();
        self.steps_before = work.steps;
        Ok(outcome)
    }

    /// Runs for `time` and adds to the averages.
    pub(crate) fn average(&mut self, time: f64, watch: &mut dyn Sink) -> Result<Outcome> {
        let end = self.orbit.t() + time;
        // At least as many intervals as the errors need, all of the same length.
        let pieces = (time / self.interval).ceil().max(128.0);
        self.interval = time / pieces;
        while self.orbit.t() < end - 0.5 * self.interval {
            let before = self.orbit.t();
            let (outcome, growth) = self.stretch(end, watch)?;
            if !outcome.is_complete() {
                return Ok(outcome);
            }
            let lasted = self.orbit.t() - before;
            self.durations.push(lasted);
            self.reduced_speeds.push((self.speed)(self.shape()));
            self.history.push((self.orbit.t(), growth.into_iter().map(|g| g / lasted).collect()));
        }
        Ok(Outcome::Completed { t: self.orbit.t() })
    }

    /// One interval, ending at `end` at the latest: the logarithms of what the vectors grew by.
    fn stretch(&mut self, end: f64, watch: &mut dyn Sink) -> Result<(Outcome, Vec<f64>)> {
        let t = self.orbit.t() + self.interval;
        let t_end = if t > end - 1e-9 * self.interval { end } else { t };
        let request = Request {
            max_steps: self.max_steps,
            escape_norm: self.escape_norm,
            watched: self.dim,
            ..Request::until(t_end, self.dim)
        };
        let outcome = drive(self.orbit.as_mut(), &request, watch)?;
        let mut state = self.orbit.state().to_vec();
        let lengths =
            orthonormalise(&mut state[self.dim..].chunks_exact_mut(self.dim.max(1)).collect::<Vec<_>>());
        if outcome.is_complete() {
            self.orbit.restart(&state);
        }
        Ok((outcome, lengths.into_iter().map(f64::ln).collect()))
    }

    /// The exponents so far.
    pub(crate) fn exponents(&self) -> Result<Vec<Estimate>> {
        let steps = (self.orbit.counters().steps - self.steps_before) as f64;
        let numerical = self.rtol * (self.dim as f64).sqrt() * steps / self.time();
        means(&self.history, numerical)
    }
}

/// Means of the rates in a history, largest first, with errors of at least `numerical`.
fn means(history: &[(f64, Vec<f64>)], numerical: f64) -> Result<Vec<Estimate>> {
    let count = history.first().map_or(0, |entry| entry.1.len());
    let exponent = |k: usize| {
        let rates: Vec<f64> = history.iter().map(|entry| entry.1[k]).collect();
        let mean = batch_means(&rates)?;
        Ok(Estimate { value: mean.value, error: mean.error.max(numerical) })
    };
    let mut exponents = (0..count).map(exponent).collect::<Result<Vec<_>>>()?;
    exponents.sort_by(|a, b| b.value.total_cmp(&a.value));
    Ok(exponents)
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
