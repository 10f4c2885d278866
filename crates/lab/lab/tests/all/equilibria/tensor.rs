//! The relative equilibria of the tensor model from closed forms.

use super::list;
use motiform_lab::equilibria::Equilibrium;
use motiform_study::{Study, presets::find_any};

fn preset(name: &str, set: &[(&str, f64)]) -> Study {
    let mut study = find_any(name, "tensor").unwrap();
    for &(name, value) in set {
        study.set(name, value).unwrap();
    }
    study
}

/// Speed and turning rate of each, sorted.
fn motions(found: &[Equilibrium]) -> Vec<(f64, f64)> {
    sorted(found.iter().map(|one| (one.speed, one.turning_rate)).collect())
}

fn sorted(mut list: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let rounded = |x: f64| (1e6 * x).round();
    list.sort_by(|a, b| rounded(a.0).total_cmp(&rounded(b.0)).then(a.1.total_cmp(&b.1)));
    list
}

fn assert_same(study: &Study, wanted: Vec<(f64, f64)>) {
    let (found, wanted) = (motions(&list(study)), sorted(wanted));
    assert_eq!(found.len(), wanted.len(), "{found:?} {wanted:?}");
    for (a, b) in found.iter().zip(&wanted) {
        assert!((a.0 - b.0).abs() < 1e-9 && (a.1 - b.1).abs() < 1e-9, "{found:?} {wanted:?}");
    }
}

/// The positive roots of `a x^2 + b x + c`.
fn positive(a: f64, b: f64, c: f64) -> Vec<f64> {
    let root = (b * b - 4.0 * a * c).sqrt();
    [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)].into_iter().filter(|&x| x > 0.0).collect()
}

/// Speed and turning rate of the motions of Fig. 4 and 5, `z_n = w_n e^{-i n Omega t}`, `q = |z1|^2`, `A = q - 1`.
///
/// (Z1) gives `e11 q w2 = (A - i Omega) w1^2`, (Z2) then w3, and (Z3) with `P = kappa2 A - 2 Omega^2 - e21 e11 q`, `Q = kappa2 + 2A`:
/// `kappa3 P - 3 Omega^2 Q = e22 q (e31 e11 q + e32 A)`, `Omega (kappa3 Q + 3P) = Omega e22 e32 q`: one quadratic for `Omega = 0`, and one
/// with `6 Omega^2 = kappa2 kappa3 + (2 kappa3 + 3 kappa2) A - (3 e21 e11 + e22 e32) q`, linear in q.
fn of_the_full_model(kappa2: f64, kappa3: f64) -> Vec<(f64, f64)> {
    let [e11, e21, e22, e31, e32] = [2.0, -0.125, 0.3, 0.0125, 0.4];
    let right = [-e22 * e32, e22 * (e31 * e11 + e32)]; // times q and q^2
    let straight = positive(-right[1], kappa3 * (kappa2 - e21 * e11) - right[0], -kappa2 * kappa3);
    // Omega^2 = w[0] + w[1] q
    let drift = 2.0 * kappa3 + 3.0 * kappa2;
    let w = [(kappa2 * kappa3 - drift) / 6.0, (drift - 3.0 * e21 * e11 - e22 * e32) / 6.0];
    let p = [-kappa2 - 2.0 * w[0], kappa2 - 2.0 * w[1] - e21 * e11];
    let q = [kappa2 - 2.0, 2.0];
    let circular = positive(
        -3.0 * w[1] * q[1] - right[1],
        kappa3 * p[1] - 3.0 * (w[0] * q[1] + w[1] * q[0]) - right[0],
        kappa3 * p[0] - 3.0 * w[0] * q[0],
    );
    let turns = |&q: &f64| (q.sqrt(), (w[0] + w[1] * q).sqrt());
    let circular: Vec<(f64, f64)> = circular.iter().map(turns).filter(|one| one.1 > 0.0).collect();
    let mut all = vec![(0.0, 0.0)];
    all.extend(straight.iter().map(|q| (q.sqrt(), 0.0)));
    all.extend(circular.iter().flat_map(|&(speed, turn)| [(speed, turn), (speed, -turn)]));
    all
}

#[test]
fn those_of_the_full_model_are_the_roots_of_its_two_quadratics() {
    for name in ["fig4", "fig5a", "fig5b"] {
        let study = preset(name, &[]);
        let value = |name: &str| {
            let place = study.info().unwrap().parameters().iter().position(|spec| spec.name == name).unwrap();
            study.values().unwrap()[place]
        };
        assert_same(&study, of_the_full_model(value("kappa2"), value("kappa3")));
    }
    for kappa2 in [-0.3, 0.1, 0.9, 1.3, 3.0] {
        for kappa3 in [0.1, 1.0] {
            let study = preset("fig4", &[("kappa2", kappa2), ("kappa3", kappa3)]);
            assert_same(&study, of_the_full_model(kappa2, kappa3));
        }
    }
}

/// Those of the reduced model (Fig. 1 to 3), from its amplitude equations with `B = b1/4`: rest; an ellipse, `8 r2^2 = -kappa2`;
/// straight, `r1^2 = gamma - 2s`, `kappa2 s + 8 s^3 = B r1^2`; circular, `r1^2 = 32 r2^2`, `72 r2^2 = 2 gamma - kappa2`.
fn of_the_reduced_model(kappa2: f64, gamma: f64) -> Vec<(f64, f64)> {
    let mut all = vec![(0.0, 0.0)];
    all.extend((kappa2 < 0.0).then_some((0.0, 0.0)));
    let cubic = |s: f64| 8.0 * s * s * s + (kappa2 + 0.25) * s - 0.125 * gamma;
    for place in -10_000..10_000 {
        let (mut low, mut high) = (1e-4 * f64::from(place), 1e-4 * f64::from(place + 1));
        if cubic(low) * cubic(high) > 0.0 {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if cubic(middle) * cubic(low) > 0.0 { low = middle } else { high = middle }
        }
        all.extend((gamma > 2.0 * low).then(|| ((gamma - 2.0 * low).sqrt(), 0.0)));
    }
    let r2 = ((2.0 * gamma - kappa2) / 72.0).sqrt();
    let (r1, cos) = (32.0_f64.sqrt() * r2, (gamma - 32.0 * r2 * r2) / (2.0 * r2));
    if cos.abs() < 1.0 {
        let turn = 2.0 * r2 * (1.0 - cos * cos).sqrt();
        all.extend([(r1, turn), (r1, -turn)]);
    }
    all
}

#[test]
fn those_of_the_reduced_model_are_those_of_its_amplitude_equations() {
    for kappa2 in [-0.6, -0.1, 0.03, 0.2] {
        for gamma in [-0.15, 0.05, 0.1] {
            let study = preset("fig1", &[("kappa2", kappa2), ("gamma", gamma)]);
            assert_same(&study, of_the_reduced_model(kappa2, gamma));
        }
    }
}
