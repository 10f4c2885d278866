//! Tests of texts: the meaning of equations, and the places where they are refused.

use super::coefficient::Tape;
use super::parser::{Names, parse};
use super::polynomial::Polynomial;
use super::tokens::TextError;

fn read(text: &str) -> Result<(Polynomial, Tape), TextError> {
    let parameters = ["gamma".to_owned(), "a1".to_owned(), "omega".to_owned()];
    let names = Names { modes: &[1, 2, 3], parameters: &parameters };
    let mut tape = Tape::default();
    Ok((parse(text, names, &mut tape)?, tape))
}

/// The terms with their values at gamma = 2, a1 = -1, omega = .5.
fn terms(text: &str) -> Vec<(String, [f64; 2])> {
    let (polynomial, tape) = read(text).unwrap();
    let values = tape.evaluate(&[2.0, -1.0, 0.5]);
    polynomial.0.iter().map(|(m, &place)| (m.text(&[1, 2, 3]), values[place as usize])).collect()
}

#[test]
fn products_are_multiplied_out() {
    let all = terms("(gamma + i*omega - |z1|^2)*z1 - 2*a1*conj(z1)*z2");
    let expected = [("conj(z1)*z2", [2.0, 0.0]), ("z1", [2.0, 0.5]), ("|z1|^2*z1", [-1.0, 0.0])];
    assert_eq!(all.len(), 3);
    for (term, value) in expected {
        assert!(all.contains(&(term.to_owned(), value)), "{all:?}");
    }
    assert_eq!(terms("(z1 + z2)^2 - z1^2 - 2*z1*z2").iter().filter(|t| t.1 != [0.0, 0.0]).count(), 1);
    assert_eq!(terms("conj(i*z1*conj(z3))"), [("conj(z1)*z3".to_owned(), [0.0, -1.0])]);
    assert_eq!(terms("-gamma^2/4*z2"), [("z2".to_owned(), [-1.0, 0.0])]);
    assert_eq!(terms("2^-1*z2^0"), [(String::new(), [0.5, 0.0])]);
    assert_eq!(terms("sqrt(gamma*2)*exp(0)*|z3|^4"), [("|z3|^4".to_owned(), [2.0, 0.0])]);
}

#[test]
fn refusals_name_the_place_and_what_was_expected() {
    let cases = [
        ("gama*z1", 0..4, "did you mean gamma?"),
        ("z1 + z4", 5..7, "no amplitude z4"),
        ("2 z1", 2..4, "written with *"),
        ("z1 *", 4..4, "ends here"),
        ("(z1", 3..3, "expected )"),
        ("z1)", 2..3, "closes none"),
        ("|z1|", 0..4, "even power"),
        ("|z1|^3", 0..6, "even power"),
        ("|a1|^2", 1..3, "one amplitude"),
        ("z1/z2", 3..5, "no amplitude"),
        ("sin(z1)", 3..7, "no amplitude"),
        ("sqrt(i)", 0..4, "real number"),
        ("z1^8", 0..4, "order above 7"),
        ("z1^a1", 3..5, "whole numbers"),
        ("z1 = 2", 3..4, "right-hand side alone"),
        ("z1 # 2", 3..4, "no meaning"),
        ("", 0..0, "ends here"),
        ("1.2.3", 3..5, "written with *"),
        ("nu*z1", 0..2, "give it a value"),
        ("2^3^4", 3..4, "parentheses"),
    ];
    for (text, span, says) in cases {
        let error = read(text).unwrap_err();
        assert_eq!(error.span, span, "{text}: {error}");
        assert!(error.problem.contains(says), "{text}: {error}");
    }
}

#[test]
fn size_and_depth_are_bounded() {
    let deep = "(".repeat(100_000);
    assert!(read(&deep).is_err());
    let nested = format!("{}z1{}", "(".repeat(100), ")".repeat(100));
    assert!(read(&nested).unwrap_err().problem.contains("64"));
    let long = format!("({})^7", vec!["gamma*z1"; 900].join("+"));
    assert!(read(&long).is_ok());
    let wide = format!("({0})*({0})*({0})", ["(z1+z2+z3+conj(z1)+conj(z2)+conj(z3)+1)^2"; 2].join("+"));
    assert!(read(&wide).unwrap_err().problem.contains("512"));
}
