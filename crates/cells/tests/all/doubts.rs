//! What makes a fit doubtful leaves it without a motion and without a place.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::bodies::{RADIUS, cell_of, preset};
use motiform_analysis::regime::Regime;
use motiform_cells::{CellTrack, FitOptions, Prediction, Sample, fit_cell, fit_together, observe};
use motiform_inference::{Placement, Symmetry};
use motiform_tracks::modes::ModeOptions;

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

/// Circling cells give names at once; two of them under one name, or one whose unit changes, give none, and no fit.
#[test]
fn records_of_two_cells_or_two_units_are_neither_named_nor_fitted() {
    let mut study = preset("fig3", 0.001, (0.5, 300));
    study.set("gamma", 0.1).unwrap();
    study.set("kappa2", -0.05).unwrap();
    let sound = cell_of(&study, 0.35, 0.01).tracks;
    let changed = |change: &dyn Fn(usize, &mut [f64; 2])| {
        let mut tracks = cell_of(&study, 0.35, 0.01).tracks;
        for (k, outline) in tracks.cells[0].frames.iter_mut().enumerate() {
            outline.points.iter_mut().for_each(|point| change(k, point));
        }
        Sample::of_tracks(tracks, &ModeOptions::default())
    };
    let mixed = changed(&|k, point| point[0] += if k % 2 == 0 { 40.0 } else { 0.0 });
    let unit = changed(&|k, point| point.iter_mut().for_each(|x| *x *= if k < 150 { 1.0 } else { 0.4 }));
    assert!(Sample::of_tracks(sound, &ModeOptions::default()).cells[0].modes.inconsistent().is_none());
    for (sample, why) in [(mixed, "two cells have one name"), (unit, "frame 150: another unit")] {
        let seen = observe(&sample.cells[0]);
        assert!(seen.motion.regime.is_none() && seen.motion.why.contains(why), "{:?}", seen.motion);
        let reason = fit_cell(&sample.cells[0], &FitOptions::default(), &()).unwrap().fitted.unwrap_err();
        assert!(reason.contains(why), "{reason}");
        let all: Vec<&CellTrack> = sample.cells.iter().collect();
        let reason = fit_together(&all, &FitOptions::default(), &()).unwrap().fitted.unwrap_err();
        assert!(reason.contains("cell one: ") && reason.contains(why), "{reason}");
    }
}
