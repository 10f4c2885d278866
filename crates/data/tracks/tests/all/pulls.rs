//! Errors are as large as they are said to be: (found - true)/error has variance 1.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{normal, uniform};
use crate::fits::random;
use motiform_tracks::modes::fit_radius;
use motiform_tracks::synthetic::{Synthetic, blur};

/// Standard deviations of the pulls of (X, Y, R0, z2.., z5) over many frames.
fn pulls(seed: u64, size: f64, noise: f64, vertices: usize, frames: usize) -> Vec<f64> {
    let (mut next, mut deviate) = (uniform(seed), normal(seed));
    let mut squares = [0.0; 11];
    for _ in 0..frames {
        let truth = random(&mut next, size);
        let mut points = truth.vertices(vertices, next());
        blur(&mut points, noise * truth.r0, &mut deviate);
        let fit = fit_radius(&points, 5).unwrap();
        let Synthetic { centre, r0, z } = truth;
        let found = fit.centre.into_iter().chain([fit.r0]).chain(fit.z.iter().flatten().copied());
        let known = centre.into_iter().chain([r0]).chain(z.into_iter().flatten());
        for (k, (found, known)) in found.zip(known).enumerate() {
            let pull = (found - known) / fit.covariance(fit.sigma, k, k).sqrt();
            squares[k] += pull * pull;
        }
    }
    squares.iter().map(|sum| (sum / frames as f64).sqrt()).collect()
}

/// 3000 frames: the error of a standard deviation is 1.3 %; Student's t with 37 degrees of freedom adds 2.8 %.
#[test]
fn pulls_are_one() {
    for (seed, size, noise) in [(5, 0.1, 0.01), (6, 0.4, 0.01), (7, 0.6, 0.02)] {
        let pulls = pulls(seed, size, noise, 48, 3000);
        println!("size {size} noise {noise}: {pulls:.3?}");
        assert!(pulls.iter().all(|pull| (0.9..1.1).contains(pull)), "{size} {noise}: {pulls:?}");
    }
}
