//! Power spectra of the deformation modes.

use super::body::Body;
use super::words;
use motiform_analysis::{Spectrum, welch};
use motiform_figures::palette::CATEGORIES;
use motiform_figures::{Chart, SpectrumCurve};
use motiform_study::Dimension;
use motiform_study::quantity::statistic::{FREQUENCY, POWER};

/// Modes whose spectra are drawn.
const MODES: usize = 4;

/// The dimension of a spectral density of lengths.
const DENSITY: Dimension = Dimension::of(2, 1);

/// Minimum number of samples for a spectrum.
const FEWEST: usize = 256;

/// The spectra of modes 1 to 4 of phi over the whole recording; `None` for models without such modes, and for short
/// recordings.
pub(super) fn figure(body: &Body<'_>) -> Option<Chart> {
    body.model.profile(&body.shape(body.rows().start), 8)?;
    let spectra: Vec<Spectrum> = (1..=MODES).map(|n| mode(body, n)).collect::<Option<_>>()?;
    let first = spectra.first()?;
    let curves = spectra.iter().enumerate().map(|(index, spectrum)| SpectrumCurve {
        label: format!("mode {}", index + 1),
        colour: CATEGORIES[index % CATEGORIES.len()],
        power: spectrum.power.iter().map(|power| power * body.units().factor(DENSITY)).collect(),
    });
    let method = format!(
        "Welch's method: {} segments, Hann window, half overlapping; each curve is the sum over the two components of a mode.",
        first.segments
    );
    let frequencies = first
        .frequencies
        .iter()
        .map(|frequency| frequency * body.units().factor(FREQUENCY.dimension))
        .collect();
    Some(Chart {
        title: format!("{}: power spectrum", body.dataset.title()),
        caption: vec![words::parameters(body), method],
        x_label: body.units().axis(&FREQUENCY),
        y_label: body.units().label(POWER.symbol, DENSITY),
        ..Chart::spectra(frequencies, curves.collect())
    })
}

/// The sum of the spectra of `c_n` and `s_n`, which does not depend on where s = 0 lies.
fn mode(body: &Body<'_>, n: usize) -> Option<Spectrum> {
    let dt = body.dataset.manifest.plan.computation.dt_out;
    let component = |letter: char| {
        let samples = body.column(&format!("{letter}{n}"));
        let segment = (samples.len() / 4).max(FEWEST);
        welch(samples, dt, segment).ok()
    };
    let (mut cosine, sine) = (component('c')?, component('s')?);
    for (power, other) in cosine.power.iter_mut().zip(&sine.power) {
        *power += other;
    }
    Some(cosine)
}
