//! Rows classified in lanes: the verdicts of single orbits, to the last bit.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::preset;
use motiform_analysis::regime::{Regime, Verdict};
use motiform_kernels::Kernel;
use motiform_lab::scan::{Axis, Classify, Evaluate};
use motiform_study::{ScanPlan, Study};
use std::collections::BTreeSet;

fn plan(name: &str, axes: [&str; 2], samples: u64) -> ScanPlan {
    let study = preset(name, |study| {
        study.scan.axes = axes.map(|text| Axis::parse(text).unwrap()).into();
        study.scan.samples = samples;
        study.scan.budget = 8000.0;
    });
    ScanPlan::new(&study).unwrap()
}

/// All rows together.
pub(crate) fn in_lanes(plan: &ScanPlan) -> Vec<Verdict> {
    let samples = plan.computation.samples;
    let mut rows = (0..plan.rows()).map(|row| (row / samples, row % samples));
    let mut verdicts = vec![None; plan.rows()];
    let mut done = |(cell, sample): (usize, usize),
                    verdict: Result<Option<Verdict>, motiform_study::Error>| {
        let row = cell * samples + sample;
        assert!(verdicts[row].replace(verdict.unwrap().unwrap()).is_none(), "row {row} came twice");
    };
    Classify.evaluate_all(plan, &mut || rows.next(), &mut done, &());
    verdicts.into_iter().map(Option::unwrap).collect()
}

/// Row after row, each by itself.
pub(crate) fn one_by_one(plan: &ScanPlan) -> Vec<Verdict> {
    let samples = plan.computation.samples;
    let row = |row| Classify.evaluate(plan, row / samples, row % samples, &()).unwrap().unwrap();
    (0..plan.rows()).map(row).collect()
}

pub(crate) fn regimes(verdicts: &[Verdict]) -> BTreeSet<String> {
    verdicts.iter().map(|verdict| verdict.regime.name().to_owned()).collect()
}

/// Numbers and reasons of a verdict; NaN equals NaN.
pub(crate) fn text(verdict: &Verdict) -> String {
    format!("{verdict:?}")
}

#[test]
fn lanes_and_single_orbits_agree_on_the_reduced_model() {
    let plan = plan("fig1", ["kappa2=-0.22:0.22:9", "gamma=-0.16:0.12:7"], 1);
    let (lanes, single) = (in_lanes(&plan), one_by_one(&plan));
    for (row, (a, b)) in lanes.iter().zip(&single).enumerate() {
        assert_eq!(text(a), text(b), "row {row}");
    }
    let seen = regimes(&lanes);
    assert!(seen.len() >= 4, "{seen:?}");
}

#[test]
fn lanes_and_single_orbits_agree_on_chaos_and_blow_up() {
    let plan = plan("fig4", ["kappa2=0.1:0.8:8", "kappa3=0.1:0.3:2"], 2);
    let (lanes, single) = (in_lanes(&plan), one_by_one(&plan));
    for (row, (a, b)) in lanes.iter().zip(&single).enumerate() {
        assert_eq!(text(a), text(b), "row {row}");
    }
    let seen = regimes(&lanes);
    for regime in [Regime::Chaotic, Regime::BlowUp, Regime::Circular] {
        assert!(seen.contains(regime.name()), "{seen:?}");
    }
}

/// Terms beyond those of the paper go through the list of products; the first column has none of them.
#[test]
fn lanes_and_single_orbits_agree_on_all_terms() {
    let plan = plan("fig4", ["a5=0:0.4:3", "kappa2=0.2:1.4:4"], 1);
    let kernels: BTreeSet<String> = (0..plan.cells())
        .map(|cell| format!("{:?}", Kernel::of(plan.model_of(cell).unwrap().as_ref())))
        .collect();
    assert_eq!(kernels.len(), 2, "{kernels:?}");
    let (lanes, single) = (in_lanes(&plan), one_by_one(&plan));
    for (row, (a, b)) in lanes.iter().zip(&single).enumerate() {
        assert_eq!(text(a), text(b), "row {row}");
    }
}

/// Rates over two decades: each body is looked at over its own times, in lanes as by itself.
#[test]
fn lanes_and_single_orbits_agree_on_equations_of_all_speeds() {
    let equations = "[model.amplitudes]\nmodes = [1, 2]\n[model.amplitudes.parameters]\nk = 1\n[model.amplitudes.equations]\n\
                     z1 = \"k*((0.3 + 0.2*i)*z1 - |z1|^2*z1 + 0.5*conj(z1)*z2)\"\nz2 = \"k*(-z2 + z1^2)\"\n\
                     [initial]\nv1 = 0.4\nz2_re = 0.1\n";
    let mut study = Study::parse(equations, "text", "test").unwrap();
    study.scan.axes = vec![Axis::parse("k=0.01:1:3").unwrap()];
    let plan = ScanPlan::new(&study).unwrap();
    let (lanes, single) = (in_lanes(&plan), one_by_one(&plan));
    for (row, (a, b)) in lanes.iter().zip(&single).enumerate() {
        assert_eq!(text(a), text(b), "row {row}");
    }
    assert_eq!(regimes(&lanes).len(), 1, "{:?}", regimes(&lanes));
    let looks: BTreeSet<String> = (0..3).map(|cell| plan.look_of(cell).unwrap().to_string()).collect();
    assert_eq!(looks.len(), 3, "{looks:?}");
}
