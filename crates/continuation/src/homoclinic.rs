//! How the period of an orbit grows towards a connection of a saddle with itself.

use motiform_analysis::RelativeEquilibrium;
use motiform_analysis::linear::solve;
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
    /// `T = amplitude / |p - p0|` to leading order: at the connection growth and decay at the saddle are equal (a resonance).
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
    /// What remains between it and the last point of the branch.
    pub remaining: f64,
    /// How far `parameter` may be away.
    #[serde(default)]
    pub error: f64,
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

    /// The connection through this saddle, the relative equilibrium that the orbit passes closest by. `None` unless deviations from it grow in some
    /// directions and decay in others, and one of their rates is that of the law (a resonant law has two rates of one size): otherwise the
    /// period grows for another reason, as in a canard explosion, and the branch goes on.
    pub(super) fn through(self, saddle: Option<RelativeEquilibrium>) -> Option<Self> {
        let saddle = saddle?;
        let rates = |sign: f64| {
            let sized = saddle.eigenvalues.iter().map(|value| sign * value.0);
            sized.filter(|rate| *rate > 0.0).collect::<Vec<f64>>()
        };
        let (grow, decay) = (rates(1.0), rates(-1.0));
        if grow.is_empty() || decay.is_empty() {
            return None;
        }
        let apart = |a: f64, b: f64| (a - b).abs() / a.max(b);
        let (apart, error) = match self.law {
            PeriodLaw::Logarithmic { rate } => {
                let apart = grow.iter().chain(&decay).map(|a| apart(*a, rate)).fold(f64::INFINITY, f64::min);
                (apart, self.error.max(apart * self.remaining)) // what remains is in proportion to the rate
            }
            PeriodLaw::Resonant { .. } => {
                let pairs = grow.iter().flat_map(|a| decay.iter().map(|b| apart(*a, *b)));
                (pairs.fold(f64::INFINITY, f64::min), self.error)
            }
        };
        (apart < RATES).then_some(Self { saddle: Some(saddle), error, ..self })
    }
}

impl std::fmt::Display for Connection {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "the orbit approaches a connection of a saddle with itself at {}: ",
            stated(self.parameter, self.error)
        )?;
        match self.law {
            PeriodLaw::Logarithmic { rate } => write!(f, "its time grows as -ln|p - p0| / {rate:.6}"),
            PeriodLaw::Resonant { amplitude } => write!(f, "its time grows as {amplitude:.6} / |p - p0|"),
        }
    }
}

/// A value with its error, to the decimals that the error leaves.
#[must_use]
pub fn stated(value: f64, error: f64) -> String {
    let decimals = (-libm::log10(error)).ceil().clamp(0.0, 15.0) as usize;
    let text = format!("{value:.decimals$}");
    let zero = text.trim_start_matches(['-', '0', '.']).is_empty();
    format!("{} +- {error:.0e}", if zero { text.trim_start_matches('-') } else { &text })
}

/// Times along a branch of orbits, with the slope of the parameter.
#[derive(Debug, Default)]
pub(super) struct Periods {
    /// `(T, p, dp/dT)`, of the last points over which the time grew.
    points: Vec<(f64, f64, f64)>,
}

/// The law must hold over as many points.
const POINTS: usize = 6;

/// Rates over the two halves of the points agree up to this part: what remains of the parameter is then known to more than one digit.
const AGREE: f64 = 0.05;

/// Part up to which a rate of the saddle is that of the law: the fitted rate comes near to it slowly.
const RATES: f64 = 0.3;

/// The rate is fitted over the times above this part of the last one.
const WINDOW: f64 = 0.85;

/// The connection is reached where this much of the parameter remains.
const NEAR: f64 = 1e-7;

/// Fits that the best one is compared with.
const COMPARED: usize = 11;

/// The resonant law is tried where the time has grown by this factor.
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
        let time = self.points.last()?.0;
        let from = self.points.iter().position(|point| point.0 > WINDOW * time)?;
        let last = &self.points[from..];
        if last.len() < POINTS {
            return None;
        }
        let &(_, parameter, slope) = last.last()?;
        // p - p0 = c exp(-rate T): ln|dp/dT| is linear in T
        let rate = exponent(last)?;
        let remaining = slope / rate;
        (remaining.abs() < NEAR * (1.0 + parameter.abs())).then(|| Connection {
            parameter: parameter + remaining,
            remaining: remaining.abs(),
            error: AGREE * remaining.abs() + f64::EPSILON * parameter.abs(),
            law: PeriodLaw::Logarithmic { rate },
            saddle: None,
        })
    }

    /// The resonant connection ahead, for a branch whose flow cannot be resolved any further: at a resonance the distance to it falls so
    /// slowly that a branch never comes near. Of the fits to the last half of the times the one that its points lie on best: the very
    /// last points carry the most round-off.
    pub(super) fn resonance(&self) -> Option<Connection> {
        let longest = self.points.last()?.0;
        let late = (0..self.points.len()).filter(|&i| self.points[i].0 > 0.5 * longest);
        let mut fits: Vec<(Connection, f64)> = late.filter_map(|last| self.resonant(last)).collect();
        fits.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (best, others) = fits.split_first()?;
        let away = |other: &(Connection, f64)| (other.0.parameter - best.0.parameter).abs();
        // Neighbouring fits have errors in common: of those that are nearly as good, the farthest one counts three times.
        let error = match &others[..others.len().min(COMPARED)] {
            [] => best.0.remaining,
            compared => 3.0 * compared.iter().map(away).fold(0.0, f64::max),
        };
        Some(Connection { error, ..best.0.clone() })
    }

    /// `p = p0 + A/T + B/T^2 + C/T^3` through the point number `last` and one well before it, with their slopes, and how far the points
    /// between them are from it, as a part of what remains. The first term must be the largest one.
    fn resonant(&self, last: usize) -> Option<(Connection, f64)> {
        let (time, parameter, _) = self.points[last];
        let first = self.points.iter().position(|point| point.0 > time / 1.6)?;
        if last < first + POINTS || self.points.first()?.0 > time / GROWN {
            return None;
        }
        let ends = [self.points[first], self.points[last]];
        let column = |power: i32| {
            let value = |t: f64| [t.powi(-power), -f64::from(power) * t.powi(-power)]; // and t times the slope
            ends.map(|(t, _, _)| value(t)).concat()
        };
        let fit = solve(&[0, 1, 2, 3].map(column), &ends.map(|(t, p, q)| [p, q * t]).concat(), 1e-14)?;
        let at = |t: f64| fit[0] + (fit[1] + (fit[2] + fit[3] / t) / t) / t;
        let remaining = (fit[0] - parameter).abs();
        let off = |&(t, p, _): &(f64, f64, f64)| (at(t) - p).abs() / remaining;
        let worst = self.points[first..last].iter().map(off).fold(0.0, f64::max);
        let leads = (fit[1] / time).abs() > 0.7 * remaining && (fit[1] / time).abs() < 1.3 * remaining;
        let law = PeriodLaw::Resonant { amplitude: fit[1].abs() };
        let connection = Connection { parameter: fit[0], remaining, error: 0.0, law, saddle: None };
        (leads && worst < 1e-3).then_some((connection, worst))
    }
}

/// `-d ln|dp/dT| / dT` over all points, where it is positive and about the same over both halves of them.
fn exponent(points: &[(f64, f64, f64)]) -> Option<f64> {
    let between = |pair: &[(f64, f64, f64)]| {
        let [(t0, _, s0), (t1, _, s1)] = [pair[0], pair[1]];
        if s0 * s1 > 0.0 { libm::log(s0 / s1) / (t1 - t0) } else { f64::NAN }
    };
    let (first, middle, last) = (points.first()?, points.get(points.len() / 2)?, points.last()?);
    let (early, late) = (between(&[*first, *middle]), between(&[*middle, *last]));
    let mean = between(&[*first, *last]);
    (mean > 0.0 && (early - late).abs() < AGREE * mean).then_some(mean)
}
