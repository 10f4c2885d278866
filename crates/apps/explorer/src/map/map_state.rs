//! The visible window, and the computed rows of its plane.

use super::Job;
use super::lattice::{Cells, Lattice, level};
use super::shipped::Table;
use super::store::Store;
use crate::protocol::Side;
use motiform_lab::scan::{Axis, Row, ScanComputation};
use motiform_models::parameters::index_of;
use motiform_study::plan::check;
use motiform_study::{Error, RunPlan, ScanPlan, Study};
use std::ops::RangeInclusive;

/// Numbers of cells along an axis.
pub(super) const COUNTS: RangeInclusive<u16> = 8..=160;

/// No window reaches further, and no start lies further away.
pub(crate) const FARTHEST: f64 = 1e9;

/// The computed rows of a plane, and its visible window.
#[derive(Default)]
pub(crate) struct MapState {
    /// The plan without the values of its axes: while it stays, rows stay.
    plane: Option<ScanComputation>,
    lattices: Vec<Lattice>,
    pub(crate) store: Store,
    present: Option<Present>,
}

/// The window that is shown.
pub(crate) struct Present {
    pub(crate) epoch: u32,
    pub(crate) plan: ScanPlan,
    /// Along each axis.
    pub(crate) sides: Vec<Cells>,
}

impl Present {
    /// The number of cells along the axes; 1 for a missing axis.
    pub(crate) fn counts(&self) -> [usize; 2] {
        [0, 1].map(|axis| self.sides.get(axis).map_or(1, |side| side.values.len()))
    }

    /// The values of the axes in a cell; `None` outside.
    pub(crate) fn at(&self, i: usize, j: usize) -> Option<Vec<f64>> {
        let [columns, rows] = self.counts();
        (i < columns && j < rows).then(|| self.plan.axis_values(i + columns * j))
    }

    /// The cell at the parameters of a study; `None` outside.
    pub(crate) fn nearest(&self, study: &Study) -> Option<[u16; 2]> {
        let specs = study.info().ok()?.parameters();
        let values = study.values().ok()?;
        let mut place = [0; 2];
        for (axis, (side, along)) in self.sides.iter().zip(&self.plan.computation.axes).enumerate() {
            let parameter = specs.iter().position(|spec| spec.name == along.name);
            let start = || study.initial.iter().find(|(name, _)| *name == along.name).map(|entry| entry.1);
            let value = parameter.map(|place| values[place]).or_else(start)?;
            let number = ((value - side.values.first()?) / side.step).round();
            place[axis] = (0.0..side.values.len() as f64).contains(&number).then_some(number as u16)?;
        }
        Some(place)
    }

    /// The level of a cell.
    pub(crate) fn level(&self, i: usize, j: usize) -> u8 {
        let number = |side: &Cells, place: usize| side.first + i64::try_from(place).unwrap_or(0);
        let levels = self.sides.iter().zip([i, j]).map(|(side, place)| level(number(side, place)));
        levels.min().unwrap_or(0)
    }
}

impl MapState {
    /// The plan without the values of its axes.
    #[cfg(test)]
    pub(super) fn plane(&self) -> Option<&ScanComputation> {
        self.plane.as_ref()
    }

    pub(crate) fn present(&self) -> Option<&Present> {
        self.present.as_ref()
    }

    /// Switches to the window of a job. Computed rows are kept if the plane is the same. Those of a new one may be among `shipped`.
    pub(super) fn turn(&mut self, job: &Job, shipped: &[&str]) -> Result<(), Error> {
        let sides: Vec<&Side> = std::iter::once(&job.window.x).chain(&job.window.y).collect();
        let ranges = sides.iter().map(|side| Range::of(&job.study, side)).collect::<Result<Vec<_>, _>>()?;
        let count = job.window.count;
        check("count", f64::from(count), COUNTS.contains(&count), "give 8 to 160 cells along an axis")?;
        let plane = plane(&job.study, &sides)?;
        if self.plane.as_ref() != Some(&plane) {
            *self = Self::default();
            let mut window: Vec<[f64; 2]> = sides.iter().map(|side| [side.low, side.high]).collect();
            if let Some(table) = shipped.iter().find_map(|text| Table::read(text, &plane)) {
                table.rows.into_iter().for_each(|(at, row)| self.store.put(&at, row));
                window = table.window;
            }
            let lattice = |([low, high], range): (&[f64; 2], &Range)| Lattice::new(*low, *high, range.whole);
            self.lattices = window.iter().zip(&ranges).map(lattice).collect();
            self.plane = Some(plane);
        }
        let within = self.lattices.iter().zip(sides.iter().zip(&ranges));
        let cells: Vec<Cells> = within
            .map(|(lattice, (side, range))| {
                lattice.cells((side.low, side.high), usize::from(count), range.allowed)
            })
            .collect();
        let axes = sides.iter().zip(&cells).map(|(side, cells)| axis(side, cells.values.clone())).collect();
        let plan = ScanPlan::new(&of_map(&job.study, axes)?)?;
        self.store.begin();
        self.present = Some(Present { epoch: job.window.epoch, plan, sides: cells });
        Ok(())
    }

    /// The visible rows that are computed, by their cell; `None` before the first window.
    pub(super) fn rows(&mut self) -> Option<(ScanPlan, Vec<Row>)> {
        let plan = self.present.as_ref()?.plan.clone();
        let row = |cell| {
            let row = self.store.get(&plan.axis_values(cell))?;
            Some(Row { cell, ..row.clone() })
        };
        let rows = (0..plan.cells()).filter_map(row).collect();
        Some((plan, rows))
    }
}

fn axis(side: &Side, values: Vec<f64>) -> Axis {
    Axis { name: side.name.clone(), values }
}

/// The values that a side of a map may take.
struct Range {
    allowed: (f64, f64),
    whole: bool,
    /// A value that every model takes.
    typical: f64,
}

impl Range {
    /// That of a valid side: a parameter, or a coordinate of the start.
    fn of(study: &Study, side: &Side) -> Result<Self, Error> {
        let info = study.info()?;
        let varies_start = axis(side, Vec::new()).varies_start(info, &study.values()?)?;
        if !(side.low < side.high
            && side.low.abs().max(side.high.abs()) < FARTHEST
            && side.high - side.low > 1e-12)
        {
            let problem =
                format!("a window from {} to {} cannot be shown: zoom out, or go back", side.low, side.high);
            return Err(Error::Axis { text: side.name.clone(), problem });
        }
        if varies_start {
            return Ok(Self { allowed: (-FARTHEST, FARTHEST), whole: false, typical: 0.0 });
        }
        let spec = &info.parameters()[index_of(info.parameters(), info.name, &side.name)?];
        Ok(Self { allowed: spec.allowed, whole: spec.whole, typical: spec.default })
    }
}

/// The study of a map: one start for all cells, that of `motiform classify` with the same parameters.
fn of_map(study: &Study, axes: Vec<Axis>) -> Result<Study, Error> {
    let mut study = study.clone();
    study.run.silence();
    study.title = format!("Motions of the {} model", study.model); // a preset's is that of one motion
    let (info, values) = (study.info()?, study.values()?);
    let mut varies_start = false;
    for axis in &axes {
        varies_start |= axis.varies_start(info, &values)?;
    }
    // The number of modes decides which coordinates there are: each cell then draws its own. Where the start itself is on the axes, what is
    // not there must not depend on the window.
    if varies_start || study.initial.is_empty() && !axes.iter().any(|axis| axis.name == "modes") {
        study.scan.axes = Vec::new();
        let complete = if varies_start { study.perturbed()?.0 } else { study.clone() };
        study.initial = RunPlan::new(&complete)?.computation.initial.0;
    }
    study.scan.samples = 1;
    study.scan.axes = axes;
    Ok(study)
}

/// The plan of a map without its values.
fn plane(study: &Study, sides: &[&Side]) -> Result<ScanComputation, Error> {
    // The corners of a window may lie beyond what the model allows; its plane is the same.
    let mut study = study.clone();
    study.scan.axes = Vec::new();
    let axes: Vec<Axis> = sides.iter().map(|side| axis(side, vec![side.low, side.high])).collect();
    let mut bare = of_map(&study, axes)?;
    for (axis, side) in bare.scan.axes.iter_mut().zip(sides) {
        axis.values = vec![Range::of(&study, side)?.typical];
    }
    Ok(ScanPlan::new(&bare)?.computation)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use crate::protocol::MapWindow;
    use motiform_study::presets::find_any;

    /// Rows are kept while the plane stays: what they start from must not depend on the window that asked for them.
    #[test]
    fn starts_of_basins_do_not_depend_on_the_window() {
        for given in [&[][..], &[("u111", 0.3)]] {
            let mut study = find_any("fig4", "tensor").unwrap();
            for (name, value) in given {
                study.set_initial(name, *value).unwrap();
            }
            let side = |name: &str, low| Side { name: name.to_owned(), low, high: low + 2.0 };
            let mut map = MapState::default();
            let windows = [-1.0, 0.5, 40.0].map(|low| {
                let window =
                    MapWindow { epoch: 1, x: side("v1", low), y: Some(side("s11", -1.0)), count: 16 };
                map.turn(&Job { window, study: study.clone() }, &[]).unwrap();
                let mut computation = map.present().unwrap().plan.computation.clone();
                computation.axes.clear();
                (map.plane().unwrap().clone(), computation)
            });
            assert!(windows.iter().all(|window| *window == windows[0]));
            assert_eq!(windows[0].1.initial.0.len(), 4, "v2, s12, u111, u222");
        }
    }
}
