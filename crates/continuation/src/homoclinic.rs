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
    /// `p = p0 + amplitude exp(-rate T) cos(frequency T + phase)` to leading order: the saddle's leading eigenvalues are the complex pair
    /// `+-rate +- i frequency`, slower than the leading eigenvalue of the other side (Shilnikov). Folds follow one another after `pi / frequency`.
    ///
    /// Source: Glendinning and Sparrow (1984), J. Stat. Phys. 35, 645.
    Oscillating {
        /// The rate (inverse model time).
        rate: f64,
        /// The frequency (rad per model time).
        frequency: f64,
    },
    /// `T = amplitude / sqrt|p - p0|` to leading order: two equilibria meet on the orbit (a saddle-node on a circle).
    SquareRoot {
        /// The amplitude.
        amplitude: f64,
    },
}

/// What an orbit approaches where its period grows without bound.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ConnectionKind {
    /// The leading eigenvalues of the saddle are real, growing and decaying ones of different size.
    Saddle,
    /// A complex pair of the saddle leads on one side (Shilnikov). Where the pair is slower than the leading eigenvalue of the other side there are
    /// infinitely many periodic orbits beside the connection.
    SaddleFocus,
    /// Growth and decay at the saddle are equal.
    Resonant,
    /// Two equilibria meet on the orbit and disappear.
    SaddleNode,
}

impl ConnectionKind {
    /// Its name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Saddle => "saddle",
            Self::SaddleFocus => "saddle-focus",
            Self::Resonant => "resonant",
            Self::SaddleNode => "saddle-node",
        }
    }
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
    /// The eigenvalues `(re, im)` of the saddle in the directions that keep the symmetry of the orbit's shapes; empty where these are not told from the others.
    #[serde(default)]
    pub rates: Vec<(f64, f64)>,
}

impl Connection {
    /// What the orbit approaches: from its law, and from the leading eigenvalues of the saddle.
    #[must_use]
    pub fn kind(&self) -> ConnectionKind {
        match self.law {
            PeriodLaw::Resonant { .. } => ConnectionKind::Resonant,
            PeriodLaw::SquareRoot { .. } => ConnectionKind::SaddleNode,
            PeriodLaw::Oscillating { .. } => ConnectionKind::SaddleFocus,
            PeriodLaw::Logarithmic { .. } => match self.sides() {
                Some([(_, 0.0), (_, 0.0)]) | None => ConnectionKind::Saddle,
                Some(_) => ConnectionKind::SaddleFocus,
            },
        }
    }

    /// The slowest eigenvalues `(re, |im|)` of the saddle that grow and that decay, in the directions that keep the symmetry of the orbit's shapes.
    #[must_use]
    pub fn sides(&self) -> Option<[(f64, f64); 2]> {
        leading_sides(&self.rates)
    }

    /// The saddle quantity: the sum of the real parts of the slowest growing and decaying eigenvalues; `None` where they are not known, and at a saddle-node.
    /// Where the leading eigenvalues are real and their sum is negative, one stable orbit meets the connection; where it is positive, the orbit
    /// is unstable. Source: Kuznetsov, Elements of Applied Bifurcation Theory, section 6.2.
    #[must_use]
    pub fn quantity(&self) -> Option<f64> {
        let [grows, decays] = self.sides().filter(|_| self.kind() != ConnectionKind::SaddleNode)?;
        Some(grows.0 + decays.0)
    }

    /// The saddle's leading eigenvalue: the one whose real part is closest to 0. The fitted rate of a logarithmic law is its modulus.
    #[must_use]
    pub fn leading(&self) -> Option<f64> {
        let values = &self.saddle.as_ref()?.eigenvalues;
        values.iter().map(|value| value.0).min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// The connection through this saddle, the relative equilibrium that the orbit passes closest by. `None` unless deviations from it grow in some
    /// directions and decay in others, and one of their rates is that of the law (a resonant law has two rates of one size): otherwise the
    /// period grows for another reason, as in a canard explosion, and the branch goes on.
    pub(super) fn through(self, saddle: Option<Saddle>) -> Option<Self> {
        let Saddle { found, rates } = saddle?;
        let all = if rates.is_empty() { &found.eigenvalues } else { &rates };
        let side = |sign: f64| {
            let sized = all.iter().map(|value| sign * value.0);
            sized.filter(|rate| *rate > 0.0).collect::<Vec<f64>>()
        };
        let (grow, decay) = (side(1.0), side(-1.0));
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
            PeriodLaw::Oscillating { .. } => (0.0, self.error), // the rate is that of the saddle: see `oscillating`
            PeriodLaw::SquareRoot { .. } => return None, // there is no saddle on this side: see `at_fold`
        };
        (apart < RATES).then_some(Self { saddle: Some(found), rates, error, ..self })
    }

    /// A saddle-node on a circle at the square-root law: beyond it, at the distances d and 4 d, `equilibrium` finds one whose slowest real
    /// eigenvalue grows as the square root, `lambda = L sqrt(d)`. In the normal form `x' = d + x^2` the orbit takes the time `pi / sqrt(d)`, and
    /// `lambda = 2 sqrt(d)`: `amplitude L` is 2 pi, or a multiple where the orbit passes several images of the place.
    ///
    /// Source: Kuznetsov, Elements of Applied Bifurcation Theory, section 7.1.
    pub(super) fn at_fold(
        self,
        side: f64,
        equilibrium: &dyn Fn(f64) -> Option<RelativeEquilibrium>,
    ) -> Option<Self> {
        let PeriodLaw::SquareRoot { amplitude } = self.law else { return None };
        let slowest = |found: &RelativeEquilibrium| {
            let real = found.eigenvalues.iter().filter(|value| value.1 == 0.0);
            real.map(|value| value.0.abs()).fold(f64::INFINITY, f64::min)
        };
        let beyond = |d: f64| equilibrium(self.parameter - side * d).map(|found| (slowest(&found), found));
        let d = self.remaining;
        let ((near, saddle), (far, _)) = (beyond(d)?, beyond(4.0 * d)?);
        let passes = near / d.sqrt() * amplitude / std::f64::consts::TAU;
        let square_root = (far / near - 2.0).abs() < 2.0 * RATES;
        let whole = passes.round() >= 1.0 && (passes - passes.round()).abs() < RATES;
        (square_root && whole).then_some(Self { saddle: Some(saddle), ..self })
    }
}

impl std::fmt::Display for Connection {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let place = stated(self.parameter, self.error);
        match self.kind() {
            ConnectionKind::Saddle => {
                write!(f, "the orbit approaches a connection of a saddle with itself at {place}")
            }
            ConnectionKind::SaddleFocus => {
                write!(
                    f,
                    "the orbit approaches a connection of a saddle-focus with itself (Shilnikov) at {place}"
                )
            }
            ConnectionKind::Resonant => {
                write!(f, "the orbit approaches a resonant connection of a saddle with itself at {place}")
            }
            ConnectionKind::SaddleNode => {
                write!(
                    f,
                    "the orbit approaches a saddle-node on a circle at {place}: two equilibria appear on it"
                )
            }
        }?;
        match self.law {
            PeriodLaw::Logarithmic { rate } => write!(f, ": its time grows as -ln|p - p0| / {rate:.6}"),
            PeriodLaw::Oscillating { rate, frequency } => {
                write!(
                    f,
                    ": the parameter oscillates as exp(-{rate:.6} T) cos({frequency:.6} T) with its time T"
                )
            }
            PeriodLaw::Resonant { amplitude } => write!(f, ": its time grows as {amplitude:.6} / |p - p0|"),
            PeriodLaw::SquareRoot { amplitude } => {
                write!(f, ": its time grows as {amplitude:.6} / sqrt|p - p0|")
            }
        }?;
        match self.quantity() {
            Some(quantity)
                if matches!(self.law, PeriodLaw::Logarithmic { .. } | PeriodLaw::Oscillating { .. }) =>
            {
                write!(f, "; saddle quantity {quantity:.4}")
            }
            _ => Ok(()),
        }
    }
}

/// The relative equilibrium that an orbit passes closest by, and its eigenvalues in the directions that keep the symmetry of the orbit's shapes (none
/// where these are not told from the others).
pub(super) struct Saddle {
    pub(super) found: RelativeEquilibrium,
    pub(super) rates: Vec<(f64, f64)>,
}

/// The slowest eigenvalues `(re, |im|)` that grow and that decay.
pub(super) fn leading_sides(rates: &[(f64, f64)]) -> Option<[(f64, f64); 2]> {
    let slowest = |sign: f64| {
        let side = rates.iter().filter(|value| sign * value.0 > 0.0);
        let least = side.min_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
        Some((least.0, least.1.abs()))
    };
    Some([slowest(1.0)?, slowest(-1.0)?])
}

/// A value with its error, to the decimals that the error leaves.
#[must_use]
pub fn stated(value: f64, error: f64) -> String {
    let decimals = (-libm::log10(error)).ceil().clamp(0.0, 15.0) as usize;
    let text = format!("{value:.decimals$}");
    let zero = text.trim_start_matches(['-', '0', '.']).is_empty();
    format!("{} +- {error:.0e}", if zero { text.trim_start_matches('-') } else { &text })
}

/// Laws by which the distance to a connection falls as a power of the time: `|p - p0| ~ 1/T^k`.
#[derive(Clone, Copy, Debug)]
pub(super) enum Algebraic {
    /// [`PeriodLaw::Resonant`].
    Resonant = 1,
    /// [`PeriodLaw::SquareRoot`].
    SquareRoot = 2,
}

/// Times along a branch of orbits, with the slope of the parameter.
#[derive(Debug, Default)]
pub(super) struct Periods {
    /// `(T, p, dp/dT)`, of the last points over which the time grew.
    pub(super) points: Vec<(f64, f64, f64)>,
}

/// The law must hold over as many points.
const POINTS: usize = 6;

/// Rates over the two halves of the points agree up to this part: what remains of the parameter is then known to more than one digit.
const AGREE: f64 = 0.05;

/// Part up to which a rate of the saddle is that of the law: the fitted rate comes near to it slowly.
const RATES: f64 = 0.3;

/// The rate is fitted over the times above this part of the last one.
const WINDOW: f64 = 0.85;

/// The same in long steps.
const LONG_WINDOW: f64 = 0.5;

/// The connection is reached where this much of the parameter remains.
pub(super) const NEAR: f64 = 1e-7;

/// Fits that the best one is compared with.
const COMPARED: usize = 11;

/// The algebraic laws are tried where the time has grown by this factor.
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
        // in long steps the times above the window are few: the law is tested over as many points, but not from far away
        let from = self.points.iter().position(|point| point.0 > WINDOW * time)?;
        let from = from.min(self.points.len().checked_sub(POINTS)?);
        let last = &self.points[from..];
        if last[0].0 < LONG_WINDOW * time {
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
            rates: Vec::new(),
        })
    }

    /// The connection ahead by one of the algebraic laws, for a branch whose flow cannot be resolved any further, or whose time has become very
    /// long: there the distance falls so slowly that a branch never comes near. Of the fits to the last half of the times the one that its
    /// points lie on best: the very last points carry the most round-off.
    pub(super) fn algebraic(&self, law: Algebraic) -> Option<Connection> {
        let longest = self.points.last()?.0;
        let late = (0..self.points.len()).filter(|&i| self.points[i].0 > 0.5 * longest);
        let mut fits: Vec<(Connection, f64)> = late.filter_map(|last| self.fit(law, last)).collect();
        fits.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (best, others) = fits.split_first()?;
        let away = |other: &(Connection, f64)| (other.0.parameter - best.0.parameter).abs();
        // Neighbouring fits have errors in common: of those that are nearly as good, the farthest one counts three times.
        let error = match &others[..others.len().min(COMPARED)] {
            [] => best.0.remaining,
            compared => 3.0 * compared.iter().map(away).fold(0.0, f64::max),
        };
        Some(Connection { error: error.max(f64::EPSILON * best.0.parameter.abs()), ..best.0.clone() })
    }

    /// `p = p0 + A/T^k + B/T^(k+1) + C/T^(k+2)` through the point number `last` and one well before it, with their slopes, and how far the
    /// points between them are from it, as a part of what remains. The first term must be the largest one.
    fn fit(&self, law: Algebraic, last: usize) -> Option<(Connection, f64)> {
        let power = law as i32;
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
        let powers = [0, power, power + 1, power + 2];
        let fit = solve(&powers.map(column), &ends.map(|(t, p, q)| [p, q * t]).concat(), 1e-14)?;
        let at = |t: f64| fit[0] + (fit[1] + (fit[2] + fit[3] / t) / t) / t.powi(power);
        let remaining = (fit[0] - parameter).abs();
        let off = |&(t, p, _): &(f64, f64, f64)| (at(t) - p).abs() / remaining;
        let worst = self.points[first..last].iter().map(off).fold(0.0, f64::max);
        let term = (fit[1] / time.powi(power)).abs();
        let leads = term > 0.7 * remaining && term < 1.3 * remaining;
        let law = match law {
            Algebraic::Resonant => PeriodLaw::Resonant { amplitude: fit[1].abs() },
            Algebraic::SquareRoot => PeriodLaw::SquareRoot { amplitude: fit[1].abs().sqrt() },
        };
        let connection =
            Connection { parameter: fit[0], remaining, error: 0.0, law, saddle: None, rates: Vec::new() };
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
