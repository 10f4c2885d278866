//! The phi functions agree with multiprecision values to 1e-14, for every size and sign of their argument.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::steppers::phi_functions::{etdrk4_weights, phi};

#[test]
fn phi_functions_agree_with_multiprecision_values() {
    let text = include_str!("../../../../../reference/phi-functions.toml");
    let table: toml::Table = text.parse().unwrap();
    let rows = table["phi"].as_array().unwrap();
    assert!(rows.len() > 40);
    let mut worst: f64 = 0.0;
    for row in rows {
        let number = |key: &str| row[key].as_float().unwrap();
        let z = number("z");
        let [_, phi1, phi2, phi3] = phi(z);
        let [first, middle, last] = etdrk4_weights(z);
        let names = ["phi1", "phi2", "phi3", "first", "middle", "last"];
        for (name, got) in names.into_iter().zip([phi1, phi2, phi3, first, middle, last]) {
            let exact = number(name);
            // beside their zeros (-3 < z < 4) the weights can only be exact to the rounding of their parts
            let floor = if (-4.0..=4.0).contains(&z) { 1e-16 } else { 0.0 };
            let error = (got - exact).abs();
            assert!(error <= 1e-14 * exact.abs() + floor, "{name}({z}) = {got:e}, exactly {exact:e}");
            worst = worst.max(error / (exact.abs() + floor));
        }
    }
    println!("largest relative error {worst:.2e}");
}

/// The three ways to compute meet: no step at the borders between them.
#[test]
fn branches_meet() {
    for border in [-16.0_f64, -1.5, 1.5, 16.0] {
        let (below, above) = (etdrk4_weights(border.next_down()), etdrk4_weights(border.next_up()));
        for (a, b) in below.into_iter().zip(above) {
            assert!((a - b).abs() <= 1e-14 * a.abs() + 1e-16, "{border}: {a:e} {b:e}");
        }
    }
}
