//! Bodies of the tensor model.

use crate::single::{Body, checked, how};
use motiform_dynamics::Watch;
use motiform_dynamics::simd::has_lanes;
use motiform_kernels::{Kernel, Start, propagate_bodies};
use motiform_models::tensor::{Tensor, TensorParameters};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Bodies of the full model (paper, Simulations II).
fn bodies(kappa2: impl Fn(usize) -> f64, count: usize) -> Vec<Body> {
    let start = [0.5, 0.1, 0.1, -0.2, 0.05, 0.1, 3.0, -2.0];
    let body = |i: usize| -> Body {
        let moved = |j: usize| start[j] * (1.0 + 0.1 * (0.7 * i as f64 + 1.3 * j as f64).sin());
        let model = Tensor::new(&TensorParameters::full(kappa2(i), 0.1));
        (Box::new(model), (0..start.len()).map(moved).collect())
    };
    (0..count).map(body).collect()
}

#[test]
fn members_pass_where_single_orbits_pass() {
    let some = bodies(|i| 0.45 + 0.2 * i as f64 / 37.0, 37);
    for rtol in [1e-6, 1e-9, 1e-12] {
        let states = checked(&some, &how(&[0.0, 0.25, 3.0, 3.5, 41.7], rtol));
        assert!(states.iter().all(Option::is_some));
    }
    checked(&some, &how(&[0.0], 1e-9));
}

/// Members that leave every bound do so among others that do not.
#[test]
fn blow_up_is_the_same_in_company() {
    let states = checked(&bodies(|i| 0.1 + 0.01 * i as f64, 30), &how(&[50.0, 200.0], 1e-9));
    let arrived = states.iter().flatten().count();
    assert!(0 < arrived && arrived < states.len(), "{arrived} of {} arrive", states.len());
}

#[test]
fn a_stop_leaves_what_is_under_way() {
    let some = bodies(|_| 0.5, 40);
    let mut left = some.iter().enumerate();
    let mut next =
        || left.next().map(|(key, (body, state))| Start { key, body: body.as_ref(), state: state.clone() });
    let (mut told, watch) = (0, AfterAsked(AtomicUsize::new(0)));
    let ran = propagate_bodies(Kernel::Tensor, &how(&[1e4], 1e-9), &mut next, &mut |_, _| told += 1, &watch);
    assert_eq!((ran, told), (has_lanes(), 0));
}

/// Stops what has asked it twenty times.
struct AfterAsked(AtomicUsize);

impl Watch for AfterAsked {
    fn stopped(&self) -> bool {
        self.0.fetch_add(1, Ordering::Relaxed) >= 20
    }
}
