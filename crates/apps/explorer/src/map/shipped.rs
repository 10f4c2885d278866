//! Coarse maps that come with the program: those of Figs. 1, 4 and 6, shown at once while finer cells are computed.
//!
//! A file of `crates/apps/explorer/maps/` has a line of JSON with plane and window, then a line for each cell. They are what the program
//! computes, to the bit: a test computes them all. `MOTIFORM_UPDATE=1 cargo test --release --workspace --lib shipped` writes them.

use motiform_analysis::regime::{Attractor, Regime};
use motiform_lab::scan::{NUMBERS, Row};
use motiform_study::scan::ScanComputation;
use serde::{Deserialize, Serialize};

/// The files.
pub(super) const TABLES: [&str; 3] = [
    include_str!("../../maps/fig1.jsonl"),
    include_str!("../../maps/fig4.jsonl"),
    include_str!("../../maps/fig6a.jsonl"),
];

/// The first line of a file.
#[derive(Deserialize, Serialize)]
struct Head {
    plane: ScanComputation,
    /// Of its lattice, along each axis.
    window: Vec<[f64; 2]>,
}

/// A line of a file: values on the axes, motion, kind of attractor, [`NUMBERS`] (null where there is none), evidence.
#[derive(Deserialize, Serialize)]
struct Line(Vec<f64>, Regime, Attractor, Vec<Option<f64>>, String);

/// The computed rows of a plane, by the values on its axes.
pub(super) struct Table {
    pub(super) window: Vec<[f64; 2]>,
    pub(super) rows: Vec<(Vec<f64>, Row)>,
}

impl Table {
    /// The table in a file; `None` if the file is that of another plane.
    pub(super) fn read(text: &str, plane: &ScanComputation) -> Option<Self> {
        let mut lines = text.lines();
        let head: Head = serde_json::from_str(lines.next()?).ok()?;
        if head.plane != *plane {
            return None;
        }
        let rows =
            lines.map(|line| serde_json::from_slice(line.as_bytes()).ok().map(row)).collect::<Option<_>>()?;
        Some(Self { window: head.window, rows })
    }
}

fn row(Line(at, regime, attractor, known, why): Line) -> (Vec<f64>, Row) {
    let mut numbers = [f64::NAN; NUMBERS.len()];
    for (number, known) in numbers.iter_mut().zip(known) {
        *number = known.unwrap_or(f64::NAN);
    }
    // the paper's models have all symmetries: no motion has a course
    (at, Row { cell: 0, sample: 0, regime, attractor, course: None, numbers, why })
}

#[cfg(test)]
mod tests {
    use super::super::map_state::{COUNTS, MapState};
    use super::*;
    use crate::map::Job;
    use crate::protocol::{MapWindow, Side};
    use crate::task::lock;
    use motiform_lab::scan::{Classify, Evaluate as _};
    use motiform_study::presets;
    use std::path::Path;
    use std::sync::Mutex;

    /// The presets, and the number of cells along an axis.
    const OF: [(&str, u16); 3] = [("fig1", 16), ("fig4", 16), ("fig6a", 64)];

    fn job(preset: &str, count: u16) -> Job {
        let study = presets::find_any(preset, "tensor").unwrap();
        let side = |k: usize| {
            let axis = study.display.plane.get(k)?;
            Some(Side { name: axis.name.clone(), low: axis.values[0], high: *axis.values.last()? })
        };
        Job { window: MapWindow { epoch: 1, x: side(0).unwrap(), y: side(1), count }, study }
    }

    /// The file of a preset, computed.
    fn computed(preset: &str, count: u16) -> String {
        let mut map = MapState::default();
        let job = job(preset, count);
        map.turn(&job, &[]).unwrap();
        let window =
            std::iter::once(&job.window.x).chain(&job.window.y).map(|side| [side.low, side.high]).collect();
        let head = Head { plane: map.plane().unwrap().clone(), window };
        let plan = &map.present().unwrap().plan;
        let lines = Mutex::new(vec![String::new(); plan.cells()]);
        let left = Mutex::new(0..plan.cells());
        let work = || {
            let mut next = || lock(&left).next().map(|cell| (cell, 0));
            let mut done = |(cell, _): (usize, usize), verdict| {
                let row = Row::of_evaluation(cell, 0, verdict).unwrap();
                assert!(row.numbers.iter().all(|number| !number.is_infinite()), "{row:?}");
                let numbers =
                    row.numbers.iter().map(|number| number.is_finite().then_some(*number)).collect();
                let line = Line(plan.axis_values(cell), row.regime, row.attractor, numbers, row.why);
                lock(&lines)[cell] = serde_json::to_string(&line).unwrap();
            };
            Classify.evaluate_all(plan, &mut next, &mut done, &());
        };
        std::thread::scope(|scope| {
            scope.spawn(work);
            scope.spawn(work);
        });
        let lines = lines.into_inner().unwrap();
        format!("{}\n{}\n", serde_json::to_string(&head).unwrap(), lines.join("\n"))
    }

    #[test]
    fn shipped_maps_are_what_the_program_computes() {
        for ((preset, count), shipped) in OF.into_iter().zip(TABLES) {
            let computed = computed(preset, count);
            if std::env::var_os("MOTIFORM_UPDATE").is_some() {
                let maps = Path::new(env!("CARGO_MANIFEST_DIR")).join("maps");
                std::fs::write(maps.join(preset).with_extension("jsonl"), computed).unwrap();
            } else {
                let same = computed.lines().zip(shipped.lines()).position(|(ours, theirs)| ours != theirs);
                assert!(computed == shipped, "{preset}, line {same:?}: MOTIFORM_UPDATE=1 writes the file");
            }
        }
    }

    /// A screen of any size shows them, whatever else it shows.
    #[test]
    fn shipped_cells_are_cells_of_every_window() {
        for ((preset, count), cells) in OF.into_iter().zip([256, 256, 64]) {
            for finer in [1, 2, 4] {
                let mut map = MapState::default();
                map.turn(&job(preset, (count * finer).min(*COUNTS.end())), &TABLES).unwrap();
                let (_, rows) = map.rows().unwrap();
                assert!(
                    rows.len() >= cells,
                    "{preset} with {} cells along an axis: {}",
                    count * finer,
                    rows.len()
                );
            }
        }
    }
}
