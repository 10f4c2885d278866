//! The motion at each length: scans with as many modes as the length needs.

use super::super::context::Context;
use motiform_analysis::Regime;
use motiform_dynamics::sample::sort_by_number;
use motiform_lab::scan::{Axis, CellSummary};
use motiform_models::ModelInfo;
use motiform_study::{Error, Study};

/// A stretch of lengths, computed with the same number of modes: about `4 L / 2 pi` at its end, so that the shortest
/// wave has k = 4, where the spectrum has fallen to about 1e-8 of its top.
struct Stretch {
    modes: usize,
    /// From, to, spacing, in hundredths.
    full: &'static [(u32, u32, usize)],
    quick: &'static [f64],
}

const STRETCHES: [Stretch; 3] = [
    Stretch {
        modes: 10,
        full: &[(550, 1175, 25), (1200, 1500, 10)],
        quick: &[5.5, 6.0, 6.4, 7.5, 10.5, 12.2, 12.7, 13.4, 14.1],
    },
    Stretch {
        modes: 15,
        full: &[(1525, 2050, 25), (2070, 2090, 20), (2100, 2290, 10)],
        quick: &[15.2, 17.0, 20.6, 21.6, 22.0, 22.3, 22.8],
    },
    Stretch {
        modes: 20,
        full: &[(2300, 2875, 25), (2880, 3060, 10), (3080, 3100, 20)],
        quick: &[24.0, 28.8, 29.2, 29.8, 30.6, 31.0],
    },
];

/// Maximum model time for classifying one motion: in a full, and in a quick run.
const BUDGET: (f64, f64) = (3e4, 1.2e4);

/// A cell of this length.
pub(crate) fn study(length: f64, modes: usize) -> Result<Study, Error> {
    let mut study = Study::of_model(ModelInfo::find("cell")?);
    study.set("length", length)?;
    study.set("modes", modes as f64)?;
    Ok(study)
}

/// Enough modes for a length.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
pub(crate) fn modes_for(length: f64) -> usize {
    ((4.0 * length / std::f64::consts::TAU).ceil() as usize).max(8)
}

/// The motions of random starts, by length.
pub(super) struct Lengths(pub(super) Vec<(f64, CellSummary)>);

impl Lengths {
    /// Scans all lengths.
    pub(super) fn scan(context: &Context<'_>) -> Result<Self, Error> {
        let mut points = Vec::new();
        for stretch in &STRETCHES {
            let mut study = study(12.0, stretch.modes)?;
            let finely = || stretch.full.iter().flat_map(|&(from, to, by)| (from..=to).step_by(by));
            let values =
                context.choose(finely().map(|l| f64::from(l) / 100.0).collect(), stretch.quick.to_vec());
            study.scan.axes = vec![Axis { name: "length".to_owned(), values }];
            study.scan.samples = context.choose(2, 1);
            study.scan.budget = context.choose(BUDGET.0, BUDGET.1);
            let (plan, cells) = context.scan(&format!("fig6-{}-modes", stretch.modes), &study)?;
            points.extend(cells.into_iter().map(|cell| (plan.axis_values(cell.cell)[0], cell)));
        }
        sort_by_number(&mut points, |a| a.0);
        Ok(Self(points))
    }

    /// The points inside a range.
    pub(super) fn inside(&self, from: f64, to: f64) -> impl Iterator<Item = &(f64, CellSummary)> {
        self.0.iter().filter(move |point| point.0 > from && point.0 < to)
    }

    /// Returns `true` if every start inside a range leads to this motion, and the number of lengths there.
    pub(super) fn only(&self, regime: Regime, from: f64, to: f64) -> (bool, usize) {
        let alone = |point: &(f64, CellSummary)| point.1.motions.iter().all(|motion| motion.regime == regime);
        (self.inside(from, to).all(alone), self.inside(from, to).count())
    }
}
