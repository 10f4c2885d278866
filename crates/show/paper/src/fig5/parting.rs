//! Separation of neighbouring orbits: the growth rate of a small difference.

use super::super::claims::check;
use super::super::context::Context;
use super::super::fig4::figure;
use super::chaos;
use motiform_analysis::Estimate;
use motiform_dynamics::distributions::student_quantile;
use motiform_figures::report::{Claim, Section};
use motiform_figures::{Chart, Drawn, ErrorBarSeries, ExpectedLine, LineStyle, Measured};
use motiform_study::{Dataset, Error, Study};

/// Size of the difference at the start.
const TINY: f64 = 1e-8;

/// The growth is measured between these times: the difference has aligned with the growing direction, and is still small.
const BETWEEN: (f64, f64) = (20.0, 120.0);

/// Observation time, and time between samples.
const SPAN: (f64, f64) = (300.0, 5.0);

/// The coordinates of the shape.
const SHAPE: [&str; 6] = ["v1", "v2", "s11", "s12", "u111", "u222"];

pub(super) fn add(context: &Context<'_>, section: &mut Section) -> Result<(), Error> {
    let pairs = context.choose(200, 32);
    let study = context.preset("fig5b", |_| Ok(()))?;
    let starts = starts(context, &study, pairs)?;
    let all: Vec<Vec<f64>> = context.each(&starts, |start| distances(context, start))?;
    let lambda = chaos::measure(context, &study)?.exponents.first().copied();
    let Some(lambda) = lambda else { return Ok(()) };
    section.figures.push(figure(
        picture(context, &all, lambda)?,
        "**Sensitive dependence.** The mean of the logarithm grows at the rate λ_1 until the difference is as large as the motion.",
    ));
    section.claims.push(rate(&all, lambda));
    Ok(())
}

/// Studies that start on the attractor, a hundred time units apart.
fn starts(context: &Context<'_>, study: &Study, count: usize) -> Result<Vec<Study>, Error> {
    let mut long = study.clone();
    (long.run.t_end, long.run.dt_out) = (100.0 * count as f64, 100.0);
    let recorded = context.simulate(&long)?.trajectory;
    let start = |row: usize| {
        let mut start = study.clone();
        (start.run.transient, start.run.t_end, start.run.dt_out) = (0.0, SPAN.0, SPAN.1);
        (start.run.rtol, start.run.atol) = (1e-13, Some(1e-15));
        for name in SHAPE {
            start.set_initial(name, recorded.get(name).map_or(0.0, |column| column[row]))?;
        }
        Ok(start)
    };
    (0..count.min(recorded.rows())).map(start).collect()
}

/// The distance of two shapes, one of which starts off by [`TINY`], over time.
fn distances(context: &Context<'_>, start: &Study) -> Result<Vec<f64>, Error> {
    let mut other = start.clone();
    let v1 = other.initial.iter().find(|(name, _)| name == "v1").map_or(0.0, |entry| entry.1);
    other.set_initial("v1", v1 + TINY)?;
    let (a, b) = (context.simulate(start)?, context.simulate(&other)?);
    let column = |dataset: &Dataset, name: &str| dataset.trajectory.get(name).unwrap_or(&[]).to_vec();
    let pairs: Vec<(Vec<f64>, Vec<f64>)> =
        SHAPE.iter().map(|name| (column(&a, name), column(&b, name))).collect();
    let rows = a.trajectory.rows().min(b.trajectory.rows());
    let distance = |row: usize| {
        let square = |(x, y): &(Vec<f64>, Vec<f64>)| (x[row] - y[row]) * (x[row] - y[row]);
        pairs.iter().map(square).sum::<f64>().sqrt()
    };
    Ok((0..rows).map(distance).collect())
}

/// Mean with its 95 % error over the pairs.
fn mean(values: &[f64]) -> Estimate {
    let n = values.len() as f64;
    let value = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|x| (x - value) * (x - value)).sum::<f64>();
    Estimate { value, error: student_quantile(values.len().max(2) - 1) * (square / (n - 1.0) / n).sqrt() }
}

/// ln of the distance at a row, of all pairs that last as long.
fn logarithms(all: &[Vec<f64>], row: usize) -> Vec<f64> {
    all.iter().filter_map(|pair| pair.get(row)).map(|d| d.ln()).filter(|x| x.is_finite()).collect()
}

fn rate(all: &[Vec<f64>], lambda: Estimate) -> Claim {
    let (from, to) = BETWEEN;
    let row = |t: f64| (t / SPAN.1).round() as usize;
    let growth = |pair: &Vec<f64>| {
        let (first, last) = (pair.get(row(from))?, pair.get(row(to))?);
        Some((last / first).ln() / (to - from))
    };
    let rates: Vec<f64> = all.iter().filter_map(growth).collect();
    let found = mean(&rates);
    let end = mean(&logarithms(all, row(SPAN.0)));
    check(
        "The chaotic motion depends sensitively on its start.",
        format!(
            "A difference of 10^{{-8}} grows at the rate {:.4} ± {:.4} (λ_1 = {:.4} ± {:.4}); after {:.0} time units it is {:.2}, \
             as large as the motion.",
            found.value,
            found.error,
            lambda.value,
            lambda.error,
            SPAN.0,
            libm::exp(end.value)
        ),
        &format!(
            "{} pairs from starts on the motion, full equations at relative tolerance 10^{{-13}}; growth from t = {from} to {to}; \
             the two rates must agree within their 95 % errors",
            rates.len()
        ),
        (found.value - lambda.value).abs() <= (found.error + lambda.error) && end.value > -3.0,
    )
}

fn picture(context: &Context<'_>, all: &[Vec<f64>], lambda: Estimate) -> Result<Drawn, Error> {
    let rows = all.iter().map(Vec::len).max().unwrap_or(0);
    let point = |row: usize| {
        let found = mean(&logarithms(all, row));
        Measured { x: row as f64 * SPAN.1, y: found.value, error: found.error }
    };
    let points: Vec<Measured> =
        (0..rows).map(point).filter(|m| m.y.is_finite() && m.error.is_finite()).collect();
    let from = points.iter().find(|m| m.x >= BETWEEN.0).map_or(0.0, |m| m.y);
    let line = |t: f64| [t, from + lambda.value * (t - BETWEEN.0)];
    let figure = Chart {
        title: "The growth of a difference of 10^{-8}".to_owned(),
        caption: vec![format!("Mean over {} pairs of starts on the motion, 95 % errors.", all.len())],
        x_label: "*t*".to_owned(),
        y_label: "mean of ln(distance)".to_owned(),
        ..Chart::default()
    }
    .with([ExpectedLine {
        label: format!("slope λ_1 = {:.4}", lambda.value),
        style: LineStyle::Dashed,
        points: vec![line(0.0), line(200.0)],
    }])
    .with([ErrorBarSeries { label: "distance of the shapes".to_owned(), points, joined: false }]);
    context.sheet(figure)
}
