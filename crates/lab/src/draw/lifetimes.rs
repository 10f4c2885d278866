//! Mean lives of chaos against a parameter, with the laws that were fitted.

use super::diagram::symbol;
use super::{FigureFormat, Picture, files, words};
use crate::lifetimes::{LifeAt, Lifetimes};
use motiform_figures::{Chart, ErrorBarSeries, ExpectedLine, Interval, LineStyle, Measured};
use motiform_models::ModelInfo;
use motiform_study::{Error, ScanPlan};

/// Points of a fitted law.
const POINTS: usize = 400;

/// Draws `mean-life` (as SVG and PNG, and PDF if requested); nothing if no value was watched.
///
/// # Errors
/// An unknown model, or numbers that do not fit on an axis.
pub fn draw_lifetimes(
    plan: &ScanPlan,
    found: &Lifetimes,
    format: &FigureFormat,
) -> Result<Vec<Picture>, Error> {
    let watched = found.values.iter().any(|at| at.life.watched > 0.0);
    let figure = watched.then(|| figure(plan, found)).transpose()?;
    files(figure.map(|figure| ("mean-life", Box::new(figure) as _)).into_iter().collect(), false, format)
}

/// Mean lives with their 95 % intervals on a logarithmic axis, and both laws.
///
/// # Errors
/// An unknown model.
pub fn figure(plan: &ScanPlan, found: &Lifetimes) -> Result<Chart, Error> {
    let info = plan.info()?;
    let watched = || found.values.iter().filter(|at| at.life.watched > 0.0);
    let point = |at: &LifeAt| Some(Measured { x: at.value, y: at.life.value?, error: 0.0 });
    let interval = |at: &LifeAt| Interval {
        x: at.value,
        low: at.life.lower,
        high: at.life.upper.unwrap_or(f64::INFINITY),
    };
    Ok(Chart {
        title: format!("{}: mean life of chaos", plan.title),
        caption: caption(plan, found, info),
        x_label: symbol(info, &found.parameter),
        y_label: "mean life".to_owned(),
        logarithmic_y: true,
        ..Chart::default()
    }
    .with(laws(found))
    .with([watched().map(interval).collect::<Vec<_>>()])
    .with([ErrorBarSeries {
        label: String::new(),
        points: watched().filter_map(point).collect(),
        joined: false,
    }]))
}

fn laws(found: &Lifetimes) -> Vec<ExpectedLine> {
    let Some((exponential, power)) = found.laws.fits() else { return Vec::new() };
    let ends = found
        .values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at.value), high.max(at.value)));
    let line = |label: &str, style, life: &dyn Fn(f64) -> f64| ExpectedLine {
        label: label.to_owned(),
        style,
        points: (0..=POINTS)
            .map(|i| ends.0 + (ends.1 - ends.0) * i as f64 / POINTS as f64)
            .map(|p| [p, life(p)])
            .filter(|point| point[1].is_finite())
            .collect(),
    };
    vec![
        line("exponential law", LineStyle::Solid, &|p| exponential.life(p)),
        line("power law", LineStyle::Dashed, &|p| power.life(p)),
    ]
}

fn caption(plan: &ScanPlan, found: &Lifetimes, info: &ModelInfo) -> Vec<String> {
    let c = &plan.computation;
    let events: usize = found.values.iter().map(|at| at.life.events).sum();
    vec![
        words::named(info, &c.parameters, &[], &c.ties),
        format!(
            "{} starts for each value, {}, seed {}, each followed to {} model time; {events} lives ended. Bars: exact 95 % limits of an \
             exponential law with censoring; a bar without an upper end: no life ended.",
            c.samples,
            c.random.words(),
            c.seed,
            words::number(found.until)
        ),
    ]
}
