//! Numbers of a cell without any model of its shape: path, speed, turning, displacement, persistence, form. From centroids and polygons
//! with gaps.
//!
//! Definitions: docs/cells.md, section 'Numbers without a model'.

mod displacement;
mod forms;
mod places;
mod population;
mod rows;
mod steps;
mod together;
mod walk;
mod wobble;

pub(crate) use displacement::{by_place, widened};
pub use forms::{FormNumber, Forms};
pub use motiform_inference::WalkTests;
pub use population::{PopulationNumber, PopulationNumbers, Withheld, population_numbers};
pub(crate) use population::{bare, walk_of_cells};
pub use rows::{Row, number_columns};
pub use steps::Steps;
pub(crate) use together::leaving;
pub use walk::{OfWalk, StatedWalk, WalkNumbers};
pub use wobble::Wobble;

use crate::{AtLag, CellTrack};
use motiform_analysis::short_series_mean;
use motiform_inference::{PersistentWalk, persistent_walk};
use motiform_statistics::{Measured, four_digits};
use places::Places;
use serde::Serialize;

/// Numbers of one cell; none is missing for want of frames but those that need two or three of them.
///
/// # Units   of the data
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Numbers {
    /// Frames whose outline is seen: place and form count, whether or not the radius is single valued.
    pub seen: usize,
    /// Times of the first and last of them; `None` without any.
    pub span: Option<[f64; 2]>,
    /// Pieces of the record between which the place or the area steps: no displacement is taken across.
    pub pieces: usize,
    /// Displacements from frame to frame; `None` where no two frames of a piece are seen.
    pub steps: Option<Steps>,
    /// Mean-square displacement; errors of the places are in it (4 sigma^2).
    pub displacement: Vec<AtLag>,
    /// The persistent random walk of highest likelihood, whether or not it describes the path; `None` with fewer than twelve displacements.
    #[serde(skip)]
    pub walk: Option<PersistentWalk>,
    /// The numbers of the walk that are stated, and why the others are not.
    #[serde(rename = "walk")]
    pub stated_walk: StatedWalk,
    /// Area, perimeter, and form.
    pub forms: Forms,
    /// The centroid beside the centre of the outline; `None` where few frames have both.
    pub wobble: Option<Wobble>,
    /// The reason why displacements are not those of one cell, and there is no number of a path; `None` of a sound record.
    pub mixed: Option<String>,
    /// The reason why the walk is not that of the cell alone, where all cells drift together or flow.
    #[serde(skip)]
    drift: Option<String>,
    #[serde(skip)]
    places: Places,
}

/// Numbers of a cell from the centroids and polygons of all frames that are seen.
///
/// # Checked by  tests/all/numbers.rs: walkers of known speed, persistence and diffusion; ellipses and rods; gaps, stage jumps, errors
pub fn numbers(cell: &CellTrack) -> Numbers {
    let places = Places::of(&cell.modes);
    let walk = persistent_walk(&places.pieces);
    let drift = cell.drift.map(|_| DRIFTS).or_else(|| cell.flows.then_some(FLOWS)).map(str::to_owned);
    let error = walk.as_ref().filter(|walk| walk.describes()).map(|walk| walk.error_variance);
    let times: Vec<f64> = cell.modes.frames.iter().filter(|one| one.is_seen()).map(|one| one.t).collect();
    let (seen, mixed) = (times.len(), cell.modes.mixed());
    let few = || if seen < 2 { rows::without_steps(seen) } else { walk::TOO_FEW.to_owned() };
    let without = mixed.clone().unwrap_or_else(few);
    Numbers {
        seen,
        span: times.first().zip(times.last()).map(|(first, last)| [*first, *last]),
        mixed,
        wobble: Wobble::of(&cell.modes),
        pieces: places.pieces.len(),
        steps: Steps::of(&places, error),
        displacement: displacement::of_cell(&places, walk.as_ref()),
        stated_walk: StatedWalk::of(walk.as_ref(), &without, drift.as_deref()),
        walk,
        forms: Forms::of(&cell.modes),
        drift,
        places,
    }
}

/// Why there is no walk of cells in a flow.
const FLOWS: &str = "velocities of the cells differ from place to place, which those of random walks do not";

/// Why there is no walk of cells on a stage that drifts.
const DRIFTS: &str = "all cells drift together, which no random walk does; the correction 'drift' subtracts it, if it is that of the stage";

impl Numbers {
    /// That changes of the shape move the centroid, of which speed and persistence are, in a sentence; `None` where they hardly do.
    pub fn remark(&self, length: &str) -> Option<String> {
        let found = self.wobble.filter(Wobble::biases)?;
        Some(format!(
            "changes of the shape move the centroid by {} {length} beside the centre of the outline, which makes {:.0} % of the changes \
             of its velocity: speeds are too large and persistence is too short for the cell as a whole; `fit` uses the centre",
            four_digits(found.size),
            100.0 * found.share
        ))
    }
}

/// The range of sizes.
const SIZE: [f64; 2] = [0.0, f64::INFINITY];

/// Mean of a series in time of a number between `least` and `most`, with an interval that ends there, from 16 samples on
/// ([`short_series_mean`]); `None` of nothing. Of a number with a least value alone the interval reaches up.
fn averaged(samples: &[f64], [least, most]: [f64; 2]) -> Option<Measured> {
    if samples.is_empty() {
        return None;
    }
    let value = samples.iter().sum::<f64>() / samples.len() as f64;
    let error = short_series_mean(samples).ok().map(|found| found.error);
    let grows = least.is_finite() && most.is_infinite();
    let up = |error| if grows { reaching_up(value - least, error) } else { error };
    let interval = error.map(|error| [(value - error).max(least), (value + up(error)).min(most)]);
    Some(Measured { value, interval })
}

/// The distance to the upper end, of a mean m above the least value whose error grows with it, as that of a speed does: where the true
/// mean is m (1 + r), the error of the estimate m is as much larger. The upper end is `m/(1 - r)`, r the relative error, and goes on as
/// its tangent, `4 m r`, from r = 1/2 on. With the same error to both sides means of few samples are too low more often than they should.
fn reaching_up(m: f64, error: f64) -> f64 {
    match error / m {
        _ if m <= 0.0 => error,
        r if r < 0.5 => error / (1.0 - r),
        r => m * (4.0 * r - 1.0),
    }
}
