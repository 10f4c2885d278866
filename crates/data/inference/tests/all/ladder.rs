//! Models compared by frames that their fits did not see.

use crate::common::{Equations, Experiment, full};
use motiform_dynamics::Complex;
use motiform_inference::{Error, Ladder, LadderModel, Rung, Settings, Track, fit, ladder};
use std::sync::LazyLock;

fn of(tracks: &[Track]) -> Ladder {
    let whole = fit(tracks, &Settings::default(), &()).expect("a fit");
    let found = ladder(tracks, &whole, &()).expect("a ladder");
    for rung in &found.rungs {
        let Rung { model, coefficients, gain, behind, error } = rung;
        println!("{:55} {coefficients:3} {gain:.4?} {behind:.1?} +- {error:.1?}", model.words());
    }
    found
}

fn experiment(equations: Equations, eta: f64, frames: usize, seed: u64) -> Experiment {
    Experiment { frames, ..Experiment::new(equations, eta, seed) }
}

fn is_as_good(found: &Ladder, model: LadderModel) -> bool {
    found.rungs.iter().find(|rung| rung.model == model).is_some_and(Rung::is_as_good)
}

/// Chaos by z1, z2 and z3, and its ladder: several tests look at it. In 300 frames a walk is 1,640 behind, with an error of 60.
static CHAOS: LazyLock<(Track, Ladder)> = LazyLock::new(|| {
    let track = chaos().track();
    let found = of(std::slice::from_ref(&track));
    (track, found)
});

fn chaos() -> Experiment {
    experiment(full(0.5, 0.1), 0.02, 300, 31)
}

/// Velocities that decay and shapes that fluctuate by themselves: the walk is enough, and 22 terms predict worse.
#[test]
fn a_walk_needs_no_more_than_a_walk() {
    let term = |equation, c: f64, factors: &[i32]| (equation, Complex::new(c, 0.0), factors.to_vec());
    let walk = vec![term(1, -0.1, &[1]), term(2, -0.5, &[2]), term(3, -0.7, &[3])];
    let found = of(&[experiment(walk, 0.2, 300, 910).track()]);
    assert_eq!(found.simplest().map(|rung| rung.model), Some(LadderModel::PassiveWalk));
    let all = found.rungs.iter().find(|rung| rung.model == LadderModel::ThreeModes).expect("a rung");
    assert!(all.gain.is_some_and(|gain| gain < 0.0), "{all:?}");
    assert_eq!((found.blocks, found.rungs[0].gain), (5, Some(0.0)));
}

/// No walk and no two modes predict it, the terms that the data ask for do.
#[test]
fn a_motion_of_three_modes_needs_them() {
    let (track, found) = &*CHAOS;
    // the mirror changes nothing
    for (one, other) in found.rungs.iter().zip(&of(&[track.mirrored()]).rungs) {
        let apart = one.behind.zip(other.behind).map(|(a, b)| (a - b).abs());
        assert!(
            one.coefficients == other.coefficients && apart.is_some_and(|off| off < 0.05),
            "{one:?} {other:?}"
        );
    }
    assert_eq!(found.simplest().map(|rung| rung.model), Some(LadderModel::Selected));
    for model in [LadderModel::PassiveWalk, LadderModel::PolarWalk, LadderModel::Speed, LadderModel::TwoModes]
    {
        assert!(!is_as_good(found, model), "{model:?}");
    }
    // their number over the fits is that of the law
    let selected = found.rungs.iter().find(|rung| rung.model == LadderModel::Selected).expect("a rung");
    assert!((8..=11).contains(&selected.coefficients), "{selected:?}");
}

/// A velocity that turns to one side: real coefficients predict worse.
#[test]
fn a_handed_motion_needs_complex_coefficients() {
    let mut handed = experiment(full(0.5, 0.1), 0.02, 300, 5);
    handed.equations[0].1 = Complex::new(1.0, 0.15);
    let found = of(&[handed.track()]);
    assert_eq!(found.best().map(|rung| rung.model), Some(LadderModel::Handed));
    assert!(!is_as_good(&found, LadderModel::Selected) && !is_as_good(&found, LadderModel::ThreeModes));
}

/// The same chaos on a stage that drifts by a tenth of the speed: laws that turn with the cell predict worse; without a drift they do not.
#[test]
fn a_stage_that_drifts_is_told_from_the_cell() {
    let (track, still) = &*CHAOS;
    assert!(is_as_good(still, LadderModel::Selected));
    let found = of(&[track.without_velocity([-0.08, 0.04])]);
    assert_eq!(found.best().map(|rung| rung.model), Some(LadderModel::Drifting));
    assert!(!is_as_good(&found, LadderModel::Selected) && !is_as_good(&found, LadderModel::ThreeModes));
}

/// The same chaos with noise of the velocity that forgets in two model times: white noise predicts worse. With white noise a memory does
/// not predict better.
#[test]
fn noise_with_a_memory_is_told_from_white_noise() {
    let coloured = Experiment { eta: [0.06, 0.01], memory: 0.5, ..chaos() };
    let found = of(&[coloured.track()]);
    assert_eq!(found.best().map(|rung| rung.model), Some(LadderModel::Coloured));
    assert!(!is_as_good(&found, LadderModel::Selected) && !is_as_good(&found, LadderModel::ThreeModes));
    let white = &CHAOS.1;
    assert!(
        is_as_good(white, LadderModel::Selected) && is_as_good(white, LadderModel::Coloured),
        "{white:?}"
    );
}

/// Two modes of a record that is seen: the ladder has no third one. Records that are too short to be cut are refused.
#[test]
fn the_ladder_has_the_modes_of_the_fit_and_records_of_forty_frames() {
    let track = experiment(full(1.5, 0.9), 0.02, 60, 3).track();
    let library = motiform_inference::Library::new(2, 3).expect("a library");
    let settings = Settings { library, ..Settings::default() };
    let tracks = [track];
    let whole = fit(&tracks, &settings, &()).expect("a fit");
    let found = ladder(&tracks, &whole, &()).expect("a ladder");
    let models: Vec<LadderModel> = found.rungs.iter().map(|rung| rung.model).collect();
    assert!(
        models.contains(&LadderModel::TwoModes)
            && !models.contains(&LadderModel::ThreeModes)
            && models.contains(&LadderModel::Coloured),
        "{models:?}"
    );
    let short = [Track(tracks[0].0[..39].to_vec())];
    assert!(matches!(ladder(&short, &whole, &()), Err(Error::TooShort { frames: 39, least: 40, .. })));
}
