//! Random equations compared with a search that shares nothing with the program's: plain Newton's method from many starts.

use super::{list, study, values};
use crate::samples::draws;
use motiform_study::initial::Uniform;
use std::fmt::Write;

/// A coefficient and the numbers of its factors.
type Term = (f64, Vec<usize>);

/// Right-hand sides of real unknowns: sums of terms.
pub(super) type Field = Vec<Vec<Term>>;

/// Linear, four quadratic and, on request, four cubic terms in each equation, one of them `-x_i^3`, and in every other field a constant.
pub(super) fn field(dim: usize, cubic: bool, seed: u64) -> Field {
    let mut random = Uniform::new(seed, 0);
    let factor = |random: &mut Uniform| ((0.5 * (1.0 + random.draw()) * dim as f64) as usize).min(dim - 1);
    let equation = |i: usize| {
        let mut terms: Vec<Term> = (0..dim).map(|j| (random.draw(), vec![j])).collect();
        if seed.is_multiple_of(2) {
            terms.push((random.draw(), Vec::new()));
        }
        terms.extend((0..4).map(|_| (random.draw(), vec![factor(&mut random), factor(&mut random)])));
        if cubic {
            terms.push((-0.5 - 0.5 * random.draw().abs(), vec![i, i, i]));
            terms.extend((0..3).map(|_| {
                let factors = vec![factor(&mut random), factor(&mut random), factor(&mut random)];
                (0.5 * random.draw(), factors)
            }));
        }
        terms.iter_mut().for_each(|term| term.0 = (1e3 * term.0).round() / 1e3);
        terms
    };
    (0..dim).map(equation).collect()
}

/// The field as a study: unknowns in pairs are real and imaginary parts; one that is left over decays.
pub(super) fn text(field: &Field) -> String {
    let modes = field.len().div_ceil(2);
    let part = |k: usize| match (k / 2 + 1, k % 2) {
        (n, 0) => format!("(0.5*(z{n}+conj(z{n})))"),
        (n, _) => format!("((-i/2)*(z{n}-conj(z{n})))"),
    };
    let side = |k: usize| match field.get(k) {
        Some(terms) => {
            let term = |(c, factors): &Term| {
                factors.iter().fold(format!("({c})"), |text, &k| format!("{text}*{}", part(k)))
            };
            terms.iter().map(term).collect::<Vec<_>>().join(" + ")
        }
        None => format!("-{}", part(k)),
    };
    let numbers: Vec<String> = (1..=modes).map(|n| n.to_string()).collect();
    let mut text = format!(
        "[model.amplitudes]\nmodes = [{}]\nsymmetry = \"none\"\n[model.amplitudes.equations]\n",
        numbers.join(", ")
    );
    for n in 1..=modes {
        writeln!(text, "z{n} = \"{} + i*({})\"", side(2 * n - 2), side(2 * n - 1)).unwrap();
    }
    text
}

/// Values and derivatives.
fn evaluate(field: &Field, u: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let (mut value, mut slope) = (vec![0.0; u.len()], vec![vec![0.0; u.len()]; u.len()]);
    for (i, (c, factors)) in field.iter().enumerate().flat_map(|(i, terms)| terms.iter().map(move |t| (i, t)))
    {
        value[i] += factors.iter().fold(*c, |product, &k| product * u[k]);
        for (place, &k) in factors.iter().enumerate() {
            let others = factors.iter().enumerate().filter(|other| other.0 != place);
            slope[i][k] += others.fold(*c, |product, (_, &k)| product * u[k]);
        }
    }
    (value, slope)
}

/// Gauss's elimination with pivots in columns.
fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let dim = b.len();
    for k in 0..dim {
        let pivot = (k..dim).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap();
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..dim {
            let factor = a[i][k] / a[k][k];
            for j in k..dim {
                a[i][j] -= factor * a[k][j];
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..dim).rev() {
        for j in k + 1..dim {
            b[k] -= a[k][j] * b[j];
        }
        b[k] /= a[k][k];
    }
    b
}

pub(super) fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    norm(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>())
}

/// Newton's method from a start; `None` where it does not converge.
fn newton(field: &Field, mut u: Vec<f64>) -> Option<Vec<f64>> {
    for _ in 0..80 {
        let (value, slope) = evaluate(field, &u);
        let step = solve(slope, value);
        u.iter_mut().zip(&step).for_each(|(u, d)| *u -= d);
        if !norm(&u).is_finite() {
            return None;
        }
        if norm(&step) <= 1e-13 * norm(&u).max(1e-3) {
            return Some(u);
        }
    }
    None
}

/// Every root of norm up to 30 that `starts` starts of all sizes from 1e-3 to 1e3 find.
fn roots(field: &Field, starts: u64) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = Vec::new();
    for start in 0..starts {
        let mut random = Uniform::new(99, start);
        let size = 10.0_f64.powf(3.0 * random.draw());
        let u = (0..field.len()).map(|_| size * random.draw() * 10.0_f64.powf(random.draw() - 1.0)).collect();
        let Some(root) = newton(field, u).filter(|root| norm(root) < 30.0) else { continue };
        if !found.iter().any(|known| distance(known, &root) < 1e-6 * norm(&root).max(1e-3)) {
            found.push(root);
        }
    }
    found
}

#[test]
fn random_equations_have_no_others() {
    let mut total = 0;
    for dim in 2..=6 {
        for (seed, cubic) in [(0, false), (1, false), (2, true), (3, true)] {
            let field = field(dim, cubic, 100 * dim as u64 + seed);
            let wanted = roots(&field, draws(500, 4000));
            let found = list(&study(&text(&field)));
            let found: Vec<Vec<f64>> = found.iter().map(|one| values(one)[..dim].to_vec()).collect();
            for root in &wanted {
                let near = |one: &Vec<f64>| distance(one, root) < 1e-9 * norm(root).max(1e-3);
                assert!(found.iter().any(near), "{dim} unknowns, seed {seed}: {root:?} in {found:?}");
            }
            for one in &found {
                assert!(norm(&evaluate(&field, one).0) < 1e-9 * norm(one).max(1.0).powi(3), "{one:?}");
            }
            total += wanted.len();
        }
    }
    assert!(total > 60, "{total}");
}
