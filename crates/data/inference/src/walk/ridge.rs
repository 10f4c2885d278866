//! Walks of one persistence time: the error of highest likelihood, and others around it.

use super::filter::{Law, Sums, spread, sums};
use crate::Fix;

/// The error's variance relative to that of what is new in the displacement of a coordinate over an interval is `exp(u) - SMOOTH`.
/// Places that are means over the time of an exposure have displacements like those with a negative one: of a path without memory down to
/// -1/6, and beyond -1/4 there is no such path.
const SMOOTH: f64 = 0.26;
/// Smallest and largest relative variance that are looked at.
const ERRORS: [f64; 2] = [-0.255, 1e6];
/// Points at which the best error is looked for first: so many per unit of u.
const COARSE: f64 = 0.8;
/// Width to which it is enclosed then (of u).
const CLOSE: f64 = 0.01;
/// Walks on each side of the best one.
const SIDE: u32 = 8;

/// A walk and its sums.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    pub(super) law: Law,
    pub(super) sums: Sums,
}

impl Entry {
    pub(super) fn highest(&self) -> f64 {
        self.sums.log_likelihood(self.sums.scale())
    }
}

/// The record, and the shortest interval of it.
#[derive(Clone, Copy)]
pub(super) struct Places<'p> {
    pub(super) pieces: &'p [Vec<Fix>],
    pub(super) interval: f64,
}

impl Places<'_> {
    /// The walk of this logarithm of the persistence time and this u of the error.
    pub(super) fn walk(&self, [time, u]: [f64; 2]) -> Entry {
        let persistence = libm::exp(time);
        let error = (libm::exp(u) - SMOOTH) * step_variance(persistence, self.interval);
        let law = Law { persistence, error, diffusion: 0.0 };
        Entry { law, sums: sums(self.pieces, law) }
    }

    /// The u of the error of a walk.
    pub(super) fn relative(&self, law: Law) -> f64 {
        libm::log(law.error / step_variance(law.persistence, self.interval) + SMOOTH)
    }

    /// Smallest and largest u of an error.
    pub(super) fn errors() -> [f64; 2] {
        ERRORS.map(|relative| libm::log(relative + SMOOTH))
    }

    /// The walk of highest likelihood among those of this persistence time (its logarithm).
    pub(super) fn ridge(&self, time: f64) -> Entry {
        let [from, to] = Self::errors();
        let count = ((to - from) * COARSE).ceil() as usize;
        let step = (to - from) / count as f64;
        let at = |k: usize| from + step * k as f64;
        let all: Vec<Entry> = (0..=count).map(|k| self.walk([time, at(k)])).collect();
        let best =
            (0..=count).max_by(|&a, &b| all[a].highest().total_cmp(&all[b].highest())).unwrap_or_default();
        let enclosed = [at(best.saturating_sub(1)), at((best + 1).min(count))];
        higher(self.golden(time, enclosed), all[best])
    }

    /// The best walk between two errors, by sections of the golden ratio.
    fn golden(&self, time: f64, [mut low, mut high]: [f64; 2]) -> Entry {
        let part = 0.5 * (3.0 - libm::sqrt(5.0));
        let walk = |error: f64| (error, self.walk([time, error]));
        let mut inner = [walk(low + part * (high - low)), walk(high - part * (high - low))];
        while high - low > CLOSE {
            if inner[0].1.highest() > inner[1].1.highest() {
                high = inner[1].0;
                inner = [walk(low + part * (high - low)), inner[0]];
            } else {
                low = inner[0].0;
                inner = [inner[1], walk(high - part * (high - low))];
            }
        }
        higher(inner[0].1, inner[1].1)
    }

    /// Walks of the same persistence time with smaller and larger errors, down to this likelihood.
    pub(super) fn around(&self, best: &Entry, least: f64) -> Vec<Entry> {
        if best.highest() < least {
            return Vec::new();
        }
        let ends = Self::errors();
        let (time, middle) = (libm::log(best.law.persistence), self.relative(best.law));
        let mut walks = Vec::new();
        for (sign, end) in [(-1.0, ends[0]), (1.0, ends[1])] {
            let room = (end - middle).abs();
            let mut reach = 0.05_f64;
            while reach < room && self.walk([time, middle + sign * reach]).highest() > least {
                reach *= 2.0;
            }
            let step = reach.min(room) / f64::from(SIDE);
            if step > 0.0 {
                walks.extend((1..=SIDE).map(|k| self.walk([time, middle + sign * step * f64::from(k)])));
            }
        }
        walks
    }
}

/// The walk of higher likelihood.
fn higher(a: Entry, b: Entry) -> Entry {
    if b.highest() > a.highest() { b } else { a }
}

/// The variance of what is new in the displacement of a coordinate over an interval, of a walk whose velocity has unit variance. Relative
/// to it the error of highest likelihood hardly depends on the persistence time.
fn step_variance(persistence: f64, interval: f64) -> f64 {
    persistence * persistence * spread(interval / persistence)
}
