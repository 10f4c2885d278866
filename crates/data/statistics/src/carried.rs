//! A velocity that all bodies have in common.

use crate::jackknife::Sums;
use crate::{Measured, Quantity, Tracks, with_error};

/// Half widths of its 95 % interval that a mean velocity exceeds: five standard errors.
const CLEAR: f64 = 2.5;

/// The reason why the statistics of displacements are not those of a walk, where all bodies together have a mean velocity that is clear of
/// its errors: a drift, or a direction that they keep. `None` with fewer bodies than have errors over bodies: one body alone keeps its
/// direction for a while.
///
/// # Checked by  tests/all/diffusion.rs: an Ornstein-Uhlenbeck process with a mean velocity, and without
pub(crate) fn carried(tracks: &Tracks) -> Option<String> {
    if tracks.bodies().len() < tracks.groups() {
        return None;
    }
    let [x, y] = [0, 1].map(|component| mean(tracks, component));
    let clear = |mean: &Measured| mean.interval.is_some() && mean.value.abs() > CLEAR * mean.half_width();
    (clear(&x) || clear(&y)).then(|| {
        let [x, y] = [x, y].map(|mean| with_error(mean.value, mean.half_width()));
        format!(
            "all bodies together move with the velocity ({x}, {y}): a drift, or a direction that they keep. Displacements and correlations \
             are those of both, and no longer record changes that"
        )
    })
}

/// The mean of a component of the velocity, over all bodies.
fn mean(tracks: &Tracks, component: usize) -> Measured {
    let mut sums = Sums::new(tracks.groups());
    for (unit, track) in tracks.units().iter().enumerate() {
        let series = Quantity::Velocity.of(track);
        let there = series.components[component].iter().sum();
        sums.add(tracks.group(unit), there, series.count());
    }
    sums.measured()
}
