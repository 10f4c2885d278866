//! A state that a cell had: where its equations begin.

use crate::own_axes::OwnAxes;
use motiform_inference::{Observation, Scales, Track};

/// Two frames whose displacement is the velocity of the first one: the frame at this place, and the first later one whose displacement
/// is clear, or the last.
pub(crate) fn pair(track: &Track, place: usize) -> Option<[&Observation; 2]> {
    let first = track.0.get(place)?;
    let later = track.0[place + 1..].iter().find(|frame| clear(first, frame)).or(track.0.last())?;
    (later.t > first.t).then_some([first, later])
}

/// The axes of the cell at the first frame of a track, along which it is simulated; `None` without two frames.
pub(crate) fn axes(track: &Track, mirrored: bool) -> Option<OwnAxes> {
    let [first, later] = pair(track, 0)?;
    let mut state = first.y.clone();
    (0..2).for_each(|k| state[k] = later.y[k] - first.y[k]);
    Some(OwnAxes::of(&state, mirrored))
}

/// Velocity and modes of a pair of frames, in natural units, as coordinates of the model.
pub(crate) fn coordinates([first, later]: [&[f64]; 2], by: f64, scales: &Scales) -> Vec<f64> {
    let sizes = &scales.amplitudes;
    let velocity = [0, 1].map(|k| (later[k] - first[k]) / by / sizes[0]);
    let shape = first.iter().enumerate().take(2 * sizes.len()).skip(2).map(|(i, y)| y / sizes[i / 2]);
    velocity.into_iter().chain(shape).collect()
}

/// The state in the middle of the longest track, where transients are over: coordinates of the model in natural units; `None` without
/// two frames. They are along the cell's own axes, so that the motion from there does not depend on those of the images: it moves to the
/// right (`mirrored`: and the imaginary part of its first mode is positive).
pub(crate) fn observed(tracks: &[Track], scales: &Scales, mirrored: bool) -> Option<Vec<f64>> {
    let track = tracks.iter().max_by_key(|track| track.0.len())?;
    let [first, later] = pair(track, track.0.len() / 2)?;
    let mut state = coordinates([&first.y, &later.y], later.t - first.t, scales);
    OwnAxes::of(&state, mirrored).into_own(&mut state);
    state[1] = 0.0; // without the round-off of the rotation
    Some(state)
}

/// `true` if the displacement is 5 times its error.
fn clear(a: &Observation, b: &Observation) -> bool {
    let variance = |frame: &Observation| 0.5 * (frame.covariance[0][0] + frame.covariance[1][1]);
    libm::hypot(b.y[0] - a.y[0], b.y[1] - a.y[1]) > 5.0 * (variance(a) + variance(b)).sqrt()
}
