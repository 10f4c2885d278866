//! Mean-square displacement against lag, and its local exponent.

use crate::jackknife::{Sums, leave_out};
use crate::{Measured, Tracks};
use std::ops::Range;

/// Lags per decade.
const PER_DECADE: f64 = 16.0;

/// The local exponent at a lag is the slope to lags this many places away.
const REACH: usize = 3;

/// Mean-square displacement at logarithmically spaced lags, with what intervals are made of.
#[derive(Debug, Clone, PartialEq)]
pub struct MeanSquare {
    dt: f64,
    /// In samples, increasing.
    lags: Vec<usize>,
    sums: Vec<Sums>,
    groups: usize,
    /// `false` where groups depend on each other: points then have no intervals.
    with_intervals: bool,
}

/// A point of the curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DisplacementPoint {
    /// The lag (model time).
    pub lag: f64,
    /// <|r(t + lag) - r(t)|^2>.
    pub value: Measured,
    /// d ln MSD / d ln lag: 2 where ballistic, 1 where diffusive. `None` where nothing moved.
    pub exponent: Option<Measured>,
    /// Windows that were averaged, overlapping ones included.
    pub windows: f64,
}

/// Mean-square displacement: the mean over units and over all times t of |r(t + tau) - r(t)|^2.
///
/// Windows overlap; each has the same weight, so longer tracks count more. The sums are direct, which keeps
/// all digits: with Fourier transforms (Kneller 1995) short lags lose those by which positions exceed
/// displacements. Lags: about 16 per decade, up to half of the longest unit.
///
/// # Units     (model length)^2
/// # Checked by  tests/all/displacement.rs: Ornstein-Uhlenbeck, active Brownian (chiral and not), circle, line; Fourier sums
pub fn mean_square(tracks: &Tracks) -> MeanSquare {
    let lags = spaced(tracks.longest_lag());
    let sums = square_sums(tracks, &lags);
    MeanSquare { dt: tracks.dt(), sums, groups: tracks.groups(), lags, with_intervals: true }
}

/// A path on an even grid: NaN where no place is known.
#[derive(Clone, Copy)]
#[allow(missing_debug_implementations, reason = "a function has no text")]
pub struct PathPiece<'p> {
    /// Places.
    pub position: &'p [[f64; 2]],
    /// The group that windows beginning at each place are in.
    pub group: &'p dyn Fn(usize) -> usize,
}

/// [`mean_square`] of pieces of paths with gaps, in groups of windows that the caller makes: no displacement
/// is taken from one piece to another.
///
/// Lags: about 16 per decade, up to half of the longest piece, and one interval at least.
///
/// # Checked by  tests/all/gaps.rs: that of the same tracks
pub fn mean_square_of_paths(dt: f64, pieces: &[PathPiece<'_>], groups: usize) -> MeanSquare {
    let longest = pieces.iter().map(|piece| piece.position.len()).max().unwrap_or(0);
    let lags = spaced((longest / 2).max(usize::from(longest > 1)));
    let mut sums = vec![Sums::new(groups); lags.len()];
    for PathPiece { position, group } in pieces {
        for (sums, &lag) in sums.iter_mut().zip(&lags) {
            for start in 0..position.len().saturating_sub(lag) {
                let [sum, count] = squares(position, start..start + 1, lag);
                sums.add(group(start), sum, count);
            }
        }
    }
    MeanSquare { dt, lags, sums, groups, with_intervals: true }
}

/// Sum and number of the squared displacements over a lag that begin in a range and are known.
fn squares(position: &[[f64; 2]], range: Range<usize>, lag: usize) -> [f64; 2] {
    let later = position.get(range.start + lag..).unwrap_or_default();
    position[range].iter().zip(later).fold([0.0; 2], |[sum, count], (a, b)| {
        let [x, y] = [b[0] - a[0], b[1] - a[1]];
        let square = x * x + y * y;
        if square.is_nan() { [sum, count] } else { [sum + square, count + 1.0] }
    })
}

/// Sums of squared displacements at each lag, by groups.
pub(crate) fn square_sums(tracks: &Tracks, lags: &[usize]) -> Vec<Sums> {
    let mut sums = vec![Sums::new(tracks.groups()); lags.len()];
    for starts in tracks.starts() {
        for (sums, &lag) in sums.iter_mut().zip(lags) {
            let [sum, count] = squares(&starts.track.position, starts.range.clone(), lag);
            if count > 0.0 {
                sums.add(starts.group, sum, count);
            }
        }
    }
    sums
}

/// 1, 2, 3, ... and from there on logarithmically, up to `longest`.
fn spaced(longest: usize) -> Vec<usize> {
    let ratio = libm::pow(10.0, 1.0 / PER_DECADE);
    let mut lags = vec![];
    let mut lag = 1;
    while lag <= longest {
        lags.push(lag);
        lag = (lag + 1).max((lag as f64 * ratio).round() as usize);
    }
    lags
}

impl MeanSquare {
    /// Number of lags.
    pub fn len(&self) -> usize {
        self.lags.len()
    }

    /// Returns `true` if there is no lag.
    pub fn is_empty(&self) -> bool {
        self.lags.is_empty()
    }

    /// The lag of a place (model time).
    pub fn lag(&self, place: usize) -> f64 {
        self.lags[place] as f64 * self.dt
    }

    /// The curve without a constant part, such as that of independent errors of the positions: of the variance v in each coordinate, `4 v`.
    #[must_use]
    pub fn less(mut self, constant: f64) -> Self {
        self.sums.iter_mut().for_each(|sums| sums.shift(-constant));
        self
    }

    /// The value at a place, without one group if asked.
    pub(crate) fn value(&self, place: usize, left_out: Option<usize>) -> f64 {
        self.sums[place].mean(left_out)
    }

    /// Number of groups that can be left out.
    pub(crate) fn groups(&self) -> usize {
        self.groups
    }

    /// Number of windows of each group at a place.
    pub(crate) fn sizes(&self, place: usize) -> Vec<f64> {
        self.sums[place].sizes()
    }

    /// Tells if a displacement over the lag of a place is known.
    pub fn is_known(&self, place: usize) -> bool {
        self.sums[place].count() > 0.0
    }

    /// The value at a place with its interval, on its logarithm (squares of late displacements are skew) where it is above 0.
    pub fn measured(&self, place: usize) -> Measured {
        self.shown(self.sums[place].skew())
    }

    /// d ln MSD / d ln lag between lags some places away on both sides; `None` where nothing moved.
    pub fn exponent(&self, place: usize) -> Option<Measured> {
        let (from, to) = (place.saturating_sub(REACH), (place + REACH).min(self.len() - 1));
        if from == to {
            return None;
        }
        let slope = |left_out| self.slope(from, to, left_out);
        slope(None).is_finite().then(|| self.shown(leave_out(&self.sizes(to), &slope, false)))
    }

    /// The curve without intervals.
    pub(crate) fn without_intervals(self) -> Self {
        Self { with_intervals: false, ..self }
    }

    fn shown(&self, found: Measured) -> Measured {
        Measured { interval: found.interval.filter(|_| self.with_intervals), ..found }
    }

    /// The slope between two places on logarithmic axes.
    pub(crate) fn slope(&self, from: usize, to: usize, left_out: Option<usize>) -> f64 {
        let ratio = self.value(to, left_out) / self.value(from, left_out);
        libm::log(ratio) / libm::log(self.lag(to) / self.lag(from))
    }

    /// All points.
    pub fn points(&self) -> Vec<DisplacementPoint> {
        let point = |place| DisplacementPoint {
            lag: self.lag(place),
            value: self.measured(place),
            exponent: self.exponent(place),
            windows: self.sums[place].count(),
        };
        (0..self.len()).map(point).collect()
    }
}
