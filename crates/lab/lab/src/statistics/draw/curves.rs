//! Autocorrelations, distributions and spectra.

use super::displacement::point;
use super::units::{in_words, with_axes};
use super::{caption, title};
use crate::statistics::{Measurement, Result};
use motiform_figures::{BandCurve, BandPoint, Chart, ExpectedLine, Figure, LineStyle};
use motiform_statistics::{Autocorrelation, Histogram, Quantity as Of, four_digits};
use motiform_study::quantity::state::SPEED;
use motiform_study::quantity::statistic::{
    CORRELATION, DENSITY, FREQUENCY, LAG, PER_DEGREE, POWER, TURNING_ANGLE,
};
use motiform_study::{Dimension, Quantity, Shown};
use std::f64::consts::{PI, TAU};

/// Lags are drawn up to this many of the longest correlation time.
const TIMES: f64 = 8.0;

/// Decays that differ by more than this factor share a logarithmic axis.
const APART: f64 = 10.0;

/// Most points of a curve.
const MOST: usize = 1000;

/// Ratio of neighbouring lags on a logarithmic axis.
const RATIO: f64 = 1.01;

/// Most curves of a figure.
const CURVES: usize = 6;

fn symbol(quantity: &Of) -> String {
    match quantity {
        Of::Velocity => "velocity ***v***".to_owned(),
        Of::Heading => "heading ***v***/|***v***|".to_owned(),
        Of::Speed => SPEED.symbol.to_owned(),
        Of::Mode(_, name) => match name.strip_prefix("mode") {
            Some(number) => format!("mode {number}"),
            None => format!("mode *{}*", name.replace('_', ", ")),
        },
    }
}

/// rho against lag.
pub(super) fn autocorrelations(measurement: &Measurement, units: &Shown) -> Result<Option<Box<dyn Figure>>> {
    let varying: Vec<&Autocorrelation> =
        measurement.statistics.autocorrelations.iter().filter(|found| !found.lags.is_empty()).collect();
    let decays = decays(&varying);
    let [least, end] =
        [decays.iter().copied().fold(f64::INFINITY, f64::min), decays.iter().copied().fold(0.0, f64::max)];
    let logarithmic_x = end > APART * least;
    let curve = |found: &&Autocorrelation| {
        let rows = found.lags.iter().zip(&found.correlation).filter(|(lag, _)| **lag <= end);
        let points = thinned(rows.map(|(lag, rho)| point(*lag, rho)).collect(), logarithmic_x);
        BandCurve { label: symbol(&found.quantity), points }
    };
    let curves: Vec<BandCurve> = varying.iter().take(CURVES).map(curve).collect();
    let hidden = hidden(&curves);
    let figure = Chart {
        title: title(measurement, "autocorrelations"),
        caption: caption(
            measurement,
            units,
            "bands",
            &hidden.iter().map(String::as_str).collect::<Vec<_>>(),
        )?,
        zero_line: true,
        logarithmic_x,
        ..Chart::default()
    }
    .with(curves);
    Ok(with_axes(figure, [&LAG, &CORRELATION], units))
}

/// At most so many points, evenly spaced along the axis.
fn thinned(points: Vec<BandPoint>, logarithmic: bool) -> Vec<BandPoint> {
    let every = points.len().div_ceil(MOST).max(1);
    let mut next = 0.0;
    let kept = |(place, p): (usize, BandPoint)| {
        let keep = if logarithmic { p.x >= next } else { place % every == 0 };
        next = if keep { p.x * RATIO } else { next };
        keep.then_some(p)
    };
    points.into_iter().enumerate().filter_map(kept).collect()
}

/// The largest lag to draw of each quantity: until its correlation has decayed; all lags where it does not.
fn decays(all: &[&Autocorrelation]) -> Vec<f64> {
    let decays = all.iter().map(|found| {
        let length = found.lags[found.lags.len() - 1];
        found.time.known().map_or(length, |_| decay(found).min(length))
    });
    decays.collect()
}

/// Eight decay times: of the envelope, twice the integral of rho^2.
fn decay(found: &Autocorrelation) -> f64 {
    let dt = found.lags.get(1).copied().unwrap_or(1.0);
    let mut squares = 0.5;
    for (lag, rho) in found.correlation.iter().enumerate().skip(1) {
        squares += rho.value * rho.value;
        if lag as f64 >= 2.0 * TIMES * squares {
            return lag as f64 * dt;
        }
    }
    f64::INFINITY
}

/// The curves that lie within this of another one, as a part of the range of all, are hidden by it: less than a line is wide.
const HIDDEN: f64 = 0.002;

/// Says which curves lie beneath later ones: they are not seen.
fn hidden(curves: &[BandCurve]) -> Vec<String> {
    let values = || curves.iter().flat_map(|curve| &curve.points).map(|point| point.y);
    let range = values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
    let same = |a: &BandCurve, b: &BandCurve| {
        let near = |(a, b): (&BandPoint, &BandPoint)| (a.y - b.y).abs() < HIDDEN * range;
        a.points.len() == b.points.len() && a.points.iter().zip(&b.points).all(near)
    };
    let above = |(place, one): (usize, &BandCurve)| {
        let other = curves[place + 1..].iter().rev().find(|other| same(one, other))?;
        Some(format!("The curve of {} lies beneath that of {}.", one.label, other.label))
    };
    curves.iter().enumerate().filter_map(above).collect()
}

/// The outline of a histogram; `unit` rescales the variable. Empty bins have no bands ([`empty`]).
fn stairs(histogram: &Histogram, unit: f64) -> Vec<BandPoint> {
    let corner = |x: f64, [y, low, high]: [f64; 3]| BandPoint {
        x: x / unit,
        y: y * unit,
        low: low * unit,
        high: high * unit,
    };
    let ends = |bin: &motiform_statistics::Bin| {
        // without an interval there is no band
        let ends =
            if bin.lower.is_nan() || bin.count == 0 { [bin.density; 2] } else { [bin.lower, bin.upper] };
        let values = [bin.density, ends[0], ends[1]];
        [corner(bin.from, values), corner(bin.to, values)]
    };
    histogram.bins.iter().flat_map(ends).collect()
}

/// The upper limit that empty bins of histograms have, in words; nothing where none is empty, or has a limit. Bands of all of them would
/// fill the frame.
fn empty<'h>(all: impl Iterator<Item = &'h Histogram>, limit: impl Fn(f64) -> String) -> Option<String> {
    let bins = all.flat_map(|histogram| &histogram.bins);
    let upper = bins.filter(|bin| bin.count == 0 && bin.upper.is_finite()).map(|bin| bin.upper);
    let upper = upper.fold(0.0, f64::max);
    (upper > 0.0).then(|| format!("Empty bins have no bands; their upper limit is at most {}.", limit(upper)))
}

/// The distribution of the speed.
pub(super) fn speeds(measurement: &Measurement, units: &Shown) -> Result<Option<Box<dyn Figure>>> {
    let Some(speeds) = &measurement.statistics.speeds else { return Ok(None) };
    let worth = if speeds.independent < speeds.samples as f64 {
        format!("{} samples, worth {:.0} independent ones.", speeds.samples, speeds.independent)
    } else {
        format!("{} samples.", speeds.samples)
    };
    let density = Quantity { dimension: SPEED.dimension.inverse(), ..DENSITY };
    let limit = empty([speeds].into_iter(), |upper| in_words(units, density.dimension, upper));
    let more: Vec<&str> = [worth.as_str()].into_iter().chain(limit.as_deref()).collect();
    let figure = Chart {
        title: title(measurement, "distribution of the speed"),
        caption: caption(measurement, units, "bands", &more)?,
        zero_line: true,
        ..Chart::default()
    }
    .with([BandCurve { label: "measured".to_owned(), points: stairs(speeds, 1.0) }]);
    Ok(with_axes(figure, [&SPEED, &density], units))
}

/// The distributions of turning angles, in degrees.
pub(super) fn turning(measurement: &Measurement, units: &Shown) -> Result<Option<Box<dyn Figure>>> {
    let moving: Vec<&motiform_statistics::Turning> =
        measurement.statistics.turning.iter().filter(|turning| turning.angles.samples > 0).collect();
    if moving.is_empty() {
        return Ok(None);
    }
    let curve = |turning: &&motiform_statistics::Turning| BandCurve {
        label: format!("*τ* = {}", in_words(units, Dimension::TIME, turning.lag)),
        points: stairs(&turning.angles, PI / 180.0),
    };
    let curves: Vec<BandCurve> = moving.iter().map(curve).collect();
    let limit = empty(moving.iter().map(|turning| &turning.angles), |upper| {
        format!("{} per degree", four_digits(upper * PI / 180.0))
    });
    let notes: Vec<String> = limit.into_iter().chain(hidden(&curves)).collect();
    let level = PI / 180.0 / TAU;
    let figure = Chart {
        title: title(measurement, "turning angles between displacements of lag *τ*"),
        caption: caption(measurement, units, "bands", &notes.iter().map(String::as_str).collect::<Vec<_>>())?,
        zero_line: true,
        ..Chart::default()
    }
    .with(curves)
    .with([ExpectedLine {
        label: "uniform".to_owned(),
        style: LineStyle::Dotted,
        points: vec![[-180.0, level], [180.0, level]],
    }]);
    Ok(with_axes(figure, [&TURNING_ANGLE, &PER_DEGREE], units))
}

/// Part of the largest power from which on spectra are drawn: below, there is what the window leaks of stronger frequencies, and round-off.
const DRAWN: f64 = 1e-10;

/// Power spectra with their bands.
pub(super) fn spectra(measurement: &Measurement, units: &Shown) -> Result<Option<Box<dyn Figure>>> {
    let found = &measurement.statistics.spectra;
    let curve = |spectrum: &motiform_statistics::PowerSpectrum| {
        // without an interval there is no band
        let [low, high] = spectrum.band.map(|factor| if factor.is_nan() { 1.0 } else { factor });
        let least = DRAWN * spectrum.power.iter().copied().fold(0.0, f64::max);
        let rows = spectrum.frequencies.iter().zip(&spectrum.power).filter(|(_, power)| **power > least);
        let points = rows.map(|(&x, &y)| BandPoint { x, y, low: low * y, high: high * y }).collect();
        BandCurve { label: symbol(&spectrum.quantity), points }
    };
    let method = found.first().map_or(String::new(), |first| {
        format!(
            "Welch's method: {} half-overlapping segments of {} samples, Hann window; bands: chi-square, 95 % at each frequency. \
             Drawn down to 10^{{-10}} of the largest power of each.",
            first.segments, first.length
        )
    });
    let mut caption = caption(measurement, units, "bands", &[&method])?;
    if let Some(line) = caption.get_mut(1) {
        *line = line.replace("; bands: 95 % intervals over bodies", "");
    }
    let figure = Chart {
        title: title(measurement, "power spectra"),
        caption,
        logarithmic_x: true,
        logarithmic_y: true,
        ..Chart::default()
    }
    .with(found.iter().map(curve).filter(|curve| !curve.points.is_empty()).take(CURVES));
    Ok(with_axes(figure, [&FREQUENCY, &POWER], units))
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_statistics::Bin;

    #[test]
    fn curves_on_each_other_are_told() {
        let curve = |label: &str, shift: f64| BandCurve {
            label: label.to_owned(),
            points: (0..9).map(f64::from).map(|x| BandPoint { x, y: x + shift, low: x, high: x }).collect(),
        };
        let told = hidden(&[curve("velocity", 0.0), curve("heading", 0.01), curve("speed", 0.5)]);
        assert_eq!(told, ["The curve of velocity lies beneath that of heading."]);
    }

    #[test]
    fn empty_bins_have_a_limit_instead_of_a_band() {
        let bin =
            |count: usize, density: f64| Bin { from: 0.0, to: 1.0, count, density, lower: 0.0, upper: 0.3 };
        let histogram = |bins: Vec<Bin>| Histogram { bins, samples: 9, independent: 9.0 };
        let found = histogram(vec![bin(0, 0.0), bin(9, 1.0)]);
        let points = stairs(&found, 1.0);
        assert_eq!((points[0].high, points[2].high), (0.0, 0.3));
        let told = |found| empty([found].into_iter(), |upper| upper.to_string());
        assert!(told(&found).is_some_and(|told| told.ends_with("at most 0.3.")));
        assert_eq!(told(&histogram(vec![bin(9, 1.0)])), None);
    }
}
