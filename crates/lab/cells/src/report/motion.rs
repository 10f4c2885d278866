//! The observed motion: verdict, numbers, displacements and correlations.

use crate::Units;
use crate::report::numbers::{answer, plain, with_error};
use crate::report::{Case, Setting, index, relatives};
use crate::{AtLag, Memory, MotionStatistics};
use motiform_figures::report::{Cell, ReportFigure, Section, Table};
use motiform_figures::{BandCurve, BandPoint, Chart, literal};
use motiform_study::quantity::cell;
use motiform_study::quantity::statistic::MSD;
use motiform_study::titles::capital;
use motiform_study::{Dimension, Error, counted};

pub(crate) fn section(case: &Case<'_>, setting: &Setting<'_>) -> Result<Section, Error> {
    let units = &setting.units;
    let found = case.observation;
    let name = index::motion(found.motion.regime);
    let mut about = format!("Observed motion: {name}. {}.", capital(&literal(&found.motion.why)));
    if let Some(confidence) = found.motion.confidence {
        about += &format!(" {:.0} % of resamples of this record say the same.", 100.0 * confidence);
    }
    let mut figures = match &found.statistics {
        Some(statistics) => figures(statistics, setting)?,
        None => Vec::new(),
    };
    let mut tables: Vec<Table> =
        found.statistics.iter().map(|statistics| memories(statistics, units)).collect();
    if let Some(found) = &found.relatives {
        tables.push(relatives::table(found, units));
        figures.extend(relatives::figure(found, setting)?);
    }
    Ok(Section {
        title: "Observed motion".to_owned(),
        about,
        tables,
        parameters: parameters(case, units),
        small_figures: figures,
        ..Section::default()
    })
}

fn parameters(case: &Case<'_>, units: &Units) -> Vec<(String, String)> {
    let (time, length) = (units.times(), units.lengths());
    let radius = match case.cell.radius {
        none if none <= 0.0 => "not known: no frame has modes of the radius".to_owned(),
        radius => format!("{} {length}", plain(radius)),
    };
    let mut all = vec![
        (
            "frames that count".to_owned(),
            format!("{} of {}", case.cell.frames(), case.cell.modes.frames.len()),
        ),
        ("mean radius".to_owned(), radius),
    ];
    for (flag, count) in case.cell.flags() {
        all.push((flag.to_owned(), counted(count, "frame")));
    }
    if let Some(m) = &case.observation.measures {
        if m.frames < case.cell.frames() {
            let [from, to] = m.span.map(plain);
            let text = format!("{} frames, *t* = {from} to {to} {time}", m.frames);
            all.push(("stretch without gaps".to_owned(), text));
        }
        all.push(("sampling interval".to_owned(), units.of_time(&plain(case.cell.track.interval()))));
        all.push((
            format!(
                "{} (of the stretch, by displacements over {})",
                cell::SPEED.symbol,
                units.of_time(&plain(m.step))
            ),
            format!("{} {}", plain(m.speed), units.unit(Dimension::SPEED)),
        ));
        all.push(("scatter of the speed".to_owned(), format!("{:.0} %", 100.0 * m.speed_scatter)));
        all.push((
            format!("{} (of the stretch)", cell::TURNING_RATE.symbol),
            format!("{} {}", with_error(m.turning, m.turning_error), units.unit(Dimension::TURNING)),
        ));
        all.push((
            "directionality (of the stretch, by the same displacements)".to_owned(),
            plain(m.directness),
        ));
    }
    all
}

/// Correlation times, of a cell or a population. (Persistence and diffusion are among the numbers without a model.)
pub(crate) fn memories(statistics: &MotionStatistics, units: &Units) -> Table {
    let name = |memory: &Memory| format!("correlation time of {}", symbol(&memory.quantity));
    let row = |memory: &Memory| (name(memory), answer(&memory.time, units.times()));
    let all = statistics.memories.iter().map(row);
    Table {
        caption: "How long velocity and shape persist; in brackets 95 % intervals.".to_owned(),
        head: ["quantity", "value"].map(str::to_owned).to_vec(),
        rows: all.map(|(name, value)| vec![Cell::text(name), Cell::text(value)]).collect(),
    }
}

/// Mean-square displacement against lag on logarithmic axes; `None` where no value has a place there.
pub(crate) fn mean_square(displacement: &[AtLag], units: &Units) -> Option<Chart> {
    let curve = BandCurve { label: "observed, 95 % band".to_owned(), points: points(displacement) };
    let chart = Chart {
        x_label: units.label("lag", Dimension::TIME),
        y_label: units.label(MSD.meaning, MSD.dimension),
        logarithmic_x: true,
        logarithmic_y: true,
        ..Chart::default()
    };
    curve.points.iter().any(|point| point.y > 0.0).then(|| chart.with([curve]))
}

/// Mean-square displacement and autocorrelations.
pub(crate) fn figures(
    statistics: &MotionStatistics,
    setting: &Setting<'_>,
) -> Result<Vec<ReportFigure>, Error> {
    let units = &setting.units;
    let curve =
        |memory: &Memory| BandCurve { label: symbol(&memory.quantity), points: points(&memory.correlation) };
    let known = statistics.memories.iter().filter(|memory| !memory.correlation.is_empty());
    let (x_label, y_label) = (units.label("lag", Dimension::TIME), "autocorrelation".to_owned());
    let correlations = Chart { x_label, y_label, zero_line: true, ..Chart::default() }.with(known.map(curve));
    let mut all = Vec::new();
    if let Some(displacement) = mean_square(&statistics.displacement, units) {
        let words = "Mean-square displacement against lag; errors of measurement subtracted.";
        all.push(setting.figure(displacement, words)?);
    }
    if !correlations.is_empty() {
        let words = "Autocorrelations of velocity and modes of the shape, with 95 % bands.";
        all.push(setting.figure(correlations, words)?);
    }
    Ok(all)
}

pub(crate) fn points(curve: &[AtLag]) -> Vec<BandPoint> {
    let point = |at: &AtLag| {
        let [low, high] = at.value.interval.unwrap_or([at.value.value; 2]);
        BandPoint { x: at.lag, y: at.value.value, low, high }
    };
    curve.iter().map(point).collect()
}

fn symbol(quantity: &str) -> String {
    match quantity {
        "z2" => "*z*_2".to_owned(),
        "z3" => "*z*_3".to_owned(),
        other => other.to_owned(),
    }
}
