//! Checks of the numbers of a study.

use crate::named::Named;
use crate::plan::Control;
use crate::scan::Axis;
use crate::study::{DisplaySettings, FigureSettings};
use crate::{Error, Shown};
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Model, Obstacle, Semilinear};
use motiform_models::ModelInfo;

/// Maximum number of steps of a run: hours of computing.
const MOST_STEPS: f64 = 1e10;

/// An adaptive explicit step times the fastest rate: the edge of stability of methods of order 5 and 8.
const STEP_TIMES_RATE: f64 = 5.0;

/// Checks that a setting is finite and `ok`.
///
/// # Errors
/// [`Error::Setting`] with the remedy.
pub fn check(key: &'static str, value: f64, ok: bool, remedy: &'static str) -> Result<(), Error> {
    if ok && value.is_finite() {
        Ok(())
    } else {
        // Debug, for it writes 1e-300 and not 300 zeros.
        let value = format!("{value:?}").trim_end_matches(".0").to_owned();
        Err(Error::Setting { key, value, remedy })
    }
}

/// Rejects a study with noise if an analysis is defined only for the flow without noise.
pub fn check_no_noise(amplitude: f64) -> Result<(), Error> {
    check(
        "noise",
        amplitude,
        amplitude == 0.0,
        "motions are named, and exponents computed, without noise: set it to 0",
    )
}

/// An explicit method is stable where its step times every rate of the linear part is small.
pub fn check_stability(model: &dyn Model, method: Method, control: Control) -> Result<(), Error> {
    let (Method::Explicit(tableau), Control::Fixed { step }) = (method, control) else { return Ok(()) };
    let mut rates = vec![0.0; model.dim()];
    Semilinear::<f64>::linear(model, &mut rates);
    let fastest = rates.iter().fold(0.0, |fastest: f64, rate| fastest.max(-rate));
    // The real stability intervals: 2 for orders 1 and 2, 2.785 for the classical method of order 4.
    let largest = if tableau.order < 4 { 2.0 } else { 2.785 } / fastest;
    if step > largest { Err(Error::UnstableStep { step, stepper: tableau.name, largest }) } else { Ok(()) }
}

/// Rejects a run that would not end: too many steps for the time, because they are fixed and tiny, or because the fastest
/// rate of the linear part keeps an explicit method to steps of some times its inverse.
pub fn check_steps(model: &dyn Model, method: Method, control: Control, time: f64) -> Result<(), Error> {
    if let Control::Fixed { step } = control {
        let remedy = "this takes more than 10 thousand million steps: give a larger step, or a shorter time";
        return check("step", step, time / step <= MOST_STEPS, remedy);
    }
    let Method::Explicit(tableau) = method else { return Ok(()) };
    let mut rates = vec![0.0; model.dim()];
    Semilinear::<f64>::linear(model, &mut rates);
    let rate = rates.iter().fold(0.0, |fastest: f64, rate| fastest.max(rate.abs()));
    if rate * time / STEP_TIMES_RATE <= MOST_STEPS {
        return Ok(());
    }
    Err(Error::Stiff { rate, time, stepper: tableau.name })
}

/// An initial state must be a body.
pub(crate) fn check_start(model: &dyn Model, initial: &Named) -> Result<(), Error> {
    let values = initial.values();
    let shape = model.encoded(&values[..model.dim()]);
    check_closed(model, &shape)
}

/// A shape must be a body.
pub fn check_closed(model: &dyn Model, shape: &[f64]) -> Result<(), Error> {
    match model.obstacle(shape) {
        Some(Obstacle::Closure { residual }) => Err(Error::NotClosed { residual }),
        _ => Ok(()),
    }
}

/// Checks settings of figures that were changed after the plan was made.
///
/// # Errors
/// [`Error::Setting`] naming the key, the value and the remedy.
pub fn check_figure(figure: &FigureSettings) -> Result<(), Error> {
    check("figure.radius", figure.radius, figure.radius >= 0.0, "give a radius above 0, or 0 to choose it")?;
    check("figure.scale", figure.scale, figure.scale >= 0.0, "give a factor above 0, or 0 to choose it")?;
    check("figure.from", figure.from, figure.from >= 0.0, "give a time of at least 0")?;
    let after = figure.to == 0.0 || figure.to > figure.from;
    check("figure.to", figure.to, after, "give a time after figure.from, or 0 for the end")?;
    if figure.outlines > 2000 {
        let value = figure.outlines.to_string();
        return Err(Error::Setting { key: "figure.outlines", value, remedy: "give at most 2000" });
    }
    Shown::parse(&figure.units).map(|_| ())
}

/// Checks the display of a body.
pub(crate) fn check_display(display: &DisplaySettings) -> Result<(), Error> {
    let (sample, speed) = (display.sample, display.speed);
    check("display.sample", sample, sample > 0.0, "give a model time above 0")?;
    let [slowest, fastest] = display.speeds();
    let usable = (slowest..=fastest).contains(&speed);
    check("display.speed", speed, usable, "give a model time per second from 2 to 3000 times display.sample")
}

/// Checks the sides of the map that a body is shown on.
pub(crate) fn check_plane(info: &ModelInfo, plane: &[Axis]) -> Result<(), Error> {
    let wrong = |text: String, problem: String| Err(Error::Axis { text, problem });
    if !(1..=2).contains(&plane.len()) || plane.iter().skip(1).any(|side| side.name == plane[0].name) {
        let names: Vec<&str> = plane.iter().map(|side| side.name.as_str()).collect();
        return wrong(names.join(", "), "a plane has one side or two, along different parameters".to_owned());
    }
    for side in plane {
        let spec = info.parameters().iter().find(|spec| spec.name == side.name);
        let (min, max) = spec.map_or((f64::MIN, f64::MAX), |spec| spec.allowed);
        let allowed = |low: f64, high: f64| min <= low && low < high && high <= max;
        if !matches!(side.values[..], [low, high] if allowed(low, high)) {
            let problem =
                format!("give its lowest and its highest value, {min} to {max}, e.g. {}=0.1,0.5", side.name);
            return wrong(side.name.clone(), problem);
        }
    }
    Ok(())
}
