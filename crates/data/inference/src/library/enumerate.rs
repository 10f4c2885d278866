//! All monomials that turn with the plane as their amplitude does.

use super::{MOST_MODES, Term};

/// The terms of all equations: by equation, order, then powers with high powers of low amplitudes first.
pub(super) fn covariant(modes: usize, order: u32) -> Vec<Term> {
    let mut all = Vec::new();
    for total in 1..=order {
        extend(&mut all, [[0; 2]; MOST_MODES], (0, 2 * modes), total);
    }
    let mut terms = Vec::new();
    for equation in 0..modes {
        let of = all.iter().map(|&powers| Term { equation, powers });
        terms.extend(of.filter(Term::is_covariant));
    }
    terms
}

/// Adds the products of `left` more factors among `z1, conj(z1), z2, ..` from factor `from` on.
fn extend(
    all: &mut Vec<[[u8; 2]; MOST_MODES]>,
    powers: [[u8; 2]; MOST_MODES],
    range: (usize, usize),
    left: u32,
) {
    if left == 0 {
        all.push(powers);
        return;
    }
    for factor in range.0..range.1 {
        let mut more = powers;
        more[factor / 2][factor % 2] += 1;
        extend(all, more, (factor, range.1), left - 1);
    }
}
