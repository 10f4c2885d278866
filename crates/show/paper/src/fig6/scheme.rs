//! The paper's scheme: a spectral method with a Runge-Kutta method of order 4 and 128 wave modes.

use super::super::claims::claim;
use super::super::context::Context;
use super::lengths::{modes_for, study};
use super::priors::{Shapes, seen, shapes_of};
use super::tracks::Track;
use motiform_dynamics::drive::drive;
use motiform_dynamics::{Outcome, Request, Sink};
use motiform_figures::report::Claim;
use motiform_models::cell::CellParameters;
use motiform_study::{Error, RunPlan};

/// The paper's 128 wave modes: *n* = ±1 to ±64; and the step that is taken with them.
const MODES: usize = 64;
const STEP: f64 = 1e-3;

/// The paper's figure is drawn again over this time, from the end of each of our runs.
const SPAN: f64 = 600.0;

/// Shapes of both schemes agree to this part of their size.
const CLOSE: f64 = 1e-5;

/// A length with few enough modes for the explicit method, its modes, and its step.
const EXPLICIT: (f64, usize, f64) = (13.4, 8, 5e-4);

/// Sentence 124.
pub(super) fn claim_of(context: &Context<'_>, tracks: &[Track]) -> Result<Claim, Error> {
    let short = context.choose(50.0, 5.0);
    let mut off: f64 = 0.0;
    for track in tracks {
        off = off.max(apart(context, track, short)?);
    }
    let off = context.number(off);
    let (same, drawn) = if context.quick {
        (true, "; in the full version the motions of the figure are drawn again with it".to_owned())
    } else {
        drawn_again(context, tracks)?
    };
    let explicit = context.number(plain(context, context.choose(400.0, 50.0))?);
    let largest = context.number(largest_step()?);
    Ok(claim(
        &[124],
        "We use the spectral method with the 4th order Runge-Kutta algorithm with the total number of wave modes *N* = 128.",
        format!(
            "with 128 wave modes (*n* up to ±{MODES}) the classical method is stable for Δ*t* < \
            {largest:.1e} only; with the linear part taken out by an integrating factor (ifrk4) it runs \
            with Δ*t* = {STEP}. From shapes of Fig. 6(a) to (d) it ends {off:.0e} apart (of the size of \
            *φ*) from the method used here, with at most {} modes, after {short} time units{drawn}. The \
            classical method itself, at *L* = {} with {} modes and Δ*t* = {}, ends {explicit:.0e} apart",
            modes_for(29.6),
            EXPLICIT.0,
            EXPLICIT.1,
            EXPLICIT.2
        ),
        "the same shapes, integrated by ifrk4 with modes up to ±64 and by krogstad4 with error control \
        (relative tolerance 10^{-10}); below 10^{-5}; in the full version (a) to (d) are run by ifrk4 for \
        600 time units: turns within 6 degrees of ours and, for (a) and (b), mean speeds within 20 %. The \
        paper says neither how it treats the stiff linear part nor its step",
        off < CLOSE && explicit < CLOSE && largest < 1e-7 && same,
    ))
}

/// The last shape of a run, with so many modes.
fn last(track: &Track, modes: usize) -> Result<Vec<f64>, Error> {
    let mut shape = shapes_of(&track.dataset)?.shapes.pop().ok_or(Error::Interrupted)?;
    shape.resize(2 * modes, 0.0);
    Ok(shape)
}

/// The shapes that follow the end of a run, from it on: their times are multiples of `every`. The path, which
/// takes most of the time of a run, is not needed.
fn onwards(
    context: &Context<'_>,
    track: &Track,
    modes: usize,
    papers: bool,
    time: f64,
    every: f64,
) -> Result<Shapes, Error> {
    let length = track.parameter("length");
    let mut study = study(length, modes)?;
    (study.run.rtol, study.run.atol) = (1e-10, Some(1e-12));
    if papers {
        "ifrk4".clone_into(&mut study.run.stepper);
        study.run.step = Some(STEP);
    }
    let plan = RunPlan::new(&study)?;
    let c = &plan.computation;
    let (model, start) = (plan.body()?, last(track, modes)?);
    let mut orbit = plan.method()?.shape_orbit(model.as_ref(), c.control.into(), 0.0, &start)?;
    let watch = &context.quiet();
    let request = Request { sample_every: Some(every), watch, ..Request::until(time, start.len()) };
    let mut shapes = Shapes { length, shapes: Vec::new() };
    match drive(orbit.as_mut(), &request, &mut shapes)? {
        Outcome::Interrupted { .. } => Err(Error::Interrupted),
        _ => Ok(shapes),
    }
}

impl Sink for Shapes {
    fn sample(&mut self, _t: f64, u: &[f64]) {
        self.shapes.push(u.to_vec());
    }
}

/// The largest difference of the modes after a time, against the largest mode.
fn apart(context: &Context<'_>, track: &Track, time: f64) -> Result<f64, Error> {
    let modes = modes_for(track.parameter("length"));
    let name = format!("the paper's scheme at {} over {time}", track.parameter("length"));
    context.kept.once(&name, || {
        let paper = onwards(context, track, MODES, true, time, time)?;
        let ours = onwards(context, track, modes, false, time, time)?;
        let ends = [paper, ours].map(|mut shapes| shapes.shapes.pop().unwrap_or_default());
        Ok(difference(&ends[0], &ends[1], 2 * modes))
    })
}

/// The largest difference of the first numbers, against the largest of them.
fn difference(a: &[f64], b: &[f64], count: usize) -> f64 {
    let size = a.iter().take(count).fold(0.0, |m: f64, x| m.max(x.abs()));
    a.iter().zip(b).take(count).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
}

/// The four runs with the paper's scheme: whether turns and speeds are ours, and words.
fn drawn_again(context: &Context<'_>, tracks: &[Track]) -> Result<(bool, String), Error> {
    let prior = CellParameters::default().prior;
    // over the same time from the same shapes: turns of a motion that does not repeat differ from one part of it to another
    let runs = context.each(tracks, |track| {
        let modes = modes_for(track.parameter("length"));
        let run = seen(&onwards(context, track, MODES, true, SPAN, 0.5)?, prior)?;
        Ok((run, seen(&onwards(context, track, modes, false, SPAN, 0.5)?, prior)?))
    })?;
    let (mut same, mut words) = (true, Vec::new());
    for (track, (run, our)) in tracks.iter().zip(&runs) {
        let length = track.parameter("length");
        if track.turns().is_empty() {
            same &= (run.speed / our.speed - 1.0).abs() < 0.2;
            words.push(format!("mean speed {:.2e} against {:.2e} at *L* = {length}", run.speed, our.speed));
        } else {
            let near = |(a, b): (&f64, &f64)| (a - b).abs() < 6.0;
            same &= run.turns.len() == our.turns.len() && run.turns.iter().zip(&our.turns).all(near);
            let turns: Vec<String> = run.turns.iter().map(|turn| format!("{turn:.0}")).collect();
            let ours: Vec<String> = our.turns.iter().map(|turn| format!("{turn:.0}")).collect();
            words.push(format!(
                "turns of {} degrees against {} at *L* = {length}",
                turns.join(" and "),
                ours.join(" and ")
            ));
        }
    }
    Ok((same, format!("; Fig. 6 drawn again with it over {SPAN} time units: {}", words.join(", "))))
}

/// The classical method with few modes against the exponential one: the same random start of size 0.3.
fn plain(context: &Context<'_>, time: f64) -> Result<f64, Error> {
    let (length, modes, step) = EXPLICIT;
    let mut exponential = study(length, modes)?;
    let mut random = motiform_study::initial::Uniform::new(7, 0);
    for n in 1..=6 {
        exponential.set_initial(&format!("c{n}"), 0.3 * random.draw())?;
        exponential.set_initial(&format!("s{n}"), 0.3 * random.draw())?;
    }
    // the path is recorded at the end only
    (exponential.run.transient, exponential.run.t_end, exponential.run.dt_out) = (time - 1.0, 1.0, 1.0);
    (exponential.run.rtol, exponential.run.atol) = (1e-10, Some(1e-12));
    let mut explicit = exponential.clone();
    "rk4".clone_into(&mut explicit.run.stepper);
    explicit.run.step = Some(step);
    let (one, other) = (context.simulate(&explicit)?, context.simulate(&exponential)?);
    Ok(difference(&one.manifest.state.values(), &other.manifest.state.values(), 2 * modes))
}

/// The largest stable step of the classical method with the paper's modes.
fn largest_step() -> Result<f64, Error> {
    let mut paper = study(21.6, MODES)?;
    "rk4".clone_into(&mut paper.run.stepper);
    paper.run.step = Some(STEP);
    match RunPlan::new(&paper) {
        Err(Error::UnstableStep { largest, .. }) => Ok(largest),
        Err(error) => Err(error),
        Ok(_) => Ok(f64::NAN),
    }
}
