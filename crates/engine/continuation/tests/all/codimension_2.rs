//! Points of codimension two: none is invented beside others, and where curves of orbits end.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{near, reduced};
use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_continuation::{Branch, Curve, CurvePoint, Degenerate, End, Family, Family2, Point, Settings};
use motiform_dynamics::{Equivariant, Scalar, VectorField};
use motiform_models::tensor::reduced::Reduced;

type Body = Result<Box<dyn Equivariant>>;

/// The points of codimension two on both sides of a point, those of the reversed settings first, and the ends.
fn both(
    family: &dyn Family2,
    point: &Point,
    second: f64,
    settings: &Settings,
    range: (f64, f64),
) -> (Vec<CurvePoint>, Vec<End>) {
    let (mut found, mut ends) = (Vec::new(), Vec::new());
    for settings in [settings.reversed(), *settings] {
        let mut curve = Curve::of(family, point, second, &settings, range, &()).expect("a curve");
        for point in curve.by_ref() {
            if point.degenerate.is_some() {
                found.push(point);
            } else {
                let off = (point.residual / point.transversality).abs();
                assert!(off < 1e-7, "{off} from the curve at {:?}", point.parameters);
            }
        }
        ends.push(curve.end().expect("an end").clone());
    }
    (found, ends)
}

fn first(family: &dyn Family, p: f64, guess: &[f64], settings: &Settings, name: &str) -> Point {
    let start =
        RelativeEquilibrium::find(family.at(p).expect("a body").as_ref(), guess).expect("an equilibrium");
    let mut branch = Branch::of_equilibria(family, p, &start, settings, &()).expect("a branch");
    branch.find(|point| point.special.is_some_and(|special| special.name() == name)).expect("a special point")
}

/// `z' = (p + 3i + w) z - |z|^2 z`, `w' = q + w^2 + |z|^2`. On the equilibria `w = w0`, `q = -w0^2` the Hopf bifurcations are at `p = -w0`,
/// and `l1 = 2 (-1 - 1/(2 w0)) / 3`: a pole at the zero-Hopf point `w0 = 0`, and a Bautin point at `w0 = -1/2`.
struct Pole {
    p: f64,
    q: f64,
}
motiform_models::plain!(Pole, 3);
impl<T: Scalar> VectorField<T> for Pole {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, w) = (u[0], u[1], u[2]);
        let square = x * x + y * y;
        let growth = x.constant(self.p) + w - square;
        du[0] = growth * x - y * 3.0;
        du[1] = growth * y + x * 3.0;
        du[2] = x.constant(self.q) + w * w + square;
    }
}

#[test]
fn a_pole_of_the_first_lyapunov_coefficient_is_no_bautin_point() {
    let family = |[p, q]: [f64; 2]| -> Body { Ok(Box::new(Pole { p, q })) };
    let along = |p: f64| family([p, -1.0]);
    for largest_step in [0.02, 0.05, 0.2] {
        let settings = Settings { largest_step, ..Settings::over(-1.2, 1.5) };
        let hopf = first(&along, 0.5, &[0.0, 0.0, -1.0], &settings, "hopf");
        near(hopf.parameter, 1.0, 1e-9);
        let (found, _) = both(&family, &hopf, -1.0, &settings, (-1.3, 0.5));
        let kinds: Vec<Degenerate> = found.iter().filter_map(|point| point.degenerate).collect();
        assert_eq!(kinds, [Degenerate::Bautin, Degenerate::ZeroHopf], "{largest_step}");
        near(found[0].parameters[0], 0.5, 1e-8);
        near(found[0].parameters[1], -0.25, 1e-8);
        near(found[1].parameters[0], 0.0, 1e-8);
        near(found[1].parameters[1], 0.0, 1e-8);
    }
}

/// `z' = (p + 3i + w) z + q |z|^2 z - |z|^4 z`, `w' = 0.3 |z|^2 - w`: cycles of radius r have folds at `r^2 = (q + 0.3)/2`, `p = -r^4`,
/// which end at the Bautin point `p = 0`, `q = -0.3`.
struct Quintic {
    p: f64,
    q: f64,
}
motiform_models::plain!(Quintic, 3);
impl<T: Scalar> VectorField<T> for Quintic {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, w) = (u[0], u[1], u[2]);
        let square = x * x + y * y;
        let growth = x.constant(self.p) + w + square * self.q - square * square;
        du[0] = growth * x - y * 3.0;
        du[1] = growth * y + x * 3.0;
        du[2] = square * 0.3 - w;
    }
}

#[test]
fn folds_of_cycles_end_at_a_bautin_point() {
    let family = |[p, q]: [f64; 2]| -> Body { Ok(Box::new(Quintic { p, q })) };
    let along = |p: f64| family([p, 0.5]);
    for largest_step in [0.02, 0.05] {
        let settings = Settings { largest_step, ..Settings::over(-0.5, 0.5) };
        let guess =
            PeriodicGuess { shape: &[0.6_f64.sqrt(), 0.0, 0.18], time: 2.1, angle: 0.0, mirrored: false };
        let start = PeriodicOrbit::find(&Quintic { p: -0.12, q: 0.5 }, &guess, &settings.flow, &()).unwrap();
        let branch = Branch::of_orbits(&along, -0.12, &start, &settings.reversed(), &()).unwrap();
        let fold = branch.into_iter().find(|point| point.special.is_some()).unwrap();
        near(fold.parameter, -0.16, 1e-9);
        let (found, ends) = both(&family, &fold, 0.5, &settings, (-1.0, 1.0));
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].degenerate, Some(Degenerate::Bautin));
        near(found[0].parameters[0], 0.0, 1e-7);
        near(found[0].parameters[1], -0.3, 1e-6);
        assert!(ends.contains(&End::Degenerate { kind: Degenerate::Bautin }), "{ends:?}");
    }
}

/// The Hopf line of circular motion of the reduced model ends in the origin, where everything vanishes. Near it the coefficient is lost in
/// rounding.
#[test]
fn beside_the_origin_of_the_reduced_model_there_are_no_bautin_points() {
    let plane = |[gamma, kappa2]: [f64; 2]| -> Body { Ok(Box::new(reduced(kappa2, gamma))) };
    let along = |gamma: f64| plane([gamma, -0.06]);
    for settings in [Settings::over(-0.01, 0.12), Settings { largest_step: 0.05, ..Settings::over(0.0, 0.1) }]
    {
        let circular = Reduced::PAPER.circular(-0.06, 0.1).unwrap();
        let sine = (1.0 - circular.cos_psi * circular.cos_psi).sqrt();
        let guess = [circular.speed, 0.0, circular.r2 * circular.cos_psi, circular.r2 * sine, 0.0, 0.0];
        let hopf = first(&along, 0.1, &guess, &settings.reversed(), "hopf");
        let (found, ends) = both(&plane, &hopf, -0.06, &settings, (-0.22, 0.01));
        ends_at_the_origin(&found, &ends);
    }
}

/// The only point of codimension two is the origin, where the shape becomes a circle.
fn ends_at_the_origin(found: &[CurvePoint], ends: &[End]) {
    let all: Vec<_> = found.iter().map(|p| (p.degenerate, p.parameters)).collect();
    assert!(matches!(all[..], [(Some(Degenerate::GainsSymmetry), _)]), "{all:?}");
    found[0].parameters.iter().for_each(|value| near(*value, 0.0, 1e-7));
    let ended = ends.iter().filter(|end| **end == End::Degenerate { kind: Degenerate::GainsSymmetry });
    assert_eq!(ended.count(), 1, "{ends:?}");
}

/// The line of drift pitchfork passes the origin, where all eigenvalues vanish and nothing was located, and goes on.
#[test]
fn the_pitchfork_line_of_the_reduced_model_passes_the_circle() {
    let plane = |[gamma, kappa2]: [f64; 2]| -> Body { Ok(Box::new(reduced(kappa2, gamma))) };
    let [kappa2, _] = Reduced::PAPER.straight_to_circular(0.03);
    let along = |gamma: f64| plane([gamma, kappa2]);
    for largest_step in [0.02, 0.05] {
        let settings = Settings { largest_step, ..Settings::over(-0.02, 0.3) };
        let start = Settings::over(0.005, 0.3);
        let point = first(&along, 0.01, &[0.1, 0.0, 0.01, 0.0, 0.0, 0.0], &start, "pitchfork");
        let (found, ends) = both(&plane, &point, kappa2, &settings, (-0.1, 0.22));
        let all: Vec<_> = found.iter().map(|p| (p.degenerate, p.parameters)).collect();
        assert!(matches!(all[..], [(Some(Degenerate::GainsSymmetry), _)]), "{all:?}");
        found[0].parameters.iter().for_each(|value| near(*value, 0.0, 1e-7));
        assert_eq!(ends, [End::RangeLeft, End::RangeLeft]);
    }
}

/// Towards the origin the frequency and the speed of straight motion vanish, and with them what the coefficient is made of.
#[test]
fn the_hopf_line_of_straight_motion_has_one_bautin_point_up_to_the_origin() {
    let plane = |[gamma, kappa2]: [f64; 2]| -> Body { Ok(Box::new(reduced(kappa2, gamma))) };
    let s = -0.03;
    let [kappa2, gamma] = Reduced::PAPER.straight_hopf(s);
    let along = |gamma: f64| plane([gamma, kappa2]);
    let guess = [(gamma - 2.0 * s).sqrt(), 0.0, s, 0.0, 0.0, 0.0];
    let start = Settings::over(gamma - 0.004, gamma + 0.004);
    let point = first(&along, gamma - 0.001, &guess, &start, "hopf");
    for range in [(-0.1, 0.1), (-0.07, 0.05), (-0.2, 0.01)] {
        let mut found = Vec::new();
        for settings in [Settings::over(-0.16, 0.12), Settings::over(-0.16, 0.12).reversed()] {
            let curve = Curve::of(&plane, &point, kappa2, &settings, range, &()).unwrap();
            found.extend(curve.filter_map(|point| Some((point.degenerate?, point.parameters))));
        }
        found.retain(|one| one.0 == Degenerate::Bautin);
        assert!(matches!(found[..], [(Degenerate::Bautin, _)]), "{range:?}: {found:?}");
        near(found[0].1[1], -0.066_873_7, 1e-6);
    }
}
