//! Where a branch changes.

use super::normal_form::NormalForm;
use serde::{Deserialize, Deserializer, Serialize, de};

/// A name of the list below. (Not spelled out in the field: serde would take it for text borrowed from its input.)
type Name = &'static str;

/// The kind of a special point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Special {
    /// The branch turns back: `dp/ds = 0`.
    Fold,
    /// A real eigenvalue 0 (multiplier +1) in a direction that breaks a symmetry of the motion: two symmetric copies branch off.
    Pitchfork {
        /// The symmetry that the branch that leaves does not have.
        breaks: Broken,
    },
    /// A real eigenvalue 0 (multiplier +1) that keeps all symmetry, where the branch does not turn back: another one crosses it.
    BranchPoint,
    /// A real eigenvalue 0 at which a whole family of motions exists for this one value of the parameter: the equations regain a symmetry
    /// there. So a body in a field may move in every direction where the field vanishes.
    Continuum,
    /// A pair of imaginary eigenvalues: an oscillation of the shape begins.
    Hopf(Hopf),
    /// Multiplier -1 over the period: an orbit of twice the period begins.
    PeriodDoubling,
    /// Multiplier -1 over half the period of an orbit that is its own mirror image: two orbits that are not, mirror images of each
    /// other, begin.
    SymmetryBreaking,
    /// A pair of multipliers `exp(+-i angle)`: an invariant torus begins.
    Torus {
        /// The angle (rad, 0 to pi).
        angle: f64,
    },
    /// A change was seen between two points of the branch and could not be located, however short the steps. The point that carries
    /// this is the one after it.
    Unresolved {
        /// The name of what it seems to be: that of another of these.
        #[serde(deserialize_with = "known")]
        seen: Name,
        /// The parameter before it.
        from: f64,
        /// The parameter after it.
        to: f64,
    },
    /// A growth comes to 0 within its error and has the same sign on both sides: branches cross here, or two special points lie closer to
    /// each other than can be told.
    Touch {
        /// The name of what each of the two would be: that of another of these.
        #[serde(deserialize_with = "known")]
        seen: Name,
        /// The parameters of two special points differ from this one by less.
        within: f64,
    },
}

/// Which symmetry a motion loses where others begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Broken {
    /// The mirror, of a shape that has a direction: the new shapes turn, left and right (a drift pitchfork).
    Mirror,
    /// Rotations (and perhaps a mirror) of a shape at rest: the new shapes have fewer axes.
    Rotations,
    /// That an orbit is its own mirror image half a period later.
    MirrorAfterHalf,
    /// That an orbit is back after half of the period of the new ones.
    HalfPeriod,
}

impl Broken {
    /// The special point at which motions without this symmetry begin.
    pub(super) const fn special(self) -> Special {
        match self {
            Self::Mirror | Self::Rotations => Special::Pitchfork { breaks: self },
            Self::MirrorAfterHalf => Special::SymmetryBreaking,
            Self::HalfPeriod => Special::PeriodDoubling,
        }
    }
}

/// A Hopf bifurcation of the reduced motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hopf {
    /// Imaginary part of the critical eigenvalues (rad per model time).
    pub frequency: f64,
    /// The part of `2 pi / frequency` after which the oscillation is back but for a rotation: below 1 where it breaks rotations of the
    /// shape.
    #[serde(default = "whole")]
    pub part: f64,
    /// The first Lyapunov coefficient, for a critical vector of length 1: below 0 the orbits that begin are stable (supercritical),
    /// above 0 unstable (subcritical).
    ///
    /// Source: Kuznetsov (2004), eq. (5.62).
    pub first_lyapunov: NormalForm,
}

/// Of results that do not name the part.
const fn whole() -> f64 {
    1.0
}

impl Hopf {
    /// Period of the relative periodic orbits that begin: rotations are divided out.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.frequency * self.part
    }

    /// Returns `Some(true)` if the orbits that begin are stable within the directions that are critical; `None` where the coefficient's
    /// error does not say so.
    pub fn is_supercritical(&self) -> Option<bool> {
        self.first_lyapunov.coefficient()?.is_negative()
    }
}

impl Special {
    /// Its name in files.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::Pitchfork { .. } => "pitchfork",
            Self::BranchPoint => "branch-point",
            Self::Continuum => "continuum",
            Self::Hopf(_) => "hopf",
            Self::PeriodDoubling => "period-doubling",
            Self::SymmetryBreaking => "symmetry-breaking",
            Self::Torus { .. } => "torus",
            Self::Unresolved { .. } => "unresolved",
            Self::Touch { .. } => "touch",
        }
    }
}

/// All names.
const NAMES: [&str; 10] = [
    "fold",
    "pitchfork",
    "branch-point",
    "continuum",
    "hopf",
    "period-doubling",
    "symmetry-breaking",
    "torus",
    "unresolved",
    "touch",
];

/// One of the names, read back.
fn known<'d, D: Deserializer<'d>>(input: D) -> Result<&'static str, D::Error> {
    let name = String::deserialize(input)?;
    let found = NAMES.into_iter().find(|known| *known == name);
    found.ok_or_else(|| de::Error::unknown_variant(&name, &NAMES))
}
