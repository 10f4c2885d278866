//! Natural units: those in which speed, modes and rate are about 1.

use crate::filter::Frame;
use crate::observation::OBSERVED;
use crate::{Observation, Term, Track};
use serde::{Deserialize, Serialize};

/// Units in which a fit is computed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scales {
    /// T: the inverse root-mean-square rate of the shape, `<|dz_n|^2>/(dt^2 <|z_n|^2>)` over n = 2, 3.
    pub time: f64,
    /// V, L2, L3: root-mean-square speed and modes.
    ///
    /// The contribution of measurement errors, as the covariances state them, is subtracted.
    pub amplitudes: [f64; 3],
    /// Mean square of speed (from frame to frame), `z2` and `z3`, errors subtracted, over that of their errors: below 1 nothing is seen.
    pub signal: [f64; 3],
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

fn square(y: &[f64; OBSERVED], first: usize) -> f64 {
    y[first] * y[first] + y[first + 1] * y[first + 1]
}

impl Scales {
    /// The natural units of these tracks.
    #[must_use]
    pub fn of(tracks: &[Track]) -> Self {
        let (mut speed, mut size, mut rate) = (Squares::default(), [Squares::default(); 2], [0.0; 2]);
        let mut duration = 0.0_f64;
        for track in tracks {
            let dt = track.interval();
            let frames = &track.0;
            duration = duration.max(frames[frames.len() - 1].t - frames[0].t);
            for frame in frames {
                for n in 0..2 {
                    size[n].add(square(&frame.y, 2 + 2 * n), variance(frame, 2 + 2 * n));
                }
            }
            for pair in frames.windows(2).filter(|pair| pair[1].t - pair[0].t < 1.5 * dt) {
                let by = pair[1].t - pair[0].t;
                let change: [f64; OBSERVED] = std::array::from_fn(|i| (pair[1].y[i] - pair[0].y[i]) / by);
                let error = |first| (variance(&pair[0], first) + variance(&pair[1], first)) / (by * by);
                speed.add(square(&change, 0), error(0));
                for n in 0..2 {
                    rate[n] += square(&change, 2 + 2 * n) - error(2 + 2 * n);
                }
            }
        }
        let pairs = speed.count.max(1.0);
        let rates: f64 = (0..2).map(|n| (rate[n] / pairs).max(0.0) / size[n].mean()).sum();
        let dt = tracks.iter().map(Track::interval).fold(f64::INFINITY, f64::min);
        let time = 1.0 / (0.5 * rates).sqrt().clamp(5.0 / duration, (2.0 / dt).max(5.0 / duration));
        let of = [speed, size[0], size[1]];
        Self { time, amplitudes: of.map(|of| of.mean().sqrt()), signal: of.map(|of| of.signal()) }
    }

    /// What a coefficient in natural units is multiplied by to be one in the units of the data: `A_n / (T prod A_m^degree)`.
    #[must_use]
    pub fn coefficient(&self, term: &Term) -> f64 {
        let product = |(m, a): (usize, &f64)| libm::pow(*a, f64::from(term.degree(m)));
        let product: f64 = self.amplitudes.iter().enumerate().map(product).product();
        self.amplitudes[term.equation] / (self.time * product)
    }

    /// What process noise of the velocity and of the shape is multiplied by.
    #[must_use]
    pub fn noise(&self) -> [f64; 2] {
        let [v, l2, l3] = self.amplitudes;
        [v, (l2 * l3).sqrt()].map(|size| size / self.time.sqrt())
    }

    /// Variances of the process noise of each mode for amplitudes 1.
    pub(crate) fn noise_of_modes(&self) -> [f64; 3] {
        let [_, l2, l3] = self.amplitudes;
        [1.0, l3 / l2, l2 / l3]
    }

    /// Unit of each observed number.
    fn units(&self) -> [f64; OBSERVED] {
        let [v, l2, l3] = self.amplitudes;
        [v * self.time, v * self.time, l2, l2, l3, l3]
    }

    /// Logarithm of the density of an observation in the units of the data, less that in natural units.
    pub(crate) fn log_density(&self) -> f64 {
        -self.units().iter().map(|&unit| libm::log(unit)).sum::<f64>()
    }

    /// A track in natural units; positions are counted from its first frame.
    pub(crate) fn frames(&self, track: &Track) -> Vec<Frame> {
        let unit = self.units();
        let origin = track.0[0].y;
        let frame = |frame: &Observation| Frame {
            t: (frame.t - track.0[0].t) / self.time,
            y: std::array::from_fn(|i| (frame.y[i] - if i < 2 { origin[i] } else { 0.0 }) / unit[i]),
            covariance: std::array::from_fn(|i| {
                std::array::from_fn(|j| frame.covariance[i][j] / (unit[i] * unit[j]))
            }),
        };
        track.0.iter().map(frame).collect()
    }
}
