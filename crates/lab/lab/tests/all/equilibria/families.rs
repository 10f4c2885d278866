//! A family of equilibria is one entry, whichever of its members are found.

use super::{list, study, values};
use motiform_lab::equilibria::Equilibrium;

fn text(modes: &str, symmetry: &str, equations: &str) -> String {
    format!(
        "[model.amplitudes]\nmodes = [{modes}]\nsymmetry = \"{symmetry}\"\n[model.amplitudes.equations]\n{equations}"
    )
}

/// Dimensions of the families, sorted; the same for three seeds.
fn families(text: &str) -> Vec<usize> {
    let of = |seed: u64| {
        let mut study = study(text);
        study.run.seed = seed;
        let mut all: Vec<usize> = list(&study).iter().map(|one| one.family).collect();
        all.sort_unstable();
        all
    };
    let first = of(0);
    assert!((1..4).all(|seed| of(seed) == first), "{first:?} {text}");
    first
}

/// A circle of rests; two of them, which make a torus with the phases of both; and an ellipse and its axes,
/// where the path from one member to the next goes round a curve that is no circle.
#[test]
fn circles_and_tori_of_equilibria_are_one_entry_each() {
    let one = "z1 = \"(1 - |z1|^2)*z1\"";
    let found = list(&study(&text("1", "none", one)));
    assert_eq!(found.len(), 2, "{found:?}");
    let sizes: Vec<f64> = found.iter().map(|one| values(one)[0].hypot(values(one)[1])).collect();
    assert!((sizes[0] - 1.0).abs() < 1e-9 && sizes[1] < 1e-12, "{sizes:?}");
    assert_eq!(families(&text("1", "none", one)), [0, 1]);
    let two = "z1 = \"(1 - |z1|^2)*z1\"\nz3 = \"(0.2 - |z3|^2)*z3\"";
    assert_eq!(families(&text("1, 3", "none", two)), [0, 1, 1, 2]);
    // x^2 + 9 y^2 = 1, a curve whose far ends are near to each other across
    let ellipse = "z1 = \"(1 - (0.5*(z1+conj(z1)))^2 - 9*((-i/2)*(z1-conj(z1)))^2)*z1\"";
    assert_eq!(families(&text("1", "none", ellipse)), [0, 1]);
}

/// The game of rock, paper and scissors: every point of the line x = y = z is a centre, with the eigenvalues 0 and +-i x sqrt(3).
#[test]
fn a_line_of_centres_is_a_family() {
    let game = "z2 = \"re(z2)*(im(z2)-re(z3)) + i*im(z2)*(re(z3)-re(z2))\"\nz3 = \"re(z3)*(re(z2)-im(z2)) - i*im(z3)\"";
    let text = text("2, 3", "none", game).replace("symmetry", "velocity = \"z2\"\nsymmetry");
    // the line, and the three axes, on which every point rests
    let found = list(&study(&text));
    let lines = found.iter().filter(|one| one.family == 1).count();
    assert!(lines >= 2 && found.len() <= 5, "{found:?}");
    let line = found.iter().find(|one| one.eigenvalues.iter().any(|value| value.1 != 0.0)).unwrap();
    assert_eq!(line.family, 1, "{line:?}");
}

/// The reduced model (a1 = 1, b1 = .5, b3 = 1) without a word about its symmetry has the rests and straight
/// motions that it has with all of it: its rotated copies are a family. (A body that turns is no equilibrium
/// of the unreduced equations.)
#[test]
fn an_undeclared_symmetry_changes_no_list_of_motions_that_do_not_turn() {
    for (kappa2, gamma) in [(0.18, 0.1), (-0.1, 0.05), (-0.1, -0.04), (0.02, 0.05)] {
        let equations = format!(
            "z1 = \"({gamma} - |z1|^2)*z1 - 2*conj(z1)*z2\"\nz2 = \"({} - 8*|z2|^2)*z2 + 0.125*z1^2\"",
            -kappa2
        );
        let seen = |symmetry: &str| {
            let still = |one: &Equilibrium| one.turning_rate == 0.0;
            let found = list(&study(&text("1, 2", symmetry, &equations)));
            let mut all: Vec<(String, i64, usize)> = found
                .iter()
                .filter(|one| still(one))
                .map(|one| (one.motion.to_string(), (1e7 * one.speed).round() as i64, one.unstable))
                .collect();
            all.sort();
            all
        };
        assert_eq!(seen("none"), seen("rotation+mirror"), "{kappa2} {gamma}");
    }
}

/// Two shapes that have a vanishing eigenvalue each, at a bifurcation, are two: no path leads from one to the
/// other.
#[test]
fn equilibria_at_bifurcations_are_no_family() {
    // double roots at x = -1 and x = 1, y = 0
    let double = "z1 = \"-((0.5*(z1+conj(z1)))^2 - 1)^2 - i*((-i/2)*(z1-conj(z1)))\"";
    let found = list(&study(&text("1", "none", double)));
    assert!(found.iter().all(|one| one.family == 0), "{found:?}");
    for root in [-1.0, 1.0] {
        assert!(found.iter().any(|one| (values(one)[0] - root).abs() < 1e-3), "{found:?}");
    }
}
