//! The likelihood of persistent random walks along its ridge, and its profiles.

use super::filter::Law;
use super::ridge::{Entry, Places};
use super::{Bounded, Fix};
use motiform_dynamics::distributions::NORMAL_95;
use std::f64::consts::LN_10;

/// Log-likelihood below the maximum that walks are looked for.
const REACH: f64 = 6.0;
/// Persistence times of the first round, per decade, and of the later ones.
const COARSE: f64 = 3.0;
const FINE: usize = 25;
/// Rounds of narrowing at most.
const ROUNDS: usize = 4;
/// Persistence times that are looked at: from this part of the shortest interval to this multiple of the longest piece.
const ENDS: (f64, f64) = (0.03, 30.0);

/// The last step of the logarithm of the persistence time.
const CLOSE: f64 = 1e-6;

/// The least gain of log-likelihood of a step: of steps without a memory P and S move together without end.
const GAIN: f64 = 1e-8;
/// The first step from a walk nearby.
const NEARBY: f64 = 0.2;

/// The quantity that an interval is computed for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Known {
    Persistence,
    Speed,
    Diffusion,
    /// The variance of the error of a coordinate.
    Error,
}

/// The value of a walk where the velocity has this variance in each coordinate.
fn value_at(walk: &Entry, known: Known, variance: f64) -> f64 {
    match known {
        Known::Persistence => walk.law.persistence,
        Known::Speed => (2.0 * variance).sqrt(),
        Known::Diffusion => variance * walk.law.persistence,
        Known::Error => variance * walk.law.error,
    }
}

/// The walks around the ridge of the likelihood: at each of some persistence times the error of highest likelihood, and errors around it.
/// The ridge is narrow where errors are small: a grid of fixed errors would pass it by.
pub(super) struct Table {
    entries: Vec<Entry>,
    best: Entry,
    /// The likelihood of errors alone: of the largest error and the shortest persistence time in the table.
    still: f64,
}

impl Table {
    /// `None` where no walk has a likelihood.
    pub(super) fn of(pieces: &[Vec<Fix>]) -> Option<Self> {
        let (interval, ends) = times(pieces)?;
        let places = Places { pieces, interval };
        let (ridge, step) = ridge(&places, ends)?;
        let best = *ridge.iter().max_by(|a, b| a.highest().total_cmp(&b.highest()))?;
        let best = refined(&places, best, step, ends);
        let least = best.highest() - REACH;
        let mut entries: Vec<Entry> = ridge.iter().flat_map(|walk| places.around(walk, least)).collect();
        entries.extend(ridge);
        entries.push(best);
        let still = places.walk([ends[0], Places::errors()[1]]).highest();
        Some(Self { entries, best, still })
    }

    /// `true` if the likelihood of errors alone is within that of the intervals.
    pub(super) fn rests(&self) -> bool {
        self.still > self.level()
    }

    /// The log-likelihood at the ends of intervals.
    fn level(&self) -> f64 {
        self.highest() - drop(self.best.sums.count)
    }

    pub(super) fn highest(&self) -> f64 {
        self.best.highest()
    }

    /// The walk of highest likelihood.
    pub(super) fn best(&self) -> &Entry {
        &self.best
    }

    /// The value of highest likelihood with the ends of its interval: where the profile of the likelihood is
    /// [`drop`] below its maximum; `None` where what was looked at ends before.
    ///
    /// The profile is the upper concave hull of the likelihoods of all walks of the table, each at its own
    /// value and at others that other variances of its velocity give.
    pub(super) fn bounded(&self, known: Known) -> Bounded {
        let value = value_at(&self.best, known, self.best.sums.scale());
        let hull = hull(self.points(known));
        let level = self.level();
        let crossing = |a: &[f64; 2], b: &[f64; 2]| a[0] + (b[0] - a[0]) * (level - a[1]) / (b[1] - a[1]);
        let first = hull.iter().position(|point| point[1] > level).unwrap_or(0);
        let last = hull.iter().rposition(|point| point[1] > level).unwrap_or(hull.len() - 1);
        let low = (first > 0).then(|| known.value(crossing(&hull[first - 1], &hull[first])));
        let high = (last + 1 < hull.len()).then(|| known.value(crossing(&hull[last + 1], &hull[last])));
        // the smallest errors that any path has are among those that were looked at
        let least = (known == Known::Error && first == 0).then(|| hull[0][0]);
        Bounded {
            value,
            low: low.or(least).map(|low| low.min(value)),
            high: high.map(|high| high.max(value)),
        }
    }

    /// Coordinate and log-likelihood of walks: of each at its best variance of the velocity and at others.
    fn points(&self, known: Known) -> Vec<[f64; 2]> {
        let unit = (2.0 / self.best.sums.count).sqrt();
        let steps = if known == Known::Persistence { 0..=0 } else { -5..=5 };
        let mut points = Vec::new();
        for entry in &self.entries {
            let variance = entry.sums.scale();
            for step in steps.clone() {
                let other = variance * libm::exp(0.7 * unit * f64::from(step));
                points.push([
                    known.coordinate(value_at(entry, known, other)),
                    entry.sums.log_likelihood(other),
                ]);
            }
        }
        points.retain(|point| point[0].is_finite() && point[1].is_finite());
        points
    }
}

/// The shortest interval.
pub(super) fn shortest(pieces: &[Vec<Fix>]) -> f64 {
    let gaps = pieces.iter().flat_map(|piece| piece.windows(2).map(|pair| pair[1].t - pair[0].t));
    gaps.filter(|gap| *gap > 0.0).fold(f64::INFINITY, f64::min)
}

/// The shortest interval, and the logarithms of the shortest and the longest persistence time that are looked at.
fn times(pieces: &[Vec<Fix>]) -> Option<(f64, [f64; 2])> {
    let interval = shortest(pieces);
    let span = |piece: &Vec<Fix>| Some(piece.last()?.t - piece.first()?.t);
    let longest = pieces.iter().filter_map(span).fold(0.0, f64::max);
    let ends = [ENDS.0 * interval, ENDS.1 * longest].map(libm::log);
    (interval.is_finite() && longest > 0.0).then_some((interval, ends))
}

/// The walk of highest likelihood of all these pieces, searched from a given one, and `true` if its persistence is resolved: the shortest
/// persistence time of the table is less likely by more than the intervals allow.
pub(super) fn nearby(pieces: &[Vec<Fix>], persistence: f64, error: f64) -> Option<(Entry, bool)> {
    let (interval, ends) = times(pieces)?;
    let places = Places { pieces, interval };
    let least = Places::errors()[0];
    let at = [libm::log(persistence), places.relative(Law { persistence, error, diffusion: 0.0 }).max(least)];
    let best = refined(&places, places.walk(at), NEARBY, ends);
    let is_resolved = places.ridge(ends[0]).highest() < best.highest() - drop(best.sums.count);
    best.highest().is_finite().then_some((best, is_resolved))
}

impl Known {
    /// Intervals are looked for on logarithms, those of the variance of an error, which may be 0 or less, on itself.
    fn coordinate(self, value: f64) -> f64 {
        if self == Self::Error { value } else { libm::log(value) }
    }

    fn value(self, coordinate: f64) -> f64 {
        if self == Self::Error { coordinate } else { libm::exp(coordinate) }
    }
}

/// The fall of the log-likelihood at the end of a 95 % interval: (n/2) ln(1 + t^2/(n - 3)) with Student's t,
/// exact for a normal mean with three other numbers; 1.92 for large n.
fn drop(count: f64) -> f64 {
    let freedom = (count - 3.0).max(1.0);
    let t = NORMAL_95 + (NORMAL_95 * NORMAL_95 * NORMAL_95 + NORMAL_95) / (4.0 * freedom);
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

/// Walks along the ridge: those of highest likelihood at persistence times between these ends (logarithms) that are within reach of the
/// maximum, and their step. `None` where none has a likelihood.
fn ridge(places: &Places<'_>, ends: [f64; 2]) -> Option<(Vec<Entry>, f64)> {
    let (mut area, mut count) = (ends, ((ends[1] - ends[0]) / LN_10 * COARSE).ceil() as usize + 1);
    let mut walks: Vec<Entry> = Vec::new();
    let mut step = 0.0;
    for _ in 0..ROUNDS {
        step = (area[1] - area[0]) / (count - 1) as f64;
        walks = (0..count).map(|k| places.ridge(area[0] + step * k as f64)).collect();
        let highest = walks.iter().map(Entry::highest).filter(|l| l.is_finite()).reduce(f64::max)?;
        let within = || walks.iter().filter(|walk| walk.highest() > highest - REACH);
        let times = within().map(|walk| libm::log(walk.law.persistence));
        let found = times.fold([f64::INFINITY, f64::NEG_INFINITY], |f, t| [f[0].min(t), f[1].max(t)]);
        // one step wider, so that the profile falls below what is asked for unless the ends are in the way
        let narrow = [(found[0] - step).max(ends[0]), (found[1] + step).min(ends[1])];
        if narrow[1] - narrow[0] > 0.5 * (area[1] - area[0]) && count >= FINE {
            break;
        }
        (area, count) = (narrow, FINE);
    }
    Some((walks, step))
}

/// The walk of highest likelihood near this one: from it in steps along both sides, halved where none leads higher.
fn refined(places: &Places<'_>, mut best: Entry, step: f64, ends: [f64; 2]) -> Entry {
    let mut at = [libm::log(best.law.persistence), places.relative(best.law)];
    let reach = [ends, Places::errors()];
    let mut steps = [step, step];
    while steps[0] > CLOSE {
        let tried = (0..2_usize).flat_map(|side| [-1.0, 1.0].map(|sign| (side, sign))).map(|(side, sign)| {
            let mut other = at;
            other[side] = (at[side] + sign * steps[side]).clamp(reach[side][0], reach[side][1]);
            (places.walk(other), other)
        });
        match tried.max_by(|a, b| a.0.highest().total_cmp(&b.0.highest())) {
            Some((higher, place)) if higher.highest() > best.highest() + GAIN => (best, at) = (higher, place),
            _ => steps = steps.map(|step| 0.5 * step),
        }
    }
    best
}
