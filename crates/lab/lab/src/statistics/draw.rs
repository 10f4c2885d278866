//! The figures of statistics.

mod curves;
mod displacement;
mod units;

use crate::draw::{FigureFormat, Picture, files, parameters};
use crate::statistics::{Measurement, Result};
use motiform_figures::Figure;
use motiform_statistics::Errors;
use motiform_study::Shown;

/// Draws `msd`, `exponent`, `autocorrelations`, `speed`, `turning`, `spectra` and `first-passage` as SVG and PNG (and PDF if requested), as
/// far as there is something to draw.
///
/// # Errors
/// Numbers that do not fit on an axis.
pub fn draw(measurement: &Measurement, format: &FigureFormat) -> Result<Vec<Picture>> {
    let units = &format.units;
    let figures: [(&'static str, Option<Box<dyn Figure>>); 7] = [
        ("msd", displacement::displacements(measurement, units)?),
        ("exponent", displacement::exponents(measurement, units)?),
        ("autocorrelations", curves::autocorrelations(measurement, units)?),
        ("speed", curves::speeds(measurement, units)?),
        ("turning", curves::turning(measurement, units)?),
        ("spectra", curves::spectra(measurement, units)?),
        ("first-passage", displacement::passages(measurement, units)?),
    ];
    let there = figures.into_iter().filter_map(|(name, figure)| Some((name, figure?)));
    Ok(files(there.collect(), false, format)?)
}

/// The caption: parameters, noise, bodies, and what the bands or bars (`marks`) are; then `more`.
fn caption(measurement: &Measurement, units: &Shown, marks: &str, more: &[&str]) -> Result<Vec<String>> {
    let mut lines = vec![parameters(&measurement.plan, units)?];
    let c = &measurement.plan.computation;
    let in_units = if units.is_physical() { " (model units)" } else { "" };
    let noise = match &c.noise {
        Some(noise) => format!(" Noise{in_units}: {}.", noise.words(measurement.plan.body()?.as_ref())),
        None => String::new(),
    };
    let found = &measurement.statistics;
    let what = match found.errors {
        Errors::Blocks { .. } if found.no_intervals.is_some() => {
            let bodies =
                if found.bodies == 1 { "One body".to_owned() } else { format!("{} bodies", found.bodies) };
            format!("{bodies}; no intervals: blocks of the tracks are alike.")
        }
        Errors::Bodies { count } => format!("{count} bodies; {marks}: 95 % intervals over bodies."),
        Errors::Blocks { count, .. } if found.bodies == 1 => {
            format!("One body; {marks}: 95 % intervals over {count} blocks of its track.")
        }
        Errors::Blocks { count, .. } => {
            format!("{} bodies; {marks}: 95 % intervals over {count} blocks of their tracks.", found.bodies)
        }
    };
    lines.push(format!("{what}{noise}"));
    lines.extend(more.iter().map(|&text| text.to_owned()));
    Ok(lines)
}

/// The title with a subject.
fn title(measurement: &Measurement, subject: &str) -> String {
    format!("{}: {subject}", measurement.title)
}
