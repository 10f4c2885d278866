//! Points of codimension two on a curve of special points.

use super::critical::{Condition, Critical, Reading};
use super::hopf::first_lyapunov;
use super::levels::Level;
use super::normal_form::Coefficient;
use super::special::Special;
use motiform_analysis::equilibrium::{Units, size_beside};
use motiform_dynamics::Equivariant;

/// Where a curve of special points changes.
///
/// Source: Kuznetsov (2004), Elements of Applied Bifurcation Theory, chapters 8 and 9.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub enum Degenerate {
    /// Two curves of folds meet in a cusp: the parameters turn back.
    Cusp,
    /// The first Lyapunov coefficient of a Hopf bifurcation changes its sign: super- and subcritical ones meet.
    Bautin,
    /// The frequency of a Hopf bifurcation is 0, or a steady one has a second eigenvalue 0.
    BogdanovTakens,
    /// An eigenvalue 0 beside an imaginary pair (on a curve of folds: fold-Hopf).
    ZeroHopf,
    /// Two imaginary pairs.
    DoubleHopf,
    /// Multipliers that are roots of unity of this order, at a torus or twice the same multiplier: a strong resonance.
    Resonance {
        /// The order, 1 to 4.
        order: u8,
    },
    /// Two different kinds of critical multipliers at once.
    DoublyCritical,
    /// The motion gains a symmetry: a part of its shape vanishes, and every eigenvalue that belongs to the symmetry is critical at once.
    /// Where the parameters turn back, the curve goes on with images of itself, and ends; so does one of pairs.
    GainsSymmetry,
    /// One of them, seen between two points of the curve and not located.
    Unresolved,
}

impl Degenerate {
    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cusp => "cusp",
            Self::Bautin => "bautin",
            Self::BogdanovTakens => "bogdanov-takens",
            Self::ZeroHopf => "zero-hopf",
            Self::DoubleHopf => "double-hopf",
            Self::Resonance { order: 1 } => "resonance-1:1",
            Self::Resonance { order: 2 } => "resonance-1:2",
            Self::Resonance { order: 3 } => "resonance-1:3",
            Self::Resonance { .. } => "resonance-1:4",
            Self::DoublyCritical => "doubly-critical",
            Self::GainsSymmetry => "gains-symmetry",
            Self::Unresolved => "unresolved",
        }
    }

    /// The points that are sought along curves of this kind: one that does not come was not found.
    pub fn sought(special: Special, orbits: bool) -> Vec<Self> {
        match (special, orbits) {
            (Special::Hopf(_), _) => {
                vec![Self::Bautin, Self::BogdanovTakens, Self::ZeroHopf, Self::DoubleHopf]
            }
            (Special::Torus { .. }, _) => {
                let orders = (1..=4).map(|order| Self::Resonance { order });
                orders.chain([Self::ZeroHopf, Self::DoubleHopf, Self::DoublyCritical]).collect()
            }
            (Special::Fold, false) => vec![Self::Cusp, Self::BogdanovTakens, Self::ZeroHopf],
            (_, false) => vec![Self::BogdanovTakens, Self::ZeroHopf],
            (Special::Fold, true) => vec![Self::Cusp, Self::Bautin, Self::DoublyCritical],
            (_, true) => vec![Self::DoublyCritical],
        }
    }
}

/// The value that changes its sign at such a point.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sign {
    /// The slope of the condition in the direction in which the parameters do not change.
    Turn,
    /// The first Lyapunov coefficient, multiplied by what makes it finite where another eigenvalue vanishes: at a zero-Hopf point it has a
    /// pole, and changes its sign without being 0.
    Lyapunov,
    /// `omega^2`, or the cosine of the angle, less this.
    Angle(f64),
    /// The growth of another real level.
    Real,
    /// The growth of another pair.
    Pair,
}

/// A place on a curve, as far as the signs need it.
pub(super) struct Seen<'s> {
    pub(super) body: &'s dyn Equivariant,
    pub(super) shape: &'s [f64],
    /// The error of the shape.
    pub(super) solved: f64,
    pub(super) levels: &'s [Vec<Level>],
    pub(super) reading: &'s Reading,
}

/// A coefficient that vanishes is smaller than this part of those around it.
const VANISHES: f64 = 1e-3;

fn first_lyapunov_of(seen: &Seen<'_>) -> Option<Coefficient> {
    let frequency = seen.reading.angle.max(0.0).sqrt();
    let scale = (size_beside(seen.body, seen.shape), Units::of(seen.body).length);
    first_lyapunov(seen.body, seen.shape, frequency, seen.solved, scale).coefficient()
}

impl Sign {
    /// Those that belong to curves of this kind, and what they stand for.
    pub(super) fn all(critical: &Critical, fold: bool) -> Vec<(Self, Degenerate)> {
        let (real, pair) = match (critical.orbits, critical.condition) {
            (true, _) => (Degenerate::DoublyCritical, Degenerate::DoublyCritical),
            (_, Condition::Pair) => (Degenerate::ZeroHopf, Degenerate::DoubleHopf),
            _ => (Degenerate::BogdanovTakens, Degenerate::ZeroHopf),
        };
        let mut out = vec![(Self::Real, real), (Self::Pair, pair)];
        if fold {
            out.push((Self::Turn, Degenerate::Cusp));
        }
        if critical.condition == Condition::Pair {
            if critical.orbits {
                let orders = [(1.0, 1), (-1.0, 2), (-0.5, 3), (0.0, 4)];
                out.extend(
                    orders.map(|(cosine, order)| (Self::Angle(cosine), Degenerate::Resonance { order })),
                );
            } else {
                out.push((Self::Lyapunov, Degenerate::Bautin));
                out.push((Self::Angle(0.0), Degenerate::BogdanovTakens));
            }
        }
        out
    }

    /// Returns `true` if the critical pair becomes real where it vanishes.
    pub(super) fn ends(self, critical: &Critical) -> bool {
        matches!(self, Self::Angle(value) if !critical.orbits || value.abs() == 1.0)
    }

    /// The value; `turn` is the one of [`Sign::Turn`].
    pub(super) fn value(self, critical: &Critical, seen: &Seen<'_>, turn: &dyn Fn() -> f64) -> f64 {
        let others = || critical.others(seen.levels, seen.reading);
        match self {
            Self::Turn => turn(),
            Self::Lyapunov => first_lyapunov_of(seen)
                .map_or(f64::NAN, |found| found.value * critical.poles(seen.levels, seen.reading)),
            Self::Angle(value) => seen.reading.angle - value,
            Self::Real => others()[0].1,
            Self::Pair => others()[1].1,
        }
    }

    /// Returns `true` if the sign of the value is known: a coefficient may be smaller than its error.
    pub(super) fn is_known(self, seen: &Seen<'_>) -> bool {
        !matches!(self, Self::Lyapunov)
            || first_lyapunov_of(seen).is_some_and(|found| found.is_negative().is_some())
    }

    /// Returns `true` if the point where the value vanishes is what it stands for: the coefficient itself must vanish, not what it is
    /// multiplied with.
    pub(super) fn holds(self, at: &Seen<'_>, ends: [&Seen<'_>; 2]) -> bool {
        if !matches!(self, Self::Lyapunov) {
            return true;
        }
        let size = |seen| first_lyapunov_of(seen).map_or(f64::NAN, |found| found.value.abs());
        size(at) < VANISHES * size(ends[0]).max(size(ends[1]))
    }

    /// Number of growing levels, for the signs of levels: it must change too.
    pub(super) fn count(self, critical: &Critical, seen: &Seen<'_>) -> Option<usize> {
        let others = || critical.others(seen.levels, seen.reading);
        match self {
            Self::Real => Some(others()[0].0),
            Self::Pair => Some(others()[1].0),
            _ => None,
        }
    }
}
