//! The map of curves: the plane of two parameters, over the regimes of a scan if there is one.

use crate::curves::{CurveSample, Curves, FollowedCurve, codimension_2};
use motiform_continuation::{Degenerate, Special};
use motiform_dynamics::in_words;
use motiform_figures::{CurveMap, CurveStyle, LineStyle, MapCurve, MapMark, PhaseDiagram};
use motiform_lab::draw::{Figures, phase_diagram, symbol, uneven, words};
use motiform_lab::scan::{CellSummary, ScanFolder, cells};
use motiform_study::branches::Along;
use motiform_study::curves::CurveKind;
use motiform_study::plan::Named;
use motiform_study::{CurvePlan, Error, ScanPlan};

/// Distance up to which marks are at one place, as a part of the ranges: less than a pixel.
const SAME_PLACE: f64 = 1e-3;

/// `curves`; nothing without any curve.
///
/// # Errors
/// [`Error::Plane`] for a scan of another plane or of other parameters, [`Error::Store`], an unknown model, or numbers that no
/// axis can hold.
pub fn curve_figures(plan: &CurvePlan, found: &Curves, over: Option<&ScanFolder>) -> Result<Figures, Error> {
    if found.curves.iter().all(|curve| curve.legs.is_empty()) {
        return Ok(Vec::new());
    }
    Ok(vec![("curves", Box::new(curve_map(plan, found, over)?))])
}

/// The map of curves.
///
/// # Errors
/// As [`curve_figures`].
pub fn curve_map(plan: &CurvePlan, found: &Curves, over: Option<&ScanFolder>) -> Result<CurveMap, Error> {
    let (info, sides) = (plan.info()?, &plan.computation.plane);
    let [x, y] = sides.each_ref().map(|side| [side.from, side.to]);
    let under = over.map(|folder| regimes(plan, folder)).transpose()?;
    let in_order = CurveKind::ALL.into_iter().flat_map(|kind| of_kind(found, kind));
    Ok(CurveMap {
        title: plan.title(),
        caption: caption(plan, found, under.as_ref())?,
        x_label: symbol(info, &sides[0].name),
        y_label: symbol(info, &sides[1].name),
        x,
        y,
        under: under.map(|found| found.1),
        named: false,
        insets: Vec::new(),
        curves: in_order.flat_map(curve_stretches).collect(),
        ends: Vec::new(),
        marks: marks_together(found.curves.iter().flat_map(codimension_2).filter_map(curve_mark), [x, y]),
    })
}

fn of_kind(found: &Curves, kind: CurveKind) -> impl Iterator<Item = &FollowedCurve> {
    found.curves.iter().filter(move |curve| curve.kind == kind)
}

/// The stretches of a curve over which line style and stability stay the same, as a map of curves has them.
pub fn curve_stretches(curve: &FollowedCurve) -> Vec<MapCurve> {
    let samples: Vec<&CurveSample> = curve.samples().collect();
    let mut all: Vec<MapCurve> = Vec::new();
    for pair in samples.windows(2) {
        let named = if pair[0].degenerate.is_none() { pair[0] } else { pair[1] };
        let (label, style) = line(curve.kind, named);
        let (from, to, bounds) = (pair[0].parameters, pair[1].parameters, named.unstable == 0);
        match all.last_mut().filter(|last| last.style == style && last.bounds == bounds) {
            Some(last) => last.points.push(to),
            None => all.push(MapCurve { label: label.to_owned(), style, bounds, points: vec![from, to] }),
        }
    }
    all
}

fn line(kind: CurveKind, sample: &CurveSample) -> (&'static str, CurveStyle) {
    match (kind, sample.special) {
        (CurveKind::Hopf, Special::Hopf(hopf)) if hopf.is_supercritical() == Some(false) => {
            ("Hopf, subcritical", CurveStyle::Line(LineStyle::LongDashed))
        }
        (CurveKind::Hopf, _) => ("Hopf, supercritical", CurveStyle::Line(LineStyle::Solid)),
        (CurveKind::Fold, _) => ("fold", CurveStyle::Thick),
        (CurveKind::Pitchfork, _) => ("pitchfork", CurveStyle::Line(LineStyle::Dashed)),
        (CurveKind::SymmetryBreaking, _) => ("symmetry breaking", CurveStyle::Line(LineStyle::DashDotted)),
        (CurveKind::PeriodDoubling, _) => ("period doubling", CurveStyle::Line(LineStyle::Dotted)),
        (CurveKind::Torus, _) => ("torus", CurveStyle::DashDotDotted),
    }
}

/// The mark of a point of codimension two; none of one that was not located ([`unlocated`] says how many there are).
pub fn curve_mark((kind, sample): (Degenerate, &CurveSample)) -> Option<MapMark> {
    Some(MapMark { label: point_words(kind)?, at: sample.parameters })
}

/// The words for a point of codimension two; none for one that was not located.
pub fn point_words(kind: Degenerate) -> Option<String> {
    match kind {
        Degenerate::Resonance { order } => Some(format!("1:{order} resonance")),
        Degenerate::Unresolved => None,
        other => Some(in_words(other.name())),
    }
}

/// A sentence for the caption about points of codimension two that were not located; nothing without any.
pub fn unlocated<'c>(points: impl Iterator<Item = (Degenerate, &'c CurveSample)>) -> Option<String> {
    match points.filter(|(kind, _)| *kind == Degenerate::Unresolved).count() {
        0 => None,
        1 => Some("One point of codimension two was not located and is not shown.".to_owned()),
        count => Some(format!("{count} points of codimension two were not located and are not shown.")),
    }
}

/// Marks at one place, as where curves meet, are one mark with the names of all.
pub fn marks_together(marks: impl Iterator<Item = MapMark>, ranges: [[f64; 2]; 2]) -> Vec<MapMark> {
    let is_near = |a: [f64; 2], b: [f64; 2]| {
        (0..2).all(|k| (a[k] - b[k]).abs() <= SAME_PLACE * (ranges[k][1] - ranges[k][0]))
    };
    let mut all: Vec<MapMark> = Vec::new();
    for mark in marks {
        match all.iter_mut().find(|known| is_near(known.at, mark.at)) {
            Some(known) if known.label.split(", ").any(|label| label == mark.label) => {}
            Some(known) => known.label += &format!(", {}", mark.label),
            None => all.push(mark),
        }
    }
    all
}

/// The number of initial states of each cell of a scan, and its regimes, with its axes in the order of the plane.
fn regimes(plan: &CurvePlan, folder: &ScanFolder) -> Result<(usize, PhaseDiagram), Error> {
    let scan = folder.plan();
    check_scan(plan, scan)?;
    let found: Vec<CellSummary> = cells(folder)?.into_iter().flatten().collect();
    let mut diagram = phase_diagram(scan, &found)?;
    if scan.computation.axes[0].name != plan.computation.plane[0].name {
        std::mem::swap(&mut diagram.x, &mut diagram.y);
        std::mem::swap(&mut diagram.x_label, &mut diagram.y_label);
        diagram.cells.iter_mut().for_each(|cell| std::mem::swap(&mut cell.x, &mut cell.y));
    }
    Ok((scan.computation.samples, diagram))
}

/// Returns `true` if a scan is one of the same body over the same plane.
///
/// # Errors
/// [`Error::Plane`].
pub fn check_scan(plan: &CurvePlan, scan: &ScanPlan) -> Result<(), Error> {
    let (c, start) = (&scan.computation, &plan.computation.branches.start);
    let refuse = |problem: String| Err(Error::Plane { text: "of the scan beneath".to_owned(), problem });
    let sides: Vec<&str> = plan.computation.plane.iter().map(|side| side.name.as_str()).collect();
    let same = c.axes.len() == 2 && c.axes.iter().all(|axis| sides.contains(&axis.name.as_str()));
    if c.model != start.model || !same {
        let axes: Vec<&str> = c.axes.iter().map(|axis| axis.name.as_str()).collect();
        return refuse(format!(
            "it is one of {} over {}; give a scan of {} over {}",
            c.model,
            axes.join(" and "),
            start.model,
            sides.join(" and ")
        ));
    }
    if c.ties != plan.computation.branches.ties {
        return refuse("it has other ties between parameters: give a scan with the same ones".to_owned());
    }
    let other = c.parameters.0.iter().find(|(name, value)| start.parameters.get(name) != Some(*value));
    match other {
        Some((name, value)) => refuse(format!(
            "it has {name} = {value}, the curves have {}: give a scan with the same parameters",
            start.parameters.get(name).unwrap_or(f64::NAN)
        )),
        None => Ok(()),
    }
}

fn caption(
    plan: &CurvePlan,
    found: &Curves,
    under: Option<&(usize, PhaseDiagram)>,
) -> Result<Vec<String>, Error> {
    let c = &plan.computation;
    let varied = |name: &str| c.plane.iter().any(|side| side.name == name);
    let fixed = c.branches.start.parameters.0.iter().filter(|entry| !varied(&entry.0)).cloned().collect();
    let (info, Along { name, .. }) = (plan.info()?, &c.plane[1 - plan.varied()]);
    let number = |count: usize, one: &str, more: &str| {
        if count == 1 { format!("one {one}") } else { format!("{count} {more}") }
    };
    let curves = found.curves.iter().filter(|curve| !curve.legs.is_empty()).count();
    let unfinished = if found.complete { "" } else { " Interrupted: not all of them are followed." };
    let at = format!("{}\u{a0}=\u{a0}{}", symbol(info, name), words::number(plan.fixed_value()));
    let mut all = vec![
        words::named(
            info,
            &Named(fixed),
            &c.plane.each_ref().map(|side| side.name.as_str()),
            &c.branches.ties,
        ),
        format!(
            "{} by pseudo-arclength continuation, through the special points of {} at {at}.{unfinished}",
            motiform_study::titles::capital(&number(curves, "curve", "curves")),
            number(found.branches.branches.len(), "branch", "branches"),
        ),
    ];
    if let Some((samples, diagram)) = under {
        let states = number(*samples, "initial state", "initial states");
        let cells = diagram.cells.len();
        all.push(format!("Beneath: the motions that {states} settled on, in each of {cells} cells."));
        all.extend(uneven(diagram));
    }
    all.extend(unlocated(found.curves.iter().flat_map(codimension_2)));
    Ok(all)
}
