//! Checks of a fit: other sampling intervals, the weak form, and what the fit leaves unexplained.

use crate::Fitted;
use crate::Units;
use crate::report::Setting;
use crate::report::numbers::{plain, with_error};
use crate::report::terms::typeset;
use motiform_dynamics::distributions::NORMAL_95;
use motiform_figures::literal;
use motiform_figures::report::{Cell, ReportFigure, Section, Table};
use motiform_figures::{BandCurve, BandPoint, Chart};
use motiform_inference::{Channel, Coefficient, DriftPoint, Estimate};
use motiform_study::Error;

/// Of a fit of fewer frames that gives no coefficients.
const NOT_COUNTED: &str = "not counted";

pub(crate) fn section(fitted: &Fitted, setting: &Setting<'_>) -> Result<Section, Error> {
    let n = fitted.model().frames as f64;
    let channels = &fitted.checks.innovations;
    let pairs = channels.chunks(2).filter(|pair| !pair[0].autocorrelation.is_empty());
    Ok(Section {
        title: "Checks".to_owned(),
        about: "If the model describes the cell, coefficients do not depend on the sampling interval, and innovations \
         have variance 1 and no memory. The weak form shares nothing with the likelihood but the data: noise biases it, so \
         only signs and orders of magnitude of its large terms count, and equations whose rates noise makes have none.".to_owned(),
        tables: vec![intervals(fitted, &setting.units), whiteness(channels)],
        small_figures: pairs.map(|pair| memory(pair, n, setting)).collect::<Result<_, _>>()?,
        ..Section::default()
    })
}

/// The coefficients of the model at other sampling intervals and by the weak form.
fn intervals(fitted: &Fitted, units: &Units) -> Table {
    let points = fitted.drift.as_ref().map_or(&[][..], |drift| &drift.points);
    let mut head = vec!["term".to_owned(), "coefficient".to_owned()];
    let every = |point: &DriftPoint| {
        format!("every {} frames ({})", point.every, units.of_time(&plain(point.interval)))
    };
    head.extend(points.iter().map(every));
    head.extend((!points.is_empty()).then(|| "largest change".to_owned()));
    head.push("weak form".to_owned());
    let row = |(place, c): (usize, &Coefficient)| {
        let part = if c.imaginary { "imaginary part of " } else { "" };
        let estimate = |e: &Estimate| with_error(e.value, e.error);
        let again = points.iter().map(|point| match &point.estimates {
            Ok(all) => all.get(place).map_or_else(|| NOT_COUNTED.to_owned(), estimate),
            Err(_) => NOT_COUNTED.to_owned(),
        });
        let change = fitted.drift.as_ref().map(|drift| {
            drift.changes.get(place).copied().flatten().map_or(NOT_COUNTED.to_owned(), |x| format!("{x:.1}"))
        });
        let weak = fitted.checks.weak(place).map_or_else(|| "none (reason above)".to_owned(), plain);
        let numbers = std::iter::once(estimate(&c.estimate)).chain(again).chain(change).chain([weak]);
        let term = Cell::text(format!("{part}{}", typeset(&c.name)));
        std::iter::once(term).chain(numbers.map(Cell::number)).collect()
    };
    let mut caption =
        "The same coefficients from fewer frames and by another method; changes in standard deviations of \
                       such a change."
            .to_owned();
    for point in points {
        if let Err(why) = &point.estimates {
            caption += &format!(" Not counted, {}: {}.", every(point), literal(why));
        }
    }
    for why in fitted.checks.no_weak() {
        caption += &format!(" No weak form: {}.", literal(&why));
    }
    Table { caption, head, rows: fitted.model().coefficients.iter().enumerate().map(row).collect() }
}

/// The autocorrelations of the innovations of a pair of numbers (x and y, the parts of a mode), on the band of white noise.
fn memory(pair: &[Channel], n: f64, setting: &Setting<'_>) -> Result<ReportFigure, Error> {
    let half = NORMAL_95 / n.sqrt();
    let lags = || (1..=pair[0].autocorrelation.len()).map(|lag| lag as f64);
    let bare = |x, y| BandPoint { x, y, low: y, high: y };
    let white = lags().map(|x| BandPoint { x, y: 0.0, low: -half, high: half });
    let mut curves = vec![BandCurve { label: "white noise, 95 % band".to_owned(), points: white.collect() }];
    for channel in pair {
        let own = lags().zip(&channel.autocorrelation).map(|(x, &y)| bare(x, y)).collect();
        curves.push(BandCurve { label: symbol(&channel.name), points: own });
    }
    for end in [-half, half] {
        // keeps the band in sight: axes show all points, and one alone is no line
        curves.push(BandCurve { label: String::new(), points: vec![bare(1.0, 1.1 * end)] });
    }
    let figure = Chart {
        x_label: "lag (frames)".to_owned(),
        y_label: "autocorrelation of innovations".to_owned(),
        zero_line: true,
        ..Chart::default()
    }
    .with(curves);
    let names: Vec<String> = pair.iter().map(|channel| symbol(&channel.name)).collect();
    setting.figure(figure, format!("Innovations of {}.", names.join(" and ")))
}

/// Variances of the innovations and the test of their whiteness.
fn whiteness(channels: &[Channel]) -> Table {
    let row = |channel: &Channel| {
        let (variance, p) = (plain(channel.variance), plain(channel.p_value));
        vec![Cell::text(symbol(&channel.name)), Cell::number(variance), Cell::number(p)]
    };
    Table {
        caption: "Innovations of each observed number.".to_owned(),
        head: ["innovations of", "variance", "p of white noise"].map(str::to_owned).to_vec(),
        rows: channels.iter().map(row).collect(),
    }
}

/// `Re z2` as it is set.
fn symbol(name: &str) -> String {
    match name.split_once(" z") {
        Some((part, n)) => format!("{part} *z*_{n}"),
        None => format!("*{name}*"),
    }
}
