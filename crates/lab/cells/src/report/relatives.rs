//! Spectra, rests, legs, rotation and the 0-1 test of a record.

use crate::Units;
use crate::report::Setting;
use crate::report::numbers::plain;
use crate::{Finding, ObservedLegs, ObservedRests, Relatives, SpectralPeak};
use motiform_figures::palette::CATEGORIES;
use motiform_figures::report::{Cell, ReportFigure, Table};
use motiform_figures::{Chart, SpectrumCurve};
use motiform_study::Error;
use motiform_study::titles::capital;

/// The motions that the record shows, and why it does not show the others.
pub(crate) fn table(found: &Relatives, units: &Units) -> Table {
    let mut rows: Vec<(String, String)> = found
        .spectra
        .iter()
        .map(|of| (format!("peaks of the spectrum of {}", symbol(of.quantity)), peaks(&of.peaks, units)))
        .collect();
    rows.push(("rests".to_owned(), said(&found.rests, |rests| rests_words(rests, units))));
    rows.push(("legs".to_owned(), said(&found.legs, |legs| legs_words(legs, units))));
    rows.push(("turns of the heading".to_owned(), format!("{} turns net", plain(found.rotation.heading))));
    let shape = found.rotation.shape.map_or_else(
        || "not seen: *z*_2 is not clear of its errors".to_owned(),
        |turns| format!("{} turns net", plain(turns)),
    );
    rows.push(("turns of the shape".to_owned(), shape));
    let zero_one = said(&found.zero_one, |k| {
        format!(
            "*K* = {:.2} ({:.2} to {:.2}), {} samples {} {} apart",
            k.k,
            k.lower,
            k.upper,
            k.samples,
            plain(k.interval),
            units.times()
        )
    });
    rows.push(("0-1 test".to_owned(), zero_one));
    Table {
        caption: "What the classifier of simulated motions looks at, from the samples.".to_owned(),
        head: ["property", "found"].map(str::to_owned).to_vec(),
        rows: rows.into_iter().map(|(name, value)| vec![Cell::text(name), Cell::text(value)]).collect(),
    }
}

fn said<T>(finding: &Finding<T>, words: impl Fn(&T) -> String) -> String {
    match finding {
        Finding::Found(found) => words(found),
        Finding::Missing { reason } => capital(reason),
    }
}

fn peaks(peaks: &[SpectralPeak], units: &Units) -> String {
    let one = |peak: &SpectralPeak| {
        let (frequency, period) = (plain(peak.frequency), plain(1.0 / peak.frequency));
        let share = 100.0 * peak.share;
        format!(
            "{frequency} per {} (period {period} {}; {share:.0} % of the variance)",
            units.time,
            units.times()
        )
    };
    let all: Vec<String> = peaks.iter().map(one).collect();
    if all.is_empty() { "none".to_owned() } else { all.join("; ") }
}

fn rests_words(rests: &ObservedRests, units: &Units) -> String {
    let Some(duration) = rests.duration else { return "none".to_owned() };
    let growth = rests.growth.map_or_else(String::new, |ratio| {
        format!("; each lasts {} times as long as the one before (median)", plain(ratio))
    });
    format!(
        "{}, of {} {} (median); {:.0} % of the time{growth}",
        rests.count,
        plain(duration),
        units.times(),
        100.0 * rests.share
    )
}

fn legs_words(legs: &ObservedLegs, units: &Units) -> String {
    let (Some(length), Some(duration), Some(swing)) = (legs.length, legs.duration, legs.swing) else {
        return format!("none: {} corners", legs.corners);
    };
    let turn = legs.turn.map_or_else(String::new, |turn| format!(", the chords by {} rad", plain(turn)));
    format!(
        "{} corners; legs of {} {} and {} {}; the heading turns by {} rad{turn} (medians)",
        legs.corners,
        plain(length),
        units.lengths(),
        plain(duration),
        units.times(),
        plain(swing)
    )
}

/// The spectra, each over its variance.
pub(crate) fn figure(found: &Relatives, setting: &Setting<'_>) -> Result<Option<ReportFigure>, Error> {
    let units = &setting.units;
    let Some(first) = found.spectra.first() else { return Ok(None) };
    let curve = |(number, of): (usize, &crate::ObservedSpectrum)| {
        let total: f64 = of.power.iter().sum::<f64>() * of.spacing;
        let power = of.power.iter().map(|p| p / total.max(f64::MIN_POSITIVE)).collect();
        SpectrumCurve { label: symbol(of.quantity), colour: CATEGORIES[number % CATEGORIES.len()], power }
    };
    let frequencies = (0..first.power.len()).map(|k| k as f64 * first.spacing).collect();
    let known = found.spectra.iter().filter(|of| of.power.len() == first.power.len());
    let curves: Vec<SpectrumCurve> = known.enumerate().map(curve).collect();
    if !curves.iter().any(|curve| curve.power.iter().skip(1).any(|p| *p > 0.0)) {
        return Ok(None);
    }
    let figure = Chart {
        x_label: format!("frequency (cycles per {})", units.time),
        y_label: format!("power over variance ({})", units.time),
        ..Chart::spectra(frequencies, curves)
    };
    let caption = "Power spectra (Welch's method, windows of half the record), each over its variance.";
    setting.figure(figure, caption).map(Some)
}

fn symbol(quantity: &str) -> String {
    match quantity {
        "|z2|" => "|*z*_2|".to_owned(),
        "z2 across" => "*z*_2 across".to_owned(),
        other => other.to_owned(),
    }
}
