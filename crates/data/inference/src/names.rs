//! The paper's names of coefficients.

use crate::Term;

/// A term of (Z1), (Z2), (Z3) in the notation of study files, the parameter of (V), (S), (U) in its
/// coefficient, and the coefficient of that parameter. Source: paper, the table of coefficients after (Z3);
/// `engine/models/src/tensor/fourier.rs`.
const PAPER: [(&str, &str, f64); 21] = [
    ("z1: z1", "gamma", 1.0),
    ("z1: |z2|^2*z1", "a4", -8.0),
    ("z1: |z3|^2*z1", "a5", -16.0),
    ("z1: conj(z1)*z2", "a1", -2.0),
    ("z1: conj(z1)^2*z3", "a2", -2.0),
    ("z1: conj(z2)*z3", "a3", -8.0),
    ("z1: z2^2*conj(z3)", "a6", 16.0),
    ("z2: z2", "kappa2", -1.0),
    ("z2: |z1|^2*z2", "b4", -1.0),
    ("z2: |z2|^2*z2", "b3", -8.0),
    ("z2: |z3|^2*z2", "b5", -16.0),
    ("z2: z1^2", "b1", 0.25),
    ("z2: conj(z1)*z3", "b2", 1.0),
    ("z2: z1*conj(z2)*z3", "b6", 2.0),
    ("z3: z3", "kappa3", -1.0),
    ("z3: |z1|^2*z3", "d4", -1.0),
    ("z3: |z2|^2*z3", "d5", -8.0),
    ("z3: |z3|^2*z3", "d3", -16.0),
    ("z3: z1^3", "d1", 0.125),
    ("z3: z1*z2", "d2", 0.5),
    ("z3: conj(z1)*z2^2", "d6", 2.0),
];

/// The name of a term's parameter and the coefficient of that parameter: `kappa2` and -1 for `z2: z2`.
///
/// `|z1|^2 z1` has the coefficient -1 in the paper; here it is `d11`. Terms that the paper does not have are named by equation and powers:
/// `c2_z1_z2c_z3`. Imaginary parts have `_i` after the name.
#[must_use]
pub fn paper(term: &Term, imaginary: bool) -> (String, f64) {
    let key = format!("z{}: {}", term.equation + 1, term.expression());
    let (name, factor) = match PAPER.iter().find(|(known, ..)| *known == key) {
        Some(&(_, name, factor)) => (name.to_owned(), factor),
        None if key == "z1: |z1|^2*z1" => ("d11".to_owned(), 1.0),
        None => (plain(term), 1.0),
    };
    if imaginary { (format!("{name}_i"), factor) } else { (name, factor) }
}

fn plain(term: &Term) -> String {
    let mut name = format!("c{}", term.equation + 1);
    for (m, powers) in term.powers.iter().enumerate() {
        for (&power, mark) in powers.iter().zip(["", "c"]) {
            match power {
                0 => {}
                1 => name += &format!("_z{}{mark}", m + 1),
                _ => name += &format!("_z{}{mark}{power}", m + 1),
            }
        }
    }
    name
}
