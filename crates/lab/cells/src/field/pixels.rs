//! Outlines that follow pixels.

use motiform_tracks::Tracks;

/// Outlines that are looked at, spread over all of them.
const MOST: usize = 200;
/// Share of the steps along the outlines that are multiples of the pitch, and how near they must be to one, relative to it.
const SHARE: f64 = 0.98;
const NEAR: f64 = 1e-3;
/// Least pitch, relative to the radius sqrt(A/pi): finer grids are those of printed digits.
const LEAST: f64 = 0.01;

/// The pitch of the grid on which all vertices lie: the least step of a coordinate from vertex to vertex, where nearly all steps are
/// multiples of it.
pub(super) fn pitch(tracks: &Tracks) -> Option<f64> {
    let every = (tracks.outlines() / MOST).max(1);
    let outlines = || tracks.cells.iter().flat_map(|cell| &cell.frames).step_by(every);
    let steps: Vec<f64> = outlines()
        .flat_map(|outline| outline.points.windows(2))
        .flat_map(|pair| [0, 1].map(|k| (pair[1][k] - pair[0][k]).abs()))
        .collect();
    let size =
        outlines().flat_map(|outline| &outline.points).flatten().fold(0.0_f64, |size, x| size.max(x.abs()));
    // differences of round-off are no steps
    let clear = || steps.iter().copied().filter(move |step| *step > 1e-9 * size);
    let pitch = clear().fold(f64::INFINITY, f64::min);
    let multiples = clear().filter(move |step| (step / pitch - (step / pitch).round()).abs() < NEAR);
    let areas: f64 = outlines().map(|outline| motiform_tracks::area(&outline.points).abs()).sum();
    let radius = (areas / outlines().count().max(1) as f64 / std::f64::consts::PI).sqrt();
    let on_grid = multiples.count() as f64 >= SHARE * clear().count() as f64;
    (pitch.is_finite() && on_grid && pitch > LEAST * radius).then_some(pitch)
}
