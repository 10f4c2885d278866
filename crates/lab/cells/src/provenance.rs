//! The table `[fit]` of a fitted model's study file: the data and settings that the equations come from, and how well their parameters
//! are known.

use crate::work::digest;
use crate::{CellFit, FitOptions, Fitted, Result, Sample, Units};
use motiform_inference::paper;
use toml::Value;

/// The study file of a fit: the model, then `[fit]`. Simulations do not read that table; it is there to make the fit again, and for its
/// covariance.
///
/// # Errors
/// Equations that are no model.
pub(crate) fn study_file(
    sample: &Sample,
    fit: &CellFit,
    fitted: &Fitted,
    options: &FitOptions,
) -> Result<String> {
    let mut text = fitted.study(&fit.name, sample.radius(&fit.name))?.to_toml()?;
    text += "\n# Where these equations come from. Simulations do not read this table.\n[fit]\n";
    for (key, value) in entries(sample, fit, fitted, options) {
        text += &format!("{key} = {value}\n");
    }
    text += &covariance(fitted);
    Ok(text)
}

/// Everything that is needed to make the fit again, and its likelihood.
fn entries(
    sample: &Sample,
    fit: &CellFit,
    fitted: &Fitted,
    options: &FitOptions,
) -> Vec<(&'static str, Value)> {
    let own = sample.cells.iter().filter(|cell| options.together || cell.name == fit.name);
    let (mut cells, mut intervals, mut digests) = (Vec::new(), Vec::new(), Vec::new());
    for cell in own {
        cells.push(cell.name.clone());
        intervals.push(cell.track.interval());
        digests.push(digest(cell, options.modes));
    }
    let Units { length, time, .. } = Units::of(sample);
    let whole = |number: u64| i64::try_from(number).map_or_else(|_| number.to_string().into(), Value::from);
    let mut all = vec![
        ("files", sample.tracks.files.clone().into()),
        ("cells", cells.into()),
        ("unit_of_length", length.into()),
        ("unit_of_time", time.into()),
        ("intervals", intervals.into()),
        ("frames", whole(fit.frames as u64)),
        ("sha256_of_frames", digests.into()),
        ("order", whole(options.order.into())),
        ("modes", whole(options.modes as u64)),
        ("draws", whole(options.draws as u64)),
        ("seed", whole(options.seed)),
        ("simulations", whole(options.simulations as u64)),
        ("log_likelihood", fitted.model().log_likelihood.into()),
    ];
    let [velocity, shape] = fitted.errors_of_noise();
    all.extend(shape.map(|error| ("error_of_noise", error.into())));
    all.extend(velocity.map(|error| ("error_of_noise_velocity", error.into())));
    all
}

/// The covariance of the parameters of the model file: that of the coefficients, divided by the factors that the equations have.
fn covariance(fitted: &Fitted) -> String {
    let model = fitted.model();
    let (names, factors): (Vec<String>, Vec<f64>) =
        model.coefficients.iter().map(|c| paper(&c.term, c.imaginary)).unzip();
    let mut text = format!("parameters = {}\ncovariance = [\n", Value::from(names));
    for (row, a) in model.covariance_of_coefficients().iter().zip(&factors) {
        let scaled: Vec<String> = row.iter().zip(&factors).map(|(x, b)| number(x / (a * b))).collect();
        text += &format!("    [{}],\n", scaled.join(", "));
    }
    text + "]\n"
}

/// Every digit, with an exponent; `nan` where a search without end left no covariance.
fn number(x: f64) -> String {
    if x.is_finite() { format!("{x:e}") } else { "nan".to_owned() }
}
