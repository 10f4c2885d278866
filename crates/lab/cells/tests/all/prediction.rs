//! Simulated cells beside the observed one: the right model agrees, wrong ones do not.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::bodies::{cell, preset};
use motiform_cells::{Agreement, CellTrack, Companions, FitOptions, Prediction, fit_cell, predict};
use motiform_inference::Fit;
use std::sync::LazyLock;

const COMPANIONS: Companions = Companions { count: 99, seed: 1 };

fn fitted(name: &str, noise: f64) -> (CellTrack, Fit) {
    let cell = cell(&preset(name, noise, (0.5, 500)), 0.01).cells.remove(0);
    let options = FitOptions { draws: 1, drift: false, ..FitOptions::default() };
    let fit = fit_cell(&cell, &options, &()).unwrap().fitted.unwrap();
    (cell, fit.model().clone())
}

/// Several tests look at these.
static CHAOTIC: LazyLock<(CellTrack, Fit)> = LazyLock::new(|| fitted("fig5b", 0.02));
static ZIGZAG: LazyLock<(CellTrack, Fit)> = LazyLock::new(|| fitted("fig5a", 0.02));

fn verdicts(prediction: &Prediction) -> Vec<(&str, f64)> {
    prediction.comparisons.iter().map(|one| (one.statistic.kind.name(), one.envelope.p_value)).collect()
}

#[test]
fn the_fit_of_a_cell_moves_like_the_cell_and_that_of_another_does_not() {
    let (chaotic, chaotic_fit) = &*CHAOTIC;
    let (zigzag, zigzag_fit) = &*ZIGZAG;
    for (cell, fit) in [(chaotic, chaotic_fit), (zigzag, zigzag_fit)] {
        let found = predict(&cell.track, fit, COMPANIONS, &()).unwrap();
        assert_eq!((found.cells, found.lost, found.comparisons.len()), (99, 0, 9));
        assert!(found.count(Agreement::Differs) <= 1, "{:?}", verdicts(&found)); // one of a hundred differs by chance
        assert!(found.count(Agreement::Agrees) >= 7, "{:?}", verdicts(&found));
    }
    for (cell, fit) in [(chaotic, zigzag_fit), (zigzag, chaotic_fit)] {
        let found = predict(&cell.track, fit, COMPANIONS, &()).unwrap();
        assert!(found.is_unstable() || found.count(Agreement::Differs) >= 3, "{:?}", verdicts(&found));
    }
}

/// Straight and circular cells whose triangles are far smaller than their ellipses: the noise of both modes is the same in the units of
/// the data, not in natural ones.
#[test]
fn simulated_cells_have_the_noise_of_the_observed_one_in_each_mode() {
    for (kappa2, kappa3) in [(1.5, 1.0), (0.9, 0.6)] {
        let mut study = preset("fig4", 0.03, (0.5, 400));
        study.set("kappa2", kappa2).unwrap();
        study.set("kappa3", kappa3).unwrap();
        let cell = cell(&study, 0.005).cells.remove(0);
        let options = FitOptions { draws: 1, drift: false, simulations: 0, ..FitOptions::default() };
        let fit = fit_cell(&cell, &options, &()).unwrap().fitted.unwrap();
        let scales = &fit.model().scales;
        assert!(scales.amplitudes[1] > 2.0 * scales.amplitudes[2], "{:?}", scales.amplitudes);
        let found = predict(&cell.track, fit.model(), COMPANIONS, &()).unwrap();
        assert!(found.count(Agreement::Differs) == 0, "{:?}", verdicts(&found));
        assert!(found.count(Agreement::Agrees) >= 7, "{:?}", verdicts(&found));
    }
}

/// 99 simulated cells where none of their p-values is near .05, otherwise all; the first ones are the same.
#[test]
fn simulation_ends_where_more_cells_cannot_change_a_verdict() {
    let ((chaotic, _), (zigzag, fit)) = (&*CHAOTIC, &*ZIGZAG);
    for (cell, is_clear) in [(zigzag, true), (chaotic, false)] {
        let of = |count| predict(&cell.track, fit, Companions { count, seed: 1 }, &()).unwrap();
        let (few, all) = (of(99), of(199));
        let clear = few.lost == 0 && few.comparisons.iter().all(|one| one.envelope.p_value > 0.12);
        assert_eq!((clear, all.cells + all.lost), (is_clear, if is_clear { 99 } else { 199 }));
        assert_eq!(few.shown, all.shown);
        let more = of(210); // asked for, so simulated
        assert_eq!(more.cells + more.lost, 210);
    }
}

#[test]
fn the_same_seed_gives_the_same_cells_and_the_watch_stops_the_work() {
    struct Stop;
    impl motiform_dynamics::Watch for Stop {
        fn stopped(&self) -> bool {
            true
        }
    }
    let (CellTrack { track, .. }, fit) = &*CHAOTIC;
    let few = |seed| predict(track, fit, Companions { count: 5, seed }, &()).unwrap().shown;
    assert_eq!(few(3), few(3));
    assert_ne!(few(3), few(4));
    // at the frames of the cell, gaps included, and from where it starts
    let mut gappy = track.clone();
    gappy.0.remove(10);
    let shown = predict(&gappy, fit, Companions { count: 1, seed: 3 }, &()).unwrap().shown;
    assert!(shown[0].frames[10].is_none() && shown[0].frames.len() == gappy.0.len() + 1);
    let start = shown[0].frames[0].as_ref().unwrap();
    assert!((0..6).all(|k| (start[k] - gappy.0[0].y[k]).abs() < 0.1), "{start:?}");
    assert!(predict(&gappy, fit, COMPANIONS, &Stop).is_none());
}
