//! Terms of the equations and their units as text in the markup of figures.

use crate::Units;
use motiform_inference::Term;

/// `z1: z1* z2^2` with subscripts and superscripts; what is no amplitude stays as it is.
pub(crate) fn typeset(term: &str) -> String {
    let mut out = String::new();
    let mut rest = term;
    while let Some(at) = rest.find('z') {
        let (before, amplitude) = rest.split_at(at);
        out += before;
        let digits = span(&amplitude[1..], |c| c.is_ascii_digit());
        if digits == 0 {
            out.push('z');
            rest = &amplitude[1..];
            continue;
        }
        let (index, after) = amplitude[1..].split_at(digits);
        let conjugate = after.starts_with('*');
        let after = after.strip_prefix('*').unwrap_or(after);
        let power = after.strip_prefix('^').map_or("", |power| &power[..span(power, |c| c.is_ascii_digit())]);
        out += &format!("*z*_{{{index}}}");
        if conjugate || !power.is_empty() {
            out += &format!("^{{{}{power}}}", if conjugate { "\\*" } else { "" });
        }
        rest = if power.is_empty() { after } else { &after[1 + power.len()..] };
    }
    out + rest
}

/// Unit of a term's coefficient: z1 is a velocity, the other amplitudes are lengths, and the equation gives the rate of one of them.
pub(crate) fn unit(term: &Term, units: &Units) -> String {
    let order = i32::try_from(term.order()).unwrap_or(0);
    let of_velocity = i32::from(term.equation == 0);
    product(&[(&units.length, 1 - order), (&units.time, term.degree(0) - of_velocity - 1)])
}

/// `µm^{-2} s`, without factors of power 0.
fn product(factors: &[(&str, i32)]) -> String {
    let written = factors.iter().filter(|(_, power)| *power != 0).map(|(unit, power)| match power {
        1 => (*unit).to_owned(),
        power => format!("{unit}^{{{}}}", power.to_string().replace('-', "−")),
    });
    written.collect::<Vec<_>>().join(" ")
}

/// Length of the characters at the start that are of a kind.
fn span(text: &str, of: impl Fn(char) -> bool) -> usize {
    text.find(|c| !of(c)).unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_inference::Library;

    /// A rate is one of its equation's amplitude: the units of coefficient and factors together are those of z1 (length/time) or z2, z3
    /// (length), over time.
    #[test]
    fn coefficients_have_units() {
        let units = Units { length: "µm".to_owned(), time: "s".to_owned(), y_down: false };
        let library = Library::tensor();
        let of = |name: &str| unit(&library.terms[library.place(name).expect("a term")], &units);
        assert_eq!(of("z1: z1"), "s^{−1}");
        assert_eq!(of("z1: |z1|^2 z1"), "µm^{−2} s");
        assert_eq!(of("z2: z2"), "s^{−1}");
        assert_eq!(of("z2: z1^2"), "µm^{−1} s");
        assert_eq!(of("z3: z1^3"), "µm^{−2} s^{2}");
    }

    #[test]
    fn amplitudes_have_subscripts_and_powers() {
        assert_eq!(typeset("z1: |z1|^2 z1"), "*z*_{1}: |*z*_{1}|^2 *z*_{1}");
        assert_eq!(typeset("z2: z1* z3"), "*z*_{2}: *z*_{1}^{\\*} *z*_{3}");
        assert_eq!(typeset("z3: z1* z2^2"), "*z*_{3}: *z*_{1}^{\\*} *z*_{2}^{2}");
        assert_eq!(typeset("z3: z1*^2"), "*z*_{3}: *z*_{1}^{\\*2}");
        assert_eq!(typeset("noise of zeta"), "noise of zeta");
    }
}
