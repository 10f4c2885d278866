//! Contours of labels.

use super::Labels;
use crate::cracks::follow;
use crate::geometry::area;
use std::collections::BTreeMap;

/// The box of the pixels of a label: first and last column and row.
type Span = [usize; 4];

/// Label, outline of the largest part, and number of parts, of each cell.
///
/// The outline is the contour at half level of the pixels of the cell (marching squares): its vertices are
/// the middles between the middles of neighbouring pixels inside and outside. Pixels that touch at a corner
/// alone are different parts; holes do not count.
///
/// Source: Lorensen and Cline (1987), Comput. Graph. 21, 163, in two dimensions.
pub(super) fn outlines(labels: &Labels) -> Vec<(u32, Vec<[f64; 2]>, usize)> {
    let of_label = |(label, span): (u32, Span)| {
        let parts = parts(labels, label, span);
        let count = parts.len();
        let size = |outline: &Vec<[f64; 2]>| area(outline).abs();
        let largest = parts.into_iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
        Some((label, largest, count))
    };
    spans(labels).into_iter().filter_map(of_label).collect()
}

fn spans(labels: &Labels) -> BTreeMap<u32, Span> {
    let mut spans: BTreeMap<u32, Span> = BTreeMap::new();
    for (y, row) in labels.of.chunks_exact(labels.width).enumerate() {
        for (x, &label) in row.iter().enumerate().filter(|(_, label)| **label > 0) {
            let span = spans.entry(label).or_insert([x, x, y, y]);
            *span = [span[0].min(x), span[1].max(x), span[2].min(y), span[3].max(y)];
        }
    }
    spans
}

/// The outlines of the parts of a label.
fn parts(labels: &Labels, label: u32, [left, right, top, bottom]: Span) -> Vec<Vec<[f64; 2]>> {
    let (width, height) = (right - left + 1, bottom - top + 1);
    let mut part = vec![0_u32; width * height];
    let inside = |x: usize, y: usize| labels.of[(top + y) * labels.width + left + x] == label;
    let mut outlines = Vec::new();
    for start in 0..width * height {
        let at = [start % width, start / width];
        if part[start] > 0 || !inside(at[0], at[1]) {
            continue;
        }
        let own = outlines.len() as u32 + 1;
        fill(&mut part, (width, height), at, own, &inside);
        let full = |x: i64, y: i64| {
            let [x, y] = [usize::try_from(x), usize::try_from(y)];
            matches!((x, y), (Ok(x), Ok(y)) if x < width && y < height && part[y * width + x] == own)
        };
        let corners = follow(at.map(|value| i64::try_from(value).unwrap_or(i64::MAX)), false, full);
        let next = corners.iter().cycle().skip(1);
        let middle = |(a, b): (&[i64; 2], &[i64; 2])| {
            [left as f64 + 0.5 * (a[0] + b[0]) as f64, top as f64 + 0.5 * (a[1] + b[1]) as f64]
        };
        outlines.push(corners.iter().zip(next).map(middle).collect());
    }
    outlines
}

/// Marks the pixels that are joined to one by their sides.
fn fill(
    part: &mut [u32],
    (width, height): (usize, usize),
    start: [usize; 2],
    own: u32,
    inside: &dyn Fn(usize, usize) -> bool,
) {
    let mut open = vec![start];
    part[start[1] * width + start[0]] = own;
    while let Some([x, y]) = open.pop() {
        let beside = [
            (x > 0).then(|| [x - 1, y]),
            (x + 1 < width).then_some([x + 1, y]),
            (y > 0).then(|| [x, y - 1]),
            (y + 1 < height).then_some([x, y + 1]),
        ];
        for [x, y] in beside.into_iter().flatten() {
            if part[y * width + x] == 0 && inside(x, y) {
                part[y * width + x] = own;
                open.push([x, y]);
            }
        }
    }
}
