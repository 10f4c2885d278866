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
