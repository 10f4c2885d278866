//! What makes a fit doubtful leaves it without a motion and without a place.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::bodies::{RADIUS, cell_of, preset};
use motiform_analysis::regime::Regime;
use motiform_cells::{FitOptions, Prediction, fit_cell};
use motiform_inference::{Placement, Symmetry};

/// Weakly handed cells: where the likelihood ratio is between both levels, nothing is said; beyond, they are handed; neither is ever called mirror symmetric with a
/// ratio that speaks against it.
#[test]
fn a_cell_that_may_be_handed_has_neither_motion_nor_place() {
    let mut seen = [0; 3];
    for omega in [0.0, 0.01, 0.02, 0.03] {
        let mut study = preset("chiral", 0.01, (0.5, 300));
        study.set("omega", omega).unwrap();
        study.set("kappa2", 0.5).unwrap();
        study.run.seed = 3;
        let sample = cell_of(&study, RADIUS, 0.01);
        let options = FitOptions { draws: 4, drift: false, simulations: 0, ..FitOptions::default() };
        let fitted = fit_cell(&sample.cells[0], &options, &()).unwrap().fitted.unwrap();
        let (p, symmetry) = (fitted.handedness.p_value, fitted.handedness.symmetry);
        println!("omega {omega}: {symmetry:?}, p = {p:.1e}, {:?}", fitted.regime.as_ref().map(|r| r.best));
        match symmetry {
            Symmetry::Handed => assert!(p < 1e-4),
            Symmetry::Mirror => assert!(p >= 0.01),
            Symmetry::Undecided => assert!(p >= 1e-4),
        }
        let doubted = p < 0.01;
        seen[if p < 1e-4 { 2 } else { usize::from(doubted) }] += 1;
        if doubted {
            assert!(fitted.places.iter().all(|place| matches!(place, Placement::Refused { .. })));
            assert!(symmetry == Symmetry::Handed || fitted.regime.is_none());
            assert!(fitted.doubts.iter().any(|doubt| doubt.contains("handed")));
        }
    }
    assert!(seen[0] > 0 && seen[2] > 0, "{seen:?}");
}

/// A quasi-periodic cell whose short record is described best by equations that circle, and blow up under the fitted noise: by the draws alone it had a wrong
/// name (2 of 150 such cells, 1 of a thousand of four motions).
#[test]
fn a_fit_whose_simulated_cells_blow_up_has_no_name() {
    let mut study = preset("fig3", 0.002, (0.5, 300));
    study.run.seed = 46;
    let sample = cell_of(&study, 0.35, 0.01);
    let options = FitOptions { draws: 4, drift: false, simulations: 40, ..FitOptions::default() };
    let fit = fit_cell(&sample.cells[0], &options, &()).unwrap();
    assert!(fit.prediction.as_ref().is_some_and(Prediction::is_unstable));
    let fitted = fit.fitted.unwrap();
    let found = fitted.regime.as_ref().unwrap();
    assert_eq!((found.regime, found.best, found.share), (None, Regime::Circular, 1.0));
    assert!(fitted.why().contains("simulated by the fit"), "{}", fitted.why());
    assert!(fitted.places.iter().all(|place| matches!(place, Placement::Refused { .. })));
}
