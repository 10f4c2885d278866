//! Places of all cells on the grid of the frames.

use super::StageJump;
use motiform_tracks::modes::{CellModes, Flag, FrameModes};
use std::collections::BTreeMap;

/// Most entries of the grid: they are held in memory.
const MOST: usize = 50_000_000;

/// Centroids of all cells, at all frames from the first to the last one.
pub(super) struct Grid {
    /// Number of the first frame, and the step between frames.
    first: i64,
    step: i64,
    /// Times of the frames; those of frames without outlines are interpolated.
    pub(super) times: Vec<f64>,
    /// Each cell's place in each frame, where it is seen.
    pub(super) places: Vec<Vec<Option<[f64; 2]>>>,
    /// Frames to which no displacement of a cell can be taken, other than by the stage: another cell, or another unit.
    parts: Vec<Vec<usize>>,
}

impl Grid {
    /// `None` without a cell that is seen in two frames.
    pub(super) fn of(cells: &[CellModes]) -> Option<Self> {
        let all = || cells.iter().flat_map(|cell| &cell.frames).filter(|frame| is_placed(frame));
        let (first, last) = (all().map(|one| one.frame).min()?, all().map(|one| one.frame).max()?);
        let step = usual_step(cells);
        let size = usize::try_from((last - first) / step).ok()? + 1;
        if size < 2 || size.saturating_mul(cells.len()) > MOST {
            return None;
        }
        let mut grid = Self { first, step, times: Vec::new(), places: Vec::new(), parts: Vec::new() };
        let mut times = vec![None; size];
        for cell in cells {
            let (mut places, mut parts) = (vec![None; size], Vec::new());
            for frame in &cell.frames {
                let Some(k) = grid.place(frame.frame).filter(|k| *k < size) else { continue };
                if frame.flags.iter().any(|flag| flag.parts() && !matches!(flag, Flag::StageJump { .. })) {
                    parts.push(k);
                }
                if is_placed(frame) {
                    places[k] = Some(frame.centroid);
                    times[k] = Some(frame.t);
                }
            }
            if places.iter().flatten().count() > 1 {
                grid.places.push(places);
                grid.parts.push(parts);
            }
        }
        grid.times = filled(&times);
        (!grid.places.is_empty()).then_some(grid)
    }

    /// Where a frame is; `None` before the first one, and between the steps.
    pub(super) fn place(&self, frame: i64) -> Option<usize> {
        let from = frame - self.first;
        if from % self.step == 0 { usize::try_from(from / self.step).ok() } else { None }
    }

    /// The number of the frame at a place.
    pub(super) fn frame(&self, place: usize) -> i64 {
        let place = i64::try_from(place).unwrap_or(i64::MAX); // places are indices of a list in memory
        self.first.saturating_add(self.step.saturating_mul(place))
    }

    pub(super) fn cells(&self) -> usize {
        self.places.len()
    }

    /// Displacement of a cell to this frame from the one before, if both are seen and nothing parts them.
    pub(super) fn displacement(&self, cell: usize, k: usize) -> Option<[f64; 2]> {
        let before = self.places[cell].get(k.checked_sub(1)?).copied()??;
        let here = self.places[cell].get(k).copied()??;
        (!self.parts[cell].contains(&k)).then(|| [0, 1].map(|i| here[i] - before[i]))
    }

    /// Takes the jumps of the stage out of all places.
    pub(super) fn subtract_jumps(&mut self, jumps: &[StageJump]) {
        for jump in jumps {
            let Some(from) = self.place(jump.frame) else { continue };
            let later = self.places.iter_mut().flat_map(|places| &mut places[from..]).flatten();
            later.for_each(|place| *place = [0, 1].map(|i| place[i] - jump.displacement[i]));
        }
    }

    /// Mean velocity of a cell from this frame on, over the pieces that nothing parts.
    pub(super) fn mean_velocity(&self, cell: usize, from: usize) -> Option<[f64; 2]> {
        let (mut moved, mut time) = ([0.0; 2], 0.0);
        let mut last: Option<(usize, [f64; 2])> = None;
        for (k, place) in self.places[cell].iter().enumerate().skip(from) {
            if self.parts[cell].contains(&k) {
                last = None;
            }
            let Some(here) = *place else { continue };
            if let Some((before, there)) = last {
                moved = [0, 1].map(|i| moved[i] + here[i] - there[i]);
                time += self.times[k] - self.times[before];
            }
            last = Some((k, here));
        }
        (time > 0.0).then(|| moved.map(|x| x / time))
    }
}

/// `true` if the place of an outline is that of the cell on the images, also where the stage was elsewhere for a moment.
fn is_placed(frame: &FrameModes) -> bool {
    frame.is_seen_but(|flag| matches!(flag, Flag::PositionJump { .. }))
}

/// The most frequent step between frames of a cell, the least of equally frequent ones.
fn usual_step(cells: &[CellModes]) -> i64 {
    let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
    for pair in cells.iter().flat_map(|cell| cell.frames.windows(2)) {
        *counts.entry(pair[1].frame - pair[0].frame).or_insert(0) += 1;
    }
    let most = counts.into_iter().fold((1, 0), |best, found| if found.1 > best.1 { found } else { best });
    most.0.max(1)
}

/// Times of all frames: those that are not known lie evenly between their neighbours.
fn filled(times: &[Option<f64>]) -> Vec<f64> {
    let known: Vec<(usize, f64)> =
        times.iter().enumerate().filter_map(|(k, time)| Some((k, (*time)?))).collect();
    let mut filled = Vec::with_capacity(times.len());
    for pair in known.windows(2) {
        let ((a, from), (b, to)) = (pair[0], pair[1]);
        filled.extend((a..b).map(|k| from + (to - from) * (k - a) as f64 / (b - a) as f64));
    }
    filled.extend(known.last().map(|last| last.1));
    filled
}
