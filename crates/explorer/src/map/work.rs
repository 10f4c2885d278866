//! Computation of a window: coarse cells first, from the centre outwards, on all cores.

use super::map_state::MapState;
use super::{Done, Job};
use crate::answers::{Answers, Gone};
use crate::frames::{self, Cell};
use crate::protocol::{Dashes, Grid, Line, MapStart, Mapped, Progress};
use crate::worker::{Current, lock};
use motiform_analysis::regime::{Regime, Verdict};
use motiform_dynamics::Watch;
use motiform_figures::{BoundaryLine, LineStyle};
use motiform_lab::draw::boundary_lines;
use motiform_lab::scan::{Classify, Evaluate, Row};
use motiform_study::{Error, ScanPlan};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Between two messages with cells, and two with the progress.
const EVERY: (Duration, Duration) = (Duration::from_millis(40), Duration::from_millis(120));

/// Computes the missing cells of the window of a job, unless it becomes stale.
pub(super) fn compute(
    job: &Job,
    map_state: &Mutex<MapState>,
    current: &Current<'_>,
    answers: &Answers,
) -> Done {
    let mut seen = lock(map_state);
    if let Err(error) = seen.turn(job) {
        drop(seen);
        return answers.refused(None, &error.to_string());
    }
    let Some(view) = View::of(&mut seen, job.window.epoch) else { return Ok(()) };
    drop(seen);
    answers.say(view.announcement.clone())?;
    for known in view.known.chunks(4096) {
        answers.binary(frames::cells(view.epoch, known))?;
    }
    let work = Work {
        view: &view,
        map_state,
        current,
        answers,
        gone: AtomicBool::new(false),
        next: Mutex::new(view.wanted.iter()),
        out: Mutex::new(Out::new(view.known.len())),
    };
    let begun = Instant::now();
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    std::thread::scope(|scope| {
        for _ in 1..threads.min(view.wanted.len()) {
            scope.spawn(|| work.run());
        }
        work.run();
    });
    work.finish(begun)
}

/// The work for a window.
struct View {
    epoch: u32,
    plan: ScanPlan,
    announcement: MapStart,
    /// Cells that are known already, and those that are not: the coarsest first.
    known: Vec<Cell>,
    wanted: Vec<Cell>,
}

impl View {
    fn of(map_state: &mut MapState, epoch: u32) -> Option<Self> {
        let map = map_state.present()?;
        let [columns, rows] = map.counts();
        let side = |axis: usize| {
            let cells = map.sides.get(axis)?;
            Some(Grid {
                name: map.plan.computation.axes[axis].name.clone(),
                first: *cells.values.first()?,
                step: cells.step,
                count: cells.values.len(),
            })
        };
        let announcement = MapStart {
            epoch,
            x: side(0)?,
            y: side(1),
            lines: boundary_lines(&map.plan).iter().map(line).collect(),
        };
        let plan = map.plan.clone();
        let places = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
        let mut cells: Vec<Cell> = places
            .map(|(i, j)| {
                let place = [i, j].map(|k| u16::try_from(k).unwrap_or(u16::MAX));
                Cell { place, level: map.level(i, j), regime: 0, exponent: [f32::NAN; 2] }
            })
            .collect();
        let centre = [columns, rows].map(|count| 0.5 * (count as f64 - 1.0));
        let distance = |cell: &Cell| {
            let [x, y] = [0, 1].map(|axis| f64::from(cell.place[axis]) - centre[axis]);
            x * x + y * y
        };
        cells.sort_by(|a, b| b.level.cmp(&a.level).then(distance(a).total_cmp(&distance(b))));
        let (mut known, mut wanted) = (Vec::new(), Vec::new());
        for cell in cells {
            match map_state.store.get(&plan.axis_values(number(columns, &cell))) {
                Some(row) => known.push(told(cell, row)),
                None => wanted.push(cell),
            }
        }
        Some(Self { epoch, plan, announcement, known, wanted })
    }

    fn columns(&self) -> usize {
        self.plan.computation.axes.first().map_or(1, |axis| axis.values.len())
    }
}

/// The number of a cell in the plan.
fn number(columns: usize, cell: &Cell) -> usize {
    usize::from(cell.place[0]) + columns * usize::from(cell.place[1])
}

/// A cell with what its row says.
fn told(cell: Cell, row: &Row) -> Cell {
    let exponent = ["lambda_1", "lambda_1_error"].map(|name| row.number(name).unwrap_or(f64::NAN) as f32);
    Cell { regime: code(row.regime), exponent, ..cell }
}

/// Place in the list of regimes.
fn code(regime: Regime) -> u8 {
    Regime::ALL
        .iter()
        .position(|&known| known == regime)
        .and_then(|k| u8::try_from(k).ok())
        .unwrap_or(u8::MAX)
}

fn line(line: &BoundaryLine) -> Line {
    let style = match line.style {
        LineStyle::Solid => Dashes::Solid,
        LineStyle::Dashed => Dashes::Dashed,
        LineStyle::Dotted => Dashes::Dotted,
        LineStyle::DashDotted => Dashes::DashDotted,
        LineStyle::LongDashed => Dashes::LongDashed,
    };
    Line { label: line.label.clone(), style, points: line.points.clone() }
}

/// What the threads share.
struct Work<'w> {
    view: &'w View,
    map_state: &'w Mutex<MapState>,
    current: &'w Current<'w>,
    answers: &'w Answers,
    gone: AtomicBool,
    next: Mutex<std::slice::Iter<'w, Cell>>,
    out: Mutex<Out>,
}

/// Cells to be sent to the page.
struct Out {
    cells: Vec<Cell>,
    done: usize,
    computed: usize,
    sent: Instant,
    told: Instant,
    begun: Instant,
}

impl Out {
    fn new(known: usize) -> Self {
        let now = Instant::now();
        Self { cells: Vec::new(), done: known, computed: 0, sent: now, told: now, begun: now }
    }
}

impl Work<'_> {
    /// One thread: cells until none is left.
    fn run(&self) {
        let columns = self.view.columns();
        // The cells under way, by their number in the plan.
        let taken = std::cell::RefCell::new(std::collections::BTreeMap::new());
        let mut next = || {
            let cell = *lock(&self.next).next().filter(|_| !self.stopped())?;
            let number = number(columns, &cell);
            taken.borrow_mut().insert(number, cell);
            Some((number, 0))
        };
        let mut done = |(number, _): (usize, usize), verdict: Result<Option<Verdict>, Error>| {
            let Some(cell) = taken.borrow_mut().remove(&number) else { return };
            if self.put(cell, verdict).is_err() {
                self.gone.store(true, Ordering::Relaxed);
            }
        };
        Classify.evaluate_all(&self.view.plan, &mut next, &mut done, self);
    }

    fn put(&self, cell: Cell, verdict: Result<Option<Verdict>, Error>) -> Done {
        let number = number(self.view.columns(), &cell);
        let Some(row) = Row::of_evaluation(number, 0, verdict) else { return Ok(()) };
        let cell = told(cell, &row);
        lock(self.map_state).store.put(&self.view.plan.axis_values(number), row);
        let mut out = lock(&self.out);
        out.cells.push(cell);
        out.done += 1;
        out.computed += 1;
        if out.sent.elapsed() < EVERY.0 {
            return Ok(());
        }
        out.sent = Instant::now();
        let cells = std::mem::take(&mut out.cells);
        self.answers.binary(frames::cells(self.view.epoch, &cells))?;
        if out.told.elapsed() < EVERY.1 {
            return Ok(());
        }
        out.told = Instant::now();
        self.answers.say(self.progress(&out))
    }

    fn progress(&self, out: &Out) -> Progress {
        let total = self.view.known.len() + self.view.wanted.len();
        let rate = out.computed as f64 / out.begun.elapsed().as_secs_f64().max(1e-3);
        Progress { epoch: self.view.epoch, done: out.done, total, rate }
    }

    /// Sends the remaining cells, and the message of completion if the map is complete.
    fn finish(self, begun: Instant) -> Done {
        let stopped = self.stopped();
        let out = self.out.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
        if self.gone.into_inner() {
            return Err(Gone);
        }
        if stopped {
            return Ok(()); // the request that made it stale reports the end
        }
        self.answers.binary(frames::cells(self.view.epoch, &out.cells))?;
        let seconds = begun.elapsed().as_secs_f64();
        self.answers.say(Mapped { epoch: self.view.epoch, cells: out.done, seconds })
    }
}

impl Watch for Work<'_> {
    fn stopped(&self) -> bool {
        self.gone.load(Ordering::Relaxed) || self.current.stopped()
    }
}
