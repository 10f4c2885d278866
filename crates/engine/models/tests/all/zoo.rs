//! The systems with known answers have them: fixed points, radii, periods, eigenvalues, rests.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_dynamics::steppers::{DOP853, KROGSTAD4};
use motiform_dynamics::{
    Direction, Dual, ExponentialOrbit, Integration, Lanes, Orbit, Request, Section, Semilinear, StepControl,
    Trajectory, VectorField, conformance, drive::drive,
};
use motiform_models::zoo::{Heteroclinic, Hopf, Linear, Lorenz, Rossler, Torus, VanDerPol};
use std::f64::consts::TAU;

const CONTROL: StepControl = StepControl::Adaptive { rtol: 1e-13, atol: 1e-13 };

fn reference(system: &str) -> toml::Table {
    let all: toml::Table = include_str!("../../../../../reference/zoo.toml").parse().unwrap();
    all[system].as_table().unwrap().clone()
}

fn number(system: &str, key: &str) -> f64 {
    reference(system)[key].as_float().unwrap()
}

fn list(system: &str, key: &str) -> Vec<f64> {
    reference(system)[key].as_array().unwrap().iter().map(|x| x.as_float().unwrap()).collect()
}

fn rate<F: VectorField<f64>>(field: &F, u: &[f64]) -> Vec<f64> {
    let mut du = vec![f64::NAN; u.len()];
    field.eval(0.0, u, &mut du);
    du
}

/// Rising crossings of `g = 0` from `u` until `t_end`.
fn crossings<F: VectorField<f64>>(
    field: &F,
    u: &[f64],
    t_end: f64,
    g: &(dyn Fn(f64, &[f64]) -> f64 + Sync),
) -> Trajectory {
    let mut orbit = Orbit::new(field, &DOP853, CONTROL, 0.0, u).unwrap();
    let sections = [Section { g, direction: Direction::Rising, terminal: false }];
    let mut trajectory = Trajectory::new(u.len());
    let request = Request { sections: &sections, ..Request::until(t_end, u.len()) };
    assert!(drive(&mut orbit, &request, &mut trajectory).unwrap().is_complete());
    trajectory
}

/// Asserts the properties of every field: purity, lanes, derivatives, the split into parts.
fn conforms<F>(field: &F)
where
    F: Semilinear<f64> + Semilinear<Lanes<4>> + VectorField<Dual<f64, 1>>,
{
    let dim = field.dim();
    let state = |shift: f64| (0..dim).map(|i| 0.3 + shift + 0.2 * i as f64).collect::<Vec<f64>>();
    let (u, w) = (state(0.0), state(-0.7));
    assert_eq!(conformance::purity_defect(field, &u), 0.0);
    let states = std::array::from_fn(|lane| state(0.1 * lane as f64));
    assert_eq!(conformance::lane_mismatches::<4, F, F>(field, field, &states), 0);
    assert!(conformance::derivative_defect(field, &u, &w) < 1e-8);
    assert_eq!(conformance::semilinear_defect(field, &u), 0.0);
}

#[test]
fn every_system_is_a_proper_field() {
    conforms(&Lorenz::default());
    conforms(&Rossler::default());
    conforms(&Hopf { mu: 0.3, omega: 2.0 });
    conforms(&VanDerPol { mu: 1.0 });
    conforms(&Torus::default());
    conforms(&Heteroclinic::default());
    conforms(&Linear { rows: [[1.0, 2.0], [-3.0, 0.5]] });
}

#[test]
fn lorenz_has_its_fixed_points_divergence_and_symmetry() {
    let lorenz = Lorenz::default();
    let c = (8.0_f64 / 3.0 * 27.0).sqrt();
    for u in [[0.0; 3], [c, c, 27.0], [-c, -c, 27.0]] {
        assert!(rate(&lorenz, &u).iter().all(|x| x.abs() < 1e-13));
    }
    // the published exponents sum to the divergence -(10 + 1 + 8/3), three times their rounding
    let sum: f64 = list("lorenz", "exponents").iter().sum();
    assert!((sum + 41.0 / 3.0).abs() < 1.5e-4, "{sum}");
    let (a, b) = (rate(&lorenz, &[1.0, 2.0, 3.0]), rate(&lorenz, &[-1.0, -2.0, 3.0]));
    assert_eq!([-a[0], -a[1], a[2]], b[..]);
}

#[test]
fn rossler_has_its_fixed_points() {
    let Rossler { a, b, c } = Rossler::default();
    for sign in [-1.0, 1.0] {
        let y = (-c + sign * (c * c - 4.0 * a * b).sqrt()) / (2.0 * a);
        assert!(rate(&Rossler::default(), &[-a * y, y, -y]).iter().all(|x| x.abs() < 1e-12));
    }
}

#[test]
fn hopf_approaches_its_circle_as_the_formula_says() {
    let (mu, omega) = (number("hopf", "mu"), number("hopf", "omega"));
    let field = Hopf { mu, omega };
    let trajectory = crossings(&field, &[0.1, -0.01], 60.0, &|_t, u| u[1]);
    let tolerance = number("hopf", "tolerance");
    for point in trajectory.crossings() {
        let start = 0.1_f64 * 0.1 + 0.01 * 0.01;
        let square = mu / (1.0 - (1.0 - mu / start) * (-2.0 * mu * point.t).exp());
        assert!((point.state[0] - square.sqrt()).abs() < 10.0 * tolerance);
    }
    let last = trajectory.crossings().last().unwrap();
    let before = &trajectory.crossings()[trajectory.crossings().len() - 2];
    assert!((last.state[0] - number("hopf", "radius")).abs() < 10.0 * tolerance);
    assert!((last.t - before.t - number("hopf", "period")).abs() < 10.0 * tolerance);
}

#[test]
fn van_der_pol_has_its_period_and_amplitude() {
    let field = VanDerPol { mu: number("van_der_pol", "mu") };
    // falling v = 0 is the maximum of x
    let trajectory = crossings(&field, &[2.0, 0.0], 100.0, &|_t, u| -u[1]);
    let [.., before, last] = trajectory.crossings() else { panic!("no cycle") };
    let tolerance = number("van_der_pol", "tolerance");
    assert!((last.t - before.t - number("van_der_pol", "period")).abs() < tolerance, "{}", last.t - before.t);
    assert!((last.state[0] - number("van_der_pol", "amplitude")).abs() < tolerance, "{}", last.state[0]);
}

#[test]
fn the_exponential_stepper_takes_a_plain_field() {
    let mut orbit = ExponentialOrbit::new(
        &VanDerPol { mu: 1.0 },
        &KROGSTAD4,
        StepControl::Fixed { step: 1e-2 },
        0.0,
        &[2.0, 0.0],
    )
    .unwrap();
    let mut other = Orbit::new(&VanDerPol { mu: 1.0 }, &DOP853, CONTROL, 0.0, &[2.0, 0.0]).unwrap();
    while orbit.t() < 3.0 {
        orbit.advance(3.0).unwrap();
    }
    while other.t() < 3.0 {
        other.advance(3.0).unwrap();
    }
    // order 4 with steps of 1e-2
    assert!(orbit.state().iter().zip(other.state()).all(|(a, b)| (a - b).abs() < 1e-7));
}

#[test]
fn the_torus_returns_by_its_rotation_number() {
    let torus = Torus::default();
    let start = [1.0, -1e-9, 1.0, 0.0];
    let trajectory = crossings(&torus, &start, 200.0, &|_t, u| u[1]);
    let angles: Vec<f64> = trajectory.crossings().iter().map(|p| p.state[3].atan2(p.state[2])).collect();
    assert_eq!(angles.len(), 32);
    for pair in angles.windows(2) {
        let turn = (pair[1] - pair[0] - TAU * torus.omega[1]).rem_euclid(TAU);
        assert!(turn.min(TAU - turn) < 1e-10, "{turn}");
    }
    let last = &trajectory.crossings()[31].state;
    assert!((last[0].hypot(last[1]) - 1.0).abs() < 1e-11 && (last[2].hypot(last[3]) - 1.0).abs() < 1e-11);
}

#[test]
fn the_heteroclinic_cycle_has_its_eigenvalues_and_its_rests() {
    let field = Heteroclinic::default();
    let eigenvalues = list("heteroclinic", "eigenvalues");
    for i in 0..3 {
        // at e_i every axis is an eigenvector: along e_(i+2), e_(i+1), e_i
        for (axis, eigenvalue) in [(i + 2) % 3, (i + 1) % 3, i].into_iter().zip(&eigenvalues) {
            let mut u = vec![Dual { value: 0.0, derivative: [0.0] }; 3];
            u[i].value = 1.0;
            u[axis].derivative = [1.0];
            let mut du = u.clone();
            field.eval(0.0, &u, &mut du);
            assert!(du.iter().all(|d| d.value == 0.0));
            assert!((du[axis].derivative[0] - eigenvalue).abs() < 1e-15);
        }
    }
    // entering the neighbourhood x_0 > x_1, x_2: the stays near e_0 grow by the third power of the ratio per round,
    // until the tolerance of the steps ends that (about t = 3300)
    let trajectory = crossings(&field, &[0.9, 0.2, 0.1], 2.6e3, &|_t, u| u[0] - 0.5);
    let times: Vec<f64> = trajectory.crossings().iter().map(|p| p.t).collect();
    let rounds: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let [.., before, last] = rounds[..] else { panic!("no rounds: {times:?}") };
    assert!((last / before - number("heteroclinic", "ratio").powi(3)).abs() < 0.05, "{}", last / before);
}

#[test]
fn a_jordan_block_and_a_spiral_are_solved_exactly() {
    let end = |rows: [[f64; 2]; 2]| {
        let field = Linear { rows };
        let mut orbit = Orbit::new(&field, &DOP853, CONTROL, 0.0, &[1.0, 2.0]).unwrap();
        while orbit.t() < 1.5 {
            orbit.advance(1.5).unwrap();
        }
        orbit.state().to_vec()
    };
    let jordan = end([[-1.0, 1.0], [0.0, -1.0]]); // e^(-t) (1 + 2 t, 2)
    let decay = (-1.5_f64).exp();
    assert!((jordan[0] - 4.0 * decay).abs() < 1e-12 && (jordan[1] - 2.0 * decay).abs() < 1e-12);
    let spiral = end([[0.2, -3.0], [3.0, 0.2]]); // e^(0.2 t) times a rotation by 3 t
    let ((sin, cos), growth) = (4.5_f64.sin_cos(), 0.3_f64.exp());
    assert!((spiral[0] - growth * (cos - 2.0 * sin)).abs() < 1e-11);
    assert!((spiral[1] - growth * (sin + 2.0 * cos)).abs() < 1e-11);
}
