//! Saddle-nodes: two equilibria on one side, and on the other a ghost, where rates are small and nothing rests.

use super::{Equilibrium, list_from, study};

/// `X' = a (mu + (X/a)^2)` and `Y' = b (1 - Y/b + X/(10 a))`, X and Y in units of their own; `X - c` for X. The roots are
/// `X = c -+ a sqrt(-mu)`, `Y = b (1 + (X - c)/(10 a))`.
fn saddle_node(mu: f64, (a, b, c): (f64, f64, f64)) -> Vec<Equilibrium> {
    let text = format!(
        "[model.amplitudes]\nmodes = [2]\nsymmetry = \"none\"\nvelocity = \"z2\"\n[model.amplitudes.parameters]\n\
         mu = {mu:e}\na = {a:e}\nb = {b:e}\nc = {c:e}\n[model.amplitudes.equations]\n\
         z2 = \"a*(mu + ((re(z2)-c)/a)^2) + i*b*(1 - im(z2)/b + (re(z2)-c)/(10*a))\""
    );
    list_from(&study(&text), 60)
}

fn place(one: &Equilibrium) -> f64 {
    one.shape.values()[0]
}

/// With x of size 1e-9 beside y of size 1 there were 200 equilibria, the places at which Newton's method had come to a stop.
#[test]
fn a_ghost_is_no_equilibrium() {
    for mu in [1e-8, 1e-10, 1e-12, 1e-14] {
        for units in [
            (1.0, 1.0, 0.0),
            (1e-3, 1e3, 0.0),
            (1e-6, 1.0, 0.0),
            (1e-9, 1.0, 0.0),
            (1.0, 1.0, 1.0),
            (1.0, 1.0, 1e3),
        ] {
            let found = saddle_node(mu, units);
            assert!(found.is_empty(), "{mu} {units:?}: {found:?}");
        }
    }
}

/// On the other side both are found, once each, also where they are a millionth of the other variable apart.
#[test]
fn both_equilibria_of_a_saddle_node_are_found_once() {
    for mu in [-1e-4, -1e-8] {
        for (a, b, c) in [(1.0, 1.0, 0.0), (1e-3, 1e3, 0.0), (1e-6, 1.0, 0.0), (1.0, 1.0, 1.0)] {
            let found = saddle_node(mu, (a, b, c));
            let mut places: Vec<f64> = found.iter().map(|one| (place(one) - c) / a / (-mu).sqrt()).collect();
            places.sort_by(f64::total_cmp);
            // round-off of terms of size 1 moves the roots by 1e-16/(2 sqrt(-mu))
            let near = |(found, wanted): (&f64, f64)| (found - wanted).abs() < 1e-4;
            assert!(
                places.len() == 2 && places.iter().zip([-1.0, 1.0]).all(near),
                "{mu} {a} {b} {c}: {places:?}"
            );
        }
    }
}

/// A root at which the rates touch 0 and change their sign is there: `x' = -(x - 1)^3` beside y, expanded.
#[test]
fn a_root_of_odd_order_is_an_equilibrium() {
    let text = "[model.amplitudes]\nmodes = [2]\nsymmetry = \"none\"\nvelocity = \"z2\"\n[model.amplitudes.parameters]\nk = 1.0\n\
        [model.amplitudes.equations]\nz2 = \"-k*(re(z2)-1)^3 + i*(re(z2) - im(z2))\"";
    let found = list_from(&study(text), 60);
    assert!(!found.is_empty() && found.iter().all(|one| (place(one) - 1.0).abs() < 1e-3), "{found:?}");
}
