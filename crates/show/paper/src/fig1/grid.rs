//! The cells of the scan compared with the formulas.

use super::{check, claim};
use motiform_analysis::regime::Regime;
use motiform_dynamics::sample::sort_by_number;
use motiform_figures::report::Claim;
use motiform_lab::scan::CellSummary;
use motiform_models::tensor::reduced::{Expected, Line, Motion, Reduced};
use motiform_study::ScanPlan;

/// Points of a line that cells are compared with.
const POINTS: usize = 4000;

/// The distance from a line within which the scan must show both of its motions, in cells.
const NEAR: f64 = 1.5;

/// A cell: its place, what was found, what is expected.
pub(super) struct Cell {
    kappa2: f64,
    gamma: f64,
    /// The motions found, the most frequent first; undetermined ones are omitted.
    found: Vec<Regime>,
    expected: Expected,
    /// Distance to the nearest analytic line, in cells.
    distance: f64,
}

impl Cell {
    fn agrees(&self) -> bool {
        self.found.iter().all(|regime| self.expected.allows(regime.name()))
    }

    pub(super) fn has(&self, motion: Motion) -> bool {
        self.found.iter().any(|regime| regime.name() == motion.name())
    }
}

/// All cells with the analytic lines.
pub(super) struct Grid {
    cells: Vec<Cell>,
    /// Width and height of a cell.
    size: [f64; 2],
    /// The lines inside the box.
    lines: Vec<(Line, Vec<[f64; 2]>)>,
}

/// The numbers of cells that agree, of all, far from and near to the lines, and of those that are
/// undetermined.
pub(super) struct Agreement {
    pub(super) far: (usize, usize),
    pub(super) near: (usize, usize),
    pub(super) undetermined: (usize, usize),
}

impl Grid {
    pub(super) fn new(plan: &ScanPlan, cells: &[CellSummary], reduced: Reduced) -> Self {
        let axes = &plan.computation.axes;
        let ends = |i: usize| {
            let values = &axes[i].values;
            (values[0], values[values.len() - 1], (values.len() - 1).max(1) as f64)
        };
        let ((left, right, across), (low, high, up)) = (ends(0), ends(1));
        let size = [(right - left) / across, (high - low) / up];
        let line = |line: Line| (line, reduced.line(line, (left, right), (low, high), POINTS));
        let lines: Vec<_> = Line::ALL.into_iter().map(line).collect();
        let mut grid = Self { cells: Vec::new(), size, lines };
        let cell = |cell: &CellSummary| {
            let at = plan.axis_values(cell.cell);
            let known = cell.motions.iter().map(|motion| motion.regime);
            Cell {
                kappa2: at[0],
                gamma: at[1],
                found: known.filter(|&regime| regime != Regime::Undetermined).collect(),
                expected: reduced.expected(at[0], at[1]),
                distance: grid.distance([at[0], at[1]], |_| true),
            }
        };
        grid.cells = cells.iter().map(cell).collect();
        grid
    }

    /// Distance of a place from the nearest of the lines that `which` takes, in cells (the longer of its two parts).
    fn distance(&self, at: [f64; 2], which: impl Fn(Line) -> bool) -> f64 {
        let points = self.lines.iter().filter(|entry| which(entry.0)).flat_map(|entry| &entry.1);
        points.map(|point| self.apart(at, *point)).fold(f64::INFINITY, f64::min)
    }

    fn apart(&self, a: [f64; 2], b: [f64; 2]) -> f64 {
        f64::max((a[0] - b[0]).abs() / self.size[0], (a[1] - b[1]).abs() / self.size[1])
    }

    /// Cells well inside the region where a motion is the only stable one: how many show it alone, and how many there are.
    pub(super) fn region(&self, motion: Motion) -> (usize, usize) {
        let only = |cell: &&Cell| cell.expected.stable == [motion] && cell.expected.possible.is_empty();
        let inside: Vec<&Cell> = self.cells.iter().filter(only).filter(|cell| cell.distance > 1.0).collect();
        let agree = inside.iter().filter(|cell| !cell.found.is_empty() && cell.agrees()).count();
        (agree, inside.len())
    }

    pub(super) fn agreement(&self) -> Agreement {
        let (known, unknown): (Vec<&Cell>, Vec<&Cell>) =
            self.cells.iter().partition(|cell| !cell.found.is_empty());
        let (far, near): (Vec<&Cell>, Vec<&Cell>) = known.into_iter().partition(|cell| cell.distance > 1.0);
        let count = |cells: &[&Cell]| (cells.iter().filter(|cell| cell.agrees()).count(), cells.len());
        let far_unknown = unknown.iter().filter(|cell| cell.distance > 1.0).count();
        let undetermined = (far_unknown, unknown.len() - far_unknown);
        Agreement { far: count(&far), near: count(&near), undetermined }
    }

    /// Cells from half a cell to six cells off the Hopf line of straight motion, more than one and a half from every other,
    /// those where straight motion is stable, and those beyond the line.
    pub(super) fn beside_hopf(&self) -> (Vec<&Cell>, Vec<&Cell>) {
        let hopf = |line| line == Line::StraightHopf;
        let beside = |cell: &&Cell| {
            let at = [cell.kappa2, cell.gamma];
            let own = self.distance(at, hopf);
            own > 0.5 && own < 6.0 && self.distance(at, |line| !hopf(line)) > 1.5
        };
        let stable = |cell: &&Cell| cell.expected.allows(Motion::Straight.name());
        self.cells.iter().filter(beside).partition(stable)
    }

    /// The most frequent motions of the column nearest to `kappa2`, from below, without repetitions.
    pub(super) fn upwards(&self, kappa2: f64) -> Vec<&'static str> {
        let off = |cell: &&Cell| (cell.kappa2 - kappa2).abs();
        let Some(nearest) = self.cells.iter().min_by(|a, b| off(a).total_cmp(&off(b))) else {
            return Vec::new();
        };
        let mut column: Vec<&Cell> = self
            .cells
            .iter()
            .filter(|cell| (cell.kappa2 - nearest.kappa2).abs() < 0.5 * self.size[0])
            .collect();
        sort_by_number(&mut column, |a| a.gamma);
        let mut names: Vec<&str> =
            column.iter().filter_map(|cell| Some(cell.found.first()?.name())).collect();
        names.dedup();
        names
    }
}

/// The claim that the scan changes from one of the two motions to the other within a cell of a line,
/// wherever no other line is near.
pub(super) fn found_line(
    grid: &Grid,
    lines: &[Line],
    sides: [Motion; 2],
    sentences: &[u16],
    says: &str,
) -> Claim {
    let own = grid.lines.iter().filter(|entry| lines.contains(&entry.0)).flat_map(|entry| &entry.1);
    let inside =
        |at: &&[f64; 2]| grid.cells.iter().any(|cell| grid.apart([cell.kappa2, cell.gamma], **at) <= 0.5);
    let alone = |at: &&[f64; 2]| grid.distance(**at, |line| !lines.contains(&line)) > 1.5;
    let thinned = own.step_by(POINTS / 400);
    let points: Vec<&[f64; 2]> = thinned.filter(inside).filter(alone).collect();
    let seen = |at: &&&[f64; 2]| {
        let near: Vec<&Cell> =
            grid.cells.iter().filter(|cell| grid.apart([cell.kappa2, cell.gamma], ***at) <= NEAR).collect();
        sides.iter().all(|&side| near.iter().any(|cell| cell.has(side)))
    };
    let found = points.iter().filter(seen).count();
    let [one, other] = sides.map(Motion::name);
    let finds = format!(
        "within one and a half cells of the analytic line the scan changes from {one} to {other} at {found} of {} places along it",
        points.len()
    );
    let how = "places along the analytic line more than one and a half cells away from all other lines; at least 95 % of \
               them have cells of both motions within one and a half cells (on the line itself motions settle infinitely slowly)";
    let holds = points.len() >= 3 && found as f64 >= 0.95 * points.len() as f64;
    match sentences {
        [] => check(says, finds, how, holds),
        sentences => claim(sentences, says, finds, how, holds),
    }
}
