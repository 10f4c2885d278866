//! The statistics as tables.

use motiform_statistics::{Autocorrelation, Histogram, Measured, PowerSpectrum, Statistics, furth};
use motiform_store::Quantity;
use motiform_store::columns::{Column, Values};
use motiform_store::quantity::statistic;

/// A table and its name.
pub struct Named {
    /// Name of the file, without its ending.
    pub name: &'static str,
    /// Its columns.
    pub columns: Vec<Column>,
}

/// `msd`, `autocorrelations`, `distributions`, `spectra` and `first_passage`. A number that is not known is NaN (null in files).
#[must_use]
pub fn tables(found: &Statistics) -> Vec<Named> {
    let named = |name, columns| Named { name, columns };
    vec![
        named("msd", msd(found)),
        named("autocorrelations", autocorrelations(&found.autocorrelations)),
        named("distributions", distributions(found)),
        named("spectra", spectra(&found.spectra)),
        named("first_passage", passages(found)),
    ]
}

fn number(quantity: &Quantity, values: impl Iterator<Item = f64>) -> Column {
    Column::of(quantity, Values::Number(values.collect()))
}

fn whole(quantity: &Quantity, values: impl Iterator<Item = usize>) -> Column {
    let values = values.map(|value| i64::try_from(value).unwrap_or(i64::MAX));
    Column::of(quantity, Values::Whole(values.collect()))
}

fn text(quantity: &Quantity, values: impl Iterator<Item = String>) -> Column {
    Column::of(quantity, Values::Text(values.collect()))
}

fn msd(found: &Statistics) -> Vec<Column> {
    let points = found.displacement.points();
    let exponent = |of: fn(&Measured) -> f64| {
        points.iter().map(move |p| p.exponent.as_ref().map_or(f64::NAN, of)).collect::<Vec<_>>().into_iter()
    };
    let fit = points.iter().map(|p| found.walk.curve.map_or(f64::NAN, |[s, time]| furth(s, time, p.lag)));
    vec![
        number(&statistic::LAG, points.iter().map(|p| p.lag)),
        number(&statistic::MSD, points.iter().map(|p| p.value.value)),
        number(&statistic::LOWER, points.iter().map(|p| p.value.lower())),
        number(&statistic::UPPER, points.iter().map(|p| p.value.upper())),
        number(&statistic::EXPONENT, exponent(|m| m.value)),
        number(&statistic::EXPONENT_LOWER, exponent(Measured::lower)),
        number(&statistic::EXPONENT_UPPER, exponent(Measured::upper)),
        number(&statistic::FIT, fit),
        number(&statistic::WINDOWS, points.iter().map(|p| p.windows)),
    ]
}

fn autocorrelations(all: &[Autocorrelation]) -> Vec<Column> {
    let rows = || all.iter().flat_map(|found| (0..found.lags.len()).map(move |place| (found, place)));
    let rho = |of: fn(&Measured) -> f64| rows().map(move |(found, place)| of(&found.correlation[place]));
    vec![
        text(&statistic::QUANTITY, rows().map(|row| row.0.quantity.name().to_owned())),
        number(&statistic::LAG, rows().map(|(found, place)| found.lags[place])),
        number(&statistic::CORRELATION, rho(|m| m.value)),
        number(&statistic::LOWER, rho(Measured::lower)),
        number(&statistic::UPPER, rho(Measured::upper)),
    ]
}

/// Name, lag (NaN for none) and histogram of each distribution.
fn histograms(found: &Statistics) -> Vec<(&'static str, f64, &Histogram)> {
    let speed = found.speeds.iter().map(|speeds| ("speed", f64::NAN, speeds));
    speed.chain(found.turning.iter().map(|turning| ("turning_angle", turning.lag, &turning.angles))).collect()
}

fn distributions(found: &Statistics) -> Vec<Column> {
    let all = histograms(found);
    let rows = || {
        all.iter().flat_map(|(name, lag, histogram)| histogram.bins.iter().map(move |bin| (*name, *lag, bin)))
    };
    vec![
        text(&statistic::QUANTITY, rows().map(|row| row.0.to_owned())),
        number(&statistic::LAG, rows().map(|row| row.1)),
        number(&statistic::FROM, rows().map(|row| row.2.from)),
        number(&statistic::TO, rows().map(|row| row.2.to)),
        whole(&statistic::COUNT, rows().map(|row| row.2.count)),
        number(&statistic::DENSITY, rows().map(|row| row.2.density)),
        number(&statistic::LOWER, rows().map(|row| row.2.lower)),
        number(&statistic::UPPER, rows().map(|row| row.2.upper)),
    ]
}

fn spectra(all: &[PowerSpectrum]) -> Vec<Column> {
    let rows = || all.iter().flat_map(|found| (0..found.power.len()).map(move |place| (found, place)));
    let power = |factor: fn(&PowerSpectrum) -> f64| {
        rows().map(move |(found, place)| factor(found) * found.power[place])
    };
    vec![
        text(&statistic::QUANTITY, rows().map(|row| row.0.quantity.name().to_owned())),
        number(&statistic::FREQUENCY, rows().map(|(found, place)| found.frequencies[place])),
        number(&statistic::POWER, power(|_| 1.0)),
        number(&statistic::LOWER, power(|found| found.band[0])),
        number(&statistic::UPPER, power(|found| found.band[1])),
    ]
}

fn passages(found: &Statistics) -> Vec<Column> {
    let all = &found.passages;
    let mean = |of: fn(&Measured) -> f64| {
        all.iter()
            .map(move |p| p.time.mean.known().as_ref().map_or(f64::NAN, of))
            .collect::<Vec<_>>()
            .into_iter()
    };
    vec![
        number(&statistic::RADIUS, all.iter().map(|p| p.radius)),
        number(&statistic::MEAN, mean(|m| m.value)),
        number(&statistic::LOWER, mean(Measured::lower)),
        number(&statistic::UPPER, mean(Measured::upper)),
        number(&statistic::RESTRICTED, all.iter().map(|p| p.time.restricted.value)),
        number(&statistic::LIMIT, all.iter().map(|p| p.time.limit)),
        number(&statistic::CENSORED, all.iter().map(|p| p.time.censored)),
        whole(&statistic::STARTS, all.iter().map(|p| p.time.count)),
    ]
}
