//! A connection of saddles, with themselves or one with the next, in which a branch of orbits ends.

use super::joins::{Joins, Passed};
use super::oscillating;
use super::passages::Passages;
use motiform_analysis::RelativeEquilibrium;
use serde::{Deserialize, Serialize};

/// Part up to which a rate of the saddle is that of the law: the fitted rate comes near to it slowly.
pub(super) const RATES: f64 = 0.3;

/// The law by which the time `T` of an orbit grows with the parameter `p`.
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
    /// `+-rate +- i frequency`, slower than the leading eigenvalue of the other side (Shilnikov). Folds follow one another after `pi /
    /// frequency`.
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

motiform_dynamics::named! {
    /// The limit of an orbit where its period grows without bound.
    #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    #[non_exhaustive]
    pub enum ConnectionKind by name {
        /// The leading eigenvalues of the saddle are real, growing and decaying ones of different size.
        Saddle = "saddle",
        /// A complex pair of the saddle leads on one side (Shilnikov). Where the pair is slower than the leading eigenvalue of the other
        /// side there are infinitely many periodic orbits beside the connection.
        SaddleFocus = "saddle-focus",
        /// Growth and decay at the saddle are equal.
        Resonant = "resonant",
        /// Two equilibria meet on the orbit and disappear.
        SaddleNode = "saddle-node",
        /// The orbit passes two saddles or more that are no images of each other (a heteroclinic cycle).
        Cycle = "cycle",
    }
}

/// Where a branch of periodic orbits ends because their period grows without bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Connection {
    /// The parameter `p0` of the connection.
    pub parameter: f64,
    /// The distance between it and the last point of the branch.
    pub remaining: f64,
    /// Bound of the error of `parameter`.
    #[serde(default)]
    pub error: f64,
    /// The law of the time of the orbit (half the period for a zigzag).
    pub law: PeriodLaw,
    /// Error of the rate or of the amplitude of the law: the difference between fits to different points, and, for a rate, from the
    /// eigenvalue of the saddle to which it belongs. 0 for an oscillating law, whose numbers are those of the saddle.
    #[serde(default)]
    pub law_error: f64,
    /// The relative equilibrium that the orbit passes closest by, at the last point.
    pub saddle: Option<RelativeEquilibrium>,
    /// The eigenvalues `(re, im)` of the saddle in the directions that keep the symmetry of the orbit's shapes, without those of
    /// coordinates in which the orbit rests; empty where these are not told from the others.
    #[serde(default)]
    pub rates: Vec<(f64, f64)>,
    /// Change of the saddle quantity from the last point, to which `rates` belong, to the connection.
    #[serde(default)]
    pub quantity_change: f64,
    /// The relation of the saddles that the orbit passes; `None` where the orbit is not seen to pass any: at a saddle-node there is none on
    /// this side.
    #[serde(default)]
    pub joins: Option<Joins>,
    /// The saddles of a heteroclinic cycle in their order; empty for other connections.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub passed: Vec<Passed>,
}

impl Connection {
    /// One of which the law alone is known.
    pub(super) const fn at(parameter: f64, remaining: f64, law: PeriodLaw) -> Self {
        Self {
            parameter,
            remaining,
            error: 0.0,
            law,
            law_error: 0.0,
            saddle: None,
            rates: Vec::new(),
            quantity_change: 0.0,
            joins: None,
            passed: Vec::new(),
        }
    }

    /// The limit of the orbit: from its law, and from the leading eigenvalues of the saddle.
    pub fn kind(&self) -> ConnectionKind {
        if self.joins == Some(Joins::Different) {
            return ConnectionKind::Cycle;
        }
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

    /// The name of such an end: `homoclinic` or `heteroclinic`; `connection` where the orbit is not seen to pass the saddles.
    pub fn name(&self) -> &'static str {
        match (self.joins, self.law) {
            (Some(Joins::Images | Joins::Different), _) => "heteroclinic",
            (Some(Joins::Itself), _) | (None, PeriodLaw::SquareRoot { .. }) => "homoclinic",
            (None, _) => "connection",
        }
    }

    /// The slowest eigenvalues `(re, |im|)` of the saddle that grow and that decay, in the directions that keep the symmetry of the orbit's
    /// shapes.
    pub fn sides(&self) -> Option<[(f64, f64); 2]> {
        leading_sides(&self.rates)
    }

    /// The saddle quantity: the sum of the real parts of the slowest growing and decaying eigenvalues; `None` where they are not known, at
    /// a saddle-node, and for a cycle of several saddles ([`Passed::quantity`]).
    /// Where the leading eigenvalues are real and their sum is negative, one stable orbit meets the connection; where it is positive, the
    /// orbit is unstable. Source: Kuznetsov, Elements of Applied Bifurcation Theory, section 6.2.
    pub fn quantity(&self) -> Option<f64> {
        let of_one = !matches!(self.kind(), ConnectionKind::SaddleNode | ConnectionKind::Cycle);
        let [grows, decays] = self.sides().filter(|_| of_one)?;
        Some(grows.0 + decays.0)
    }

    /// Bound of the error of the saddle quantity: it changes up to the connection, and the saddle's rates have errors of their own.
    pub fn quantity_error(&self) -> Option<f64> {
        self.quantity()?;
        Some(self.quantity_change.abs() + rounding(self.sides()?))
    }

    /// The saddle's leading eigenvalue: of `rates`, the one whose real part is closest to 0. The fitted rate of a
    /// logarithmic law is its modulus.
    pub fn leading(&self) -> Option<f64> {
        let all = &self.saddle.as_ref()?.eigenvalues;
        let values = if self.rates.is_empty() { all } else { &self.rates };
        values.iter().map(|value| value.0).min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// The connection through this saddle, the relative equilibrium that the orbit passes closest by. `None` unless deviations from it grow
    /// in some directions and decay in others, and one of their rates is that of the law (a resonant law has two rates of one size):
    /// otherwise the period grows for another reason, as in a canard explosion, and the branch goes on.
    pub(super) fn through(self, saddle: Option<Saddle>) -> Option<Self> {
        let Saddle { found, rates, .. } = saddle?;
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
            PeriodLaw::Logarithmic { .. } if oscillating::leading(&rates).is_some() => return None, // see `oscillating`
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
        let law_error = self.law_error_beside(apart);
        (apart < RATES).then_some(Self { saddle: Some(found), rates, error, law_error, ..self })
    }

    /// The connection of the saddles that an orbit passes; `None` unless each passage is clear and the law is theirs.
    ///
    /// An orbit that the parameter's distance `d` from the connection keeps away from a saddle, or from the next one's stable manifold, by
    /// a distance in proportion to d stays there for `T_i = const - ln d / |lambda_i|`, with a growing eigenvalue of the first or a
    /// decaying one of the second. Near the others `ln d` enters with factors of its own, so that `T = sum T_i` alone grows with a rate
    /// that belongs to no eigenvalue; but with the share `T_i / T` the law's rate is `|lambda_i| T_i / T` for one of them.
    ///
    /// Source: the maps along a cycle: Kuznetsov, Elements of Applied Bifurcation Theory, section 6.2.
    pub(super) fn past(self, passages: &Passages) -> Option<Self> {
        let PeriodLaw::Logarithmic { rate } = self.law else { return None };
        let values = |saddle: &Saddle| {
            if saddle.rates.is_empty() { saddle.found.eigenvalues.clone() } else { saddle.rates.clone() }
        };
        let mut apart = f64::INFINITY;
        for passage in &passages.all {
            for value in values(&passage.saddle) {
                let its = passage.share * value.0.abs();
                apart = apart.min((its - rate).abs() / its.max(rate));
            }
        }
        if apart > RATES || !passages.is_clear() {
            return None;
        }
        let longest = passages.all.iter().max_by(|a, b| a.share.total_cmp(&b.share))?;
        let of_one = passages.joins != Joins::Different;
        if of_one && oscillating::leading(&longest.saddle.rates).is_some() {
            return None;
        }
        let passed = |passage: &super::passages::Passage| {
            let Saddle { found, .. } = &passage.saddle;
            let sides = leading_sides(&values(&passage.saddle))?;
            Some(Passed { saddle: found.clone(), sides, share: passage.share })
        };
        let passed = match passages.joins {
            Joins::Different => passages.all.iter().map(passed).collect::<Option<_>>()?,
            Joins::Itself | Joins::Images => Vec::new(),
        };
        let error = self.error.max(apart * self.remaining); // what remains is in proportion to the rate
        let (saddle, rates) = (Some(longest.saddle.found.clone()), longest.saddle.rates.clone());
        let law_error = self.law_error_beside(apart);
        Some(Self { saddle, rates, error, law_error, joins: Some(passages.joins), passed, ..self })
    }

    /// The error of the law's rate, if the rate that the saddle gives differs from it by the part `apart` of the larger one.
    fn law_error_beside(&self, apart: f64) -> f64 {
        match self.law {
            PeriodLaw::Logarithmic { rate } => self.law_error.max(rate * apart / (1.0 - apart)),
            _ => self.law_error,
        }
    }

    /// For a cycle the product of `-decaying / growing` over its saddles: above 1 the orbits that meet it are stable.
    ///
    /// Source: Kuznetsov, Elements of Applied Bifurcation Theory, section 6.2 (planar cycles).
    pub fn attraction(&self) -> Option<f64> {
        let ratio = |passed: &Passed| -passed.sides[1].0 / passed.sides[0].0;
        (!self.passed.is_empty()).then(|| self.passed.iter().map(ratio).product())
    }

    /// A saddle-node on a circle at the square-root law: beyond it, at the distances d and 4 d, `equilibrium` finds one whose slowest real
    /// eigenvalue grows as the square root, `lambda = L sqrt(d)`. In the normal form `x' = d + x^2` the orbit takes the time `pi /
    /// sqrt(d)`, and `lambda = 2 sqrt(d)`: `amplitude L` is 2 pi, or a multiple where the orbit passes several images of the place.
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

/// Errors of the rates of a saddle, as a part of them.
const NEUTRAL: f64 = 1e-6;

/// Error of the sum of the rates of both sides, at one value of the parameter.
pub(super) fn rounding([grows, decays]: [(f64, f64); 2]) -> f64 {
    NEUTRAL * (grows.0 - decays.0)
}

/// The relative equilibrium that an orbit passes closest by, and its eigenvalues in the directions that keep the symmetry of the orbit's
/// shapes (none where these are not told from the others).
pub(super) struct Saddle {
    pub(super) found: RelativeEquilibrium,
    pub(super) rates: Vec<(f64, f64)>,
    /// The distance of the slowest shape of the orbit from it, as a part of the largest one.
    pub(super) near: f64,
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
