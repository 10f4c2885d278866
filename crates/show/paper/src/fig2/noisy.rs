//! Rests with explicit noise: their mean against the amplitude, and the sides of the turns.

use super::{GAMMA, KAPPA2, check, claim, durations, rates};
use crate::context::Context;
use motiform_analysis::{Ends, Estimate, PathSample, legs, series_mean};
use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::RK4;
use motiform_dynamics::{
    InPlane, Model, Noise, NoisyOrbit, Normal, Orbit, Request, Shape, Sink, StepControl, StopOnly,
};
use motiform_figures::report::{Claim, ReportFigure};
use motiform_figures::{Chart, ErrorBarSeries, ExpectedLine, LineStyle, Measured};
use motiform_models::ModelInfo;
use motiform_models::tensor::reduced::Reduced;
use motiform_study::{Error, Study};

/// Seed of the noise.
const SEED: u64 = 2010;

/// Step of the method, of the noise and between samples.
const STEP: f64 = 0.2;

/// Excluded: the path from the start to the cycle.
const TRANSIENT: f64 = 500.0;

/// One amplitude.
#[derive(Clone, Copy)]
struct NoisyRun {
    eta: f64,
    mean: Estimate,
    left: f64,
    turns: usize,
}

/// Rests at several amplitudes of noise.
pub(super) struct Rests {
    runs: Vec<NoisyRun>,
    time: f64,
}

pub(super) fn measure(context: &Context<'_>) -> Result<Rests, Error> {
    let exponents: &[i32] = context.choose(&[-4, -5, -6, -7, -8, -9, -10, -11, -12], &[-5, -7, -9, -11]);
    let time = context.choose(80_000.0, 40_000.0);
    let run = |(stream, &exponent): (u64, &i32)| {
        measured(context, libm::pow(10.0, f64::from(exponent)), stream, time)
    };
    let runs = (0..).zip(exponents).map(run).collect::<Result<_, _>>()?;
    Ok(Rests { runs, time })
}

fn measured(context: &Context<'_>, eta: f64, stream: u64, time: f64) -> Result<NoisyRun, Error> {
    let name = format!("rests under noise {eta} {stream} {time}");
    let run = context.kept.once(&name, || counted(context, eta, stream, time))?;
    Ok(NoisyRun { mean: context.estimate(run.mean), left: context.number(run.left), ..run })
}

fn counted(context: &Context<'_>, eta: f64, stream: u64, time: f64) -> Result<NoisyRun, Error> {
    let path = path(context, eta, stream, time)?;
    let mean = series_mean(&durations(&path)?.0)?;
    let turns = legs(&path, Ends::Open)?.heading_turns;
    let left = turns.iter().filter(|turn| **turn > 0.0).count();
    Ok(NoisyRun { eta, mean, left: left as f64, turns: turns.len() })
}

/// A path under noise.
fn path(context: &Context<'_>, eta: f64, stream: u64, time: f64) -> Result<Vec<PathSample>, Error> {
    let Reduced { a1, b1, b3 } = Reduced::PAPER;
    let mut study = Study::of_model(ModelInfo::find("tensor")?);
    for (name, value) in
        [("kappa2", KAPPA2), ("gamma", GAMMA), ("kappa3", 1.0), ("a1", a1), ("b1", b1), ("b3", b3)]
    {
        study.set(name, value)?;
    }
    let model = study.info()?.build(&study.values()?)?;
    let model = model.as_ref();
    let body = InPlane(model);
    let start = [0.01, 0.0, 0.005, 0.0015, 0.0, 0.0, 0.0, 0.0];
    let orbit = Orbit::new(&body, &RK4, StepControl::Fixed { step: STEP }, 0.0, &start)?;
    let noise = Noise::on(model, eta, eta, STEP);
    let mut noisy = NoisyOrbit::new(orbit, noise, Normal::new(SEED, stream))?;
    let watch = &StopOnly(context.watch);
    let request = Request { sample_every: Some(STEP), watched: 6, watch, ..Request::until(time, 8) };
    let mut recorder = Recorder { model, path: Vec::new() };
    let outcome = drive(&mut noisy, &request, &mut recorder)?;
    if outcome.is_complete() { Ok(recorder.path) } else { Err(Error::Interrupted) }
}

/// Keeps the path after the transient.
struct Recorder<'m> {
    model: &'m dyn Model,
    path: Vec<PathSample>,
}

impl Sink for Recorder<'_> {
    fn sample(&mut self, t: f64, u: &[f64]) {
        if t >= TRANSIENT {
            let [vx, vy] = Shape::<f64>::velocity(self.model, &u[..6]);
            self.path.push(PathSample { t, x: u[6], y: u[7], vx, vy });
        }
    }
}

/// A weighted straight line through means against ln(eta).
struct Line {
    slope: Estimate,
    /// Its height at ln(eta) = 0 with the slope that theory gives.
    height: f64,
}

impl Rests {
    /// Least squares with weights 1/error^2.
    fn line(&self, theory: f64) -> Line {
        let terms =
            || self.runs.iter().map(|run| (libm::log(run.eta), run.mean.value, run.mean.error.powi(-2)));
        let weight: f64 = terms().map(|term| term.2).sum();
        let mean = |of: fn((f64, f64, f64)) -> f64| terms().map(of).sum::<f64>() / weight;
        let (x0, y0) = (mean(|(x, _, w)| w * x), mean(|(_, y, w)| w * y));
        let square: f64 = terms().map(|(x, _, w)| w * (x - x0) * (x - x0)).sum();
        let along: f64 = terms().map(|(x, y, w)| w * (x - x0) * (y - y0)).sum();
        let slope = Estimate { value: along / square, error: square.sqrt().recip() };
        Line { slope, height: y0 - theory * x0 }
    }

    pub(super) fn figure(&self, context: &Context<'_>) -> Result<ReportFigure, Error> {
        let theory = -1.0 / rates()[0];
        let height = self.line(theory).height;
        let point = |run: &NoisyRun| Measured { x: run.eta, y: run.mean.value, error: run.mean.error };
        let ends = [1e-13, 1e-3].map(|eta: f64| [eta, height + theory * libm::log(eta)]);
        let figure = Chart {
            title: "Rectangular motion with noise: mean rest".to_owned(),
            caption: vec![format!(
                "Rests: speed below a tenth of its maximum. Bars: 95 %, {} time units per amplitude, seed {SEED}. \
                 Only the height of the line is fitted.",
                self.time
            )],
            x_label: "amplitude of the noise *η*".to_owned(),
            y_label: "mean rest".to_owned(),
            logarithmic_x: true,
            ..Chart::default()
        }.with([ExpectedLine {
                label: "−ln *η*/*λ*_+ + const".to_owned(),
                style: LineStyle::Dashed,
                points: ends.to_vec(),
            }]).with([ErrorBarSeries {
                label: "measured".to_owned(),
                points: self.runs.iter().map(point).collect(),
                joined: false,
            }]);
        let caption = "Mean rest of rectangular motion against the amplitude of explicit noise, with the slope −1/*λ*_+ that the \
                       saddle's growth rate gives.";
        Ok(ReportFigure::new(context.sheet(figure)?, caption))
    }

    pub(super) fn claims(&self) -> [Claim; 2] {
        [self.law(), self.sides()]
    }

    fn law(&self) -> Claim {
        let theory = -1.0 / rates()[0];
        let slope = self.line(theory).slope;
        let finds = format!(
            "d(mean rest)/d ln *η* = {:.3} ± {:.3} over {} amplitudes; −1/*λ*_+ = {theory:.3}",
            slope.value,
            slope.error,
            self.runs.len()
        );
        let how = "weighted least squares on the means, 95 % error; within twice that error, and within 5 %";
        let off = (slope.value - theory).abs();
        let says = "With explicit noise the law of a noisy heteroclinic cycle holds: mean rest = −ln *η*/*λ*_+ + const (Stone and Holmes \
                    1990).";
        check(says, finds, how, off < 2.0 * slope.error && off < 0.05 * theory.abs())
    }

    fn sides(&self) -> Claim {
        let (left, all) =
            self.runs.iter().fold((0.0, 0), |(left, all), run| (left + run.left, all + run.turns));
        let share = left / all.max(1) as f64;
        let error = 0.5 / (all.max(1) as f64).sqrt();
        let finds = format!("{left} of {all} turns go to the left: {share:.3} ± {error:.3}");
        let how = "turns of the heading at all amplitudes; within three standard errors of a fair coin";
        let says = "Either clock-wise rotation or counter clock-wise rotation seem to occur at random.";
        claim(&[100], says, finds, how, all >= 200 && (share - 0.5).abs() < 3.0 * error)
    }
}
