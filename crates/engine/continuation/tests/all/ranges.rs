//! Branches over ranges of any width, from starts anywhere on them: the same special points where the ranges overlap, and none outside.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::{Error, PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_continuation::{
    Branch, Degenerate, End, Family, Family2, Point, Settings, Special, WholeCurve, switch,
};
use motiform_dynamics::Equivariant;
use motiform_models::amplitudes::{Definition, ParameterDefinition, info};

/// The bodies of equations, one for each amplitude, over two parameters.
pub(crate) fn plane(
    symmetry: &str,
    equations: &[&str],
) -> impl Fn([f64; 2]) -> Result<Box<dyn Equivariant>> + Sync + use<> {
    let model = info(&Definition {
        modes: (1..=equations.len() as u32).collect(),
        velocity: None,
        symmetry: Some(symmetry.to_owned()),
        parameters: ["p", "q"].map(|name| ParameterDefinition::new(name, 0.0)).to_vec(),
        equations: equations.iter().map(|&equation| equation.to_owned()).collect(),
        noise: std::collections::BTreeMap::new(),
    })
    .expect("a model");
    move |values| {
        let none = |error: motiform_models::Error| Error::NoBody { value: values[0], why: error.to_string() };
        let body: Box<dyn Equivariant> = model.build(&values).map_err(none)?;
        Ok(body)
    }
}

/// The bodies of an equation for one amplitude.
fn family(symmetry: &str, equation: &str) -> impl Fn(f64) -> Result<Box<dyn Equivariant>> + Sync + use<> {
    let plane = plane(symmetry, &[equation]);
    move |p| plane([p, 0.0])
}

/// The points of codimension two on the curve through the first point of this kind, which begins at `x` and the parameters `from`, and the
/// number of its points.
fn degenerate(
    family: &dyn Family2,
    (from, x): ([f64; 2], &[f64]),
    kind: &str,
    [first, second]: [(f64, f64); 2],
) -> (Vec<(Degenerate, [f64; 2])>, usize) {
    let along = |p: f64| family.at([p, from[1]]);
    let start = RelativeEquilibrium::find(along(from[0]).unwrap().as_ref(), x).unwrap();
    let settings = Settings::over(first.0, first.1);
    let mut branch = Branch::of_equilibria(&along, from[0], &start, &settings, &()).unwrap();
    let special = branch.find(|point| point.special.is_some_and(|special| special.name() == kind)).unwrap();
    let curve = WholeCurve::through(family, &special, from[1], &settings, second, &()).unwrap();
    let found = curve.points.iter().filter_map(|point| Some((point.degenerate?, point.parameters)));
    (found.collect(), curve.points.len())
}

/// The points on both sides of the equilibrium near `x`.
fn points(family: &dyn Family, (p, x): (f64, f64), settings: &Settings) -> Vec<Point> {
    let start = RelativeEquilibrium::find(family.at(p).unwrap().as_ref(), &[x, 0.0]).unwrap();
    let leg = |settings| Branch::of_equilibria(family, p, &start, &settings, &()).unwrap();
    [settings.reversed(), *settings].into_iter().flat_map(leg).collect()
}

/// The special points by their parameter.
fn special(points: &[Point]) -> Vec<(f64, &'static str)> {
    let mut found: Vec<_> = points.iter().filter_map(|at| Some((at.parameter, at.special?.name()))).collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
}

/// `|z|^2 = 1 + p` crosses `|z| = 1` at p = 0, and is unstable below. Over a wide range steps led from one to the other, past the crossing;
/// to the pitchfork at p = -1, outside of the range; or the growth beyond was taken for 0.
#[test]
fn a_crossing_is_found_over_ranges_of_any_width_from_any_start() {
    for scale in [1e-3, 1.0, 1e3] {
        let family = family("rotation", &format!("{scale}*(i*0.5*|z1|^2 + (|z1|^2-1)*(1+p-|z1|^2))*z1"));
        // the lower end, the upper one, the start; with -0.1 nothing is found at the edge after the first steps
        let cases = [
            (-0.5, 1.0, 0.25),
            (-0.5, 1e2, 1.0),
            (-0.5, 1e2, 1e2),
            (-0.5, 1e4, 0.25),
            (-0.5, 1e4, 1e4),
            (-0.1, 1e4, 1e4),
            (-0.5, 1e5, 1e5),
            (-0.5, 9e5, 9e5),
        ];
        for (low, high, p) in cases {
            let found = points(&family, (p, (1.0 + p).sqrt()), &Settings::over(low, high));
            let case = format!("x{scale}, {p} in {low} to {high}: {:?}", special(&found));
            assert!(matches!(special(&found)[..], [(at, "branch-point")] if at.abs() < 1e-9), "{case}");
            let right = |at: &Point| at.special.is_some() || (at.parameter < 0.0) == (at.unstable > 0);
            assert!(found.iter().all(right), "{case}");
            assert!(
                found.iter().any(|at| at.parameter == low) && found.iter().any(|at| at.parameter == high),
                "{case}"
            );
        }
    }
}

/// The last step ends at the edge of the range, where the rest and the motion with `|z| = 1` are solutions, too. A step to `-z`, past the
/// pitchfork at p = -1, would leave the range and come back.
#[test]
fn the_end_at_the_edge_of_a_wide_range_is_on_the_branch() {
    let family = family("rotation", "(i*0.5*|z1|^2 + (|z1|^2-1)*(1+p-|z1|^2))*z1");
    let low = -0.9_f64;
    for (high, from) in [(1e3, 1e3), (3e3, 3e3), (1e4, 1e4), (1e4, 9e3)] {
        let found = points(&family, (from, f64::sqrt(1.0 + from)), &Settings::over(low, high));
        let end = found.iter().find(|at| at.parameter == low).map(|at| at.motion.shape());
        let size = end.map(|shape| f64::hypot(shape[0], shape[1]));
        let special = special(&found);
        assert!(size.is_some_and(|size| (size - f64::sqrt(1.0 + low)).abs() < 1e-6), "{high}: {size:?}");
        assert!(matches!(special[..], [(at, "branch-point")] if at.abs() < 1e-9), "{high}: {special:?}");
    }
}

/// Beside a parameter whose range is far wider than what matters, all else seemed to vanish: folds were called branch points or
/// continua, or listed twice.
#[test]
fn folds_have_their_name_over_ranges_of_any_width() {
    // p + a x - x^3 = 0: folds at p = +-2 (a/3)^(3/2)
    for a in [0.1, 0.01] {
        let family = family("none", &format!("p + {a}*re(z1) - re(z1)^3 - i*im(z1)"));
        let fold = 2.0 * f64::powf(a / 3.0, 1.5);
        for high in [1.0, 1e4, 1e5, 9e5] {
            let settings = Settings { most_points: 1500, ..Settings::over(-high, high) };
            let found = special(&points(&family, (-0.01, -0.4), &settings));
            let [(low, first), (high, second)] = found[..] else { unreachable!("{a} {high}: {found:?}") };
            assert_eq!((first, second), ("fold", "fold"), "{a} {high}");
            assert!((low + fold).abs() < 1e-9 && (high - fold).abs() < 1e-9, "{a} {high}: {found:?}");
        }
    }
}

/// `x' = p + q x - x^3`: in units of a wide range the parameters hardly change beside the cusp, and their direction had a sign of rounding:
/// there were several cusps, or one elsewhere.
#[test]
fn folds_meet_in_one_cusp_in_ranges_of_any_width() {
    let family = plane("none", &["p + q*re(z1) - re(z1)^3 - i*im(z1)"]);
    for (first, second) in [(1.0, 1.0), (1.0, 1e3), (10.0, 1e5), (1e3, 10.0), (1e5, 1e5)] {
        let ranges = [(-first, first), (-second, second)];
        let (found, _) = degenerate(&family, ([0.0, 0.8], &[-0.9, 0.0]), "fold", ranges);
        let [(Degenerate::Cusp, [p, q])] = found[..] else { unreachable!("{first} {second}: {found:?}") };
        assert!(p.abs() < 1e-8 * first && q.abs() < 1e-9 * second.max(10.0), "{first} {second}: {found:?}");
    }
}

/// Two oscillators: beside the Hopf point, in units of a wide range, the pair of the other one was taken for the critical one, and no
/// curve began.
#[test]
fn hopf_curves_begin_in_ranges_of_any_width() {
    let equations = ["(p + 2*i - |z1|^2)*z1", "(q + 3.3*i - |z2|^2)*z2"];
    let family = plane("none", &equations);
    for first in [1.0, 1e3, 1e5] {
        let ranges = [(-first, first), (-1.0, 1.0)];
        let (found, points) = degenerate(&family, ([-0.2, -0.5], &[0.0; 4]), "hopf", ranges);
        let [(Degenerate::DoubleHopf, [p, q])] = found[..] else { unreachable!("{first}: {found:?}") };
        assert!(p.abs().max(q.abs()) < 1e-8 && points > 50, "{first}: {found:?}");
    }
}

/// `x' = y`, `y' = (p - x^2) y - q x - x^3`, with `x -> -x`: Hopf bifurcations on `p = 0`, `q > 0`. At `q = 0` a pitchfork crosses, where
/// the equations are singular: the point was at the end of its step, and of no kind.
#[test]
fn a_hopf_curve_ends_at_a_point_where_the_equations_are_singular() {
    let family = plane("none", &["im(z1) + i*((p - re(z1)^2)*im(z1) - q*re(z1) - re(z1)^3)"]);
    for (first, second) in [(1.0, 1.0), (1.0, 0.7), (1.0, 1e3), (1e3, 10.0)] {
        let ranges = [(-first, first), (-second, second)];
        let (found, _) = degenerate(&family, ([-0.2, 0.5], &[0.0; 2]), "hopf", ranges);
        let [(Degenerate::BogdanovTakens, [p, q])] = found[..] else {
            unreachable!("{first} {second}: {found:?}")
        };
        assert!(p.abs() < 1e-8 && q.abs() < 1e-8 * second, "{first} {second}: {found:?}");
    }
}

/// `|z|^2 = p`: steps are as long as the orbit is large. While they kept the length of the start there were as many points as sizes of it.
#[test]
fn a_growing_orbit_has_few_points() {
    let family = family("none", "(p - |z1|^2 + 2*i)*z1");
    let guess = PeriodicGuess { shape: &[0.3, 0.4], time: std::f64::consts::PI, angle: 0.0, mirrored: false };
    let start = |settings: &Settings| {
        PeriodicOrbit::find(family(0.25).unwrap().as_ref(), &guess, &settings.flow, &())
    };
    let leg = |high: f64| -> Vec<Point> {
        let settings = Settings::over(-1.0, high);
        Branch::of_orbits(&family, 0.25, &start(&settings).unwrap(), &settings, &()).unwrap().collect()
    };
    let (near, far) = (leg(4.0), leg(100.0));
    // the size is 20 times that of the start: 200 steps to 4 times, then 2 % of a quarter of it each
    assert!(far.len() < 600 && near.len() < far.len(), "{} {}", near.len(), far.len());
    for point in far {
        let shape = point.motion.shape();
        assert!(
            (f64::hypot(shape[0], shape[1]) - point.parameter.sqrt()).abs() < 1e-8 * point.parameter.sqrt()
        );
    }
}

/// Van der Pol's equation at 0 is `x'' = -x`: circles of all sizes, with the period 2 pi. They are a family, not a branch with folds.
#[test]
fn circles_of_a_linear_centre_are_one_family() {
    let family = family("none", "im(z1) + i*(p*(1 - re(z1)^2)*im(z1) - re(z1))");
    let settings = Settings::over(1.0, -1.0);
    let guess = PeriodicGuess { shape: &[2.0, 0.0], time: 6.4, angle: 0.0, mirrored: false };
    let start = PeriodicOrbit::find(family(0.5).unwrap().as_ref(), &guess, &settings.flow, &()).unwrap();
    let mut branch = Branch::of_orbits(&family, 0.5, &start, &settings, &()).unwrap();
    let crossing = branch.find(|point| point.special.is_some()).unwrap();
    assert!(
        crossing.parameter.abs() < 1e-9 && crossing.special == Some(Special::BranchPoint),
        "{crossing:?}"
    );
    let mut ends = Vec::new();
    for mut leg in switch(&family, &crossing, &settings, &()).unwrap().into_iter().flatten() {
        for point in leg.by_ref() {
            let period = point.motion.orbit().unwrap().period();
            assert!(
                (period - std::f64::consts::TAU).abs() < 1e-7 && point.parameter.abs() < 1e-9,
                "{point:?}"
            );
            match point.special {
                None => assert!(point.neutral > 0, "{point:?}"),
                Some(special) => {
                    assert!(special == Special::BranchPoint && point.arclength <= 0.0, "{point:?}");
                }
            }
        }
        ends.push(leg.end().unwrap().clone());
    }
    assert!(
        ends.iter().any(|end| matches!(end, End::Family { parameter } if parameter.abs() < 1e-9)),
        "{ends:?}"
    );
}
