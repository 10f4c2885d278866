//! Where neighbouring cells have different motions, and which bifurcation lies between them.

use crate::atlas::grid::{Grid, rank};
use crate::atlas::line::{EndKind, Line, LineEnd, StabilityCurve};
use crate::branches::draw::curve_stretches;
use motiform_analysis::Regime;
use motiform_study::AtlasPlan;
use motiform_study::curves::CurveKind;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A curve explains an edge that it passes within so many cells: a motion may go on into a cell whose few initial states missed it.
const REACH: f64 = 1.0;

/// Part of the distance between two cells by which the place where a curve passes between them may be off.
const OFF: f64 = 0.02;

/// An end of a branch explains the edges of its motion within so many cells.
const REACH_OF_ENDS: f64 = 2.5;

/// Two neighbouring cells with different motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Edge {
    /// The cells, the one with smaller parameters first.
    pub cells: [usize; 2],
    /// The side of the plane along which they are neighbours: 0 across, 1 upwards.
    pub side: usize,
}

/// The motions on one side of a boundary and on the other.
pub(crate) type Pair = [Vec<Regime>; 2];

/// A boundary between two sets of motions.
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    /// The motions on one side and on the other, in the order of legends.
    pub between: [Vec<Regime>; 2],
    /// Edges of cells in it.
    pub edges: usize,
    /// The bifurcations on it with their numbers of edges, the most frequent first.
    pub kinds: Vec<(String, usize)>,
    /// Edges that lie on no bifurcation that was found.
    pub unnamed: usize,
    /// Why there are such edges.
    pub why: Option<&'static str>,
}

impl Edge {
    /// Its middle, in units of half cells.
    fn middle(self, grid: &Grid) -> [i64; 2] {
        let [i, j] = grid.place(self.cells[0]).map(|place| 2 * i64::try_from(place).unwrap_or(i64::MAX / 4));
        if self.side == 0 { [i + 1, j] } else { [i, j + 1] }
    }

    /// Its middle, in units of cells.
    pub(crate) fn centre(self, grid: &Grid) -> [f64; 2] {
        self.middle(grid).map(|half| 0.5 * half as f64)
    }

    /// Returns `true` if a curve that bounds a motion passes between the two cells, or a little beyond the one that lacks the motion
    /// (the second one, or the first one). What is beyond the other cell bounds the motion on its other side.
    fn is_passed(self, grid: &Grid, points: &[[f64; 2]], second_lacks: bool) -> bool {
        let [along, across] = [self.side, 1 - self.side];
        let centre = self.centre(grid);
        points.windows(2).any(|pair| {
            let [from, to] = [0, 1].map(|end| [along, across].map(|side| pair[end][side] - centre[side]));
            let part = from[1] / (from[1] - to[1]);
            let at = (from[0] + part * (to[0] - from[0])) * if second_lacks { 1.0 } else { -1.0 };
            (0.0..=1.0).contains(&part) && (-0.5 - OFF..=REACH).contains(&at)
        })
    }

    fn pair(self, labels: &[Vec<Regime>]) -> Pair {
        let mut pair = self.cells.map(|cell| labels[cell].clone());
        let key = |label: &Vec<Regime>| label.iter().map(|regime| rank(*regime)).collect::<Vec<_>>();
        if key(&pair[1]) < key(&pair[0]) {
            pair.swap(0, 1);
        }
        pair
    }
}

/// The edges between cells with different motions, row by row.
pub(crate) fn edges(grid: &Grid, labels: &[Vec<Regime>]) -> Vec<Edge> {
    let [columns, rows] = grid.size;
    let mut all = Vec::new();
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let here = grid.cell([column, row]);
        let right = (column + 1 < columns).then(|| (grid.cell([column + 1, row]), 0));
        let above = (row + 1 < rows).then(|| (grid.cell([column, row + 1]), 1));
        let differing = right.into_iter().chain(above).filter(|(other, _)| labels[*other] != labels[here]);
        all.extend(differing.map(|(other, side)| Edge { cells: [here, other], side }));
    }
    all
}

/// Edges in connected pieces between the same motions, the longest first.
pub(crate) fn pieces(grid: &Grid, labels: &[Vec<Regime>], edges: &[Edge]) -> Vec<(Pair, Vec<Edge>)> {
    let mut open: BTreeMap<[i64; 2], Edge> = edges.iter().map(|edge| (edge.middle(grid), *edge)).collect();
    let mut all = Vec::new();
    while let Some((_, first)) = open.pop_first() {
        let pair = first.pair(labels);
        let (mut piece, mut next) = (vec![first], 0);
        while let Some(edge) = piece.get(next).copied() {
            next += 1;
            let [x, y] = edge.middle(grid);
            for place in (-2..=2).flat_map(|up| (-2..=2).map(move |right| [x + right, y + up])) {
                if open.get(&place).is_some_and(|near| near.pair(labels) == pair)
                    && let Some(near) = open.remove(&place)
                {
                    piece.push(near);
                }
            }
        }
        piece.sort_unstable();
        all.push((pair, piece));
    }
    descending(all, |(_, piece)| piece.len())
}

/// The motions that one side has and the other has not, in the order of legends.
pub(crate) fn differing(pair: &Pair) -> Vec<Regime> {
    let only = |regime: &Regime| pair.iter().filter(|label| label.contains(regime)).count() == 1;
    Regime::ALL.into_iter().filter(only).collect()
}

/// The known bifurcations, in units of cells.
pub(crate) struct Atlas {
    stretches: Vec<Bound>,
    ends: Vec<(Regime, EndKind, [f64; 2])>,
}

/// The bifurcation on an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Name<'s> {
    /// That of a curve.
    Curve(&'s str),
    /// One that is known on lines alone.
    End(EndKind),
}

impl<'s> Name<'s> {
    pub(crate) fn words(self) -> &'s str {
        match self {
            Self::Curve(label) => label,
            Self::End(kind) => kind.words(),
        }
    }
}

/// A part of a curve that bounds a motion.
struct Bound {
    motion: Regime,
    /// `true` for period doublings.
    doubles: bool,
    label: String,
    points: Vec<[f64; 2]>,
}

impl Atlas {
    pub(crate) fn of(plan: &AtlasPlan, grid: &Grid, lines: &[Line]) -> Self {
        let mut found = Self { stretches: Vec::new(), ends: Vec::new() };
        for StabilityCurve { motion, curve } in lines.iter().flat_map(|line| &line.curves) {
            for stretch in curve_stretches(curve).into_iter().filter(|stretch| stretch.bounds) {
                let points = stretch.points.iter().map(|at| grid.units(plan, *at)).collect();
                let doubles = curve.kind == CurveKind::PeriodDoubling;
                found.stretches.push(Bound { motion: *motion, doubles, label: stretch.label, points });
            }
        }
        for LineEnd { at, kind, motion } in lines.iter().flat_map(|line| &line.ends) {
            found.ends.push((*motion, *kind, grid.units(plan, *at)));
        }
        found
    }

    /// The bifurcation of a motion that only one side of an edge has: the nearest curve that passes between its cells, or else the
    /// nearest end of a branch. The doublings of a cascade accumulate: beside chaos the first one stands for all.
    pub(crate) fn name<'s>(&'s self, grid: &Grid, labels: &[Vec<Regime>], edge: Edge) -> Option<Name<'s>> {
        let (at, between) = (edge.centre(grid), differing(&edge.pair(labels)));
        let own = |motion: &Regime| between.contains(motion);
        let chaos = own(&Regime::Chaotic);
        let curves = self.stretches.iter().filter(|stretch| own(&stretch.motion)).filter_map(|stretch| {
            let off = stretch.points.windows(2).map(|pair| distance(at, [pair[0], pair[1]]));
            let off = off.fold(f64::INFINITY, f64::min);
            let begins_chaos = chaos && stretch.doubles && off <= REACH;
            let second_lacks = labels[edge.cells[0]].contains(&stretch.motion);
            (begins_chaos || edge.is_passed(grid, &stretch.points, second_lacks))
                .then_some((off, Name::Curve(&stretch.label)))
        });
        let ends = self
            .ends
            .iter()
            .filter(|end| own(&end.0))
            .map(|end| (distance(at, [end.2; 2]), Name::End(end.1)));
        let closer = |best: Option<(f64, Name<'s>)>, one: (f64, Name<'s>)| match best {
            Some(known) if known.0 <= one.0 => best,
            _ => Some(one),
        };
        let curve = curves.fold(None, closer);
        let found = curve.or_else(|| ends.filter(|one| one.0 <= REACH_OF_ENDS).fold(None, closer));
        found.map(|one| one.1)
    }
}

/// Distance of a point from a segment.
fn distance(at: [f64; 2], [from, to]: [[f64; 2]; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let off = [at[0] - from[0], at[1] - from[1]];
    let length = along[0] * along[0] + along[1] * along[1];
    let part =
        if length > 0.0 { ((off[0] * along[0] + off[1] * along[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
    (off[0] - part * along[0]).hypot(off[1] - part * along[1])
}

/// The boundaries of a plane with their bifurcations, the longest first.
pub fn boundaries(plan: &AtlasPlan, grid: &Grid, lines: &[Line]) -> Vec<Boundary> {
    let labels = grid.labels();
    let known = Atlas::of(plan, grid, lines);
    let mut all: Vec<(Pair, Vec<Option<Name<'_>>>)> = Vec::new();
    for edge in edges(grid, &labels) {
        let (pair, name) = (edge.pair(&labels), known.name(grid, &labels, edge));
        match all.iter_mut().find(|entry| entry.0 == pair) {
            Some(entry) => entry.1.push(name),
            None => all.push((pair, vec![name])),
        }
    }
    let all = all.into_iter().map(|(between, names)| summed(between, &names, lines)).collect();
    descending(all, |boundary: &Boundary| boundary.edges)
}

fn summed(between: Pair, names: &[Option<Name<'_>>], lines: &[Line]) -> Boundary {
    let mut kinds: Vec<(String, usize)> = Vec::new();
    for name in names.iter().flatten().map(|name| name.words()) {
        match kinds.iter_mut().find(|kind| kind.0 == name) {
            Some(kind) => kind.1 += 1,
            None => kinds.push((name.to_owned(), 1)),
        }
    }
    let kinds = descending(kinds, |kind| kind.1);
    let unnamed = names.iter().filter(|name| name.is_none()).count();
    let crossing = |name: &Name<'_>| matches!(name, Name::End(EndKind::Crossing(_)));
    let why = (unnamed > 0).then(|| match names.iter().flatten().any(crossing) {
        true => "a crossing of branches without a symmetry that the model states has no curve here: it is known on the lines alone",
        false => why(&differing(&between), lines),
    });
    Boundary { between, edges: names.len(), kinds, unnamed, why }
}

/// The items, the largest first, equal ones in their order. Lists of tens of items: a sort of the library is 20 kB of code for each type.
pub(crate) fn descending<T>(items: Vec<T>, size: impl Fn(&T) -> usize) -> Vec<T> {
    let mut all: Vec<T> = Vec::new();
    for item in items {
        let place = all.iter().position(|other| size(other) < size(&item)).unwrap_or(all.len());
        all.insert(place, item);
    }
    all
}

/// Why a part of a boundary has no name.
fn why(differing: &[Regime], lines: &[Line]) -> &'static str {
    let one = |pair: &[Regime; 2]| pair.iter().all(|motion| differing.contains(motion));
    if differing.len() == 2 && lines.iter().flat_map(|line| &line.renamed).any(one) {
        return "a branch that was followed has both names without a bifurcation between them (as where its velocity passes over rest)";
    }
    let has = |regime| differing.contains(&regime);
    if has(Regime::Undetermined) {
        "a motion is undetermined there"
    } else if has(Regime::BlowUp) && has(Regime::Chaotic) {
        "kind undetermined: neither is a branch; sampling does not tell a crisis of the chaotic set \
         from transients longer than what was looked at"
    } else if has(Regime::BlowUp) {
        "kind undetermined: blow-up is not a solution branch, and no bifurcation of the neighbouring motion was found here; \
         this may be the edge of its basin of attraction"
    } else if has(Regime::Chaotic) {
        "kind undetermined: chaotic motion is no branch, found by sampling; it may begin with a cascade, or end in a crisis"
    } else if has(Regime::Rectangular) {
        "kind undetermined: rectangular motion is a heteroclinic cycle, which is no branch, found by sampling"
    } else if lines.is_empty() {
        "no line was followed: none was asked for, or no piece of the boundary is long enough for one, as on a coarse grid"
    } else {
        "no special point of a followed branch lies there: another branch may end, or several motions coexist on both sides and the \
         samples found different ones; more lines or initial states tell"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atlas::grid::{Found, Place};
    use crate::atlas::line::CrossingKind;

    fn grid(rows: &[&str]) -> Grid {
        let motion = |letter: char| match letter {
            's' => Regime::Straight,
            'c' => Regime::Circular,
            _ => Regime::Chaotic,
        };
        let found = |letter| Found {
            regime: motion(letter),
            rows: 1,
            sample: 0,
            numbers: [None; 5],
            courses: Vec::new(),
        };
        let place = |letter: char| Place { motions: vec![found(letter)], like: None };
        let places: Vec<Place> = rows.iter().flat_map(|row| row.chars().map(place)).collect();
        Grid { size: [rows[0].len(), rows.len()], places }
    }

    #[test]
    fn edges_between_the_same_motions_are_pieces_by_place() {
        let grid = grid(&["ccss", "ccss", "ccss", "cccx"]);
        let labels = grid.labels();
        let all = edges(&grid, &labels);
        let found = pieces(&grid, &labels, &all);
        let count: Vec<usize> = found.iter().map(|piece| piece.1.len()).collect();
        assert_eq!(count.iter().sum::<usize>(), all.len());
        assert_eq!(found[0].0, [vec![Regime::Straight], vec![Regime::Circular]]);
        assert_eq!((count[0], count.len()), (4, 3), "{found:?}");
    }

    /// A column of another motion is no place where the motion around it was missed.
    #[test]
    fn a_cell_without_a_motion_of_those_around_it_keeps_its_own() {
        let line = grid(&["sscss", "sscss", "sscss"]);
        let labels = line.labels();
        assert!([2, 7, 12].iter().all(|&cell| labels[cell] == [Regime::Circular]), "{labels:?}");
    }

    /// A window that is narrower than a cell has two curves: the one on its other side is no end of it towards this neighbour.
    #[test]
    fn a_curve_beyond_a_cell_does_not_bound_it() {
        let grid = grid(&["scc", "scc", "scc"]);
        let labels = grid.labels();
        let known = |x: f64, label: &str| Bound {
            motion: Regime::Circular,
            doubles: label == "doubling",
            label: label.to_owned(),
            points: vec![[x, -1.0], [x, 0.5], [x, 3.0]],
        };
        let name = |stretches: Vec<Bound>, row: usize| {
            let edge = Edge { cells: [3 * row, 3 * row + 1], side: 0 };
            Atlas { stretches, ends: Vec::new() }
                .name(&grid, &labels, edge)
                .map(|name| name.words().to_owned())
        };
        for row in 0..3 {
            assert_eq!(name(vec![known(1.3, "doubling")], row), None);
            assert_eq!(name(vec![known(1.3, "doubling"), known(0.9, "breaking")], row).unwrap(), "breaking");
            assert_eq!(name(vec![known(0.1, "breaking")], row).unwrap(), "breaking");
            assert_eq!(name(vec![known(-0.1, "breaking")], row).unwrap(), "breaking");
            assert_eq!(name(vec![known(-0.7, "breaking")], row), None);
        }
    }

    /// A pitchfork that breaks a symmetry has a curve, and one that breaks none has not: they have one name.
    #[test]
    fn a_reason_tells_a_curve_from_a_crossing_of_its_name() {
        let between = [vec![Regime::Straight], vec![Regime::Circular]];
        let why = |name| summed(between.clone(), &[Some(name), None], &[]).why.unwrap();
        let crossing = Name::End(EndKind::Crossing(CrossingKind::Pitchfork));
        assert_eq!(crossing.words(), CurveKind::Pitchfork.name());
        assert!(why(crossing).contains("without a symmetry"));
        assert!(!why(Name::Curve(crossing.words())).contains("without a symmetry"));
        let unseen = summed(between.clone(), &[None], &[]).why.unwrap();
        assert!(unseen.starts_with("no line was followed"), "{unseen}");
    }

    #[test]
    fn a_distance_is_that_from_the_segment() {
        assert_eq!(distance([0.0, 1.0], [[-1.0, 0.0], [1.0, 0.0]]), 1.0);
        assert_eq!(distance([4.0, 4.0], [[-1.0, 0.0], [1.0, 0.0]]), 5.0);
        assert_eq!(distance([3.0, 4.0], [[0.0, 0.0], [0.0, 0.0]]), 5.0);
    }
}
