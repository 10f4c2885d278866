//! Hopf bifurcations of shapes whose rotations mix critical vectors: every kind of oscillation begins.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::near;
use motiform_analysis::{RelativeEquilibrium, Result};
use motiform_continuation::{Branch, Family, Motion, Point, Settings, Special, switch};
use motiform_dynamics::{Equivariant, Scalar, Semilinear, Shape, Symmetry, System, VectorField};

/// Coefficients of the normal form, and the frequency.
const ALPHA: f64 = -1.0;
const BETA: f64 = -0.4;
const OMEGA: f64 = 2.0;

/// A shape `w` with `folds` rotations (the amplitude of that mode, 1 at rest; 0 folds: a circle) and two amplitudes of the first mode,
///
/// `a' = (mu + i omega) a + (alpha |a|^2 + beta |b|^2) a + c`, `b' = (mu - i omega) b + (alpha |b|^2 + beta |a|^2) b + c`
///
/// with `c = strength w conj((a + b) / 2)^(folds - 1)`: for `c = 0` the normal form for O(2), solved by `|a|^2 = -mu / alpha`, `b = 0` and
/// by `|a|^2 = |b|^2 = -mu / (alpha + beta)`. A mirror takes `(w, a, b)` to `(conj w, conj b, conj a)`.
struct Polygon {
    mu: f64,
    folds: usize,
    strength: f64,
    /// `false`: without the amplitude `b`, which decays, and without the mirror.
    mirror: bool,
}

impl System for Polygon {
    fn dim(&self) -> usize {
        if self.folds == 0 { 4 } else { 6 }
    }
}

impl<T: Scalar> VectorField<T> for Polygon {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let product = |x: [T; 2], y: [T; 2]| [x[0] * y[0] - x[1] * y[1], x[0] * y[1] + x[1] * y[0]];
        let square = |x: [T; 2]| x[0] * x[0] + x[1] * x[1];
        let number = |value: f64| u[0].constant(value);
        let (a, b) = ([u[0], u[1]], [u[2], u[3]]);
        let mut coupling = [number(0.0); 2];
        if self.folds > 0 {
            let w = [u[4], u[5]];
            let mean = [number(0.5) * (a[0] + b[0]), number(-0.5) * (a[1] + b[1])];
            coupling = (1..self.folds)
                .fold([number(self.strength) * w[0], number(self.strength) * w[1]], |sum, _| {
                    product(sum, mean)
                });
            for i in 0..2 {
                du[4 + i] = (number(1.0) - square(w)) * w[i];
            }
        }
        for (own, other, turn, at) in [(a, b, OMEGA, 0), (b, a, -OMEGA, 2)] {
            let growth = number(self.mu) + number(ALPHA) * square(own) + number(BETA) * square(other);
            let rate = product([growth, number(turn)], own);
            let decays = number(if self.mirror || at == 0 { 0.0 } else { 3.0 });
            for i in 0..2 {
                du[at + i] = rate[i] + coupling[i] - decays * own[i];
            }
        }
    }
}

impl<T: Scalar> Semilinear<T> for Polygon {
    fn linear(&self, lambda: &mut [T::Real]) {
        for rate in lambda {
            *rate = Scalar::zero(*rate);
        }
    }
    fn nonlinear(&self, t: T::Real, u: &[T], du: &mut [T]) {
        VectorField::<T>::eval(self, t, u, du);
    }
}

impl<T: Scalar> Shape<T> for Polygon {
    fn velocity(&self, shape: &[T]) -> [T; 2] {
        [shape[0], shape[1]]
    }
}

impl Equivariant for Polygon {
    fn symmetry(&self) -> Symmetry {
        Symmetry { rotations: true, mirror: self.mirror }
    }
    fn rotate(&self, angle: f64, shape: &mut [f64]) {
        for (pair, mode) in shape.chunks_exact_mut(2).zip([1.0, 1.0, self.folds as f64]) {
            let (sin, cos) = libm::sincos(mode * angle);
            (pair[0], pair[1]) = (cos * pair[0] - sin * pair[1], sin * pair[0] + cos * pair[1]);
        }
    }
    fn spin(&self, shape: &[f64], out: &mut [f64]) {
        for ((pair, out), mode) in
            shape.chunks_exact(2).zip(out.chunks_exact_mut(2)).zip([1.0, 1.0, self.folds as f64])
        {
            (out[0], out[1]) = (-mode * pair[1], mode * pair[0]);
        }
    }
    fn mirror(&self, shape: &mut [f64]) {
        (shape[0], shape[2]) = (shape[2], shape[0]);
        (shape[1], shape[3]) = (-shape[3], -shape[1]);
        shape.iter_mut().skip(5).for_each(|x| *x = -*x);
    }
    fn highest_mode(&self) -> usize {
        self.folds.max(1)
    }
}

/// The first points of all branches that begin at the Hopf bifurcation at 0.
fn begun(folds: usize, strength: f64, mirror: bool) -> Vec<Vec<Point>> {
    let family = move |mu: f64| -> Result<Box<dyn Equivariant>> {
        Ok(Box::new(Polygon { mu, folds, strength, mirror }))
    };
    let family: &dyn Family = &family;
    let body = family.at(-0.3).unwrap();
    let rest = if folds == 0 { vec![0.0; 4] } else { vec![0.0, 0.0, 0.0, 0.0, 1.0, 0.0] };
    let start = RelativeEquilibrium::find(body.as_ref(), &rest).unwrap();
    let settings = Settings { first_step: 0.02, ..Settings::over(-0.5, 0.5) };
    let mut branch = Branch::of_equilibria(family, -0.3, &start, &settings, &()).unwrap();
    let hopf = branch.find(|point| matches!(point.special, Some(Special::Hopf(_)))).unwrap();
    near(hopf.parameter, 0.0, 1e-9);
    let found = switch(family, &hopf, &settings, &()).unwrap();
    found.into_iter().map(|mut legs| legs.remove(0).take(4).collect()).collect()
}

/// `|a|^2` and `|b|^2`, the larger one first: their means along the orbit.
fn sizes(point: &Point) -> [f64; 2] {
    let nodes: &[Vec<f64>] = match &point.motion {
        Motion::Orbit { nodes, .. } => nodes,
        Motion::Equilibrium(start) => std::slice::from_ref(&start.shape),
    };
    let mean = |at: usize| {
        nodes.iter().map(|u| u[at] * u[at] + u[at + 1] * u[at + 1]).sum::<f64>() / nodes.len() as f64
    };
    let (a, b) = (mean(0), mean(2));
    [a.max(b), a.min(b)]
}

/// Checks that a branch begins as the normal form says, standing or turning.
fn begins(branch: &[Point], standing: bool, within: f64) {
    let point = &branch[0];
    let [large, small] = sizes(point);
    let expected = -point.parameter / if standing { ALPHA + BETA } else { ALPHA };
    near(large, expected, within * expected.abs());
    near(small, if standing { expected } else { 0.0 }, within * expected.abs());
}

/// From a circle: relative equilibria that turn at the rate of the frequency, and orbits that are back after half a period, turned by half
/// a turn.
#[test]
fn a_circle_begins_to_turn_and_to_swing() {
    let found = begun(0, 0.0, true);
    assert_eq!(found.len(), 2);
    for branch in &found {
        match &branch[0].motion {
            Motion::Equilibrium(start) => {
                near(start.turning_rate.abs(), OMEGA, 1e-9);
                begins(branch, false, 1e-7);
            }
            Motion::Orbit { orbit, .. } => {
                near(orbit.time, std::f64::consts::PI / OMEGA, 1e-7);
                begins(branch, true, 1e-7);
            }
        }
    }
}

/// Without a mirror a circle only begins to turn: one branch of relative equilibria. Orbits of any period were followed from there, each
/// a part of the turning motion.
#[test]
fn a_circle_without_a_mirror_only_begins_to_turn() {
    let found = begun(0, 0.0, false);
    assert_eq!(found.len(), 1);
    let Motion::Equilibrium(start) = &found[0][0].motion else { unreachable!("{:?}", found[0][0]) };
    near(start.turning_rate, OMEGA, 1e-9);
    begins(&found[0], false, 1e-7);
}

/// The equivariant Hopf theorem for `D_n`: two standing oscillations that are no images of each other and one that turns, which is back
/// after one `n`-th of the period. Where `n` is even, half a turn is half a period of the standing ones; where it is odd, one of them keeps
/// a mirror axis, the other swings across one.
#[test]
fn a_polygon_begins_to_oscillate_in_three_ways() {
    let period = std::f64::consts::TAU / OMEGA;
    for (folds, strength) in [(3, 0.1), (4, 0.02), (5, 0.5), (6, 0.5)] {
        let found = begun(folds, strength, true);
        let mut times: Vec<f64> = found
            .iter()
            .map(|branch| match &branch[0].motion {
                Motion::Orbit { orbit, .. } => orbit.time / period,
                Motion::Equilibrium(_) => f64::NAN,
            })
            .collect();
        times.sort_by(f64::total_cmp);
        let expected = [1.0 / folds as f64, 0.5, if folds % 2 == 0 { 0.5 } else { 1.0 }];
        assert!(
            times.len() == 3 && times.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.01),
            "{folds}: {times:?}"
        );
        for branch in &found {
            let Motion::Orbit { orbit, .. } = &branch[0].motion else { unreachable!() };
            let turns = (orbit.time / period - expected[0]).abs() < 0.01;
            begins(branch, !turns, 0.03);
        }
    }
}
