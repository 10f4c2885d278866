//! The nearest bifurcations of a fitted cell against those of the law that it was simulated by.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::bodies::{cell, preset};
use motiform_cells::{FitOptions, fit_cell};
use motiform_diagrams::follow;
use motiform_study::branches::{Along, BranchSettings};
use motiform_study::{BranchPlan, presets::find_any};

#[test]
fn a_zigzag_is_as_far_from_its_bifurcations_as_its_law() {
    let sample = cell(&preset("fig5a", 0.005, (0.5, 600)), 0.01);
    let options =
        FitOptions { draws: 10, simulations: 0, bifurcations: true, drift: false, ..FitOptions::default() };
    let fit = fit_cell(&sample.cells[0], &options, &()).unwrap();
    let law = find_any("fig5a", "tensor").unwrap();
    let along = Along { name: "kappa2".to_owned(), from: 0.45, to: 1.35 };
    let settings = BranchSettings { points: 400, branches: 1, ..BranchSettings::over(along) };
    let truth = follow(&BranchPlan::new(&law, &settings).unwrap(), None, &()).unwrap().special(0);
    let mut compared = 0;
    for near in fit.bifurcations.iter().filter(|near| near.parameter == "kappa2") {
        println!("{}", near.sentence());
        let like = |entry: &&motiform_diagrams::SpecialEntry| {
            entry.kind == near.kind && (entry.parameter > 0.9) == (near.at > near.value)
        };
        let off = |entry: &&motiform_diagrams::SpecialEntry| (entry.parameter - 0.9).abs();
        let Some(known) = truth.iter().filter(like).min_by(|a, b| off(a).total_cmp(&off(b))) else {
            continue;
        };
        // the place moves with all coefficients, not only with kappa2
        assert!((near.at - known.parameter).abs() < 0.08, "{} but {}", near.sentence(), known.parameter);
        compared += 1;
    }
    assert!(compared > 0, "{:?} {truth:?}", fit.bifurcations);
}
