//! Scans: phase diagrams, and the largest exponent along one axis.

use super::{Figures, words};
use crate::scan::{Axis, CellSummary, Reasons, ScanFolder, cells};
use motiform_analysis::regime::Regime;
use motiform_dynamics::sample::ascending;
use motiform_dynamics::sample::sort_by_number;
use motiform_figures::{
    Cell, Chart, ErrorBarSeries, ExpectedLine, LineStyle, Measured, PhaseDiagram, sentence,
};
use motiform_models::ModelInfo;
use motiform_models::parameters::Parameters;
use motiform_models::tensor::TensorParameters;
use motiform_models::tensor::reduced::{Line, Reduced};
use motiform_study::quantity::motion::{LAMBDA_1, LAMBDA_1_ERROR};
use motiform_study::{Error, ScanPlan, Shown, counted};

/// Points of an analytic line.
const POINTS: usize = 600;

/// The figures of a scan in these units: `_diagram`, and with one axis `_exponent` if exponents are known.
/// Because of the underscore, readers of all parts as one table ignore them. A scan without any computed cell
/// has none.
///
/// # Errors
/// [`Error::Store`], an unknown model, or numbers that do not fit on an axis.
pub fn scan_figures(folder: &ScanFolder, units: &Shown) -> Result<Figures, Error> {
    let plan = folder.plan();
    let cells: Vec<CellSummary> = cells(folder)?.into_iter().flatten().collect();
    let mut all: Figures = Vec::new();
    if !cells.is_empty() {
        all.push(("_diagram", Box::new(phase_diagram_in(plan, &cells, units)?)));
        all.extend(exponents(plan, &cells, units)?.map(|figure| ("_exponent", Box::new(figure) as _)));
    }
    Ok(all)
}

/// The phase diagram of a scan over one or two axes, with the analytic lines if the model is the paper's reduced one. Its axes are
/// parameters, and stay those of the model.
///
/// # Errors
/// An unknown model.
pub fn phase_diagram(plan: &ScanPlan, cells: &[CellSummary]) -> Result<PhaseDiagram, Error> {
    phase_diagram_in(plan, cells, &Shown::default())
}

/// The phase diagram of a scan whose other figures are in these units.
fn phase_diagram_in(plan: &ScanPlan, cells: &[CellSummary], units: &Shown) -> Result<PhaseDiagram, Error> {
    let info = plan.info()?;
    let axes = &plan.computation.axes;
    let cell = |cell: &CellSummary| {
        let at = plan.axis_values(cell.cell);
        Cell { x: at[0], y: at.get(1).copied().unwrap_or(0.0), shares: cell.shares() }
    };
    let label = |axis: Option<&Axis>| axis.map_or_else(String::new, |axis| symbol(info, &axis.name));
    let values = |axis: Option<&Axis>| axis.map_or_else(Vec::new, |axis| sorted(&axis.values));
    let mut diagram = PhaseDiagram {
        title: plan.title.clone(),
        caption: caption(plan, info, cells, units),
        x_label: label(axes.first()),
        y_label: label(axes.get(1)),
        x: values(axes.first()),
        y: values(axes.get(1)),
        cells: cells.iter().map(cell).collect(),
        lines: boundary_lines(plan),
    };
    let words = uneven(&diagram);
    diagram.caption.extend(words);
    Ok(diagram)
}

/// A sentence for each axis along which distances mean nothing.
pub fn uneven(diagram: &PhaseDiagram) -> Vec<String> {
    let sides = [(&diagram.x_label, "columns of one width"), (&diagram.y_label, "rows of one height")];
    let uneven = diagram.columns().into_iter().zip(sides).filter(|(uneven, _)| *uneven);
    uneven
        .map(|(_, (symbol, places))| {
            format!("The values of {symbol} stand in {places}, whatever their steps.")
        })
        .collect()
}

/// The largest Lyapunov exponent against the parameter of a scan's only axis; `None` with two axes, or if no motion
/// has one.
///
/// # Errors
/// An unknown model.
pub fn exponents(plan: &ScanPlan, cells: &[CellSummary], units: &Shown) -> Result<Option<Chart>, Error> {
    let info = plan.info()?;
    let [axis] = &plan.computation.axes[..] else { return Ok(None) };
    let factor = units.factor(LAMBDA_1.dimension);
    let series: Vec<ErrorBarSeries> =
        Regime::ALL.into_iter().filter_map(|regime| exponents_of(regime, plan, cells, factor)).collect();
    if series.is_empty() {
        return Ok(None);
    }
    let mut caption = caption(plan, info, cells, units);
    let shown = |cell: &&CellSummary| {
        series.iter().any(|one| one.points.iter().any(|point| is_at(plan, cell, point)))
    };
    caption.extend(left_out(cells.iter().filter(|cell| !shown(cell))));
    caption.push(
        "Medians over the initial states that lead to the same motion; bars: medians of the half widths of the 95 % \
         confidence intervals. Exponents of fixed shapes and of periodic orbits are those of the linearised motion; the \
         neutral directions of the symmetry make them exactly 0 wherever the body moves."
            .to_owned(),
    );
    Ok(Some(
        Chart {
            title: format!("{}: largest Lyapunov exponent", plan.title),
            caption,
            x_label: symbol(info, &axis.name),
            y_label: units.axis(&LAMBDA_1),
            zero_line: true,
            ..Chart::default()
        }
        .with(series),
    ))
}

/// The cells without an exponent, counted by what their bodies do; nothing where there are none.
fn left_out<'c>(cells: impl Iterator<Item = &'c CellSummary>) -> Option<String> {
    let mut counts = [("blow up", 0), ("are undetermined", 0), ("have none", 0)];
    for cell in cells {
        let only = |regimes: &[Regime]| cell.motions.iter().all(|motion| regimes.contains(&motion.regime));
        let place = match () {
            () if only(&[Regime::BlowUp]) => 0,
            () if only(&[Regime::BlowUp, Regime::Undetermined]) => 1,
            () => 2,
        };
        counts[place].1 += 1;
    }
    let (whole, told): (usize, Vec<_>) =
        (counts.iter().map(|entry| entry.1).sum(), counts.iter().filter(|entry| entry.1 > 0).collect());
    let why = match told[..] {
        [] => return None,
        [(what, _)] => (*what).to_owned(),
        _ => told.iter().map(|(what, count)| format!("{what} ({count})")).collect::<Vec<_>>().join(" or "),
    };
    Some(match whole {
        1 => format!("One cell without an exponent is left out: its bodies {why}."),
        _ => format!("{whole} cells without an exponent are left out: their bodies {why}."),
    })
}

/// Returns `true` if this is a point of the cell.
fn is_at(plan: &ScanPlan, cell: &CellSummary, point: &Measured) -> bool {
    plan.axis_values(cell.cell).first() == Some(&point.x)
}

/// The exponents of one regime.
fn exponents_of(
    regime: Regime,
    plan: &ScanPlan,
    cells: &[CellSummary],
    factor: f64,
) -> Option<ErrorBarSeries> {
    let point = |cell: &CellSummary| {
        let motion = cell.motions.iter().find(|motion| motion.regime == regime)?;
        let (y, error) = (motion.median(LAMBDA_1.name)?, motion.median(LAMBDA_1_ERROR.name)?);
        let x = *plan.axis_values(cell.cell).first()?;
        let shown = Measured { x, y: factor * y, error: factor * error.abs() };
        (y.is_finite() && error.is_finite()).then_some(shown)
    };
    let mut points: Vec<Measured> = cells.iter().filter_map(point).collect();
    sort_by_number(&mut points, |a| a.x);
    (!points.is_empty()).then(|| ErrorBarSeries { label: regime.words(), points, joined: false })
}

/// Description of the scan.
fn caption(plan: &ScanPlan, info: &ModelInfo, cells: &[CellSummary], units: &Shown) -> Vec<String> {
    let c = &plan.computation;
    let (count, all) = (cells.len(), plan.cells());
    let computed =
        if count < all { format!("{count} of {all} cells are computed") } else { counted(all, "cell") };
    let random = format!("{}, seed {}", c.random.words(), c.seed);
    let given = if plan.varies_start().unwrap_or(false) {
        "the one with the coordinates on the axes and the others as given, or 0"
    } else {
        "the given one"
    };
    let states = match (c.samples, plan.draws_first().unwrap_or(true)) {
        (1, false) => format!("one initial state each, {given}"),
        (1, true) => format!("one random initial state each, {random}"),
        (samples, false) => format!("{samples} initial states each, {given} and random ones, {random}"),
        (samples, true) => format!("{samples} random initial states each, {random}"),
    };
    let varied: Vec<&str> = c.axes.iter().map(|axis| axis.name.as_str()).collect();
    let mut all =
        vec![words::named_in(info, &c.parameters, &varied, &c.ties, units), format!("{computed}, {states}.")];
    let mut reasons = Reasons::default();
    cells.iter().flat_map(|cell| &cell.motions).for_each(|motion| reasons.add_all(&motion.reasons));
    let told = reasons
        .told()
        .into_iter()
        .map(|(why, rows)| format!("{} ({})", sentence(why), counted(rows, "initial state")));
    let told = told.collect::<Vec<_>>().join("; ");
    all.extend((!told.is_empty()).then(|| format!("Undetermined: {told}.")));
    all
}

/// Notation of a parameter in figures, or of a coordinate of the start.
pub fn symbol(info: &ModelInfo, name: &str) -> String {
    let spec = info.parameters().iter().find(|spec| spec.name == name);
    spec.map_or_else(|| format!("initial {}", coordinate(name)), |spec| spec.symbol.to_owned())
}

/// Notation of a coordinate: *v*_1, *s*_{12}.
fn coordinate(name: &str) -> String {
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
    format!("*{letters}*_{{{}}}", &name[letters.len()..])
}

/// Cell centres in the order of an axis.
fn sorted(values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    ascending(&mut values);
    values
}

/// The couplings of a plan that is the reduced model over the plane (kappa2, gamma), in either order.
fn reduced(plan: &ScanPlan) -> Option<Reduced> {
    let c = &plan.computation;
    if c.model.as_str() != TensorParameters::MODEL || c.axes.len() != 2 {
        return None;
    }
    if !c.ties.is_empty() {
        return None; // its lines are those of constant couplings
    }
    let mut parameters = TensorParameters::default();
    for (name, value) in &c.parameters.0 {
        parameters.set(name, *value).ok()?;
    }
    let named = |name: &str| c.axes.iter().any(|axis| axis.name == name);
    (named("kappa2") && named("gamma")).then(|| Reduced::of(&parameters))?
}

/// The analytic lines over a scan of the reduced tensor model over (kappa2, gamma); none for other models and planes.
pub fn boundary_lines(plan: &ScanPlan) -> Vec<ExpectedLine> {
    let Some(reduced) = reduced(plan) else { return Vec::new() };
    let axes = &plan.computation.axes;
    let swapped = axes[0].name == "gamma";
    let range = |name: &str| {
        let values = axes.iter().find(|axis| axis.name == name).map(|axis| sorted(&axis.values));
        let values = values.unwrap_or_default();
        let (low, high) = (values[0], values[values.len() - 1]);
        let room = (high - low) / values.len() as f64; // the outer halves of the outer cells
        (low - room, high + room)
    };
    let (kappa2, gamma) = (range("kappa2"), range("gamma"));
    let points = |line: Line| reduced.line(line, kappa2, gamma, POINTS);
    let mut motionless = points(Line::CircleToStraight);
    motionless.reverse();
    motionless.extend(points(Line::EllipseToStraight));
    let all = [
        ("motionless | straight", LineStyle::Solid, motionless),
        ("straight | circular", LineStyle::Dashed, points(Line::StraightToCircular)),
        ("stability limit of straight (Hopf)", LineStyle::Dotted, points(Line::StraightHopf)),
        ("circular | quasi-periodic", LineStyle::DashDotted, points(Line::CircularToQuasiPeriodic)),
        ("quasi-periodic | rectangular", LineStyle::LongDashed, points(Line::QuasiPeriodicToRectangular)),
    ];
    let oriented =
        |points: Vec<[f64; 2]>| points.into_iter().map(|[k, g]| if swapped { [g, k] } else { [k, g] });
    let line = |(label, style, points): (&str, LineStyle, Vec<[f64; 2]>)| ExpectedLine {
        label: label.to_owned(),
        style,
        points: oriented(points).collect(),
    };
    all.into_iter().filter(|entry| entry.2.len() > 1).map(line).collect()
}
