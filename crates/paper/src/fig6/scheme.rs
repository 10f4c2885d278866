//! The paper's scheme: a spectral method with the classical Runge-Kutta method.

use super::super::claims::claim;
use super::super::context::Context;
use super::lengths::study;
use motiform_report::Claim;
use motiform_study::{Error, Plan, Study};

/// Length, and modes: few enough for an explicit method.
const LENGTH: f64 = 13.4;
const MODES: usize = 8;

/// Step of the explicit method, and the time compared.
const STEP: f64 = 5e-4;

/// The paper's number of points: modes up to 64.
const PAPER: usize = 64;

/// Sentence 124.
pub(super) fn claim_of(context: &Context<'_>) -> Result<Claim, Error> {
    let time = context.choose(400.0, 100.0);
    let (mut explicit, mut exponential) = (start(LENGTH, MODES, time)?, start(LENGTH, MODES, time)?);
    "rk4".clone_into(&mut explicit.run.stepper);
    explicit.run.step = Some(STEP);
    (exponential.run.rtol, exponential.run.atol) = (1e-10, Some(1e-12));
    let scheme = apart(context, &explicit, &exponential, MODES)?;
    let short = context.choose(60.0, 30.0);
    let truncation = apart(context, &start(21.6, 15, short)?, &start(21.6, 30, short)?, 15)?;
    let mut paper = start(21.6, PAPER, short)?;
    "rk4".clone_into(&mut paper.run.stepper);
    paper.run.step = Some(1e-3);
    let largest = match Plan::new(&paper) {
        Err(Error::UnstableStep { largest, .. }) => largest,
        Err(error) => return Err(error),
        Ok(_) => f64::NAN,
    };
    Ok(claim(
        &[124],
        "We use the spectral method with the 4th order Runge-Kutta algorithm with the total number of wave modes *N* = 128.",
        format!(
            "at *L* = {LENGTH} the classical Runge-Kutta method with 8 modes and Δ*t* = 5·10^{{-4}} and the exponential method used here \
             end {scheme:.0e} apart (of the size of *φ*) after {time} time units; at *L* = 21.6 15 and 30 modes end {truncation:.0e} apart \
             after {short}. With 128 points (modes up to {PAPER}) the explicit method is stable for Δ*t* < {largest:.1e} only: that run is \
             not repeated"
        ),
        "the same random start of size 0.3; both differences below 10^{-5}; the stable step from the fastest decay rate",
        scheme < 1e-5 && truncation < 1e-5 && largest < 1e-6,
    ))
}

/// A random start that has the same first modes, however many there are.
fn start(length: f64, modes: usize, time: f64) -> Result<Study, Error> {
    let mut study = study(length, modes)?;
    let mut random = motiform_study::initial::Uniform::new(7, 0);
    for n in 1..=6 {
        study.set_initial(&format!("c{n}"), 0.3 * random.draw())?;
        study.set_initial(&format!("s{n}"), 0.3 * random.draw())?;
    }
    (study.run.transient, study.run.t_end, study.run.dt_out) = (0.0, time, time);
    (study.run.rtol, study.run.atol) = (1e-10, Some(1e-12));
    Ok(study)
}

/// The largest difference of the first modes at the end of two runs, against the largest mode.
fn apart(context: &Context<'_>, one: &Study, other: &Study, modes: usize) -> Result<f64, Error> {
    let (a, b) = (context.simulate(one)?, context.simulate(other)?);
    let (a, b) = (a.manifest.state.values(), b.manifest.state.values());
    let size = a[..2 * modes].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    Ok(a.iter().zip(&b).take(2 * modes).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size)
}
