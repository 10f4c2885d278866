//! The centroid of the area beside the centre of the outline.

use motiform_tracks::modes::{CellModes, Flag, FrameModes};
use serde::Serialize;

/// Largest share of the changes of velocity, and largest memory from frame to frame, of a centroid that stands for the centre.
const MOST: f64 = 0.2;
/// Fewest changes of velocity.
const LEAST: usize = 20;

/// The motion of the centroid beside the centre of the outline, by changes of the shape.
///
/// # Units   of the data
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Wobble {
    /// Root mean square distance of both.
    pub size: f64,
    /// Share of the changes of the centroid's velocity from frame to frame that go with it, the square of their correlation: 0 where the
    /// path of the centroid does not depend on the distance of the centre from it.
    pub share: f64,
    /// Correlation of the displacement from the centre with that a frame later: errors of outlines have none.
    pub memory: f64,
}

impl Wobble {
    /// Over frames in a row that have both; `None` with fewer than 20 changes of velocity.
    pub(super) fn of(modes: &CellModes) -> Option<Self> {
        let beside = |frame: &FrameModes| {
            let centre = frame.radius.as_ref().filter(|_| frame.is_seen())?.centre;
            Some([0, 1].map(|k| frame.centroid[k] - centre[k]))
        };
        let (mut count, mut sums) = (0, [0.0; 5]);
        for three in modes.frames.windows(3) {
            let even = three[2].frame - three[1].frame == three[1].frame - three[0].frame;
            let parted = three[1..].iter().any(|frame| frame.flags.iter().any(Flag::parts));
            let [Some(a), Some(b), Some(c)] = [0, 1, 2].map(|k| beside(&three[k])) else { continue };
            if parted || !even {
                continue;
            }
            count += 1;
            for k in 0..2 {
                let place = |frame: usize| three[frame].centroid[k];
                let change = place(2) - 2.0 * place(1) + place(0);
                let own = c[k] - 2.0 * b[k] + a[k];
                let here = [own * own, change * change, own * change, a[k] * b[k], a[k] * a[k]];
                sums.iter_mut().zip(here).for_each(|(sum, value)| *sum += value);
            }
        }
        let [own, all, both, product, square] = sums;
        let share = both.max(0.0) * both / (own * all);
        let found = Self { size: (square / count as f64).sqrt(), share, memory: product / square };
        (count >= LEAST && own > 0.0 && all > 0.0).then_some(found)
    }

    /// `true` if changes of the shape move the centroid so much, and with a memory, that a walk of it is another one than that of the
    /// centre.
    pub fn biases(&self) -> bool {
        self.share > MOST && self.memory > MOST
    }
}
