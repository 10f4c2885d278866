//! Curves along which the critical multiplier ceases to be resolved.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::samples::draws;
use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::symmetry::align;
use motiform_analysis::{PeriodicOrbit, Result};
use motiform_continuation::{Branch, Curve, CurvePoint, End, Settings};
use motiform_dynamics::{Equivariant, Request, drive::drive};
use motiform_models::tensor::{Tensor, TensorParameters};

type Body = Result<Box<dyn Equivariant>>;

fn body([kappa2, kappa3]: [f64; 2]) -> Tensor {
    let values = TensorParameters { a2: 0.2, b3: 0.5, d3: 0.5, ..TensorParameters::full(kappa2, kappa3) };
    Tensor::new(&values)
}

fn family(at: [f64; 2]) -> Body {
    Ok(Box::new(body(at)))
}

/// A simulated zigzag; `time` is half of its period.
fn zigzag(at: [f64; 2], time: f64, settings: &Settings) -> PeriodicOrbit {
    let (body, flow) = (body(at), &settings.flow);
    let after = |start: &[f64], time: f64| {
        let mut orbit = flow.method.shape_orbit(&body, flow.control, 0.0, start).unwrap();
        drive(orbit.as_mut(), &Request::until(time, 6), &mut ()).unwrap();
        orbit.state().to_vec()
    };
    let shape = after(&[-0.5, 0.001, 0.0, 0.0, 0.0, 0.0], 1500.0);
    let angle = align(&body, &after(&shape, time), &shape, true).angle;
    let guess = PeriodicGuess { shape: &shape, time, angle, mirrored: true };
    PeriodicOrbit::find(&body, &guess, flow, &()).unwrap()
}

/// Distance of the critical multiplier from -1.
fn off(point: &CurvePoint) -> f64 {
    let multipliers = &point.motion.orbit().unwrap().multipliers;
    multipliers.iter().map(|value| libm::hypot(value.0 + 1.0, value.1)).fold(f64::INFINITY, f64::min)
}

/// Towards a connection of saddles the period of the critical zigzag grows, and its multipliers change by `exp(lambda T)` with the
/// parameters: round-off of the parameters moves them by more than 1 in the end. The curve ends before, with this reason; it used to
/// wander on with a multiplier far from -1.
#[test]
fn a_curve_ends_where_its_critical_multiplier_is_not_resolved() {
    let settings = Settings::over(0.1, 0.3);
    let along = |kappa2: f64| family([kappa2, -0.1]);
    let start = zigzag([0.16, -0.1], 9.6, &settings);
    let mut branch = Branch::of_orbits(&along, 0.16, &start, &settings.reversed(), &()).unwrap();
    let breaking = branch.find(|point| point.special.is_some()).unwrap();
    for largest_step in [0.1, 0.02].into_iter().take(draws(1, 2)) {
        let settings = Settings { largest_step, ..Settings::over(-0.3, 1.0) };
        let mut curve = Curve::of(&family, &breaking, -0.1, &settings, (-0.3, 0.6), &()).unwrap();
        let points: Vec<CurvePoint> = curve.by_ref().collect();
        let Some(End::Lost { off: after }) = curve.end() else { unreachable!("{:?}", curve.end()) };
        assert!(*after > 1e-4, "{after}");
        let (first, last) = (points.first().unwrap(), points.last().unwrap());
        let period = |point: &CurvePoint| point.motion.orbit().unwrap().period();
        assert!(period(last) > 5.0 * period(first), "{}", period(last));
        for point in &points {
            assert!(off(point) <= 1e-4, "{} at {:?}", off(point), point.parameters);
        }
    }
}
