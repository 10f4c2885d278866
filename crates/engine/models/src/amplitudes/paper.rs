//! The list of products of the paper's terms, known when the program is compiled.
//!
//! Equations with exactly these terms and real coefficients, whatever their names and values, are evaluated
//! by it: the same operations in the same order, without a list that is read (docs/records/lanes.md has what
//! it gains).

use super::program::{Group, List, Operand, Program, Sum};
use std::ops::Range;

/// The terms of the paper's full model: `z1`, `|z1|^2 z1`, `conj(z1) z2`; `z2`, `z1^2`, `conj(z1) z3`; `z3`, `z1^3`, `z1 z2`.
pub(super) struct Paper;

impl Paper {
    /// Returns `true` if a program is this list.
    pub(super) fn is(program: &Program) -> bool {
        let norms: Vec<Option<u16>> = program.factors.iter().map(|factor| factor.norm).collect();
        program.one == Self.one()
            && program.parts() == Self.parts()
            && program.products == Self.products()
            && program.norms == Self.norms()
            && program.norm_products == Self.norm_products()
            && norms == NORMS
            && program.groups == Self.groups()
            && program.sums == Self.sums()
    }
}

const fn plain(register: u16) -> Operand {
    Operand { register, conj: false }
}

const fn conj(register: u16) -> Operand {
    Operand { register, conj: true }
}

const fn group(register: u16, factors: Range<usize>) -> Group {
    Group { base: plain(register), factors }
}

/// Real coefficients alone, then those with squared moduli.
const fn sum(first: usize, real: usize, end: usize) -> Sum {
    Sum { plain: first..real, real: real..end, complex: end..end }
}

/// The squared modulus of each factor: that of z1 in the third one.
const NORMS: [Option<u16>; 9] = [None, None, Some(0), None, None, None, None, None, None];

impl List for Paper {
    #[inline(always)]
    fn lengths(&self, _given: [usize; 3]) -> [usize; 3] {
        [NORMS.len(), 6, 6]
    }

    #[inline(always)]
    fn one(&self) -> bool {
        false
    }

    #[inline(always)]
    fn parts(&self) -> bool {
        false
    }

    /// Registers 3 to 7: `conj(z1) z2`, `z1^2`, `conj(z1) z3`, `z1^3`, `z1 z2`.
    #[inline(always)]
    fn products(&self) -> &[[Operand; 2]] {
        const PRODUCTS: [[Operand; 2]; 5] = [
            [conj(0), plain(1)],
            [plain(0), plain(0)],
            [conj(0), plain(2)],
            [plain(4), plain(0)],
            [plain(0), plain(1)],
        ];
        &PRODUCTS
    }

    #[inline(always)]
    fn norms(&self) -> &[u16] {
        &[0]
    }

    #[inline(always)]
    fn norm_products(&self) -> &[[u16; 2]] {
        &[]
    }

    #[inline(always)]
    fn norm(&self, factor: usize) -> Option<u16> {
        NORMS[factor]
    }

    #[inline(always)]
    fn groups(&self) -> &[Group] {
        const GROUPS: [Group; 8] = [
            group(3, 0..1),
            group(0, 1..3),
            group(4, 3..4),
            group(5, 4..5),
            group(1, 5..6),
            group(6, 6..7),
            group(7, 7..8),
            group(2, 8..9),
        ];
        &GROUPS
    }

    #[inline(always)]
    fn sums(&self) -> &[Sum] {
        const SUMS: [Sum; 3] = [sum(0, 1, 2), sum(2, 5, 5), sum(5, 8, 8)];
        &SUMS
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amplitudes::{Definition, Equations, ParameterDefinition};
    use motiform_dynamics::Dual;

    const TEXTS: [&str; 3] =
        ["(g - 2*|z1|^2)*z1 + p*conj(z1)*z2", "-q*z2 + r*z1^2 + 3*conj(z1)*z3", "s*z1^3 - z3 + g*z1*z2"];

    fn program(texts: [&str; 3]) -> Program {
        let parameters = ["g", "p", "q", "r", "s"].map(|name| ParameterDefinition::new(name, 0.5)).to_vec();
        let definition = Definition {
            modes: vec![1, 2, 3],
            velocity: None,
            symmetry: None,
            parameters,
            equations: texts.map(str::to_owned).to_vec(),
            noise: std::collections::BTreeMap::new(),
        };
        Equations::new(&definition).unwrap().program
    }

    /// Texts with these terms, in any order and with any coefficients, are this list; with one more term, one
    /// less, or one that is not real they are not.
    #[test]
    fn texts_with_the_papers_terms_are_recognised() {
        assert!(program(TEXTS).paper);
        let [one, two, three] = TEXTS;
        for others in [
            [one, two, "s*z1^3 - z3 + g*z1*z2 + conj(z1)*z2^2"],
            [one, two, "s*z1^3 - z3"],
            ["(g + i*q - 2*|z1|^2)*z1 + p*conj(z1)*z2", two, three],
        ] {
            assert!(!program(others).paper, "{others:?}");
        }
    }

    /// The same bits as the list that is read, over numbers and duals.
    #[test]
    fn it_has_the_bits_of_the_list() {
        let known = program(TEXTS);
        let read = Program { paper: false, ..known.clone() };
        let coefficients: Vec<[f64; 2]> = (0..9).map(|k| [0.3 - 0.17 * f64::from(k), 0.0]).collect();
        for k in 0..50 {
            let u: Vec<f64> = (0..6).map(|i| libm::sin(1.3 * f64::from(k) + 2.1 * f64::from(i))).collect();
            let [mut a, mut b] = [[0.0; 6]; 2];
            known.eval(&coefficients, &u, &mut a);
            read.eval(&coefficients, &u, &mut b);
            assert_eq!(a.map(f64::to_bits), b.map(f64::to_bits));
            let duals: Vec<Dual<f64, 2>> =
                u.iter().map(|&x| Dual { value: x, derivative: [1.0 - x, x * x] }).collect();
            let [mut a, mut b] = [[duals[0]; 6]; 2];
            known.eval(&coefficients, &duals, &mut a);
            read.eval(&coefficients, &duals, &mut b);
            assert_eq!(format!("{a:?}"), format!("{b:?}"));
        }
    }
}
