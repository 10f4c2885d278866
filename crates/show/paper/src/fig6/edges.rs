//! The range of each motion, from the eigenvalues of the corresponding shapes.

use super::super::context::Context;
use super::branches::Branch;
use motiform_models::cell::{CellField, CellParameters};
use motiform_study::Error;

/// The lengths at which something changes. `None`: not within the examined lengths.
#[derive(Clone)]
pub(super) struct Edges {
    /// The largest growth rate, and k^2 there.
    pub(super) fastest: (f64, f64),
    /// Straight motion ends.
    pub(super) straight: Option<f64>,
    /// The same with twice as many modes.
    pub(super) straight_refined: Option<f64>,
    /// Leading eigenvalue of straight motion at the paper's edge, 12.0.
    pub(super) straight_growth: f64,
    /// Circular motion ends.
    pub(super) circular: Option<f64>,
    /// Leading eigenvalue of circular motion at 12.95, real and imaginary part.
    pub(super) circular_slow: (f64, f64),
    /// The cycle between two-fold shapes attracts from here ...
    pub(super) cycle: Option<f64>,
    /// ... to here, where the two-fold shape itself becomes stable ...
    pub(super) two_fold: Option<f64>,
    /// ... until here.
    pub(super) two_fold_end: Option<f64>,
    /// Growth rate lambda_+ of the two-fold shape at the paper's edge, 14.4.
    pub(super) leaving: f64,
    /// Growth rate of the two-fold shape at the paper's edge, 21.0.
    pub(super) second_leaving: f64,
    /// Circular motion of the second window.
    pub(super) second_circular: (Option<f64>, Option<f64>),
    /// Stable three-fold shapes.
    pub(super) three_fold: (Option<f64>, Option<f64>),
    /// Stable four-fold shapes begin.
    pub(super) four_fold: Option<f64>,
    /// Folds of the shapes at 16, 25 and 31.
    pub(super) folds: [usize; 3],
}

/// Lengths, and numbers of modes, at which the branches are entered.
const PLACES: [(f64, usize); 6] = [(9.0, 10), (12.6, 10), (16.0, 14), (22.2, 15), (25.0, 20), (31.0, 20)];

impl Edges {
    /// Follows all branches.
    pub(super) fn find(context: &Context<'_>) -> Result<Self, Error> {
        Ok(context.kept.once("edges of Fig. 6", || Self::followed(context))?.through(context))
    }

    /// On the way to the claims.
    fn through(self, context: &Context<'_>) -> Self {
        let one = |x: f64| context.number(x);
        let edge = |x: Option<f64>| x.map(one);
        let both = |(a, b): (f64, f64)| (one(a), one(b));
        let ends = |(a, b): (Option<f64>, Option<f64>)| (edge(a), edge(b));
        Self {
            fastest: both(self.fastest),
            straight: edge(self.straight),
            straight_refined: edge(self.straight_refined),
            straight_growth: one(self.straight_growth),
            circular: edge(self.circular),
            circular_slow: both(self.circular_slow),
            cycle: edge(self.cycle),
            two_fold: edge(self.two_fold),
            two_fold_end: edge(self.two_fold_end),
            leaving: one(self.leaving),
            second_leaving: one(self.second_leaving),
            second_circular: ends(self.second_circular),
            three_fold: ends(self.three_fold),
            four_fold: edge(self.four_fold),
            folds: self.folds,
        }
    }

    fn followed(context: &Context<'_>) -> Result<Self, Error> {
        let branches = Branch::all(context, &PLACES)?;
        let [straight, circular, two_fold, second, three_fold, four_fold] = &branches[..] else {
            return Err(Error::Interrupted);
        };
        let refined = straight.refined(20)?;
        let at_twelve = near(straight, 12.0)?;
        let saddle = near(two_fold, 14.0)?;
        let attracts = |branch: &Branch| {
            branch.edge(12.0, |cell, found| found.saddle(cell).is_some_and(|saddle| saddle.attracts()))
        };
        Ok(Self {
            fastest: fastest(),
            straight: straight.stable_until(15.0)?,
            straight_refined: refined.map(|branch| branch.stable_until(15.0)).transpose()?.flatten(),
            straight_growth: at_twelve.map_or(f64::NAN, |branch| branch.shape.growth()),
            circular: circular.stable_until(15.0)?,
            circular_slow: near(circular, 12.95)?
                .and_then(|branch| branch.shape.eigenvalues.first().copied())
                .unwrap_or((f64::NAN, f64::NAN)),
            cycle: saddle.as_ref().map(attracts).transpose()?.flatten(),
            two_fold: two_fold.stable_until(12.0)?,
            two_fold_end: two_fold.stable_until(24.0)?,
            leaving: near(two_fold, 14.4)?.map_or(f64::NAN, |branch| branch.shape.growth()),
            second_leaving: near(two_fold, 21.0)?.map_or(f64::NAN, |branch| branch.shape.growth()),
            second_circular: (second.stable_until(20.0)?, second.stable_until(25.0)?),
            three_fold: (three_fold.stable_until(20.0)?, three_fold.stable_until(32.0)?),
            four_fold: four_fold.stable_until(27.0)?,
            folds: [two_fold.folds()?, three_fold.folds()?, four_fold.folds()?],
        })
    }
}

/// The branch at a length further away, in small steps.
fn near(branch: &Branch, length: f64) -> Result<Option<Branch>, Error> {
    let count = ((length - branch.length).abs() / 0.1).ceil();
    let mut here = branch.at(branch.length)?;
    let mut done = 0.0;
    while let (Some(last), true) = (&here, done < count) {
        done += 1.0;
        here = last.at(branch.length + (length - branch.length) * done / count)?;
    }
    Ok(here)
}

/// The largest growth rate of mode 1 over all lengths, by golden-section search, and `k^2` there.
fn fastest() -> (f64, f64) {
    let golden = 0.5 * (5_f64.sqrt() - 1.0);
    let rate = |length: f64| rates(length, 1)[0];
    let (mut low, mut high) = (6.3, 20.0);
    while high - low > 1e-7 {
        let span = golden * (high - low);
        if rate(high - span) > rate(low + span) { high = low + span } else { low = high - span }
    }
    let k = std::f64::consts::TAU / (0.5 * (low + high));
    (rate(0.5 * (low + high)), k * k)
}

fn rates(length: f64, modes: usize) -> Vec<f64> {
    let parameters = CellParameters { length, ..CellParameters::default() };
    CellField::new(&parameters, modes).rates().to_vec()
}
