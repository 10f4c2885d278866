//! The cells of a plane, with the motions found in each.

use motiform_analysis::{Course, Regime};
use motiform_study::quantity::motion;
use motiform_study::{AtlasPlan, Quantity};
use serde::{Deserialize, Serialize};

/// A motion found in a cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Its name.
    pub regime: Regime,
    /// Initial states that lead to it.
    pub rows: usize,
    /// The first one that does.
    pub sample: usize,
    /// Medians over those that do: mean speed, turning rate, period, largest Lyapunov exponent and its error; `None` where a number has no
    /// meaning.
    pub numbers: [Option<f64>; 5],
    /// Their directions, where the model tells directions apart.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub courses: Vec<Course>,
}

/// The numbers of [`Found::numbers`].
pub(crate) const NUMBERS: [&Quantity; 5] =
    [&motion::SPEED_MEAN, &motion::TURNING_RATE, &motion::PERIOD, &motion::LAMBDA_1, &motion::LAMBDA_1_ERROR];

/// A cell of the plane, with its motions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// Its motions, the most frequent first.
    pub motions: Vec<Found>,
    /// The computed cell that it was taken from, because all cells around have the same motions; `None` if it was computed itself.
    pub like: Option<usize>,
}

/// All cells, in the order of the scan: `cell = i1 + n1 i2`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Numbers of values across and upwards.
    pub size: [usize; 2],
    /// The cells.
    pub places: Vec<Place>,
}

impl Place {
    /// The motions by name, sorted, without those that are undetermined if others are known.
    pub fn label(&self) -> Vec<Regime> {
        let known = self.motions.iter().any(|found| found.regime != Regime::Undetermined);
        let counts =
            |regime: &Regime| self.motion(*regime).is_some() && !(known && *regime == Regime::Undetermined);
        Regime::ALL.into_iter().filter(counts).collect()
    }

    /// The motion of this name.
    pub fn motion(&self, regime: Regime) -> Option<&Found> {
        self.motions.iter().find(|found| found.regime == regime)
    }
}

/// The place of a motion in the order of legends.
pub(crate) fn rank(regime: Regime) -> usize {
    Regime::ALL.iter().position(|one| *one == regime).unwrap_or(Regime::ALL.len())
}

impl Grid {
    /// Column and row of a cell.
    pub fn place(&self, cell: usize) -> [usize; 2] {
        [cell % self.size[0], cell / self.size[0]]
    }

    /// The cell in a column and row.
    pub fn cell(&self, [column, row]: [usize; 2]) -> usize {
        column + self.size[0] * row
    }

    /// Number of cells that were computed.
    pub fn computed(&self) -> usize {
        self.places.iter().filter(|place| place.like.is_none()).count()
    }

    /// The motions of each cell. Few initial states miss a motion of a small basin now and then: it counts where most of the cells around
    /// have it beside one that the cell has. (Where they have no motion in common the cell is no part of their region.)
    pub fn labels(&self) -> Vec<Vec<Regime>> {
        let own: Vec<Vec<Regime>> = self.places.iter().map(Place::label).collect();
        let filled = |(cell, label): (usize, &Vec<Regime>)| {
            let around: Vec<usize> = self.around(cell).collect();
            let missed = |regime: &Regime| {
                let alike =
                    |near: &Vec<Regime>| near.contains(regime) && near.iter().any(|one| label.contains(one));
                let having = around.iter().filter(|near| alike(&own[**near])).count();
                *regime != Regime::Undetermined && 8 * having >= 6 * around.len().max(8)
            };
            let all = Regime::ALL.into_iter();
            all.filter(|regime| label.contains(regime) || missed(regime)).collect()
        };
        own.iter().enumerate().map(filled).collect()
    }

    /// The cells around a cell, diagonal ones included.
    fn around(&self, cell: usize) -> impl Iterator<Item = usize> {
        let [column, row] = self.place(cell);
        let near = |at: usize, most: usize| at.saturating_sub(1)..(at + 2).min(most);
        near(row, self.size[1])
            .flat_map(move |j| near(column, self.size[0]).map(move |i| [i, j]))
            .map(|place| self.cell(place))
            .filter(move |other| *other != cell)
    }

    /// A place in the plane in units of cells: 0 is the centre of the first one.
    pub(crate) fn units(&self, plan: &AtlasPlan, at: [f64; 2]) -> [f64; 2] {
        let plane = plan.plane();
        [0, 1].map(|side| {
            let last = (self.size[side].max(2) - 1) as f64;
            (at[side] - plane[side].from) / (plane[side].to - plane[side].from) * last
        })
    }
}
