//! Outlines clipped at the border of the images.

use super::flag::{Flag, Side};
use super::straight::{Edge, run};
use crate::geometry::{area, centroid};
use crate::{Outline, Tracks};
use motiform_dynamics::sample::ascending;
use motiform_dynamics::sample::median;
use std::f64::consts::PI;

/// Frames in which a line must be reached.
const FRAMES: usize = 5;

/// Width of the band in which extremes coincide, and distance from the extreme of all within which outlines
/// count, both relative to the radius.
const BAND: f64 = 0.01;
const NEAR: f64 = 0.05;

/// Share of the outlines near the extreme of all whose extremes coincide at a border.
const SHARE: f64 = 0.75;

/// Their least number.
const COINCIDE: usize = 8;

/// Centroids move at least so many times as far as extremes while outlines stay at a border.
const CUT: f64 = 2.0;

/// A side: its name, its axis, and the sign that makes it the greatest coordinate.
const SIDES: [(Side, usize, f64); 4] =
    [(Side::Left, 0, -1.0), (Side::Right, 0, 1.0), (Side::LeastY, 1, -1.0), (Side::GreatestY, 1, 1.0)];

/// Lines that outlines are clipped at.
pub(super) struct Borders {
    lines: Vec<Line>,
    /// The lines of the greatest coordinates of all outlines, on all four sides.
    edges: Vec<Edge>,
}

struct Line {
    side: Side,
    axis: usize,
    sign: f64,
    /// Line of the greatest signed coordinate of all outlines.
    edge: Edge,
    /// Outlines that reach this signed coordinate are clipped; `None`: those with a straight run at the extreme.
    level: Option<f64>,
}

impl Borders {
    /// A border is known where a file has the size of its images: outlines of its outermost pixels are clipped. Otherwise it is the extreme
    /// coordinate of all outlines if one of two things is seen there.
    ///
    /// 1. Straight runs in at least 5 frames: see [`run`].
    /// 2. Extremes that coincide: of the outlines whose extreme lies within 5 % of the radius of that of all,
    ///    75 % and at least 8 lie in a band of 1 % (evenly spread ones: 20 %; where a path turns back: 45 %), while from frame to frame
    ///    extremes move by more than half the band (median), and while outlines stay in the band, for 5 frames
    ///    and more, their centroids move at least twice as far from frame to frame as their extremes (median): what is cut off changes
    ///    and the line does not. A cell that rests takes its extreme with it; so does one that turns back, and one that comes
    ///    back to the same places (a circle of 10 frames a turn) does not stay.
    pub(super) fn find(tracks: &Tracks) -> Self {
        let edges: Vec<Edge> = SIDES.iter().map(|&(_, axis, sign)| edge(tracks, axis, sign)).collect();
        let lines = SIDES.iter().zip(&edges).filter_map(|(&side, &edge)| line(tracks, side, edge, &edges));
        Self { lines: lines.collect(), edges }
    }

    /// The borders that this outline is clipped at.
    pub(super) fn flags(&self, points: &[[f64; 2]]) -> Vec<Flag> {
        self.lines.iter().filter_map(|line| line.flag(points, &self.edges)).collect()
    }
}

impl Line {
    fn flag(&self, points: &[[f64; 2]], edges: &[Edge]) -> Option<Flag> {
        let own = reach(points, self.axis, self.sign)?;
        let found = run(points, self.edge, edges);
        let clipped = self.level.map_or(found.1, |level| own >= level || found.1);
        clipped.then_some(Flag::Clipped { side: self.side, at: self.sign * own, run: found.0 })
    }
}

/// Outlines that enclose something.
fn outlines(tracks: &Tracks) -> impl Iterator<Item = &Outline> {
    tracks.cells.iter().flat_map(|cell| &cell.frames).filter(|outline| outline.points.len() > 2)
}

fn edge(tracks: &Tracks, axis: usize, sign: f64) -> Edge {
    let reaches = outlines(tracks).filter_map(|outline| reach(&outline.points, axis, sign));
    Edge::of_axis(axis, sign, reaches.fold(f64::NEG_INFINITY, f64::max))
}

fn line(tracks: &Tracks, (side, axis, sign): (Side, usize, f64), edge: Edge, edges: &[Edge]) -> Option<Line> {
    let level = |level| Some(Line { side, axis, sign, edge, level });
    if let Some(image) = tracks.image {
        // coordinates count from the corner or from the middle of the first pixel: an outline of its edge lies at 0 or -1/2
        let [near, far] = [0.25, image.size[axis] / image.pixel - 0.75];
        return level(Some(if sign > 0.0 { far * image.pixel } else { -near * image.pixel }));
    }
    if let Some(found) = coincidence(tracks, axis, sign, edge.level) {
        return level(Some(found));
    }
    let straight = |outline: &&Outline| run(&outline.points, edge, edges).1;
    if outlines(tracks).filter(straight).count() >= FRAMES { level(None) } else { None }
}

/// The lower end of the band in which extremes coincide.
fn coincidence(tracks: &Tracks, axis: usize, sign: f64, extreme: f64) -> Option<f64> {
    let radius = median(outlines(tracks).map(|outline| (area(&outline.points).abs() / PI).sqrt()))?;
    // extreme and centroid of each outline, cell by cell
    let of = |o: &Outline| Some([reach(&o.points, axis, sign)?, centroid(&o.points)[axis]]);
    let all: Vec<Vec<[f64; 2]>> =
        tracks.cells.iter().map(|cell| cell.frames.iter().filter_map(of).collect()).collect();
    let pairs = || all.iter().flat_map(|cell| cell.windows(2));
    if median(pairs().map(|pair| (pair[1][0] - pair[0][0]).abs()))? <= 0.5 * BAND * radius {
        return None; // at rest extremes coincide by themselves
    }
    let reaches = all.iter().flatten().map(|at| at[0]);
    let mut near: Vec<f64> = reaches.filter(|reach| extreme - reach <= NEAR * radius).collect();
    ascending(&mut near);
    let within = |from: f64, reach: f64| (from..=from + BAND * radius).contains(&reach);
    let count = |from: f64| near.iter().filter(|reach| within(from, **reach)).count();
    let (count, from) = near.iter().map(|&from| (count(from), from)).max_by_key(|found| found.0)?;
    if count < COINCIDE || (count as f64) < SHARE * near.len() as f64 {
        return None;
    }
    let stays = all.iter().flat_map(|cell| cell.chunk_by(|a, b| within(from, a[0]) == within(from, b[0])));
    let stays = stays.filter(|stay| stay.len() >= FRAMES && within(from, stay[0][0]));
    let moved: Vec<[f64; 2]> = stays
        .flat_map(|stay| stay.windows(2))
        .map(|pair| [0, 1].map(|k| (pair[1][k] - pair[0][k]).abs()))
        .collect();
    let [extremes, centroids] = [0, 1].map(|k| median(moved.iter().map(|step| step[k])));
    (centroids? > CUT * extremes?).then_some(from)
}

/// Greatest signed coordinate.
fn reach(points: &[[f64; 2]], axis: usize, sign: f64) -> Option<f64> {
    points.iter().map(|point| sign * point[axis]).max_by(f64::total_cmp)
}
