//! Where branches of orbits end at connections: saddles, saddle-foci, saddle-nodes on a circle.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::normal_forms::Lorenz;
use crate::common::near;
use crate::samples::draws;
use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_continuation::{
    Branch, Connection, ConnectionKind, End, Family, Joins, PeriodLaw, Point, Settings, Special, stated,
    switch,
};
use motiform_dynamics::{Equivariant, Request, Scalar, VectorField, drive::drive};
use motiform_models::tensor::{Tensor, TensorParameters};

type Body = Result<Box<dyn Equivariant>>;

/// The points of a branch of orbits and the connection at its end.
fn connection(
    family: &dyn Family,
    p: f64,
    guess: &PeriodicGuess<'_>,
    settings: &Settings,
) -> (Vec<Point>, Connection) {
    let body = family.at(p).expect("a body");
    let start = PeriodicOrbit::find(body.as_ref(), guess, &settings.flow, &()).expect("an orbit");
    let mut branch = Branch::of_orbits(family, p, &start, settings, &()).expect("it lies on a branch");
    let points = branch.by_ref().collect();
    let Some(End::Homoclinic(connection)) = branch.end() else { unreachable!("{:?}", branch.end()) };
    (points, connection.as_ref().clone())
}

/// Where the flow comes to after a time.
fn settled(body: &dyn Equivariant, start: &[f64], time: f64) -> Vec<f64> {
    let flow = Settings::over(0.0, 1.0).flow;
    let mut orbit = flow.method.shape_orbit(body, flow.control, 0.0, start).expect("a method");
    drive(orbit.as_mut(), &Request::until(time, start.len()), &mut ()).expect("it is sound");
    orbit.state().to_vec()
}

/// A pendulum driven by a torque, `theta'' = torque - damping theta' - sin theta`, with `(x, y) = (cos theta, sin theta)` held on the
/// circle by attraction.
///
/// At torque 1 saddle and node meet. With strong damping the whirling motion ends there; with weak damping before it, on the loop of a
/// saddle, at `torque = 4 damping / pi` to first order. Source: Strogatz (1994), Nonlinear Dynamics and Chaos, section 8.5.
struct Pendulum {
    torque: f64,
    damping: f64,
}
motiform_models::plain!(Pendulum, 3);
impl<T: Scalar> VectorField<T> for Pendulum {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, rate) = (u[0], u[1], u[2]);
        let off = x.constant(1.0) - x * x - y * y;
        du[0] = off * x - y * rate;
        du[1] = off * y + x * rate;
        du[2] = x.constant(self.torque) - rate * self.damping - y;
    }
}

/// The pendulum beside a variable that neither acts on it nor is acted on, `z' = -rate (z - 0.3)`.
struct Beside {
    pendulum: Pendulum,
    rate: f64,
}
motiform_models::plain!(Beside, 4);
impl<T: Scalar> VectorField<T> for Beside {
    fn eval(&self, t: T::Real, u: &[T], du: &mut [T]) {
        self.pendulum.eval(t, &u[..3], &mut du[..3]);
        du[3] = (u[3].constant(0.3) - u[3]) * self.rate;
    }
}

/// The saddle quantity is that of the directions in which the orbit comes and goes.
#[test]
fn a_variable_in_which_the_orbit_rests_has_no_part_in_the_rates() {
    let pendulum = |torque: f64| Pendulum { torque, damping: 0.1 };
    let settings = Settings::over(1.5, 0.02);
    let alone = whirling(0.1, 1.2, &settings);
    for rate in [0.03, 5.0] {
        let family = move |torque: f64| -> Body { Ok(Box::new(Beside { pendulum: pendulum(torque), rate })) };
        let shape = settled(&Beside { pendulum: pendulum(1.2), rate }, &[1.0, 0.0, 12.0, 0.3], 60.0);
        let guess =
            PeriodicGuess { shape: &shape, time: std::f64::consts::TAU / 12.0, angle: 0.0, mirrored: false };
        let found = connection(&family, 1.2, &guess, &settings).1;
        near(found.parameter, alone.parameter, 1e-8);
        near(found.quantity().unwrap(), alone.quantity().unwrap(), 1e-6);
        assert_eq!(found.kind(), alone.kind(), "{found}");
    }
}

fn whirling(damping: f64, from: f64, settings: &Settings) -> Connection {
    let family = move |torque: f64| -> Body { Ok(Box::new(Pendulum { torque, damping })) };
    let shape = settled(&Pendulum { torque: from, damping }, &[1.0, 0.0, from / damping], 60.0);
    let time = std::f64::consts::TAU * damping / from;
    let guess = PeriodicGuess { shape: &shape, time, angle: 0.0, mirrored: false };
    connection(&family, from, &guess, settings).1
}

#[test]
fn a_damped_pendulum_stops_whirling_at_a_saddle_node_on_a_circle() {
    for settings in [Settings::over(6.0, 0.5), Settings { largest_step: 0.05, ..Settings::over(6.0, 0.2) }] {
        let settings = Settings { longest_time: 2000.0, ..settings };
        let found = whirling(2.0, 5.0, &settings);
        assert_eq!(found.kind(), ConnectionKind::SaddleNode, "{found}");
        assert!((found.parameter - 1.0).abs() <= found.error && found.error < 1e-5, "{found}");
        assert!(found.quantity().is_none());
    }
}

#[test]
fn a_weakly_damped_pendulum_stops_whirling_on_the_loop_of_its_saddle() {
    let damping = 0.1;
    let found = whirling(damping, 1.2, &Settings::over(1.5, 0.02));
    assert_eq!(found.kind(), ConnectionKind::Saddle, "{found}");
    near(found.parameter, 4.0 * damping / std::f64::consts::PI, 0.02 * found.parameter);
    // sin theta = torque, cos theta < 0: rate^2 + damping rate = |cos theta|
    let cosine = (1.0 - found.parameter * found.parameter).sqrt();
    let root = (0.25 * damping * damping + cosine).sqrt();
    let [grows, decays] = found.sides().unwrap();
    near(grows.0, root - 0.5 * damping, 1e-5);
    near(decays.0, -root - 0.5 * damping, 1e-5);
    near(found.quantity().unwrap(), -damping, 1e-8);
    let error = found.quantity_error().unwrap();
    assert!((found.quantity().unwrap() + damping).abs() <= error && error < 1e-4 * damping, "{error}");
}

/// The folds of a branch, in its order, as long as they are farther from each other than 100 of their errors.
fn folds(points: &[Point]) -> Vec<f64> {
    let folds: Vec<&Point> = points.iter().filter(|point| point.special == Some(Special::Fold)).collect();
    let error = |point: &Point| point.certificate.map_or(0.0, |shown| shown.error);
    let apart = |pair: &&[&Point]| (pair[1].parameter - pair[0].parameter).abs() > 100.0 * error(pair[1]);
    let told = folds.windows(2).take_while(apart).count();
    folds.iter().take(told + 1).map(|point| point.parameter).collect()
}

/// The saddle-focus at the end: its pair leads, the folds come closer as it says, and their limit (Aitken) is the end.
fn is_shilnikov(points: &[Point], found: &Connection, expected: f64) {
    assert_eq!(found.kind(), ConnectionKind::SaddleFocus, "{found}");
    let PeriodLaw::Oscillating { rate, frequency } = found.law else { unreachable!("{found}") };
    let folds = folds(points);
    let [.., a, b, c] = folds[..] else { unreachable!("{folds:?}") };
    let ratio = (c - b) / (b - a);
    near(ratio, -(-rate * std::f64::consts::PI / frequency).exp(), 0.03 * ratio.abs());
    let limit = c - (c - b) * (c - b) / ((c - b) - (b - a));
    near(found.parameter, limit, 1e-2 * (c - b).abs() + found.error);
    near(found.parameter, expected, found.error.max(1e-3 * expected.abs()));
    assert!(found.error < 1e-6, "{found}");
    let [grows, decays] = found.sides().unwrap();
    assert!((grows.1 > 0.0) != (decays.1 > 0.0), "one side is a focus");
    near(found.quantity().unwrap(), grows.0 + decays.0, 0.0);
}

/// `x' = -y - z`, `y' = x + a y`, `z' = b x - c z + x z` with a = 0.38, b = 0.3: a homoclinic orbit of the origin at c = 4.82.
/// Source: Gaspard, Kapral and Nicolis (1984), J. Stat. Phys. 35, 697.
struct Rossler(f64);
motiform_models::plain!(Rossler, 3);
impl<T: Scalar> VectorField<T> for Rossler {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, z) = (u[0], u[1], u[2]);
        du[0] = -(y + z);
        du[1] = x + y * 0.38;
        du[2] = x * 0.3 - z * self.0 + x * z;
    }
}

#[test]
fn a_branch_of_rosslers_equations_ends_at_its_saddle_focus() {
    let family = |c: f64| -> Body { Ok(Box::new(Rossler(c))) };
    // of four turns, stable between two period doublings
    let shape = settled(&Rossler(2.6), &[1.0, 1.0, 0.1], 4000.0);
    let guess = PeriodicGuess { shape: &shape, time: 23.0, angle: 0.0, mirrored: false };
    let settings = Settings { largest_step: draws(0.05, 0.02), ..Settings::over(1.0, 8.0) };
    let (points, found) = connection(&family, 2.6, &guess, &settings);
    is_shilnikov(&points, &found, 4.82);
}

/// A rotating motion of the tensor model: folds that converge on -0.018038352 in steps of 10.05 of the period.
#[test]
fn a_rotating_motion_of_the_tensor_model_ends_at_a_saddle_focus() {
    let family = |kappa3: f64| -> Body {
        let base = TensorParameters {
            b3: 1.0,
            d3: 1.0,
            a1: 0.8,
            a3: 0.5,
            b1: 0.6,
            b2: 0.7,
            ..TensorParameters::full(0.3, kappa3)
        };
        Ok(Box::new(Tensor::new(&TensorParameters { d1: 0.3, d2: 0.9, d6: 0.4, gamma: 0.3, ..base })))
    };
    let shape = [-0.482_516, 0.003_306, 0.032_383, -0.063_425, 0.026_391, 0.039_035];
    let guess = PeriodicGuess { shape: &shape, time: 12.630_755, angle: -1.552_724, mirrored: false };
    for largest_step in [0.03, 0.02].into_iter().take(draws(1, 2)) {
        let settings = Settings { largest_step, ..Settings::over(0.5, -0.8) };
        let (points, found) = connection(&family, 0.109_683_548_9, &guess, &settings);
        is_shilnikov(&points, &found, -0.018_038_352);
        near(found.parameter, -0.018_038_351_53, 1e-9 + found.error);
    }
}

/// `x' = a (1 - x^2) + c w`, `y' = y (p - 2 a x)` with `c = y - 1 + x^2`, `a = 0.9 + 0.1 x`, `w = 1.55 + 0.05 x`.
///
/// At every p the line y = 0 is invariant and leads from the saddle (1, 0) to the saddle (-1, 0). At p = 0 the parabola c = 0 is invariant,
/// too (`c' = 2 x w c`), and leads back. The eigenvalues at p = 0 are `2 (w - a) = 1.2` and `-2 a = -2` at the first, `-1.4` and `1.6` at
/// the second: the cycle is attracting, `(2/1.2)(1.4/1.6) > 1`. For p < 0 orbits pass the first saddle at a distance d and the second one
/// at its power 2/1.2, and come back at its power q = (2/1.2)(1.4/1.6): `T = -ln(d) (1/1.2 + 2/(1.2 1.6))` with `d = c |p| + a d^q`, so
/// that `-dT/dln|p|` is off its limit in proportion to `|p|^(q-1)`.
struct Parabola(f64);
motiform_models::plain!(Parabola, 2);
impl<T: Scalar> VectorField<T> for Parabola {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        let one = x.constant(1.0);
        let (a, w) = (x * 0.1 + x.constant(0.9), x * 0.05 + x.constant(1.55));
        let off = y - one + x * x;
        du[0] = a * (one - x * x) + off * w;
        du[1] = y * (x.constant(self.0) - a * x * 2.0);
    }
}

/// `-dT/dln|p|` between neighbours on a branch that ends at p = 0, with the geometric mean of `|p|` there.
fn slopes(points: &[Point]) -> Vec<(f64, f64)> {
    let read = |point: &Point| (point.parameter.abs().ln(), point.motion.orbit().unwrap().time);
    let between = |pair: &[Point]| {
        let (a, b) = (read(&pair[0]), read(&pair[1]));
        ((0.5 * (a.0 + b.0)).exp(), (b.1 - a.1) / (a.0 - b.0))
    };
    points.windows(2).map(between).collect()
}

#[test]
fn a_broken_cycle_of_two_saddles_is_heteroclinic_with_the_rates_of_both() {
    let family = |p: f64| -> Body { Ok(Box::new(Parabola(p))) };
    for (from, to, start, step) in
        [(-0.09, 0.1, -0.05, 0.02), (-0.07, 0.02, -0.03, 0.01), (-0.2, 1.0, -0.05, 0.005)]
    {
        let shape = settled(&Parabola(start), &[0.0, 0.3], 200.0);
        let guess = PeriodicGuess {
            shape: &shape,
            time: if start < -0.04 { 7.2 } else { 8.3 },
            angle: 0.0,
            mirrored: false,
        };
        let settings = Settings { largest_step: step, ..Settings::over(from, to) };
        let (points, found) = connection(&family, start, &guess, &settings);
        assert_eq!((found.kind(), found.joins), (ConnectionKind::Cycle, Some(Joins::Different)), "{found}");
        near(found.parameter, 0.0, found.error);
        assert!(found.error < 1e-7, "{found}");
        let PeriodLaw::Logarithmic { rate } = found.law else { unreachable!("{found}") };
        let (limit, q) = (1.0 / 1.2 + 2.0 / (1.2 * 1.6), 2.0 / 1.2 * 1.4 / 1.6);
        near(found.attraction().unwrap(), q, 1e-6);
        let slopes = slopes(&points);
        let at = |p: f64| *slopes.iter().rfind(|slope| slope.0 > p).unwrap();
        let (far, close) = (at(1e-4), at(1e-6));
        let power = ((far.1 - limit) / (close.1 - limit)).ln() / (far.0 / close.0).ln();
        near(power, q - 1.0, 0.02); // the next order is smaller by |p|^(q-1), 0.015 at 1e-4
        // fitted over points of at least half of the last time
        let last = points.last().unwrap().motion.orbit().unwrap().time;
        let late = points.iter().find(|point| point.motion.orbit().unwrap().time > 0.5 * last).unwrap();
        let (first, end) = (at(late.parameter.abs()).1, slopes.last().unwrap().1);
        assert!(limit < end && end < 1.0 / rate && 1.0 / rate < first, "{end} {} {first}", 1.0 / rate);
        assert_eq!(found.passed.len(), 2, "{found}");
        for passed in &found.passed {
            let first = passed.saddle.shape[0] > 0.0;
            let (place, [grows, decays]) = if first { (1.0, [1.2, -2.0]) } else { (-1.0, [1.6, -1.4]) };
            near(passed.saddle.shape[0], place, 1e-8);
            near(passed.sides[0].0, grows, 1e-6);
            near(passed.sides[1].0, decays, 1e-6);
            near(passed.quantity(), grows + decays, 1e-6);
        }
    }
}

/// `x' = y`, `y' = x^3 - x - (h - p) y`, `h = y^2/2 + x^2/2 - x^4/4`: as `h' = -(h - p) y^2` the curve h = p is a periodic orbit, exactly,
/// until at p = 1/4 it joins the saddles at x = +-1, whose eigenvalues are `+-sqrt 2` there. `(x, y) -> (-x, -y)` is a symmetry: the
/// mirror, if it is declared.
#[derive(Clone, Copy)]
struct Duffing {
    p: f64,
    mirrors: bool,
}
impl motiform_dynamics::System for Duffing {
    fn dim(&self) -> usize {
        2
    }
}
impl<T: Scalar> VectorField<T> for Duffing {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        let energy = y * y * 0.5 + x * x * 0.5 - x * x * x * x * 0.25;
        du[0] = y;
        du[1] = x * x * x - x - (energy - x.constant(self.p)) * y;
    }
}
impl<T: Scalar> motiform_dynamics::Semilinear<T> for Duffing {
    fn linear(&self, lambda: &mut [T::Real]) {
        for rate in lambda {
            *rate = Scalar::zero(*rate);
        }
    }
    fn nonlinear(&self, t: T::Real, u: &[T], du: &mut [T]) {
        VectorField::<T>::eval(self, t, u, du);
    }
}
impl<T: Scalar> motiform_dynamics::Shape<T> for Duffing {
    fn velocity(&self, shape: &[T]) -> [T; 2] {
        [Scalar::zero(shape[0]); 2]
    }
}
impl Equivariant for Duffing {
    fn symmetry(&self) -> motiform_dynamics::Symmetry {
        motiform_dynamics::Symmetry { mirror: self.mirrors, ..motiform_dynamics::Symmetry::default() }
    }
    fn mirror(&self, shape: &mut [f64]) {
        if self.mirrors {
            shape.iter_mut().for_each(|x| *x = -*x);
        }
    }
}

#[test]
fn an_orbit_that_passes_a_saddle_and_its_image_ends_in_a_heteroclinic_connection() {
    // half of the orbit up to the mirror, the whole orbit, and the whole orbit without the mirror
    for (mirrors, half, joins) in
        [(true, true, Joins::Images), (true, false, Joins::Images), (false, false, Joins::Different)]
    {
        let family = move |p: f64| -> Body { Ok(Box::new(Duffing { p, mirrors })) };
        let shape = settled(&Duffing { p: 0.15, mirrors }, &[0.5, 0.0], 300.0);
        let time = if half { 3.7 } else { 7.4 };
        let guess = PeriodicGuess { shape: &shape, time, angle: 0.0, mirrored: half };
        for settings in
            [Settings::over(0.05, 0.4), Settings { largest_step: 0.008, ..Settings::over(0.1, 1.1) }]
        {
            let (_, found) = connection(&family, 0.15, &guess, &settings);
            assert_eq!(found.joins, Some(joins), "{found}");
            near(found.parameter, 0.25, found.error.max(1e-9));
            assert!(found.error < 1e-7, "{found}");
            assert_eq!(found.passed.len(), if joins == Joins::Different { 2 } else { 0 }, "{found}");
            let leading = found.saddle.as_ref().map(|saddle| saddle.eigenvalues[0].0).unwrap();
            near(leading, 2.0_f64.sqrt(), 1e-5);
        }
    }
}

/// `x' = y, y' = x - x^2 - y (H - p) (1 + x)` with `H = y^2/2 - x^2/2 + x^3/3`: the orbit at p is the level H = p, and at p = 0 the
/// loop of a saddle with the eigenvalues 1 and -1.
struct Neutral(f64);
motiform_models::plain!(Neutral, 2);
impl<T: Scalar> VectorField<T> for Neutral {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        let level = y * y * 0.5 - x * x * 0.5 + x * x * x * (1.0 / 3.0) - x.constant(self.0);
        du[0] = y;
        du[1] = x - x * x - y * level * (x + x.constant(1.0));
    }
}

#[test]
fn a_saddle_quantity_within_its_error_has_no_sign() {
    let family = |p: f64| -> Body { Ok(Box::new(Neutral(p))) };
    let guess = PeriodicGuess { shape: &[1.331, 0.0], time: 7.0, angle: 0.0, mirrored: false };
    for (low, high) in [(-0.16, 0.1), (-0.12, 0.3)] {
        let (_, found) = connection(&family, -0.1, &guess, &Settings::over(low, high));
        near(found.parameter, 0.0, 1e-6);
        assert!(found.quantity().unwrap().abs() < 1e-6, "{:?}", found.quantity());
        let error = found.quantity_error().unwrap();
        assert!(found.quantity().unwrap().abs() <= error && error < 1e-4, "{error}");
        assert!(
            found.to_string().ends_with("saddle quantity 0 within its error: its sign is not known"),
            "{found}"
        );
    }
}

/// Chua's equations with a cubic, b = 14, along a.
struct Chua(f64);
motiform_models::plain!(Chua, 3);
impl<T: Scalar> VectorField<T> for Chua {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, z) = (u[0], u[1], u[2]);
        du[0] = (y - x * x * x * (1.0 / 16.0) + x * (1.0 / 6.0)) * self.0;
        du[1] = x - y + z;
        du[2] = y * -14.0;
    }
}

/// The folds follow one another after the same time whatever the steps; long steps must not pass some of them, nor may the rise between two
/// of them be taken for the law of a saddle with real eigenvalues.
#[test]
fn the_end_at_a_saddle_focus_does_not_depend_on_the_steps() {
    let family = |a: f64| -> Body { Ok(Box::new(Chua(a))) };
    let shape = settled(&Chua(8.41), &[1.0, 0.0, 0.0], 2000.0);
    let guess = PeriodicGuess { shape: &shape, time: 9.331, angle: 0.0, mirrored: false };
    let mut all: Vec<Connection> = Vec::new();
    let cases = [(0.015, 5.0, 10.0), (0.03, 5.0, 10.0), (0.02, 8.0, 12.0), (0.01, 5.0, 10.0)];
    for (largest_step, low, high) in cases.into_iter().take(draws(3, 4)) {
        let settings = Settings { largest_step, ..Settings::over(low, high) };
        let (points, found) = connection(&family, 8.41, &guess, &settings);
        is_shilnikov(&points, &found, 9.385_156_865);
        near(found.parameter, 9.385_156_865, found.error + 5e-10);
        let late = points.iter().filter(|point| point.special.is_some()).map(period);
        let late: Vec<f64> = late.filter(|period| *period > 15.0).collect();
        assert!(late.windows(2).all(|pair| (pair[1] - pair[0] - 1.159).abs() < 0.01), "{late:?}");
        all.push(found);
    }
    for (a, b) in all.iter().flat_map(|a| all.iter().map(move |b| (a, b))) {
        assert!((a.parameter - b.parameter).abs() <= a.error + b.error, "{a}\n{b}");
    }
}

fn period(point: &Point) -> f64 {
    point.motion.orbit().unwrap().period()
}

/// Lorenz's equations, whose saddle at the origin has the leading eigenvalue -8/3. Mirror images that they do not state, and other steps:
/// their laws agree within their errors, which hold the saddle's rate.
#[test]
fn the_law_of_a_connection_is_as_good_as_its_error() {
    let family = |r: f64| -> Body { Ok(Box::new(Lorenz(r))) };
    for (side, largest_step, high) in
        [(1.0, 0.02, 30.0), (-1.0, 0.02, 30.0), (1.0, 0.01, 28.0), (-1.0, 0.03, 35.0)]
    {
        let settings = Settings { largest_step, ..Settings::over(5.0, high) };
        let place = side * (8.0_f64 / 3.0 * 23.0).sqrt();
        let rest = RelativeEquilibrium::find(&Lorenz(24.0), &[place, place, 23.0]).unwrap();
        let mut branch = Branch::of_equilibria(&family, 24.0, &rest, &settings, &()).unwrap();
        let hopf = branch.find(|point| point.special.is_some()).unwrap();
        near(hopf.parameter, 470.0 / 19.0, 1e-8);
        let mut orbits = switch(&family, &hopf, &settings, &()).unwrap().pop().unwrap().pop().unwrap();
        orbits.by_ref().for_each(drop);
        let Some(End::Homoclinic(found)) = orbits.end() else { unreachable!("{:?}", orbits.end()) };
        near(found.parameter, 13.926_557_407, 1e-8 + found.error);
        let PeriodLaw::Logarithmic { rate } = found.law else { unreachable!("{found}") };
        assert!((rate - 8.0 / 3.0).abs() <= found.law_error && found.law_error < 0.3 * rate, "{found}");
        assert!(found.to_string().contains(&stated(rate, found.law_error)), "{found}");
    }
}
