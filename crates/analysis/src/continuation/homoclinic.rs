//! How the period of an orbit grows towards a connection of a saddle with itself.

use crate::RelativeEquilibrium;
use serde::{Deserialize, Serialize};

/// How the time `T` of an orbit grows with the parameter `p`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum PeriodLaw {
    /// `T = const - ln|p - p0| / rate`: the saddle's leading eigenvalues are real and of different size. The fitted rate is that of
    /// the leading one.
    Logarithmic {
        /// The rate (inverse model time).
        rate: f64,
    },
    /// `T = amplitude / |p - p0|`: at the connection growth and decay at the saddle are equal (a resonance).
    Resonant {
        /// The amplitude.
        amplitude: f64,
    },
}

/// Where a branch of periodic orbits ends because their period grows without bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Connection {
    /// The parameter `p0` of the connection.
    pub parameter: f64,
    /// What remains between it and the last point of the branch: its error is much smaller.
    pub remaining: f64,
    /// How the time of the orbit grows (half the period for a zigzag).
    pub law: PeriodLaw,
    /// The relative equilibrium that the orbit passes closest by, at the last point.
    pub saddle: Option<RelativeEquilibrium>,
}

impl Connection {
    /// The saddle's leading eigenvalue: the one whose real part is closest to 0. The fitted rate of a logarithmic law is its modulus.
    #[must_use]
    pub fn leading(&self) -> Option<f64> {
        let values = &self.saddle.as_ref()?.eigenvalues;
        values.iter().map(|value| value.0).min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    pub(super) fn through(self, saddle: Option<RelativeEquilibrium>) -> Self {
        Self { saddle, ..self }
    }
}

impl std::fmt::Display for Connection {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "the orbit approaches a connection of a saddle with itself at {:.9}: ", self.parameter)?;
        match self.law {
            PeriodLaw::Logarithmic { rate } => write!(f, "its time grows as -ln|p - p0| / {rate:.6}"),
            PeriodLaw::Resonant { amplitude } => write!(f, "its time grows as {amplitude:.6} / |p - p0|"),
        }
    }
}

/// Times along a branch of orbits, with the slope of the parameter.
#[derive(Debug, Default)]
pub(super) struct Periods {
    /// `(T, p, dp/dT)`, of the last points over which the time grew.
    points: Vec<(f64, f64, f64)>,
}

/// The law must hold over as many points.
const POINTS: usize = 6;

/// Fitted exponents over neighbouring points agree up to this part.
const AGREE: f64 = 0.02;

/// The connection is reached where this much of the parameter remains.
const NEAR: f64 = 1e-8;

/// A resonant connection is recognised where the time has grown by this factor.
const GROWN: f64 = 8.0;

impl Periods {
    /// A point of the branch: the time with its derivative along the branch, and the same of the parameter.
    pub(super) fn push(&mut self, time: (f64, f64), parameter: (f64, f64)) {
        let grows = self.points.last().is_none_or(|last| time.0 > last.0 && time.1 > 0.0);
        if !grows {
            self.points.clear();
        }
        self.points.push((time.0, parameter.0, parameter.1 / time.1));
    }

    /// The connection ahead, where one of the laws holds and little remains.
    pub(super) fn connection(&self) -> Option<Connection> {
        let from = self.points.len().checked_sub(POINTS)?;
        let last = &self.points[from..];
        let &(time, parameter, slope) = last.last()?;
        let made = |law, remaining: f64| {
            Some(Connection {
                parameter: parameter + remaining,
                remaining: remaining.abs(),
                law,
                saddle: None,
            })
        };
        // p - p0 = c exp(-rate T): ln|dp/dT| is linear in T
        if let Some(rate) = exponent(last, |t| t)
            && (slope / rate).abs() < NEAR * (1.0 + parameter.abs())
        {
            return made(PeriodLaw::Logarithmic { rate }, slope / rate);
        }
        // p - p0 = A/T: ln|dp/dT| is linear in ln T with slope -2
        let power = exponent(last, libm::log)?;
        let grown = time > GROWN * self.points.first()?.0;
        if grown && (power - 2.0).abs() < AGREE {
            return made(PeriodLaw::Resonant { amplitude: (slope * time * time).abs() }, slope * time);
        }
        None
    }
}

/// `-d ln|dp/dT| / d g(T)`, where it is positive and the same over all pairs of neighbours.
fn exponent(points: &[(f64, f64, f64)], g: fn(f64) -> f64) -> Option<f64> {
    let between = |pair: &[(f64, f64, f64)]| {
        let [(t0, _, s0), (t1, _, s1)] = [pair[0], pair[1]];
        if s0 * s1 > 0.0 { libm::log(s0 / s1) / (g(t1) - g(t0)) } else { f64::NAN }
    };
    let all: Vec<f64> = points.windows(2).map(between).collect();
    let last = *all.last()?;
    let agree = all.iter().all(|rate| (rate - last).abs() < AGREE * last.abs());
    (last > 0.0 && agree).then_some(last)
}
