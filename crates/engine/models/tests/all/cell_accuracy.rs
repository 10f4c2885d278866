//! Orbits of the active cell model: growth rates, known amplitudes, convergence, long runs, the reduction.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::{EXPONENTIAL_STEPPERS, ExponentialTableau, IFRK4, KROGSTAD4};
use motiform_dynamics::{
    ExponentialOrbit, InPlane, Integration, Outcome, Request, StepControl, System, VectorField,
};
use motiform_models::cell::reduction::{Slaved, amplitudes, modes, reduce};
use motiform_models::cell::{Cell, CellParameters};
use motiform_models::tensor::FourierField;
use std::f64::consts::TAU;

fn cell(length: f64, modes: f64) -> Cell {
    Cell::new(&CellParameters { length, modes, ..Default::default() }).unwrap()
}

/// The state after `span` at a fixed step.
fn fixed(cell: &Cell, tableau: &'static ExponentialTableau, start: &[f64], step: f64, span: f64) -> Vec<f64> {
    let mut orbit = ExponentialOrbit::new(cell, tableau, StepControl::Fixed { step }, 0.0, start).unwrap();
    let outcome = drive(&mut orbit, &Request::until(span, cell.dim()), &mut ()).unwrap();
    assert!(outcome.is_complete(), "{outcome}");
    orbit.state().to_vec()
}

/// A shape on the irregular motion at length 21.6, of 42 modes.
fn irregular(cell: &Cell) -> Vec<f64> {
    let mut start = vec![0.0; cell.dim()];
    (start[0], start[3], start[4]) = (0.05, -0.05, 0.025);
    fixed(cell, &KROGSTAD4, &start, 0.02, 200.0)
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn growth_rates_are_k4_minus_k6() {
    for length in [6.0, 7.0, 14.4, 21.6, 29.2] {
        for n in 1..=6 {
            for tableau in EXPONENTIAL_STEPPERS {
                let cell = cell(length, 21.0);
                let mut start = vec![0.0; cell.dim()];
                start[2 * n - 2] = 1e-12;
                let k = TAU * n as f64 / length;
                let rate = k.powi(4) - k.powi(6);
                let span = 1.0 / rate.abs().max(0.1);
                let end = fixed(&cell, tableau, &start, 0.05 * span, span);
                let measured = (end[2 * n - 2] / 1e-12).ln() / span;
                assert!((measured - rate).abs() < 1e-8, "{length} {n} {}: {measured} {rate}", tableau.name);
            }
        }
    }
}

/// Amplitudes measured by independent programs before this one: 2.944 and 3.22.
#[test]
fn saturated_amplitudes() {
    let seven = cell(7.0, 16.0);
    let mut start = vec![0.0; seven.dim()];
    (start[0], start[1]) = (0.01, 0.02);
    let end = fixed(&seven, &KROGSTAD4, &start, 0.1, 500.0);
    assert!((2.0 * end[0].hypot(end[1]) - 2.944).abs() < 1e-3, "{}", 2.0 * end[0].hypot(end[1]));

    let pure = cell(14.4, 16.0);
    let mut start = vec![0.0; pure.dim()];
    start[2] = 0.01;
    let end = fixed(&pure, &KROGSTAD4, &start, 0.1, 1000.0);
    assert!((2.0 * end[2].abs() - 3.22).abs() < 5e-3, "{}", 2.0 * end[2]);
    assert!(end.chunks(2).step_by(2).all(|odd| odd == [0.0, 0.0]), "modes 1, 3, .. stay away");
}

/// Steps of `dt` and `dt/2` agree, and 21 modes (64 points) agree with 42 (128 points).
///
/// The shortest waves have `h k^6 >> 1`, so the orders are the stiff ones, between 2 and 3 (Hochbruck and Ostermann 2005,
/// SIAM J. Numer. Anal. 43, 1069; hochbruck4 too: the nonlinearity has five derivatives of the six,
/// docs/records/convolution.md), and not the 4 of `engine/dynamics/tests/all/exponential.rs`; the errors are small
/// all the same.
#[test]
fn orbits_converge_in_time_and_space() {
    let fine = cell(21.6, 42.0);
    let start = irregular(&fine);
    for (tableau, order, largest) in EXPONENTIAL_STEPPERS
        .into_iter()
        .zip([(1.0, 1e-2), (2.0, 1e-6), (2.3, 1e-7), (2.3, 1e-7)])
        .map(|(t, (o, l))| (t, o, l))
    {
        let ends: Vec<_> = [0.2, 0.1, 0.05].map(|step| fixed(&fine, tableau, &start, step, 4.0)).into();
        let (coarse, half) = (distance(&ends[0], &ends[1]), distance(&ends[1], &ends[2]));
        println!("{}: {coarse:.2e} {half:.2e}, order {:.2}", tableau.name, (coarse / half).log2());
        assert!((coarse / half).log2() > order && half < largest, "{}: {coarse:e} {half:e}", tableau.name);
    }
    let coarse = cell(21.6, 21.0);
    let end = fixed(&fine, &KROGSTAD4, &start, 0.01, 4.0);
    let other = fixed(&coarse, &KROGSTAD4, &start[..coarse.dim()], 0.01, 4.0);
    let difference = distance(&end[..coarse.dim()], &other);
    println!("21 against 42 modes: {difference:.2e}");
    assert!(difference < 1e-9, "{difference:e}");
}

/// The mean of phi(s) stays, to round-off, over t = 1e4 of irregular motion.
#[test]
fn mean_of_phi_is_conserved() {
    let cell = cell(21.6, 21.0);
    let start: Vec<f64> = irregular(&cell);
    let end = fixed(&cell, &KROGSTAD4, &start, 0.05, 1e4);
    let mean = |u: &[f64]| cell.phi(u, 64).iter().sum::<f64>() / 64.0;
    assert!(end.iter().all(|x| x.is_finite()) && (mean(&end) - mean(&start)).abs() < 1e-15);
}

/// A complex transform would let the anti-Hermitian part grow by exp(sigma t) and overflow at t = 434: it has no place
/// here, and the fixed shape stays fixed for t = 1e5.
#[test]
fn nothing_grows_behind_the_scenes() {
    let cell = cell(7.0, 16.0);
    let mut start = vec![0.0; cell.dim()];
    (start[0], start[1]) = (0.01, 0.02);
    let early = fixed(&cell, &KROGSTAD4, &start, 0.25, 1e3);
    let late = fixed(&cell, &KROGSTAD4, &early, 0.25, 1e5);
    assert!(distance(&early, &late) < 1e-9, "{:e}", distance(&early, &late));
}

/// The position by quadrature is as accurate as the shape allows (order 2.3 to 3, see above), and agrees with
/// the velocity integrated by the stages of the method.
#[test]
fn position_by_quadrature_agrees_with_position_by_stages() {
    let cell = cell(21.6, 21.0);
    let mut start = irregular(&cell);
    start.extend([0.0; 2]);
    let dim = cell.dim();
    let body = InPlane(&cell);
    let position = |step: f64, staged: bool| {
        let control = StepControl::Fixed { step };
        let state = if staged {
            let mut orbit = ExponentialOrbit::new(&body, &KROGSTAD4, control, 0.0, &start).unwrap();
            drive(&mut orbit, &Request::until(5.0, dim), &mut ()).unwrap();
            orbit.state().to_vec()
        } else {
            let mut orbit = ExponentialOrbit::in_plane(&cell, &KROGSTAD4, control, 0.0, &start).unwrap();
            drive(&mut orbit, &Request::until(5.0, dim), &mut ()).unwrap();
            orbit.state().to_vec()
        };
        [state[dim], state[dim + 1]]
    };
    let exact = position(0.00625, true);
    let errors = [0.1, 0.05, 0.025].map(|step| distance(&position(step, false), &exact));
    let staged = [0.1, 0.05, 0.025].map(|step| distance(&position(step, true), &exact));
    println!("quadrature {errors:?}, stages {staged:?}, path {:e}", exact[0].hypot(exact[1]));
    assert!((errors[1] / errors[2]).log2() > 2.3, "{errors:?} {staged:?}");
    assert!(
        errors[2] < 2.0 * staged[2] && errors[0] < 1e-5 * exact[0].hypot(exact[1]),
        "{errors:?} {staged:?}"
    );
}

/// With a huge step the integrating factor overflows: an outcome, not a number.
#[test]
fn overflow_is_an_outcome() {
    let cell = cell(21.6, 21.0);
    let mut start = vec![0.0; cell.dim()];
    (start[0], start[3]) = (40.0, 30.0);
    let mut orbit =
        ExponentialOrbit::new(&cell, &IFRK4, StepControl::Fixed { step: 1.0 }, 0.0, &start).unwrap();
    let outcome = drive(&mut orbit, &Request::until(100.0, cell.dim()), &mut ()).unwrap();
    assert!(matches!(outcome, Outcome::Escaped { .. }), "{outcome}");
}

/// Three modes of the cell are the tensor model, term by term: for any g4, g5.
#[test]
fn three_modes_are_the_tensor_model() {
    for (g4, g5) in [(0.0, -1.0), (0.7, -1.0), (-0.4, 0.6)] {
        let p = CellParameters { length: 6.0, modes: 3.0, g4, g5, ..Default::default() };
        let full = Cell::new(&p).unwrap();
        let shape = [0.3, -0.2, 0.25, 0.1, -0.15, 0.05];
        let (mut rate, mut reduced) = ([0.0; 6], [0.0; 6]);
        VectorField::<f64>::eval(&full, 0.0, &shape, &mut rate);
        FourierField::all(reduce(&p, Slaved::Nothing)).eval(0.0, &amplitudes(&shape), &mut reduced);
        assert!(distance(&modes(&reduced), &rate) < 1e-14, "{:?} {rate:?}", modes(&reduced));
    }
}

/// With mode 4 slaved, `phi_4 = A phi_2^2 + B phi_1 phi_3`, the reduced rates of modes 1 to 3 are those of the full field there: A and B
/// from the mode form, `(2 sigma_2 - sigma_4) A = -32 i k^5`, `(sigma_1 + sigma_3 - sigma_4) B = -36 i k^5`.
#[test]
fn the_slaved_fourth_mode_acts_back_as_in_the_full_field() {
    let p = CellParameters { length: 14.0, modes: 7.0, ..Default::default() };
    let full = Cell::new(&p).unwrap();
    let k = TAU / p.length;
    let sigma = |n: f64| (k * n).powi(4) - (k * n).powi(6);
    let a = -32.0 * k.powi(5) / (2.0 * sigma(2.0) - sigma(4.0));
    let b = -36.0 * k.powi(5) / (sigma(1.0) + sigma(3.0) - sigma(4.0));
    let times = |x: [f64; 2], y: [f64; 2]| [x[0] * y[0] - x[1] * y[1], x[0] * y[1] + x[1] * y[0]];
    let mut shape = vec![0.0; full.dim()];
    shape[..6].copy_from_slice(&[0.3, -0.2, 0.25, 0.1, -0.15, 0.05]);
    let [one, two, three] = [0, 2, 4].map(|i| [shape[i], shape[i + 1]]);
    let (square, mixed) = (times(two, two), times(one, three));
    let sum = [a * square[0] + b * mixed[0], a * square[1] + b * mixed[1]];
    (shape[6], shape[7]) = (-sum[1], sum[0]); // times i
    let (mut rate, mut reduced) = (vec![0.0; full.dim()], [0.0; 6]);
    VectorField::<f64>::eval(&full, 0.0, &shape, &mut rate);
    FourierField::all(reduce(&p, Slaved::Fourth)).eval(0.0, &amplitudes(&shape[..6]), &mut reduced);
    assert!(distance(&modes(&reduced), &rate[..6]) < 1e-14, "{:?} {:?}", modes(&reduced), &rate[..6]);
}

/// On the slow manifold near 4 pi the error of the reduced flow falls with the stated power of the amplitude.
#[test]
fn slaved_modes_follow_to_the_stated_order() {
    let p = CellParameters { length: 2.0 * TAU + 0.1, modes: 10.0, ..Default::default() };
    let full = Cell::new(&p).unwrap();
    // errors of w1', w2' by leading order: truncated to modes 1-3, w3 free, w4 = 0: cubic; slaved: quartic and beyond
    let error = |slaved: Slaved, size: f64| {
        let mut start = vec![0.0; full.dim()];
        start[..4].copy_from_slice(&[0.8 * size, 0.3 * size, -0.5 * size, 0.6 * size]);
        // let the fast modes find their manifold
        let start = fixed(&full, &KROGSTAD4, &start, 0.05, 5.0);
        let mut rate = vec![0.0; full.dim()];
        VectorField::<f64>::eval(&full, 0.0, &start, &mut rate);
        let mut w = amplitudes(&start[..6]);
        if slaved == Slaved::ThirdAndFourth {
            (w[4], w[5]) = (0.0, 0.0);
        }
        let mut reduced = [0.0; 6];
        FourierField::all(reduce(&p, slaved)).eval(0.0, &w, &mut reduced);
        distance(&modes(&reduced)[..4], &rate[..4])
    };
    for (slaved, order) in [(Slaved::Nothing, 3.0), (Slaved::Fourth, 4.0), (Slaved::ThirdAndFourth, 4.0)] {
        let (large, small) = (error(slaved, 0.1), error(slaved, 0.05));
        println!("{slaved:?}: {large:.2e} {small:.2e} order {:.2}", (large / small).log2());
        assert!((large / small).log2() > order - 0.2, "{slaved:?}: {large:e} {small:e}");
    }
}

/// Growth rates of mode 1 on the pure mode 2 (`lambda_+-`), measured on the full model.
fn rates_on_the_pure_mode(length: f64) -> [f64; 2] {
    let cell = cell(length, 10.0);
    let mut pure = vec![0.0; cell.dim()];
    pure[3] = 1.0; // phi_2 = i w2, w2 > 0
    let pure = fixed(&cell, &KROGSTAD4, &pure, 0.1, 2000.0);
    [0, 1].map(|part| {
        let mut start = pure.clone();
        start[part] = 1e-9;
        let early = fixed(&cell, &KROGSTAD4, &start, 0.1, 30.0);
        let late = fixed(&cell, &KROGSTAD4, &early, 0.1, 10.0);
        (late[part] / early[part]).ln() / 10.0
    })
}

/// The same from the reduction: `sigma_1 + d12 r^2 +- e11 r`, `r^2 = -sigma_2 / d22`.
fn reduced_rates(length: f64) -> [f64; 2] {
    let c = reduce(&CellParameters { length, ..Default::default() }, Slaved::ThirdAndFourth);
    let r = (c.kappa2 / c.d22).sqrt();
    let mean = c.gamma + c.d12 * r * r;
    [mean + c.e11 * r, mean - c.e11 * r]
}

/// The zero of a function of the length, by bisection.
fn edge(f: &dyn Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    assert!(f(low) * f(high) < 0.0, "{} {}", f(low), f(high));
    for _ in 0..12 {
        let middle = 0.5 * (low + high);
        if f(middle) * f(low) > 0.0 { low = middle } else { high = middle }
    }
    low
}

/// Rectangular motion: from `lambda_+ + lambda_- = 0` (the cycle attracts) to `lambda_+ = 0` (the ellipse does); the
/// window seen in runs is 13.0 to 14.6 (rests near the upper edge outlast any run).
#[test]
fn reduction_predicts_the_edges_of_rectangular_motion() {
    let sum = |[plus, minus]: [f64; 2]| plus + minus;
    let full = [
        edge(&|length| sum(rates_on_the_pure_mode(length)), 12.7, 13.6),
        edge(&|length| rates_on_the_pure_mode(length)[0], 13.8, 15.2),
    ];
    let reduced = [
        edge(&|length| sum(reduced_rates(length)), 12.6, 14.0),
        edge(&|length| reduced_rates(length)[0], 13.0, 16.5),
    ];
    println!("edges: full {full:.3?}, reduced {reduced:.3?}");
    assert!((12.8..13.1).contains(&full[0]) && (14.6..15.0).contains(&full[1]), "{full:?}");
    assert!((full[0] - reduced[0]).abs() < 0.1, "{full:?} {reduced:?}");
    assert!((full[1] - reduced[1]).abs() < 0.8, "{full:?} {reduced:?}");
}
