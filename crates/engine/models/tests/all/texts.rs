//! Tests of texts: the meaning of equations and of parameters, and the places where they are refused.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::amplitudes::definition;
use motiform_dynamics::{Dual, VectorField};
use motiform_models::amplitudes::{Amplitudes, Definition, DefinitionError, Equations, Formula, info};

/// The equation of `z1`, beside two that have every symmetry; this one need not have any.
fn read(text: &str) -> Result<Equations, DefinitionError> {
    with_symmetry(text, Some("none"))
}

fn with_symmetry(text: &str, symmetry: Option<&str>) -> Result<Equations, DefinitionError> {
    let parameters = [("gamma", 2.0), ("a1", -1.0), ("omega", 0.5)];
    let symmetry = symmetry.map(str::to_owned);
    Equations::new(&Definition { symmetry, ..definition(&[1, 2, 3], &[text, "-z2", "-z3"], &parameters) })
}

/// The terms with their values at gamma = 2, a1 = -1, omega = .5.
fn terms(text: &str) -> Vec<(String, [f64; 2])> {
    let all = read(text).unwrap().terms(0, &[2.0, -1.0, 0.5]);
    all.into_iter().map(|(term, value)| (term.text(&[1, 2, 3]), value)).collect()
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

#[test]
fn coefficients_that_are_real_however_they_are_written_keep_the_mirror() {
    for (text, value, mirror) in [
        ("(i*omega)^2*z1", [-0.25, 0.0], true),
        ("i*omega*z1", [0.0, 0.5], false),
        ("(omega + i*omega)*z1", [0.5, 0.5], false),
        ("exp(i*omega)*z1", [libm::cos(0.5), libm::sin(0.5)], false),
    ] {
        assert_eq!(terms(text), [("z1".to_owned(), value)], "{text}");
        assert_eq!(with_symmetry(text, None).unwrap().symmetry().mirror, mirror, "{text}");
    }
    let refused = read("sqrt(omega + i*omega)*z1").unwrap_err();
    assert!(refused.problem.contains("real number"), "{refused}");
}

#[test]
fn quotients_are_inverse_to_products() {
    for b in ["2", "(-3*i)", "(1.5 + .25*i)"] {
        let value = |coefficient: &str| terms(&format!("{coefficient}*z1"))[0].1;
        let back = value(&format!("(.7 - 1.1*i)/{b}*{b}"));
        assert!((back[0] - 0.7).abs() < 1e-15 && (back[1] + 1.1).abs() < 1e-15, "{b}: {back:?}");
        assert_eq!(value(&format!("{b}^-2")), value(&format!("1/{b}^2")));
    }
}

/// The terms of the paper's full model, in any order and with any coefficients, are a list that is known when the program is compiled.
/// It has the bits of the list that is read, over numbers and duals, and is that of no other terms.
#[test]
fn the_papers_list_has_the_bits_of_the_list_that_is_read() {
    const TEXTS: [&str; 3] =
        ["(g - 2*|z1|^2)*z1 + p*conj(z1)*z2", "-q*z2 + r*z1^2 + 3*conj(z1)*z3", "s*z1^3 - z3 + g*z1*z2"];
    let parameters = [("g", 0.3), ("p", 0.13), ("q", -0.04), ("r", -0.21), ("s", 0.7), ("none", 0.0)];
    let of = |texts: [&str; 3]| definition(&[1, 2, 3], &texts, &parameters);
    let is_known = |texts| format!("{:?}", Equations::new(&of(texts)).unwrap()).contains("paper: true");
    let [one, two, three] = TEXTS;
    let longer = [one, two, "s*z1^3 - z3 + g*z1*z2 + none*conj(z1)*z2^2"];
    let shorter = [one, two, "s*z1^3 - z3"];
    let handed = ["(g + i*q - 2*|z1|^2)*z1 + p*conj(z1)*z2", two, three];
    assert_eq!([TEXTS, longer, shorter, handed].map(is_known), [true, false, false, false]);
    let values = parameters.map(|(_, value)| value);
    let [known, read] = [TEXTS, longer].map(|texts| info(&of(texts)).unwrap().build(&values).unwrap());
    let [known, read] = [&known, &read].map(|it| it.as_any().unwrap().downcast_ref::<Amplitudes>().unwrap());
    for k in 0..50 {
        let u: [f64; 6] = std::array::from_fn(|i| libm::sin(1.3 * f64::from(k) + 2.1 * i as f64));
        let [mut a, mut b] = [[0.0; 6]; 2];
        known.eval(0.0, &u, &mut a);
        read.eval(0.0, &u, &mut b);
        assert_eq!(a.map(f64::to_bits), b.map(f64::to_bits));
        let duals = u.map(|x| Dual { value: x, derivative: [1.0 - x, x * x] });
        let [mut a, mut b] = [[duals[0]; 6]; 2];
        known.eval(0.0, &duals, &mut a);
        read.eval(0.0, &duals, &mut b);
        assert_eq!(format!("{a:?}"), format!("{b:?}"));
    }
}

fn names() -> Vec<String> {
    ["a2", "kappa2", "d3"].map(str::to_owned).to_vec()
}

#[test]
fn expressions_of_parameters_have_their_values() {
    let values = [4.0, -0.3, 0.05];
    for (text, value, uses) in [
        ("d3", 0.05, vec![2]),
        ("2*kappa2", -0.6, vec![1]),
        ("-sqrt(a2)^3/8 + 1", 0.0, vec![0]),
        ("cos(pi)*a2 - 0", -4.0, vec![0]),
        ("0", 0.0, vec![]),
    ] {
        let formula = Formula::parse(text, &names()).expect(text);
        assert!((formula.value(&values) - value).abs() < 1e-15, "{text}");
        assert_eq!(formula.uses(), uses, "{text}");
    }
    assert!(!Formula::parse("sqrt(kappa2)", &names()).expect("a formula").value(&values).is_finite());
}

#[test]
fn what_is_no_real_expression_says_why() {
    for (text, part) in [
        ("kapa2", "did you mean kappa2?"),
        ("i*a2", "leave out i"),
        ("a2 d3", "expected an operator"),
        ("", "ends here"),
        ("z1", "no parameter"),
    ] {
        let problem = Formula::parse(text, &names()).expect_err(text);
        assert!(problem.contains(part), "{text}: {problem}");
    }
}
