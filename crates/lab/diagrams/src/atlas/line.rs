//! A line across the plane: the branches that begin with a motion of one of its cells, and where their motions begin and end.

use crate::curves::{FollowedCurve, follow_curve_within};
use crate::{Allowance, BranchEnd, Branches, Followed, Sample, follow_within, is_stable};
use motiform_analysis::Regime;
use motiform_continuation::{ConnectionKind, Special};
use motiform_dynamics::Watch;
use motiform_study::AtlasPlan;
use motiform_study::curves::CurveKind;
use motiform_study::{CurvePlan, Error, ScanPlan};
use serde::{Deserialize, Serialize};

/// A curve along which a motion gains or loses its stability.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StabilityCurve {
    /// The motion that is stable on one side, where the curve was begun.
    pub motion: Regime,
    /// The curve.
    pub curve: FollowedCurve,
}

/// A place on a line at which a stable motion ends or begins, and through which no curve is followed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum EndKind {
    /// A connection of a steady motion with itself or its images.
    Connection(ConnectionKind),
    /// A crossing of branches.
    Crossing(CrossingKind),
}

motiform_dynamics::named! {
    /// A crossing of branches that breaks no symmetry which the model states: its curve over two parameters is not followed, for equations
    /// in general have none.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "snake_case")]
    pub enum CrossingKind by words {
        /// One branch turns back there.
        Pitchfork = "pitchfork",
        /// Both go on.
        Transcritical = "crossing of branches",
    }
}

impl EndKind {
    /// Its name.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Connection(ConnectionKind::Resonant) => "resonant heteroclinic connection",
            Self::Connection(ConnectionKind::SaddleNode) => "saddle-node on a circle",
            Self::Connection(ConnectionKind::Cycle) => "heteroclinic cycle",
            Self::Connection(_) => "homoclinic connection",
            Self::Crossing(kind) => kind.words(),
        }
    }
}

/// Where a stable motion ends, or begins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LineEnd {
    /// Where, across and upwards.
    pub at: [f64; 2],
    /// The kind of end.
    pub kind: EndKind,
    /// The motion that ends or begins.
    pub motion: Regime,
}

/// A line, and what was found on it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// The cell and the initial state that it begins with.
    pub start: (usize, usize),
    /// Where that is in the plane.
    pub at: [f64; 2],
    /// The side of the plane along which it goes: 0 across, 1 upwards.
    pub side: usize,
    /// The motion that it begins with.
    pub motion: Regime,
    /// Branches that were followed.
    pub branches: usize,
    /// The curves that were begun on it.
    pub curves: Vec<StabilityCurve>,
    /// Ends of stable motions.
    pub ends: Vec<LineEnd>,
    /// Pairs of motions that are names of one branch, without a bifurcation between them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub renamed: Vec<[Regime; 2]>,
    /// Steps of the flow that its orbits took.
    pub steps: u64,
    /// Why nothing could be followed, or not all.
    pub refused: Option<String>,
}

/// A line to follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Task {
    pub(crate) start: (usize, usize),
    pub(crate) side: usize,
    pub(crate) motion: Regime,
}

/// The branches on a line, and what is left for curves; or why there are none. `None` if the watch stopped it.
pub(crate) type Course = Option<Result<Ground, String>>;

/// The branches on a line, and what is left for curves.
pub(crate) type Ground = (CurvePlan, Branches, Allowance);

/// Follows the branches on a line.
pub(crate) fn course(
    plan: &AtlasPlan,
    scan: &ScanPlan,
    task: Task,
    watch: &dyn Watch,
) -> Result<Course, Error> {
    let line = plan.line(scan, task.start, task.side)?;
    let allowance = Allowance::of(plan.computation.line_steps);
    match follow_within(&line.branches(), &allowance, watch) {
        Ok(found) if found.complete => Ok(Some(Ok((line, found, allowance)))),
        Ok(_) => Ok(None),
        Err(_) if watch.stopped() => Ok(None),
        Err(error @ (Error::Start { .. } | Error::Analysis(_))) => Ok(Some(Err(error.to_string()))),
        Err(error) => Err(error),
    }
}

/// The names that follow one another on a branch.
fn renamed(found: &Branches) -> Vec<[Regime; 2]> {
    let mut all: Vec<[Regime; 2]> = Vec::new();
    for parts in found.branches.iter().map(Followed::parts) {
        let pairs = parts.windows(2).map(|pair| [pair[0].motion, pair[1].motion]);
        all.extend(pairs);
    }
    all.dedup();
    all
}

/// Follows the curves on which motions of these branches gain or lose their stability: those that begin at a boundary of the motion, as
/// `bounds` says of places, and are not known. `None` if the watch stopped it.
pub(crate) fn read_line(
    scan: &ScanPlan,
    most: u64,
    task: Task,
    course: Result<Ground, String>,
    known: &[Line],
    bounds: &dyn Fn([f64; 2], Regime) -> bool,
    watch: &dyn Watch,
) -> Result<Option<Line>, Error> {
    let values = scan.axis_values(task.start.0);
    let mut line = Line {
        start: task.start,
        at: [values[0], values[1]],
        side: task.side,
        motion: task.motion,
        branches: 0,
        curves: Vec::new(),
        ends: Vec::new(),
        renamed: Vec::new(),
        steps: 0,
        refused: None,
    };
    let (plan, found, allowance) = match course {
        Ok(found) => found,
        Err(why) => return Ok(Some(Line { refused: Some(why), ..line })),
    };
    line.branches = found.branches.len();
    line.ends = ends(&plan, &found);
    line.ends.extend(crossings(&plan, &found));
    line.renamed = renamed(&found);
    let mut doublings: Vec<f64> = Vec::new();
    for (kind, start, motion) in limits(&found) {
        let Some(sample) = found.at(start) else { continue };
        let mut at = [plan.fixed_value(); 2];
        at[plan.varied()] = sample.point.parameter;
        if !bounds(at, motion) {
            continue;
        }
        // the doublings of a cascade accumulate: beside the boundary the first one stands for all
        let period = sample.reading.period.unwrap_or(0.0);
        let doubled = doublings.iter().any(|first| LATER * first <= period);
        if kind == CurveKind::PeriodDoubling && doubled {
            continue;
        }
        if kind == CurveKind::PeriodDoubling {
            doublings.push(period);
        }
        let is_known = known
            .iter()
            .chain([&line])
            .flat_map(|line| &line.curves)
            .any(|one| one.curve.kind == kind && one.curve.passes(&plan, sample));
        if is_known {
            continue;
        }
        if allowance.is_spent() {
            break;
        }
        match follow_curve_within(&plan, &found, kind, start, &allowance, watch) {
            Ok(curve) => line.curves.push(StabilityCurve { motion, curve }),
            Err(Error::Interrupted) => return Ok(None),
            Err(error) => return Err(error),
        }
    }
    line.steps = most - allowance.left();
    line.refused = unfinished(&line, &found, allowance.is_spent());
    Ok(Some(line))
}

/// The work that was left because the steps of the line were spent, in a sentence.
fn unfinished(line: &Line, found: &Branches, spent: bool) -> Option<String> {
    let legs = found.branches.iter().flat_map(|branch| &branch.legs);
    let cut = legs.filter(|leg| leg.end == BranchEnd::Spent).count();
    let curves = line.curves.iter().flat_map(|one| &one.curve.legs);
    let short = curves.filter(|leg| leg.end == BranchEnd::Spent).count();
    let count = |count: usize, one: &str, many: &str| match count {
        0 => None,
        1 => Some(format!("1 {one}")),
        _ => Some(format!("{count} {many}")),
    };
    let parts = [
        count(cut, "end of a branch", "ends of branches"),
        count(short, "end of a curve", "ends of curves"),
        (cut + short == 0).then(|| "what begins last on its branches".to_owned()),
    ];
    (spent || cut + short > 0).then(|| {
        let left: Vec<String> = parts.into_iter().flatten().collect();
        format!("the steps that its orbits may take were spent before {}", left.join(" and "))
    })
}

/// A doubling of an orbit whose period is so many times longer than that of another one on the line is a later one of its cascade.
const LATER: f64 = 1.5;

/// The special points at which a motion gains or loses its stability, with that motion.
fn limits(found: &Branches) -> Vec<(CurveKind, [usize; 3], Regime)> {
    let limit = |(place, sample): ([usize; 3], &Sample)| {
        let [branch, leg, point] = place;
        let kind = CurveKind::find(sample.point.special?.name())?;
        let beside = [point.checked_sub(1), Some(point + 1)].into_iter().flatten();
        let mut beside = beside.filter_map(|point| found.at([branch, leg, point]));
        let stable = beside.find(|near| is_stable(near, sample))?;
        Some((kind, place, stable.reading.motion))
    };
    found.samples().filter_map(limit).collect()
}

/// The crossings of branches that bound a stable motion, once each.
fn crossings(plan: &CurvePlan, found: &Branches) -> Vec<LineEnd> {
    let mut all: Vec<LineEnd> = Vec::new();
    for leg in found.branches.iter().flat_map(|followed| &followed.legs) {
        for (point, sample) in leg.samples.iter().enumerate() {
            if sample.point.special != Some(Special::BranchPoint) {
                continue;
            }
            let kind = if sample.point.is_unstated_pitchfork() {
                CrossingKind::Pitchfork
            } else {
                CrossingKind::Transcritical
            };
            let mut at = [plan.fixed_value(); 2];
            at[plan.varied()] = sample.point.parameter;
            let before = point.checked_sub(1).and_then(|place| leg.samples.get(place));
            for near in before.into_iter().chain(leg.samples.get(point + 1)) {
                let end = LineEnd { at, kind: EndKind::Crossing(kind), motion: near.reading.motion };
                if is_stable(near, sample) && !all.contains(&end) {
                    all.push(end);
                }
            }
        }
    }
    all
}

/// The connections in which stable motions end.
fn ends(plan: &CurvePlan, found: &Branches) -> Vec<LineEnd> {
    let legs = found.branches.iter().flat_map(|followed| &followed.legs);
    let end = |leg: &crate::Leg| {
        let BranchEnd::Homoclinic(connection) = &leg.end else { return None };
        let [.., before, last] = &leg.samples[..] else { return None };
        let pair: [&Sample; 2] = [before, last];
        let mut at = [plan.fixed_value(); 2];
        at[plan.varied()] = connection.parameter;
        is_stable(pair[0], pair[1]).then(|| LineEnd {
            at,
            kind: EndKind::Connection(connection.kind()),
            motion: last.reading.motion,
        })
    };
    legs.filter_map(end).collect()
}
