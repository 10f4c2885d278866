//! Exponential steppers: orders at the ends of steps and inside them, error control, sections, outcomes, no allocation.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{Modes, StuartLandau, slope, stuart_landau};
use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::{DOP853, EXPONENTIAL_STEPPERS, ExponentialTableau, HOCHBRUCK4, KROGSTAD4};
use motiform_dynamics::{
    Direction, Error, ExponentialOrbit, Integration, Orbit, Outcome, Request, Scalar, Section, Semilinear,
    StepControl, System, Trajectory, VectorField,
};

fn start() -> Vec<f64> {
    (0..Modes::COUNT).map(|n| 0.8 / (1.0 + n as f64).powi(2)).collect()
}

/// The stiff problem by an unrelated method: order 8, tolerance 1e-14.
fn reference(span: f64, parts: u32) -> Vec<Vec<f64>> {
    let control = StepControl::Adaptive { rtol: 1e-14, atol: 1e-15 };
    let mut orbit = Orbit::new(&Modes, &DOP853, control, 0.0, &start()).unwrap();
    let mut states = vec![start()];
    for part in 1..=parts {
        let t = span * f64::from(part) / f64::from(parts);
        drive(&mut orbit, &Request::until(t, Modes::COUNT), &mut ()).unwrap();
        states.push(orbit.state().to_vec());
    }
    states
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt()
}

/// Error at the end of the span, and the largest one in the middle of a step, for one fixed step size.
fn errors<F: Semilinear<f64>>(
    field: &F,
    tableau: &'static ExponentialTableau,
    (steps, span): (u32, f64),
    exact: &dyn Fn(f64) -> Vec<f64>,
) -> (f64, f64) {
    let control = StepControl::Fixed { step: span / f64::from(steps) };
    let mut orbit = ExponentialOrbit::new(field, tableau, control, 0.0, &exact(0.0)).unwrap();
    let mut state = exact(0.0);
    let mut inside: f64 = 0.0;
    for _ in 0..steps {
        orbit.advance(span).unwrap();
        let middle = 0.5 * (orbit.t_old() + orbit.t());
        orbit.dense().at(middle, &mut state);
        if middle > 0.5 * span {
            inside = inside.max(distance(&state, &exact(middle))); // the first transient is over
        }
    }
    (distance(orbit.state(), &exact(span)), inside)
}

fn check<F: Semilinear<f64>>(field: &F, span: f64, fewest: u32, exact: &dyn Fn(f64) -> Vec<f64>, name: &str) {
    for tableau in EXPONENTIAL_STEPPERS {
        let runs: Vec<(f64, (f64, f64))> = (0..4)
            .map(|i| fewest << i)
            .map(|n| (1.0 / f64::from(n), errors(field, tableau, (n, span), exact)))
            .collect();
        let ends: Vec<_> = runs.iter().map(|&(h, (end, _))| (h, end)).collect();
        let inside: Vec<_> = runs.iter().map(|&(h, (_, inside))| (h, inside)).collect();
        let (at_ends, within) = (slope(&ends), slope(&inside));
        println!("{name:8} {:10} order {at_ends:.3}, dense {within:.3}, {ends:?}", tableau.name);
        assert!((at_ends - f64::from(tableau.order)).abs() < 0.1, "{name} {}: order {at_ends}", tableau.name);
        let stated = f64::from(tableau.dense_order());
        assert!((within - stated).abs() < 0.1, "{name} {}: dense order {within}", tableau.name);
    }
}

#[test]
fn orders_on_a_problem_with_an_exact_solution() {
    check(&StuartLandau, 2.0, 80, &stuart_landau, "exact");
}

/// Linear rates down to -82, a quadratic coupling of eight modes: `h lambda` down to -1.3.
#[test]
fn orders_on_a_stiff_problem() {
    let states = reference(1.0, 1024);
    check(&Modes, 1.0, 64, &|t| states[(t * 1024.0).round() as usize].clone(), "stiff");
}

/// `u_t = u_xx + mean(u) + g(t, x)` on 0..1, zero at both ends, by second differences at 199 points, in sine modes: `u = x (1 - x) e^t` is
/// exact. The mean does not vanish at the ends, so slow and fast modes are coupled: `h lambda` goes down to -2e4.
struct Mean {
    /// Sine modes of 1 and of `x (1 - x)`, and the sum of the latter.
    ones: Vec<f64>,
    bump: Vec<f64>,
    sum: f64,
}

impl Mean {
    const POINTS: usize = 200;

    fn new() -> Self {
        let n = Self::POINTS as f64;
        let shape = |i: usize| i as f64 / n * (1.0 - i as f64 / n);
        let mode = |k: usize, f: &dyn Fn(usize) -> f64| {
            let wave = |i: usize| (std::f64::consts::PI * (i * k) as f64 / n).sin();
            (1..Self::POINTS).map(|i| (2.0 / n).sqrt() * wave(i) * f(i)).sum()
        };
        Self {
            ones: (1..Self::POINTS).map(|k| mode(k, &|_| 1.0)).collect(),
            bump: (1..Self::POINTS).map(|k| mode(k, &shape)).collect(),
            sum: (1..Self::POINTS).map(shape).sum(),
        }
    }

    fn exact(&self, t: f64) -> Vec<f64> {
        self.bump.iter().map(|x| x * t.exp()).collect()
    }
}

impl System for Mean {
    fn dim(&self) -> usize {
        Self::POINTS - 1
    }
}

impl VectorField<f64> for Mean {
    fn eval(&self, t: f64, u: &[f64], du: &mut [f64]) {
        self.nonlinear(t, u, du);
        let mut lambda = vec![0.0; u.len()];
        self.linear(&mut lambda);
        du.iter_mut().zip(lambda.iter().zip(u)).for_each(|(rate, (l, x))| *rate += l * x);
    }
}

impl Semilinear<f64> for Mean {
    fn linear(&self, lambda: &mut [f64]) {
        let n = Self::POINTS as f64;
        for (k, rate) in lambda.iter_mut().enumerate() {
            *rate = -(2.0 * n * (0.5 * std::f64::consts::PI * (k as f64 + 1.0) / n).sin()).powi(2);
        }
    }

    fn nonlinear(&self, t: f64, u: &[f64], du: &mut [f64]) {
        let n = Self::POINTS as f64;
        let mean = u.iter().zip(&self.ones).map(|(x, one)| x * one).sum::<f64>() / n;
        for (k, rate) in du.iter_mut().enumerate() {
            *rate = self.ones[k] * (mean + t.exp() * (2.0 - self.sum / n)) + t.exp() * self.bump[k];
        }
    }
}

/// hochbruck4 keeps its order where a stiff nonlinearity couples slow and fast modes, krogstad4 loses one (3.1 measured): as its authors
/// find for the same equation (Hochbruck and Ostermann 2005, section 6).
#[test]
fn order_four_is_kept_under_a_stiff_nonlinearity() {
    let field = Mean::new();
    let order = |tableau| {
        let run = |steps| errors(&field, tableau, (steps, 1.0), &|t| field.exact(t)).0;
        let points: Vec<_> = [16, 32, 64].map(|steps| (1.0 / f64::from(steps), run(steps))).into();
        println!("{}: order {:.2}, {points:?}", tableau.name, slope(&points));
        slope(&points)
    };
    assert!(order(&HOCHBRUCK4) > 3.75 && order(&KROGSTAD4) < 3.4);
}

#[test]
fn adaptive_steps_meet_the_tolerance_and_reuse_their_tables() {
    let exact = reference(1.0, 1).pop().unwrap();
    for tableau in EXPONENTIAL_STEPPERS.into_iter().filter(|tableau| tableau.is_adaptive()) {
        let mut points = Vec::new();
        for rtol in [1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
            let control = StepControl::Adaptive { rtol, atol: rtol };
            let mut orbit = ExponentialOrbit::new(&Modes, tableau, control, 0.0, &start()).unwrap();
            let outcome = drive(&mut orbit, &Request::until(1.0, Modes::COUNT), &mut ()).unwrap();
            assert!(outcome.is_complete());
            let error = distance(orbit.state(), &exact);
            assert!(error < 10.0 * rtol, "{} at {rtol:e}: {error:e}", tableau.name);
            points.push((orbit.counters().steps as f64, error));
        }
        // error ~ steps^-4
        assert!((slope(&points) + 4.0).abs() < 0.5, "{}: {points:?}", tableau.name);
    }
}

#[test]
fn sections_are_located_on_the_orbit_itself() {
    let g = |_t: f64, u: &[f64]| u[0];
    for terminal in [false, true] {
        let sections = [Section { g: &g, direction: Direction::Rising, terminal }];
        let mut times = Vec::new();
        for control in [StepControl::Fixed { step: 0.01 }, StepControl::Adaptive { rtol: 1e-10, atol: 1e-12 }]
        {
            let mut orbit =
                ExponentialOrbit::new(&StuartLandau, &KROGSTAD4, control, 0.0, &stuart_landau(0.0)).unwrap();
            let mut found = Trajectory::new(2);
            let request = Request { sections: &sections, ..Request::until(6.0, 2) };
            let outcome = drive(&mut orbit, &request, &mut found).unwrap();
            assert_eq!(terminal, matches!(outcome, Outcome::Stopped { .. }));
            assert!(found.crossings().iter().all(|c| c.state[0].abs() < 1e-13 && c.rising));
            let t = found.crossings()[0].t;
            assert!(stuart_landau(t)[0].abs() < 1e-6 && (!terminal || orbit.t() == t));
            // and it goes on from there
            let end = orbit.t() + 0.1;
            orbit.advance(end).unwrap();
            times.push(t);
        }
        assert!((times[0] - times[1]).abs() < 1e-6, "{times:?}");
    }
}

#[test]
fn bad_input_is_refused_and_overflow_is_an_outcome() {
    let adaptive = StepControl::Adaptive { rtol: 1e-6, atol: 1e-6 };
    let [ifrk4, ..] = EXPONENTIAL_STEPPERS;
    let refused = ExponentialOrbit::new(&StuartLandau, ifrk4, adaptive, 0.0, &[1.0, 0.0]).err();
    assert_eq!(refused, Some(Error::NoErrorEstimate { stepper: "ifrk4" }));
    let refused = ExponentialOrbit::new(&StuartLandau, &KROGSTAD4, adaptive, 0.0, &[1.0]).err();
    assert!(matches!(refused, Some(Error::Shape { expected: 2, got: 1, .. })));
    for control in [StepControl::Fixed { step: 0.5 }, adaptive] {
        let mut start = vec![0.0; Modes::COUNT];
        start[0] = 1e200;
        let mut orbit = ExponentialOrbit::new(&Modes, &KROGSTAD4, control, 0.0, &start).unwrap();
        let request = Request { escape_norm: 1e250, ..Request::until(1.0, Modes::COUNT) };
        let outcome = drive(&mut orbit, &request, &mut ()).unwrap();
        assert!(!outcome.is_complete() && orbit.state().iter().all(|x| x.is_finite()), "{outcome}");
    }
}

/// `u' = -u` has decayed to 1e-287 at 660 and to 1e-295 at 680: the one is what it is, the other 0, and not a
/// number that every operation is slow with.
#[test]
fn what_has_decayed_to_the_least_numbers_is_0() {
    struct Decay;
    impl System for Decay {
        fn dim(&self) -> usize {
            1
        }
    }
    impl<T: Scalar> VectorField<T> for Decay {
        fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
            du[0] = -u[0];
        }
    }
    impl<T: Scalar> Semilinear<T> for Decay {
        fn linear(&self, lambda: &mut [T::Real]) {
            lambda[0] = lambda[0].constant(-1.0);
        }
        fn nonlinear(&self, _t: T::Real, u: &[T], du: &mut [T]) {
            du[0] = u[0].constant(0.0);
        }
    }
    let control = StepControl::Fixed { step: 1.0 };
    let mut orbit = ExponentialOrbit::new(&Decay, &KROGSTAD4, control, 0.0, &[1.0]).unwrap();
    drive(&mut orbit, &Request::until(660.0, 1), &mut ()).unwrap();
    assert!((orbit.state()[0] / (-660.0_f64).exp() - 1.0).abs() < 1e-10, "{:e}", orbit.state()[0]);
    drive(&mut orbit, &Request::until(680.0, 1), &mut ()).unwrap();
    assert_eq!(orbit.state(), [0.0]);
}
