//! The computed rows of a plane by their parameters, in bounded memory.

use motiform_lab::scan::Row;
use std::collections::HashMap;

/// Maximum number of rows that are kept, at about 300 bytes each.
const MOST: usize = 60_000;

/// Rows of cells, found by the bits of the values on the axes.
#[derive(Default)]
pub(crate) struct Store {
    /// With the number of the map that last requested it.
    rows: HashMap<[u64; 2], (u32, Row)>,
    round: u32,
}

impl Store {
    /// Starts a new map: its rows will be the last to be removed.
    pub(crate) fn begin(&mut self) {
        self.round = self.round.wrapping_add(1);
    }

    /// The row of a cell with these values, now requested by the present map.
    pub(crate) fn get(&mut self, at: &[f64]) -> Option<&Row> {
        let (round, row) = self.rows.get_mut(&key(at))?;
        *round = self.round;
        Some(row)
    }

    /// Stores a row. If there are too many, those of earlier maps are removed first.
    pub(crate) fn put(&mut self, at: &[f64], row: Row) {
        if self.rows.len() >= MOST {
            let now = self.round;
            self.rows.retain(|_, (round, _)| *round == now);
            if self.rows.len() >= MOST {
                self.rows.clear();
            }
        }
        self.rows.insert(key(at), (self.round, row));
    }
}

fn key(at: &[f64]) -> [u64; 2] {
    [at.first(), at.get(1)].map(|value| value.map_or(0, |value| value.to_bits()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_analysis::regime::{Attractor, Regime, Verdict};

    fn row(why: usize) -> Row {
        Row::new(0, 0, Verdict::new(Regime::Straight, Attractor::Equilibrium, why.to_string(), 1.0))
    }

    #[test]
    fn memory_is_bounded_and_the_present_map_stays() {
        let mut store = Store::default();
        for k in 0..MOST {
            if k == MOST / 2 {
                store.begin();
                assert!(store.get(&[0.0, 1.0]).is_some());
            }
            store.put(&[k as f64, 1.0], row(k));
        }
        store.put(&[0.5, 0.5], row(7));
        assert!(store.rows.len() <= MOST / 2 + 2);
        for k in [0, MOST / 2, MOST - 1] {
            assert_eq!(store.get(&[k as f64, 1.0]).map(|row| row.why.clone()), Some(k.to_string()));
        }
        assert!(store.get(&[1.0, 1.0]).is_none() && store.get(&[0.5]).is_none());
        for k in 0..3 * MOST {
            store.put(&[k as f64, 2.0], row(k));
            assert!(store.rows.len() <= MOST);
        }
    }
}
