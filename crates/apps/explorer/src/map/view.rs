//! The cells of a window: known, and to be computed.

use super::map_state::MapState;
use super::{Done, Job};
use crate::answers::Answers;
use crate::frames::{self, Cell};
use crate::protocol::{Dashes, Grid, Line, MapStart};
use motiform_analysis::regime::Regime;
use motiform_figures::{ExpectedLine, LineStyle, REGIMES};
use motiform_lab::draw::boundary_lines;
use motiform_lab::scan::{Row, motion_mark};
use motiform_study::ScanPlan;

/// The work for a window.
pub(super) struct View {
    pub(super) epoch: u32,
    pub(super) plan: ScanPlan,
    announcement: MapStart,
    /// Cells that are known already, and those that are not: the coarsest first.
    pub(super) known: Vec<Cell>,
    pub(super) wanted: Vec<Cell>,
}

impl View {
    /// The window of a job; `None` before the first one.
    pub(super) fn of(map_state: &mut MapState, job: &Job) -> Option<Self> {
        let epoch = job.window.epoch;
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
        // Those about the body come first: its mark lies on its own motion, not on a coarse cell's.
        let body = map.nearest(&job.study);
        let apart = |cell: &Cell| {
            body.is_none_or(|body| (0..2).any(|axis| cell.place[axis].abs_diff(body[axis]) > 1))
        };
        cells.sort_by(|a, b| {
            let finer = apart(a).cmp(&apart(b)).then(b.level.cmp(&a.level));
            finer.then(distance(a).total_cmp(&distance(b)))
        });
        let (mut known, mut wanted) = (Vec::new(), Vec::new());
        for cell in cells {
            match map_state.store.get(&plan.axis_values(number(columns, &cell))) {
                Some(row) => known.push(told(cell, row)),
                None => wanted.push(cell),
            }
        }
        Some(Self { epoch, plan, announcement, known, wanted })
    }

    /// Announces the map, and sends what is known of it.
    pub(super) fn announce(&self, answers: &Answers) -> Done {
        answers.say(self.announcement.clone())?;
        for known in self.known.chunks(4096) {
            answers.binary(frames::cells(self.epoch, known))?;
        }
        Ok(())
    }

    /// The number of a cell in the plan.
    pub(super) fn number(&self, cell: &Cell) -> usize {
        number(self.columns(), cell)
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
pub(super) fn told(cell: Cell, row: &Row) -> Cell {
    let exponent = ["lambda_1", "lambda_1_error"].map(|name| row.number(name).unwrap_or(f64::NAN) as f32);
    Cell { regime: code(row), exponent, ..cell }
}

/// Place in the list of regimes, and after these in that of regimes by sense.
fn code(row: &Row) -> u8 {
    let mark = motion_mark(row.regime, row.course);
    let place = match mark.hand {
        None => Regime::ALL.iter().position(|&known| known == row.regime),
        Some(_) => {
            let mut turning = REGIMES.iter().filter(|known| known.hand.is_some());
            turning.position(|known| known.name == mark.name).map(|place| place + Regime::ALL.len())
        }
    };
    place.and_then(|place| u8::try_from(place).ok()).unwrap_or(u8::MAX)
}

fn line(line: &ExpectedLine) -> Line {
    let style = match line.style {
        LineStyle::Solid => Dashes::Solid,
        LineStyle::Dashed => Dashes::Dashed,
        LineStyle::Dotted => Dashes::Dotted,
        LineStyle::DashDotted => Dashes::DashDotted,
        LineStyle::LongDashed => Dashes::LongDashed,
    };
    Line { label: line.label.clone(), style, points: line.points.clone() }
}
