//! Curves in a few numbers: what `--json` prints and `summary.json` holds.

use super::result::{CurveLeg, CurveSample, Curves, FollowedCurve};
use crate::branches::summary::summary;
use motiform_continuation::{Degenerate, End};
use motiform_study::CurvePlan;
use serde_json::{Map, Value, json};

/// The points of codimension two on a curve, in its order.
pub fn codimension_2(curve: &FollowedCurve) -> Vec<(Degenerate, &CurveSample)> {
    curve.samples().filter_map(|sample| Some((sample.degenerate?, sample))).collect()
}

/// The kinds of points of codimension two that were looked for on a curve and not found.
pub fn not_found(curve: &FollowedCurve) -> Vec<Degenerate> {
    let found = codimension_2(curve);
    curve.sought.iter().copied().filter(|sought| found.iter().all(|entry| entry.0 != *sought)).collect()
}

/// Why a curve ended, leg by leg.
pub fn curve_ends(plan: &CurvePlan, curve: &FollowedCurve) -> Vec<String> {
    curve.legs.iter().map(|leg| ending(plan, leg)).collect()
}

fn ending(plan: &CurvePlan, leg: &CurveLeg) -> String {
    match (&leg.end, leg.samples.last()) {
        (End::RangeLeft, Some(last)) => {
            let sides = plan.computation.plane.iter().zip(last.parameters);
            let off = |(side, value): &(&motiform_study::branches::Along, f64)| {
                ((value - side.from).abs().min((value - side.to).abs())) / (side.to - side.from)
            };
            let nearest = sides.min_by(|a, b| off(a).total_cmp(&off(b)));
            nearest.map_or_else(String::new, |(side, value)| {
                format!("{} left its range at {}", side.name, motiform_study::titles::number(value))
            })
        }
        (End::Closed, _) => "the curve came back to its start".to_owned(),
        (end, _) => end.to_string(),
    }
}

/// The summary as JSON: `{"curves": [{"kind", "start", "codimension_2", "not_found", "ends", ...}], "branches": [...], ...}`.
pub fn curve_summary(plan: &CurvePlan, found: &Curves) -> Value {
    let c = &plan.computation;
    let start = &c.branches.start;
    let branches = summary(&plan.branches(), &found.branches);
    json!({
        "model": start.model,
        "parameters": start.parameters,
        "along": c.branches.along,
        "in": c.plane,
        "kinds": c.kinds,
        "complete": found.complete,
        "curves": found.curves.iter().map(|curve| entry(plan, found, curve)).collect::<Vec<_>>(),
        "branches": branches["branches"],
    })
}

fn entry(plan: &CurvePlan, found: &Curves, curve: &FollowedCurve) -> Value {
    let [branch, ..] = curve.start;
    let mut object = json!({ "kind": curve.kind, "branch": branch });
    let mut put = |key: &str, value: Value| object[key] = value;
    if let Some(at) = found.start(plan, curve) {
        put("start", place(plan, at));
    }
    if let Some(why) = &curve.refused {
        put("refused", why.as_str().into());
    }
    put("points", curve.samples().count().into());
    let ranges = [0, 1].map(|side| {
        let values = || curve.samples().map(|sample| sample.parameters[side]);
        json!([values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)])
    });
    if curve.samples().next().is_some() {
        let names = plan.computation.plane.iter().map(|side| side.name.clone());
        put("range", names.zip(ranges).collect::<Map<String, Value>>().into());
    }
    let located = codimension_2(curve).into_iter().map(|(kind, sample)| {
        let mut point = place(plan, sample.parameters);
        point["kind"] = kind.name().into();
        point["period"] = sample.period.into();
        point
    });
    put("codimension_2", located.collect::<Vec<_>>().into());
    put("not_found", not_found(curve).iter().map(|kind| kind.name()).collect::<Vec<_>>().into());
    put("ends", curve_ends(plan, curve).into());
    object
}

fn place(plan: &CurvePlan, at: [f64; 2]) -> Value {
    let names = plan.computation.plane.iter().map(|side| side.name.clone());
    Value::Object(names.zip(at.map(Value::from)).collect())
}
