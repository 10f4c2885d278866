//! The lines across the boundaries that have no name yet, the longest first.

use crate::atlas::boundary::{Atlas, Edge, Pair, differing, edges, pieces};
use crate::atlas::folder::parsed;
use crate::atlas::grid::Grid;
use crate::atlas::line::{Course, Line, Task, course, read_line};
use crate::atlas::survey::{Begins, Stage};
use motiform_analysis::Regime;
use motiform_dynamics::{StopOnly, Watch};
use motiform_lab::pool::each;
use motiform_store::Journal;
use motiform_study::AtlasPlan;
use motiform_study::branches::FOLLOWED;
use motiform_study::{Error, ScanPlan};
use std::path::Path;

/// Lines that are followed at the same time, whatever the number of threads: the numbers do not depend on it.
const TOGETHER: usize = 2;

/// A boundary between the same motions is left after so many lines that named nothing of it.
const VAIN: usize = 3;

/// A curve is followed where it begins within so many cells of a boundary without a name.
const CLOSE: f64 = 2.5;

/// A shorter piece of a boundary is left, such as one around a single cell, which has four edges: few initial states and windows in chaos
/// make such cells.
const SHORTEST: usize = 5;

/// Follows lines across the boundaries of a grid; `None` if the watch stopped it: what is finished is in the journal. The progress is
/// the part of the boundaries that has a name: no measure of the time that is left, as `begins` is told.
///
/// # Errors
/// Those of the journal, and of the models.
pub fn trace(
    plan: &AtlasPlan,
    grid: &Grid,
    threads: usize,
    journal: &dyn Journal,
    watch: &dyn Watch,
    begins: Begins<'_>,
) -> Result<Option<Vec<Line>>, Error> {
    let scan = plan.scan();
    let labels = grid.labels();
    let all = edges(grid, &labels);
    let mut work = Tracer { plan, scan: &scan, grid, labels: &labels, lines: Vec::new(), vain: Vec::new() };
    let name = format!("bifurcations at the boundaries (at most {} lines)", plan.computation.lines);
    begins(&Stage { name, share: [0.0, 1.0], even: false });
    for round in 0.. {
        let open = work.open(&all);
        watch.progress(1.0 - open.len() as f64 / all.len().max(1) as f64);
        let tasks = work.tasks(&open);
        if tasks.is_empty() {
            break;
        }
        let item = format!("lines-{round}.json");
        let kept = journal.finished(&item).and_then(|bytes| parsed::<Vec<Line>>(&bytes));
        let fits = |lines: &Vec<Line>| {
            lines
                .iter()
                .map(|line| (line.start, line.side))
                .eq(tasks.iter().map(|task| (task.1.start, task.1.side)))
        };
        let lines = match kept.filter(fits) {
            Some(lines) => lines,
            None => {
                let Some(lines) = work.follow(&tasks, &open, threads, watch)? else { return Ok(None) };
                let content = serde_json::to_vec(&lines)
                    .map_err(|error| Error::write_failed(Path::new(&item), error))?;
                journal.finish(&item, &content)?;
                lines
            }
        };
        work.lines.extend(lines);
        let after = work.open(&all);
        for (pair, _) in tasks {
            let count = |open: &[Edge]| open.iter().filter(|edge| work.pair(**edge) == pair).count();
            if count(&after) == count(&open) {
                work.vain.push(pair);
            }
        }
    }
    Ok(Some(work.lines))
}

struct Tracer<'w> {
    plan: &'w AtlasPlan,
    scan: &'w ScanPlan,
    grid: &'w Grid,
    labels: &'w [Vec<Regime>],
    lines: Vec<Line>,
    /// A boundary for each line that named nothing of it.
    vain: Vec<Pair>,
}

impl Tracer<'_> {
    fn pair(&self, edge: Edge) -> Pair {
        pieces(self.grid, self.labels, &[edge]).swap_remove(0).0
    }

    /// The edges without a name.
    fn open(&self, all: &[Edge]) -> Vec<Edge> {
        let known = Atlas::of(self.plan, self.grid, &self.lines);
        let is_open = |edge: &Edge| known.name(self.grid, self.labels, *edge).is_none();
        all.iter().copied().filter(is_open).collect()
    }

    /// The next lines, across the longest pieces that have no name, each with the motions that it parts.
    fn tasks(&self, open: &[Edge]) -> Vec<(Pair, Task)> {
        let left = self.plan.computation.lines.saturating_sub(self.lines.len());
        let mut tasks: Vec<(Pair, Task)> = Vec::new();
        for (pair, piece) in pieces(self.grid, self.labels, open) {
            let vain = self.vain.iter().filter(|known| **known == pair).count();
            let is_new = tasks.iter().all(|other| other.0 != pair);
            if piece.len() >= SHORTEST && vain < VAIN && is_new {
                tasks.extend(self.task(&pair, &piece).map(|task| (pair, task)));
            }
            if tasks.len() >= TOGETHER.min(left) {
                break;
            }
        }
        tasks.truncate(left);
        tasks
    }

    /// A line through the middle of a piece from a motion that one side of it has alone: steady motions first. None was followed before.
    fn task(&self, pair: &Pair, piece: &[Edge]) -> Option<Task> {
        let centres: Vec<[f64; 2]> = piece.iter().map(|edge| edge.centre(self.grid)).collect();
        let mean = [0, 1].map(|side| centres.iter().map(|at| at[side]).sum::<f64>() / centres.len() as f64);
        let off = |edge: &Edge| {
            let [x, y] = edge.centre(self.grid);
            (x - mean[0]).hypot(y - mean[1])
        };
        let motions = differing(pair);
        let of = |motion: Regime| {
            let tasks = piece.iter().flat_map(|edge| {
                edge.cells.into_iter().filter_map(move |cell| {
                    let place = &self.grid.places[cell];
                    let sample = place.motion(motion).filter(|_| place.like.is_none())?.sample;
                    Some((off(edge), Task { start: (cell, sample), side: edge.side, motion }))
                })
            });
            tasks.filter(|(_, task)| !self.tried(*task)).min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let mut followed = FOLLOWED.into_iter().filter(|regime| motions.contains(regime));
        followed.find_map(of).map(|found| found.1)
    }

    /// Returns `true` if the line was followed before.
    fn tried(&self, task: Task) -> bool {
        self.lines.iter().any(|line| line.start == task.start && line.side == task.side)
    }

    /// Follows lines: the branches of all at the same time, then curve by curve.
    fn follow(
        &self,
        tasks: &[(Pair, Task)],
        open: &[Edge],
        threads: usize,
        watch: &dyn Watch,
    ) -> Result<Option<Vec<Line>>, Error> {
        let courses: Vec<Course> = match each(tasks, threads.min(TOGETHER), watch, |(_, task)| {
            course(self.plan, self.scan, *task, &StopOnly(watch))
        }) {
            Err(Error::Interrupted) => return Ok(None),
            courses => courses?,
        };
        // a curve is followed where a motion that only one side has may end on it
        let bounds = |at: [f64; 2], motion: Regime| {
            let [x, y] = self.grid.units(self.plan, at);
            open.iter().any(|edge| {
                let [i, j] = edge.centre(self.grid);
                (x - i).hypot(y - j) <= CLOSE && differing(&self.pair(*edge)).contains(&motion)
            })
        };
        let mut lines: Vec<Line> = Vec::new();
        for ((_, task), course) in tasks.iter().zip(courses) {
            let Some(course) = course else { return Ok(None) };
            let known: Vec<Line> = self.lines.iter().chain(&lines).cloned().collect();
            let Some(line) = read_line(
                self.scan,
                self.plan.computation.line_steps,
                *task,
                course,
                &known,
                &bounds,
                &StopOnly(watch),
            )?
            else {
                return Ok(None);
            };
            lines.push(line);
        }
        Ok(Some(lines))
    }
}
