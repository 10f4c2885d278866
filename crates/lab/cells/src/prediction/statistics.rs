//! The statistics that are compared: curves over lags, and distributions as quantiles.
//!
//! Plain sums over the frames that are there, gaps included: the scatter between simulated cells takes the place of the intervals that
//! `motiform_statistics` computes for records without gaps.

use super::record::Record;
use crate::observe::step_of;
use motiform_dynamics::sample::{ascending, mean, quantile};
use motiform_inference::Track;
use motiform_statistics::GappedVectors;
use serde::{Deserialize, Serialize};

/// Lags per decade.
const PER_DECADE: f64 = 10.0;
/// The longest lag, as a part of the record.
const LONGEST: f64 = 0.25;
/// Lags on both sides of the correlation of shape and motion.
const SIDE: usize = 12;
/// Quantiles of distributions (%).
const QUANTILES: [f64; 9] = [5.0, 10.0, 20.0, 35.0, 50.0, 65.0, 80.0, 90.0, 95.0];

/// The variable that a statistic runs over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// Lags, in units of time.
    Lag,
    /// Shares of the samples, in %: the values are quantiles.
    Share,
}

motiform_dynamics::named! {
    /// The statistics. Definitions: docs/cells.md.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Kind by name {
        /// Mean-square displacement; errors of measurement are in it (length^2).
        Displacement = "mean-square displacement",
        /// Autocorrelation of the velocity.
        Velocity = "autocorrelation of the velocity",
        /// Autocorrelation of z2.
        SecondMode = "autocorrelation of z2",
        /// Autocorrelation of z3, of models with z3.
        ThirdMode = "autocorrelation of z3",
        /// Autocorrelation of z4, of models with z4.
        FourthMode = "autocorrelation of z4",
        /// Elongation along (1) or across (-1) the motion, at times before or after it.
        Elongation = "elongation along the motion",
        /// Quantiles of the speed (length/time).
        Speed = "speed",
        /// Quantiles of the turning angle (rad).
        Turning = "turning angle",
        /// Quantiles of |z2| (length).
        SecondSize = "size of z2",
        /// Quantiles of |z3| (length), of models with z3.
        ThirdSize = "size of z3",
        /// Quantiles of |z4| (length), of models with z4.
        FourthSize = "size of z4",
    }
}

impl Kind {
    /// The variable that it runs over.
    pub fn axis(self) -> Axis {
        match self {
            Self::Displacement
            | Self::Velocity
            | Self::SecondMode
            | Self::ThirdMode
            | Self::FourthMode
            | Self::Elongation => Axis::Lag,
            Self::Speed | Self::Turning | Self::SecondSize | Self::ThirdSize | Self::FourthSize => {
                Axis::Share
            }
        }
    }
}

/// A statistic of a record.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Statistic {
    /// Which one.
    pub kind: Kind,
    /// Places on its axis.
    pub at: Vec<f64>,
    /// Its values there.
    pub values: Vec<f64>,
}

/// The lags that are asked of all records of a cell, in frames.
pub(super) struct Asked {
    lags: Vec<usize>,
    /// Frames over which displacements are taken, so that the observed cell's headings are clear.
    step: usize,
    dt: f64,
}

impl Asked {
    pub(super) fn of(observed: &Record, track: &Track) -> Self {
        let longest = (LONGEST * observed.frames.len() as f64) as usize;
        let ratio = libm::pow(10.0, 1.0 / PER_DECADE);
        let mut lags = vec![1];
        while let Some(&last) = lags.last().filter(|last| **last < longest) {
            lags.push(((last as f64 * ratio).round() as usize).max(last + 1).min(longest));
        }
        Self { lags, step: step_of(&track.0), dt: observed.dt }
    }

    /// All statistics of a record, always in the same order and at the same places.
    pub(super) fn all(&self, record: &Record) -> Vec<Statistic> {
        let number = |at: usize| {
            GappedVectors::of(record.frames.iter().map(move |y| y.as_ref().map(|y| [y[at], y[at + 1]])))
        };
        let (place, second) = (number(0), number(2));
        // velocities by displacements over some frames
        let moves = place.displacements(self.step, self.step as f64 * record.dt);
        let mut all = vec![
            self.over_lags(Kind::Displacement, self.lags.iter().map(|&lag| place.mean_square(lag)).collect()),
            self.over_lags(Kind::Velocity, moves.correlations(&self.lags)),
            self.over_lags(Kind::SecondMode, second.correlations(&self.lags)),
            self.alignment(&moves, &second),
            quantiles(Kind::Speed, moves.lengths()),
            quantiles(Kind::Turning, moves.turns(self.step)),
            quantiles(Kind::SecondSize, second.lengths()),
        ];
        let higher = [(Kind::ThirdMode, Kind::ThirdSize), (Kind::FourthMode, Kind::FourthSize)];
        for (n, (mode, size)) in (2..record.modes()).zip(higher) {
            let series = number(2 * n);
            all.push(self.over_lags(mode, series.correlations(&self.lags)));
            all.push(quantiles(size, series.lengths()));
        }
        all
    }

    fn over_lags(&self, kind: Kind, values: Vec<f64>) -> Statistic {
        Statistic { kind, at: self.lags.iter().map(|&lag| lag as f64 * self.dt).collect(), values }
    }

    /// `<Re z2(t + lag) exp(2 i heading(t))> / <|z2|>`: whether, and how long before or after, the body is elongated along (1) or across
    /// (-1) its motion.
    fn alignment(&self, moves: &GappedVectors, shape: &GappedVectors) -> Statistic {
        let side = SIDE.min(shape.len() / 8).cast_signed();
        let size = mean(shape.lengths()).unwrap_or(f64::NAN);
        let double = moves.doubled();
        let middle = (self.step / 2).cast_signed(); // of the displacement
        let lags: Vec<isize> = (-side..=side).collect();
        let at = lags.iter().map(|&lag| lag as f64 * self.dt).collect();
        let values = lags.into_iter().map(|lag| double.mean_dot(shape, lag + middle) / size).collect();
        Statistic { kind: Kind::Elongation, at, values }
    }
}

fn quantiles(kind: Kind, mut samples: Vec<f64>) -> Statistic {
    ascending(&mut samples);
    let at = |share: &f64| quantile(&samples, share / 100.0).unwrap_or(f64::NAN);
    let values = QUANTILES.iter().map(at).collect();
    Statistic { kind, at: QUANTILES.to_vec(), values }
}
