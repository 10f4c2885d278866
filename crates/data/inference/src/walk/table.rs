//! The likelihood of persistent random walks on a grid that narrows, and its profiles.

use super::filter::{Sums, sums};
use super::{Bounded, Fix};
use std::f64::consts::LN_10;

/// Log-likelihood below the maximum that the last grid reaches.
const REACH: f64 = 6.0;
/// Points of the first grid, per decade, and of the later ones, along each side.
const COARSE: f64 = 3.0;
const FINE: [usize; 2] = [21, 17];
/// Rounds of narrowing at most.
const ROUNDS: usize = 4;
/// Persistence times that are looked at: from this part of the shortest interval to this multiple of the longest piece.
const ENDS: (f64, f64) = (0.03, 30.0);
/// Decades of the variance of an error relative to the mean square displacement of a coordinate in an
/// interval; beside them no error at all.
const ERRORS: (f64, f64) = (-3.0, 4.0);

/// The last step of the logarithm of the persistence time.
const CLOSE: f64 = 1e-6;

/// The quantity that an interval is computed for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Known {
    Persistence,
    Speed,
    Diffusion,
    Error,
}

/// A walk of the grid: persistence time, variance of the error relative to that of the velocity, and its sums.
#[derive(Debug, Clone, Copy)]
struct Entry {
    persistence: f64,
    error: f64,
    sums: Sums,
}

impl Entry {
    fn highest(&self) -> f64 {
        self.sums.log_likelihood(self.sums.scale())
    }

    fn value(&self, known: Known) -> f64 {
        self.value_at(known, self.sums.scale())
    }

    /// The value where the velocity has this variance in each coordinate.
    fn value_at(&self, known: Known, variance: f64) -> f64 {
        match known {
            Known::Persistence => self.persistence,
            Known::Speed => (2.0 * variance).sqrt(),
            Known::Diffusion => variance * self.persistence,
            Known::Error => (variance * self.error).sqrt(),
        }
    }
}

/// The walks of the last grid.
pub(super) struct Table {
    entries: Vec<Entry>,
    best: Entry,
}

impl Table {
    /// `None` where no walk has a likelihood.
    pub(super) fn of(pieces: &[Vec<Fix>]) -> Option<Self> {
        let gaps = pieces.iter().flat_map(|piece| piece.windows(2).map(|pair| pair[1].t - pair[0].t));
        let interval = gaps.filter(|gap| *gap > 0.0).fold(f64::INFINITY, f64::min);
        let span = |piece: &Vec<Fix>| Some(piece.last()?.t - piece.first()?.t);
        let longest = pieces.iter().filter_map(span).fold(0.0, f64::max);
        if !(interval.is_finite() && longest > 0.0) {
            return None;
        }
        let ends = [ENDS.0 * interval, ENDS.1 * longest].map(libm::log);
        let decades = ((ends[1] - ends[0]) / LN_10 * COARSE).ceil() as usize;
        let errors = ((ERRORS.1 - ERRORS.0) * 0.5 * COARSE).ceil() as usize;
        let mut area = [ends, [ERRORS.0 * LN_10, ERRORS.1 * LN_10]];
        let mut size = [decades + 1, errors + 1];
        let mut entries = Vec::new();
        for _ in 0..ROUNDS {
            entries = grid(pieces, interval, area, size);
            let narrow = narrowed(&entries, interval, area, size)?;
            let shrunk = (0..2).any(|k| narrow[k][1] - narrow[k][0] < 0.5 * (area[k][1] - area[k][0]));
            (area, size) = (narrow, FINE);
            if !shrunk {
                break;
            }
        }
        let best = *entries.iter().max_by(|a, b| a.highest().total_cmp(&b.highest()))?;
        if !best.highest().is_finite() {
            return None;
        }
        let steps = [0, 1].map(|k| (area[k][1] - area[k][0]) / (size[k] - 1) as f64);
        let best = refined(pieces, interval, (best, steps), ends);
        entries.push(best);
        Some(Self { entries, best })
    }

    pub(super) fn highest(&self) -> f64 {
        self.best.highest()
    }

    /// Persistence time and relative variance of the error of highest likelihood.
    pub(super) fn best(&self) -> [f64; 2] {
        [self.best.persistence, self.best.error]
    }

    /// The value of highest likelihood with the ends of its interval: where the profile of the likelihood is
    /// [`drop`] below its maximum; `None` where what was looked at ends before.
    ///
    /// The profile is the upper concave hull of the likelihoods of all walks of the grid, each at its own
    /// value and at others that other variances of its velocity give.
    pub(super) fn bounded(&self, known: Known) -> Bounded {
        let value = self.best.value(known);
        let hull = hull(self.points(known));
        let level = self.highest() - drop(self.best.sums.count);
        let crossing = |a: &[f64; 2], b: &[f64; 2]| a[0] + (b[0] - a[0]) * (level - a[1]) / (b[1] - a[1]);
        let first = hull.iter().position(|point| point[1] > level).unwrap_or(0);
        let last = hull.iter().rposition(|point| point[1] > level).unwrap_or(hull.len() - 1);
        let low = (first > 0).then(|| known.value(crossing(&hull[first - 1], &hull[first])));
        let high = (last + 1 < hull.len()).then(|| known.value(crossing(&hull[last + 1], &hull[last])));
        let none = known == Known::Error && first == 0;
        Bounded {
            value,
            low: if none { Some(0.0) } else { low.map(|low| low.min(value)) },
            high: high.map(|high| high.max(value)),
        }
    }

    /// Coordinate and log-likelihood of walks: of each of the grid at its best variance of the velocity and at others.
    fn points(&self, known: Known) -> Vec<[f64; 2]> {
        let unit = (2.0 / self.best.sums.count).sqrt();
        let steps = if known == Known::Persistence { 0..=0 } else { -5..=5 };
        let mut points = Vec::new();
        for entry in &self.entries {
            let variance = entry.sums.scale();
            for step in steps.clone() {
                let other = variance * libm::exp(0.7 * unit * f64::from(step));
                points
                    .push([known.coordinate(entry.value_at(known, other)), entry.sums.log_likelihood(other)]);
            }
        }
        points.retain(|point| point[0].is_finite() && point[1].is_finite());
        points
    }
}

impl Known {
    /// Intervals are looked for on logarithms, those of an error, which may be 0, on itself.
    fn coordinate(self, value: f64) -> f64 {
        if self == Self::Error { value } else { libm::log(value) }
    }

    fn value(self, coordinate: f64) -> f64 {
        if self == Self::Error { coordinate.max(0.0) } else { libm::exp(coordinate) }
    }
}

/// The fall of the log-likelihood at the end of a 95 % interval: (n/2) ln(1 + t^2/(n - 3)) with Student's t,
/// exact for a normal mean with three other numbers; 1.92 for large n.
fn drop(count: f64) -> f64 {
    const NORMAL: f64 = 1.959_963_984_540_054;
    let freedom = (count - 3.0).max(1.0);
    let t = NORMAL + (NORMAL * NORMAL * NORMAL + NORMAL) / (4.0 * freedom);
    0.5 * count * libm::log1p(t * t / freedom)
}

/// The upper concave hull, from left to right.
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for c in points {
        while let [.., a, b] = kept[..]
            && (b[0] - a[0]) * (c[1] - a[1]) >= (b[1] - a[1]) * (c[0] - a[0])
        {
            kept.pop();
        }
        if kept.last().is_some_and(|last| last[0] == c[0] && last[1] <= c[1]) {
            kept.pop();
        }
        kept.push(c);
    }
    kept
}

/// The walk of highest likelihood near the best one of a grid: from it in steps along each side, halved where none leads higher. An
/// error of 0 stays 0.
fn refined(
    pieces: &[Vec<Fix>],
    interval: f64,
    (mut best, mut steps): (Entry, [f64; 2]),
    ends: [f64; 2],
) -> Entry {
    let entry = |[time, error]: [f64; 2]| {
        let persistence = libm::exp(time);
        let error = libm::exp(error) * step_variance(persistence, interval); // exp(-inf) = 0: no error
        Entry { persistence, error, sums: sums(pieces, persistence, error) }
    };
    let relative = libm::log(best.error / step_variance(best.persistence, interval));
    let mut at = [libm::log(best.persistence), relative];
    let reach = [ends, [ERRORS.0 * LN_10, ERRORS.1 * LN_10]];
    let sides = if best.error > 0.0 { 2 } else { 1 };
    while steps[0] > CLOSE {
        let tried = (0..sides).flat_map(|side| [-1.0, 1.0].map(|sign| (side, sign))).map(|(side, sign)| {
            let mut other = at;
            other[side] = (at[side] + sign * steps[side]).clamp(reach[side][0], reach[side][1]);
            (entry(other), other)
        });
        match tried.max_by(|a, b| a.0.highest().total_cmp(&b.0.highest())) {
            Some((higher, place)) if higher.highest() > best.highest() => (best, at) = (higher, place),
            _ => steps = steps.map(|step| 0.5 * step),
        }
    }
    best
}

/// Points of a side.
fn side([from, to]: [f64; 2], count: usize) -> impl Iterator<Item = f64> + Clone {
    (0..count).map(move |k| from + (to - from) * k as f64 / (count - 1) as f64)
}

/// All walks of a grid, by persistence time; the first of each has no error where the grid begins at the least one.
fn grid(pieces: &[Vec<Fix>], interval: f64, area: [[f64; 2]; 2], size: [usize; 2]) -> Vec<Entry> {
    let without = area[1][0] <= ERRORS.0 * LN_10;
    let mut entries = Vec::with_capacity(size[0] * (size[1] + 1));
    for persistence in side(area[0], size[0]).map(libm::exp) {
        let unit = step_variance(persistence, interval);
        let errors = without.then_some(0.0).into_iter().chain(side(area[1], size[1]).map(libm::exp));
        for error in errors.map(|relative| relative * unit) {
            entries.push(Entry { persistence, error, sums: sums(pieces, persistence, error) });
        }
    }
    entries
}

/// Mean square displacement of a coordinate in an interval, of a walk whose velocity has unit variance.
fn step_variance(persistence: f64, interval: f64) -> f64 {
    let h = interval / persistence;
    // h - 1 + e^-h, whose series is taken where it cancels
    let rise = if h < 1e-3 { 0.5 * h * h * (1.0 - h / 3.0) } else { h + libm::expm1(-h) };
    2.0 * persistence * persistence * rise
}

/// The part of the area whose likelihood is within reach of the maximum, one step wider on each side.
fn narrowed(
    entries: &[Entry],
    interval: f64,
    area: [[f64; 2]; 2],
    size: [usize; 2],
) -> Option<[[f64; 2]; 2]> {
    let highest = entries.iter().map(Entry::highest).filter(|l| l.is_finite()).reduce(f64::max)?;
    let step = [0, 1].map(|k| (area[k][1] - area[k][0]) / (size[k] - 1) as f64);
    let mut found = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    for entry in entries.iter().filter(|entry| entry.highest() > highest - REACH) {
        let relative = libm::log(entry.error / step_variance(entry.persistence, interval));
        for (side, at) in found.iter_mut().zip([libm::log(entry.persistence), relative.max(area[1][0])]) {
            *side = [side[0].min(at), side[1].max(at)];
        }
    }
    Some([0, 1].map(|k| [(found[k][0] - step[k]).max(area[k][0]), (found[k][1] + step[k]).min(area[k][1])]))
}
