//! Results over a population of cells: shares of names and numbers over cells. The units are whole cells, never frames.

use crate::{CellFit, Fitted, Observation};
use motiform_analysis::Share;
use motiform_dynamics::Normal;
use motiform_dynamics::distributions::student_factor;
use motiform_dynamics::sample::{ascending, mean, median, quantile};
use motiform_inference::{Coefficient, Fit, PValue, Pooled, pooled_fits};
use serde::Serialize;
use std::collections::BTreeMap;

/// Resamples of the cells.
const RESAMPLES: usize = 2000;
/// Seed of the resamples: the same cells give the same intervals.
const SEED: u64 = 1;
/// Fewest cells that give an interval.
const LEAST_CELLS: usize = 8;
/// The name of motions without a name.
const UNDECIDED: &str = "undecided";

/// A name and its share of the cells, with its 95 % interval (Wilson's).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NameShare {
    /// The motion, or `undecided`.
    pub name: &'static str,
    /// The number of cells, of how many, and the interval of the share.
    #[serde(flatten)]
    pub share: Share,
}

/// A number over cells.
///
/// Intervals are those of the 2.5 % and 97.5 % quantiles of 2000 resamples of whole cells with replacement, every other one of the
/// opposite ranks; none with fewer than 8 cells. Resampling `n` cells scatters by `sqrt((n - 1)/n)` too little, and as if that scatter were
/// known: the distances from the value are widened by the inverse, and by [`student_factor`] of n - 1 degrees of freedom.
///
/// Source: Efron (1979), Ann. Stat. 7, 1; the factors: Hesterberg (2015), Am. Stat. 69, 371 (expanded percentile interval).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OverCells {
    /// Cells that have the number.
    pub cells: usize,
    /// Mean over these cells.
    pub mean: f64,
    /// 95 % interval of the mean.
    pub mean_interval: Option<[f64; 2]>,
    /// Median over these cells.
    pub median: f64,
    /// 95 % interval of the median.
    pub median_interval: Option<[f64; 2]>,
}

impl OverCells {
    /// The same, the interval of the mean wide enough to hold another one.
    #[must_use]
    pub(crate) fn holding(self, [low, high]: [f64; 2]) -> Self {
        let mean_interval = self.mean_interval.map(|ends| [ends[0].min(low), ends[1].max(high)]);
        Self { mean_interval, ..self }
    }
}

/// A coefficient over cells. Where they follow one law within their errors the mean is that with the weights of their information
/// ([`pooled_fits`]); else it is the plain one, without an interval.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PopulationCoefficient {
    /// The term.
    pub term: String,
    /// `true` if this is the imaginary part of its coefficient, as handed cells have.
    pub imaginary: bool,
    /// Its coefficient over the cells, from the fits with all terms: no cell's value is 0 because its data did not ask for the term. Of
    /// handed cells, whose data reject those fits, from the models that describe them, for terms that all of these have.
    #[serde(flatten)]
    pub over: OverCells,
    /// The number of cells whose fit has the term.
    pub asked_for: usize,
}

/// A population of fitted cells.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedPopulation {
    /// Number of cells.
    pub cells: usize,
    /// Names and their shares, the most frequent first.
    pub regimes: Vec<NameShare>,
    /// The motion of the cells whose coefficients count: the most frequent name of a fit that converged with bounded coefficients; cells
    /// with other motions, or none, have other laws. `None` where no cell has a name.
    pub law: Option<&'static str>,
    /// `true` if these cells are handed; mirror-symmetric ones have another law.
    pub handed: bool,
    /// Cells whose coefficients count: fits with all terms (of handed cells: handed models) that converged and leave no coefficient
    /// unbounded, of this motion and of one set of modes.
    pub fitted: usize,
    /// Coefficients over these cells.
    pub coefficients: Vec<PopulationCoefficient>,
    /// The reason why their means have no intervals, with the remedy; `None` where they have them, and with fewer than 8 cells.
    pub no_intervals: Option<String>,
    /// Process noise of the velocity and of the shape over these cells.
    pub noise: Option<[OverCells; 2]>,
}

impl FittedPopulation {
    /// The fits whose coefficients are compared, in words.
    pub fn of_which_fits(&self) -> &'static str {
        match self.handed {
            true => "of the handed models, terms that all of them have",
            false => "of the fits with all terms",
        }
    }
}

impl PopulationCoefficient {
    /// The coefficient in words.
    pub fn name(&self) -> String {
        format!("{}{}", if self.imaginary { "imaginary part of " } else { "" }, self.term)
    }
}

/// A population of observed cells.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ObservedPopulation {
    /// Number of cells.
    pub cells: usize,
    /// Names and their shares, the most frequent first.
    pub regimes: Vec<NameShare>,
    /// Mean speed of each cell, over cells.
    pub speed: Option<OverCells>,
    /// Mean turning rate of each cell, over cells.
    pub turning: Option<OverCells>,
    /// Net displacement divided by the length of the path, over cells.
    pub directness: Option<OverCells>,
}

/// The names with their shares.
fn shares(names: impl Iterator<Item = &'static str>) -> Vec<NameShare> {
    let mut counts: Vec<(&'static str, usize)> = Vec::new();
    let mut all = 0;
    for name in names {
        all += 1;
        match counts.iter_mut().find(|entry| entry.0 == name) {
            Some(entry) => entry.1 += 1,
            None => counts.push((name, 1)),
        }
    }
    counts.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(b.0)));
    let share = |(name, count)| Some(NameShare { name, share: Share::new(count, all)? });
    counts.into_iter().filter_map(share).collect()
}

/// A number over cells, whatever their order; `None` without any.
pub fn over_cells(values: &[f64]) -> Option<OverCells> {
    let mut values = values.to_vec();
    ascending(&mut values);
    let values = &values[..];
    let (mean, median) = (mean(values.iter().copied())?, median(values.iter().copied())?);
    let [mean_interval, median_interval] = intervals(values, [mean, median]);
    Some(OverCells { cells: values.len(), mean, mean_interval, median, median_interval })
}

/// Intervals of mean and median.
fn intervals(values: &[f64], estimates: [f64; 2]) -> [Option<[f64; 2]>; 2] {
    let n = values.len();
    if n < LEAST_CELLS {
        return [None, None];
    }
    let mut random = Normal::new(SEED, 0);
    let mut places = vec![0; n];
    let mut found = [Vec::with_capacity(RESAMPLES), Vec::with_capacity(RESAMPLES)];
    for _ in 0..RESAMPLES / 2 {
        places.fill_with(|| ((random.uniform() * n as f64) as usize).min(n - 1));
        // with each resample that of the opposite ranks: mirrored values have mirrored intervals
        for mirrored in [false, true] {
            let drawn = || places.iter().map(|&k| values[if mirrored { n - 1 - k } else { k }]);
            found[0].extend(mean(drawn()));
            found[1].extend(median(drawn()));
        }
    }
    let wider = (n as f64 / (n - 1) as f64).sqrt() * student_factor(n - 1);
    // a length is not negative, and neither is the end of its interval
    let least = if values.iter().all(|&value| value >= 0.0) { 0.0 } else { f64::NEG_INFINITY };
    [0, 1].map(|which| {
        ascending(&mut found[which]);
        let value = estimates[which];
        let end = |share| Some((value + wider * (quantile(&found[which], share)? - value)).max(least));
        Some([end(0.025)?, end(0.975)?])
    })
}

/// The most frequent of these, the first in order of equally frequent ones.
fn most_frequent<T: Ord>(all: impl Iterator<Item = T>) -> Option<T> {
    let mut counts: BTreeMap<T, usize> = BTreeMap::new();
    all.for_each(|one| *counts.entry(one).or_default() += 1);
    let most = counts.values().copied().max()?;
    counts.into_iter().find(|(_, count)| *count == most).map(|(one, _)| one)
}

/// Results over fitted cells.
///
/// # Checked by  `tests/all/population.rs`: coverage of the intervals, shares
pub fn fitted_population(fits: &[CellFit]) -> FittedPopulation {
    let name = |fit: &CellFit| fit.fitted.as_ref().map_or(UNDECIDED, |fitted| fitted.motion_name());
    let counts = |fitted: &&Fitted| compared(fitted).converged() && compared(fitted).is_bounded();
    let sound = || fits.iter().filter_map(|fit| fit.fitted.as_deref().ok()).filter(counts);
    let law = |of: &Fitted| (of.motion_name(), of.model().library.modes, of.is_handed());
    let frequent = most_frequent(sound().map(law).filter(|(name, ..)| *name != UNDECIDED));
    let usable: Vec<&Fitted> = sound().filter(|fitted| Some(law(fitted)) == frequent).collect();
    let (together, no_intervals) = common(&usable);
    let coefficient = |(place, c): (usize, &Coefficient)| {
        let same = |other: &&Coefficient| (&other.name, other.imaginary) == (&c.name, c.imaginary);
        let has = |fit: &Fit| fit.coefficients.iter().find(same).map(|c| c.estimate.value);
        let values: Vec<f64> = usable.iter().filter_map(|of| has(compared(of))).collect();
        let asked_for = usable.iter().filter(|of| has(of.model()).is_some()).count();
        let plain = over_cells(&values).filter(|over| over.cells == usable.len())?;
        let bare = OverCells { mean_interval: None, median_interval: None, ..plain };
        let over = match &together {
            Some(found) => {
                OverCells { mean: found.values[place], mean_interval: Some(found.intervals[place]), ..bare }
            }
            None => bare,
        };
        Some(PopulationCoefficient { over, term: c.name.clone(), imaginary: c.imaginary, asked_for })
    };
    let noise = |of: &dyn Fn(&Fit) -> f64| {
        over_cells(&usable.iter().map(|one| of(compared(one))).collect::<Vec<_>>())
    };
    let velocity = noise(&|fit| fit.noise.eta_v.value);
    let shape = noise(&|fit| fit.noise.eta_shape.value);
    let first = usable.first().map_or(&[][..], |fitted| &compared(fitted).coefficients);
    FittedPopulation {
        cells: fits.len(),
        regimes: shares(fits.iter().map(name)),
        law: frequent.map(|(name, ..)| name),
        handed: frequent.is_some_and(|(.., handed)| handed),
        fitted: usable.len(),
        coefficients: first.iter().enumerate().filter_map(coefficient).collect(),
        no_intervals,
        noise: velocity.zip(shape).map(|(velocity, shape)| [velocity, shape]),
    }
}

/// Probability below which cells differ.
const DIFFER: f64 = 0.01;

/// The coefficients that cells of one law have in common, or why there is no interval of a plain mean over them: estimates from single
/// records are biased by a part of their errors, and a mean over many cells keeps that, while its interval shrinks.
fn common(usable: &[&Fitted]) -> (Option<Pooled>, Option<String>) {
    if usable.len() < LEAST_CELLS {
        return (None, None);
    }
    let bias = "estimates from single records are biased by a part of their errors, which a mean over cells keeps; a fit of all \
                cells together has one set of coefficients, with errors that count the differences between cells";
    let fits: Vec<&Fit> = usable.iter().map(|one| compared(one)).collect();
    match pooled_fits(&fits) {
        Some(found) if found.p_value >= DIFFER => (Some(found), None),
        Some(found) => (
            None,
            Some(format!("cells differ by more than their errors ({}), and {bias}", PValue(found.p_value))),
        ),
        None => (
            None,
            Some(format!(
                "the fits of these cells have different terms, or errors without a bound, and {bias}"
            )),
        ),
    }
}

/// The fit whose coefficients are compared with those of other cells: that with all terms, in which none is 0 because the data did not ask
/// for it; of a handed cell, whose data reject it, the model that describes the cell.
fn compared(fitted: &Fitted) -> &Fit {
    if fitted.is_handed() { fitted.model() } else { &fitted.whole }
}

/// Results over observed cells.
pub fn observed_population(found: &[Observation]) -> ObservedPopulation {
    let name = |one: &Observation| one.motion.regime.map_or(UNDECIDED, |regime| regime.name());
    let measured = || found.iter().filter_map(|one| one.measures.as_ref());
    ObservedPopulation {
        cells: found.len(),
        regimes: shares(found.iter().map(name)),
        speed: over_cells(&measured().map(|of| of.speed).collect::<Vec<_>>()),
        turning: over_cells(&measured().map(|of| of.turning).collect::<Vec<_>>()),
        directness: over_cells(&measured().map(|of| of.directness).collect::<Vec<_>>()),
    }
}
