//! Products of amplitudes, each computed once from a shorter one.

use super::SHAPE;
use crate::Term;
use motiform_dynamics::Complex;
use std::collections::BTreeMap;

/// Powers of `z1, conj(z1), z2, conj(z2), z3, conj(z3)`.
type Powers = [u8; SHAPE];

/// A derivative of a term: `factor * product`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Second {
    /// The two variables.
    pub(super) by: [usize; 2],
    pub(super) factor: f64,
    pub(super) product: usize,
}

/// The products that terms and their derivatives are made of.
#[derive(Clone, Debug)]
pub(super) struct Products {
    /// Each product as a shorter one times a variable; number 0 is 1.
    steps: Vec<(usize, usize)>,
    /// The product that each term is.
    terms: Vec<usize>,
    /// First derivatives of each term by each variable: factor and product.
    first: Vec<[(f64, usize); SHAPE]>,
    second: Vec<Vec<Second>>,
}

/// Products under construction.
#[derive(Default)]
struct Table {
    places: BTreeMap<Powers, usize>,
    steps: Vec<(usize, usize)>,
}

impl Table {
    fn place(&mut self, powers: Powers) -> usize {
        if let Some(&place) = self.places.get(&powers) {
            return place;
        }
        let step = match lowered(&powers) {
            Some((variable, shorter)) => (self.place(shorter), variable),
            None => (0, 0),
        };
        self.steps.push(step);
        self.places.insert(powers, self.steps.len() - 1);
        self.steps.len() - 1
    }
}

/// The first variable that occurs, and the powers without it.
fn lowered(powers: &Powers) -> Option<(usize, Powers)> {
    let variable = powers.iter().position(|&power| power > 0)?;
    Some((variable, derivative(powers, variable).1))
}

/// Factor and powers of the derivative by a variable; the factor is 0 where it does not occur.
fn derivative(powers: &Powers, variable: usize) -> (f64, Powers) {
    let mut lower = *powers;
    lower[variable] = lower[variable].saturating_sub(1);
    (f64::from(powers[variable]), lower)
}

impl Products {
    pub(super) fn new(terms: &[Term]) -> Self {
        let mut table = Table::default();
        table.place([0; SHAPE]);
        let (mut places, mut first, mut second) = (Vec::new(), Vec::new(), Vec::new());
        for term in terms {
            let powers: Powers = std::array::from_fn(|v| term.powers[v / 2][v % 2]);
            places.push(table.place(powers));
            let mut gradient = [(0.0, 0); SHAPE];
            let mut entries = Vec::new();
            for v in (0..SHAPE).filter(|&v| powers[v] > 0) {
                let (factor, lower) = derivative(&powers, v);
                gradient[v] = (factor, table.place(lower));
                for w in (0..SHAPE).filter(|&w| lower[w] > 0) {
                    let (again, lowest) = derivative(&lower, w);
                    entries.push(Second { by: [v, w], factor: factor * again, product: table.place(lowest) });
                }
            }
            first.push(gradient);
            second.push(entries);
        }
        Self { steps: table.steps, terms: places, first, second }
    }

    pub(super) fn len(&self) -> usize {
        self.steps.len()
    }

    pub(super) fn evaluate(&self, shape: &[f64; SHAPE], values: &mut [Complex<f64>]) {
        let variables: [Complex<f64>; SHAPE] = std::array::from_fn(|v| {
            let (re, im) = (shape[v / 2 * 2], shape[v / 2 * 2 + 1]);
            Complex::new(re, if v % 2 == 0 { im } else { -im })
        });
        values[0] = Complex::new(1.0, 0.0);
        for (place, &(shorter, variable)) in self.steps.iter().enumerate().skip(1) {
            values[place] = values[shorter] * variables[variable];
        }
    }

    pub(super) fn value(&self, term: usize, values: &[Complex<f64>]) -> Complex<f64> {
        values[self.terms[term]]
    }

    pub(super) fn first(&self, term: usize, values: &[Complex<f64>]) -> [Complex<f64>; SHAPE] {
        self.first[term].map(|(factor, product)| values[product] * factor)
    }

    pub(super) fn second(&self, term: usize) -> &[Second] {
        &self.second[term]
    }
}
