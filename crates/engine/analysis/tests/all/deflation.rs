//! Deflation finds what is not known, once.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Random, near, reduced};
use motiform_analysis::RelativeEquilibrium;
use motiform_analysis::equilibrium::{Deflation, balances};
use motiform_dynamics::{Equivariant, Scalar, VectorField};
use motiform_models::zoo::Linear;

/// `x' = (x - 1)(x + 2)(x - 3)(x - 3.001)` in a unit of length.
struct Quartic(f64);
motiform_models::plain!(Quartic, 1);
impl<T: Scalar> VectorField<T> for Quartic {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let x = u[0] * (1.0 / self.0);
        let less = |root: f64| x - x.constant(root);
        du[0] = less(1.0) * less(-2.0) * less(3.0) * less(3.001);
    }
}

/// `(x, y)' = (1 - x^2 - y^2) (x, y)` without a stated symmetry: the origin and a family.
struct Ring;
motiform_models::plain!(Ring, 2);
impl<T: Scalar> VectorField<T> for Ring {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let rate = u[0].constant(1.0) - u[0] * u[0] - u[1] * u[1];
        (du[0], du[1]) = (rate * u[0], rate * u[1]);
    }
}

/// Everything that deflation finds from one start.
fn all(body: &impl Equivariant, guess: &[f64], reach: f64) -> Vec<RelativeEquilibrium> {
    let (mut known, mut found) = (Deflation::of(body), Vec::new());
    while let Some(new) = known.find(body, guess, reach) {
        known.add(body, &new);
        found.push(new);
    }
    found
}

#[test]
fn one_start_leads_to_all_roots_one_after_the_other() {
    for unit in [1e-3, 1.0, 1e5] {
        let mut roots: Vec<f64> =
            all(&Quartic(unit), &[10.0 * unit], 1e3 * unit).iter().map(|one| one.shape[0] / unit).collect();
        roots.sort_by(f64::total_cmp);
        assert_eq!(roots.len(), 4, "{roots:?}");
        for (root, want) in roots.iter().zip([-2.0, 1.0, 3.0, 3.001]) {
            near(*root, want, 1e-10); // the slope at the two close roots is 0.01, the terms of the field are about 50
        }
    }
}

/// The circle, an ellipse, and circular motion with its mirror image: all their rotated copies are known with them.
#[test]
fn rotated_copies_are_known() {
    let (kappa2, gamma) = (-0.1, 0.1);
    let body = reduced(kappa2, gamma);
    let mut random = Random(5);
    let mut known = Deflation::of(&body);
    let mut found: Vec<RelativeEquilibrium> = Vec::new();
    for _ in 0..200 {
        let guess: Vec<f64> = (0..6).map(|_| 0.3 * random.next()).collect();
        while let Some(new) = known.find(&body, &guess, 0.3) {
            assert!(found.iter().all(|old| old.distance(&body, &new.shape) > 1e-3));
            known.add(&body, &new);
            found.push(new);
        }
    }
    let mut speeds: Vec<f64> = found.iter().map(RelativeEquilibrium::speed).collect();
    speeds.sort_by(f64::total_cmp);
    assert_eq!(speeds.len(), 4, "{found:?}");
    // r1^2 = 32 r2^2, r2^2 = (2 gamma - kappa2)/72
    let speed = (32.0 * (2.0 * gamma - kappa2) / 72.0_f64).sqrt();
    for (seen, want) in speeds.iter().zip([0.0, 0.0, speed, speed]) {
        near(*seen, want, 1e-11);
    }
}

#[test]
fn members_of_a_family_are_not_found_one_by_one() {
    let known = all(&Ring, &[0.1, 0.05], 1.0);
    assert!(known.iter().all(|one| one.shape[0].hypot(one.shape[1]) < 1e-12), "{known:?}");
}

/// The coefficients of `1, x, .., x^4` are -18.006, 21.005, 1.002, -5.001 and 1: the powers that dominate
/// somewhere balance at about 2 units.
#[test]
fn sizes_follow_from_the_equations() {
    for unit in [1e-6, 1.0, 1e6] {
        let sizes = balances(&Quartic(unit), &[vec![1.0], vec![-1.0]]);
        assert!(!sizes.is_empty());
        assert!(sizes.iter().all(|size| (0.2..20.0).contains(&(size / unit))), "{unit}: {sizes:?}");
    }
    let linear = Linear { rows: [[-1.0, 0.5], [0.0, -2.0]] };
    assert!(balances(&linear, &[vec![1.0; 2]]).is_empty());
}
