//! The statistics as tables.

use motiform_statistics::{Autocorrelation, Histogram, Measured, PowerSpectrum, Statistics, furth};
use motiform_store::columns::Column;
use motiform_store::quantity::statistic;

/// A table and its name.
pub struct Named {
    /// Name of the file, without its ending.
    pub name: &'static str,
    /// Its columns.
    pub columns: Vec<Column>,
}

/// `msd`, `autocorrelations`, `distributions`, `spectra` and `first_passage`. A number that is not known is NaN (null in files).
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

fn msd(found: &Statistics) -> Vec<Column> {
    let points = found.displacement.points();
    let exponent = |of: fn(&Measured) -> f64| points.iter().map(move |p| p.exponent.as_ref().map(of));
    let fit = points.iter().map(|p| found.walk.curve.map_or(f64::NAN, |[s, time]| furth(s, time, p.lag)));
    vec![
        Column::of(&statistic::LAG, points.iter().map(|p| p.lag).collect()),
        Column::of(&statistic::MSD, points.iter().map(|p| p.value.value).collect()),
        Column::of(&statistic::LOWER, points.iter().map(|p| p.value.lower()).collect()),
        Column::of(&statistic::UPPER, points.iter().map(|p| p.value.upper()).collect()),
        Column::of(&statistic::EXPONENT, exponent(|m| m.value).collect()),
        Column::of(&statistic::EXPONENT_LOWER, exponent(Measured::lower).collect()),
        Column::of(&statistic::EXPONENT_UPPER, exponent(Measured::upper).collect()),
        Column::of(&statistic::FIT, fit.collect()),
        Column::of(&statistic::WINDOWS, points.iter().map(|p| p.windows).collect()),
    ]
}

fn autocorrelations(all: &[Autocorrelation]) -> Vec<Column> {
    let rows = || all.iter().flat_map(|found| (0..found.lags.len()).map(move |place| (found, place)));
    let rho = |of: fn(&Measured) -> f64| rows().map(move |(found, place)| of(&found.correlation[place]));
    vec![
        Column::of(&statistic::QUANTITY, rows().map(|row| row.0.quantity.name().to_owned()).collect()),
        Column::of(&statistic::LAG, rows().map(|(found, place)| found.lags[place]).collect()),
        Column::of(&statistic::CORRELATION, rho(|m| m.value).collect()),
        Column::of(&statistic::LOWER, rho(Measured::lower).collect()),
        Column::of(&statistic::UPPER, rho(Measured::upper).collect()),
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
        Column::of(&statistic::QUANTITY, rows().map(|row| row.0).collect()),
        Column::of(&statistic::LAG, rows().map(|row| row.1).collect()),
        Column::of(&statistic::FROM, rows().map(|row| row.2.from).collect()),
        Column::of(&statistic::TO, rows().map(|row| row.2.to).collect()),
        Column::of(&statistic::COUNT, rows().map(|row| row.2.count).collect()),
        Column::of(&statistic::DENSITY, rows().map(|row| row.2.density).collect()),
        Column::of(&statistic::LOWER, rows().map(|row| row.2.lower).collect()),
        Column::of(&statistic::UPPER, rows().map(|row| row.2.upper).collect()),
    ]
}

fn spectra(all: &[PowerSpectrum]) -> Vec<Column> {
    let rows = || all.iter().flat_map(|found| (0..found.power.len()).map(move |place| (found, place)));
    let power = |factor: fn(&PowerSpectrum) -> f64| {
        rows().map(move |(found, place)| factor(found) * found.power[place])
    };
    vec![
        Column::of(&statistic::QUANTITY, rows().map(|row| row.0.quantity.name().to_owned()).collect()),
        Column::of(&statistic::FREQUENCY, rows().map(|(found, place)| found.frequencies[place]).collect()),
        Column::of(&statistic::POWER, power(|_| 1.0).collect()),
        Column::of(&statistic::LOWER, power(|found| found.band[0]).collect()),
        Column::of(&statistic::UPPER, power(|found| found.band[1]).collect()),
    ]
}

fn passages(found: &Statistics) -> Vec<Column> {
    let all = &found.passages;
    let mean = |of: fn(&Measured) -> f64| all.iter().map(move |p| p.time.mean.known().as_ref().map(of));
    vec![
        Column::of(&statistic::RADIUS, all.iter().map(|p| p.radius).collect()),
        Column::of(&statistic::MEAN, mean(|m| m.value).collect()),
        Column::of(&statistic::LOWER, mean(Measured::lower).collect()),
        Column::of(&statistic::UPPER, mean(Measured::upper).collect()),
        Column::of(&statistic::RESTRICTED, all.iter().map(|p| p.time.restricted.value).collect()),
        Column::of(&statistic::LIMIT, all.iter().map(|p| p.time.limit).collect()),
        Column::of(&statistic::CENSORED, all.iter().map(|p| p.time.censored).collect()),
        Column::of(&statistic::STARTS, all.iter().map(|p| p.time.count).collect()),
    ]
}
