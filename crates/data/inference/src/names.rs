//! The paper's names of coefficients.

use crate::Term;
use motiform_models::amplitudes::tensor_parameter;

/// The name of a term's parameter and the coefficient of that parameter: `kappa2` and -1 for `z2: z2`.
///
/// `|z1|^2 z1` has the coefficient -1 in the paper; here it is `d11`. Terms that the paper does not have are named by equation and powers:
/// `c2_z1_z2c_z3`. Imaginary parts have `_i` after the name.
pub fn paper(term: &Term, imaginary: bool) -> (String, f64) {
    let key = format!("z{}: {}", term.equation + 1, term.expression());
    let (name, factor) = match tensor_parameter(&key) {
        Some((name, factor)) => (name.to_owned(), factor),
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
