//! Names as people type them: Greek letters, and the symbols of the paper.

use crate::parameters::ParameterSpec;

/// Greek letters and their names in ASCII.
const GREEK: [(char, &str); 24] = [
    ('α', "alpha"),
    ('β', "beta"),
    ('γ', "gamma"),
    ('δ', "delta"),
    ('ε', "epsilon"),
    ('ζ', "zeta"),
    ('η', "eta"),
    ('θ', "theta"),
    ('ι', "iota"),
    ('κ', "kappa"),
    ('λ', "lambda"),
    ('μ', "mu"),
    ('ν', "nu"),
    ('ξ', "xi"),
    ('ο', "omicron"),
    ('π', "pi"),
    ('ρ', "rho"),
    ('σ', "sigma"),
    ('τ', "tau"),
    ('υ', "upsilon"),
    ('φ', "phi"),
    ('χ', "chi"),
    ('ψ', "psi"),
    ('ω', "omega"),
];

/// A name with its Greek letters spelled and its subscripts as digits: `κ₂`, `κ_2` and `κ2` are `kappa2`. Other names stay as they are.
pub fn ascii(name: &str) -> String {
    if name.is_ascii() {
        return name.to_owned();
    }
    let mut spelled = String::new();
    for letter in name.chars() {
        match (GREEK.iter().find(|(greek, _)| *greek == letter), letter) {
            (Some((_, word)), _) => spelled += word,
            (None, '₀'..='₉') => spelled.push(char::from(b'0' + (letter as u32 - '₀' as u32) as u8)),
            (None, '_') => {}
            _ => spelled.push(letter),
        }
    }
    spelled
}

/// The name of the parameter that a name means: itself, or that whose symbol in the paper it is (`L` for `length`).
pub fn canonical<'s>(specs: &'s [ParameterSpec], name: &'s str) -> &'s str {
    let plain = |symbol: &str| symbol.replace(['*', '_', '{', '}'], "");
    let known = specs.iter().any(|spec| spec.name == name);
    let meant = specs.iter().find(|spec| !known && plain(spec.symbol) == name);
    meant.map_or(name, |spec| spec.name)
}
