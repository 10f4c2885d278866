//! Trajectories of any length: what is drawn of them is read a group of rows at a time.

use motiform_store::table::Table;
use motiform_store::{GROUP_ROWS, read_groups};
use motiform_study::{Error, Manifest};
use std::ops::Range;
use std::path::Path;

/// Rows that are drawn of a long trajectory, at most: more than a figure has points across.
const DRAWN: usize = 1 << 16;

/// Reads the rows of a trajectory that figures are drawn from, and how many rows each stands for: all of a trajectory with fewer rows
/// than a group of a file; of a longer one every second, fourth, .. row of the shown window, at least half of 65,536. The sampling
/// interval of the manifest's plan becomes that of these rows.
///
/// # Errors
/// [`Error::Store`].
///
/// # Checked by  the tests below: windows and strides, on both sides of the number
pub fn read_shown(manifest: &mut Manifest, path: &Path) -> Result<(Table, u32), Error> {
    let figure = &manifest.plan.figure;
    let mut shown = Shown { window: [figure.from, figure.to], most: [GROUP_ROWS, DRAWN], ..Shown::default() };
    read_groups(path, &mut |group| -> Result<(), Error> {
        shown.take(group);
        Ok(())
    })?;
    let stride = shown.stride();
    manifest.plan.computation.dt_out *= f64::from(stride);
    Ok((shown.table, stride))
}

/// Rows that stand for all.
#[derive(Default)]
struct Shown {
    /// As in the settings of figures: a second number of 0 is the end.
    window: [f64; 2],
    /// Fewer rows than this are kept all; of more, so many.
    most: [usize; 2],
    table: Table,
    /// Halvings so far; `None` while all rows are here.
    halved: Option<u32>,
    /// Rows of the window that came.
    seen: usize,
}

impl Shown {
    fn stride(&self) -> u32 {
        1 << self.halved.unwrap_or(0)
    }

    fn take(&mut self, group: Table) {
        if self.halved.is_none() && self.table.rows() + group.rows() < self.most[0] {
            if self.table.columns.is_empty() {
                self.table = group;
            } else {
                self.append(&group, 0..group.rows());
            }
            return;
        }
        if self.halved.is_none() {
            self.halved = Some(0);
            let all = std::mem::take(&mut self.table);
            group
                .columns
                .iter()
                .for_each(|column| self.table.push(&column.name, column.meaning.clone(), Vec::new()));
            self.keep(&all);
        }
        self.keep(&group);
    }

    /// Appends those of these rows that are shown.
    fn keep(&mut self, group: &Table) {
        let times = group.get("t").unwrap_or(&[]);
        let [from, to] = self.window;
        let inside = |t: f64| t >= from && (to == 0.0 || t <= to);
        for (row, _) in times.iter().enumerate().filter(|(_, t)| inside(**t)) {
            if self.seen.is_multiple_of(self.stride() as usize) {
                self.append(group, row..row + 1);
            }
            self.seen += 1;
            if self.table.rows() > self.most[1] {
                self.halve();
            }
        }
    }

    fn append(&mut self, group: &Table, rows: Range<usize>) {
        for (column, more) in self.table.columns.iter_mut().zip(&group.columns) {
            column.values.extend_from_slice(&more.values[rows.clone()]);
        }
    }

    fn halve(&mut self) {
        for column in &mut self.table.columns {
            let mut row = 0;
            column.values.retain(|_| {
                row += 1;
                row % 2 == 1
            });
        }
        self.halved = self.halved.map(|halved| halved + 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The times that are shown of `rows` rows at 0, 1, 2, .. in groups of 3, all of 8, and 6 of more.
    fn shown(rows: usize, window: [f64; 2]) -> (Vec<f64>, u32) {
        let mut shown = Shown { window, most: [9, 6], ..Shown::default() };
        let all: Vec<f64> = (0..rows).map(|row| row as f64).collect();
        for group in all.chunks(3) {
            let mut table = Table::default();
            table.push("t", "", group.to_vec());
            table.push("x", "", group.iter().map(|t| -t).collect());
            shown.take(table);
        }
        let stride = shown.stride();
        let times = shown.table.get("t").unwrap_or(&[]).to_vec();
        assert!(shown.table.get("x").unwrap_or(&[]).iter().zip(&times).all(|(x, t)| *x == -t));
        (times, stride)
    }

    #[test]
    fn short_ones_are_whole_and_long_ones_are_thinned() {
        assert_eq!(shown(8, [0.0, 0.0]).0.len(), 8);
        assert_eq!(shown(8, [3.0, 4.0]).0.len(), 8, "the window is that of the figures");
        assert_eq!(shown(9, [0.0, 0.0]), (vec![0.0, 2.0, 4.0, 6.0, 8.0], 2));
        assert_eq!(shown(12, [0.0, 0.0]), ((0..6).map(|k| 2.0 * f64::from(k)).collect(), 2));
        assert_eq!(shown(13, [0.0, 0.0]), (vec![0.0, 4.0, 8.0, 12.0], 4));
        assert_eq!(shown(100, [94.0, 0.0]), ((94..100).map(f64::from).collect(), 1));
        assert_eq!(shown(100, [10.0, 19.0]), (vec![10.0, 12.0, 14.0, 16.0, 18.0], 2));
        assert_eq!(shown(0, [0.0, 0.0]).0.len(), 0);
    }
}
