//! The terms against an independent enumeration.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_inference::Library;

/// Number of exponents with total order up to `order` and angular index `n`: a polynomial in two counters, multiplied out.
fn count(modes: usize, order: usize, n: usize) -> usize {
    let middle = 4 * 5;
    // ways[o][i]: monomials of order o and index i - middle
    let mut ways = vec![vec![0_usize; 2 * middle + 1]; order + 1];
    ways[0][middle] = 1;
    for factor in 0..2 * modes {
        let turn = factor / 2 + 1;
        for o in 1..=order {
            for i in 0..ways[o].len() {
                let before = if factor % 2 == 0 { i.checked_sub(turn) } else { Some(i + turn) };
                ways[o][i] += before.and_then(|before| ways[o - 1].get(before)).copied().unwrap_or(0);
            }
        }
    }
    (1..=order).map(|o| ways[o][n + middle]).sum()
}

#[test]
fn counts() {
    let expected: [(usize, u32, &[usize]); 3] =
        [(3, 3, &[8, 7, 7]), (4, 3, &[12, 12, 11, 10]), (3, 5, &[32, 30, 29])];
    for (modes, order, counts) in expected {
        let library = Library::new(modes, order).unwrap();
        for (equation, &expected) in counts.iter().enumerate() {
            assert_eq!(library.of_equation(equation).len(), expected, "{modes} {order} {equation}");
            assert_eq!(count(modes, order as usize, equation + 1), expected);
        }
        let mut names = library.names();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), library.terms.len(), "every term once");
    }
}

#[test]
fn names() {
    let library = Library::tensor();
    for name in [
        "z1: z1",
        "z1: z1* z2",
        "z1: |z1|^2 z1",
        "z1: z1*^2 z3",
        "z1: z2* z3",
        "z1: z2^2 z3*",
        "z2: z1^2",
        "z2: z1* z3",
        "z2: |z2|^2 z2",
        "z2: z1 z2* z3",
        "z3: z1 z2",
        "z3: z1^3",
        "z3: z1* z2^2",
    ] {
        library.place(name).unwrap();
    }
    let error = library.place("z3: z1^2").unwrap_err().to_string();
    assert!(error.contains("unknown term \"z3: z1^2\": choose among z1: z1;"), "{error}");
    assert!(Library::new(5, 3).is_err());
    assert!(Library::new(3, 9).is_err());
}
