//! The names of wide regions, written into them; smaller ones have their markers.

use super::super::geometry::{Point, Rect};
use super::super::marks::REGIMES;
use super::super::svg::Anchor;
use super::super::text::Label;
use super::cells::Cells;
use super::inset::{self, MapInset};
use super::{Paint, Scale, Svg, WHITE};

/// Size of the letters, in pixels.
const SIZE: f64 = 12.0;

/// Room around a name, in pixels.
const ROOM: f64 = 5.0;

/// Opacity of the ground of names and paths.
const GROUND: f64 = 0.8;

/// Room for a marker where there is none for a name, in pixels.
const MARKER: f64 = 18.0;

/// The positions at which a name is tried, as parts of the room that it leaves in a row.
const STEPS: [f64; 7] = [0.5, 0.4, 0.6, 0.25, 0.75, 0.1, 0.9];

/// Names of more motions than this are no names.
const MOST: usize = 2;

/// A row of cells with the same motions.
struct Run {
    row: usize,
    from: usize,
    to: usize,
}

/// The name of a region, or the marker of its motion, with its place.
#[derive(Debug, Clone)]
struct Name {
    place: Rect,
    motions: Vec<usize>,
    label: Option<Label>,
    paths: Vec<Vec<Point>>,
}

/// The names of regions with their places, which are those of a frame whose corner is the origin.
#[derive(Debug, Clone, Default)]
pub(crate) struct Names(Vec<Name>);

/// Places the names of the regions that have room for them, below a name the paths of its motions, where
/// `clear` has nothing against it; a marker where one motion has no room for its name.
pub(super) fn places(
    scale: &Scale,
    cells: &Cells,
    insets: &[MapInset],
    clear: &dyn Fn(&Rect) -> bool,
) -> Names {
    let all = regions(cells).into_iter().filter(|(motions, _)| motions.len() <= MOST);
    Names(
        all.filter_map(|(motions, region)| {
            let own = |inset: &&MapInset| {
                cells.number(inset.cell).is_some_and(|cell| region.binary_search(&cell).is_ok())
            };
            let paths = insets.iter().find(own).map_or(Vec::new(), |inset| inset.paths.clone());
            let words: Vec<&str> = motions.iter().map(|rank| REGIMES[*rank].words).collect();
            let label = Label::parse(&words.join(" + "));
            let found = |size: [f64; 2]| place(scale, cells, &region, size, clear);
            let size = [label.width(SIZE) + 2.0 * ROOM, SIZE + 2.0 * ROOM];
            let [w, h] = inset::SIZE;
            let large = [size[0].max(w * paths.len() as f64), size[1] + h];
            let whole = if paths.is_empty() { None } else { found(large) };
            let marker = || if motions.len() == 1 { found([MARKER; 2]) } else { None };
            if let Some(place) = whole {
                return Some(Name { place, motions, label: Some(label), paths });
            }
            match found(size) {
                Some(place) => Some(Name { place, motions, label: Some(label), paths: Vec::new() }),
                None => marker().map(|place| Name { place, motions, label: None, paths: Vec::new() }),
            }
        })
        .collect(),
    )
}

impl Names {
    /// The places that they take.
    #[cfg(test)]
    fn taken(&self) -> impl Iterator<Item = Rect> + '_ {
        self.0.iter().map(|name| name.place)
    }

    /// Returns `true` if a motion stands in the plane by its name, alone, and nowhere by its marker.
    pub(super) fn tell(&self, rank: usize) -> bool {
        let own = || self.0.iter().filter(|name| name.motions == [rank]);
        own().any(|name| name.label.is_some()) && own().all(|name| name.label.is_some())
    }

    /// Draws them; `corner` is where the frame lies on the sheet.
    pub(crate) fn draw(&self, svg: &mut Svg, [dx, dy]: Point) {
        for Name { place, motions, label, paths } in &self.0 {
            let whole = Rect { x: place.x + dx, y: place.y + dy, ..*place };
            let Some(label) = label else {
                let at = [whole.x + 0.5 * whole.w, whole.y + 0.5 * whole.h];
                svg.circle(at, 8.0, &Paint::fill(WHITE).opacity(0.85));
                motions.iter().for_each(|rank| REGIMES[*rank].draw(svg, at, 4.6));
                continue;
            };
            let [w, h] = inset::SIZE;
            let below = if paths.is_empty() { 0.0 } else { h };
            name(svg, Rect { h: whole.h - below, ..whole }, label);
            let left = whole.x + 0.5 * (whole.w - w * paths.len() as f64);
            for (number, path) in paths.iter().enumerate() {
                let place = Rect { x: left + w * number as f64, y: whole.bottom() - h, w, h };
                svg.rect(place, &Paint::fill(WHITE).opacity(GROUND));
                inset::draw(svg, place, path);
            }
        }
    }
}

/// A name on a pale ground.
fn name(svg: &mut Svg, place: Rect, label: &Label) {
    let w = label.width(SIZE) + 2.0 * ROOM - 4.0;
    let ground = Rect { x: place.x + 0.5 * (place.w - w), y: place.y + 2.0, w, h: place.h - 4.0 };
    svg.rect(ground, &Paint::fill(WHITE).opacity(GROUND));
    let at = [place.x + 0.5 * place.w, place.y + 0.5 * place.h + 0.36 * SIZE];
    svg.text(at, SIZE, Anchor::Middle, label);
}

/// The place in a region with the most room around a name of this size; `None` if it fits nowhere.
fn place(
    scale: &Scale,
    cells: &Cells,
    region: &[usize],
    [w, h]: [f64; 2],
    clear: &dyn Fn(&Rect) -> bool,
) -> Option<Rect> {
    let columns = cells.size().0;
    let is_own = |[column, row]: [usize; 2]| region.binary_search(&(row * columns + column)).is_ok();
    let mut best: Option<(f64, Rect)> = None;
    for Run { row, from, to } in runs(region, columns) {
        let (left, right) =
            (scale.map([cells.column(from)[0], 0.0])[0], scale.map([cells.column(to)[1], 0.0])[0]);
        let [low, high] = cells.row(row);
        let middle = scale.map([0.0, 0.5 * (low + high)])[1];
        let spare = right - left - w;
        let at = |part: f64| Rect { x: left + part * spare, y: middle - 0.5 * h, w, h };
        // in the middle of the row, or as near to it as nothing is in the way
        let Some(at) = STEPS.map(at).into_iter().find(|at| spare >= 0.0 && clear(at)) else { continue };
        // how far the rows above and below have room for it, too
        let mut free = 0.0;
        for beyond in 0.. {
            let spans = |row: Option<usize>| {
                let row = row.filter(|row| *row < cells.size().1);
                row.is_some_and(|row| covered(scale, cells, row, &at, &is_own))
            };
            if !(spans(row.checked_sub(beyond)) && spans(row.checked_add(beyond))) {
                break;
            }
            let [low, high] = cells.row(row + beyond);
            free = 2.0 * (middle - scale.map([0.0, low.max(high)])[1]).abs();
        }
        let score = free + 0.2 * spare;
        if free >= h && best.as_ref().is_none_or(|known| score > known.0) {
            best = Some((score, at));
        }
    }
    best.map(|found| found.1)
}

/// Returns `true` if the part of a row below a name belongs to its region.
fn covered(scale: &Scale, cells: &Cells, row: usize, at: &Rect, is_own: &dyn Fn([usize; 2]) -> bool) -> bool {
    let columns = cells.size().0;
    let touched = (0..columns).filter(|column| {
        let [left, right] = cells.column(*column).map(|x| scale.map([x, 0.0])[0]);
        right > at.x && left < at.right()
    });
    let mut any = false;
    for column in touched {
        any = true;
        if !is_own([column, row]) {
            return false;
        }
    }
    any
}

/// The rows of a region, each without gaps.
fn runs(region: &[usize], columns: usize) -> Vec<Run> {
    let mut all: Vec<Run> = Vec::new();
    for &cell in region {
        let (column, row) = (cell % columns, cell / columns);
        match all.last_mut().filter(|run| run.row == row && run.to + 1 == column) {
            Some(run) => run.to = column,
            None => all.push(Run { row, from: column, to: column }),
        }
    }
    all
}

/// Connected cells with the same motions, each with its cells in order.
fn regions(cells: &Cells) -> Vec<(Vec<usize>, Vec<usize>)> {
    let (columns, rows) = cells.size();
    let motions = |cell: usize| {
        let mut all: Vec<usize> =
            cells.at(cell % columns, cell / columns)?.iter().map(|share| share.0).collect();
        all.sort_unstable();
        Some(all)
    };
    let all: Vec<Option<Vec<usize>>> = (0..columns * rows).map(motions).collect();
    let mut seen = vec![false; all.len()];
    let mut found = Vec::new();
    for first in 0..all.len() {
        let Some(own) = &all[first] else { continue };
        let (mut open, mut region) = (vec![first], Vec::new());
        while let Some(cell) = open.pop() {
            if all[cell].as_ref() != Some(own) || std::mem::replace(&mut seen[cell], true) {
                continue;
            }
            region.push(cell);
            let (column, row) = (cell % columns, cell / columns);
            open.extend((column + 1 < columns).then_some(cell + 1));
            open.extend((column > 0).then(|| cell - 1));
            open.extend((row + 1 < rows).then_some(cell + columns));
            open.extend((row > 0).then(|| cell - columns));
        }
        region.sort_unstable();
        if !region.is_empty() {
            found.push((own.clone(), region));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::super::geometry::Range;
    use super::super::Cell;
    use super::*;

    #[test]
    fn a_name_lies_in_the_middle_of_its_region_and_a_marker_where_it_does_not_fit() {
        let axis: Vec<f64> = (0..20).map(f64::from).collect();
        let motion = |x: f64| if x < 1.5 { "zigzag" } else { "straight" };
        let places = axis.iter().flat_map(|y| axis.iter().map(move |x| (*x, *y)));
        let all: Vec<_> = places.map(|(x, y)| Cell { x, y, shares: vec![(motion(x).into(), 1.0)] }).collect();
        let cells = Cells::new(&axis, &axis, &all).expect("cells");
        let frame = Rect { x: 0.0, y: 0.0, w: 400.0, h: 300.0 };
        let range = Range { min: -0.5, max: 19.5 };
        let scale = Scale { frame, x: range, y: range };
        let found = |insets: &[MapInset], clear: &dyn Fn(&Rect) -> bool| {
            super::places(&scale, &cells, insets, clear).taken().collect::<Vec<_>>()
        };
        let taken = found(&[], &|_| true);
        let [marker, name] = &taken[..] else { panic!("{taken:?}") };
        let path = (0..50).map(|i| [f64::from(i), f64::from(i % 9)]).collect();
        let with = found(&[MapInset { cell: [10.0, 10.0], paths: vec![path] }], &|_| true);
        // what is in the way in the middle moves it
        let away = found(&[], &|place| place.y > 160.0 || place.bottom() < 140.0);
        assert!(away[1].y > 160.0 || away[1].bottom() < 140.0, "{away:?}");
        assert!(with[0] == *marker && with[1].h > name.h + 30.0, "{with:?}");
        assert!(with[1].x >= 40.0 && with[1].right() <= 400.0, "{with:?}");
        assert!(marker.x >= 0.0 && marker.right() <= 40.0, "{marker:?}");
        assert!(
            name.x >= 40.0 && name.right() <= 400.0 && name.y > 50.0 && name.bottom() < 250.0,
            "{name:?}"
        );
    }
}
