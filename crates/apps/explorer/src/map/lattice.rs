//! The lattice of the cells of a map, which does not move with the window.

/// The lattice of one axis at one level of detail: cell `k` has its centre at `anchor + k step`.
///
/// Every level is half as fine as the next and part of it, to the bit: cells computed for one window are reused in another that
/// overlaps it. The anchor is offset by a third of a cell from the edge of the first window, so that no cell of any level lies on a round
/// number, where bifurcations often occur.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lattice {
    anchor: f64,
    /// Step of level 0.
    base: f64,
    whole: bool,
}

/// The cells of one axis in a window.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Cells {
    /// Number of the first one on the lattice.
    pub(crate) first: i64,
    pub(crate) step: f64,
    /// Centres.
    pub(crate) values: Vec<f64>,
}

/// Cells of the first window at level 0. The same for every screen, so that all have the same lattice.
const ACROSS: f64 = 64.0;

/// Finest and coarsest level, against level 0: a factor of a million each way.
const LEVELS: f64 = 20.0;

impl Lattice {
    /// The lattice for a first window, with [`ACROSS`] cells at level 0; of whole numbers if the parameter is one.
    pub(crate) fn new(low: f64, high: f64, whole: bool) -> Self {
        if whole {
            return Self { anchor: 0.0, base: 1.0, whole };
        }
        let base = (high - low) / ACROSS;
        Self { anchor: low + base / 3.0, base, whole }
    }

    /// The cells that a window with about `count` cells shows, none beyond what the model allows; at the window's nearest level.
    pub(crate) fn cells(&self, (low, high): (f64, f64), count: usize, allowed: (f64, f64)) -> Cells {
        let level = ((high - low) / count as f64 / self.base).log2().round().clamp(-LEVELS, LEVELS);
        let step = self.base * if self.whole { level.max(0.0) } else { level }.exp2();
        let place = |x: f64| (x - self.anchor) / step;
        let inside = |k: &i64| (allowed.0..=allowed.1).contains(&self.value(*k, step));
        let first = (place(low) - 0.5).ceil() as i64;
        let last = (place(high) + 0.5).floor() as i64;
        let numbers: Vec<i64> = (first..=last).filter(inside).collect();
        let values = numbers.iter().map(|&k| self.value(k, step)).collect();
        Cells { first: numbers.first().copied().unwrap_or(first), step, values }
    }

    fn value(&self, k: i64, step: f64) -> f64 {
        self.anchor + k as f64 * step
    }
}

/// The coarsest first look takes one cell of 2^COARSEST along each axis.
pub(crate) const COARSEST: u8 = 3;

/// The coarsest level that a cell number of a lattice belongs to.
pub(crate) fn level(k: i64) -> u8 {
    u8::try_from(k.trailing_zeros()).unwrap_or(COARSEST).min(COARSEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: (f64, f64) = (-1e6, 1e6);

    #[test]
    fn a_window_is_covered() {
        let lattice = Lattice::new(-0.22, 0.22, false);
        for (low, high) in [(-0.22, 0.22), (0.013, 0.0302), (-7.0, 9.0), (0.1, 0.1 + 1e-5)] {
            let cells = lattice.cells((low, high), 64, ALL);
            let half = 0.5 * cells.step;
            let (first, last) = (cells.values[0], cells.values[cells.values.len() - 1]);
            assert!(first - half <= low && high <= last + half);
            assert!((44..=93).contains(&cells.values.len()), "{}", cells.values.len());
        }
        assert!((64..=65).contains(&lattice.cells((-0.22, 0.22), 64, ALL).values.len()));
    }

    #[test]
    fn finer_lattices_contain_the_coarser_ones_to_the_bit() {
        let lattice = Lattice::new(-0.22, 0.22, false);
        let coarse = lattice.cells((-0.22, 0.22), 64, ALL);
        let fine = lattice.cells((-0.05, 0.06), 64, ALL);
        assert_eq!(fine.step, 0.25 * coarse.step);
        let bits: Vec<u64> = fine.values.iter().map(|x| x.to_bits()).collect();
        let within = coarse.values.iter().filter(|x| (-0.05..0.06).contains(*x));
        assert!(within.clone().count() > 10);
        assert!(within.into_iter().all(|x| bits.contains(&x.to_bits())));
        let moved = lattice.cells((-0.2, 0.24), 64, ALL);
        assert_eq!(moved.step, coarse.step);
        assert!(coarse.values[10..].iter().all(|x| moved.values.contains(x)));
    }

    /// Bifurcations happen at round numbers: no cell of any level may lie there.
    #[test]
    fn no_cell_lies_on_zero() {
        let lattice = Lattice::new(-0.22, 0.22, false);
        let mut span = 0.44;
        while span > 1e-6 {
            let cells = lattice.cells((-0.4 * span, 0.6 * span), 64, ALL);
            assert!(cells.values.iter().all(|x| x.abs() > 0.1 * cells.step));
            span *= 0.5;
        }
    }

    #[test]
    fn whole_numbers_stay_whole_and_what_is_not_allowed_is_left_out() {
        let lattice = Lattice::new(0.0, 12.0, true);
        assert_eq!(lattice.cells((-0.3, 3.3), 64, (0.0, 12.0)).values, [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(lattice.cells((0.0, 1024.0), 64, (0.0, 1e6)).step, 16.0);
        assert!(lattice.cells((13.0, 20.0), 64, (0.0, 12.0)).values.is_empty());
    }

    #[test]
    fn a_quarter_of_the_cells_of_a_level_are_those_of_the_next() {
        let at_least = |least: u8| (0..64).filter(|&k| level(k) >= least).count();
        assert_eq!([0, 1, 2, 3].map(at_least), [64, 32, 16, 8]);
        assert_eq!((level(0), level(-8), level(-6), level(5)), (3, 3, 1, 0));
    }
}
