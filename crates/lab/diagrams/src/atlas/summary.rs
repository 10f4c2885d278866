//! An atlas in a few numbers: what `--json` prints and `summary.json` holds.

use crate::atlas::boundary::{Boundary, boundaries};
use crate::atlas::courses::mixed_courses;
use crate::atlas::folder::AtlasFolder;
use crate::atlas::points::special_points;
use crate::atlas::region::{Region, regions};
use motiform_analysis::Regime;
use serde_json::{Map, Value, json};

/// The summary as JSON: `{"regions": [...], "boundaries": [...], "curves": [...], "ends": [...], ...}`.
pub fn atlas_summary(folder: &AtlasFolder) -> Value {
    let AtlasFolder { plan, grid, lines } = folder;
    let c = &plan.computation;
    let names = plan.plane().map(|side| side.name);
    let place = |at: [f64; 2]| -> Value {
        names.iter().cloned().zip(at.map(Value::from)).collect::<Map<String, Value>>().into()
    };
    let boundaries = boundaries(plan, grid, lines);
    let all: usize = boundaries.iter().map(|boundary| boundary.edges).sum();
    let unnamed: usize = boundaries.iter().map(|boundary| boundary.unnamed).sum();
    let special = special_points(folder);
    let curves = lines.iter().flat_map(|line| &line.curves).map(|one| {
        let own = special.iter().filter(|point| std::ptr::eq(point.on, one));
        let marks: Vec<Value> = own
            .map(|point| {
                let sample = point.sample;
                json!({ "kind": point.kind.name(), "at": place(sample.parameters), "period": sample.period })
            })
            .collect();
        json!({
            "kind": one.curve.kind,
            "motion": one.motion,
            "points": one.curve.samples().count(),
            "codimension_2": marks,
            "refused": one.curve.refused,
        })
    });
    let ends = lines
        .iter()
        .flat_map(|line| &line.ends)
        .map(|end| json!({ "kind": end.kind.words(), "motion": end.motion, "at": place(end.at) }));
    let lines_json = lines.iter().map(|line| {
        json!({
            "at": place(line.at),
            "along": names[line.side],
            "motion": line.motion,
            "branches": line.branches,
            "steps": line.steps,
            "refused": line.refused,
        })
    });
    let region =
        |one: &Region| json!({ "motions": one.motions, "share": one.share, "inside": place(one.at) });
    json!({
        "model": c.scan.model,
        "parameters": c.scan.parameters,
        "plane": plan.plane(),
        "plan_hash": plan.hash(),
        "cells": grid.places.len(),
        "computed": grid.computed(),
        "samples": c.scan.samples,
        "regions": regions(plan, grid).iter().map(region).collect::<Vec<_>>(),
        "mixed_courses": mixed_courses(grid),
        "boundaries": boundaries.iter().map(boundary_json).collect::<Vec<_>>(),
        "named": if all > 0 { json!(1.0 - unnamed as f64 / all as f64) } else { Value::Null },
        "curves": curves.collect::<Vec<_>>(),
        "ends": ends.collect::<Vec<_>>(),
        "lines": lines_json.collect::<Vec<_>>(),
    })
}

fn boundary_json(boundary: &Boundary) -> Value {
    let kinds: Vec<Value> =
        boundary.kinds.iter().map(|(kind, edges)| json!({ "kind": kind, "edges": edges })).collect();
    json!({
        "between": boundary.between,
        "edges": boundary.edges,
        "kinds": kinds,
        "unnamed": boundary.unnamed,
        "why": boundary.why,
    })
}

/// Motions as words: `circular + zigzag`.
pub fn words(motions: &[Regime]) -> String {
    motions.iter().map(|motion| motion.words()).collect::<Vec<_>>().join(" + ")
}
