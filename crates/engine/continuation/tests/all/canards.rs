//! Folds within canard explosions.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::samples::draws;
use motiform_analysis::{RelativeEquilibrium, Result};
use motiform_continuation::{Branch, Point, Settings, switch};
use motiform_dynamics::{Equivariant, Scalar, VectorField};

type Body = Result<Box<dyn Equivariant>>;

/// `v' = v - v^3/3 - w + J`, `w' = eps (v + 0.7 - 0.8 w)`: `(v, w, J)` and `(-v, 7/4 - w, 7/4 - J)` are images of each other.
struct Nagumo {
    current: f64,
    eps: f64,
}
motiform_models::plain!(Nagumo, 2);
impl<T: Scalar> VectorField<T> for Nagumo {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (v, w) = (u[0], u[1]);
        du[0] = v - v * v * v * (1.0 / 3.0) - w + v.constant(self.current);
        du[1] = (v + v.constant(0.7) - w * 0.8) * self.eps;
    }
}

/// The points of the branch of orbits that begins at the Hopf bifurcation at the smaller current, or at the larger one.
fn orbits(eps: f64, settings: &Settings, larger: bool, count: usize) -> Vec<Point> {
    let family = move |current: f64| -> Body { Ok(Box::new(Nagumo { current, eps })) };
    let from = if larger { 1.9 } else { -0.1 };
    let rest =
        RelativeEquilibrium::find(&Nagumo { current: from, eps }, &[if larger { 1.5 } else { -1.5 }, 0.0])
            .unwrap();
    let settings = if larger { settings.reversed() } else { *settings };
    let mut branch = Branch::of_equilibria(&family, from, &rest, &settings, &()).unwrap();
    let hopf = branch.find(|point| point.special.is_some()).unwrap();
    let mut orbits = switch(&family, &hopf, &settings, &()).unwrap().pop().unwrap().pop().unwrap();
    orbits.by_ref().take(count).collect()
}

/// The folds of both canard explosions are images of each other: their currents and their periods are the same within their errors.
#[test]
fn folds_of_mirror_images_within_canard_explosions_have_the_same_period() {
    let all = [(0.05, -0.5, 2.0, 200), (0.02, -0.3, 1.9, 260)];
    for (eps, low, high, count) in all.into_iter().take(draws(1, 2)) {
        let settings = Settings::over(low, high);
        let fold = |larger: bool| {
            let points = orbits(eps, &settings, larger, count);
            let found: Vec<Point> = points.into_iter().filter(|point| point.special.is_some()).collect();
            assert_eq!(
                found.iter().map(|point| point.special.unwrap().name()).collect::<Vec<_>>(),
                ["fold"],
                "{eps}"
            );
            let certificate = found[0].certificate.unwrap();
            (found[0].parameter, found[0].motion.orbit().unwrap().period(), certificate)
        };
        let [a, b] = [false, true].map(fold);
        assert!((a.0 + b.0 - 1.75).abs() <= a.2.error + b.2.error, "{a:?} {b:?}");
        assert!((a.1 - b.1).abs() <= a.2.time_error + b.2.time_error, "{a:?} {b:?}");
        assert!(a.2.time_error < 1e-3 * a.1, "{a:?}");
    }
}

/// Far from 1 a multiplier excludes a fold, whatever the sign of a slope of round-off.
#[test]
fn where_a_multiplier_is_far_from_1_there_is_no_fold() {
    let points = orbits(0.001, &Settings::over(-0.5, 2.0), true, draws(170, 240));
    assert!(points.len() > 160, "{}", points.len());
    for point in points.iter().filter(|point| point.special.is_some()) {
        let multiplier = point.motion.orbit().unwrap().multipliers[0].0;
        assert!((multiplier - 1.0).abs() < 1e-3, "{multiplier:e} {:?}", point.special);
    }
}
