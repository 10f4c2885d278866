//! Tests of the walks of all cells together, and their common walk.

use super::WalkNumbers;
use super::displacement::by_place;
use crate::Observation;
use motiform_dynamics::distributions::chi_square_tail;
use motiform_inference::{
    Bounded, Fix, Misfit, PValue, PersistentWalk, SPREAD_SCATTER, WalkTogether, walk_together,
};
use motiform_statistics::{Answer, Measured, four_digits};

/// The walks that describe their paths.
pub(super) fn described(found: &[Observation]) -> Vec<&PersistentWalk> {
    walks(found).filter(|walk| walk.describes()).collect()
}

fn walks(found: &[Observation]) -> impl Iterator<Item = &PersistentWalk> {
    found.iter().filter_map(|one| one.numbers.walk.as_ref())
}

/// The reason why neither a mean of the walks nor their common walk is stated.
pub(super) fn refused(found: &[Observation]) -> Option<String> {
    let described = described(found);
    let drift = found.iter().find_map(|one| one.numbers.drift.clone());
    drift
        .or_else(|| few_left(described.len(), walks(found).count() - described.len()))
        .or_else(|| turning_together(&described))
        .or_else(|| elsewhere(found))
        .or_else(|| no_walks(found))
        .or_else(|| leaving(found))
}

/// Tracks that end at the sides of the area of all places by chance, its extremes.
const EXTREMES: usize = 4;

/// The sentence that tracks end where cells leave the view, if they do: of the tracks that end before the last frame more end within a step
/// of the sides of the area of all places than places lie there (binomial). Those that keep their direction, or are fast, leave first.
pub(crate) fn leaving(found: &[Observation]) -> Option<String> {
    let fixes = |one: &Observation| one.numbers.places.pieces.iter().flatten().copied().collect::<Vec<Fix>>();
    let tracks: Vec<Vec<Fix>> = found.iter().map(fixes).filter(|track| track.len() > 1).collect();
    let all = || tracks.iter().flatten();
    let ends = |k: usize| {
        all().fold([f64::INFINITY, f64::NEG_INFINITY], |e, fix| [e[0].min(fix.at[k]), e[1].max(fix.at[k])])
    };
    let last = all().map(|fix| fix.t).fold(f64::NEG_INFINITY, f64::max);
    let steps = || tracks.iter().flat_map(|track| track.windows(2));
    let square = |pair: &[Fix]| (0..2).map(|k| (pair[1].at[k] - pair[0].at[k]).powi(2)).sum::<f64>();
    let step = (steps().map(square).sum::<f64>() / steps().count().max(1) as f64).sqrt();
    let sides = [ends(0), ends(1)];
    let at_side = |fix: &Fix| (0..2).any(|k| (fix.at[k] - sides[k][0]).min(sides[k][1] - fix.at[k]) < step);
    let early: Vec<&Fix> =
        tracks.iter().filter_map(|track| track.last()).filter(|end| end.t < last).collect();
    let count = early.iter().filter(|end| at_side(end)).count();
    let part = all().filter(|fix| at_side(fix)).count() as f64 / all().count().max(1) as f64;
    (early.len() >= FEWEST && tail(early.len(), count.saturating_sub(EXTREMES), part) < TOGETHER).then(|| {
        format!(
            "{count} of {} tracks that end early end at a side of the view: cells that keep their direction, or are fast, leave it first, \
             and what is left of a mean is that of the others; tracks of a length that no cell leaves in, or a wider view, are needed",
            early.len()
        )
    })
}

/// Probability of at least so many of `n` where each has this one.
fn tail(n: usize, least: usize, part: f64) -> f64 {
    let mut term = libm::pow(1.0 - part, n as f64);
    let mut below = 0.0;
    for k in 0..least {
        below += term;
        term *= (n - k) as f64 / (k + 1) as f64 * part / (1.0 - part);
    }
    1.0 - below
}

/// Largest ratio of the ends of an interval of the common walk.
const WIDEST: f64 = 4.0;

/// The common walk of all paths, whatever the order of the cells, or why there is none.
pub(super) fn walk(found: &[Observation]) -> Result<WalkTogether, String> {
    let cell = |one: &'_ Observation| Some((one.numbers.places.pieces.clone(), one.numbers.walk.clone()?));
    let mut cells: Vec<(Vec<Vec<Fix>>, PersistentWalk)> = found.iter().filter_map(cell).collect();
    let first = |pieces: &[Vec<Fix>]| pieces.first().map_or([0.0; 2], |piece| piece[0].at);
    cells.sort_by(|a, b| {
        a.1.tests.steps.cmp(&b.1.tests.steps).then_with(|| by_place(first(&a.0), first(&b.0)))
    });
    let cells: Vec<(&[Vec<Fix>], &PersistentWalk)> =
        cells.iter().map(|(pieces, walk)| (&pieces[..], walk)).collect();
    let found = walk_together(&cells)
        .ok_or("the paths do not tell persistence, speed and errors of the places apart, taken together")?;
    if found.p_value < TOGETHER {
        return Err(format!(
            "no one persistent random walk describes the paths of all cells together: changes of the velocity are not independent ({}); \
             cells may differ",
            PValue(found.p_value)
        ));
    }
    Ok(found)
}

/// The numbers of the common walk.
pub(super) fn stated(walk: &WalkTogether) -> WalkNumbers {
    let answer = |of: Bounded| {
        let interval = of.low.zip(of.high).map(<[f64; 2]>::from);
        match interval {
            Some([low, high]) if high <= WIDEST * low => {
                Answer::Known(Measured { value: of.value, interval })
            }
            _ => Answer::unknown("the paths hardly bound it, taken together: record more often, or longer"),
        }
    };
    WalkNumbers {
        persistence: answer(walk.persistence),
        speed: answer(walk.speed),
        diffusion: answer(walk.diffusion),
    }
}

/// The sentence that displacements from place to place are not those of walks with errors, taken together, if they are not: the score of
/// one cell ([`motiform_inference::WalkTests::diffusion_score`]) for all. Those that show it by themselves count.
pub(super) fn no_walks(found: &[Observation]) -> Option<String> {
    let meant =
        walks(found).filter(|walk| matches!(walk.misfit(), None | Some(Misfit::Diffuses | Misfit::Smoothed)));
    let scores: Vec<f64> = meant.map(|walk| walk.tests.diffusion_score).collect();
    let sum: f64 = scores.iter().sum();
    let p = chi_square_tail(sum * sum / scores.len() as f64, 1.0);
    (scores.len() >= FEWEST && p < TOGETHER).then(|| {
        format!(
            "of {} cells, taken together ({}), {}",
            scores.len(),
            PValue(p),
            if sum > 0.0 { Misfit::Diffuses } else { Misfit::Smoothed }
        )
    })
}

/// The sentence that most cells are no such walk, if so: the others may be those in which it does not show.
fn few_left(walks: usize, refused: usize) -> Option<String> {
    (refused > walks && walks > 0).then(|| {
        format!(
            "no persistent random walk describes the path of {refused} of {} cells; the others may be those in which that does not show",
            walks + refused
        )
    })
}

/// Significance of tests of all walks together.
const TOGETHER: f64 = 1e-3;
/// Fewest cells of these tests.
const FEWEST: usize = 8;

/// The sentence that walks turn one way, each for itself or all alike, although no single cell shows it, if they do.
fn turning_together(walks: &[&PersistentWalk]) -> Option<String> {
    let count = walks.len() as f64;
    let squares: f64 = walks.iter().map(|walk| walk.tests.turning_score * walk.tests.turning_score).sum();
    let sum: f64 = walks.iter().map(|walk| walk.tests.turning_score).sum();
    let p = chi_square_tail(squares, count).min(chi_square_tail(sum * sum / count, 1.0));
    (walks.len() >= FEWEST && p < TOGETHER).then(|| {
        format!(
            "of {} cells whose path alone is a persistent random walk the velocities keep turning one way, taken together ({}): \
             such cells diffuse less than these walks",
            walks.len(),
            PValue(p)
        )
    })
}

/// The ratio of mean-square displacements beyond which cells and their walks disagree, where their difference is significant.
const APART: f64 = 1.5;

/// The sentence that cells displace themselves by far less or more than their walks, over long times, if they do: the test of one cell
/// ([`motiform_inference::WalkTests::spread`]) for all together. Those that show it by themselves count.
fn elsewhere(found: &[Observation]) -> Option<String> {
    let walks = found.iter().filter_map(|one| one.numbers.walk.as_ref());
    let meant = walks.filter(|walk| matches!(walk.misfit(), None | Some(Misfit::Held | Misfit::Keeps)));
    let spreads: Vec<f64> = meant.map(|walk| walk.tests.spread).collect();
    let count = spreads.len() as f64;
    let mean = spreads.iter().sum::<f64>() / count;
    // a mean of positive numbers is skew: a gamma variable of the same variance
    let freedom = 2.0 * count / (SPREAD_SCATTER * SPREAD_SCATTER);
    let above = chi_square_tail(freedom * mean, freedom);
    let apart = above.min(1.0 - above) < 0.5 * TOGETHER && !(1.0 / APART..=APART).contains(&mean);
    (spreads.len() >= FEWEST && apart).then(|| {
        format!(
            "over long times the mean-square displacement of {} cells is {} times that of their walks: {}",
            spreads.len(),
            four_digits(mean),
            if mean < 1.0 { "they are held back, or come back" } else { "they keep a direction" }
        )
    })
}
