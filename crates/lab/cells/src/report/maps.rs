//! The regimes of the paper's planes, beneath the places of cells.

use motiform_dynamics::Watch;
use motiform_figures::PhaseDiagram;
use motiform_inference::Plane;
use motiform_lab::draw::phase_diagram;
use motiform_lab::scan::{Axis, CellSummary, Classify, Row, Store, compute};
use motiform_study::{Error, Random, ScanPlan, Study, presets};
use std::sync::{Mutex, PoisonError};

/// Cells of a diagram along each axis.
const CELLS: usize = 24;

/// The diagrams of both planes; `None` where no cell has a place.
#[derive(Debug, Clone, Default)]
pub struct Maps {
    full: Option<PhaseDiagram>,
    reduced: Option<PhaseDiagram>,
}

impl Maps {
    /// The diagram of a plane.
    pub(crate) fn of(&self, plane: Plane) -> Option<&PhaseDiagram> {
        match plane {
            Plane::Full => self.full.as_ref(),
            Plane::Reduced => self.reduced.as_ref(),
        }
    }

    /// Classifies the motions of the planes on 24 x 24 points, on `threads` threads: of those planes that are asked for.
    ///
    /// # Errors
    /// [`Error::Interrupted`].
    pub fn compute(planes: &[Plane], threads: usize, watch: &dyn Watch) -> Result<Self, Error> {
        let of = |plane: Plane| planes.contains(&plane).then(|| diagram(plane, threads, watch)).transpose();
        Ok(Self { full: of(Plane::Full)?, reduced: of(Plane::Reduced)? })
    }
}

/// The ranges of each plane in which its motions change.
fn axes(plane: Plane) -> (&'static str, [(&'static str, [f64; 2]); 2]) {
    match plane {
        Plane::Full => ("fig4", [("kappa2", [0.1, 1.7]), ("kappa3", [0.0, 0.6])]),
        Plane::Reduced => ("fig1", [("kappa2", [-0.22, 0.22]), ("gamma", [-0.16, 0.12])]),
    }
}

fn diagram(plane: Plane, threads: usize, watch: &dyn Watch) -> Result<PhaseDiagram, Error> {
    let (preset, axes) = axes(plane);
    let mut study: Study = presets::find_any(preset, "tensor")?;
    study.random = study.random.or(Some(Random::SMALL));
    study.scan.axes = axes.map(refined).to_vec();
    let plan = ScanPlan::new(&study)?;
    let rows = Rows(Mutex::new(Vec::new()));
    let parts: Vec<usize> = (0..plan.parts()).collect();
    if !compute(&plan, parts, &Classify, threads, watch, &rows)?.complete {
        return Err(Error::Interrupted);
    }
    let mut rows = rows.0.into_inner().unwrap_or_else(PoisonError::into_inner);
    rows.sort_by_key(|row| (row.cell, row.sample));
    let cells: Vec<CellSummary> =
        rows.chunk_by(|a, b| a.cell == b.cell).map(|rows| CellSummary::of(rows[0].cell, rows)).collect();
    phase_diagram(&plan, &cells)
}

/// The middles of the cells that fill the range of an axis.
fn refined((name, [low, high]): (&str, [f64; 2])) -> Axis {
    let middle = |k: usize| low + (high - low) * (k as f64 + 0.5) / CELLS as f64;
    Axis { name: name.to_owned(), values: (0..CELLS).map(middle).collect() }
}

/// Rows in memory.
struct Rows(Mutex<Vec<Row>>);

impl Store for Rows {
    fn put(&self, _part: usize, rows: Vec<Row>) -> Result<(), Error> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).extend(rows);
        Ok(())
    }
}
