//! The motions on the paper's planes, beneath the places of cells.
//!
//! They come with the program, as files of `crates/lab/cells/maps/`: a line of JSON for each value on the second axis, a motion for each
//! on the first one. They are what the program computes: a test computes them all.
//! `MOTIFORM_UPDATE=1 cargo test --release --workspace --lib beneath` writes them.

use motiform_analysis::regime::Regime;
use motiform_figures::PhaseDiagram;
use motiform_inference::Plane;
use motiform_lab::draw::phase_diagram;
use motiform_lab::scan::{Axis, CellSummary, Motion, NUMBERS, Reasons};
use motiform_study::{Error, Random, ScanPlan, Study, presets};

/// Cells of a diagram along each axis.
const CELLS: usize = 24;

/// The preset of each plane, the ranges in which its motions change, and the file of these.
fn plane(plane: Plane) -> (&'static str, [(&'static str, [f64; 2]); 2], &'static str) {
    match plane {
        Plane::Full => {
            ("fig4", [("kappa2", [0.1, 1.7]), ("kappa3", [0.0, 0.6])], include_str!("../../maps/fig4.jsonl"))
        }
        Plane::Reduced => (
            "fig1",
            [("kappa2", [-0.22, 0.22]), ("gamma", [-0.16, 0.12])],
            include_str!("../../maps/fig1.jsonl"),
        ),
    }
}

/// The scan of a plane on 24 x 24 points.
fn plan(of: Plane) -> Result<ScanPlan, Error> {
    let (preset, axes, _) = plane(of);
    let mut study: Study = presets::find_any(preset, "tensor")?;
    study.random = study.random.or(Some(Random::SMALL));
    study.scan.axes = axes.map(middles).to_vec();
    ScanPlan::new(&study)
}

/// The middles of the cells that fill the range of an axis.
fn middles((name, [low, high]): (&str, [f64; 2])) -> Axis {
    let middle = |k: usize| low + (high - low) * (k as f64 + 0.5) / CELLS as f64;
    Axis { name: name.to_owned(), values: (0..CELLS).map(middle).collect() }
}

/// The diagram of a plane; `None` where its file has no motion for a cell.
///
/// # Errors
/// As [`phase_diagram`].
pub(crate) fn beneath(of: Plane) -> Result<Option<PhaseDiagram>, Error> {
    let plan = plan(of)?;
    let lines = plane(of).2.lines().map(serde_json::from_str::<Vec<Regime>>).collect::<Result<Vec<_>, _>>();
    let Ok(motions) = lines.map(|lines| lines.concat()) else { return Ok(None) };
    let summary = |cell: usize| {
        let regime = *motions.get(cell)?;
        let motion = Motion {
            regime,
            rows: 1,
            turning: [0; 2],
            share: 1.0,
            medians: [f64::NAN; NUMBERS.len()],
            reasons: Reasons::default(),
        };
        Some(CellSummary { cell, rows: 1, motions: vec![motion] })
    };
    let cells: Option<Vec<CellSummary>> = (0..plan.cells()).map(summary).collect();
    cells.map(|cells| phase_diagram(&plan, &cells)).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_lab::scan::{Classify, Row, Store, compute};
    use std::path::Path;
    use std::sync::Mutex;

    /// Rows in memory.
    struct Rows(Mutex<Vec<Row>>);

    impl Store for Rows {
        fn put(&self, _part: usize, rows: Vec<Row>) -> Result<(), Error> {
            self.0.lock().unwrap().extend(rows);
            Ok(())
        }
    }

    /// The file of a plane, computed.
    fn computed(of: Plane) -> String {
        let plan = plan(of).unwrap();
        let rows = Rows(Mutex::new(Vec::new()));
        assert!(compute(&plan, (0..plan.parts()).collect(), &Classify, 2, &(), &rows).unwrap().complete);
        let mut rows = rows.0.into_inner().unwrap();
        rows.sort_by_key(|row| row.cell);
        let line = |rows: &[Row]| {
            let motions: Vec<Regime> = rows.iter().map(|row| row.regime).collect();
            format!("{}\n", serde_json::to_string(&motions).unwrap())
        };
        rows.chunks(CELLS).map(line).collect()
    }

    #[test]
    fn motions_beneath_places_are_what_the_program_computes() {
        for of in [Plane::Full, Plane::Reduced] {
            let (preset, _, shipped) = plane(of);
            let computed = computed(of);
            if std::env::var_os("MOTIFORM_UPDATE").is_some() {
                let maps = Path::new(env!("CARGO_MANIFEST_DIR")).join("maps");
                std::fs::write(maps.join(preset).with_extension("jsonl"), computed).unwrap();
            } else {
                assert!(computed == shipped, "{preset}: MOTIFORM_UPDATE=1 writes the file");
                assert_eq!(beneath(of).unwrap().unwrap().cells.len(), CELLS * CELLS);
            }
        }
    }
}
