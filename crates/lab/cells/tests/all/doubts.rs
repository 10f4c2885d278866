//! Doubts leave a fit without a motion and without a place.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::bodies::{RADIUS, cell_of, preset};
use super::recordings::{Seen, Shape, Walker, tracks};
use super::samples::draws;
use motiform_analysis::regime::Regime;
use motiform_cells::{
    CellTrack, FitOptions, Fitted, FittedRegime, PERSISTENT_WALK, Sample, fit_cell, fit_together, observe,
};
use motiform_inference::{Placement, Symmetry, Warning};
use motiform_tracks::modes::ModeOptions;
use motiform_tracks::{Tracks, centroid};

/// Weakly handed cells: where the likelihood ratio is between both levels, nothing is said; beyond, they are handed; neither is ever
/// called mirror symmetric with a ratio that speaks against it.
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
            let named = |reasons: &[String]| reasons.iter().any(|reason| reason.contains("handed"));
            assert!(
                fitted
                    .places
                    .iter()
                    .all(|place| matches!(place, Placement::Refused { reasons } if named(reasons)))
            );
            assert_eq!(named(&fitted.doubts), symmetry == Symmetry::Undecided);
        }
    }
    assert!(seen[0] > 0 && seen[2] > 0, "{seen:?}");
}

/// A cell that moves straight, and from the middle on another one that circles, where the first one ended: no step shows it, but the
/// fit of both does not describe the record.
#[test]
fn a_fit_that_its_cell_contradicts_has_neither_name_nor_symmetry() {
    let body = |kappa2: f64, kappa3: f64| {
        let mut study = preset("fig4", 0.01, (0.5, 200));
        study.set("kappa2", kappa2).unwrap();
        study.set("kappa3", kappa3).unwrap();
        cell_of(&study, RADIUS, 0.01).tracks
    };
    let (mut tracks, second) = (body(1.5, 1.0), body(0.9, 0.6));
    let end = tracks.cells[0].frames.last().unwrap().clone();
    let start = &second.cells[0].frames[0];
    let shift = [0, 1].map(|k| centroid(&end.points)[k] - centroid(&start.points)[k]);
    for outline in second.cells[0].frames.iter().skip(1) {
        let mut outline = outline.clone();
        outline.frame += end.frame;
        outline.t += end.t;
        outline.points.iter_mut().for_each(|point| *point = [point[0] + shift[0], point[1] + shift[1]]);
        tracks.cells[0].frames.push(outline);
    }
    let sample = Sample::of_tracks(tracks, &ModeOptions::default());
    assert!(sample.cells[0].modes.inconsistent().is_none());
    let options = FitOptions { draws: 4, drift: false, simulations: 99, ..FitOptions::default() };
    let fit = fit_cell(&sample.cells[0], &options, &()).unwrap();
    let fitted = fit.fitted.unwrap();
    assert!(!fitted.doubts.is_empty(), "{:?}", fitted.warnings);
    assert!(fitted.regime.as_ref().is_none_or(|found| found.regime.is_none()), "{}", fitted.why());
    assert!(fitted.symmetry() == Symmetry::Undecided && !fitted.is_handed());
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
        assert!(reason.contains("cell 1: ") && reason.contains(why), "{reason}");
    }
}

/// A circling cell in images whose pixels are taken for squares and are not: the fit of stretched outlines is called handed by its
/// likelihood, and is not.
#[test]
fn outlines_of_pixels_that_are_not_square_are_doubted() {
    let fitted = |scale: f64| {
        let mut study = preset("fig4", 0.01, (0.5, 300));
        study.set("kappa2", 0.5).unwrap();
        study.set("kappa3", 0.5).unwrap();
        let mut tracks = cell_of(&study, 0.6, 0.01).tracks;
        let points = tracks.cells[0].frames.iter_mut().flat_map(|outline| &mut outline.points);
        points.for_each(|point| point[1] *= scale);
        let sample = Sample::of_tracks(tracks, &ModeOptions::default());
        let options = FitOptions { drift: false, simulations: 0, draws: 10, ..FitOptions::default() };
        fit_cell(&sample.cells[0], &options, &()).unwrap().fitted.unwrap()
    };
    let [square, other] = [1.0, 0.8].map(fitted);
    assert_eq!(square.regime.as_ref().and_then(|found| found.regime), Some(Regime::Circular));
    assert_ne!(square.symmetry(), Symmetry::Handed);
    let why = other.why();
    assert!(why.contains("pixels are not square") && why.contains("elongated at"), "{why}");
    assert_eq!((other.symmetry(), other.is_handed()), (Symmetry::Undecided, false));
    assert!(other.regime.is_none());
    assert!(other.places.iter().all(|place| matches!(place, Placement::Refused { .. })));
}

/// A circling cell on a stage that drifts by some per cent of its speed: the likelihood calls it handed, and it is not said.
#[test]
fn a_circling_cell_on_a_drifting_stage_is_not_handed() {
    let mut called = 0;
    for drift in [0.0, 0.02, 0.05] {
        let mut study = preset("fig4", 0.01, (0.5, 400));
        study.set("kappa2", 0.5).unwrap();
        study.set("kappa3", 0.5).unwrap();
        let tracks = cell_of(&study, 0.6, 0.01).tracks;
        let mean = super::recordings::mean_speed(&tracks);
        let sample = Sample::of_tracks(tracks.drifting([drift * mean, 0.0]), &ModeOptions::default());
        let options = FitOptions { drift: false, simulations: 0, draws: 4, ..FitOptions::default() };
        let fitted = fit_cell(&sample.cells[0], &options, &()).unwrap().fitted.unwrap();
        let raw = &fitted.handedness;
        println!("drift {drift}: {:?}, p = {:.1e}, {:?}", raw.symmetry, raw.p_value, fitted.doubts);
        called += usize::from(raw.symmetry == Symmetry::Handed);
        assert!(!fitted.is_handed() && fitted.symmetry() == Symmetry::Undecided, "{drift}");
    }
    assert!(called > 0, "the drift is too small for this test");
}

/// Walkers whose shape fluctuates by itself: noise carries them, and they are no cells that rest.
#[test]
fn a_random_walker_is_not_motionless() {
    let mut named = 0;
    for (seed, shape) in [(0, Shape::Passive), (1, Shape::Passive), (2, Shape::Passive), (3, Shape::Polar)] {
        let walker = Walker { speed: 0.8, persistence: 6.0, shape, frames: 300, noise: 0.005 };
        let sample = Sample::of_tracks(tracks(vec![walker.outlines(40 + seed)]), &ModeOptions::default());
        let options = FitOptions { drift: false, simulations: 0, draws: 10, ..FitOptions::default() };
        let fitted = fit_cell(&sample.cells[0], &options, &()).unwrap().fitted.unwrap();
        println!("{}: {}", fitted.motion_name(), fitted.why());
        assert!(fitted.regime.as_ref().is_none_or(|found| found.regime != Some(Regime::Motionless)));
        if fitted.motion_name() == PERSISTENT_WALK {
            named += 1;
            assert!(fitted.why().contains("noise carries the displacement"), "{}", fitted.why());
            assert!(fitted.places.iter().all(|place| matches!(place, Placement::Refused { .. })));
        }
        assert_ne!(observe(&sample.cells[0]).motion.regime, Some(Regime::Motionless));
    }
    assert!(named > 0, "none is named");
}

/// Walkers whose fitted shape decays as a power of time, which is neither a rest nor any motion: noise carries them all the same.
#[test]
fn walkers_whose_equations_rest_slowly_are_walks() {
    let mut slow = 0;
    for seed in 0..draws(7, 14) {
        let walker =
            Walker { speed: 0.5, persistence: 8.0, shape: Shape::Passive, frames: 300, noise: 0.005 };
        let sample = Sample::of_tracks(tracks(vec![walker.outlines(seed)]), &ModeOptions::default());
        let options = FitOptions { drift: false, simulations: 0, draws: 23, ..FitOptions::default() };
        let fitted = fit_cell(&sample.cells[0], &options, &()).unwrap().fitted.unwrap();
        println!("{seed} {}: {}", fitted.motion_name(), fitted.why());
        assert!(fitted.regime.as_ref().is_none_or(|found| found.regime.is_none()), "{}", fitted.why());
        let of_slow = fitted.regime.as_ref().is_some_and(|found| found.best == Regime::Undetermined);
        slow += usize::from(of_slow && fitted.motion_name() == PERSISTENT_WALK);
    }
    assert!(slow > draws(0, 1), "{slow} of the best models decay slowly");
}

/// Models of which 90 % agree, and no name: the reason is the one that holds.
#[test]
fn a_missing_name_has_its_reason() {
    use Regime::{BlowUp, Chaotic, Undetermined, Zigzag};
    let found = |best: Regime, counts: &[(Regime, usize)]| {
        let draws = counts.iter().map(|one| one.1).sum();
        let lost = counts.iter().find(|one| one.0 == BlowUp).map_or(0, |one| one.1);
        let share = counts[0].1 as f64 / (draws - lost) as f64;
        FittedRegime {
            regime: None,
            best,
            share,
            counts: counts.to_vec(),
            draws,
            start: Vec::new(),
            carried: false,
            slow: false,
            coarse: false,
            driven: None,
        }
    };
    for (found, reason) in [
        (found(Undetermined, &[(Chaotic, 22), (BlowUp, 1)]), "the best model itself has no motion"),
        (found(Zigzag, &[(Chaotic, 22), (BlowUp, 1)]), "the best model itself is zigzag"),
        (found(Chaotic, &[(Chaotic, 30), (BlowUp, 10)]), "more than a tenth of them blow up"),
        (found(Chaotic, &[(Chaotic, 30), (Zigzag, 10)]), "75 % of those that do not blow up agree"),
    ] {
        let why = found.why_unnamed().unwrap();
        assert!(why.contains(reason), "{why}");
    }
    let named = FittedRegime { regime: Some(Chaotic), ..found(Chaotic, &[(Chaotic, 23)]) };
    assert_eq!(named.why_unnamed(), None);
}

/// A simulated cell of a preset with other parameters.
fn cell_on(study: (&str, &[(&str, f64)]), seed: u64, frames: usize) -> Tracks {
    let mut found = preset(study.0, 0.02, (0.5, frames));
    study.1.iter().for_each(|(name, value)| found.set(name, *value).unwrap());
    found.run.seed = seed;
    cell_of(&found, RADIUS, 0.01).tracks
}

const HANDED: (&str, &[(&str, f64)]) = ("chiral", &[("kappa2", 0.5), ("omega", 0.1)]);

/// Two handed cells and the mirror images of two more: one law of all has no coefficients, and those of one sense have one.
#[test]
fn cells_of_both_senses_have_no_law_together() {
    let mut all: Vec<_> = (3..7).map(|seed| cell_on(HANDED, seed, 200).cells.remove(0).frames).collect();
    for outline in all.iter_mut().skip(2).flatten() {
        outline.points.iter_mut().for_each(|point| point[1] = -point[1]);
        outline.points.reverse();
    }
    let sample = Sample::of_tracks(tracks(all), &ModeOptions::default());
    let cells: Vec<&CellTrack> = sample.cells.iter().collect();
    let options = FitOptions { drift: false, simulations: 0, draws: 4, ..FitOptions::default() };
    let why = fit_together(&cells, &options, &()).unwrap().fitted.unwrap_err();
    println!("{why}");
    assert!(
        why.contains("cells of both senses are handed") && why.contains("or those of each sense together"),
        "{why}"
    );
    assert!(["1, 2", "3, 4"].iter().all(|side| why.contains(side)), "{why}");
    let fitted = fit_together(&cells[..2], &options, &()).unwrap().fitted.unwrap();
    assert_eq!(fitted.handedness.symmetry, Symmetry::Handed);
}

/// A stage that drifts by much of the speed: the correction leaves nothing of it, of handed cells and others, which keep their symmetry.
/// Of one that turns back in the middle no velocity is subtracted that explains it, and the warning says that the correction was given.
#[test]
fn a_drift_is_subtracted_until_none_is_seen() {
    let fitted = |tracks: Tracks, stage: bool| {
        let sample = Sample::of_tracks(tracks, &ModeOptions::default());
        let options = FitOptions { drift: false, simulations: 0, draws: 4, stage, ..FitOptions::default() };
        fit_cell(&sample.cells[0], &options, &()).unwrap().fitted.unwrap()
    };
    let carried = |fitted: &Fitted| {
        let all = fitted.warnings.iter().filter(|one| matches!(one, Warning::Carried { .. }));
        all.map(ToString::to_string).collect::<Vec<_>>()
    };
    for (study, part, handed) in [(HANDED, 0.3, true), (("fig5b", &[][..]), 0.5, false)] {
        for seed in 3..draws(4, 5) {
            let still = cell_on(study, seed, 300);
            let speed = super::recordings::mean_speed(&still);
            let found = fitted(still.drifting([part * speed, 0.0]), true);
            println!("{} {speed} {:?} {:?} {:?}", study.0, found.stage, carried(&found), found.symmetry());
            assert!(carried(&found).is_empty() && found.stage.len() == 1, "{:?}", found.warnings);
            let [x, y] = found.stage[0].map(|v| v / speed);
            assert!((x - part).abs() < 0.1 && y.abs() < 0.1, "{x} {y}");
            assert_eq!(found.is_handed(), handed);
        }
    }
    let still = cell_on(HANDED, 3, 300);
    let speed = super::recordings::mean_speed(&still);
    let mut back = still.clone();
    for outline in &mut back.cells[0].frames {
        let by = 0.3 * speed * (outline.t - 75.0).abs();
        outline.points.iter_mut().for_each(|point| point[0] += by);
    }
    let said = carried(&fitted(still.drifting([0.3 * speed, 0.0]), false)).concat();
    assert!(
        said.contains(") um/s does not turn") && said.ends_with("the correction 'drift' subtracts a drift"),
        "{said}"
    );
    let found = fitted(back, true);
    assert!(found.symmetry() == Symmetry::Undecided, "{:?}", found.doubts);
}
