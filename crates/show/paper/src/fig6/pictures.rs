//! The figures of the chapter.

use super::super::context::Context;
use super::super::strip::strip;
use super::exponents::Exponents;
use super::lengths::Lengths;
use super::tracks::Track;
use motiform_analysis::Regime;
use motiform_figures::report::ReportFigure;
use motiform_figures::{Chart, Drawn, ErrorBarSeries, ExpectedLine, LineStyle, Measured};
use motiform_study::Error;
use motiform_study::quantity::motion::SPEED_MEAN;

/// The paper's windows.
const WINDOWS: [(f64, f64, LineStyle); 3] =
    [(12.0, 14.4, LineStyle::Solid), (21.0, 21.9, LineStyle::Dashed), (29.0, 29.9, LineStyle::Dotted)];

/// The regimes that have a speed.
const MOVING: [Regime; 7] = [
    Regime::Straight,
    Regime::PulsatingStraight,
    Regime::Circular,
    Regime::Rectangular,
    Regime::QuasiPeriodic,
    Regime::Zigzag,
    Regime::Chaotic,
];

/// Letters of the figure.
const LETTERS: [&str; 4] = ["a", "b", "c", "d"];

pub(super) fn all(
    context: &Context<'_>,
    lengths: &Lengths,
    exponents: &Exponents,
    tracks: &[Track],
) -> Result<Vec<ReportFigure>, Error> {
    let mut figures = Vec::new();
    for (track, letter) in tracks.iter().zip(LETTERS) {
        figures.extend(track.figures(context, letter)?);
    }
    figures.extend(context.drawn(&|| over_lengths(context, lengths, exponents))?);
    Ok(figures)
}

/// The figures over the length.
fn over_lengths(
    context: &Context<'_>,
    lengths: &Lengths,
    exponents: &Exponents,
) -> Result<Vec<ReportFigure>, Error> {
    Ok(vec![
        ReportFigure::new(
            windows(context, lengths)?,
            "Which motion random starts lead to, over the length. Brackets: the paper's windows.",
        ),
        ReportFigure::new(
            speeds(context, lengths)?,
            "Mean speed over the length (motionless shapes are left out).",
        ),
        ReportFigure::new(exponents.drawn(context)?, "Largest Lyapunov exponent in *W*_2."),
        super::codimension::figure(context)?,
    ])
}

fn windows(context: &Context<'_>, lengths: &Lengths) -> Result<Drawn, Error> {
    let bracket = |(n, (from, to, style)): (usize, (f64, f64, LineStyle))| ExpectedLine {
        label: format!("*W*_{} of the paper: {from:.1} to {to:.1}", n + 1),
        style,
        points: vec![[from, 0.0], [from, 0.97], [to, 0.97], [to, 0.0]],
    };
    let lines = WINDOWS.into_iter().enumerate().map(bracket).collect();
    strip(context, "length *L*", &lengths.0, lines, Vec::new())
}

fn speeds(context: &Context<'_>, lengths: &Lengths) -> Result<Drawn, Error> {
    let series = |regime: Regime| {
        let point = |(length, summary): &(f64, motiform_lab::scan::CellSummary)| {
            let motion = summary.motions.iter().find(|motion| motion.regime == regime)?;
            Some(Measured { x: *length, y: motion.median(SPEED_MEAN.name)?, error: 0.0 })
        };
        let points: Vec<Measured> = lengths.0.iter().filter_map(point).collect();
        ErrorBarSeries { label: regime.name().to_owned(), points, joined: false }
    };
    let figure = Chart {
        x_label: "length *L*".to_owned(),
        y_label: SPEED_MEAN.symbol.to_owned(),
        logarithmic_y: true,
        ..Chart::default()
    }
    .with(MOVING.into_iter().map(series).filter(|series| !series.points.is_empty()));
    context.sheet(figure)
}
