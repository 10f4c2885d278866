//! How the period of an orbit grows towards a connection of a saddle with itself.

use crate::RelativeEquilibrium;
use crate::linear::solve;

/// How the time `T` of an orbit grows with the parameter `p`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PeriodLaw {
    /// `T = const - ln|p - p0| / rate`: the saddle's leading eigenvalues are real and of different size. The fitted rate is that of
    /// the leading one.
    Logarithmic {
        /// The rate (inverse model time).
        rate: f64,
    },
    /// `T = amplitude / |p - p0|` to leading order: at the connection growth and decay at the saddle are equal (a resonance).
    Resonant {
        /// The amplitude.
        amplitude: f64,
    },
}

/// Where a branch of periodic orbits ends because their period grows without bound.
#[derive(Clone, Debug, PartialEq)]
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
const GROWN: f64 = 2.0;

impl Periods {
    /// A point of the branch: the time with its derivative along the branch, and the same of the parameter.
    pub(super) fn push(&mut self, time: (f64, f64), parameter: (f64, f64)) {
        let grows = self.points.last().is_none_or(|last| time.0 > last.0 && time.1 > 0.0);
        if !grows {
            self.points.clear();
        }
        self.points.push((time.0, parameter.0, parameter.1 / time.1));
    }

    /// The connection ahead, where the logarithmic law holds and little remains.
    pub(super) fn connection(&self) -> Option<Connection> {
        let from = self.points.len().checked_sub(POINTS)?;
        let last = &self.points[from..];
        let &(_, parameter, slope) = last.last()?;
        // p - p0 = c exp(-rate T): ln|dp/dT| is linear in T
        let rate = exponent(last)?;
        let remaining = slope / rate;
        (remaining.abs() < NEAR * (1.0 + parameter.abs())).then(|| Connection {
            parameter: parameter + remaining,
            remaining: remaining.abs(),
            law: PeriodLaw::Logarithmic { rate },
            saddle: None,
        })
    }

    /// The resonant connection ahead, for a branch whose flow cannot be resolved any further: at a resonance the distance to it falls so
    /// slowly that a branch never comes near.
    ///
    /// `p = p0 + A/T + B/T^2 + C/T^3` through two points with their slopes; the points between them must lie on it.
    pub(super) fn resonance(&self) -> Option<Connection> {
        let apart = self.points.windows(2).rposition(|pair| pair[1].0 > 1.001 * pair[0].0)? + 1;
        let last = self.points[apart];
        let first = self.points.iter().position(|point| point.0 > last.0 / 1.6)?;
        let tried = self.points.first()?.0 < last.0 / GROWN && apart - first >= POINTS;
        let columns = |power: i32| {
            let value = |t: f64| t.powi(-power);
            let slope = |t: f64| -f64::from(power) * t.powi(-power - 1);
            let (a, b) = (self.points[first].0, last.0);
            vec![value(a), slope(a) * a, value(b), slope(b) * b]
        };
        let right = [self.points[first], last].map(|(t, p, q)| [p, q * t]).concat();
        let fit =
            solve(&[columns(0), columns(1), columns(2), columns(3)], &right, 1e-14).filter(|_| tried)?;
        let at = |t: f64| fit[0] + (fit[1] + (fit[2] + fit[3] / t) / t) / t;
        let remaining = fit[0] - last.1;
        let fits =
            self.points[first..apart].iter().all(|&(t, p, _)| (at(t) - p).abs() < 1e-3 * remaining.abs());
        let tail = (fit[1] / last.0 + remaining).abs() < 0.3 * remaining.abs();
        (fits && tail).then(|| Connection {
            parameter: fit[0],
            remaining: remaining.abs(),
            law: PeriodLaw::Resonant { amplitude: fit[1].abs() },
            saddle: None,
        })
    }
}

/// `-d ln|dp/dT| / dT`, where it is positive and the same over all pairs of neighbours.
fn exponent(points: &[(f64, f64, f64)]) -> Option<f64> {
    let between = |pair: &[(f64, f64, f64)]| {
        let [(t0, _, s0), (t1, _, s1)] = [pair[0], pair[1]];
        if s0 * s1 > 0.0 { libm::log(s0 / s1) / (t1 - t0) } else { f64::NAN }
    };
    let all: Vec<f64> = points.windows(2).map(between).collect();
    let last = *all.last()?;
    let agree = all.iter().all(|rate| (rate - last).abs() < AGREE * last.abs());
    (last > 0.0 && agree).then_some(last)
}
