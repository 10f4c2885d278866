//! The rows of a scan as columns in memory, the basis of arrays.

use super::{NUMBERS, Row, ScanPlan};
use motiform_analysis::regime::{Attractor, Course, Regime};

/// Rows `first..` of a scan, column by column, in the order `row = cell * samples + sample`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScanTable {
    /// Place in [`Regime::ALL`]; [`ScanTable::MISSING`] if the row is not computed.
    pub regimes: Vec<u8>,
    /// Place in [`Attractor::ALL`]; [`ScanTable::MISSING`] if the row is not computed.
    pub attractors: Vec<u8>,
    /// Place in [`Course::ALL`]; [`ScanTable::MISSING`] where the model does not tell motions of this name apart.
    pub courses: Vec<u8>,
    /// One column for each of [`NUMBERS`]; NaN if the number is not defined for the motion.
    pub numbers: [Vec<f64>; NUMBERS.len()],
    /// The evidence of each row, if it is kept: it takes more memory than all numbers.
    pub whys: Option<Vec<String>>,
}

impl ScanTable {
    /// The code of a row that is not computed.
    pub const MISSING: u8 = u8::MAX;

    /// A table for this many rows, none of them computed.
    pub fn empty(rows: usize, whys: bool) -> Self {
        Self {
            regimes: vec![Self::MISSING; rows],
            attractors: vec![Self::MISSING; rows],
            courses: vec![Self::MISSING; rows],
            numbers: std::array::from_fn(|_| vec![f64::NAN; rows]),
            whys: whys.then(|| vec![String::new(); rows]),
        }
    }

    /// Puts a row in a place.
    pub fn put(&mut self, place: usize, row: Row) {
        self.regimes[place] = code(Regime::ALL.iter().position(|&known| known == row.regime));
        self.attractors[place] = code(Attractor::ALL.iter().position(|&known| known == row.attractor));
        self.courses[place] = code(Course::ALL.iter().position(|&known| Some(known) == row.course));
        for (column, number) in self.numbers.iter_mut().zip(row.numbers) {
            column[place] = number;
        }
        if let Some(whys) = &mut self.whys {
            whys[place] = row.why;
        }
    }

    /// The row in a place, which is that of `cell` and `sample`; `None` if it is not computed, or without evidence.
    pub fn row(&self, place: usize, cell: usize, sample: usize) -> Option<Row> {
        Some(Row {
            cell,
            sample,
            regime: *Regime::ALL.get(usize::from(*self.regimes.get(place)?))?,
            attractor: *Attractor::ALL.get(usize::from(*self.attractors.get(place)?))?,
            course: Course::ALL.get(usize::from(*self.courses.get(place)?)).copied(),
            numbers: std::array::from_fn(|number| self.numbers[number][place]),
            why: self.whys.as_ref()?.get(place)?.clone(),
        })
    }

    /// The place of a row in the table of the whole plan.
    pub fn place(plan: &ScanPlan, row: &Row) -> usize {
        row.cell * plan.computation.samples + row.sample
    }
}

fn code(place: Option<usize>) -> u8 {
    place.and_then(|place| u8::try_from(place).ok()).unwrap_or(ScanTable::MISSING)
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_analysis::regime::Verdict;

    #[test]
    fn a_row_comes_back_as_it_was_put() {
        let verdict = Verdict::new(Regime::Zigzag, Attractor::Periodic, "because".to_owned(), 3.0);
        let course = Some(Course::Clockwise);
        let row = Row::new(7, 1, Verdict { period: Some(2.5), course, ..verdict });
        let mut table = ScanTable::empty(3, true);
        table.put(1, row.clone());
        let back = table.row(1, 7, 1).unwrap();
        assert_eq!((back.regime, back.attractor, &back.why), (row.regime, row.attractor, &row.why));
        assert_eq!(back.course, course);
        assert_eq!(back.numbers.map(f64::to_bits), row.numbers.map(f64::to_bits));
        assert!(table.row(0, 7, 0).is_none(), "it is not computed");
        assert_eq!(table.regimes[2], ScanTable::MISSING);
    }
}
