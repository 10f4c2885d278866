//! Polynomials in amplitudes and their conjugates, with coefficients that depend on parameters.

use super::coefficient::{Place, Tape};
use std::collections::BTreeMap;

/// Maximum number of amplitudes.
pub const MOST_MODES: usize = 16;
/// Maximum order of a term.
pub const MOST_ORDER: u32 = 7;
/// Maximum number of terms of a polynomial.
pub(super) const MOST_TERMS: usize = 512;

/// A product of powers of amplitudes: for each amplitude, the power of `z` and that of `conj(z)`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Monomial(pub [[u8; 2]; MOST_MODES]);

impl Monomial {
    /// The amplitude of this number.
    pub fn amplitude(number: usize) -> Self {
        let mut one = Self::default();
        one.0[number][0] = 1;
        one
    }

    /// Number of factors.
    pub fn order(&self) -> u32 {
        self.0.iter().flatten().map(|&power| u32::from(power)).sum()
    }

    /// The angular index, by which it turns with the plane: `sum_n n (power of z_n - power of conj(z_n))`.
    pub fn angular_index(&self, modes: &[u32]) -> i64 {
        let terms = modes.iter().zip(&self.0);
        terms.map(|(&n, &[z, conj])| i64::from(n) * (i64::from(z) - i64::from(conj))).sum()
    }

    /// The complex conjugate.
    #[must_use]
    pub fn conj(mut self) -> Self {
        for powers in &mut self.0 {
            powers.swap(0, 1);
        }
        self
    }

    fn times(mut self, other: &Self) -> Self {
        for (powers, more) in self.0.iter_mut().flatten().zip(other.0.iter().flatten()) {
            *powers = powers.saturating_add(*more);
        }
        self
    }

    /// As people write it: `|z1|^2 z1`, `conj(z1) z2`; nothing for 1.
    pub fn text(&self, modes: &[u32]) -> String {
        let mut factors = Vec::new();
        for (&n, &[z, conj]) in modes.iter().zip(&self.0) {
            if z.min(conj) > 0 {
                factors.push(format!("|z{n}|^{}", 2 * z.min(conj)));
            }
        }
        for (&n, &[z, conj]) in modes.iter().zip(&self.0) {
            let (rest, name) =
                if z > conj { (z - conj, format!("z{n}")) } else { (conj - z, format!("conj(z{n})")) };
            match rest {
                0 => {}
                1 => factors.push(name),
                _ => factors.push(format!("{name}^{rest}")),
            }
        }
        factors.join("*")
    }
}

/// A sum of monomials with their coefficients.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Polynomial(pub(super) BTreeMap<Monomial, Place>);

/// The reason why an operation on polynomials is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    /// An order above [`MOST_ORDER`].
    Order,
    /// More than [`MOST_TERMS`] terms, or coefficients too long.
    Terms,
}

impl Polynomial {
    /// A coefficient alone.
    pub(super) fn constant(coefficient: Place) -> Self {
        Self(BTreeMap::from([(Monomial::default(), coefficient)]))
    }

    /// One monomial with a coefficient.
    pub(super) fn term(monomial: Monomial, coefficient: Place) -> Self {
        Self(BTreeMap::from([(monomial, coefficient)]))
    }

    /// The coefficient, if there is nothing else.
    pub(super) fn as_constant(&self) -> Option<Place> {
        let (monomial, &place) = self.0.iter().next()?;
        (self.0.len() == 1 && *monomial == Monomial::default()).then_some(place)
    }

    pub(super) fn add(mut self, other: &Self, minus: bool, tape: &mut Tape) -> Result<Self, Refusal> {
        for (monomial, &place) in &other.0 {
            let sum = match (self.0.get(monomial), minus) {
                (Some(&mine), false) => tape.add(mine, place),
                (Some(&mine), true) => tape.subtract(mine, place),
                (None, false) => place,
                (None, true) => tape.negate(place),
            };
            self.0.insert(*monomial, sum);
        }
        self.checked(tape)
    }

    pub(super) fn multiply(&self, other: &Self, tape: &mut Tape) -> Result<Self, Refusal> {
        let mut product = Self::default();
        for (a, &place_a) in &self.0 {
            for (b, &place_b) in &other.0 {
                let monomial = a.times(b);
                if monomial.order() > MOST_ORDER {
                    return Err(Refusal::Order);
                }
                let place = tape.multiply(place_a, place_b);
                let sum = match product.0.get(&monomial) {
                    Some(&before) => tape.add(before, place),
                    None => place,
                };
                product.0.insert(monomial, sum);
                if tape.is_full() {
                    return Err(Refusal::Terms);
                }
            }
        }
        product.checked(tape)
    }

    /// This with every coefficient changed.
    pub(super) fn map(mut self, mut change: impl FnMut(Place) -> Place) -> Self {
        for place in self.0.values_mut() {
            *place = change(*place);
        }
        self
    }

    pub(super) fn conj(self, tape: &mut Tape) -> Self {
        Self(self.0.into_iter().map(|(monomial, place)| (monomial.conj(), tape.conjugate(place))).collect())
    }

    fn checked(self, tape: &Tape) -> Result<Self, Refusal> {
        if self.0.len() > MOST_TERMS || tape.is_full() { Err(Refusal::Terms) } else { Ok(self) }
    }
}
