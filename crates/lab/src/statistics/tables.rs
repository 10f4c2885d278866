//! The statistics as tables.

use motiform_statistics::{Autocorrelation, Histogram, Measured, PowerSpectrum, Quantity, Statistics, furth};
use motiform_store::columns::{Column, Values};

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

fn number(name: &str, meaning: &'static str, values: impl Iterator<Item = f64>) -> Column {
    Column::new(name, meaning, Values::Number(values.collect()))
}

fn whole(name: &str, meaning: &'static str, values: impl Iterator<Item = usize>) -> Column {
    let values = values.map(|value| i64::try_from(value).unwrap_or(i64::MAX));
    Column::new(name, meaning, Values::Whole(values.collect()))
}

fn text(name: &str, meaning: &'static str, values: impl Iterator<Item = String>) -> Column {
    Column::new(name, meaning, Values::Text(values.collect()))
}

fn msd(found: &Statistics) -> Vec<Column> {
    let points = found.displacement.points();
    let exponent = |of: fn(&Measured) -> f64| {
        points.iter().map(move |p| p.exponent.as_ref().map_or(f64::NAN, of)).collect::<Vec<_>>().into_iter()
    };
    let fit = points.iter().map(|p| found.walk.curve.map_or(f64::NAN, |[s, time]| furth(s, time, p.lag)));
    vec![
        number("lag", "lag (model time)", points.iter().map(|p| p.lag)),
        number("msd", "mean-square displacement (model length^2)", points.iter().map(|p| p.value.value)),
        number("lower", "lower end of its 95 % interval", points.iter().map(|p| p.value.lower())),
        number("upper", "upper end of its 95 % interval", points.iter().map(|p| p.value.upper())),
        number("exponent", "d ln msd / d ln lag", exponent(|m| m.value)),
        number("exponent_lower", "lower end of its 95 % interval", exponent(Measured::lower)),
        number("exponent_upper", "upper end of its 95 % interval", exponent(Measured::upper)),
        number("fit", "fitted persistent random walk (model length^2)", fit),
        number("windows", "overlapping windows averaged", points.iter().map(|p| p.windows)),
    ]
}

fn autocorrelations(all: &[Autocorrelation]) -> Vec<Column> {
    let rows = || all.iter().flat_map(|found| (0..found.lags.len()).map(move |place| (found, place)));
    let rho = |of: fn(&Measured) -> f64| rows().map(move |(found, place)| of(&found.correlation[place]));
    vec![
        text(
            "quantity",
            "velocity, heading, speed, or a mode",
            rows().map(|row| row.0.quantity.name().to_owned()),
        ),
        number("lag", "lag (model time)", rows().map(|(found, place)| found.lags[place])),
        number("correlation", "C(lag)/C(0)", rho(|m| m.value)),
        number("lower", "lower end of its 95 % interval", rho(Measured::lower)),
        number("upper", "upper end of its 95 % interval", rho(Measured::upper)),
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
        text("quantity", "speed or turning_angle", rows().map(|row| row.0.to_owned())),
        number("lag", "lag of a turning angle (model time)", rows().map(|row| row.1)),
        number("from", "lower edge of the bin (model units, rad)", rows().map(|row| row.2.from)),
        number("to", "upper edge of the bin", rows().map(|row| row.2.to)),
        whole("count", "samples in the bin", rows().map(|row| row.2.count)),
        number("density", "probability density", rows().map(|row| row.2.density)),
        number("lower", "lower end of its 95 % interval", rows().map(|row| row.2.lower)),
        number("upper", "upper end of its 95 % interval", rows().map(|row| row.2.upper)),
    ]
}

fn spectra(all: &[PowerSpectrum]) -> Vec<Column> {
    let rows = || all.iter().flat_map(|found| (0..found.power.len()).map(move |place| (found, place)));
    let power = |factor: fn(&PowerSpectrum) -> f64| {
        rows().map(move |(found, place)| factor(found) * found.power[place])
    };
    let name = |quantity: &Quantity| quantity.name().to_owned();
    vec![
        text("quantity", "velocity, speed, or a mode", rows().map(|row| name(&row.0.quantity))),
        number("frequency", "cycles per model time", rows().map(|(found, place)| found.frequencies[place])),
        number(
            "power",
            "power spectral density (unit^2 x model time), summed over components",
            power(|_| 1.0),
        ),
        number("lower", "lower end of its 95 % interval", power(|found| found.band[0])),
        number("upper", "upper end of its 95 % interval", power(|found| found.band[1])),
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
        number("radius", "radius of the disc (model length)", all.iter().map(|p| p.radius)),
        number("mean", "mean first-passage time (model time)", mean(|m| m.value)),
        number("lower", "lower end of its 95 % interval", mean(Measured::lower)),
        number("upper", "upper end of its 95 % interval", mean(Measured::upper)),
        number("restricted", "mean of min(time, limit)", all.iter().map(|p| p.time.restricted.value)),
        number("limit", "limit of the restricted mean (model time)", all.iter().map(|p| p.time.limit)),
        number(
            "censored",
            "share of the starts that were not watched until they left",
            all.iter().map(|p| p.time.censored),
        ),
        whole("starts", "starting times", all.iter().map(|p| p.time.count)),
    ]
}
