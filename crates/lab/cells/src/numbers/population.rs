//! Numbers over cells.

use super::Wobble;
use super::displacement;
use super::places::Places;
use crate::{AtLag, Observation, OverCells, over_cells};
use motiform_dynamics::distributions::chi_square_tail;
use motiform_dynamics::sample::{ascending, median};
use motiform_inference::{Bounded, Misfit, PValue, PersistentWalk, SPREAD_SCATTER};
use motiform_statistics::four_digits;
use motiform_study::Quantity;
use motiform_study::quantity::cell;
use serde::{Serialize, Serializer};

/// A number over cells.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PopulationNumber {
    /// The number.
    #[serde(rename = "key", serialize_with = "by_name")]
    pub quantity: &'static Quantity,
    /// Over the cells that have it.
    #[serde(flatten)]
    pub over: OverCells,
}

fn by_name<S: Serializer>(quantity: &&'static Quantity, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(quantity.name)
}

/// A number of which no mean over cells is stated.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Withheld {
    /// The number.
    #[serde(rename = "key", serialize_with = "by_name")]
    pub quantity: &'static Quantity,
    /// The reason, in a sentence.
    pub why: String,
}

/// Numbers over cells.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PopulationNumbers {
    /// Each number over the cells that have it.
    pub numbers: Vec<PopulationNumber>,
    /// Numbers of the walk of which a mean over cells would be biased.
    pub withheld: Vec<Withheld>,
    /// Mean-square displacement over the cells of the usual sampling interval; intervals are those over cells, from 8 on.
    pub displacement: Vec<AtLag>,
    /// Cells in it.
    pub displacement_cells: usize,
}

/// Numbers over these cells.
#[must_use]
pub fn population_numbers(found: &[Observation]) -> PopulationNumbers {
    let rows: Vec<_> = found.iter().map(|one| one.numbers.rows()).collect();
    let withheld = withheld(found);
    let number = |place: usize| {
        let quantity = rows[0][place].quantity;
        let values: Vec<f64> = rows.iter().filter_map(|all| Some(all[place].value.known()?.value)).collect();
        let stated = withheld.iter().all(|other| !std::ptr::eq(other.quantity, quantity));
        Some(PopulationNumber { quantity, over: over_cells(&values)? }).filter(|_| stated)
    };
    let count = rows.first().map_or(0, Vec::len);
    let numbers = (0..count).filter_map(number).collect();
    let places = usual(found);
    PopulationNumbers {
        numbers,
        withheld,
        displacement: displacement::of_cells(&places),
        displacement_cells: places.len(),
    }
}

/// Numbers of the walk that too many cells only bound, or that single cells know too poorly.
fn withheld(found: &[Observation]) -> Vec<Withheld> {
    let described = |one: &&PersistentWalk| one.describes();
    let walks: Vec<&PersistentWalk> =
        found.iter().filter_map(|one| one.numbers.walk.as_ref().filter(described)).collect();
    let refused = found.iter().filter_map(|one| one.numbers.walk.as_ref()?.misfit()).count();
    let together =
        few_left(walks.len(), refused).or_else(|| turning_together(&walks)).or_else(|| elsewhere(found));
    let together = together.or_else(|| wobbling(found));
    let all = |of: fn(&PersistentWalk) -> Bounded| walks.iter().map(|walk| of(walk)).collect::<Vec<_>>();
    let numbers =
        [(&cell::PERSISTENCE, all(|walk| walk.persistence)), (&cell::DIFFUSION, all(|walk| walk.diffusion))];
    let one = |(quantity, of_cells): (&'static Quantity, Vec<Bounded>)| {
        Some(Withheld { quantity, why: together.clone().or_else(|| why_biased(&of_cells))? })
    };
    let mut all: Vec<Withheld> = numbers.into_iter().filter_map(one).collect();
    all.extend(of_short_records(&walks));
    all
}

/// Records with fewer steps than this have errors of places that are too small, by 1.5 over the steps: three numbers are fitted beside
/// them.
const SHORT: usize = 100;

/// The error of the places, where most records are short.
fn of_short_records(walks: &[&PersistentWalk]) -> Option<Withheld> {
    let usual = median(walks.iter().map(|walk| walk.steps as f64)).filter(|&usual| usual < SHORT as f64)?;
    let why = format!(
        "estimates from {usual} steps (median) are too small by some percent, and a mean over cells keeps that; {SHORT} are needed"
    );
    Some(Withheld { quantity: &cell::POSITION_ERROR, why })
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

/// The sentence that the centroids of most cells are moved by changes of their shapes, if they are.
fn wobbling(found: &[Observation]) -> Option<String> {
    let seen: Vec<Wobble> = found.iter().filter_map(|one| one.numbers.wobble).collect();
    let count = seen.iter().filter(|one| one.biases()).count();
    (2 * count > seen.len()).then(|| {
        format!(
            "changes of the shape move the centroids of {count} of {} cells beside the centre of the outline: the walk of the centroid is \
             less persistent than that of the cell as a whole; `fit` uses the centre",
            seen.len()
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
    let squares: f64 = walks.iter().map(|walk| walk.turning_score * walk.turning_score).sum();
    let sum: f64 = walks.iter().map(|walk| walk.turning_score).sum();
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

/// The ratio of mean-square displacements beyond which cells and their walks disagree, where their difference is so many standard errors.
const APART: f64 = 1.5;
const ERRORS: f64 = 4.0;

/// The sentence that cells displace themselves by far less or more than their walks, over long times, if they do: the test of one cell
/// ([`PersistentWalk::spread`]) for all together. Those that show it by themselves count.
fn elsewhere(found: &[Observation]) -> Option<String> {
    let walks = found.iter().filter_map(|one| one.numbers.walk.as_ref());
    let meant = walks.filter(|walk| matches!(walk.misfit(), None | Some(Misfit::Held | Misfit::Keeps)));
    let spreads: Vec<f64> = meant.map(|walk| walk.spread).collect();
    let count = spreads.len() as f64;
    let mean = spreads.iter().sum::<f64>() / count;
    let apart =
        (mean - 1.0).abs() > ERRORS * SPREAD_SCATTER / count.sqrt() && !(1.0 / APART..=APART).contains(&mean);
    (spreads.len() >= FEWEST && apart).then(|| {
        format!(
            "over long times the mean-square displacement of {} cells is {} times that of their walks: {}",
            spreads.len(),
            four_digits(mean),
            if mean < 1.0 { "they are held back, or come back" } else { "they keep a direction" }
        )
    })
}

/// The reason why a mean of these numbers over cells is biased, if there is one.
fn why_biased(of_cells: &[Bounded]) -> Option<String> {
    let spans: Vec<f64> = of_cells.iter().filter_map(|one| Some(one.high? / one.low?)).collect();
    let (cells, open) = (of_cells.len(), of_cells.len() - spans.len());
    if open as f64 > MOST_OPEN * cells as f64 {
        if cells == 1 {
            return Some(
                "the only cell whose path is a persistent random walk bounds it, without a value".to_owned(),
            );
        }
        let bound = if open == 1 { "bounds" } else { "bound" };
        return Some(format!(
            "of {cells} cells whose path is a persistent random walk, {open} only {bound} it, those that keep their direction \
             longest or shortest; a mean over the others would leave them out"
        ));
    }
    let span = median(spans).filter(|&span| span > WIDEST)?;
    Some(format!(
        "single cells know it within a factor of {} (median of the interval's upper over lower end): so poorly known values \
         are biased, and a mean over cells keeps the bias; longer records are needed",
        four_digits(span)
    ))
}

/// Largest share of cells that only bound a number of the walk, and largest ratio of the ends of a typical cell's interval, where a mean
/// over cells is stated. The estimate of highest likelihood is biased in the second order of its relative error.
const MOST_OPEN: f64 = 0.05;
const WIDEST: f64 = 2.5;

/// Places of the cells of the median sampling interval.
fn usual(found: &[Observation]) -> Vec<&Places> {
    let all = || found.iter().map(|one| &one.numbers.places).filter(|places| places.interval > 0.0);
    let mut intervals: Vec<f64> = all().map(|places| places.interval).collect();
    ascending(&mut intervals);
    let Some(usual) = intervals.get(intervals.len() / 2).copied() else { return Vec::new() };
    all().filter(|places| (places.interval / usual - 1.0).abs() < 1e-3).collect()
}
