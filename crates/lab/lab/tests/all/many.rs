//! Motions of many plans at once.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_analysis::Verdict;
use motiform_lab::{analyse, many};
use motiform_study::{RunPlan, Study};

fn plans(text: &str) -> Vec<RunPlan> {
    let plan = |kappa2: f64| {
        let mut study = Study::parse(text, "text", "test").unwrap();
        study.set("kappa2", kappa2).unwrap();
        RunPlan::new(&study).unwrap()
    };
    [0.3, 0.5, 0.7, 0.9, 1.2].map(plan).to_vec()
}

/// In lanes, and one by one with a method that has none.
#[test]
fn verdicts_are_those_of_each_plan() {
    for text in ["preset = \"fig4\"", "preset = \"fig4\"\n[run]\nstepper = \"dopri5\""] {
        let plans = plans(text);
        let alone = |plan: &RunPlan| analyse::classify(plan, 0.0, &()).unwrap().unwrap();
        let alone: Vec<Verdict> = plans.iter().map(alone).collect();
        assert_eq!(many::classify(&plans, 0.0, &()).unwrap().unwrap(), alone);
        assert!(alone[0].regime != alone[4].regime);
    }
    assert_eq!(many::classify(&[], 0.0, &()).unwrap(), Some(Vec::new()));
}
