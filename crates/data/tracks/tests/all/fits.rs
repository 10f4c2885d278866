//! Exact outlines give back their modes.

use crate::common::uniform;
use motiform_tracks::modes::{ModeOptions, fit_radius, outline_modes};
use motiform_tracks::synthetic::Synthetic;

/// A random outline; `size` is the sum of 2 |z_n|/R0.
pub(crate) fn random(next: &mut impl FnMut() -> f64, size: f64) -> Synthetic {
    let mut z: Vec<[f64; 2]> = (0..4).map(|_| [next() - 0.5, next() - 0.5]).collect();
    let sum: f64 = z.iter().map(|[a, b]| 2.0 * a.hypot(*b)).sum();
    let r0 = 0.5 + 3.0 * next();
    z.iter_mut().flatten().for_each(|part| *part *= size * r0 / sum);
    Synthetic { centre: [4.0 * next() - 2.0, 4.0 * next() - 2.0], r0, z }
}

/// Largest difference of the fit from the truth, relative to R0.
fn error(truth: &Synthetic, vertices: usize) -> Option<f64> {
    let fit = fit_radius(&truth.vertices(vertices, 0.3), 5)?;
    let mut parts = vec![fit.r0 - truth.r0];
    parts.extend((0..2).map(|k| fit.centre[k] - truth.centre[k]));
    parts.extend(fit.z.iter().zip(&truth.z).flat_map(|(a, b)| [a[0] - b[0], a[1] - b[1]]));
    Some(parts.into_iter().fold(0.0_f64, |most, part| most.max(part.abs())) / truth.r0)
}

#[test]
fn circle() {
    let circle = Synthetic { centre: [3.0, -1.0], r0: 2.0, z: vec![[0.0; 2]; 4] };
    assert!(error(&circle, 20).unwrap() < 1e-15);
    let modes = outline_modes(&circle.vertices(64, 0.0), &ModeOptions::default());
    assert!(modes.flags.is_empty() && modes.radius.is_some());
}

/// 1e-13: some tens of round-offs, times the condition of the equations.
#[test]
fn exact_outlines_give_their_modes() {
    let mut next = uniform(1);
    let mut worst = 0.0_f64;
    for size in [0.05, 0.2, 0.4, 0.6] {
        for _ in 0..300 {
            let truth = random(&mut next, size);
            worst = worst.max(error(&truth, 24 + (100.0 * next()) as usize).unwrap());
        }
    }
    println!("worst {worst:.1e}");
    assert!(worst < 1e-13, "{worst:e}");
}

/// Outlines that nearly reach their centre: no wrong modes without a large residual, and nearly always the
/// right ones.
#[test]
fn large_deformation() {
    let mut next = uniform(2);
    let (mut worst, mut found, mut all) = (0.0_f64, 0, 0);
    while all < 400 {
        let truth = random(&mut next, 0.9);
        if truth.margin().0 < 0.1 * truth.r0 {
            continue;
        }
        all += 1;
        if let Some(error) = error(&truth, 80) {
            found += usize::from(error < 1e-6);
            if error < 1e-6 {
                worst = worst.max(error);
            } else {
                // another minimum shows by its residuals
                let fit = fit_radius(&truth.vertices(80, 0.3), 5).unwrap();
                assert!(fit.sigma > 1e-3 * truth.r0, "{error} {truth:?}");
            }
        }
    }
    println!("{found} of {all}, worst {worst:.1e}");
    assert!(found >= 396 && worst < 1e-13, "{found} {worst:e}");
}

/// The convention is that of the models: R = R0 + sum 2 Re(z_n e^{i n theta}).
#[test]
fn as_the_models_draw() {
    let state = [0.3, 0.1, 0.2, -0.1, 0.07, 0.05]; // z1, z2, z3
    let outline = motiform_models::tensor::outline::outline(&state, 1.5, 60);
    let motiform_dynamics::Outline::Curve(points) = outline else { panic!("a curve") };
    let fit = fit_radius(&points, 3).unwrap();
    let truth = [[0.2, -0.1], [0.07, 0.05]];
    for (z, truth) in fit.z.iter().zip(truth) {
        assert!((z[0] - truth[0]).abs() < 1e-14 && (z[1] - truth[1]).abs() < 1e-14);
    }
    assert!(fit.centre.iter().all(|x| x.abs() < 1e-14) && (fit.r0 - 1.5).abs() < 1e-14);
}

/// The centroid of the area is another point: the first harmonic about it is not 0.
#[test]
fn the_centre_is_not_the_centroid() {
    let truth = Synthetic { centre: [0.0; 2], r0: 1.0, z: vec![[0.12, 0.0], [0.06, 0.02]] };
    let points = truth.vertices(200, 0.0);
    let centroid = motiform_tracks::centroid(&points);
    assert!(centroid[0].hypot(centroid[1]) > 0.01);
    let centre = fit_radius(&points, 5).unwrap().centre;
    assert!(centre[0].hypot(centre[1]) < 1e-14);
}

/// Features finer than the modes show by the correlation of the residuals; noise does not.
#[test]
fn finer_features_are_seen() {
    let mut wavy = Synthetic { centre: [0.0; 2], r0: 1.0, z: vec![[0.1, 0.0], [0.0, 0.05]] };
    let mut noisy = wavy.vertices(120, 0.0);
    wavy.z.extend([[0.0; 2], [0.0; 2], [0.0; 2], [0.02, 0.01]]);
    let fine = fit_radius(&wavy.vertices(120, 0.0), 5).unwrap();
    assert!(fine.neighbours > 0.7 && fine.inflation > 3.0, "{} {}", fine.neighbours, fine.inflation);
    motiform_tracks::synthetic::blur(&mut noisy, 0.02, crate::common::normal(12));
    let fit = fit_radius(&noisy, 5).unwrap();
    assert!(fit.neighbours.abs() < 0.25 && fit.inflation < 1.3, "{} {}", fit.neighbours, fit.inflation);
}
