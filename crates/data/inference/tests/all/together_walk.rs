//! Additional diffusion, means over exposures, and the common walk of many cells, on processes of known numbers.

use super::walk::{found, walk};
use crate::samples::draws;
use motiform_dynamics::Normal;
use motiform_inference::{Bounded, Fix, Misfit, PersistentWalk, WalkTogether, walk_together};

const TRUTH: [f64; 3] = [2.0, 1.0, 0.0];

/// Places that are means over the whole time between frames.
fn exposed(truth: [f64; 3], frames: u32, seed: u64) -> Vec<Fix> {
    let fine = walk(truth, (0.1, 10 * frames), 1.0, seed);
    let mean = |ten: &[Fix]| {
        let at = [0, 1].map(|k| ten.iter().map(|fix| fix.at[k]).sum::<f64>() / ten.len() as f64);
        Fix { t: ten[0].t, at }
    };
    fine.chunks(10).map(mean).collect()
}

/// The walk with additional diffusion of this coefficient.
fn diffusing(coefficient: f64, frames: u32, seed: u64) -> Vec<Fix> {
    let mut normal = Normal::new(seed, 5);
    let mut at = [0.0; 2];
    let mut fixes = walk([5.0, 1.0, 0.0], (1.0, frames), 1.0, seed);
    for fix in &mut fixes {
        for k in 0..2 {
            fix.at[k] += at[k];
            at[k] += (2.0 * coefficient).sqrt() * normal.next();
        }
    }
    fixes
}

fn holds(of: Bounded, value: f64) -> bool {
    of.low.is_none_or(|low| low <= value) && of.high.is_none_or(|high| value <= high)
}

fn together(cells: &[Vec<Fix>]) -> Option<WalkTogether> {
    let pieces: Vec<[Vec<Fix>; 1]> = cells.iter().map(|cell| [cell.clone()]).collect();
    let walks: Vec<PersistentWalk> = cells.iter().map(|cell| found(cell)).collect();
    let cells: Vec<_> = pieces.iter().map(|one| &one[..]).zip(&walks).collect();
    walk_together(&cells)
}

/// Means over the whole exposure: the persistence is that of the walk. With errors of 0 at least it was 1.4 times as long, and held in none
/// of ten.
#[test]
fn exposures_do_not_lengthen_the_persistence() {
    let runs = draws(20, 100);
    let (mut held, mut mean) = (0, 0.0);
    for seed in 0..runs {
        let one = found(&exposed(TRUTH, 200, seed));
        held += u64::from(holds(one.persistence, TRUTH[0]));
        mean += libm::log(one.persistence.value / TRUTH[0]) / runs as f64;
    }
    println!("held {held} of {runs}, mean of the logarithm {mean}");
    // a persistence 1.1 times as long remains, half of its error
    assert!(held >= draws(16, 85) && mean < 0.22, "{held} {mean}");
}

/// Additional diffusion is seen, or the intervals allow for it: those of P that are given contain the true value. Without this they did in
/// a quarter.
#[test]
fn additional_diffusion_is_seen_or_allowed_for() {
    let runs = draws(40, 200);
    let (mut seen, mut held, mut given) = (0, 0, 0);
    for seed in 0..runs {
        let one = found(&diffusing(0.2, 200, seed));
        if one.describes() {
            given += 1;
            held += u64::from(holds(one.persistence, 5.0));
        }
        seen += u64::from(one.misfit() == Some(Misfit::Diffuses));
    }
    println!("seen in {seen} of {runs}, held in {held} of {given}");
    assert!(5 * seen > runs && 10 * held >= 7 * given, "{seen} {held} {given}");
    let free = (0..runs).filter(|&seed| {
        let misfit = found(&diffusing(0.0, 200, seed)).misfit();
        matches!(misfit, Some(Misfit::Diffuses | Misfit::Smoothed))
    });
    assert!(free.count() as u64 <= draws(5, 14));
}

/// Intervals of the common walk over cells of very different lengths, and of equal ones; additional diffusion is seen there.
#[test]
fn one_walk_of_many_cells() {
    let truth = [3.0, 1.0, 0.1];
    for (lengths, least) in
        [([60; 12], draws(21, 180)), ([15, 15, 15, 30, 30, 30, 60, 60, 60, 300, 300, 300], draws(20, 175))]
    {
        let runs = draws(25, 200);
        let mut held = [0; 3];
        for seed in 0..runs {
            let cell =
                |(k, frames): (usize, &u32)| walk(truth, (1.0, *frames), 1.0, 5000 + 20 * seed + k as u64);
            let cells: Vec<Vec<Fix>> = lengths.iter().enumerate().map(cell).collect();
            let Some(one) = together(&cells) else { continue };
            let all = [(one.persistence, truth[0]), (one.speed, truth[1]), (one.diffusion, 1.5)];
            held.iter_mut().zip(all).for_each(|(count, (of, value))| *count += u64::from(holds(of, value)));
        }
        println!("{lengths:?}: held {held:?} of {runs}");
        assert!(held.iter().all(|&count| count >= least), "{held:?}");
    }
    let cells: Vec<Vec<Fix>> =
        (0..20).map(|seed| walk([0.01, 10.0, 0.0], (1.0, 200), 1.0, 60 + seed)).collect();
    let one = together(&cells).expect("a walk");
    assert!(
        one.persistence.low.is_none() && one.speed.high.is_none() && holds(one.diffusion, 0.5),
        "{one:?}"
    );
    let cells: Vec<Vec<Fix>> = (0..20).map(|seed| diffusing(0.2, 200, 40 + seed)).collect();
    let one = together(&cells).expect("a walk");
    assert!(one.diffusion_score > 3.3, "{one:?}");
}
