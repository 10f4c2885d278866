//! The analyses together, on systems of the zoo: rests near a heteroclinic cycle, and returns of a torus.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_analysis::{Estimate, Rests, correlation_dimension, rests, series_mean, zero_one};
use motiform_dynamics::steppers::{DOP853, RK4};
use motiform_dynamics::{
    Direction, Integration, Noise, NoisyOrbit, Normal, Orbit, Request, Section, StepControl, Trajectory,
    VectorField, drive::drive,
};
use motiform_models::zoo::{Heteroclinic, Lorenz, Torus};

/// Rests of the speed in shape space, below a fifth of its maximum.
fn rests_of(orbit: &mut dyn Integration, t_end: f64, every: f64) -> Rests {
    let mut trajectory = Trajectory::new(3);
    let request = Request { sample_every: Some(every), ..Request::until(t_end, 3) };
    assert!(drive(orbit, &request, &mut trajectory).unwrap().is_complete());
    let speed = |u: &[f64]| {
        let mut du = [0.0; 3];
        Heteroclinic::default().eval(0.0, u, &mut du);
        du.iter().map(|x| x * x).sum::<f64>().sqrt()
    };
    let sizes: Vec<f64> = trajectory.iter().map(|(_, u)| speed(u)).collect();
    rests(trajectory.times(), &sizes, 0.2).unwrap()
}

fn ratio() -> f64 {
    let all: toml::Table = include_str!("../../../../../reference/zoo.toml").parse().unwrap();
    all["heteroclinic"]["ratio"].as_float().unwrap()
}

#[test]
fn without_noise_rests_grow_by_the_ratio_of_the_eigenvalues() {
    let field = Heteroclinic::default();
    let control = StepControl::Adaptive { rtol: 1e-13, atol: 1e-100 }; // small components matter
    let mut orbit = Orbit::new(&field, &DOP853, control, 0.0, &[0.9, 0.2, 0.1]).unwrap();
    let seen = rests_of(&mut orbit, 3000.0, 0.05);
    let (ratios, growth) = (seen.ratios(), seen.growth());
    println!("{ratios:?} {growth:?}");
    let ([.., last], [.., increments]) = (&ratios[..], &growth[..]) else { panic!("no rests") };
    assert!((last - ratio()).abs() < 0.01, "{last}"); // converges like the rests grow
    assert!((increments - ratio()).abs() < 1e-3, "{increments}");
}

/// Mean rest = -ln(eta)/lambda_+ + const, lambda_+ = 1 - b = 0.45. Source: Stone and Holmes (1990), SIAM J. Appl. Math.
/// 50, 726.
#[test]
fn with_noise_mean_rests_grow_with_the_logarithm_of_its_amplitude() {
    let field = Heteroclinic::default();
    let mean_rest = |amplitude: f64, stream: u64| -> Estimate {
        let control = StepControl::Fixed { step: 0.05 };
        let orbit = Orbit::new(&field, &RK4, control, 0.0, &[0.9, 0.2, 0.1]).unwrap();
        let noise = Noise { amplitudes: vec![amplitude; 3], rates: vec![0.0; 3], step: 0.05 };
        let mut noisy = NoisyOrbit::new(orbit, noise, Normal::new(1990, stream)).unwrap();
        let seen = rests_of(&mut noisy, 40_000.0, 0.05);
        let durations: Vec<f64> = seen.rests.iter().skip(5).map(|rest| rest.duration).collect();
        series_mean(&durations).unwrap()
    };
    let (few, less, least) = (mean_rest(1e-4, 0), mean_rest(1e-6, 1), mean_rest(1e-8, 2));
    println!("{few:?} {less:?} {least:?}");
    for (a, b) in [(few, less), (less, least)] {
        let (difference, error) = (b.value - a.value, a.error.hypot(b.error));
        let expected = 100.0_f64.ln() / 0.45;
        // twice the 95 % half width: four standard errors
        assert!((difference - expected).abs() < 2.0 * error, "{difference} +- {error}, expected {expected}");
        assert!(error < 0.1 * expected);
    }
}

/// Section points of a field, `count` of them, after as many that are dropped.
fn section_points<F: VectorField<f64>>(
    field: &F,
    u: &[f64],
    g: &(dyn Fn(f64, &[f64]) -> f64 + Sync),
    t_end: f64,
) -> Vec<Vec<f64>> {
    let control = StepControl::Adaptive { rtol: 1e-10, atol: 1e-10 };
    let mut orbit = Orbit::new(field, &DOP853, control, 0.0, u).unwrap();
    let sections = [Section { g, direction: Direction::Rising, terminal: false }];
    let mut trajectory = Trajectory::new(u.len());
    let request = Request { sections: &sections, ..Request::until(t_end, u.len()) };
    assert!(drive(&mut orbit, &request, &mut trajectory).unwrap().is_complete());
    trajectory.crossings().iter().skip(50).map(|p| p.state.clone()).collect()
}

#[test]
fn returns_of_a_torus_lie_on_a_curve_and_are_regular() {
    let points = section_points(&Torus::default(), &[0.5, -0.1, 0.8, 0.1], &|_t, u| u[1], 4000.0);
    let seen = correlation_dimension(&points, 1e-8).unwrap();
    assert!((seen.value - 1.0).abs() < 0.1, "{seen:?}");
    let series: Vec<f64> = points.iter().map(|p| p[2]).collect();
    assert!(zero_one(&series, 1).unwrap().k.abs() < 0.1);
}

#[test]
fn returns_of_lorenz_are_chaotic() {
    let points = section_points(&Lorenz::default(), &[1.0, 1.0, 20.0], &|_t, u| u[2] - 27.0, 1000.0);
    let series: Vec<f64> = points.iter().map(|p| p[0].abs()).collect();
    assert!(zero_one(&series, 1).unwrap().k > 0.9);
}
