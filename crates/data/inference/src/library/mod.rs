//! The terms that equations of a fit can have: monomials that turn with the plane as their amplitude does.

mod enumerate;

use crate::{Error, Result, Scales, Track};
use serde::{Deserialize, Serialize};

/// Fewest amplitudes of a library: `z1` and `z2`.
pub(crate) const LEAST_MODES: usize = 2;
/// Most amplitudes of a library: `z1` to `z4`.
pub const MOST_MODES: usize = 4;

/// A monomial in one equation: `prod_m z_m^p conj(z_m)^q`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Term {
    /// The amplitude whose rate it is in, from 0: 0 is `z1`.
    pub equation: usize,
    /// The powers of `z_m` and of `conj(z_m)`, m = 1 to 4.
    pub powers: [[u8; 2]; MOST_MODES],
}

impl Term {
    /// Number of factors.
    pub fn order(&self) -> u32 {
        self.powers.iter().flatten().map(|&power| u32::from(power)).sum()
    }

    /// Number of factors that are `z_m` or its conjugate, m from 0.
    pub fn degree(&self, amplitude: usize) -> i32 {
        self.powers[amplitude].iter().map(|&power| i32::from(power)).sum()
    }

    /// The angular index, by which it turns with the plane: `sum_m m (power of z_m - power of conj(z_m))`.
    pub fn angular_index(&self) -> i32 {
        let turns = |(m, &[z, conj]): (i32, &[u8; 2])| m * (i32::from(z) - i32::from(conj));
        (1..).zip(&self.powers).map(turns).sum()
    }

    /// Returns `true` if it turns as the amplitude of its equation does.
    pub fn is_covariant(&self) -> bool {
        usize::try_from(self.angular_index()) == Ok(self.equation + 1)
    }

    /// As people write it, with its equation: `z1: z1* z2`, `z2: |z2|^2 z2`; a star is the complex conjugate.
    pub fn name(&self) -> String {
        format!("z{}: {}", self.equation + 1, self.factors("*", "", " "))
    }

    /// Its factors in the notation of study files: `|z1|^2*z1`, `conj(z1)*z2`.
    pub fn expression(&self) -> String {
        self.factors(")", "conj(", "*")
    }

    fn factors(&self, after: &str, before: &str, times: &str) -> String {
        let mut factors = Vec::new();
        for (m, &[z, conj]) in self.powers.iter().enumerate() {
            if z.min(conj) > 0 {
                factors.push(format!("|z{}|^{}", m + 1, 2 * z.min(conj)));
            }
        }
        for (m, &[z, conj]) in self.powers.iter().enumerate() {
            let (bare, starred) = (format!("z{}", m + 1), format!("{before}z{}{after}", m + 1));
            let (rest, name) = if z > conj { (z - conj, bare) } else { (conj - z, starred) };
            match rest {
                0 => {}
                1 => factors.push(name),
                _ => factors.push(format!("{name}^{rest}")),
            }
        }
        factors.join(times)
    }
}

/// The terms of all equations, sorted by equation and order.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Library {
    /// Number of amplitudes: 2 to 4.
    pub modes: usize,
    /// The terms.
    pub terms: Vec<Term>,
}

impl Library {
    /// All rotation-covariant monomials of `z1 .. z_modes` of order 1 to `order`.
    ///
    /// Two modes: 4 + 4 terms to order 3. Three modes: 8 + 7 + 7 terms to order 3 (the tensor model's), 32 +
    /// 30 + 29 to order 5. Four modes: 12, 12, 11, 10 to order 3.
    ///
    /// # Errors
    /// [`Error::Setting`] unless `modes` is 2 to 4 and `order` 1 to 5.
    pub fn new(modes: usize, order: u32) -> Result<Self> {
        if !(LEAST_MODES..=MOST_MODES).contains(&modes) {
            return Err(Error::Setting { key: "modes", value: modes as f64, remedy: "give 2, 3 or 4" });
        }
        if !(1..=5).contains(&order) {
            return Err(Error::Setting { key: "order", value: f64::from(order), remedy: "give 1 to 5" });
        }
        Ok(Self { modes, terms: enumerate::covariant(modes, order) })
    }

    /// The terms of the tensor model: three modes, order 3.
    pub fn tensor() -> Self {
        Self { modes: 3, terms: enumerate::covariant(3, 3) }
    }

    /// The terms that these tracks can have anything to say of: of three amplitudes those without z3, where
    /// that does not exceed its errors of observation.
    ///
    /// A mode that is not seen fixes none of its coefficients, and would leave a motion that z1 and z2 make without a name.
    #[must_use]
    pub fn seen(self, tracks: &[Track]) -> Self {
        let known = self.modes == 3 && crate::observation::check(tracks, 3).is_ok();
        let unseen = known && Scales::of(tracks, 3).signal[2] < 1.0;
        if !unseen {
            return self;
        }
        let terms = self.terms.into_iter().filter(|term| term.equation < 2 && term.degree(2) == 0);
        Self { modes: 2, terms: terms.collect() }
    }

    /// Those of its terms that have these names ([`Term::name`]).
    ///
    /// # Errors
    /// [`Error::Term`] for a name that none of its terms has.
    pub fn select(&self, names: &[&str]) -> Result<Self> {
        let mut kept = vec![false; self.terms.len()];
        for name in names {
            kept[self.place(name)?] = true;
        }
        let terms = self.terms.iter().zip(kept).filter(|(_, kept)| *kept).map(|(term, _)| term.clone());
        Ok(Self { modes: self.modes, terms: terms.collect() })
    }

    /// The number of the term with this name.
    ///
    /// # Errors
    /// [`Error::Term`] if there is none.
    pub fn place(&self, name: &str) -> Result<usize> {
        let found = self.terms.iter().position(|term| term.name() == name);
        found.ok_or_else(|| Error::Term { name: name.to_owned(), known: self.names() })
    }

    /// The names of all terms.
    pub fn names(&self) -> Vec<String> {
        self.terms.iter().map(Term::name).collect()
    }

    /// The numbers of the terms in one equation.
    pub fn of_equation(&self, equation: usize) -> Vec<usize> {
        (0..self.terms.len()).filter(|&term| self.terms[term].equation == equation).collect()
    }
}
