//! A cell seen by other cameras: turned images, and images from the other side.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::bodies::{cell_of, preset};
use motiform_cells::{CellFit, FitOptions, Sample, fit_cell};
use motiform_tracks::modes::ModeOptions;

/// The fit of the cell in images that are turned by an angle, and then mirrored.
fn seen(sample: &Sample, angle: f64, mirrored: bool) -> CellFit {
    let mut tracks = sample.tracks.clone();
    let (sin, cos) = libm::sincos(angle);
    let sign = if mirrored { -1.0 } else { 1.0 };
    for outline in &mut tracks.cells[0].frames {
        outline.points.iter_mut().for_each(|[x, y]| {
            (*x, *y) = (cos * *x - sin * *y, sign * (sin * *x + cos * *y));
        });
        if mirrored {
            outline.points.reverse(); // outlines run to the left
        }
    }
    let sample = Sample::of_tracks(tracks, &ModeOptions::default());
    let options = FitOptions { drift: false, draws: 20, simulations: 39, ..FitOptions::default() };
    fit_cell(&sample.cells[0], &options, &()).unwrap()
}

/// The motions of the drawn models, the intervals of all terms, and the statistics of simulated cells are the same to all of them.
#[test]
fn nothing_of_a_fit_depends_on_the_axes_of_the_images() {
    let sample = cell_of(&preset("fig5a", 0.01, (0.5, 250)), 1.2, 0.01);
    let first = seen(&sample, 0.0, false);
    let own = first.fitted.as_ref().unwrap();
    let statistics = |fit: &CellFit| -> Vec<f64> {
        let prediction = fit.prediction.as_ref().unwrap();
        prediction.comparisons.iter().map(|one| one.envelope.p_value).collect()
    };
    assert!(own.regime.as_ref().unwrap().draws >= 20 && statistics(&first).len() > 5);
    for (angle, mirrored) in [(0.7, false), (2.3, true)] {
        let other = seen(&sample, angle, mirrored);
        let fitted = other.fitted.as_ref().unwrap();
        let counts = [own, fitted].map(|fitted| fitted.regime.as_ref().unwrap().counts.clone());
        assert_eq!(counts[0], counts[1], "{angle} {mirrored}");
        for (a, b) in own.averaged.iter().zip(&fitted.averaged) {
            let width = a.interval[1] - a.interval[0];
            let apart = (0..2).map(|end| (a.interval[end] - b.interval[end]).abs()).fold(0.0, f64::max);
            assert!(a.name == b.name && apart < 0.01 * width, "{a:?} {b:?}");
        }
        for (a, b) in statistics(&first).into_iter().zip(statistics(&other)) {
            assert!((a - b).abs() < 1.5 / 40.0, "{a} {b}");
        }
    }
}
