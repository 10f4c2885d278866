//! Modes of the tangent angle.

use crate::common::uniform;
use crate::fits::random;
use motiform_tracks::modes::{Flag, ModeOptions, outline_modes, tangent_modes};
use motiform_tracks::synthetic::Synthetic;

/// Equal to z_n to first order: the difference falls with the square of the deformation.
#[test]
fn equal_to_the_modes_of_the_radius_to_first_order() {
    let difference = |size: f64| {
        let mut truth = random(&mut uniform(8), size);
        (truth.centre, truth.r0) = ([0.0; 2], 1.0);
        let w = tangent_modes(&truth.vertices(4000, 0.0), 5).unwrap().w;
        let z = truth.z;
        w.iter().zip(z).map(|(w, z)| (w[0] - z[0]).hypot(w[1] - z[1])).fold(0.0, f64::max)
    };
    // below 1e-6 the polygon differs from the curve
    let (large, small) = (difference(0.08), difference(0.02));
    let order = (large / small).ln() / 4.0_f64.ln();
    assert!((1.8..2.3).contains(&order), "{large:e} {small:e} {order}");
}

/// An outline with a lobe that hangs over: rays meet it three times.
pub(crate) fn mushroom() -> Vec<[f64; 2]> {
    let corners = [
        [-0.3, -2.0],
        [0.3, -2.0],
        [0.3, 0.2],
        [1.4, 0.0],
        [1.5, -1.2],
        [1.9, -1.2],
        [2.0, 1.0],
        [0.0, 1.8],
        [-2.0, 1.0],
        [-1.9, -1.2],
        [-1.5, -1.2],
        [-1.4, 0.0],
        [-0.3, 0.2],
    ];
    let mut points = Vec::new();
    for (k, a) in corners.iter().enumerate() {
        let b = corners[(k + 1) % corners.len()];
        points.extend(
            (0..8).map(|j| f64::from(j) / 8.0).map(|s| [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])]),
        );
    }
    points
}

#[test]
fn a_fold_has_no_radius_but_a_tangent_angle() {
    let modes = outline_modes(&mushroom(), &ModeOptions::default());
    assert!(modes.radius.is_none(), "{modes:?}");
    assert!(modes.flags.iter().any(|flag| matches!(flag, Flag::NotStarShaped { .. } | Flag::NoFit)));
    assert!(modes.tangent.is_some() && !modes.is_left_out());
}

#[test]
fn a_circle_has_none() {
    let circle = Synthetic { centre: [1.0, 2.0], r0: 3.0, z: Vec::new() };
    let modes = tangent_modes(&circle.vertices(100, 0.0), 5).unwrap();
    assert!(modes.w.iter().flatten().all(|part| part.abs() < 1e-14) && (modes.r0 / 3.0 - 1.0).abs() < 1e-3);
}

#[test]
fn what_does_not_turn_once_has_none() {
    let eight: Vec<[f64; 2]> =
        (0..40).map(|k| f64::from(k) * 0.157).map(|t| [t.sin(), (2.0 * t).sin() + 0.3 * t.sin()]).collect();
    assert!(tangent_modes(&eight, 5).is_none());
    assert!(tangent_modes(&[[0.0, 0.0], [1.0, 0.0]], 5).is_none());
    assert!(tangent_modes(&[], 5).is_none());
    assert!(tangent_modes(&[[f64::NAN, 0.0], [1.0, 0.0], [1.0, 1.0]], 5).is_none());
}
