//! Mean lives of chaos against a parameter, with the laws that were fitted.

use super::diagram::symbol;
use super::{FigureFormat, Picture, files, words};
use crate::lifetimes::{LifeAt, Lifetimes};
use motiform_figures::{Chart, ErrorBarSeries, ExpectedLine, Interval, Label, LineStyle, Measured, sentence};
use motiform_models::ModelInfo;
use motiform_study::quantity::statistic::LIFE;
use motiform_study::{Error, ScanPlan, Shown};

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
    let figure = watched.then(|| figure(plan, found, &format.units)).transpose()?;
    files(figure.map(|figure| ("mean-life", Box::new(figure) as _)).into_iter().collect(), false, format)
}

/// Mean lives with their 95 % intervals on a logarithmic axis, and both laws, in these units.
///
/// # Errors
/// An unknown model.
pub fn figure(plan: &ScanPlan, found: &Lifetimes, units: &Shown) -> Result<Chart, Error> {
    let (info, factor) = (plan.info()?, units.factor(LIFE.dimension));
    let watched = || found.values.iter().filter(|at| at.life.watched > 0.0);
    let point = |at: &LifeAt| Some(Measured { x: at.value, y: factor * at.life.value?, error: 0.0 });
    let interval = |at: &LifeAt| Interval {
        x: at.value,
        low: factor * at.life.lower,
        high: factor * at.life.upper.unwrap_or(f64::INFINITY),
    };
    Ok(Chart {
        title: format!("{}: mean life of chaos", plan.title),
        caption: caption(plan, found, info, units),
        x_label: symbol(info, &found.parameter),
        y_label: units.axis(&LIFE),
        logarithmic_y: true,
        ..Chart::default()
    }
    .with(laws(found, factor))
    .with([watched().map(interval).collect::<Vec<_>>()])
    .with([ErrorBarSeries {
        label: "mean life, with 95 % limits".to_owned(),
        points: watched().filter_map(point).collect(),
        joined: false,
    }]))
}

fn laws(found: &Lifetimes, factor: f64) -> Vec<ExpectedLine> {
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
            .map(|p| [p, factor * life(p)])
            .filter(|point| point[1].is_finite())
            .collect(),
    };
    vec![
        line("exponential law", LineStyle::Solid, &|p| exponential.life(p)),
        line("power law", LineStyle::Dashed, &|p| power.life(p)),
    ]
}

fn caption(plan: &ScanPlan, found: &Lifetimes, info: &ModelInfo, units: &Shown) -> Vec<String> {
    let c = &plan.computation;
    let events: usize = found.values.iter().map(|at| at.life.events).sum();
    let until = found.until_in(|time| units.words(time, LIFE.dimension, " model time"));
    vec![
        words::named_in(info, &c.parameters, &[&found.parameter], &c.ties, units),
        format!(
            "{} starts for each value, {}, seed {}, each followed to {until}; {events} lives ended. Bars: exact 95 % limits of an \
             exponential law with censoring; a bar without an upper end: no life ended.",
            c.samples,
            c.random.words(),
            c.seed
        ),
        format!("Law: {}.", verdict(found, units)),
    ]
}

/// The law of the lives, or why there is none, in these units.
fn verdict(found: &Lifetimes, units: &Shown) -> String {
    let unit = Label::parse(&units.name(LIFE.dimension, "")).terminal();
    sentence(&found.laws.words_in(units.factor(LIFE.dimension), &unit))
}
