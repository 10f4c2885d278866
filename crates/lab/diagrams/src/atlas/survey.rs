//! The motions of all cells: a coarse grid first, then finer ones where neighbours differ.

use crate::atlas::folder::parsed;
use crate::atlas::grid::{Found, Grid, NUMBERS, Place};
use motiform_analysis::{Course, Regime};
use motiform_dynamics::{Part, Watch};
use motiform_lab::scan::{CellSummary, Classify, Row, rows_at};
use motiform_store::Journal;
use motiform_study::AtlasPlan;
use motiform_study::{Error, ScanPlan};
use std::path::Path;

/// Distances between the cells of the grids, in cells of the finest one.
const STRIDES: [usize; 3] = [4, 2, 1];

/// Cells that are computed and kept together: a kill costs these at most.
const TOGETHER: usize = 192;

/// Called where a stage begins.
pub type Begins<'a> = &'a dyn Fn(&Stage);

/// A stage of the work on an atlas.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// Its name.
    pub name: String,
    /// Its part of the progress of the call that it belongs to.
    pub share: [f64; 2],
    /// `true` if equal parts of its progress take about equal times.
    pub even: bool,
}

/// Names of the stages of [`survey()`], one for each of [`STRIDES`].
const NAMES: [&str; 3] =
    ["coarse grid", "finer grid where motions differ", "finest grid where motions differ"];

/// Classifies the cells of a plan; `None` if the watch stopped it: what is finished is in the journal. `begins` is told each stage.
///
/// # Errors
/// Those of the journal, and of the models.
pub fn survey(
    plan: &AtlasPlan,
    threads: usize,
    journal: &dyn Journal,
    watch: &dyn Watch,
    begins: Begins<'_>,
) -> Result<Option<Grid>, Error> {
    let scan = plan.scan();
    let size = [0, 1].map(|side| scan.computation.axes[side].values.len());
    let mut work = Surveyor { scan: &scan, size, places: vec![None; scan.cells()], threads, journal };
    for (level, stride) in STRIDES.into_iter().enumerate() {
        let share = |level: usize| level as f64 / STRIDES.len() as f64;
        let part = Part { watch, from: share(level), to: share(level + 1) };
        let wanted = work.wanted(level, stride);
        let name = format!("{} cells of the {}", wanted.len(), NAMES[level]);
        begins(&Stage { name, share: [share(level), share(level + 1)], even: true });
        if !work.compute(level, &wanted, &part)? {
            return Ok(None);
        }
    }
    let places: Option<Vec<Place>> = work.places.into_iter().collect();
    Ok(places.map(|places| Grid { size, places }))
}

struct Surveyor<'w> {
    scan: &'w ScanPlan,
    size: [usize; 2],
    places: Vec<Option<Place>>,
    threads: usize,
    journal: &'w dyn Journal,
}

impl Surveyor<'_> {
    /// The cells of a grid that must be computed, rising; the others get the motions of the cells around them, which are the same.
    fn wanted(&mut self, level: usize, stride: usize) -> Vec<usize> {
        let [across, upwards] = self.size.map(|count| ticks(count, stride));
        let mut wanted = Vec::new();
        let mut taken = Vec::new();
        for (j, i) in upwards.iter().flat_map(|j| across.iter().map(move |i| (*j, *i))) {
            let cell = i + self.size[0] * j;
            if self.places[cell].is_some() {
                continue;
            }
            match self.like([i, j], 2 * stride).filter(|_| level > 0) {
                Some(like) => taken.push((cell, like)),
                None => wanted.push(cell),
            }
        }
        for (cell, place) in taken {
            self.places[cell] = Some(place);
        }
        wanted
    }

    /// The motions that all cells of the coarser grid around a place have.
    fn like(&self, at: [usize; 2], stride: usize) -> Option<Place> {
        let [columns, rows] = [0, 1].map(|side| enclosing(at[side], self.size[side], stride));
        let corners = rows.iter().flat_map(|j| columns.iter().map(move |i| i + self.size[0] * j));
        let mut found: Vec<(usize, &Place)> = Vec::new();
        for cell in corners {
            found.push((cell, self.places[cell].as_ref()?));
        }
        let (first, place) = *found.first()?;
        let same = found.iter().all(|other| other.1.label() == place.label());
        let like = Some(place.like.unwrap_or(first));
        same.then(|| Place { motions: place.motions.clone(), like })
    }

    /// Computes cells, group by group. Whether it came to the end.
    fn compute(&mut self, level: usize, cells: &[usize], watch: &dyn Watch) -> Result<bool, Error> {
        for (number, group) in cells.chunks(TOGETHER).enumerate() {
            let item = format!("cells-{level}-{number}.json");
            let share = |done: usize| (done * TOGETHER).min(cells.len()) as f64 / cells.len() as f64;
            let part = Part { watch, from: share(number), to: share(number + 1) };
            let kept = self.journal.finished(&item).and_then(|bytes| read(&bytes, group));
            let places = match kept {
                Some(places) => places,
                None => {
                    let rows = rows_at(self.scan, group, self.threads, &Classify, &part)?;
                    let Some(rows) = rows else { return Ok(false) };
                    let places: Vec<(usize, Place)> =
                        rows.chunk_by(|a, b| a.cell == b.cell).map(place).collect();
                    let content = serde_json::to_vec(&places)
                        .map_err(|error| Error::write_failed(Path::new(&item), error))?;
                    self.journal.finish(&item, &content)?;
                    places
                }
            };
            for (cell, place) in places {
                self.places[cell] = Some(place);
            }
            part.progress(1.0);
        }
        Ok(true)
    }
}

/// The kept items of these cells.
fn read(bytes: &[u8], cells: &[usize]) -> Option<Vec<(usize, Place)>> {
    let places: Vec<(usize, Place)> = parsed(bytes)?;
    places.iter().map(|entry| entry.0).eq(cells.iter().copied()).then_some(places)
}

/// A cell with its number, from its rows.
pub(crate) fn place(rows: &[Row]) -> (usize, Place) {
    let cell = rows.first().map_or(0, |row| row.cell);
    let found = CellSummary::of(cell, rows).motions.into_iter().map(|motion| Found {
        regime: motion.regime,
        rows: motion.rows,
        sample: rows.iter().find(|row| row.regime == motion.regime).map_or(0, |row| row.sample),
        numbers: NUMBERS.map(|quantity| motion.median(quantity.name).filter(|value| value.is_finite())),
        courses: courses(rows, motion.regime),
    });
    (cell, Place { motions: found.collect(), like: None })
}

/// The directions of a motion in these rows, each once.
fn courses(rows: &[Row], regime: Regime) -> Vec<Course> {
    let has = |course: &Course| rows.iter().any(|row| row.regime == regime && row.course == Some(*course));
    Course::ALL.into_iter().filter(has).collect()
}

/// The places of a grid along an axis: both ends among them.
fn ticks(count: usize, stride: usize) -> Vec<usize> {
    let mut all: Vec<usize> = (0..count).step_by(stride).collect();
    if all.last().is_some_and(|last| last + 1 < count) {
        all.push(count - 1);
    }
    all
}

/// The places of a grid on both sides of one place, or that place alone if it is on the grid.
fn enclosing(at: usize, count: usize, stride: usize) -> Vec<usize> {
    let all = ticks(count, stride);
    let place = all.partition_point(|tick| *tick < at);
    if all.get(place) == Some(&at) { vec![at] } else { all[place.saturating_sub(1)..=place].to_vec() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_hold_both_ends_and_enclose_every_place() {
        assert_eq!(ticks(9, 4), [0, 4, 8]);
        assert_eq!(ticks(11, 4), [0, 4, 8, 10]);
        assert_eq!(ticks(1, 4), [0]);
        assert_eq!(enclosing(4, 11, 4), [4]);
        assert_eq!(enclosing(9, 11, 4), [8, 10]);
        assert_eq!(enclosing(1, 11, 4), [0, 4]);
    }
}
