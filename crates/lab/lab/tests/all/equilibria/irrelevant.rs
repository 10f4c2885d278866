//! The invariance of a list of equilibria under what cannot matter: the seed, units, the order of the
//! unknowns, silent unknowns.

use super::other_search::{Field, distance, field, norm, text};
use super::{list, study, values};
use crate::samples::draws;
use motiform_study::{Study, presets::find_any};

/// The list for this seed, as values of the unknowns.
fn roots(field: &Field, seed: u64) -> Vec<Vec<f64>> {
    let mut study = study(&text(field));
    study.run.seed = seed;
    list(&study).iter().map(|one| values(one)[..field.len()].to_vec()).collect()
}

/// The same equations for `X_k = units_k x_k`.
fn in_units(field: &Field, units: &[f64]) -> Field {
    let scaled = |i: usize, (c, factors): &(f64, Vec<usize>)| {
        (factors.iter().fold(units[i] * c, |c, &k| c / units[k]), factors.clone())
    };
    field.iter().enumerate().map(|(i, terms)| terms.iter().map(|term| scaled(i, term)).collect()).collect()
}

/// The same equations for `X_(dim - 1 - k) = x_k`.
fn reversed(field: &Field) -> Field {
    let renamed = |factors: &[usize]| factors.iter().map(|&k| field.len() - 1 - k).collect();
    field
        .iter()
        .rev()
        .map(|terms| terms.iter().map(|(c, factors)| (*c, renamed(factors))).collect())
        .collect()
}

/// The same equations beside three unknowns that decay, each driven by the one before it.
fn with_silent(field: &Field) -> Field {
    let dim = field.len();
    let mut all = field.clone();
    all.extend((dim..dim + 3).map(|k| vec![(-1.0 - k as f64, vec![k]), (0.5, vec![k - 1])]));
    all
}

fn assert_same(found: &[Vec<f64>], wanted: &[Vec<f64>], what: &str) {
    assert_eq!(found.len(), wanted.len(), "{what}: {found:?}, not {wanted:?}");
    for root in wanted {
        let near = |one: &Vec<f64>| distance(one, root) < 1e-8 * norm(root).max(1e-3);
        assert!(found.iter().any(near), "{what}: {root:?} in {found:?}");
    }
}

#[test]
fn seeds_units_order_and_silent_unknowns_change_no_list() {
    let mut most = 0;
    for dim in (2..=6).step_by(draws(2, 1)) {
        for cubic in [false, true] {
            let field = field(dim, cubic, 1000 + dim as u64);
            let wanted = roots(&field, 0);
            most = most.max(wanted.len());
            let same = |what: &str, found: Vec<Vec<f64>>| {
                assert_same(&found, &wanted, &format!("{dim} unknowns, {what}"));
            };
            same("seed 1", roots(&field, 1));
            same("seed 2", roots(&field, 2));
            for unit in [1e-3, 1e3] {
                let mut found = roots(&in_units(&field, &vec![unit; dim]), 0);
                found.iter_mut().flatten().for_each(|x| *x /= unit);
                same(&format!("unit {unit}"), found);
            }
            let mut found = roots(&reversed(&field), 0);
            found.iter_mut().for_each(|root| root.reverse());
            same("reversed", found);
            let mut found = roots(&with_silent(&field), 0);
            found.iter_mut().for_each(|root| root.truncate(dim));
            same("silent", found);
        }
    }
    assert!(most > 5, "{most}");
}

/// Speed and turning rate of each, sorted.
fn motions(study: &Study, seed: u64) -> Vec<[i64; 2]> {
    let mut study = study.clone();
    study.run.seed = seed;
    let rounded = |x: f64| (1e8 * x).round() as i64;
    let mut all: Vec<_> =
        list(&study).iter().map(|one| [rounded(one.speed), rounded(one.turning_rate)]).collect();
    all.sort_unstable();
    all
}

#[test]
fn seeds_change_no_list_of_the_models() {
    for (name, model) in [("fig4", "tensor"), ("fig1", "tensor")] {
        let study = find_any(name, model).expect("a preset");
        for seed in 1..4 {
            assert_eq!(motions(&study, seed), motions(&study, 0), "{name}, seed {seed}");
        }
    }
}

/// The ellipse and the triangle of the full model, which zigzags: rates times `rate`, shapes times `length`.
fn zigzag(rate: f64, length: f64) -> Study {
    let equations = "z1 = \"s*((1 - |z1|^2/l^2)*z1 + 2/l*conj(z1)*z2)\"\n\
        z2 = \"s*(-0.9*z2 - 0.125/l*z1^2 + 0.3/l*conj(z1)*z3)\"\n\
        z3 = \"s*(-0.1*z3 + 0.0125/l^2*z1^3 + 0.4/l*z1*z2)\"";
    let parameters = format!("[model.amplitudes.parameters]\ns = {rate:?}\nl = {length:?}\n");
    study(&format!(
        "[model.amplitudes]\nmodes = [1, 2, 3]\n{parameters}[model.amplitudes.equations]\n{equations}"
    ))
}

/// A rotation is a change of shape by the unit of length, whatever that is, and the smallest step of Newton's method is the same one.
#[test]
fn units_change_no_list_of_motions_that_turn() {
    let wanted = motions(&zigzag(1.0, 1.0), 0);
    assert_eq!(wanted.len(), 5, "{wanted:?}");
    for (rate, length) in [(1e-3, 1e6), (1e3, 1e-6), (1.0, 1e-6), (1e-6, 1.0), (1e3, 1e6)] {
        let found = list(&zigzag(rate, length));
        let mut found: Vec<_> =
            found.iter().map(|one| [one.speed / length, one.turning_rate / rate]).collect();
        found.sort_by(|a, b| a.partial_cmp(b).unwrap());
        assert_eq!(found.len(), wanted.len(), "rate {rate}, length {length}: {found:?}");
        for (found, wanted) in found.iter().zip(&wanted) {
            let near = |(found, &wanted): (&f64, &i64)| (1e8 * found - wanted as f64).abs() < 2.0;
            assert!(
                found.iter().zip(wanted).all(near),
                "rate {rate}, length {length}: {found:?}, not {wanted:?}"
            );
        }
    }
}
