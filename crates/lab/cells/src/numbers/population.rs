//! Numbers over cells.

use super::places::Places;
use super::{WalkNumbers, Wobble, displacement, together};
use crate::{AtLag, Observation, OverCells, over_cells};
use motiform_dynamics::sample::{ascending, median};
use motiform_inference::{Bounded, PersistentWalk, WalkTogether};
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

/// Means over the cells of a recording, with their intervals.
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
pub fn population_numbers(found: &[Observation]) -> PopulationNumbers {
    let rows: Vec<_> = found.iter().map(|one| one.numbers.rows()).collect();
    let refused = together::refused(found);
    let walk = refused.is_none().then(|| together::walk(found).ok()).flatten();
    let withheld = withheld(found, refused.as_deref(), walk.is_some());
    let error = |walk: &&PersistentWalk| walk.error_variance.low.and(walk.error_variance.high);
    let walks = together::described(found).into_iter().filter(|walk| error(walk).is_some());
    let errors: Vec<f64> = walks.map(|walk| walk.error_variance.value).collect();
    let number = |place: usize| {
        let quantity = rows[0][place].quantity;
        let values: Vec<f64> = rows.iter().filter_map(|all| Some(all[place].value.known()?.value)).collect();
        let stated = withheld.iter().all(|other| !std::ptr::eq(other.quantity, quantity));
        let over = over_cells(&values)?;
        let other = unbiased(quantity, &values, walk.as_ref(), &errors);
        let over = other.map_or(over.clone(), |ends| over.holding(ends));
        Some(PopulationNumber { quantity, over }).filter(|_| stated)
    };
    let count = rows.first().map_or(0, Vec::len);
    let numbers = (0..count).filter_map(number).collect();
    let places = usual(found);
    PopulationNumbers {
        numbers,
        withheld,
        displacement: bare(displacement::of_cells(&places), together::leaving(found).is_some()),
        displacement_cells: places.len(),
    }
}

/// Points without intervals where they would be those of a selection of cells.
pub(crate) fn bare(mut points: Vec<AtLag>, is_selected: bool) -> Vec<AtLag> {
    points.iter_mut().filter(|_| is_selected).for_each(|at| at.value.interval = None);
    points
}

/// An interval without the bias of short records, which that of a mean over cells also holds: P and D of the walk of all paths together;
/// the root of the mean over cells of squares, of rms speeds and of errors of the places, whose variances may be below 0 by chance.
fn unbiased(
    quantity: &Quantity,
    values: &[f64],
    walk: Option<&WalkTogether>,
    errors: &[f64],
) -> Option<[f64; 2]> {
    let ends = |of: fn(&WalkTogether) -> Bounded| walk.map(of).and_then(|one| Some([one.low?, one.high?]));
    let root = |squares: &[f64]| Some(over_cells(squares)?.mean_interval?.map(|end| end.max(0.0).sqrt()));
    match quantity {
        one if std::ptr::eq(one, &cell::PERSISTENCE) => ends(|walk| walk.persistence),
        one if std::ptr::eq(one, &cell::DIFFUSION) => ends(|walk| walk.diffusion),
        one if std::ptr::eq(one, &cell::RMS_SPEED) => {
            root(&values.iter().map(|value| value * value).collect::<Vec<_>>())
        }
        one if std::ptr::eq(one, &cell::POSITION_ERROR) => root(errors),
        _ => None,
    }
}

/// The walk of these cells together, or why there is none: what refuses means of the walks refuses it.
pub(crate) fn walk_of_cells(found: &[Observation]) -> WalkNumbers {
    let walk = together::refused(found).map_or_else(|| together::walk(found), Err);
    walk.map_or_else(|reason| WalkNumbers::unknown(&reason), |walk| together::stated(&walk))
}

/// Numbers of the walk that too many cells only bound, or that single cells know too poorly.
fn withheld(found: &[Observation], refused: Option<&str>, has_common: bool) -> Vec<Withheld> {
    let walks = together::described(found);
    let no_walks = together::no_walks(found);
    // what moves the centroids is why their walks are refused
    let together = wobbling(found).or_else(|| refused.map(str::to_owned));
    let all = |of: fn(&PersistentWalk) -> Bounded| walks.iter().map(|walk| of(walk)).collect::<Vec<_>>();
    let widest = if has_common { WIDEST_BESIDE } else { WIDEST };
    let numbers =
        [(&cell::PERSISTENCE, all(|walk| walk.persistence)), (&cell::DIFFUSION, all(|walk| walk.diffusion))];
    let one = |(quantity, of_cells): (&'static Quantity, Vec<Bounded>)| {
        Some(Withheld { quantity, why: together.clone().or_else(|| why_biased(&of_cells, widest))? })
    };
    let mut all: Vec<Withheld> = numbers.into_iter().filter_map(one).collect();
    let unresolved = || {
        let open = walks.iter().filter(|walk| walk.persistence.low.is_none()).count();
        (open as f64 > MOST_UNRESOLVED * walks.len() as f64).then(|| {
            format!(
                "the frames do not resolve the persistence of {open} of {} cells, whose displacements do not tell motion from errors",
                walks.len()
            )
        })
    };
    let rms = no_walks.clone().or_else(unresolved).map(|why| Withheld { quantity: &cell::RMS_SPEED, why });
    let error = no_walks.map(|why| Withheld { quantity: &cell::POSITION_ERROR, why });
    all.extend(rms);
    all.extend(error.or_else(|| of_short_records(&walks)));
    all
}

/// Records with fewer steps than this have errors of places that are too small, by 1.5 over the steps: three numbers are fitted beside
/// them.
const SHORT: usize = 100;

/// The error of the places, where most records are short.
fn of_short_records(walks: &[&PersistentWalk]) -> Option<Withheld> {
    let usual =
        median(walks.iter().map(|walk| walk.tests.steps as f64)).filter(|&usual| usual < SHORT as f64)?;
    let why = format!(
        "estimates from {usual} steps (median) are too small by some percent, and a mean over cells keeps that; {SHORT} are needed"
    );
    Some(Withheld { quantity: &cell::POSITION_ERROR, why })
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

/// The reason why a mean of these numbers over cells is biased, if there is one.
fn why_biased(of_cells: &[Bounded], widest: f64) -> Option<String> {
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
    let span = median(spans).filter(|&span| span > widest)?;
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
/// Largest share of cells without a rms speed, for want of frames that resolve the persistence, where a mean of it is stated: it hardly
/// depends on which cells these are.
const MOST_UNRESOLVED: f64 = 0.25;
/// [`WIDEST`] where the interval of the mean also holds the walk of all paths together, which has no such bias.
const WIDEST_BESIDE: f64 = 5.0;

/// Places of the cells of the median sampling interval.
fn usual(found: &[Observation]) -> Vec<&Places> {
    let all = || found.iter().map(|one| &one.numbers.places).filter(|places| places.interval > 0.0);
    let mut intervals: Vec<f64> = all().map(|places| places.interval).collect();
    ascending(&mut intervals);
    let Some(usual) = intervals.get(intervals.len() / 2).copied() else { return Vec::new() };
    all().filter(|places| (places.interval / usual - 1.0).abs() < 1e-3).collect()
}
