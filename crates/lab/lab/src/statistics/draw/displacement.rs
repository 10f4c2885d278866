//! Displacements: mean square, its exponent, first-passage times.

use super::units::with_axes;
use super::{caption, title};
use crate::statistics::summary::value_in;
use crate::statistics::{Measurement, Result};
use motiform_figures::{
    BandCurve, BandPoint, Chart, ErrorBarSeries, ExpectedLine, Figure, Interval, LineStyle, Measured as Point,
};
use motiform_statistics::{Measured, furth};
use motiform_study::quantity::statistic::{EXPONENT, LAG, MEAN, MSD, RADIUS};
use motiform_study::{Dimension, Shown};

/// Points of a line.
const POINTS: usize = 200;

/// Lags that are drawn differ by this factor at least.
const APART: f64 = 1.25;

/// The reach of guide lines beyond the crossover, as a factor.
const BEYOND: f64 = 4.0;

/// Measured values as points of a curve; without an interval there is no band.
pub(super) fn point(x: f64, measured: &Measured) -> BandPoint {
    let [low, high] = measured.interval.unwrap_or([measured.value; 2]);
    BandPoint { x, y: measured.value, low, high }
}

/// The mean-square displacement with the fitted walk, both of its limits and the crossover.
pub(super) fn displacements(measurement: &Measurement, units: &Shown) -> Result<Option<Box<dyn Figure>>> {
    let found = &measurement.statistics;
    let points: Vec<BandPoint> = found.displacement.points().iter().map(|p| point(p.lag, &p.value)).collect();
    if !points.iter().any(|p| p.y > 0.0) {
        return Ok(None);
    }
    let unit = if units.is_physical() { " (numbers in model units)" } else { "" };
    let note = found.walk.persistence.reason().map(|reason| format!("Persistence time: {reason}{unit}."));
    let lines = lines(measurement, &points, units);
    let mut last = 0.0;
    let apart = |p: &BandPoint| {
        let kept = p.x > APART * last;
        last = if kept { p.x } else { last };
        kept
    };
    let shown: Vec<BandPoint> = points.into_iter().filter(apart).collect();
    let intervals =
        shown.iter().filter(|p| p.low < p.high).map(|p| Interval { x: p.x, low: p.low, high: p.high });
    let figure = Chart {
        title: title(measurement, "mean-square displacement"),
        caption: caption(measurement, units, "bars", &note.iter().map(String::as_str).collect::<Vec<_>>())?,
        logarithmic_x: true,
        logarithmic_y: true,
        ..Chart::default()
    }
    .with([intervals.collect::<Vec<_>>()])
    .with([measured(shown.iter().map(|p| (p.x, p.y)))])
    .with(lines); // on top: the dotted one lies on the points
    Ok(with_axes(figure, [&LAG, &MSD], units))
}

/// Values whose intervals are drawn by themselves.
fn measured(values: impl Iterator<Item = (f64, f64)>) -> ErrorBarSeries {
    let points = values.map(|(x, y)| Point { x, y, error: 0.0 }).collect();
    ErrorBarSeries { label: "measured".to_owned(), points, joined: false }
}

/// The fit, what is ballistic and what is diffusive in it, and where they meet.
fn lines(measurement: &Measurement, points: &[BandPoint], units: &Shown) -> Vec<ExpectedLine> {
    let walk = &measurement.statistics.walk;
    let Some([square, time]) = walk.curve else { return Vec::new() };
    let speed = measurement.statistics.rms_speed.value;
    let (first, last) = (points[0].x, points[points.len() - 1].x);
    let line = |label: String, style, range: (f64, f64), of: &dyn Fn(f64) -> f64| ExpectedLine {
        label,
        style,
        points: logarithmic(range).into_iter().map(|t| [t, of(t)]).collect(),
    };
    let mut lines = Vec::new();
    if walk.speed.known().is_some() || walk.persistence.known().is_some() {
        let label = "persistent random walk".to_owned();
        lines.push(line(label, LineStyle::Solid, (first, last), &|t| furth(square, time, t)));
    }
    let end = (BEYOND * time).clamp(first, last);
    if walk.speed.known().is_some() {
        lines.push(line("ballistic: *S*^2*τ*^2".to_owned(), LineStyle::Dashed, (first, end), &|t| {
            square * t * t
        }));
    } else if walk.diffusion.known().is_none() {
        // no persistent random walk, but its start is as straight
        let label = "ballistic: ⟨|***v***|^2⟩*τ*^2";
        lines.push(line(label.to_owned(), LineStyle::Dashed, (first, end), &|t| speed * speed * t * t));
    }
    lines.extend(diffusive(measurement, (first, last), units));
    // what ends before the first lag is no line
    lines.retain(|line| line.points.first() != line.points.last());
    if let Some(persistence) = walk.persistence.known() {
        let ends = points.iter().filter(|p| p.y > 0.0).map(|p| p.y);
        let (low, high) = ends.fold((f64::MAX, f64::MIN), |(low, high), y| (low.min(y), high.max(y)));
        let label = format!("crossover 2*P*, *P* = {}", value_in(units, Dimension::TIME, &persistence));
        let crossover = 2.0 * persistence.value; // S^2 t^2 = 4 D t
        let points = vec![[crossover, 0.1 * low], [crossover, 10.0 * high]];
        lines.push(ExpectedLine { label, style: LineStyle::DashDotted, points });
    }
    lines
}

/// The reach of the line below the lags it was fitted to, as a factor, while its intercept is less than half
/// of it.
const BEFORE: f64 = 8.0;

/// The straight line of the late displacements, with its intercept: that is what passes through the points.
fn diffusive(measurement: &Measurement, (first, last): (f64, f64), units: &Shown) -> Option<ExpectedLine> {
    let found = &measurement.statistics.diffusion;
    let ([intercept, slope], [lag, _]) = (found.line?, found.lags?);
    let coefficient = found.displacements.known()?;
    let points = logarithmic(((lag / BEFORE).clamp(first, last), last));
    let points = points.into_iter().map(|t| [t, intercept + slope * t]).filter(|[t, y]| *y > 0.5 * slope * t);
    // where the line meets the axis has no error of its own, and is no result
    let label =
        format!("diffusive: slope 4*D*, *D* = {}", value_in(units, Dimension::DIFFUSION, &coefficient));
    Some(ExpectedLine { label, style: LineStyle::Dotted, points: points.collect() })
}

fn logarithmic((from, to): (f64, f64)) -> Vec<f64> {
    let ratio = to / from;
    (0..=POINTS).map(|k| from * ratio.powf(k as f64 / POINTS as f64)).collect()
}

/// The local exponent against the lag.
pub(super) fn exponents(measurement: &Measurement, units: &Shown) -> Result<Option<Box<dyn Figure>>> {
    let points = measurement.statistics.displacement.points();
    let points: Vec<BandPoint> =
        points.iter().filter_map(|p| Some(point(p.lag, p.exponent.as_ref()?))).collect();
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Ok(None) };
    let level = |label: &str, style, y| {
        let points = vec![[first.x, y], [last.x, y]];
        ExpectedLine { label: label.to_owned(), style, points }
    };
    let lines = vec![level("ballistic", LineStyle::Dashed, 2.0), level("diffusive", LineStyle::Dotted, 1.0)];
    let figure = Chart {
        title: title(measurement, "exponent of the mean-square displacement"),
        caption: caption(measurement, units, "bands", &[])?,
        zero_line: true,
        logarithmic_x: true,
        ..Chart::default()
    }
    .with([BandCurve { label: "measured".to_owned(), points }])
    .with(lines);
    Ok(with_axes(figure, [&LAG, &EXPONENT], units))
}

/// Mean first-passage times against the radius.
pub(super) fn passages(measurement: &Measurement, units: &Shown) -> Result<Option<Box<dyn Figure>>> {
    let found = &measurement.statistics;
    let known: Vec<(f64, Measured)> =
        found.passages.iter().filter_map(|p| Some((p.radius, p.time.mean.known()?))).collect();
    let (Some(first), Some(last)) = (known.first(), known.last()) else { return Ok(None) };
    let mut lines = Vec::new();
    let mut line = |label: &str, style, of: &dyn Fn(f64) -> f64| {
        let points = logarithmic((first.0, last.0 * 1.0001)).into_iter().map(|r| [r, of(r)]).collect();
        lines.push(ExpectedLine { label: label.to_owned(), style, points });
    };
    let speed = found.mean_speed.value;
    if speed > 0.0 {
        line("straight: *r*/⟨|***v***|⟩", LineStyle::Dashed, &|r| r / speed);
    }
    if let Some(diffusion) = found.walk.diffusion.known().or(found.diffusion.displacements.known()) {
        line("diffusive: *r*^2/4*D*", LineStyle::Dotted, &|r| r * r / (4.0 * diffusion.value));
    }
    let interval = |(x, m): &(f64, Measured)| m.interval.map(|[low, high]| Interval { x: *x, low, high });
    let left_out = found.passages.len() - known.len();
    let note = format!(
        "Not drawn: {left_out} radii that more than half of the starts did not leave within the tracks."
    );
    let more = if left_out > 0 { vec![note.as_str()] } else { Vec::new() };
    let figure = Chart {
        title: title(measurement, "mean first-passage time out of a disc"),
        caption: caption(measurement, units, "bars", &more)?,
        logarithmic_x: true,
        logarithmic_y: true,
        ..Chart::default()
    }
    .with(lines)
    .with([known.iter().filter_map(interval).collect::<Vec<_>>()])
    .with([measured(known.iter().map(|(x, m)| (*x, m.value)))]);
    Ok(with_axes(figure, [&RADIUS, &MEAN], units))
}
