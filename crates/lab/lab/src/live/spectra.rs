//! Power spectra of a recorded motion.

use super::Record;
use motiform_analysis::welch;
use motiform_dynamics::Model;

/// Fewest samples that a spectrum is made of, and the longest segment.
const SAMPLES: (usize, usize) = (256, 2048);

/// Power spectra of the speed and of the model's observables, except those that do not vary beyond their errors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectra {
    /// Cycles per model time, without the frequency 0; empty if the record is too short.
    pub frequencies: Vec<f64>,
    /// Of each quantity: name, symbol (markup) and power spectral density.
    pub curves: Vec<(&'static str, &'static str, Vec<f64>)>,
    /// Segments averaged over.
    pub segments: usize,
}

/// Welch's method over the whole record, sampled every `dt`: about eight half-overlapping segments, of 2048 samples at most.
///
/// # Checked by  live/tests.rs: a body on a circle with a known frequency
pub fn spectra(record: &Record, model: &dyn Model, dt: f64) -> Spectra {
    let samples = record.len();
    if samples < SAMPLES.0 {
        return Spectra::default();
    }
    // Powers of 2: fast, and the axis of frequencies keeps still while the record grows.
    let segment = (1 << (samples * 2 / 9).max(SAMPLES.0 / 2).ilog2()).min(SAMPLES.1);
    let observables = model.observables().iter().map(|observable| (observable.name, observable.symbol));
    let names = std::iter::once(("speed", "|*v*|")).chain(observables);
    // The turning rate, which is undefined at rest, lies between.
    let columns = std::iter::once(0).chain(2..);
    let mut all = Spectra::default();
    for ((name, symbol), column) in names.zip(columns) {
        let values: Vec<f64> = record.rows().map(|row| row.read[column]).collect();
        let Ok(spectrum) = welch(&values, dt, segment) else { continue };
        all.segments = spectrum.segments;
        all.frequencies = spectrum.frequencies[1..].to_vec();
        if record.accuracy().varies(values) {
            all.curves.push((name, symbol, spectrum.power[1..].to_vec()));
        }
    }
    all
}
