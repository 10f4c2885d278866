//! The cells of a phase diagram on their grid, checked.

use super::super::marks::{REGIMES, rank};
use super::{Cell, FigureError, Range, Result, check_finite};

/// Most that the shares of a cell may miss 1 by: they may be printed numbers.
const SLACK: f64 = 0.02;

/// Shares of regimes, by rank in [`REGIMES`], largest first, 1 in all.
pub(super) type Shares = Vec<(usize, f64)>;

/// A grid with what was found at its places.
#[derive(Debug)]
pub(super) struct Cells {
    x: Axis,
    y: Axis,
    places: Vec<Option<Shares>>,
}

/// Cells along an axis: one more edge than cells.
#[derive(Debug)]
struct Axis {
    centres: Vec<f64>,
    edges: Vec<f64>,
}

impl Cells {
    /// Sorts the cells into the grid. Without values of `y`, all cells lie in one row from 0 to 1.
    pub(super) fn new(x: &[f64], y: &[f64], cells: &[Cell]) -> Result<Self> {
        let x = Axis::new("cell centre across", x)?;
        let row = Axis { centres: vec![0.5], edges: vec![0.0, 1.0] };
        let y = if y.is_empty() { row } else { Axis::new("cell centre upwards", y)? };
        let one_row = y.centres.len() == 1;
        if cells.is_empty() {
            return Err(FigureError::Empty { what: "list of cells" });
        }
        let mut places = vec![None; x.centres.len() * y.centres.len()];
        for (index, cell) in cells.iter().enumerate() {
            let off = FigureError::OffGrid { index, x: cell.x, y: cell.y };
            let row = if one_row { Some(0) } else { y.find(cell.y) };
            let (Some(column), Some(row)) = (x.find(cell.x), row) else { return Err(off) };
            let place = &mut places[row * x.centres.len() + column];
            if place.replace(shares(index, cell)?).is_some() {
                return Err(FigureError::SameCell { index });
            }
        }
        Ok(Self { x, y, places })
    }

    /// Numbers of columns and rows.
    pub(super) fn size(&self) -> (usize, usize) {
        (self.x.centres.len(), self.y.centres.len())
    }

    /// Ranges from the first edge to the last.
    pub(super) fn ranges(&self) -> [Range; 2] {
        [&self.x, &self.y].map(|axis| Range { min: axis.edges[0], max: axis.edges[axis.edges.len() - 1] })
    }

    /// Lower and upper edge of a column.
    pub(super) fn column(&self, column: usize) -> [f64; 2] {
        [self.x.edges[column], self.x.edges[column + 1]]
    }

    /// Lower and upper edge of a row.
    pub(super) fn row(&self, row: usize) -> [f64; 2] {
        [self.y.edges[row], self.y.edges[row + 1]]
    }

    /// The number of the cell with a centre.
    pub(super) fn number(&self, [x, y]: [f64; 2]) -> Option<usize> {
        Some(self.y.find(y)? * self.x.centres.len() + self.x.find(x)?)
    }

    /// The motions found in a cell.
    pub(super) fn at(&self, column: usize, row: usize) -> Option<&Shares> {
        self.places[row * self.x.centres.len() + column].as_ref()
    }

    /// Returns `true` if a regime occurs anywhere.
    pub(super) fn has(&self, rank: usize) -> bool {
        self.places.iter().flatten().flatten().any(|(r, _)| *r == rank)
    }

    /// The two most frequent motions of the first cell that has two known ones.
    pub(super) fn first_pair(&self) -> Option<[usize; 2]> {
        self.places.iter().flatten().find_map(|shares| {
            let mut known = shares.iter().map(|(rank, _)| *rank).filter(|r| !REGIMES[*r].is_undetermined());
            Some([known.next()?, known.next()?])
        })
    }
}

impl Axis {
    /// Edges lie half-way between centres.
    fn new(what: &'static str, centres: &[f64]) -> Result<Self> {
        check_finite(what, centres.iter().copied())?;
        if let Some(i) = centres.windows(2).position(|w| w[0] >= w[1]) {
            return Err(FigureError::NotIncreasing { what, index: i + 1 });
        }
        let (Some(first), Some(last)) = (centres.first(), centres.last()) else {
            return Err(FigureError::Empty { what });
        };
        let mut edges: Vec<f64> = centres.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect();
        let Range { min, max } = Range { min: *first, max: *first }.padded(0.0);
        let low = edges.first().map_or(min, |edge| 2.0 * first - edge);
        let high = edges.last().map_or(max, |edge| 2.0 * last - edge);
        edges.insert(0, low);
        edges.push(high);
        Ok(Self { centres: centres.to_vec(), edges })
    }

    /// The cell whose centre is `value`, up to rounding.
    fn find(&self, value: f64) -> Option<usize> {
        let i = self.edges.partition_point(|edge| *edge <= value).checked_sub(1)?;
        let centre = self.centres.get(i)?;
        ((value - centre).abs() <= 1e-6 * (self.edges[i + 1] - self.edges[i])).then_some(i)
    }
}

fn shares(index: usize, cell: &Cell) -> Result<Shares> {
    let sum: f64 = cell.shares.iter().map(|(_, share)| share).sum();
    let negative = cell.shares.iter().any(|(_, share)| *share < 0.0);
    if negative || !(1.0 - SLACK..=1.0 + SLACK).contains(&sum) {
        return Err(FigureError::Shares { index, sum });
    }
    let mut totals = [0.0; REGIMES.len()]; // two names may mean one mark
    for (name, share) in &cell.shares {
        totals[rank(name)] += share / sum;
    }
    let mut shares: Shares = totals.into_iter().enumerate().filter(|(_, share)| *share > 0.0).collect();
    shares.sort_by(|a, b| b.1.total_cmp(&a.1)); // stable: equal shares keep the order of the regimes
    Ok(shares)
}
