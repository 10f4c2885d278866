//! The results of a scan, read part by part.

use super::rows::place;
use super::{NUMBERS, PartError, Reasons, Row, ScanFolder, read_part};
use motiform_analysis::regime::{Course, Regime};
use motiform_dynamics::sample::median;
use motiform_figures::{Hand, RegimeMark, turning_mark};
use motiform_study::Error;

/// The total results of a scan, in memory that does not grow with the cells.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// Cells that are computed.
    pub cells: usize,
    /// Rows that are computed.
    pub rows: usize,
    /// Rows of each regime, in the order of [`Regime::ALL`].
    pub regimes: [usize; Regime::ALL.len()],
    /// Those of each course, in the order of [`Course::ALL`], where the model tells directions apart.
    pub courses: [[usize; Course::ALL.len()]; Regime::ALL.len()],
    /// Cells with more than one motion, not counting undetermined rows.
    pub multistable: usize,
    /// Cells with an undetermined row.
    pub undetermined: usize,
    /// Why rows are undetermined.
    pub reasons: Reasons,
    /// Cells with a row that blew up.
    pub escaped: usize,
    /// Cells that are not computed yet.
    pub missing: usize,
    /// Damaged parts, each with a description (their cells count as missing).
    pub damaged: Vec<String>,
}

impl Totals {
    /// Reads a folder.
    ///
    /// # Errors
    /// [`Error::Store`].
    pub fn of(folder: &ScanFolder) -> Result<Self, Error> {
        let mut totals = Self::default();
        totals.damaged = for_each_part(folder, |rows| {
            for cell in rows.chunk_by(|a, b| a.cell == b.cell) {
                totals.add(cell);
            }
        })?;
        totals.missing = folder.plan().cells() - totals.cells;
        Ok(totals)
    }

    fn add(&mut self, cell: &[Row]) {
        let motions = motions(cell);
        let has = |regime| motions.iter().any(|motion| motion.regime == regime);
        let decided = motions.iter().filter(|motion| motion.regime != Regime::Undetermined).count();
        self.cells += 1;
        self.rows += cell.len();
        self.multistable += usize::from(decided > 1);
        self.undetermined += usize::from(has(Regime::Undetermined));
        self.escaped += usize::from(has(Regime::BlowUp));
        motions.iter().for_each(|motion| self.reasons.add_all(&motion.reasons));
        for (count, regime) in self.regimes.iter_mut().zip(Regime::ALL) {
            *count += cell.iter().filter(|row| row.regime == regime).count();
        }
        let courses = cell.iter().filter_map(|row| Some((row.regime, row.course?)));
        for (regime, course) in courses {
            let row = Regime::ALL.iter().position(|one| *one == regime);
            let column = Course::ALL.iter().position(|one| *one == course);
            if let (Some(row), Some(column)) = (row, column) {
                self.courses[row][column] += 1;
            }
        }
    }

    /// The regimes that occur, with their number of rows.
    pub fn regimes(&self) -> impl Iterator<Item = (Regime, usize)> {
        Regime::ALL.into_iter().zip(self.regimes).filter(|entry| entry.1 > 0)
    }

    /// The courses of the rows of a regime, with their number of rows; none where the model has no directions.
    pub fn courses(&self, regime: Regime) -> impl Iterator<Item = (Course, usize)> {
        let own = Regime::ALL.iter().position(|one| *one == regime).map(|place| self.courses[place]);
        Course::ALL.into_iter().zip(own.into_iter().flatten()).filter(|entry| entry.1 > 0)
    }
}

/// One cell: its motions, the most frequent first.
#[derive(Clone, Debug, PartialEq)]
pub struct CellSummary {
    /// The cell.
    pub cell: usize,
    /// Its rows.
    pub rows: usize,
    /// The motions that its initial states lead to; never empty.
    pub motions: Vec<Motion>,
}

impl CellSummary {
    /// The summary of the rows of one cell, at least one.
    pub fn of(cell: usize, rows: &[Row]) -> Self {
        Self { cell, rows: rows.len(), motions: motions(rows) }
    }

    /// The motions by name with their shares, as diagrams take them: those that turn by their sense, where left and right differ.
    pub fn shares(&self) -> Vec<(String, f64)> {
        self.motions.iter().flat_map(|motion| motion.shares(self.rows)).collect()
    }
}

/// The initial states of one cell that lead to the same regime.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// The regime.
    pub regime: Regime,
    /// Number of initial states.
    pub rows: usize,
    /// Those that turn anticlockwise, and clockwise, where left and right differ.
    pub turning: [usize; 2],
    /// Their share of the cell, 0 to 1.
    pub share: f64,
    /// Median of each number over the rows that have it, as in [`NUMBERS`]; NaN if none has. Different motions are never
    /// averaged.
    pub medians: [f64; NUMBERS.len()],
    /// Why it is undetermined, if it is.
    pub reasons: Reasons,
}

/// The courses that are senses of turning.
pub(crate) const SENSES: [(Course, Hand); 2] =
    [(Course::Anticlockwise, Hand::Anticlockwise), (Course::Clockwise, Hand::Clockwise)];

/// The mark of a motion of this course.
pub fn motion_mark(regime: Regime, course: Option<Course>) -> RegimeMark {
    let hand = SENSES.into_iter().find(|(sense, _)| Some(*sense) == course).map(|(_, hand)| hand);
    turning_mark(regime.name(), hand)
}

impl Motion {
    /// Its name, or its names by sense, with their shares of these rows.
    fn shares(&self, of: usize) -> Vec<(String, f64)> {
        let [left, right] = self.turning;
        let rest = self.rows - left - right;
        let parts = [(Some(Course::Anticlockwise), left), (Some(Course::Clockwise), right), (None, rest)];
        let there = parts.into_iter().filter(|(_, rows)| *rows > 0);
        there
            .map(|(course, rows)| (motion_mark(self.regime, course).name.to_owned(), rows as f64 / of as f64))
            .collect()
    }

    /// The median of a number by its name in [`NUMBERS`]; `None` if it is not defined.
    pub fn median(&self, name: &str) -> Option<f64> {
        Some(self.medians[place(name)?]).filter(|value| !value.is_nan())
    }
}

/// The cells of a scan by their number, for drawing: `None` if a cell is not computed. Only here is one entry per cell in
/// memory.
///
/// # Errors
/// [`Error::Store`].
pub fn cells(folder: &ScanFolder) -> Result<Vec<Option<CellSummary>>, Error> {
    let mut all = vec![None; folder.plan().cells()];
    for_each_part(folder, |rows| {
        for rows in rows.chunk_by(|a, b| a.cell == b.cell) {
            let cell = rows[0].cell;
            if let Some(place) = all.get_mut(cell) {
                *place = Some(CellSummary::of(cell, rows));
            }
        }
    })?;
    Ok(all)
}

/// Passes the rows of each undamaged part to `use_rows`, in order; returns descriptions of the defects of the others.
///
/// # Errors
/// [`Error::Store`].
pub fn for_each_part(folder: &ScanFolder, mut use_rows: impl FnMut(&[Row])) -> Result<Vec<String>, Error> {
    let (plan, parts) = (folder.plan(), folder.parts());
    let mut damaged = Vec::new();
    for part in 0..plan.parts() {
        match parts.check(part) {
            Ok(_) => use_rows(&read_part(plan, &parts, part)?),
            Err(PartError::Missing) => {}
            Err(PartError::Damaged(how)) => damaged.push(how),
            Err(PartError::InTheWay(path)) => damaged.push(format!("{} is not a file", path.display())),
        }
    }
    Ok(damaged)
}

/// The motions of a cell's rows, the most frequent first, in the order of legends if equally frequent.
fn motions(rows: &[Row]) -> Vec<Motion> {
    let of = |regime| {
        let same: Vec<&Row> = rows.iter().filter(|row| row.regime == regime).collect();
        let medians = std::array::from_fn(|place| {
            let defined = same.iter().map(|row| row.numbers[place]).filter(|number| !number.is_nan());
            median(defined).unwrap_or(f64::NAN)
        });
        let mut reasons = Reasons::default();
        let undetermined = same.iter().filter(|row| row.regime == Regime::Undetermined);
        undetermined.for_each(|row| reasons.add(&row.why, 1));
        let turning = SENSES.map(|(sense, _)| same.iter().filter(|row| row.course == Some(sense)).count());
        let share = same.len() as f64 / rows.len() as f64;
        Motion { regime, rows: same.len(), turning, share, medians, reasons }
    };
    let mut motions: Vec<Motion> = Regime::ALL.into_iter().map(of).filter(|motion| motion.rows > 0).collect();
    motions.sort_by_key(|motion| std::cmp::Reverse(motion.rows)); // stable
    motions
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_analysis::regime::{Attractor, Verdict};

    fn row(sample: usize, regime: Regime, period: f64) -> Row {
        let verdict = Verdict::new(regime, Attractor::Unknown, String::new(), 1.0);
        Row::new(3, sample, Verdict { period: Some(period), ..verdict })
    }

    #[test]
    fn motions_are_counted_and_never_averaged_with_each_other() {
        let rows = [
            row(0, Regime::Zigzag, 4.0),
            row(1, Regime::Straight, f64::NAN),
            row(2, Regime::Zigzag, 7.0),
            row(3, Regime::Zigzag, 5.0),
        ];
        let found = motions(&rows);
        assert_eq!((found[0].regime, found[0].rows, found[0].share), (Regime::Zigzag, 3, 0.75));
        assert_eq!(found[0].median("period"), Some(5.0));
        assert_eq!(
            (found[1].regime, found[1].share, found[1].median("period")),
            (Regime::Straight, 0.25, None)
        );
        for regime in Regime::ALL {
            assert_eq!(motion_mark(regime, None).words, regime.words(), "figures and sentences");
        }
        let turned = |mut row: Row, course| {
            row.course = Some(course);
            row
        };
        let senses = [
            turned(row(0, Regime::Circular, f64::NAN), Course::Clockwise),
            turned(row(1, Regime::Circular, f64::NAN), Course::Anticlockwise),
            turned(row(2, Regime::Circular, f64::NAN), Course::Clockwise),
            turned(row(3, Regime::Zigzag, 1.0), Course::AlongField),
        ];
        let shares = CellSummary::of(3, &senses).shares();
        let expected = [("circular, anticlockwise", 0.25), ("circular, clockwise", 0.5), ("zigzag", 0.25)];
        assert_eq!(shares, expected.map(|(name, share)| (name.to_owned(), share)));
        let mut totals = Totals::default();
        totals.add(&rows);
        totals.add(&[row(0, Regime::BlowUp, 1.0), row(1, Regime::Undetermined, 1.0)]);
        assert_eq!((totals.cells, totals.rows, totals.multistable), (2, 6, 1));
        assert_eq!((totals.undetermined, totals.escaped), (1, 1));
    }
}
