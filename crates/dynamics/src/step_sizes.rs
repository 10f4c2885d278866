//! Step sizes of exponential methods: `2^(k/4)`, each with its table of coefficients.

use crate::steppers::ExponentialTableau;
use crate::steppers::exponential::StepTable;

/// Longest step, over the fastest growth rate of the linear part. Measured on the cell's saddles (lengths 13.2 to 29.45): growth
/// rates of deviations within 2 % or 1e-4 at .15, wrong by 5 to 30 % at .3, decay instead of growth at .6.
const LONGEST: f64 = 0.15;

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
    /// The largest `k` that is tried.
    most: i32,
}

const FIXED: i32 = i32::MAX;

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
            most,
        }
    }

    /// The step size required by step control.
    pub(crate) fn size(&self) -> f64 {
        libm::exp2(f64::from(self.k) / PER_DOUBLING)
    }

    /// Selects the largest size up to `h`.
    pub(crate) fn set_size(&mut self, h: f64) {
        self.k = exponent(h).min(self.most);
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

    /// Whether a step of size `h` with this error norm is good, and the size of the next one to try.
    ///
    /// `h_new = 0.9 h err^(-1/order)`, within factors 0.2 and 4, rounded down; a step truncated by a limit (`last`)
    /// gives little information about the next one. Source: Hairer, Norsett, Wanner, I, II.4.
    pub(crate) fn judge(&mut self, error: f64, h: f64, order: u32, last: bool) -> bool {
        let good = error <= 1.0;
        let factor = 0.9 * libm::pow(error.max(1e-30), -1.0 / f64::from(order));
        let factor = if error.is_finite() { factor.clamp(0.2, 4.0) } else { 0.2 };
        let k = exponent(h * factor);
        self.k = match (good, last) {
            (true, true) => self.k.max(k),
            (true, false) => k,
            (false, _) => k.min(exponent(h) - 1),
        };
        self.k = self.k.min(self.most);
        good
    }
}

/// The largest `k` with `2^(k/4) <= h` (up to rounding).
#[allow(clippy::cast_possible_truncation, reason = "step sizes are within 2^-1074 .. 2^1024")]
fn exponent(h: f64) -> i32 {
    (PER_DOUBLING * libm::log2(h) + 1e-9).floor() as i32
}
