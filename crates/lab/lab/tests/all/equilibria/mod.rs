//! The list of equilibria is complete: closed forms, and another search.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod families;
mod irrelevant;
mod other_search;
mod tensor;

use motiform_lab::equilibria::{Equilibrium, FoundBy, equilibria};
use motiform_study::{RunPlan, Study};

fn study(text: &str) -> Study {
    Study::parse(text, "text", "test").unwrap()
}

/// The list with the default number of starts.
fn list(study: &Study) -> Vec<Equilibrium> {
    list_from(study, 200)
}

fn list_from(study: &Study, starts: usize) -> Vec<Equilibrium> {
    equilibria(&RunPlan::new(study).unwrap(), starts, &()).unwrap().unwrap()
}

/// The real and imaginary parts of the amplitudes: the velocity is the conjugate of z1.
fn values(one: &Equilibrium) -> Vec<f64> {
    let mut values = one.shape.values();
    values[1] = -values[1];
    values
}

/// The Lorenz equations for `x + iy = z1`, `z = Re z2`, in a unit of length: r = 20 has its steady states at distances of 21 units.
fn lorenz(r: f64, unit: f64) -> Study {
    let text = "[model.amplitudes]\nmodes = [1, 2]\nsymmetry = \"none\"\n[model.amplitudes.parameters]\nr = 20.0\ns = 10.0\n\
        b = 2.6666666666666665\nk = 1.0\n[model.amplitudes.equations]\n\
        z1 = \"s*(Y - X) + i*(r*X - Y - k*X*Z)\"\nz2 = \"k*X*Y - b*Z - i*((-i/2)*(z2-conj(z2)))\"";
    let text = text.replace('X', "(0.5*(z1+conj(z1)))").replace('Y', "((-i/2)*(z1-conj(z1)))");
    let mut study = study(&text.replace('Z', "(0.5*(z2+conj(z2)))"));
    study.set("r", r).unwrap();
    study.set("k", 1.0 / unit).unwrap();
    study
}

/// The origin, and `x = y = -+sqrt(b(r-1))`, `z = r - 1`: Lorenz (1963), J. Atmos. Sci. 20, 130, eq. (31).
#[test]
fn the_lorenz_equations_have_three_steady_states_in_any_unit() {
    for unit in [1e-3, 1.0, 1e4] {
        for r in [0.5, 2.0, 10.0, 20.0, 24.0, 28.0_f64] {
            let found = list(&lorenz(r, unit));
            let x = (8.0 / 3.0 * (r - 1.0)).sqrt();
            let mut wanted = vec![[0.0; 3]];
            if r > 1.0 {
                wanted.extend([[x, x, r - 1.0], [-x, -x, r - 1.0]]);
            }
            assert_eq!(found.len(), wanted.len(), "r = {r}, unit {unit}: {found:?}");
            for want in wanted {
                let near =
                    |one: &Equilibrium| (0..3).all(|i| (values(one)[i] / unit - want[i]).abs() < 1e-9 * r);
                assert!(found.iter().any(near), "r = {r}, unit {unit}: {want:?} in {found:?}");
            }
            assert!(found.iter().all(|one| one.residual < 1e-11 * unit * r));
        }
    }
}

/// In this unit of length random starts are smaller than most of the others' distances: few lead there.
#[test]
fn what_deflation_alone_finds_has_no_share() {
    let found = list_from(&lorenz(20.0, 0.7), 20);
    let ways: Vec<_> = found.iter().map(|one| (one.found_by, one.share)).collect();
    assert_eq!(ways.iter().filter(|way| **way == (FoundBy::Deflation, 0.0)).count(), 2, "{ways:?}");
    assert_eq!(ways.iter().filter(|way| **way == (FoundBy::Starts, 1.0)).count(), 1, "{ways:?}");
    assert_eq!(list_from(&lorenz(20.0, 0.7), 20), found, "the same bits");
}

/// A double root at -1 beside a regular one at 2: it is not listed again and again.
#[test]
fn multiple_roots_are_not_multiplied() {
    let fold = "[model.amplitudes]\nmodes = [1]\nsymmetry = \"none\"\n[model.amplitudes.equations]\n\
        z1 = \"2 + 3*(0.5*(z1+conj(z1))) - (0.5*(z1+conj(z1)))^3 - i*((-i/2)*(z1-conj(z1)))\"";
    let found = list(&study(fold));
    let regular = found.iter().filter(|one| (values(one)[0] - 2.0).abs() < 1e-12).count();
    let double = found.iter().filter(|one| (values(one)[0] + 1.0).abs() < 1e-5).count();
    assert_eq!((regular, found.len() - double), (1, 1), "{found:?}");
}

/// Exactly at pitchforks, and where straight motion begins to turn: shapes of a hundred thousandth of the others' size solve the equations
/// to Newton's accuracy there, and are the same equilibrium. Whatever the seed.
#[test]
fn equilibria_where_branches_meet_are_listed_once() {
    let counts = |model, name: &str, set: &[(&str, f64)], expected: [usize; 2]| {
        for seed in [1, 2, 5] {
            let mut study = motiform_study::presets::find_any(name, model).unwrap();
            set.iter().for_each(|(name, value)| study.set(name, *value).unwrap());
            study.run.seed = seed;
            let found = list(&study);
            let rests = found.iter().filter(|one| one.speed < 1e-3).count();
            assert_eq!([rests, found.len() - rests], expected, "{name}, seed {seed}: {found:?}");
        }
    };
    // gamma = -sqrt(-kappa2/2)
    counts("tensor", "fig1", &[("kappa2", -0.02), ("gamma", -0.1)], [2, 0]);
    // straight motion begins to turn
    counts("amplitudes", "ohta-ohkuma", &[("gamma", 0.75)], [1, 1]);
    // along the field straight motion begins at a1 = gamma 2 kappa2/E^2, beside the two across it
    counts("amplitudes", "elongating-field", &[("a1", 0.781_25)], [1, 2]);
    counts("amplitudes", "elongating-field", &[("a1", -0.781_25)], [1, 2]);
}

/// `x' = m x - x^3/unit^2`: three roots, however near to each other and in whatever unit.
#[test]
fn roots_beside_a_pitchfork_are_three() {
    for unit in [1e-3, 1.0, 1e3] {
        for m in [1e-8, 1e-4, 0.04] {
            let text = format!(
                "[model.amplitudes]\nmodes = [1]\nsymmetry = \"none\"\n[model.amplitudes.equations]\n\
                 z1 = \"{m:e}*(0.5*(z1+conj(z1))) - {:e}*(0.5*(z1+conj(z1)))^3 - i*((-i/2)*(z1-conj(z1)))\"",
                1.0 / (unit * unit)
            );
            let found = list(&study(&text));
            assert_eq!(found.len(), 3, "unit {unit}, m = {m}: {found:?}");
        }
    }
}

/// FitzHugh-Nagumo: `x - x^3/3 - y = 0`, `x + a = b y` has one solution. Where y is 1e15, the derivatives of
/// `x^3` are rounding alone, and hundreds of places seemed to be solutions.
#[test]
fn rounding_far_away_is_no_equilibrium() {
    let text = "[model.amplitudes]\nmodes = [1]\nsymmetry = \"none\"\n[model.amplitudes.equations]\n\
        z1 = \"X - X^3/3 - Y + i*(0.08*(X + 0.7 - 0.8*Y))\"";
    let text = text.replace('X', "(0.5*(z1+conj(z1)))").replace('Y', "((-i/2)*(z1-conj(z1)))");
    for seed in 0..3 {
        let mut study = study(&text);
        study.run.seed = seed;
        let found = list(&study);
        assert_eq!(found.len(), 1, "{found:?}");
        let (x, y) = (values(&found[0])[0], values(&found[0])[1]);
        assert!((x - x * x * x / 3.0 - y).abs() + (x + 0.7 - 0.8 * y).abs() < 1e-12, "{x} {y}");
    }
}

/// The Brusselator, `1 - (b + 1) x + x^2 y = 0`, `b x - x^2 y = 0`, has one solution, (1, b). Along `x y = b`, far out, all terms but one
/// cancel: the residual is small against the largest of them, but no rounding.
#[test]
fn a_small_part_of_large_terms_is_no_equilibrium() {
    let text = "[model.amplitudes]\nmodes = [2]\nvelocity = \"z2\"\nsymmetry = \"none\"\n[model.amplitudes.parameters]\nb = 2.5\n\
        [model.amplitudes.equations]\nz2 = \"1 - (b+1)*re(z2) + re(z2)^2*im(z2) + i*(b*re(z2) - re(z2)^2*im(z2))\"";
    for (starts, seed, b) in [(200, 1, 2.5), (2000, 1, 2.5), (2000, 2, 1.5), (2000, 1, 4.0)] {
        let mut study = study(&text.replace("b = 2.5", &format!("b = {b}")));
        study.run.seed = seed;
        let found = list_from(&study, starts);
        assert_eq!(found.len(), 1, "{found:?}");
        let (x, y) = (values(&found[0])[0], -values(&found[0])[1]); // of z2, not conjugated
        assert!((x - 1.0).abs() + (y - b).abs() < 1e-12, "{x} {y}");
    }
}
