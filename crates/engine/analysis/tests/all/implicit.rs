//! The implicit flow against exact solutions and against the explicit and exponential methods.

use motiform_analysis::implicit_flow;
use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::{DOP853, KROGSTAD4, Method};

use motiform_dynamics::{Equivariant, Outcome, Request, Scalar, StepControl, System, Tangent, VectorField};
use motiform_models::cell::{Cell, CellParameters};
use motiform_models::zoo::{Hopf, Lorenz};

fn units(dim: usize) -> Vec<f64> {
    (0..dim * dim).map(|i| f64::from(u8::from(i / dim == i % dim))).collect()
}

fn nothing(_: &[f64]) -> Vec<Vec<f64>> {
    Vec::new()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt()
}

/// The state and the images of the unit vectors, by another method.
fn reference<F: Equivariant>(
    field: &F,
    method: Method,
    start: &[f64],
    span: f64,
    count: usize,
) -> (Vec<f64>, Vec<f64>) {
    let dim = start.len();
    let tangent = Tangent::following(field, count);
    let mut state = start.to_vec();
    state.extend(&units(dim)[..dim * count]);
    let control = StepControl::Adaptive { rtol: 1e-13, atol: 1e-15 };
    let mut orbit = method.shape_orbit(&tangent, control, 0.0, &state).expect("a method");
    let request = Request { watched: dim, ..Request::until(span, state.len()) };
    assert!(drive(orbit.as_mut(), &request, &mut ()).expect("a run").is_complete());
    let (u, w) = orbit.state().split_at(dim);
    (u.to_vec(), w.to_vec())
}

#[test]
fn a_limit_cycle_and_its_multipliers_are_exact() {
    let hopf = Hopf { mu: 1.0, omega: 2.0 };
    let time = std::f64::consts::PI;
    let flowed = implicit_flow(&hopf, &[1.0, 0.0], &units(2), &nothing, (time, None), &()).unwrap();
    assert!(distance(&flowed.end, &[1.0, 0.0]) < 1e-12, "{:?}", flowed.end);
    let exact = [(-2.0 * time).exp(), 0.0, 0.0, 1.0];
    assert!(distance(&flowed.vectors, &exact) < 1e-12, "{:?}", flowed.vectors);
}

#[test]
fn the_flow_of_lorenz_is_that_of_dop853() {
    let lorenz = Lorenz::default();
    let start = [5.0, 6.0, 20.0];
    let (end, vectors) = reference(&lorenz, Method::Explicit(&DOP853), &start, 1.5, 3);
    let flowed = implicit_flow(&lorenz, &start, &units(3), &nothing, (1.5, None), &()).unwrap();
    assert!(distance(&flowed.end, &end) < 1e-10, "{}", distance(&flowed.end, &end));
    let size = distance(&vectors, &[0.0; 9]);
    assert!(distance(&flowed.vectors, &vectors) < 1e-10 * size, "{}", distance(&flowed.vectors, &vectors));
}

#[test]
fn the_flow_of_the_cell_is_that_of_an_exponential_method_in_short_steps() {
    let cell =
        Cell::new(&CellParameters { length: 12.98, modes: 16.0, ..CellParameters::default() }).unwrap();
    let start: Vec<f64> =
        (0..cell.dim()).map(|i| 0.2 * (-(i as f64) / 2.0).exp() * (1.0 + i as f64).sin()).collect();
    // past the transients of the fast modes
    let (start, _) = reference(&cell, Method::Exponential(&KROGSTAD4), &start, 20.0, 0);
    let (end, _) = reference(&cell, Method::Exponential(&KROGSTAD4), &start, 4.0, 0);
    let mut flow = vec![0.0; start.len()];
    VectorField::<f64>::eval(&cell, 0.0, &start, &mut flow);
    let flowed = implicit_flow(&cell, &start, &flow, &nothing, (4.0, None), &()).unwrap();
    assert!(distance(&flowed.end, &end) < 1e-11, "{}", distance(&flowed.end, &end));
    // with a first step that is given, here a short one
    let slower = implicit_flow(&cell, &start, &flow, &nothing, (4.0, Some(0.01)), &()).unwrap();
    assert!(distance(&slower.end, &end) < 1e-11, "{}", distance(&slower.end, &end));
    assert!(slower.steps > flowed.steps, "{} {}", slower.steps, flowed.steps);
    // the flow moves its own direction along
    VectorField::<f64>::eval(&cell, 0.0, &end, &mut flow);
    assert!(distance(&flowed.vectors, &flow) < 1e-10, "{}", distance(&flowed.vectors, &flow));
    assert!(flowed.steps < 40);
}

#[test]
fn vectors_are_the_derivatives_of_the_computed_flow() {
    let cell = Cell::new(&CellParameters { length: 21.8, modes: 16.0, ..CellParameters::default() }).unwrap();
    let start: Vec<f64> =
        (0..cell.dim()).map(|i| 0.2 * (-(i as f64) / 2.0).exp() * (1.0 + i as f64).sin()).collect();
    let flowed = implicit_flow(&cell, &start, &units(cell.dim()), &nothing, (0.3, None), &()).unwrap();
    let size = 1e-4;
    let moved = |by: f64| {
        let start: Vec<f64> = start
            .iter()
            .enumerate()
            .map(|(i, x)| x + by * size * (i as f64).cos() / (1.0 + i as f64))
            .collect();
        implicit_flow(&cell, &start, &[], &nothing, (0.3, None), &()).unwrap().end
    };
    let difference: Vec<f64> =
        moved(1.0).iter().zip(moved(-1.0)).map(|(a, b)| (a - b) / (2.0 * size)).collect();
    let dim = cell.dim();
    let image: Vec<f64> = (0..dim)
        .map(|k| (0..dim).map(|i| flowed.vectors[i * dim + k] * (i as f64).cos() / (1.0 + i as f64)).sum())
        .collect();
    assert!(distance(&difference, &image) < 1e-6, "{}", distance(&difference, &image));
}

#[test]
fn a_force_adds_the_derivative_by_a_parameter() {
    let hopf = |mu: f64| Hopf { mu, omega: 2.0 };
    // u' = f(u, mu), with df/dmu = u
    let force = |u: &[f64]| vec![u.to_vec()];
    let flowed = implicit_flow(&hopf(0.5), &[0.3, 0.1], &[0.0; 2], &force, (2.0, None), &()).unwrap();
    let end = |mu| implicit_flow(&hopf(mu), &[0.3, 0.1], &[], &nothing, (2.0, None), &()).unwrap().end;
    let slope: Vec<f64> = end(0.501).iter().zip(end(0.499)).map(|(a, b)| (a - b) / 0.002).collect();
    assert!(distance(&slope, &flowed.vectors) < 1e-6, "{slope:?} {:?}", flowed.vectors);
}

#[test]
fn a_flow_that_leaves_says_so() {
    struct Leaving;
    impl System for Leaving {
        fn dim(&self) -> usize {
            1
        }
    }
    impl<T: Scalar> VectorField<T> for Leaving {
        fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
            du[0] = u[0] * u[0];
        }
    }
    let left = implicit_flow(&Leaving, &[1.0], &[], &nothing, (2.0, None), &());
    assert!(matches!(left, Err(Outcome::StepUnderflow { t, .. }) if (t - 1.0).abs() < 1e-6), "{left:?}");
}
