//! Rows compared with those of a file while they are computed: in memory that does not grow with their number.

use crate::recorder::Rows;
use motiform_store::read_groups;
use motiform_store::table::Table;
use motiform_study::Error;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, sync_channel};
use std::thread::Scope;

/// Rows that are computed before they are compared.
const BLOCK: usize = 1024;

/// The rows of a run that is repeated.
pub(super) struct Compared<'c> {
    /// Begins to read the file.
    open: &'c dyn Fn() -> Groups,
    groups: Groups,
    /// Rows of the file that are compared next.
    there: Table,
    at: usize,
    /// Rows that are computed.
    again: Table,
    /// Rows that are compared, at most; the run then ends.
    most: usize,
    enough: &'c AtomicBool,
    pub(super) rows: usize,
    /// The first difference of each column.
    different: BTreeMap<String, String>,
}

/// The groups of rows of a file, in turn.
pub(super) type Groups = Receiver<Result<Table, Error>>;

/// Reads a file on a thread of its own, one group ahead.
pub(super) fn groups<'s>(scope: &'s Scope<'s, '_>, path: &'s Path) -> Groups {
    let (sender, groups) = sync_channel(1);
    scope.spawn(move || {
        // A receiver that has gone needs no more: that ends the reading.
        let mut send = |group| sender.send(Ok(group)).map_err(|_| Error::Interrupted);
        if let Err(error) = read_groups(path, &mut send) {
            let _ = sender.send(Err(error));
        }
    });
    groups
}

impl<'c> Compared<'c> {
    /// At most `most` rows; `columns` is the table of the run without rows. `enough` becomes true when they are compared.
    pub(super) fn new(
        open: &'c dyn Fn() -> Groups,
        columns: Table,
        most: usize,
        enough: &'c AtomicBool,
    ) -> Self {
        let groups = open();
        let (there, different) = (Table::default(), BTreeMap::new());
        Self { open, groups, there, at: 0, again: columns, most, enough, rows: 0, different }
    }

    /// Compares the rows that are left; whether the file has more of them.
    pub(super) fn finish(&mut self) -> Result<bool, Error> {
        self.compare()?;
        self.more()
    }

    /// The first difference of each column.
    pub(super) fn different(self) -> Vec<String> {
        self.different.into_values().collect()
    }

    /// Returns `true` if the file has a row that is not compared yet.
    fn more(&mut self) -> Result<bool, Error> {
        while self.at == self.there.rows() {
            let Ok(group) = self.groups.recv() else { return Ok(false) };
            (self.there, self.at) = (group?, 0);
        }
        Ok(true)
    }

    fn compare(&mut self) -> Result<(), Error> {
        let mut row = 0;
        while row < self.again.rows() && self.rows < self.most && self.more()? {
            let count = (self.again.rows() - row).min(self.there.rows() - self.at).min(self.most - self.rows);
            let (first, at) = (self.rows, self.at);
            for column in &self.again.columns {
                let values = self.there.get(&column.name).unwrap_or(&[]);
                let (a, b) = (&values[at.min(values.len())..], &column.values[row..row + count]);
                if !self.different.contains_key(&column.name)
                    && let Some(found) = difference(&column.name, first, a, b)
                {
                    self.different.insert(column.name.clone(), found);
                }
            }
            (row, self.at, self.rows) = (row + count, at + count, first + count);
        }
        if row < self.again.rows() || self.rows == self.most {
            self.enough.store(true, Ordering::Relaxed);
        }
        self.again.columns.iter_mut().for_each(|column| column.values.clear());
        Ok(())
    }
}

/// The first difference of two columns that begin at row `first`.
pub(super) fn difference(name: &str, first: usize, there: &[f64], again: &[f64]) -> Option<String> {
    let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
    let row = (0..again.len()).find(|&row| !there.get(row).is_some_and(|a| same(*a, again[row])))?;
    let there = there.get(row).map_or("nothing".to_owned(), |a| format!("{a:?}"));
    Some(format!("row {}, {name}: {there} there, {:?} computed again", first + row, again[row]))
}

impl Rows for Compared<'_> {
    fn table(&mut self) -> &mut Table {
        &mut self.again
    }

    fn advance(&mut self) -> Result<(), Error> {
        if self.again.rows() < BLOCK { Ok(()) } else { self.compare() }
    }

    fn restart(&mut self) -> Result<(), Error> {
        self.again.columns.iter_mut().for_each(|column| column.values.clear());
        (self.groups, self.there, self.at) = ((self.open)(), Table::default(), 0);
        self.enough.store(false, Ordering::Relaxed);
        (self.rows, self.different) = (0, BTreeMap::new());
        Ok(())
    }
}
