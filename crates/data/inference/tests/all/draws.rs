//! Draws of coefficients.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Experiment, full};
use motiform_dynamics::Normal;
use motiform_inference::{Fit, Library, Settings, draws, fit};
use nalgebra::{DMatrix, Matrix3};

const SEED: u64 = 5;

/// The root of the covariance by which draws follow from normal deviates, in natural units.
fn root(fit: &Fit) -> Matrix3<f64> {
    let columns = draws(fit, 3, SEED);
    let unit = |i: usize| fit.scales.coefficient(&fit.coefficients[i].term);
    let moved = Matrix3::from_fn(|i, k| (columns[k][i] - fit.coefficients[i].estimate.value) / unit(i));
    let mut normal = Normal::new(SEED, 0);
    let deviates: Vec<f64> = (0..9).map(|_| normal.next()).collect();
    moved * Matrix3::from_column_slice(&deviates).try_inverse().unwrap()
}

/// Two equal variances, in axes of their plane that no round-off fixes, and a third one that is nearly 0.
#[test]
fn the_root_follows_the_covariance() {
    let library = Library::new(2, 2).unwrap().select(&["z1: z1", "z2: z2", "z2: z1^2"]).unwrap();
    let tracks = [Experiment { frames: 40, ..Experiment::new(full(0.5, 0.1), 0.05, 7) }.track()];
    let fit = fit(&tracks, &Settings { library, ..Settings::default() }, &()).unwrap();
    let column = DMatrix::from_column_slice(3, 1, &[1.0, 2.0, -2.0]) / 3.0;
    let along = &column * column.transpose();
    let covariance =
        Matrix3::from_fn(|i, j| ((DMatrix::identity(3, 3) - &along) * 4.0 + &along * 1e-9)[(i, j)]);
    let with = |covariance: &Matrix3<f64>| {
        let mut fit = fit.clone();
        for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
            fit.natural.covariance[i][j] = covariance[(i, j)];
        }
        root(&fit)
    };
    let one = with(&covariance);
    assert!((one * one - covariance).norm() < 1e-11, "{one}");
    let mut moved = covariance;
    moved[(0, 1)] += 1e-13;
    moved[(1, 0)] += 1e-13;
    assert!((with(&moved) - one).norm() < 1e-8);
}
