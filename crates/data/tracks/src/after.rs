//! Checks after reading: frames that stand for 'none', cells filed twice, areas that no cell has.

use crate::geometry::area;
use crate::{Cell, Note, Outline};
use motiform_dynamics::sample::ascending;
use std::collections::{BTreeMap, HashMap};

/// A frame is far where its distance to the next exceeds this many times the span of all others.
const FAR: i64 = 10;

/// Others that must be there before a frame can be far from them.
const OTHERS: usize = 5;

/// Areas of cells, in square micrometres: bacteria to oocytes, with room.
const AREAS: [f64; 2] = [0.1, 1e6];

/// Negative frames that are no sentinels: so many at least, as far apart as frames before a stimulus are.
const BEFORE: usize = 2;

/// Takes frames out whose number stands for 'none': negative ones, and a last one (999, 65535, ...) far from
/// all others. Two negative frames and more that lead up to the others, as before a stimulus at frame 0, are
/// frames.
pub(crate) fn sentinels(cell: &mut Cell, notes: &mut Vec<Note>) {
    let mut out: Vec<i64> = Vec::new();
    let negative = cell.frames.iter().filter(|outline| outline.frame < 0).count();
    if negative < cell.frames.len() && !leads_up(&cell.frames, negative) {
        out.extend(cell.frames.drain(..negative).map(|outline| outline.frame));
    }
    if let [first, .., before, last] = cell.frames.as_slice()
        && cell.frames.len() > OTHERS
        && last.frame.saturating_sub(before.frame)
            > before.frame.saturating_sub(first.frame).saturating_add(1).saturating_mul(FAR)
    {
        out.push(last.frame);
        cell.frames.pop();
    }
    if !out.is_empty() {
        notes.push(Note::SentinelFrames { cell: cell.name.clone(), frames: out });
    }
}

/// Returns `true` if the negative frames are a record that continues at 0: most steps among them and to the next one are within three
/// times the smallest step of all; a record may have gaps.
fn leads_up(frames: &[Outline], negative: usize) -> bool {
    let steps = |frames: &[Outline]| {
        frames.windows(2).map(|pair| pair[1].frame - pair[0].frame).collect::<Vec<i64>>()
    };
    let least = steps(frames).into_iter().min().unwrap_or(1);
    let before = steps(&frames[..(negative + 1).min(frames.len())]);
    negative >= BEFORE && 2 * before.iter().filter(|&&step| step <= 3 * least).count() > before.len()
}

/// Pairs of cells with the same outlines in the same frames, whatever their first vertex and sense.
pub(crate) fn filed_twice(cells: &[Cell]) -> Vec<Note> {
    let mut first: HashMap<(i64, u64, usize), usize> = HashMap::new();
    let mut pairs: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for (at, cell) in cells.iter().enumerate() {
        for outline in cell.frames.iter().filter(|outline| !outline.points.is_empty()) {
            let key = (outline.frame, digest(&outline.points), outline.points.len());
            let before = *first.entry(key).or_insert(at);
            if before != at {
                *pairs.entry((before, at)).or_insert(0) += 1;
            }
        }
    }
    let name = |at: usize| cells[at].name.clone();
    pairs
        .iter()
        .map(|(&(a, b), &frames)| Note::SameCell { first: name(a), second: name(b), frames })
        .collect()
}

/// A number that does not depend on the order of the vertices.
pub(crate) fn digest(points: &[[f64; 2]]) -> u64 {
    let mix = |mut z: u64| {
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    let one = |[x, y]: &[f64; 2]| {
        mix(mix((x + 0.0).to_bits()).wrapping_add(mix((y + 0.0).to_bits().rotate_left(17))))
    };
    points.iter().map(one).fold(0, u64::wrapping_add)
}

/// The cells that have positions alone.
pub(crate) fn positions(cells: &[Cell]) -> Option<Note> {
    let cells = cells.iter().filter(|cell| cell.has_positions_alone()).count();
    (cells > 0).then_some(Note::Positions { cells })
}

/// Median areas above this are said once for all cells (um^2): large tissue cells have them, amoebae with a wrong scale too.
const LARGE: f64 = 1000.0;

/// The median area of all cells, where it is that of large cells only.
pub(crate) fn large(cells: &[Cell], unit: &str) -> Option<Note> {
    let mut areas: Vec<f64> =
        cells.iter().flat_map(|cell| &cell.frames).map(|outline| area(&outline.points).abs()).collect();
    ascending(&mut areas);
    let area = *areas.get(areas.len() / 2)?;
    (unit == "um" && area > LARGE && area <= AREAS[1]).then_some(Note::LargeArea { area })
}

/// Cells whose median area is not that of a cell, in micrometres.
pub(crate) fn implausible(cell: &Cell, unit: &str) -> Option<Note> {
    let mut areas: Vec<f64> = cell.frames.iter().map(|outline| area(&outline.points).abs()).collect();
    ascending(&mut areas);
    let area = *areas.get(areas.len() / 2)?;
    let strange = unit == "um" && !cell.has_positions_alone() && !(AREAS[0]..=AREAS[1]).contains(&area);
    strange.then(|| Note::ImplausibleArea { cell: cell.name.clone(), area, unit: unit.to_owned() })
}
