//! The names of wide regions, written into them; smaller ones have their markers.

use super::super::geometry::Rect;
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

/// Names of more motions than this are no names.
const MOST: usize = 2;

/// A row of cells with the same motions.
struct Run {
    row: usize,
    from: usize,
    to: usize,
}

/// Writes the names of the regions that have room for them, and below a name the paths of its motions; the places that they take.
pub(super) fn draw(svg: &mut Svg, scale: &Scale, cells: &Cells, insets: &[MapInset]) -> Vec<Rect> {
    let mut taken = Vec::new();
    for (motions, region) in regions(cells) {
        let words: Vec<&str> = motions.iter().map(|rank| REGIMES[*rank].name).collect();
        let label = Label::parse(&words.join(" + "));
        let size = [label.width(SIZE) + 2.0 * ROOM, SIZE + 2.0 * ROOM];
        if motions.len() > MOST {
            continue;
        }
        let own = |inset: &&MapInset| {
            cells.number(inset.cell).is_some_and(|cell| region.binary_search(&cell).is_ok())
        };
        let paths = insets.iter().find(own).map_or(&[][..], |inset| &inset.paths);
        let below =
            [inset::SIZE[0] * paths.len() as f64, if paths.is_empty() { 0.0 } else { inset::SIZE[1] }];
        if let Some(whole) = place(scale, cells, &region, [size[0].max(below[0]), size[1] + below[1]]) {
            name(svg, Rect { h: size[1], ..whole }, &label);
            let left = whole.x + 0.5 * (whole.w - below[0]);
            for (number, path) in paths.iter().enumerate() {
                let [w, h] = inset::SIZE;
                let place = Rect { x: left + w * number as f64, y: whole.y + size[1], w, h };
                svg.rect(place, &Paint::fill(WHITE).opacity(GROUND));
                inset::draw(svg, place, path);
            }
            taken.push(whole);
        } else if let Some(place) = place(scale, cells, &region, size) {
            name(svg, place, &label);
            taken.push(place);
        } else if let ([rank], Some(place)) = (&motions[..], place(scale, cells, &region, [MARKER; 2])) {
            let at = [place.x + 0.5 * place.w, place.y + 0.5 * place.h];
            svg.circle(at, 8.0, &Paint::fill(WHITE).opacity(0.85));
            REGIMES[*rank].draw(svg, at, 4.6);
            taken.push(place);
        }
    }
    taken
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
fn place(scale: &Scale, cells: &Cells, region: &[usize], [w, h]: [f64; 2]) -> Option<Rect> {
    let columns = cells.size().0;
    let is_own = |[column, row]: [usize; 2]| region.binary_search(&(row * columns + column)).is_ok();
    let mut best: Option<(f64, Rect)> = None;
    for Run { row, from, to } in runs(region, columns) {
        let (left, right) =
            (scale.map([cells.column(from)[0], 0.0])[0], scale.map([cells.column(to)[1], 0.0])[0]);
        let [low, high] = cells.row(row);
        let middle = scale.map([0.0, 0.5 * (low + high)])[1];
        let at = Rect { x: 0.5 * (left + right - w), y: middle - 0.5 * h, w, h };
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
        let score = free + 0.2 * (right - left - w);
        if free >= h && right - left >= w && best.as_ref().is_none_or(|known| score > known.0) {
            best = Some((score, at));
        }
    }
    best.map(|found| found.1)
}

/// Whether the part of a row below a name belongs to its region.
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
        let mut svg = Svg::new(400.0, 300.0);
        let taken = draw(&mut svg, &Scale { frame, x: range, y: range }, &cells, &[]);
        let [marker, name] = &taken[..] else { panic!("{taken:?}") };
        let path = (0..50).map(|i| [f64::from(i), f64::from(i % 9)]).collect();
        let inset = MapInset { cell: [10.0, 10.0], paths: vec![path] };
        let with = draw(&mut svg, &Scale { frame, x: range, y: range }, &cells, &[inset]);
        assert!(with[0] == *marker && with[1].h > name.h + 30.0, "{with:?}");
        assert!(with[1].x >= 40.0 && with[1].right() <= 400.0, "{with:?}");
        assert!(marker.x >= 0.0 && marker.right() <= 40.0, "{marker:?}");
        assert!(
            name.x >= 40.0 && name.right() <= 400.0 && name.y > 50.0 && name.bottom() < 250.0,
            "{name:?}"
        );
    }
}
