//! Every stepper has its stated order, at the ends of the steps and inside them, on a linear and a nonlinear problem.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{Lorentzian, Oscillator, StuartLandau, slope, stuart_landau};
use motiform_dynamics::steppers::{STEPPERS, Tableau};
use motiform_dynamics::{Integration, Orbit, StepControl, VectorField};

/// Largest error at the ends of the steps, and its root mean square inside them, for one fixed step size.
fn errors<F: VectorField<f64>>(
    field: &F,
    tableau: &'static Tableau,
    steps: u32,
    span: f64,
    exact: &dyn Fn(f64) -> Vec<f64>,
) -> (f64, f64) {
    let step = span / f64::from(steps);
    let mut orbit = Orbit::new(field, tableau, StepControl::Fixed { step }, 0.0, &exact(0.0)).unwrap();
    let mut state = exact(0.0);
    let (mut ends, mut inside): (f64, f64) = (0.0, 0.0);
    let distance =
        |state: &[f64], t: f64| state.iter().zip(exact(t)).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    while orbit.t() < span {
        orbit.advance(span).unwrap();
        ends = ends.max(distance(orbit.state(), orbit.t()));
        let dense = orbit.dense();
        let (start, end) = dense.span();
        for tenth in 1..10 {
            let fraction = f64::from(tenth) / 10.0;
            let t = start + fraction * (end - start);
            dense.at(t, &mut state);
            inside += distance(&state, t).powi(2) * (end - start) / 9.0;
        }
    }
    (ends, inside.sqrt())
}

fn check<F: VectorField<f64>>(
    name: &str,
    field: &F,
    span: f64,
    highest: (u32, u32),
    exact: &dyn Fn(f64) -> Vec<f64>,
) {
    for tableau in STEPPERS {
        // Steps where the leading term rules and round-off does not: errors between about 1e-2 and 1e-12. `highest`
        // is that range for order 8.
        let (fewest, doublings) = match tableau.order {
            1 => (512, 5),
            2 => (128, 5),
            4 => (64, 4),
            5 => (48, 3),
            _ => highest,
        };
        let runs: Vec<(f64, (f64, f64))> = (0..=2 * doublings)
            .map(|i| {
                let steps = (f64::from(fewest) * f64::powf(2.0, f64::from(i) / 2.0)).round() as u32;
                (span / f64::from(steps), errors(field, tableau, steps, span, exact))
            })
            .collect();
        let ends: Vec<_> = runs.iter().map(|&(h, (end, _))| (h, end)).collect();
        let inside: Vec<_> = runs.iter().map(|&(h, (_, inside))| (h, inside)).collect();
        let (at_ends, within) = (slope(&ends), slope(&inside));
        println!("{name:10} {:7} order {at_ends:.3}, dense {within:.3}", tableau.name);
        assert!((at_ends - f64::from(tableau.order)).abs() < 0.1, "{name} {}: order {at_ends}", tableau.name);
        let stated = f64::from(tableau.dense.order);
        assert!((within - stated).abs() < 0.1, "{name} {}: dense order {within}", tableau.name);
    }
}

#[test]
fn linear_problem() {
    check("linear", &Oscillator, 6.0, (14, 2), &|t| vec![t.cos(), -t.sin()]);
}

#[test]
fn nonlinear_problem() {
    check("nonlinear", &StuartLandau, 3.0, (40, 1), &stuart_landau);
}

/// A field that depends on time: the nodes `c_i` are used where they belong (order drops to 1 or 2 otherwise).
#[test]
fn driven_problem_converges() {
    for tableau in STEPPERS.into_iter().filter(|tableau| tableau.order >= 4) {
        let exact = |t: f64| vec![1.0 / (1.0 + t * t)];
        let (coarse, _) = errors(&Lorentzian, tableau, 40, 3.0, &exact);
        let (fine, _) = errors(&Lorentzian, tableau, 80, 3.0, &exact);
        let gain = (coarse / fine).log2();
        assert!(gain > f64::from(tableau.order) - 0.5, "{}: {gain}", tableau.name);
    }
}
