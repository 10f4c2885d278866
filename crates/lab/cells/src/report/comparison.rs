//! Simulated cells beside the observed one.

use crate::Units;
use crate::report::numbers::plain;
use crate::report::outlines::{observed, track};
use crate::report::{Case, Setting};
use crate::{Agreement, Axis, Comparison, Kind, Prediction};
use motiform_figures::report::{Cell, ReportFigure, Section, Table};
use motiform_figures::{BandCurve, BandPoint, Chart, TrackPanels};
use motiform_inference::PValue;
use motiform_lab::draw::{Picture, files};
use motiform_study::{Dimension, Error};

pub(crate) fn section(
    case: &Case<'_>,
    prediction: &Prediction,
    setting: &Setting<'_>,
) -> Result<Section, Error> {
    let units = &setting.units;
    let title = "Simulated cells".to_owned();
    let lost = prediction.lost;
    if prediction.is_unstable() {
        let about = format!(
            "{lost} of {} simulated cells leave all bounds: the fit, with its noise and its uncertainty, does not \
             describe the cell. Nothing is compared.",
            prediction.cells + lost
        );
        return Ok(Section { title, about, ..Section::default() });
    }
    let mut about = format!(
        "{} cells simulated by equations drawn from the estimate, with their noise, from where the observed one \
         starts, seen at the same frames with errors of the same size. Of {} statistics {} agree, {} are doubtful and {} differ.",
        prediction.cells,
        prediction.comparisons.len(),
        prediction.count(Agreement::Agrees),
        prediction.count(Agreement::Doubtful),
        prediction.count(Agreement::Differs)
    );
    if lost > 0 {
        about += &format!(" {lost} more leave all bounds and are left out.");
    }
    let paths = side_by_side(case, prediction, units);
    let figures = vec![setting.figure(paths, "The observed cell and three simulated ones, at one scale.")?];
    let small = prediction.comparisons.iter().map(|one| curve(one, setting)).collect::<Result<_, _>>()?;
    Ok(Section {
        title,
        about,
        tables: vec![table(prediction, units)],
        figures,
        small_figures: small,
        ..Section::default()
    })
}

/// The observed cell beside simulated ones as files, `paths-NAME`: for a slide or a page. None without simulated cells.
pub(crate) fn pictures(case: &Case<'_>, name: &str, setting: &Setting<'_>) -> Result<Vec<Picture>, Error> {
    let Some(prediction) = case.prediction().filter(|prediction| !prediction.is_unstable()) else {
        return Ok(Vec::new());
    };
    let caption =
        "At one scale. A ring where a path begins; outlines from the first (dark) to the last (bright).";
    let paths =
        TrackPanels { caption: vec![caption.to_owned()], ..side_by_side(case, prediction, &setting.units) };
    files(vec![(format!("paths-{name}"), Box::new(paths))], false, setting.format)
}

fn side_by_side(case: &Case<'_>, prediction: &Prediction, units: &Units) -> TrackPanels {
    let simulated = prediction.shown.iter().zip(1..);
    let panels = std::iter::once(observed(case, units))
        .chain(simulated.map(|(record, k)| track(format!("simulated {k}"), record, case.cell.radius, units)));
    TrackPanels { unit: units.length.clone(), columns: 4, panels: panels.collect(), ..TrackPanels::default() }
}

fn table(prediction: &Prediction, units: &Units) -> Table {
    let row = |one: &Comparison| {
        let (place, off) = one.envelope.worst;
        let side = if off > 0.0 { "more" } else { "less" };
        let at = plain(one.statistic.at[place]);
        let at = match one.statistic.kind.axis() {
            Axis::Lag => format!("lag {at} {}", units.times()),
            Axis::Share => format!("{at} % quantile"),
        };
        vec![
            Cell::text(one.statistic.kind.name()),
            Cell::text(one.envelope.agreement.name()),
            Cell::number(format!("{:.3}", one.envelope.p_value)),
            Cell::text(format!("{:.1} standard deviations {side} at {at}", off.abs())),
        ]
    };
    Table {
        caption: "The observed cell among the simulated ones.".to_owned(),
        head: ["statistic", "verdict", "p-value", "farthest off"].map(str::to_owned).to_vec(),
        rows: prediction.comparisons.iter().map(row).collect(),
    }
}

fn curve(one: &Comparison, setting: &Setting<'_>) -> Result<ReportFigure, Error> {
    let units = &setting.units;
    let (statistic, envelope) = (&one.statistic, &one.envelope);
    let places = || statistic.at.iter().copied().enumerate();
    let simulated = places().map(|(k, x)| BandPoint {
        x,
        y: envelope.median[k],
        low: envelope.low[k],
        high: envelope.high[k],
    });
    let own = places().map(|(k, x)| [x, statistic.values[k]]);
    let own = own.map(|[x, y]| BandPoint { x, y, low: y, high: y });
    let square = statistic.kind == Kind::Displacement;
    let figure = Chart {
        x_label: match statistic.kind.axis() {
            Axis::Lag => units.label("lag", Dimension::TIME),
            Axis::Share => "share of the samples below (%)".to_owned(),
        },
        y_label: label(statistic.kind, units),
        logarithmic_x: square,
        logarithmic_y: square,
        zero_line: statistic.kind.axis() == Axis::Lag,
        ..Chart::default()
    }
    .with([
        BandCurve { label: "simulated: median, 95 % band".to_owned(), points: simulated.collect() },
        BandCurve { label: "observed".to_owned(), points: own.collect() },
    ]);
    let caption =
        format!("{}: {}, {}.", statistic.kind.name(), envelope.agreement.name(), PValue(envelope.p_value));
    setting.figure(figure, caption)
}

fn label(kind: Kind, units: &Units) -> String {
    let dimension = match kind {
        Kind::Displacement => Dimension::AREA,
        Kind::Speed => Dimension::SPEED,
        Kind::Turning => Dimension::ANGLE,
        Kind::SecondSize | Kind::ThirdSize | Kind::FourthSize => Dimension::LENGTH,
        Kind::Velocity | Kind::SecondMode | Kind::ThirdMode | Kind::FourthMode | Kind::Elongation => {
            Dimension::NUMBER
        }
    };
    units.label(kind.name(), dimension)
}
