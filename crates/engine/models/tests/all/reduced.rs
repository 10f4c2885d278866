//! The formulas of the reduced model against Newton's method and numerical eigenvalues, and against classified motions.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_analysis::{RelativeEquilibrium, Settings, classify};
use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::{DOP853, Method};
use motiform_dynamics::{Orbit, Request, StepControl, Trajectory};
use motiform_models::tensor::reduced::{Line, Motion, Reduced};
use motiform_models::tensor::{Tensor, TensorParameters};

/// The paper's couplings, and others of the same signs.
const COUPLINGS: [Reduced; 3] =
    [Reduced::PAPER, Reduced { a1: 0.7, b1: 0.9, b3: 1.4 }, Reduced { a1: 1.3, b1: 0.3, b3: 0.6 }];

fn model(reduced: &Reduced, kappa2: f64, gamma: f64) -> Tensor {
    let Reduced { a1, b1, b3 } = *reduced;
    Tensor::new(&TensorParameters { kappa2, gamma, kappa3: 10.0, a1, b1, b3, ..TensorParameters::default() })
}

/// The equilibrium that Newton's method finds from the formula's state: it must be that state.
fn newton(model: &Tensor, state: [f64; 4]) -> RelativeEquilibrium {
    let guess = [state[0], state[1], state[2], state[3], 0.0, 0.0];
    let found = RelativeEquilibrium::find(model, &guess).unwrap();
    let off = found.shape.iter().zip(guess).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    assert!(off < 1e-9, "{state:?}: {found:?}");
    found
}

fn places() -> impl Iterator<Item = (f64, f64)> {
    let kappas = (-11..=11).map(|i| 0.0203 * f64::from(i));
    kappas.flat_map(|kappa2| (-10..=10).map(move |j| (kappa2, 0.0151 * f64::from(j) + 1e-4)))
}

#[test]
fn straight_and_circular_states_are_equilibria_with_these_eigenvalues() {
    let (mut straight, mut circular) = (0, 0);
    for reduced in &COUPLINGS {
        for (kappa2, gamma) in places() {
            let model = model(reduced, kappa2, gamma);
            for state in reduced.straight(kappa2, gamma).iter().filter(|state| state.speed > 1e-3) {
                let found = newton(&model, [state.speed, 0.0, state.s, 0.0]);
                let off = (found.growth() - state.growth).abs();
                assert!(off < 1e-8, "{reduced:?} {kappa2} {gamma} {state:?}: {found:?}");
                straight += 1;
            }
            let Some(state) = reduced.circular(kappa2, gamma) else { continue };
            if 1.0 - state.cos_psi.abs() < 1e-3 {
                continue; // about to merge with the straight motion
            }
            let sine = (1.0 - state.cos_psi * state.cos_psi).sqrt();
            let found = newton(&model, [state.speed, 0.0, state.r2 * state.cos_psi, state.r2 * sine]);
            assert!((found.turning_rate.abs() - state.turning_rate).abs() < 1e-9);
            assert_eq!(state.stable, found.growth() < 0.0, "{reduced:?} {kappa2} {gamma}: {found:?}");
            circular += 1;
        }
    }
    println!("{straight} straight, {circular} circular");
    assert!(straight > 600 && circular > 300);
}

/// With `8 b3 = 1` and `b1 = 4`, straight motions are the roots of `s^3 + (kappa2 + 2 a1) s - gamma`.
#[test]
fn straight_motions_are_roots_of_a_cubic() {
    let of = |a1: f64, kappa2: f64, gamma: f64| {
        let all = Reduced { a1, b1: 4.0, b3: 0.125 }.straight(kappa2, gamma);
        all.iter().map(|state| state.s).collect::<Vec<f64>>()
    };
    // (s + 2)(s + 1)(s - 3) = s^3 - 7 s - 6
    let three = of(0.5, -8.0, 6.0);
    assert!(
        three.len() == 3 && three.iter().zip([-2.0, -1.0, 3.0]).all(|(x, y)| (x - y).abs() < 1e-14),
        "{three:?}"
    );
    // (s - 2)(s^2 + 2 s + 5) = s^3 + s - 10
    let one = of(0.5, 0.0, 10.0);
    assert!(one.len() == 1 && (one[0] - 2.0).abs() < 1e-15, "{one:?}");
    // s^3 + .001 s - 1e-12: no digits are lost
    let small = of(libm::exp2(-12.0), 1e-3 - libm::exp2(-11.0), 1e-12);
    assert!(small.len() == 1 && (small[0] / 1e-9 - 1.0).abs() < 1e-13, "{small:?}");
}

#[test]
fn the_ellipse_at_rest_has_the_saddle_rates() {
    for reduced in &COUPLINGS {
        for (kappa2, gamma) in places().filter(|place| place.0 < 0.0) {
            let r2 = reduced.ellipse(kappa2).unwrap();
            let found = newton(&model(reduced, kappa2, gamma), [0.0, 0.0, r2, 0.0]);
            let [out, inward] = reduced.saddle_rates(kappa2, gamma).unwrap();
            for rate in [out, inward, 2.0 * kappa2] {
                let near = found.eigenvalues.iter().map(|value| (value.0 - rate).abs()).fold(1.0, f64::min);
                assert!(near < 1e-10, "{rate}: {found:?}");
            }
        }
    }
}

/// On a line the growth rate of what loses its stability is zero.
#[test]
fn lines_are_where_growth_rates_vanish() {
    for reduced in &COUPLINGS {
        for i in 1..40 {
            let part = f64::from(i) / 40.0;
            let [kappa2, gamma] = reduced.straight_to_circular(0.1 * part);
            let states = reduced.straight(kappa2, gamma);
            assert!(states.iter().any(|state| state.growth.abs() < 1e-12), "{states:?}");
            let [kappa2, gamma] = reduced.straight_hopf(-0.5 * 0.25 * reduced.b1 * 0.9 * part);
            let states = reduced.straight(kappa2, gamma);
            let along = |s: f64, speed: f64| -2.0 * speed * speed - kappa2 - 24.0 * reduced.b3 * s * s;
            assert!(states.iter().any(|state| along(state.s, state.speed).abs() < 1e-12), "{states:?}");
            let [kappa2, gamma] = reduced.circular_hopf(4e-3 * part);
            let state = reduced.circular(kappa2, gamma).unwrap();
            let sine = (1.0 - state.cos_psi * state.cos_psi).sqrt();
            let shape = [state.speed, 0.0, state.r2 * state.cos_psi, state.r2 * sine];
            let found = newton(&model(reduced, kappa2, gamma), shape);
            assert!(found.growth().abs() < 1e-9, "{found:?}");
        }
    }
}

/// Least and largest speed of the orbit that begins 2 % off the straight motion, `beyond` (in gamma) the Hopf line at the ellipse
/// `s`; it stays mirror symmetric.
fn speeds_beyond_hopf(s: f64, beyond: f64) -> [f64; 2] {
    let [kappa2, gamma] = Reduced::PAPER.straight_hopf(s);
    let model = model(&Reduced::PAPER, kappa2, gamma + beyond);
    let start = [1.02 * (gamma - 2.0 * s).sqrt(), 0.0, s, 0.0, 0.0, 0.0];
    let control = StepControl::Adaptive { rtol: 1e-9, atol: 1e-30 };
    let mut orbit = Orbit::new(&model, &DOP853, control, 0.0, &start).unwrap();
    drive(&mut orbit, &Request::until(100_000.0, 6), &mut ()).unwrap();
    let mut path = Trajectory::new(6);
    let request = Request { sample_every: Some(1.0), ..Request::until(102_000.0, 6) };
    drive(&mut orbit, &request, &mut path).unwrap();
    let speeds = path.iter().map(|(_, u)| u[0].abs());
    speeds.fold([f64::INFINITY, 0.0], |[low, high], v| [low.min(v), high.max(v)])
}

/// Below 0 the oscillation grows out of the straight motion like the square root of the distance (2 at four times the distance, to
/// 10 %: the next order); above 0 the orbit leaves for good, to the ellipse at rest. Measured zero: kappa2 = -0.0669.
#[test]
fn the_sign_of_the_criticality_is_the_kind_of_the_bifurcation() {
    for s in [-0.0242, -0.03, -0.034] {
        assert!(Reduced::PAPER.straight_hopf_criticality(s) < 0.0, "{s}");
        let swing =
            |beyond: f64| speeds_beyond_hopf(s, beyond).into_iter().rev().reduce(|a, b| a - b).unwrap();
        let growth = swing(4e-4) / swing(1e-4);
        println!("s = {s}: {growth}");
        assert!((growth / 2.0 - 1.0).abs() < 0.1, "{s}: {growth}");
    }
    for s in [-0.042, -0.0456] {
        assert!(Reduced::PAPER.straight_hopf_criticality(s) > 0.0, "{s}");
        assert!(speeds_beyond_hopf(s, 1e-4)[1] < 1e-9, "{s}");
    }
    assert!((Reduced::PAPER.bautin().unwrap()[0] + 0.0669).abs() < 1e-4);
}

#[test]
fn the_papers_quasi_periodic_line_is_straight() {
    for i in 1..40 {
        let [kappa2, gamma] = Reduced::PAPER.circular_hopf(1e-3 * f64::from(i) / 40.0);
        assert!((gamma + 0.4 * kappa2).abs() < 1e-14, "{kappa2} {gamma}");
    }
}

/// For other couplings the line bends, and where it ends there is nothing: it never jumps to another root.
#[test]
fn lines_of_other_couplings_are_smooth() {
    let (kappa2, gamma) = ((-0.6, 0.3), (-0.2, 0.4));
    for a1 in [0.3, 0.5, 0.8, 0.95, 1.0, 1.05, 1.3, 1.9] {
        let reduced = Reduced { a1, ..Reduced::PAPER };
        let points = reduced.line(Line::CircularToQuasiPeriodic, kappa2, gamma, 600);
        assert!(points.len() > 3, "{a1}: {}", points.len());
        let steps: Vec<[f64; 2]> =
            points.windows(2).map(|pair| [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]]).collect();
        for pair in steps.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let (dot, sizes) = (a[0] * b[0] + a[1] * b[1], a[0].hypot(a[1]) * b[0].hypot(b[1]));
            assert!(dot > 0.9 * sizes, "{a1}: {a:?} {b:?}");
        }
        for point in points.iter().skip(1).step_by(40) {
            let state = reduced.circular(point[0], point[1]).unwrap();
            let sine = (1.0 - state.cos_psi * state.cos_psi).sqrt();
            let shape = [state.speed, 0.0, state.r2 * state.cos_psi, state.r2 * sine];
            let found = newton(&model(&reduced, point[0], point[1]), shape);
            assert!(found.growth().abs() < 1e-8, "{a1} {point:?} {found:?}");
        }
    }
}

#[test]
fn lines_stay_near_the_box() {
    let (kappa2, gamma) = ((-0.22, 0.22), (-0.16, 0.12));
    for line in Line::ALL {
        let points = Reduced::PAPER.line(line, kappa2, gamma, 400);
        println!("{line:?}: {} points, {:?} to {:?}", points.len(), points.first(), points.last());
        assert!(points.len() > 30);
    }
    assert!(Reduced::PAPER.line(Line::CircleToStraight, (-1.0, -0.5), gamma, 50).is_empty());
}

/// Points of every line are found again by their `kappa2`; beyond their ends there are none.
#[test]
fn lines_are_found_by_kappa2() {
    let reduced = Reduced::PAPER;
    for x in [0.003, 0.011, 0.027] {
        let again = |line, x: f64, [kappa2, gamma]: [f64; 2]| {
            let found = reduced.on_line(line, kappa2).unwrap();
            assert!((found.0 - x).abs() < 1e-12 && (found.1 - gamma).abs() < 1e-12, "{line:?} {x} {found:?}");
        };
        again(Line::EllipseToStraight, x, reduced.ellipse_to_straight(x));
        again(Line::StraightToCircular, x, reduced.straight_to_circular(x));
        again(Line::StraightHopf, -x, reduced.straight_hopf(-x));
        again(Line::CircularToQuasiPeriodic, x * x, reduced.circular_hopf(x * x));
        again(Line::CircleToStraight, x, [x, 0.0]);
    }
    assert_eq!(reduced.on_line(Line::CircleToEllipse, 0.1), None);
    assert_eq!(reduced.on_line(Line::StraightToCircular, 0.51), None); // 4 s - 8 s^2 is 1/2 at most
    assert!(reduced.on_line(Line::StraightToCircular, 0.49).is_some());
    for line in [Line::EllipseToStraight, Line::StraightHopf, Line::CircularToQuasiPeriodic] {
        assert_eq!(reduced.on_line(line, 0.1), None);
    }
}

/// A handful of places of each kind, classified.
#[test]
fn classified_motions_are_those_expected() {
    let settings = Settings {
        method: Method::find("dop853").unwrap(),
        control: StepControl::Adaptive { rtol: 1e-9, atol: 1e-12 },
        first_look: 200.0,
        budget: 4e4,
        escape_norm: 1e6,
        max_steps: 10_000_000,
    };
    let places = [
        (0.1, -0.05, Motion::Motionless),
        (-0.01, -0.12, Motion::Motionless),
        (0.18, 0.05, Motion::Straight),
        (-0.18, -0.1, Motion::Straight),
        (-0.1, 0.1, Motion::Circular),
        (-0.06, 0.02, Motion::QuasiPeriodic),
        (-0.1, -0.04, Motion::Rectangular),
    ];
    for (kappa2, gamma, motion) in places {
        let expected = Reduced::PAPER.expected(kappa2, gamma);
        assert!(expected.stable.contains(&motion), "{kappa2} {gamma}: {expected:?}");
        let model = model(&Reduced::PAPER, kappa2, gamma);
        let start = [0.01, 0.003, 0.008, -0.006, 0.0, 0.0];
        let verdict = classify(&model, &start, &settings, &()).unwrap().unwrap();
        assert!(expected.allows(verdict.regime.name()), "{kappa2} {gamma}: {verdict:?}");
    }
}
