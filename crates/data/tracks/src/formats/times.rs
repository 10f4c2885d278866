//! Frames of a table from its columns of frames and times.

use super::clock::Clock;
use crate::numbering::{median_difference, numbers};
use crate::{Cell, Error, Note, Place, Result};
use motiform_dynamics::sample::median;
use std::collections::{BTreeMap, BTreeSet};

/// Share of the steps of cells that are those between the times of all of them, below which cells are seen at times of their own.
const COMMON: f64 = 0.1;

/// Longest such step, in intervals.
const ONE: f64 = 1.5;

/// Part of an interval by which cells may be seen later than the first one, beyond half of it.
const LATER: f64 = 0.4;

/// Frames and times of the rows of a table.
///
/// While rows are read a frame is known by a key that is in the order of its value. At the end values that
/// are whole numbers of a column of frames are the frames; others are times, and frames are counted in their
/// intervals.
pub(super) struct Times {
    /// `true` if the column of frames was named by an option: then its values are frames.
    named: bool,
    /// The values of frames, or times where there are none.
    values: BTreeMap<i64, f64>,
    /// The time of each frame, where there are both.
    times: BTreeMap<i64, f64>,
    /// `true` if there is a column of frames.
    framed: bool,
    /// The first frame that is no whole number.
    fraction: Option<(Place, f64)>,
    /// The key of the row before: rows of a frame follow one another.
    last: Option<i64>,
}

impl Times {
    pub(super) fn new(named: bool) -> Self {
        Self {
            named,
            values: BTreeMap::new(),
            times: BTreeMap::new(),
            framed: true,
            fraction: None,
            last: None,
        }
    }

    /// The key of a row.
    ///
    /// # Errors
    /// Values that are not finite, and fractions in a column of frames that was named as such.
    pub(super) fn frame(&mut self, frame: Option<f64>, time: Option<f64>, place: &Place) -> Result<i64> {
        self.framed = frame.is_some();
        let (value, what) = match frame {
            Some(frame) => (frame, "frame"),
            None => (time.unwrap_or(f64::NAN), "time"),
        };
        let sound = value.is_finite() && value.abs() < 9.0e15 && (!self.named || value == value.trunc());
        if !sound {
            let expected = if self.named { "a whole number" } else { "a number" };
            return Err(Error::structure(place, format!("{what} is {value}"), expected));
        }
        if frame.is_some() && value != value.trunc() && self.fraction.is_none() {
            self.fraction = Some((place.clone(), value));
        }
        let key = key(value);
        if self.last != Some(key) {
            self.values.insert(key, value);
            self.last = Some(key);
        }
        if let (Some(_), Some(time)) = (frame, time.filter(|time| time.is_finite())) {
            self.times.entry(key).or_insert(time);
        }
        Ok(key)
    }

    /// The interval of the times: where these stand for frames, and beside a column of frames the median time per frame.
    pub(super) fn interval(&self, cells: &[Cell]) -> Option<f64> {
        if !self.framed {
            return self.own(cells).or_else(|| median_difference(&self.in_order(self.values.keys())));
        }
        let both: Vec<[f64; 2]> =
            self.times.iter().filter_map(|(key, time)| Some([*self.values.get(key)?, *time])).collect();
        median(both.windows(2).map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0])))
    }

    /// The values of keys in their order.
    fn in_order<'k>(&self, keys: impl Iterator<Item = &'k i64>) -> Vec<f64> {
        keys.filter_map(|key| self.values.get(key).copied()).collect()
    }

    /// The interval of the cells where each is seen at times of its own, as those of several positions of the stage in turn: hardly any of
    /// their steps is that between the times of all cells. `None` where they share their times.
    fn own(&self, cells: &[Cell]) -> Option<f64> {
        let between = median_difference(&self.in_order(self.values.keys())).filter(|_| !self.framed)?;
        let times = |cell: &Cell| self.in_order(cell.frames.iter().map(|outline| &outline.frame));
        let steps = |times: Vec<f64>| times.windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<f64>>();
        let steps: Vec<f64> = cells.iter().flat_map(|cell| steps(times(cell))).collect();
        let common = steps.iter().filter(|step| **step < ONE * between).count();
        if common as f64 >= COMMON * steps.len() as f64 { None } else { median(steps) }
    }

    /// Takes the times of an even clock for stamps that are rounded from it: its interval, and the unit of the stamps. `None` where they
    /// stay as they are: without fractions numbers that stand for frames are counts, and cells with times of their own have no clock.
    pub(super) fn even_clock(&mut self, cells: &[Cell]) -> Option<[f64; 2]> {
        let (stamps, frames): (Vec<f64>, Option<Vec<f64>>) = if self.framed {
            let both = self.times.iter().filter_map(|(key, time)| Some((*time, *self.values.get(key)?)));
            let (times, frames): (Vec<f64>, Vec<f64>) = both.unzip();
            (times, Some(frames))
        } else {
            (self.values.values().copied().collect(), None)
        };
        let whole = stamps.iter().all(|value| *value == value.trunc());
        if !self.framed && whole || self.framed && self.fraction.is_some() || self.own(cells).is_some() {
            return None;
        }
        let clock = Clock::of(&stamps, frames.as_deref())?;
        let own = if self.framed { &mut self.times } else { &mut self.values };
        own.values_mut().zip(clock.times).for_each(|(time, even)| *time = even);
        Some([clock.interval, clock.unit])
    }

    /// Returns `true` if a column of times beside one of frames only repeats these.
    pub(super) fn repeats_frames(&self) -> bool {
        self.framed && self.times.iter().all(|(key, time)| self.values.get(key) == Some(time))
    }

    /// Leaves out the times beside a column of frames.
    pub(super) fn forget(&mut self) {
        self.times.clear();
    }

    /// The same error with the frame instead of its key.
    pub(super) fn in_words(&self, error: Error) -> Error {
        match error {
            Error::MixedCells { file, name, conflicts, frames, first, remedy } => {
                let first = self.values.get(&first).map_or(first, |value| value.round() as i64);
                Error::MixedCells { file, name, conflicts, frames, first, remedy }
            }
            other => other,
        }
    }

    /// Gives every outline its frame and, where times are known, its time; whether times are. `as_times`:
    /// whole values without a column of frames are times, not counts.
    ///
    /// # Errors
    /// Frames that are no whole numbers, and are not evenly spaced either.
    pub(super) fn apply(self, cells: &mut [Cell], notes: &mut [Note], as_times: bool) -> Result<bool> {
        if let Some((place, value)) = self.fraction.as_ref().filter(|_| !self.even()) {
            let expected = "a whole number (or at least three evenly spaced ones)";
            return Err(Error::structure(place, format!("frame is {value}"), expected));
        }
        let whole = self.values.values().all(|value| *value == value.trunc());
        let interval = self.interval(cells);
        let count = whole && (self.framed || interval == Some(1.0));
        let timed = if self.framed { !self.times.is_empty() } else { as_times || !count };
        let between = || median_difference(&self.in_order(self.values.keys()));
        let interval = if self.framed { between() } else { interval };
        let all = (!count).then(|| self.counted(self.values.keys(), interval, 0.0));
        let first = self.values.values().next().copied().unwrap_or(0.0);
        // cells that follow the first one within an interval have its frames
        let phase = |interval: f64| first + (LATER - (first / interval).round()) * interval;
        let phase = self.own(cells).map(phase);
        for cell in cells {
            let keys = cell.frames.iter().map(|outline| &outline.frame);
            let counted = phase.map(|phase| self.counted(keys, interval, phase));
            let frame = |key: &i64| match counted.as_ref().or(all.as_ref()) {
                Some(counted) => counted.get(key).or_else(|| all.as_ref()?.get(key)).copied().unwrap_or(*key),
                None => self.values.get(key).map_or(*key, |value| *value as i64),
            };
            for outline in &mut cell.frames {
                let key = outline.frame;
                let value = self.values.get(&key).copied().unwrap_or(0.0);
                outline.t = self.times.get(&key).copied().unwrap_or(value);
                outline.frame = frame(&key);
            }
            for note in notes.iter_mut() {
                if let Note::SameFrameTwice { cell: of, frames }
                | Note::ConflictingFrames { cell: of, frames }
                | Note::MissingVertices { cell: of, frames } = note
                    && *of == cell.name
                {
                    frames.iter_mut().for_each(|key| *key = frame(key));
                }
            }
        }
        Ok(timed)
    }

    /// Returns `true` if there are at least three values, in steps of one interval.
    fn even(&self) -> bool {
        let values: Vec<f64> = self.values.values().copied().collect();
        values.len() > 2 && numbers(&values, median_difference(&values)).is_some()
    }

    /// Frames counted in the interval, from a time on; in order where the times are no multiples of it.
    fn counted<'k>(
        &self,
        keys: impl Iterator<Item = &'k i64> + Clone,
        interval: Option<f64>,
        from: f64,
    ) -> BTreeMap<i64, i64> {
        let values: Vec<f64> = self.in_order(keys.clone()).into_iter().map(|value| value - from).collect();
        let in_order = || (0..).take(values.len()).collect();
        let found: Vec<i64> = numbers(&values, interval).unwrap_or_else(in_order);
        // two values that are counted as one frame would be one outline
        let apart = found.iter().collect::<BTreeSet<_>>().len() == found.len();
        let found = if apart { found } else { in_order() };
        keys.copied().zip(found).collect()
    }
}

/// A whole number in the order of the value.
fn key(value: f64) -> i64 {
    let bits = (value + 0.0).to_bits().cast_signed();
    if bits < 0 { -(bits & i64::MAX) } else { bits }
}
