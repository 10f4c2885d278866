//! Simulated cells beside the observed one: does the fitted model move like the cell?
//!
//! Cells are simulated by equations drawn from the estimate with the fitted noise, from where the observed one starts, and seen at the
//! same frames with errors of the same covariance: so the spread of the simulated cells holds that of the noise and the uncertainty of
//! the coefficients. The same statistics are taken of all of them, and a rank test says for each whether the observed cell could be one
//! of the simulated ones. Definitions: docs/cells.md, section 'Simulated cells'.

mod envelope;
mod record;
mod simulated;
mod statistics;

pub use envelope::{Agreement, Envelope};
pub use record::Record;
pub use statistics::{Axis, Kind, Statistic};

use crate::regime::MOST_LOST;
use crate::start;
use motiform_dynamics::Watch;
use motiform_inference::{Fit, Track, draws};
use serde::{Deserialize, Serialize};
use simulated::Simulator;

/// Simulated cells that are kept for drawing.
const SHOWN: usize = 3;
/// Simulated cells after which the comparison may end, and the most that may be asked for then: who asks for more wants all of them.
const EARLY: usize = 99;
const MOST_EARLY: usize = 199;
/// A p-value of them from which on that of twice as many is above .05, so that the statistic agrees.
const CLEAR: f64 = 0.12;

/// The number of simulated cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Companions {
    /// Most simulated cells: the least p-value is 1/(count + 1). Of at most 199 the first 99 are all where they leave no doubt.
    pub count: usize,
    /// Seed of their noise.
    pub seed: u64,
}

impl Default for Companions {
    fn default() -> Self {
        Self { count: 199, seed: 1 }
    }
}

/// A statistic of the observed cell among those of the simulated ones.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// The statistic.
    pub statistic: Statistic,
    /// Where it lies among the simulated ones, and the verdict.
    #[serde(flatten)]
    pub envelope: Envelope,
}

/// Statistics of cells simulated by the fitted model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Prediction {
    /// Simulated cells that count.
    pub cells: usize,
    /// Those that left all bounds: the equations with their noise, or others that the estimate allows, blow up.
    pub lost: usize,
    /// One comparison per statistic; empty if too many cells are lost.
    pub comparisons: Vec<Comparison>,
    /// Simulated records, as observed: for drawing.
    pub shown: Vec<Record>,
}

impl Prediction {
    /// `true` if too many simulated cells blow up for a comparison: the model does not describe the cell.
    pub fn is_unstable(&self) -> bool {
        self.lost as f64 > MOST_LOST * (self.cells + self.lost) as f64
    }

    /// Why the fit does not describe the cell, if so: simulated cells blow up, or a third of the statistics differ from those of the cell.
    pub fn contradiction(&self) -> Option<String> {
        if self.is_unstable() {
            return Some(
                "cells simulated by the fit, with its noise and its uncertainty, leave all bounds".to_owned(),
            );
        }
        let (differ, all) = (self.count(Agreement::Differs), self.comparisons.len());
        (3 * differ >= all && differ > 1).then(|| {
            format!("{differ} of {all} statistics of cells simulated by the fit, with its noise and its uncertainty, \
             differ from those of the cell")
        })
    }

    /// That the cell differs from simulated ones in more than one statistic, as a clause; `None` where that contradicts the fit, which says
    /// it.
    pub fn warning(&self) -> Option<String> {
        let differ = self.count(Agreement::Differs);
        (differ > 1 && self.contradiction().is_none()).then(|| {
            format!(
                "{differ} of {} statistics of the cell differ from those of simulated cells: the equations, or the \
                 noise, do not describe all of its motion",
                self.comparisons.len()
            )
        })
    }

    /// The number of statistics with this verdict.
    pub fn count(&self, agreement: Agreement) -> usize {
        self.comparisons.iter().filter(|one| one.envelope.agreement == agreement).count()
    }
}

/// Simulates cells by a fit and compares them with the track of the observed one; `None` if the watch stopped the work, or where there
/// are too few frames.
///
/// Of at most 199 cells no more than 99 are simulated where all their p-values are above .12: 12 of them are at least as far off as the
/// cell, so that p-values of 199 would be above .05, but for the change of the mean and the spread of the curves.
///
/// Source: Besag and Clifford (1991), Biometrika 78, 301 (sequential Monte Carlo p-values).
///
/// # Checked by  tests/all/prediction.rs: p-values of the true model are uniform; wrong models are found
pub fn predict(track: &Track, fit: &Fit, companions: Companions, watch: &dyn Watch) -> Option<Prediction> {
    let observed = Record::of(track, fit.library.modes)?;
    let asked = statistics::Asked::of(&observed, track);
    let (mut found, mut lost) = (Vec::new(), 0);
    let mut shown = Vec::new();
    let axes = start::axes(track, !fit.handed)?;
    let own = axes.track(track);
    let simulator = Simulator::new(fit, &own, &observed, companions.seed);
    let own = asked.all(&observed);
    for (number, drawn) in draws(fit, companions.count, companions.seed).into_iter().enumerate() {
        if watch.stopped() {
            return None;
        }
        if number == EARLY
            && companions.count <= MOST_EARLY
            && lost == 0
            && compared(&own, &found).iter().all(is_clear)
        {
            break;
        }
        match simulator.record(&drawn, number as u64 + 1) {
            Some(mut record) => {
                found.push(asked.all(&record));
                if shown.len() < SHOWN {
                    record.frames.iter_mut().flatten().for_each(|y| axes.into_images(y));
                    shown.push(record);
                }
            }
            None => lost += 1,
        }
    }
    let mut prediction = Prediction { cells: found.len(), lost, comparisons: Vec::new(), shown };
    if !prediction.is_unstable() {
        prediction.comparisons = compared(&own, &found);
    }
    Some(prediction)
}

/// Returns `true` if a statistic agrees, whatever cells show that are not simulated yet.
fn is_clear(one: &Comparison) -> bool {
    one.envelope.p_value > CLEAR
}

/// The statistics of a cell among those of simulated ones.
fn compared(own: &[Statistic], found: &[Vec<Statistic>]) -> Vec<Comparison> {
    let compare = |(place, statistic): (usize, &Statistic)| {
        let others: Vec<&[f64]> = found.iter().map(|all| all[place].values.as_slice()).collect();
        let there =
            |k: &usize| others.iter().all(|curve| curve[*k].is_finite()) && statistic.values[*k].is_finite();
        let places: Vec<usize> = (0..statistic.at.len()).filter(there).collect();
        let kept = |values: &[f64]| places.iter().map(|&k| values[k]).collect::<Vec<f64>>();
        let others: Vec<Vec<f64>> = others.into_iter().map(kept).collect();
        let others: Vec<&[f64]> = others.iter().map(Vec::as_slice).collect();
        let Statistic { kind, at, values } = statistic;
        let statistic = Statistic { kind: *kind, at: kept(at), values: kept(values) };
        let envelope = Envelope::of(&statistic.values, &others)?;
        Some(Comparison { statistic, envelope })
    };
    own.iter().enumerate().filter_map(compare).collect()
}
