//! Natural units: those in which speed, modes and rate are about 1.

use crate::filter::Frame;
use crate::{Observation, Term, Track};
use serde::{Deserialize, Serialize};

/// Units in which a fit is computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scales {
    /// T: the inverse root-mean-square rate of the shape, `<|dz_n|^2>/(dt^2 <|z_n|^2>)` over all n from 2.
    pub time: f64,
    /// V, L2, L3 (and L4): root-mean-square speed and modes.
    ///
    /// The contribution of measurement errors, as the covariances state them, is subtracted.
    pub amplitudes: Vec<f64>,
    /// Mean square of speed (from frame to frame), `z2`, `z3` .., errors subtracted, over that of their errors: below 1 nothing is seen.
    pub signal: Vec<f64>,
    /// Mean variance of a coordinate of the centre, as the covariances state it (length^2).
    pub centre: f64,
}

/// Sums of squares over frames.
#[derive(Clone, Copy, Debug, Default)]
struct Squares {
    /// Of `z_n`, less errors.
    size: f64,
    /// Errors of `z_n`.
    error: f64,
    count: f64,
}

impl Squares {
    fn add(&mut self, square: f64, error: f64) {
        self.size += square - error;
        self.error += error;
        self.count += 1.0;
    }

    /// Mean square over that of the errors.
    fn signal(&self) -> f64 {
        if self.error > 0.0 { (self.size / self.error).max(0.0) } else { f64::MAX }
    }

    /// The mean, at least what errors leave of 0.
    fn mean(&self) -> f64 {
        let floor = self.error / self.count.sqrt().max(1.0);
        self.size.max(floor) / self.count.max(1.0)
    }
}

fn variance(frame: &Observation, first: usize) -> f64 {
    frame.covariance[first][first] + frame.covariance[first + 1][first + 1]
}

fn square(y: &[f64], first: usize) -> f64 {
    y[first] * y[first] + y[first + 1] * y[first + 1]
}

impl Scales {
    /// The natural units of these tracks, for a model of so many amplitudes.
    pub fn of(tracks: &[Track], modes: usize) -> Self {
        let shapes = modes - 1;
        let centres = tracks.iter().flat_map(|track| &track.0).map(|frame| 0.5 * variance(frame, 0));
        let centre =
            centres.sum::<f64>() / tracks.iter().map(|track| track.0.len()).sum::<usize>().max(1) as f64;
        let (mut speed, mut size) = (Squares::default(), vec![Squares::default(); shapes]);
        let mut rate = vec![0.0; shapes];
        let mut duration = 0.0_f64;
        for track in tracks {
            let dt = track.interval();
            let frames = &track.0;
            duration = duration.max(frames[frames.len() - 1].t - frames[0].t);
            for frame in frames {
                for n in 0..shapes {
                    size[n].add(square(&frame.y, 2 + 2 * n), variance(frame, 2 + 2 * n));
                }
            }
            for pair in frames.windows(2).filter(|pair| pair[1].t - pair[0].t < 1.5 * dt) {
                let by = pair[1].t - pair[0].t;
                let change: Vec<f64> = pair[1].y.iter().zip(&pair[0].y).map(|(b, a)| (b - a) / by).collect();
                let error = |first| (variance(&pair[0], first) + variance(&pair[1], first)) / (by * by);
                speed.add(square(&change, 0), error(0));
                for n in 0..shapes {
                    rate[n] += square(&change, 2 + 2 * n) - error(2 + 2 * n);
                }
            }
        }
        let pairs = speed.count.max(1.0);
        let rates: f64 = (0..shapes).map(|n| (rate[n] / pairs).max(0.0) / size[n].mean()).sum();
        let dt = tracks.iter().map(Track::interval).fold(f64::INFINITY, f64::min);
        let time = 1.0 / (rates / shapes as f64).sqrt().clamp(5.0 / duration, (2.0 / dt).max(5.0 / duration));
        let of = || std::iter::once(&speed).chain(&size);
        let amplitudes = of().map(|of| of.mean().sqrt()).collect();
        Self { time, amplitudes, signal: of().map(Squares::signal).collect(), centre }
    }

    /// The factor from a coefficient in natural units to one in the units of the data:
    /// `A_n / (T prod A_m^degree)`.
    pub fn coefficient(&self, term: &Term) -> f64 {
        let product = |(m, a): (usize, &f64)| libm::pow(*a, f64::from(term.degree(m)));
        let product: f64 = self.amplitudes.iter().enumerate().map(product).product();
        self.amplitudes[term.equation] / (self.time * product)
    }

    /// The factors from process noise of the velocity and of the shape in natural units to the units of the
    /// data.
    pub fn noise(&self) -> [f64; 2] {
        let [l2, l3] = self.reference();
        [self.amplitudes[0], (l2 * l3).sqrt()].map(|size| size / self.time.sqrt())
    }

    /// The modes whose geometric mean is the unit of the process noise of all modes: z2 and z3, or z2 alone.
    fn reference(&self) -> [f64; 2] {
        [self.amplitudes[1], self.amplitudes[2.min(self.amplitudes.len() - 1)]]
    }

    /// Variances of the process noise of each mode in natural units, for amplitudes 1: in the units of the
    /// data all modes of the shape have the same noise.
    pub fn noise_of_modes(&self) -> Vec<f64> {
        let [l2, l3] = self.reference();
        let of = |(n, l): (usize, &f64)| if n == 0 { 1.0 } else { (l2 / l) * (l3 / l) };
        self.amplitudes.iter().enumerate().map(of).collect()
    }

    /// Unit of lengths of the path: that of the speed times that of time.
    pub fn length(&self) -> f64 {
        self.amplitudes[0] * self.time
    }

    /// Unit of each observed number.
    fn units(&self) -> Vec<f64> {
        let of = |(n, l): (usize, &f64)| [if n == 0 { self.length() } else { *l }; 2];
        self.amplitudes.iter().enumerate().flat_map(of).collect()
    }

    /// Logarithm of the density of an observation in the units of the data, less that in natural units.
    pub(crate) fn log_density(&self) -> f64 {
        -self.units().iter().map(|&unit| libm::log(unit)).sum::<f64>()
    }

    /// A track in natural units; positions are counted from its first frame.
    pub(crate) fn frames(&self, track: &Track) -> Vec<Frame> {
        let unit = self.units();
        let origin = &track.0[0].y;
        let own = |frame: &Observation, i: usize| frame.y[i] - if i < 2 { origin[i] } else { 0.0 };
        let row = |row: &[f64], i: usize| row.iter().zip(&unit).map(|(x, u)| x / (unit[i] * u)).collect();
        let frame = |frame: &Observation| Frame {
            t: (frame.t - track.0[0].t) / self.time,
            y: unit.iter().enumerate().map(|(i, unit)| own(frame, i) / unit).collect(),
            covariance: (0..unit.len()).map(|i| row(&frame.covariance[i], i)).collect(),
        };
        track.0.iter().map(frame).collect()
    }
}
