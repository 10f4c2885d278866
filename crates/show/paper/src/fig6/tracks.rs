//! Fig. 6(a) to (d): the four motions that the paper shows.

use super::super::context::Context;
use super::super::fig5::drawings;
use super::boundary::Boundary;
use super::lengths::modes_for;
use motiform_analysis::{Verdict, welch};
use motiform_dynamics::sample::ascending;
use motiform_figures::report::ReportFigure;
use motiform_study::{Dataset, Error, Study};

/// Rows at which the boundary is measured: in a full, and in a quick run.
const MEASURED: (usize, usize) = (200, 50);

/// Recorded time of a quick run, where the spectrum needs no more.
const QUICK: f64 = 1000.0;

/// A preset, run, named and measured.
pub(crate) struct Track {
    /// The run.
    pub(crate) dataset: Dataset,
    /// Its motion.
    pub(crate) verdict: Verdict,
    /// Its boundary.
    pub(super) boundary: Boundary,
}

/// Computes all four.
pub(super) fn all(context: &Context<'_>) -> Result<Vec<Track>, Error> {
    context.each(&["fig6a", "fig6b", "fig6c", "fig6d"], |name| Track::of(context, name))
}

impl Track {
    /// Runs a preset of the cell and classifies its motion, starting from the end of the run.
    pub(crate) fn of(context: &Context<'_>, name: &str) -> Result<Self, Error> {
        let study = context.preset(name, |study| {
            let length = study.parameters.iter().find(|entry| entry.0 == "length").map_or(21.6, |e| e.1);
            study.title = format!("Active cell, *L* = {length}");
            study.set("modes", modes_for(length) as f64)?;
            if length > 25.0 {
                study.run.t_end = context.choose(study.run.t_end, QUICK);
            }
            Ok(())
        })?;
        let dataset = context.simulate(&study)?;
        let verdict = context.classify(&continued(&study, &dataset)?)?;
        let boundary = context.kept.once(&format!("boundary of {name}"), || measured(context, &dataset))?;
        let boundary = boundary.through(context);
        Ok(Self { dataset, verdict, boundary })
    }

    /// A parameter of the run.
    pub(crate) fn parameter(&self, name: &str) -> f64 {
        self.dataset.manifest.plan.computation.parameters.get(name).unwrap_or(f64::NAN)
    }

    /// The sizes of the turns from leg to leg, in degrees, smallest first, equal ones (to a degree) once.
    pub(super) fn turns(&self) -> Vec<f64> {
        let mut turns: Vec<f64> = self.verdict.legs.iter().map(|turn| turn.to_degrees().abs()).collect();
        ascending(&mut turns);
        turns.dedup_by(|a, b| (*a - *b).abs() < 1.0);
        turns
    }

    /// Spectral flatness of the amplitudes of modes 2 to 4 below frequency 0.05: geometric over arithmetic mean of the
    /// power. 1 for white noise, small for lines.
    pub(super) fn flatness(&self) -> Option<f64> {
        let dt = self.dataset.manifest.plan.computation.dt_out;
        let of = |name: &str| {
            let samples = self.dataset.trajectory.get(name)?;
            let spectrum = welch(samples, dt, samples.len()).ok()?;
            let low =
                spectrum.frequencies.iter().zip(&spectrum.power).filter(|(f, _)| (1e-9..0.05).contains(*f));
            let power: Vec<f64> = low.map(|(_, power)| *power).collect();
            let count = power.len() as f64;
            let geometric = (power.iter().map(|x| x.ln()).sum::<f64>() / count).exp();
            Some(geometric / (power.iter().sum::<f64>() / count))
        };
        Some((of("mode2")? + of("mode3")? + of("mode4")?) / 3.0)
    }

    /// Path, boundary field, spectrum and film.
    pub(super) fn figures(&self, context: &Context<'_>, letter: &str) -> Result<Vec<ReportFigure>, Error> {
        let length = self.parameter("length");
        let turns: Vec<String> = self.turns().iter().map(|turn| format!("{turn:.0}")).collect();
        let turns = match turns.is_empty() {
            true => String::new(),
            false => format!(", turns of {} degrees", turns.join(" and ")),
        };
        let inset = if letter == "a" { ": the inset of Fig. 6(a)" } else { "" };
        let words = [
            ("path", format!("*L* = {length}: {}{turns}.", self.verdict.regime)),
            ("phi", format!("*φ*(*s*, *t*) of the motion of Fig. 6({letter}), *L* = {length}.")),
            ("spectrum", format!("Power spectra of the modes of *φ* at *L* = {length}{inset}.")),
            ("motion", format!("The motion at *L* = {length}, animated.")),
        ];
        let name = format!("6({letter})");
        drawings(
            context,
            &name,
            &self.dataset,
            &words.each_ref().map(|(name, caption)| (*name, caption.as_str())),
        )
    }
}

/// The study that continues from the end of a run.
pub(super) fn continued(study: &Study, dataset: &Dataset) -> Result<Study, Error> {
    let mut next = study.clone();
    for (name, value) in &dataset.manifest.state.0 {
        next.set_initial(name, *value)?;
    }
    Ok(next)
}

/// Measures the boundary along a run.
fn measured(context: &Context<'_>, dataset: &Dataset) -> Result<Boundary, Error> {
    let plan = &dataset.manifest.plan;
    let (info, parameters) = (plan.info()?, &plan.computation.parameters);
    let build = |open: bool| {
        let value =
            |(name, value): &(String, f64)| if open && name == "closure_modes" { 0.0 } else { *value };
        info.build(&parameters.0.iter().map(value).collect::<Vec<_>>())
    };
    let (model, bare) = (build(false)?, build(true)?);
    let columns: Vec<&[f64]> =
        model.coordinates().iter().filter_map(|c| dataset.trajectory.get(c.name)).collect();
    let rows = dataset.trajectory.rows();
    let state = |row: usize| columns.iter().map(|column| column[row]).collect();
    let states: Vec<Vec<f64>> =
        (0..rows).step_by(rows.div_ceil(context.choose(MEASURED.0, MEASURED.1)).max(1)).map(state).collect();
    let length = parameters.get("length").unwrap_or(f64::NAN);
    Boundary::along(&states, length, [model.as_ref(), bare.as_ref()])
}
