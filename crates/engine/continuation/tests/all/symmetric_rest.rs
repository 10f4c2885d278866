//! Shapes that vanish have the symmetry of the equations, whatever rounding leaves of them.

use motiform_analysis::{Error, RelativeEquilibrium};
use motiform_continuation::{Branch, Broken, End, Family, Point, Settings};
use motiform_dynamics::Equivariant;
use motiform_models::amplitudes::{Definition, ParameterDefinition, info};

/// One amplitude `z1 = x + iy` with this equation, and the mirror `y -> -y` alone.
fn family(equation: &str) -> impl Fn(f64) -> Result<Box<dyn Equivariant>, Error> + Sync + use<> {
    let model = info(&Definition {
        modes: vec![1],
        velocity: None,
        symmetry: Some("mirror".to_owned()),
        parameters: vec![ParameterDefinition::new("p", 0.0)],
        equations: vec![equation.to_owned()],
        noise: std::collections::BTreeMap::new(),
    })
    .expect("a model");
    move |p| {
        let body: Box<dyn Equivariant> = model.build(&[p]).expect("a body");
        Ok(body)
    }
}

/// The special points of the branch upwards or downwards from the motion near `guess`, and its end.
fn special(
    family: &dyn Family,
    (p, guess): (f64, [f64; 2]),
    settings: Settings,
) -> (Vec<(&'static str, f64)>, End) {
    let body = family.at(p).expect("a body");
    let start = RelativeEquilibrium::find(body.as_ref(), &guess).expect("a motion");
    let mut branch = Branch::of_equilibria(family, p, &start, &settings, &()).expect("a branch");
    let read = |point: Point| Some((point.special?.name(), point.parameter));
    let found = branch.by_ref().filter_map(read).collect();
    (found, branch.end().expect("an end").clone())
}

fn same(found: &[(&str, f64)], expected: &[(&str, f64)]) {
    let near = |(a, b): (&(&str, f64), &(&str, f64))| a.0 == b.0 && (a.1 - b.1).abs() < 1e-9;
    assert!(
        found.len() == expected.len() && found.iter().zip(expected).all(near),
        "{found:?}, not {expected:?}"
    );
}

/// `x' = p x - x^2 ..`, `y' = (p - 0.3) y ..`: the rest, which Newton's method leaves at 1e-25, is its own mirror image, so that another
/// branch crosses at 0 and a pitchfork follows at 0.3. The branch was said to become its own mirror image at 0, and ended.
#[test]
fn the_rest_has_the_mirror_axis_that_rounding_hides() {
    let family = family("(p-0.15)*z1 + 0.15*conj(z1) - (z1+conj(z1))*(z1+conj(z1))/4 - z1*conj(z1)*z1");
    let body = family(-0.5).expect("a body");
    let rest = RelativeEquilibrium::find(body.as_ref(), &[3e-10, 7e-10]).expect("the rest");
    assert_eq!(rest.shape, [0.0, 0.0]);
    let (found, end) = special(&family, (-0.5, [3e-10, 7e-10]), Settings::over(-1.0, 1.0));
    same(&found, &[("branch-point", 0.0), ("pitchfork", 0.3)]);
    assert_eq!(end, End::RangeLeft);
}

/// `y^2 = p` beside the rest: its branch ends there, at a pitchfork of the rest.
#[test]
fn a_branch_that_shrinks_to_the_rest_gains_its_mirror_axis() {
    let family = family("(p-1)/2*z1 - (p+1)/2*conj(z1) - z1*conj(z1)*z1");
    let (found, end) = special(&family, (0.5, [0.0, 0.7]), Settings::over(-1.0, 1.0).reversed());
    same(&found, &[("pitchfork", 0.0)]);
    assert!(matches!(end, End::Meets { gains: Broken::Mirror, .. }), "{end:?}");
}
