//! Products of amplitudes, each computed once from a shorter one.

use crate::{MOST_MODES, Term};
use motiform_dynamics::Complex;
use std::collections::BTreeMap;

/// Powers of `z1, conj(z1), z2, conj(z2), ..`.
type Powers = [u8; VARIABLES];

const VARIABLES: usize = 2 * MOST_MODES;

/// Derivatives of a term by an amplitude and its conjugate: factor and product.
#[derive(Clone, Copy, Debug)]
pub(super) struct First {
    pub(super) term: usize,
    pub(super) equation: usize,
    pub(super) amplitude: usize,
    pub(super) z: (f64, usize),
    pub(super) conj: (f64, usize),
}

/// A second derivative of a term by variables of which the first is not the later one: `factor * product`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Second {
    pub(super) term: usize,
    pub(super) equation: usize,
    pub(super) by: [usize; 2],
    pub(super) factor: f64,
    pub(super) product: usize,
}

/// The products that terms and their derivatives are made of.
#[derive(Clone, Debug, Default)]
pub(super) struct Products {
    places: BTreeMap<Powers, usize>,
    /// Each product as a shorter one times a variable; number 0 is 1.
    pub(super) steps: Vec<(usize, usize)>,
    /// The product that each term is.
    pub(super) terms: Vec<usize>,
    pub(super) first: Vec<First>,
    pub(super) second: Vec<Second>,
}

/// Factor and powers of the derivative by a variable; the factor is 0 where it does not occur.
fn derivative(powers: &Powers, variable: usize) -> (f64, Powers) {
    let mut lower = *powers;
    lower[variable] = lower[variable].saturating_sub(1);
    (f64::from(powers[variable]), lower)
}

impl Products {
    pub(super) fn new(terms: &[Term]) -> Self {
        let mut made = Self::default();
        made.place([0; VARIABLES]);
        for (number, term) in terms.iter().enumerate() {
            let powers: Powers = std::array::from_fn(|v| term.powers[v / 2][v % 2]);
            let place = made.place(powers);
            made.terms.push(place);
            made.derivatives(number, term.equation, &powers);
        }
        made
    }

    /// The number of a product.
    fn place(&mut self, powers: Powers) -> usize {
        if let Some(&place) = self.places.get(&powers) {
            return place;
        }
        let step = match powers.iter().position(|&power| power > 0) {
            Some(variable) => (self.place(derivative(&powers, variable).1), variable),
            None => (0, 0),
        };
        self.steps.push(step);
        self.places.insert(powers, self.steps.len() - 1);
        self.steps.len() - 1
    }

    fn derivatives(&mut self, term: usize, equation: usize, powers: &Powers) {
        for amplitude in (0..MOST_MODES).filter(|a| powers[2 * a] + powers[2 * a + 1] > 0) {
            let [z, conj] = [2 * amplitude, 2 * amplitude + 1].map(|v| {
                let (factor, lower) = derivative(powers, v);
                (factor, if factor > 0.0 { self.place(lower) } else { 0 })
            });
            self.first.push(First { term, equation, amplitude, z, conj });
        }
        for v in (0..VARIABLES).filter(|&v| powers[v] > 0) {
            let (factor, lower) = derivative(powers, v);
            for w in (v..VARIABLES).filter(|&w| lower[w] > 0) {
                let (again, lowest) = derivative(&lower, w);
                let product = self.place(lowest);
                self.second.push(Second { term, equation, by: [v, w], factor: factor * again, product });
            }
        }
    }

    #[inline(always)]
    pub(super) fn evaluate<const SHAPE: usize>(&self, shape: &[f64; SHAPE], values: &mut [Complex<f64>]) {
        let mut variables = [Complex::new(0.0, 0.0); SHAPE];
        for n in 0..SHAPE / 2 {
            variables[2 * n] = Complex::new(shape[2 * n], shape[2 * n + 1]);
            variables[2 * n + 1] = Complex::new(shape[2 * n], -shape[2 * n + 1]);
        }
        values[0] = Complex::new(1.0, 0.0);
        for (place, &(shorter, variable)) in self.steps.iter().enumerate().skip(1) {
            values[place] = values[shorter] * variables[variable];
        }
    }
}
