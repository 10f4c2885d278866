//! Polynomials in the real and imaginary parts of the amplitudes.
//!
//! Equations of real variables x and y, written with `z = x + i y` and its conjugate, are sums of terms that cancel: `x^3` is
//! `(z + conj(z))^3/8`, with a part `x^2 y` that vanishes. As polynomials in x and y they have their own terms alone: planes that the
//! flow keeps stay exact, and far from the origin nothing is left of what cancels.

use super::coefficient::{Place, Tape, Value};
use super::polynomial::{Monomial, Polynomial};
use std::collections::BTreeMap;

/// A coefficient as a sum of coefficients of the polynomial, each times a whole complex number.
pub(super) type Combination = Vec<(Place, [f64; 2])>;

/// The powers of the parts in turn: `x_0, y_0, x_1, y_1, ..`.
pub(super) type Powers = Vec<u8>;

/// Terms in real and imaginary parts.
pub(super) type RealTerms = BTreeMap<Powers, Combination>;

/// The rest of a sum that cancels is less than this part of its summands.
const CANCELLED: f64 = 1e-15;

/// Values of the parameters at which sums are examined: a sum that vanishes at both of them vanishes at all values.
const SAMPLES: [(f64, f64); 2] = [(1.0937, 0.1371), (0.8713, -0.2119)];

/// The value of a combination: 0 where it cancels.
pub(super) fn value(combination: &Combination, values: &[Value]) -> Value {
    let (mut sum, mut size) = ([0.0_f64; 2], [0.0_f64; 2]);
    for &(place, [re, im]) in combination {
        let [a, b] = values[place as usize];
        for (part, terms) in [[a * re, -b * im], [a * im, b * re]].into_iter().enumerate() {
            sum[part] += terms[0] + terms[1];
            size[part] += terms[0].abs() + terms[1].abs();
        }
    }
    [0, 1].map(|part| if sum[part].abs() <= CANCELLED * size[part] { 0.0 } else { sum[part] })
}

/// Polynomials in real and imaginary parts.
pub(super) struct RealForm {
    /// Their terms.
    pub(super) terms: Vec<RealTerms>,
    /// Bits of the parts that are a factor of their own rate. Parts with a constant rate of growth or decay are not among them.
    pub(super) kept: u64,
}

/// The terms of these polynomials in real and imaginary parts, without those that cancel for all values of the parameters `defaults`;
/// `None` where they are not fewer than those in the amplitudes.
pub(super) fn fewer(
    polynomials: &[Polynomial],
    modes: usize,
    tape: &Tape,
    defaults: &[f64],
) -> Option<RealForm> {
    let samples = SAMPLES.map(|(factor, offset)| {
        // each parameter differently: a difference of two with the same default is no 0
        let moved = |(place, value): (usize, &f64)| {
            let place = place as f64;
            value * (factor + 0.0173 * place) + offset * (1.0 + 0.618 * place)
        };
        tape.evaluate(&defaults.iter().enumerate().map(moved).collect::<Vec<f64>>())
    });
    let remains = |terms: &Combination| samples.iter().any(|values| value(terms, values) != [0.0; 2]);
    let mut all = Vec::new();
    for polynomial in polynomials {
        let mut terms = expanded(polynomial, modes);
        terms.retain(|_, combination| remains(combination));
        all.push(terms);
    }
    let count = |lengths: Vec<usize>| lengths.iter().sum::<usize>();
    let real = count(all.iter().map(BTreeMap::len).collect());
    let complex = count(polynomials.iter().map(|polynomial| polynomial.0.len()).collect());
    if real >= complex {
        return None;
    }
    let part_remains =
        |sum: &Combination, part: usize| samples.iter().any(|values| value(sum, values)[part] != 0.0);
    let is_factor = |unknown: usize| {
        let own = || all[unknown / 2].iter().filter(|(_, sum)| part_remains(sum, unknown % 2));
        let more = |powers: &Powers| powers.iter().map(|power| u32::from(*power)).sum::<u32>() > 1;
        own().all(|(powers, _)| powers[unknown] > 0) && own().any(|(powers, _)| more(powers))
    };
    let unknowns = (0..2 * all.len()).filter(|&unknown| is_factor(unknown));
    let kept = unknowns.fold(0, |bits, unknown| bits | 1 << unknown);
    Some(RealForm { terms: all, kept })
}

/// A polynomial in real and imaginary parts.
fn expanded(polynomial: &Polynomial, modes: usize) -> RealTerms {
    let mut terms = RealTerms::new();
    for (monomial, &place) in &polynomial.0 {
        for (powers, factor) in product(monomial, modes) {
            terms.entry(powers).or_default().push((place, factor));
        }
    }
    terms
}

/// A monomial: the product over the amplitudes of `(x + i y)^a (x - i y)^b`.
fn product(monomial: &Monomial, modes: usize) -> BTreeMap<Powers, [f64; 2]> {
    let mut all = BTreeMap::from([(vec![0; 2 * modes], [1.0, 0.0])]);
    for (mode, &[z, conj]) in monomial.0.iter().enumerate().take(modes) {
        for sign in (0..z).map(|_| 1.0).chain((0..conj).map(|_| -1.0)) {
            all = times(&all, mode, sign);
        }
    }
    all
}

/// A polynomial times `x + i sign y` of an amplitude.
fn times(all: &BTreeMap<Powers, [f64; 2]>, mode: usize, sign: f64) -> BTreeMap<Powers, [f64; 2]> {
    let mut out: BTreeMap<Powers, [f64; 2]> = BTreeMap::new();
    for (powers, &[re, im]) in all {
        for (part, factor) in [(0, [re, im]), (1, [-sign * im, sign * re])] {
            let mut raised = powers.clone();
            raised[2 * mode + part] += 1;
            let sum = out.entry(raised).or_default();
            (sum[0], sum[1]) = (sum[0] + factor[0], sum[1] + factor[1]);
        }
    }
    out.retain(|_, factor| *factor != [0.0; 2]);
    out
}
