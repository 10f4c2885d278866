//! The cost of the classification of the active cell, and the tries that it refuses. Costs are counted in
//! evaluations of the field, never in seconds.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Random, cell, named, settings};
use motiform_analysis::Regime;
use motiform_dynamics::{
    Dual, Equivariant, Obstacle, Scalar, Semilinear, Shape, Symmetry, System, VectorField,
};
use motiform_models::cell::Cell;
use std::sync::atomic::{AtomicU64, Ordering};

/// A cell that counts how often its field is evaluated with a tangent vector.
struct Counted {
    cell: Cell,
    tangents: AtomicU64,
}

impl Counted {
    fn count<T: Scalar<Real = f64>>(&self) {
        let tangent = size_of::<T>() > size_of::<f64>();
        self.tangents.fetch_add(u64::from(tangent), Ordering::Relaxed);
    }
}

impl System for Counted {
    fn dim(&self) -> usize {
        self.cell.dim()
    }

    fn obstacle(&self, u: &[f64]) -> Option<Obstacle> {
        self.cell.obstacle(u)
    }
}

impl<T: Scalar<Real = f64>> VectorField<T> for Counted {
    fn eval(&self, t: f64, u: &[T], du: &mut [T]) {
        self.count::<T>();
        self.cell.eval(t, u, du);
    }
}

impl<T: Scalar<Real = f64>> Semilinear<T> for Counted {
    fn linear(&self, lambda: &mut [f64]) {
        Semilinear::<T>::linear(&self.cell, lambda);
    }

    fn nonlinear(&self, t: f64, u: &[T], du: &mut [T]) {
        self.count::<T>();
        self.cell.nonlinear(t, u, du);
    }
}

impl<T: Scalar<Real = f64>> Shape<T> for Counted {
    fn velocity(&self, shape: &[T]) -> [T; 2] {
        self.cell.velocity(shape)
    }
}

impl Equivariant for Counted {
    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }

    fn rotate(&self, angle: f64, shape: &mut [f64]) {
        self.cell.rotate(angle, shape);
    }

    fn spin(&self, shape: &[f64], out: &mut [f64]) {
        self.cell.spin(shape, out);
    }

    fn mirror(&self, shape: &mut [f64]) {
        self.cell.mirror(shape);
    }

    fn speed_resolution(&self, shape: &[f64], atol: f64) -> f64 {
        self.cell.speed_resolution(shape, atol)
    }
}

const _: fn() = || {
    fn is_equivariant<B: Equivariant + Semilinear<Dual<f64, 1>>>() {}
    is_equivariant::<Counted>();
};

/// At 13.5 two returns to the same saddle look like a perfect recurrence. No try at a periodic orbit may
/// follow its tangent vectors far, and rests decide as soon as three of them were seen.
#[test]
fn a_cycle_of_saddles_is_named_without_following_tangent_vectors_through_its_rests() {
    let settings = settings("cell");
    for seed in 1..=3 {
        let body = Counted { cell: cell(13.5, 21), tangents: AtomicU64::new(0) };
        let verdict = named(&body, &Random(seed).state(42, 0.01), &settings);
        let tangents = body.tangents.load(Ordering::Relaxed);
        println!("{seed}: {} after {}, {tangents} tangents", verdict.regime, verdict.time);
        assert_eq!(verdict.regime, Regime::Rectangular, "{}", verdict.why);
        // Two looks and the wait for no exponent: 1500 + 3000. A look of 1500 has some 1e5 evaluations.
        assert!(verdict.time <= 6.0 * settings.first_look, "{}", verdict.time);
        assert!(tangents < 500_000, "{tangents}");
    }
}

/// Weak chaos is named within the budget, by an exponent beyond three of its errors, and most evaluations with tangent vectors are those
/// of the exponent (one vector, five evaluations a step, some twelve steps per unit of time).
#[test]
fn weak_chaos_is_named_by_its_exponent_and_not_after_long_tries() {
    let settings = settings("cell");
    let body = Counted { cell: cell(21.75, 21), tangents: AtomicU64::new(0) };
    let verdict = named(&body, &Random(3).state(42, 0.01), &settings);
    let tangents = body.tangents.load(Ordering::Relaxed) as f64;
    println!("{} after {}, {tangents} tangents", verdict.why, verdict.time);
    assert_eq!(verdict.regime, Regime::Chaotic, "{}", verdict.why);
    let exponent = verdict.exponents[0];
    assert!(
        exponent.value > 3.0 * exponent.error && (0.0005..0.004).contains(&exponent.value),
        "{exponent:?}"
    );
    assert!(tangents < 150.0 * verdict.time, "{} per unit of time", tangents / verdict.time);
}
