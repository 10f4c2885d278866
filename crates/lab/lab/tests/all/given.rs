//! Fields given from outside: exact solutions, the bits of a built-in model, blow-up as a value, exponents.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_dynamics::{Direction, InPlane, Model, Outcome, Section, StepControl, VectorField};
use motiform_lab::given::{Flow, Given, Settings, Span, exponents, record, tracks};
use motiform_lab::simulate::simulate;
use motiform_models::zoo::Lorenz;
use motiform_study::study::RunSettings;
use motiform_study::{RunPlan, presets};

/// A function of Rust as one given from outside, with its Jacobian or without.
struct Function<F, J> {
    dim: usize,
    rates: F,
    jacobian: J,
}

impl<F, J> Given for Function<F, J>
where
    F: Fn(f64, &[f64], &[f64], &mut [f64]) + Send + Sync,
    J: Fn(&[f64], &[f64], &mut [f64]) -> bool + Send + Sync,
{
    fn dim(&self) -> usize {
        self.dim
    }

    fn rates(&self, t: f64, x: &[f64], parameters: &[f64], dx: &mut [f64]) {
        (self.rates)(t, x, parameters, dx);
    }

    fn jacobian(&self, _t: f64, x: &[f64], parameters: &[f64], matrix: &mut [f64]) -> bool {
        (self.jacobian)(x, parameters, matrix)
    }
}

fn unknown(_: &[f64], _: &[f64], _: &mut [f64]) -> bool {
    false
}

/// `x' = -k x + cos t`.
fn driven() -> impl Given {
    let rates = |t: f64, x: &[f64], p: &[f64], dx: &mut [f64]| dx[0] = -p[0] * x[0] + t.cos();
    Function { dim: 1, rates, jacobian: unknown }
}

/// Its solution from `x` at time 0.
fn driven_exactly(t: f64, x: f64, k: f64) -> f64 {
    let forced = |t: f64| (k * t.cos() + t.sin()) / (k * k + 1.0);
    forced(t) + (x - forced(0.0)) * (-k * t).exp()
}

fn settings(flow: &Flow<'_>) -> Settings {
    Settings::new(&RunSettings { rtol: 1e-11, ..RunSettings::default() }, flow).unwrap()
}

fn span(transient: f64, t_end: f64, dt_out: f64) -> Span {
    Span { transient, t_end, dt_out }
}

#[test]
fn rows_lie_on_the_exact_solution() {
    let given = driven();
    let flow = Flow::new(&given, vec![0.7]);
    let found = record(&flow, &[2.0], &span(0.0, 20.0, 0.037), &settings(&flow), &[], &()).unwrap();
    assert!(found.ending.is_complete() && found.trajectory.len() == 541);
    for (t, x) in found.trajectory.iter() {
        assert!((x[0] - driven_exactly(t, 2.0, 0.7)).abs() < 1e-9, "{t}");
    }
    // A transient begins at a negative time.
    let start = driven_exactly(-5.0, 2.0, 0.7);
    let later = record(&flow, &[start], &span(5.0, 20.0, 0.5), &settings(&flow), &[], &()).unwrap();
    for (t, x) in later.trajectory.iter() {
        assert!((x[0] - driven_exactly(t, 2.0, 0.7)).abs() < 1e-9, "{t}");
    }
}

#[test]
fn a_built_in_model_has_the_same_bits() {
    let mut study = presets::find_any("fig5b", "tensor").unwrap();
    (study.run.t_end, study.run.transient) = (60.0, 0.0);
    let plan = RunPlan::new(&study).unwrap();
    let dataset = simulate(&plan, &()).unwrap();
    let model = plan.info().unwrap().build(&plan.computation.parameters.values()).unwrap();
    let body = InPlane(model.as_ref());
    let rates = |t: f64, x: &[f64], _: &[f64], dx: &mut [f64]| body.eval(t, x, dx);
    let given = Function { dim: model.dim() + 2, rates, jacobian: unknown };
    let start = start_of(&plan, model.as_ref());
    let flow = Flow::new(&given, vec![]);
    let settings = Settings::new(&study.run, &flow).unwrap();
    let span = span(0.0, 60.0, plan.computation.dt_out);
    let found = record(&flow, &start, &span, &settings, &[], &()).unwrap();
    let x = &dataset.trajectory.columns.iter().find(|column| column.name == "x").unwrap().values;
    let same: Vec<f64> = found.trajectory.iter().map(|(_, u)| u[u.len() - 2]).collect();
    assert_eq!(&same, x);
}

fn start_of(plan: &RunPlan, model: &dyn Model) -> Vec<f64> {
    let values = plan.computation.initial.values();
    let mut start = vec![0.0; model.dim()];
    model.encode(&values[..model.dim()], &mut start);
    start.extend_from_slice(&values[model.dim()..]);
    start
}

#[test]
fn a_blow_up_is_a_value_and_so_is_a_rate_that_is_no_number() {
    let square = |_: f64, x: &[f64], _: &[f64], dx: &mut [f64]| dx[0] = x[0] * x[0];
    let given = Function { dim: 1, rates: square, jacobian: unknown };
    let flow = Flow::new(&given, vec![]);
    let found = record(&flow, &[0.5], &span(0.0, 5.0, 0.1), &settings(&flow), &[], &()).unwrap();
    let Outcome::Escaped { t, singular: true, .. } = found.ending.outcome else { panic!("{}", found.ending) };
    assert!((t - 2.0).abs() < 1e-6 && found.trajectory.len() == 20, "{t}");

    let root = |_: f64, x: &[f64], _: &[f64], dx: &mut [f64]| dx[0] = -1.0 - 0.0 * x[0].sqrt();
    let given = Function { dim: 1, rates: root, jacobian: unknown };
    let flow = Flow::new(&given, vec![]);
    let found = record(&flow, &[1.0], &span(0.0, 5.0, 0.1), &settings(&flow), &[], &()).unwrap();
    assert!(matches!(found.ending.outcome, Outcome::StepUnderflow { t, .. } if t <= 1.0), "{}", found.ending);
}

#[test]
fn many_orbits_are_the_single_ones() {
    let given = driven();
    let members: Vec<_> = (0..17).map(|k| (vec![0.2 + 0.1 * f64::from(k)], vec![f64::from(k)])).collect();
    let (times, settings) = ([0.0, 1.0, 12.5], settings(&Flow::new(&given, vec![0.7])));
    let one = tracks(&given, &members, &times, &settings, 1, &()).unwrap().unwrap();
    assert_eq!(one, tracks(&given, &members, &times, &settings, 3, &()).unwrap().unwrap());
    for ((parameters, start), track) in members.iter().zip(&one) {
        for (t, state) in times.iter().zip(&track.states) {
            assert!((state[0] - driven_exactly(*t, start[0], parameters[0])).abs() < 1e-9);
        }
    }
}

/// FitzHugh and Nagumo's equations for `x / length` in the time `rate t`: after their time 50, the state in the unit of length.
fn nerve(length: f64, rate: f64) -> Vec<f64> {
    let rates = |_: f64, x: &[f64], p: &[f64], dx: &mut [f64]| {
        let (length, rate) = (p[0], p[1]);
        dx[0] = rate * (x[0] - x[0] * (x[0] / length) * (x[0] / length) / 3.0 - x[1] + 0.5 * length);
        dx[1] = 0.08 * rate * (x[0] + 0.7 * length - 0.8 * x[1]);
    };
    let given = Function { dim: 2, rates, jacobian: unknown };
    let flow = Flow::new(&given, vec![length, rate]);
    let settings = Settings::new(&RunSettings::default(), &flow).unwrap();
    let start = [0.1 * length, -0.2 * length];
    let found = record(&flow, &start, &span(0.0, 50.0 / rate, 0.0), &settings, &[], &()).unwrap();
    assert!(found.ending.is_complete(), "{length} {rate}: {}", found.ending);
    found.last.iter().map(|x| x / length).collect()
}

#[test]
fn an_orbit_is_the_same_in_other_units() {
    let expected = nerve(1.0, 1.0);
    for (length, rate) in [(1e-6, 1.0), (1e6, 1.0), (1e-9, 1e9), (1e9, 1e-9)] {
        let found = nerve(length, rate);
        let off = found.iter().zip(&expected).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(off < 1e-7, "{length} {rate}: {off:e}");
    }
}

#[test]
fn crossings_are_where_the_solution_crosses() {
    let turn = |_: f64, x: &[f64], p: &[f64], dx: &mut [f64]| (dx[0], dx[1]) = (p[0] * x[1], -p[0] * x[0]);
    let given = Function { dim: 2, rates: turn, jacobian: unknown };
    let flow = Flow::new(&given, vec![2.0]);
    let g = |_: f64, x: &[f64]| x[0];
    let sections = [Section { g: &g, direction: Direction::Rising, terminal: false }];
    let span = span(0.0, 10.0, f64::INFINITY);
    let found = record(&flow, &[-1.0, 0.0], &span, &settings(&flow), &sections, &()).unwrap();
    let times: Vec<f64> = found.trajectory.crossings().iter().map(|crossing| crossing.t).collect();
    assert!(found.trajectory.is_empty() && times.len() == 3);
    for (k, t) in times.iter().enumerate() {
        assert!((t - std::f64::consts::PI * (k as f64 + 0.25)).abs() < 1e-9, "{t}");
    }
}

#[test]
fn exponents_of_a_linear_flow_are_its_rates() {
    let rates = |_: f64, x: &[f64], p: &[f64], dx: &mut [f64]| {
        dx[0] = p[0] * x[0] + 3.0 * x[1];
        dx[1] = p[1] * x[1];
    };
    let given = Function { dim: 2, rates, jacobian: unknown };
    let flow = Flow::new(&given, vec![-0.2, -1.5]);
    let found = exponents(&flow, &[0.3, 0.4], 2, 20.0, 100.0, &settings(&flow), &()).unwrap();
    assert!((found.exponents[0].value + 0.2).abs() < 1e-9, "{:?}", found.exponents);
    assert!((found.exponents[1].value + 1.5).abs() < 1e-9, "{:?}", found.exponents);
}

#[test]
fn exponents_of_lorenz_agree_with_the_exact_tangent_flow() {
    let lorenz = Lorenz::default();
    let rates = |t: f64, x: &[f64], _: &[f64], dx: &mut [f64]| lorenz.eval(t, x, dx);
    let jacobian = |x: &[f64], _: &[f64], m: &mut [f64]| {
        let rows = [[-10.0, 10.0, 0.0], [28.0 - x[2], -1.0, -x[0]], [x[1], x[0], -8.0 / 3.0]];
        m.copy_from_slice(rows.as_flattened());
        true
    };
    let start = [1.0, 2.0, 20.0];
    // The same orbit as long as rounding has not grown: 20 time units of a growth of 0.9.
    let exact = Function { dim: 3, rates, jacobian };
    let flow = Flow::new(&exact, vec![]);
    let settings = settings(&flow);
    let exact = exponents(&flow, &start, 3, 5.0, 20.0, &settings, &()).unwrap();
    let differences = Function { dim: 3, rates, jacobian: unknown };
    let flow = Flow::new(&differences, vec![]);
    let near = exponents(&flow, &start, 3, 5.0, 20.0, &settings, &()).unwrap();
    for (a, b) in exact.exponents.iter().zip(&near.exponents) {
        assert!((a.value - b.value).abs() < 1e-5, "{a:?} {b:?}");
    }
    let trace: f64 = near.exponents.iter().map(|exponent| exponent.value).sum();
    assert!((trace + 10.0 + 1.0 + 8.0 / 3.0).abs() < 1e-7, "{trace}");
    let long = exponents(&flow, &start, 3, 50.0, 2000.0, &settings, &()).unwrap();
    assert!((long.exponents[0].value - 0.9056).abs() < 2.0 * long.exponents[0].error.max(0.01));
}

#[test]
fn what_cannot_be_computed_is_refused_with_the_reason() {
    let given = driven();
    let flow = Flow::new(&given, vec![1.0]);
    let text = |error: motiform_study::Error| error.to_string();
    let error = exponents(&flow, &[0.5], 1, 1.0, 10.0, &settings(&flow), &()).unwrap_err();
    assert!(text(error).contains("does not depend on the time"));
    let error = exponents(&flow, &[0.5], 2, 1.0, 10.0, &settings(&flow), &()).unwrap_err();
    assert!(text(error).contains("from 1 to 1"));
    let exponential = RunSettings { stepper: "krogstad4".into(), ..RunSettings::default() };
    assert!(text(Settings::new(&exponential, &flow).unwrap_err()).contains("linear part"));
    for (start, t_end, word) in
        [(vec![1.0, 2.0], 1.0, "start"), (vec![f64::NAN], 1.0, "start"), (vec![1.0], 0.0, "t_end")]
    {
        let Err(error) = record(&flow, &start, &span(0.0, t_end, 0.0), &settings(&flow), &[], &()) else {
            panic!()
        };
        assert!(text(error).contains(word));
    }
    let fixed =
        Settings::new(&RunSettings { stepper: "rk4".into(), ..RunSettings::default() }, &flow).unwrap();
    assert_eq!(fixed.control, StepControl::Fixed { step: 1e-3 });
}
