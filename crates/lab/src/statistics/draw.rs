//! The figures of statistics.

mod curves;
mod displacement;

use crate::draw::{FigureFormat, Picture, files, parameters};
use crate::statistics::{Measurement, Result};
use motiform_figures::Figure;
use motiform_statistics::Errors;

/// Draws `msd`, `exponent`, `autocorrelations`, `speed`, `turning`, `spectra` and `first-passage` as SVG and PNG (and PDF if requested), as
/// far as there is something to draw.
///
/// # Errors
/// Numbers that do not fit on an axis.
pub fn draw(measurement: &Measurement, format: &FigureFormat) -> Result<Vec<Picture>> {
    let figures: [(&'static str, Option<Box<dyn Figure>>); 7] = [
        ("msd", displacement::displacements(measurement)?),
        ("exponent", displacement::exponents(measurement)?),
        ("autocorrelations", curves::autocorrelations(measurement)?),
        ("speed", curves::speeds(measurement)?),
        ("turning", curves::turning(measurement)?),
        ("spectra", curves::spectra(measurement)?),
        ("first-passage", displacement::passages(measurement)?),
    ];
    let there = figures.into_iter().filter_map(|(name, figure)| Some((name, figure?)));
    Ok(files(there.collect(), false, format)?)
}

/// The caption: parameters, noise, bodies, and what the bands or bars (`marks`) are; then `more`.
fn caption(measurement: &Measurement, marks: &str, more: &[&str]) -> Result<Vec<String>> {
    let mut lines = vec![parameters(&measurement.plan)?];
    let c = &measurement.plan.computation;
    let noise = c.noise.map_or(String::new(), |noise| format!(" Noise: {noise}."));
    let found = &measurement.statistics;
    let what = match found.errors {
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
