//! The points of a branch.

use super::certificate::Certificate;
use super::homoclinic::Connection;
use super::normal_form::NormalForm;
use super::special::{Broken, Special};
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium};
use motiform_dynamics::Outcome;
use serde::{Deserialize, Serialize};

/// One motion of a branch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Motion {
    /// A shape that does not change but for a steady rotation.
    Equilibrium(RelativeEquilibrium),
    /// A shape that comes back turned or mirrored.
    Orbit {
        /// The orbit; its shape is the first node.
        orbit: PeriodicOrbit,
        /// Shapes along it at equal times, `orbit.time / nodes.len()` apart.
        nodes: Vec<Vec<f64>>,
    },
}

impl Motion {
    /// The relative equilibrium, if it is one.
    pub fn equilibrium(&self) -> Option<&RelativeEquilibrium> {
        match self {
            Self::Equilibrium(equilibrium) => Some(equilibrium),
            Self::Orbit { .. } => None,
        }
    }

    /// The periodic orbit, if it is one.
    pub fn orbit(&self) -> Option<&PeriodicOrbit> {
        match self {
            Self::Equilibrium(_) => None,
            Self::Orbit { orbit, .. } => Some(orbit),
        }
    }

    /// A shape of the motion.
    pub fn shape(&self) -> &[f64] {
        match self {
            Self::Equilibrium(equilibrium) => &equilibrium.shape,
            Self::Orbit { orbit, .. } => &orbit.shape,
        }
    }

    /// Its shapes: one, or the nodes of an orbit.
    pub fn shapes(&self) -> Vec<&[f64]> {
        match self {
            Self::Equilibrium(equilibrium) => vec![&equilibrium.shape],
            Self::Orbit { nodes, .. } => nodes.iter().map(Vec::as_slice).collect(),
        }
    }
}

/// One point of a branch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// The parameter.
    pub parameter: f64,
    /// Length along the branch from its start, in the units of [`super::Settings`].
    pub arclength: f64,
    /// The motion, with its eigenvalues or multipliers.
    pub motion: Motion,
    /// Number of growing directions of the reduced motion: 0 if it is stable. At a special point that is the count of those that are not
    /// critical.
    pub unstable: usize,
    /// Number of directions whose growth is 0 within its error; 0 at special points.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub neutral: usize,
    /// Dimension of the family of motions with this value of the parameter that it belongs to, where there is one all along the branch that
    /// no symmetry of the model explains: `unstable` and `neutral` are about deviations from the family.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub family: usize,
    /// Number of directions (a pair counts as one) that are critical at a special point, where these are more than its symmetry makes
    /// equal: no normal form of one direction says what begins. Elsewhere 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub critical: usize,
    /// Derivative of the parameter by the length along the branch: it changes its sign at a fold.
    pub slope: f64,
    /// The tangent at a special point, in numbers that do not depend on the units of the branch: the change of the parameter, the root mean
    /// square of those of the shapes, and that of the other unknowns (of steady motions the turning rate; of orbits the relative change of
    /// the period, and the angle). `None` elsewhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangent: Option<[f64; 3]>,
    /// The kind of special point, if it was solved for as one.
    pub special: Option<Special>,
    /// The evidence for a special point; `None` at ordinary points, and where it was not solved for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certificate: Option<Certificate>,
}

/// For serde.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
const fn is_zero(count: &usize) -> bool {
    *count == 0
}

impl Point {
    /// Returns `true` where branches cross in a pitchfork of a symmetry that the model does not state.
    pub fn is_unstated_pitchfork(&self) -> bool {
        let form = self.certificate.and_then(|certificate| certificate.normal_form);
        self.special == Some(Special::BranchPoint) && matches!(form, Some(NormalForm::Cubic(_)))
    }

    /// Returns `true` if small deviations die out.
    pub fn is_stable(&self) -> bool {
        self.unstable == 0 && self.neutral == 0 && self.special.is_none()
    }
}

/// Why a branch ended. The last point handed out is the last good one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum End {
    /// The parameter left its range; the last point lies at the edge.
    RangeLeft,
    /// The branch came back to its start (up to the symmetry); the last point is the start again.
    Closed,
    /// A curve of special points ends in one of codimension two: beyond it the critical pair is real.
    Degenerate {
        /// Its kind.
        kind: super::Degenerate,
    },
    /// A curve of special points comes to where its condition is not resolved any more: multipliers change so much with the parameters,
    /// close to a connection of saddles, that round-off decides whether one is critical. The last point is one where it still is.
    Lost {
        /// Distance of the critical multiplier, or eigenvalue in units of the rate of the equations, from where it belongs after the
        /// shortest step that was tried.
        off: f64,
    },
    /// As many points as were asked for.
    PointLimit,
    /// All steps of the flow along orbits that were allowed ([`super::Allowance`]).
    Spent,
    /// The watch stopped it.
    Stopped,
    /// A shape grew beyond [`super::Settings::largest_size`].
    BlowUp {
        /// The size reached.
        size: f64,
    },
    /// Newton's method failed even after the shortest step.
    StepUnderflow {
        /// Length of the step that failed.
        step: f64,
        /// Why it failed.
        why: Obstruction,
    },
    /// The period grows without bound: the orbit approaches a connection of a saddle with itself, or of several saddles.
    Homoclinic(Box<Connection>),
    /// The time of the orbit passed [`super::Settings::longest_time`], and grows by no law that was recognised.
    PeriodLimit {
        /// The time reached.
        time: f64,
    },
    /// The period grows while the place stays: beside a connection of a saddle-focus a branch or a curve winds without an end.
    Settles {
        /// The period reached.
        period: f64,
    },
    /// The parameter has not changed since the start: the orbits of the branch are a family for one value of it, as those of a linear
    /// centre or of a conservative system.
    Family {
        /// The parameter.
        parameter: f64,
    },
    /// The motion gains a symmetry: the branch meets its own images at a motion of more symmetry. The last point, a pitchfork of that
    /// motion, lies there.
    Meets {
        /// The parameter there.
        parameter: f64,
        /// The symmetry, which the motions of the branch do not have.
        gains: Broken,
    },
    /// The orbit shrinks to a relative equilibrium: the branch ends at its Hopf bifurcation.
    Shrinks {
        /// The parameter there.
        parameter: f64,
        /// The time of the orbit there (half the period for a zigzag).
        time: f64,
    },
}

impl End {
    /// The parameter at which the branch ends, where that is a place of its own beyond the last point that is computed, or at it.
    pub fn parameter(&self) -> Option<f64> {
        match self {
            Self::Homoclinic(connection) => Some(connection.parameter),
            Self::Meets { parameter, .. } | Self::Shrinks { parameter, .. } => Some(*parameter),
            _ => None,
        }
    }
}

/// Why Newton's method failed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Obstruction {
    /// It did not converge to a point of the branch nearby.
    Newton,
    /// The equations are singular in more than one direction.
    Singular,
    /// The flow did not reach the end of a part of the orbit.
    Flow(Outcome),
    /// There is no body for a parameter value.
    NoBody {
        /// The reason.
        why: String,
    },
}

impl std::fmt::Display for Obstruction {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Newton => write!(f, "Newton's method does not converge"),
            Self::Singular => write!(
                f,
                "the equations are singular in more than one direction, as where a family of motions exists for one value (has the model a \
                 symmetry that it does not state?)"
            ),
            Self::Flow(outcome) => write!(f, "the flow {outcome}"),
            Self::NoBody { why } => write!(f, "{why}"),
        }
    }
}

impl std::fmt::Display for End {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::RangeLeft => write!(f, "the parameter left its range"),
            Self::Closed => write!(f, "the branch came back to its start"),
            Self::Degenerate { kind } => write!(f, "the curve ends: {}", kind.name()),
            Self::Lost { off } => {
                write!(
                    f,
                    "the critical multiplier is not resolved any more: after the shortest step it is off by {off:.1e}"
                )
            }
            Self::PointLimit => write!(f, "as many points as were asked for"),
            Self::Spent => write!(f, "the steps along orbits that were allowed are spent"),
            Self::Stopped => write!(f, "stopped from outside"),
            Self::BlowUp { size } => write!(f, "the shape grew to {size:.3e}"),
            Self::StepUnderflow { step, why } => write!(f, "no point after a step of {step:.1e}: {why}"),
            Self::Homoclinic(connection) => write!(f, "{connection}"),
            Self::PeriodLimit { time } => write!(f, "the time of the orbit grew to {time:.6}"),
            Self::Settles { period } => {
                write!(
                    f,
                    "the period grew to {period:.1} and the place did not change any more, as beside a connection"
                )
            }
            Self::Family { parameter } => {
                write!(
                    f,
                    "the parameter stays at {}: the orbits are a family for this value",
                    nine(*parameter)
                )
            }
            Self::Meets { parameter, gains } => {
                let (meets, beyond) = match gains {
                    Broken::Mirror => ("the motion becomes its own mirror image", "its mirror image"),
                    Broken::Rotations => ("the shape becomes symmetric under rotations", "a rotated copy"),
                    Broken::MirrorAfterHalf => {
                        ("the orbit becomes its own mirror image half a period later", "its mirror image")
                    }
                    Broken::HalfPeriod => (
                        "the orbit becomes one of half the period, passed twice",
                        "the same orbit, shifted by half a period",
                    ),
                };
                write!(f, "{meets} at {}; beyond, the branch is {beyond}", nine(*parameter))
            }
            Self::Shrinks { parameter, .. } => {
                write!(f, "the orbit shrinks to an equilibrium at {}", nine(*parameter))
            }
        }
    }
}

/// A parameter to nine decimals, and 0 without a sign.
pub fn nine(parameter: f64) -> String {
    let text = format!("{parameter:.9}");
    if text.trim_start_matches(['-', '0', '.']).is_empty() { "0.000000000".to_owned() } else { text }
}
