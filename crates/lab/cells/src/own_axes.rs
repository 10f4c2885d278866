//! The axes of a cell itself: numbers that are computed along them do not depend on how the camera was turned, nor on whether it looked
//! from above or from below.

use motiform_inference::{Observation, Track};

/// Axes along which a state of the cell moves to the right. A vector `(x, y, Re z2, Im z2, ..)` is turned by
/// `x + i y -> (x + i y) e^{-i angle}`, `z_n -> z_n e^{i n angle}`, and then mirrored, if this is asked for, so that the imaginary part of
/// the first mode that has one is positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OwnAxes {
    /// The direction of the motion in the images.
    angle: f64,
    mirrored: bool,
}

impl OwnAxes {
    /// The axes of a state: its velocity (of any length), and its modes. `mirrored`: equations keep their form in a mirror.
    pub(crate) fn of(state: &[f64], mirrored: bool) -> Self {
        let angle = match state {
            [x, y, ..] => libm::atan2(*y, *x),
            _ => 0.0,
        };
        let mut own = state.to_vec();
        turn(angle, &mut own);
        let imaginary = own.iter().skip(3).step_by(2).find(|part| **part != 0.0);
        Self { angle, mirrored: mirrored && imaginary.is_some_and(|part| *part < 0.0) }
    }

    /// A vector along these axes.
    pub(crate) fn into_own(self, y: &mut [f64]) {
        turn(self.angle, y);
        self.mirror(y);
    }

    /// A vector along those of the images.
    pub(crate) fn into_images(self, y: &mut [f64]) {
        self.mirror(y);
        turn(-self.angle, y);
    }

    /// A track along these axes.
    pub(crate) fn track(self, track: &Track) -> Track {
        Track(track.0.iter().map(|frame| self.frame(frame)).collect())
    }

    fn frame(self, frame: &Observation) -> Observation {
        let mut own = frame.clone();
        self.into_own(&mut own.y);
        // R C R^T: first the rows of C, then the columns of the product, which is the transpose of C R^T
        own.covariance.iter_mut().for_each(|row| self.into_own(row));
        own.covariance = transposed(&own.covariance);
        own.covariance.iter_mut().for_each(|row| self.into_own(row));
        own
    }

    fn mirror(self, y: &mut [f64]) {
        if self.mirrored {
            y.iter_mut().skip(1).step_by(2).for_each(|part| *part = -*part);
        }
    }
}

fn transposed(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    (0..rows.len()).map(|i| rows.iter().map(|row| row[i]).collect()).collect()
}

/// Axes turned by an angle: the centre has the angular index -1, and `z_n` has n.
fn turn(angle: f64, y: &mut [f64]) {
    for (place, pair) in y.chunks_exact_mut(2).enumerate() {
        let index = if place == 0 { -1.0 } else { place as f64 + 1.0 };
        let (sin, cos) = libm::sincos(index * angle);
        let [re, im] = [pair[0], pair[1]];
        (pair[0], pair[1]) = (re * cos - im * sin, re * sin + im * cos);
    }
}

#[cfg(test)]
mod tests {
    use super::OwnAxes;
    use motiform_inference::{Observation, Track};

    /// A frame of a cell seen by two cameras, the second one turned by `angle` and behind the plane.
    fn seen(angle: f64, mirrored: bool) -> Track {
        let y = vec![0.3, -1.2, 0.2, 0.1, -0.3, 0.4, 0.05, 0.07];
        let n = y.len();
        let entry = |i: usize, j: usize| if i == j { 2.0 + i as f64 } else { 0.1 * ((i * j) as f64).sin() };
        let covariance = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
        let camera = OwnAxes { angle, mirrored };
        camera.track(&Track(vec![Observation { t: 0.0, y, covariance }]))
    }

    fn own(track: &Track) -> Observation {
        OwnAxes::of(&track.0[0].y, true).track(track).0[0].clone()
    }

    #[test]
    fn a_cell_is_the_same_to_every_camera() {
        let first = own(&seen(0.0, false));
        assert!(first.y[0] > 0.0 && first.y[1].abs() < 1e-15 && first.y[3] > 0.0, "{first:?}");
        for (angle, mirrored) in [(0.7, false), (-2.9, true), (3.0, false), (0.0, true)] {
            let other = own(&seen(angle, mirrored));
            let of = |one: &Observation| {
                one.y.iter().chain(one.covariance.iter().flatten()).copied().collect::<Vec<f64>>()
            };
            let apart = of(&first).iter().zip(of(&other)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-14, "{angle} {mirrored}: {apart:e}");
        }
    }

    #[test]
    fn back_to_the_images() {
        let track = seen(1.0, true);
        let axes = OwnAxes::of(&track.0[0].y, true);
        let mut y = track.0[0].y.clone();
        axes.into_own(&mut y);
        axes.into_images(&mut y);
        assert!(y.iter().zip(&track.0[0].y).all(|(a, b)| (a - b).abs() < 1e-15));
    }
}
