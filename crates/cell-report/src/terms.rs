//! Terms of the equations as text in the markup of figures.

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

/// Length of the characters at the start that are of a kind.
fn span(text: &str, of: impl Fn(char) -> bool) -> usize {
    text.find(|c| !of(c)).unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amplitudes_have_subscripts_and_powers() {
        assert_eq!(typeset("z1: |z1|^2 z1"), "*z*_{1}: |*z*_{1}|^2 *z*_{1}");
        assert_eq!(typeset("z2: z1* z3"), "*z*_{2}: *z*_{1}^{\\*} *z*_{3}");
        assert_eq!(typeset("z3: z1* z2^2"), "*z*_{3}: *z*_{1}^{\\*} *z*_{2}^{2}");
        assert_eq!(typeset("z3: z1*^2"), "*z*_{3}: *z*_{1}^{\\*2}");
        assert_eq!(typeset("noise of zeta"), "noise of zeta");
    }
}
