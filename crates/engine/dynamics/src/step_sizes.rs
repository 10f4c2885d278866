//! Step sizes of exponential methods: `2^(k/4)`, each with its table of coefficients.

use crate::steppers::ExponentialTableau;
use crate::steppers::exponential::StepTable;

/// Longest step, over the fastest growth rate of the linear part. Measured on the cell's saddles (lengths 13.2 to 29.45): growth
/// rates of deviations within 2 % or 1e-4 at .15, wrong by 5 to 30 % at .3, decay instead of growth at .6.
const LONGEST: f64 = 0.15;

/// Bound on the round-off error of a size in quarters of a doubling.
const ROUNDING: f64 = 1e-9;

/// Step sizes per doubling.
const PER_DOUBLING: f64 = 4.0;

/// The tables computed so far, the one in use, and the size required by step control.
pub(crate) struct StepTables {
    /// By `k`; the fixed step is stored under [`FIXED`].
    known: Vec<(i32, StepTable)>,
    /// For sizes used once: the last step to a limit, a step to a section.
    odd: StepTable,
    /// Its size, 0 for none: steps of the same odd size often follow each other.
    odd_size: f64,
    /// Index in `known`; `None` for `odd`.
    selected: Option<usize>,
    /// Exponent `k` of the next step to try.
    k: i32,
    /// `2^(k/4)`.
    size: f64,
    /// The largest error norms after which the exponent grows by [`MOST_SMALLER`], one more, and so on.
    errors: [f64; CHANGES],
    /// The largest `k` that is tried.
    most: i32,
}

const FIXED: i32 = i32::MAX;

/// Least and greatest factor between the sizes of successive steps.
const FACTORS: [f64; 2] = [0.2, 4.0];

/// Change of `k` for the least factor.
const MOST_SMALLER: i32 = -10;

/// Changes of `k` above that one, up to the greatest factor.
const CHANGES: usize = 18;

impl StepTables {
    /// Tables for the rates `lambda` of the linear part.
    ///
    /// No step is longer than [`LONGEST`] over the fastest growth rate. Near an unstable equilibrium the error of a step is below
    /// any tolerance, whatever its length; there long steps would damp a growing oscillation, and the orbit would never
    /// leave.
    pub(crate) fn new(tableau: &ExponentialTableau, lambda: &[f64]) -> Self {
        let fastest = lambda.iter().copied().fold(0.0, f64::max);
        let most = if fastest > 0.0 { exponent(LONGEST / fastest) } else { i32::MAX - 1 };
        Self {
            known: Vec::new(),
            odd: StepTable::new(tableau, lambda.len()),
            odd_size: 0.0,
            selected: None,
            k: 0,
            size: 1.0,
            errors: errors(tableau.order),
            most,
        }
    }

    /// The step size required by step control.
    pub(crate) fn size(&self) -> f64 {
        self.size
    }

    /// Selects the largest size up to `h`.
    pub(crate) fn set_size(&mut self, h: f64) {
        self.set_exponent(exponent(h));
    }

    fn set_exponent(&mut self, k: i32) {
        let k = k.min(self.most);
        if k != self.k {
            (self.k, self.size) = (k, libm::exp2(f64::from(k) / PER_DOUBLING));
        }
    }

    /// The table in use.
    pub(crate) fn selected(&self) -> &StepTable {
        self.selected.map_or(&self.odd, |index| &self.known[index].1)
    }

    /// Uses the size required by step control.
    pub(crate) fn select_size(&mut self, tableau: &ExponentialTableau, lambda: &[f64]) {
        self.select(self.k, self.size(), tableau, lambda);
    }

    /// Uses the one size of a fixed-step run.
    pub(crate) fn select_fixed(&mut self, tableau: &ExponentialTableau, lambda: &[f64], h: f64) {
        self.select(FIXED, h, tableau, lambda);
    }

    /// Uses the size `h`, without keeping its table.
    pub(crate) fn select_odd(&mut self, tableau: &ExponentialTableau, lambda: &[f64], h: f64) {
        if h != self.odd_size {
            self.odd.fill(tableau, lambda, h);
            self.odd_size = h;
        }
        self.selected = None;
    }

    fn select(&mut self, key: i32, h: f64, tableau: &ExponentialTableau, lambda: &[f64]) {
        let found = self.known.iter().position(|&(known, _)| known == key);
        let index = found.unwrap_or_else(|| {
            let mut table = StepTable::new(tableau, lambda.len());
            table.fill(tableau, lambda, h);
            self.known.push((key, table));
            self.known.len() - 1
        });
        self.selected = Some(index);
    }

    /// Returns `true` if a step of size `h` with this error norm is accepted, and sets the size of the next
    /// one to try.
    ///
    /// `h_new = 0.9 h err^(-1/order)`, within factors 0.2 and 4, rounded down; a step truncated by a limit (`last`)
    /// gives little information about the next one. Source: Hairer, Norsett, Wanner, I, II.4.
    pub(crate) fn judge(&mut self, error: f64, h: f64, order: u32, last: bool) -> bool {
        let good = error <= 1.0;
        let k = if last { exponent(h * factor(error, order)) } else { self.k + self.change(error) };
        self.set_exponent(match (good, last) {
            (true, true) => self.k.max(k),
            (true, false) => k,
            (false, true) => k.min(exponent(h) - 1),
            (false, false) => k.min(self.k - 1),
        });
        good
    }

    /// The change of `k` after a step of size `2^(k/4)`: without a power and a logarithm at every step.
    fn change(&self, error: f64) -> i32 {
        self.errors.iter().take_while(|most| error <= **most).fold(MOST_SMALLER, |k, _| k + 1)
    }
}

/// The largest `k` with `2^(k/4) <= h` (up to rounding).
#[allow(clippy::cast_possible_truncation, reason = "step sizes are within 2^-1074 .. 2^1024")]
fn exponent(h: f64) -> i32 {
    (PER_DOUBLING * libm::log2(h) + ROUNDING).floor() as i32
}

/// The factor between the sizes of successive steps.
fn factor(error: f64, order: u32) -> f64 {
    let factor = 0.9 * libm::pow(error.max(1e-30), -1.0 / f64::from(order));
    if error.is_finite() { factor.clamp(FACTORS[0], FACTORS[1]) } else { FACTORS[0] }
}

/// The error norms at which [`factor`] is `2^(change/4)`, for each change above [`MOST_SMALLER`].
fn errors(order: u32) -> [f64; CHANGES] {
    let at = |i: usize| {
        let change = f64::from(MOST_SMALLER) + 1.0 + i as f64;
        libm::pow(0.9 / libm::exp2((change - ROUNDING) / PER_DOUBLING), f64::from(order))
    };
    std::array::from_fn(at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::steppers::KROGSTAD4;

    #[test]
    fn the_change_of_the_exponent_is_that_of_the_factor() {
        let tables = StepTables::new(&KROGSTAD4, &[-1.0]);
        let errors =
            (0..20_000).map(|i| libm::exp2(f64::from(i) / 150.0 - 110.0)).chain([0.0, f64::INFINITY]);
        for error in errors {
            let from_factor = exponent(factor(error, KROGSTAD4.order));
            assert_eq!(tables.change(error), from_factor, "after an error of {error}");
        }
        assert_eq!(tables.change(f64::NAN), exponent(FACTORS[0]));
        assert!(tables.change(0.0) == 8 && tables.change(1e9) == MOST_SMALLER);
    }
}
