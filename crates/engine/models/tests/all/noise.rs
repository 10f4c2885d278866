//! The noise of every model does not know directions.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::Noise;
use motiform_dynamics::model::velocity;
use motiform_models::MODELS;

/// The covariance `diag(eta^2)` commutes with the rotations `R`, which are orthogonal: `R D = D R`.
#[test]
fn the_law_of_the_noise_commutes_with_rotations() {
    for info in MODELS {
        let defaults: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
        let model = info.build(&defaults).unwrap();
        let noise = Noise::on(model.as_ref(), 0.7, 0.3, 1.0);
        let times = |u: &[f64]| -> Vec<f64> {
            u.iter().zip(&noise.amplitudes).map(|(x, eta)| x * eta * eta).collect()
        };
        for entry in 0..model.dim() {
            let mut unit = vec![0.0; model.dim()];
            unit[entry] = 1.0;
            let mut first = times(&unit);
            model.rotate(0.4, &mut first);
            model.rotate(0.4, &mut unit);
            let largest = first.iter().zip(times(&unit)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(largest < 1e-15, "{} {entry}: {largest}", info.name);
        }
    }
}

/// The amplitudes of the noise are those of the coordinates that users see: without a flow every coordinate
/// of the shape has the variance eta^2 t.
#[test]
fn every_coordinate_has_its_amplitude() {
    for info in MODELS {
        let defaults: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
        let model = info.build(&defaults).unwrap();
        let noise = Noise::on(model.as_ref(), 0.7, 0.3, 1.0);
        // a state whose entries are their standard deviations, read as coordinates: the models' maps are diagonal
        let mut seen = vec![0.0; model.dim()];
        model.decode(&noise.amplitudes, &mut seen);
        for (i, (coordinate, x)) in model.coordinates().iter().zip(&seen).enumerate() {
            let expected = if i < model.velocities() { 0.7 } else { 0.3 };
            assert!((x.abs() - expected).abs() < 1e-15, "{} {x}", coordinate.name);
        }
        let velocity = velocity(model.as_ref(), &noise.amplitudes);
        assert_eq!(seen[..model.velocities()], velocity[..model.velocities()], "{}", info.name);
        assert!(info.name != "tensor" || model.velocities() == 2);
    }
}
