//! The symmetry of a motion that repeats: what distinguishes the periodic motions of one regime.

use super::motion::Path;
use super::verdict::Regime;
use crate::isotropy::Isotropy;
use crate::periodic::PeriodicOrbit;
use serde::{Deserialize, Serialize};

motiform_dynamics::named! {
    /// The kind of a relative periodic orbit, by its symmetry and by the rotation that it adds up to in a period.
    ///
    /// The symmetry of the shape at every moment (its isotropy) comes first, then the symmetry between different moments, then the
    /// net rotation. See docs/regimes.md, section 'Periodic motions'.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Form by name {
        /// The shape repeats while the centre of mass rests.
        PulsatingAtRest = "pulsating-at-rest",
        /// Mirror symmetric at every moment, no net rotation: the body moves along a straight line at a changing speed.
        PulsatingStraight = "pulsating-straight",
        /// Along a straight line without net displacement: in general the shape is turned by half a turn after half the period.
        BackAndForth = "back-and-forth",
        /// Half a period later the motion is its own mirror image: left and right turns are alike.
        MirrorZigzag = "mirror-zigzag",
        /// No symmetry, and no net rotation either.
        AsymmetricZigzag = "asymmetric-zigzag",
        /// The heading turns through full circles in a period, and the body is not turned after it: in a field, or at parameters where the
        /// net rotation is a whole number of turns. In general the body drifts.
        DriftingCircular = "drifting-circular",
        /// The heading swings left and right, by more than the net rotation of a period.
        RotatingZigzag = "rotating-zigzag",
        /// The heading turns in one direction only, at a changing rate.
        PulsatingCircular = "pulsating-circular",
        /// A net rotation, and neither of the two above.
        Rosette = "rosette",
    }
}

impl Form {
    /// The meaning of the form, as a clause of a verdict.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::PulsatingAtRest => "the centre of mass rests while the shape repeats",
            Self::PulsatingStraight => "the shape repeats while the body keeps to a line: constant heading",
            Self::BackAndForth => "the body goes back and forth on a line: after a period it is where it was",
            Self::MirrorZigzag => {
                "half a period later the motion is its own mirror image, so it has no net rotation"
            }
            Self::AsymmetricZigzag => "the shape repeats without net rotation",
            Self::DriftingCircular => "the heading turns through full circles in a period",
            Self::RotatingZigzag => {
                "a slowly rotating zigzag: the heading swings by more than the net rotation"
            }
            Self::PulsatingCircular => "a pulsating circular motion: the heading turns in one direction only",
            Self::Rosette => "the shape repeats with a net rotation",
        }
    }

    /// The regime that it belongs to.
    pub const fn regime(self) -> Regime {
        match self {
            Self::PulsatingAtRest => Regime::Motionless,
            Self::PulsatingStraight | Self::BackAndForth => Regime::PulsatingStraight,
            Self::MirrorZigzag | Self::AsymmetricZigzag => Regime::Zigzag,
            Self::DriftingCircular => Regime::Circular,
            Self::RotatingZigzag | Self::PulsatingCircular | Self::Rosette => Regime::QuasiPeriodic,
        }
    }

    /// The form of an orbit whose shapes all have the symmetry `symmetry`, with the path of one period. Net rotations below
    /// `no_turn` (rad) are none.
    pub(super) fn of(symmetry: &Isotropy, orbit: &PeriodicOrbit, path: &Path, no_turn: f64) -> Self {
        let turns = orbit.net_rotation().abs() >= no_turn;
        if !path.moves() {
            return Self::PulsatingAtRest;
        }
        // equations without the mirror, or modes that do not act on the motion, may leave no axis: the velocity tells over one period. The
        // next one is on the same line only if the net rotation maps the line to itself: beside a cycle of saddles shapes are
        // as good as symmetric at all times, about one axis before a rest and about another one after it
        let same_line = libm::sin(orbit.net_rotation()).abs() < no_turn;
        let straight =
            same_line && (symmetry.mirror.is_some() || !orbit.mirrored && path.keeps_to_a_line(no_turn));
        // a line that is turned into itself, or a path along it that closes
        let returns = turns || path.displacement(no_turn) == [0.0; 2];
        match (straight, orbit.mirrored, turns) {
            (true, _, _) if returns => Self::BackAndForth,
            (true, _, _) => Self::PulsatingStraight,
            (false, true, _) => Self::MirrorZigzag,
            (false, false, false) if path.windings() != 0 => Self::DriftingCircular,
            (false, false, false) => Self::AsymmetricZigzag,
            (false, false, true) => Self::turning(path),
        }
    }

    /// The form of a motion with a net rotation, by its heading: how far it turns back within a period.
    fn turning(path: &Path) -> Self {
        let Some(heading) = path.heading() else { return Self::Rosette };
        let steps: Vec<f64> = heading.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let net = steps.iter().sum::<f64>().abs();
        let all = steps.iter().map(|step| step.abs()).sum::<f64>();
        let back = 0.5 * (all - net);
        if back < 1e-6 * all {
            Self::PulsatingCircular
        } else if back > net {
            Self::RotatingZigzag
        } else {
            Self::Rosette
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A body that goes along one line for a period and returns turned by `angle`.
    fn form_of_legs(mirror: Option<f64>, angle: f64) -> Form {
        let speeds = [0.0, 1.0, 2.0, 1.0, 0.0];
        let path = Path {
            times: vec![0.0, 1.0, 2.0, 3.0, 4.0],
            positions: vec![[0.0, 0.0], [0.5, 0.0], [2.0, 0.0], [3.5, 0.0], [4.0, 0.0]],
            velocities: speeds.iter().map(|&v| [v, 0.0]).collect(),
            resolution: 1e-12,
            largest: 1.0,
        };
        let orbit = PeriodicOrbit {
            shape: vec![1.0, 0.0],
            time: 4.0,
            angle,
            mirrored: false,
            residual: 0.0,
            multipliers: Vec::new(),
            errors: Vec::new(),
        };
        let isotropy = Isotropy { folds: 1, circle: false, mirror };
        Form::of(&isotropy, &orbit, &path, 1e-6)
    }

    /// The legs of a rectangle, with corners at rest, are no motion along a line, straight and symmetric as each of them is.
    #[test]
    fn legs_that_are_turned_against_each_other_are_on_no_line() {
        for mirror in [None, Some(0.0)] {
            assert_eq!(form_of_legs(mirror, 0.0), Form::PulsatingStraight);
            assert_eq!(form_of_legs(mirror, std::f64::consts::PI), Form::BackAndForth);
            for angle in [0.5 * std::f64::consts::PI, 0.1, -2.0] {
                assert_eq!(form_of_legs(mirror, angle).regime(), Regime::QuasiPeriodic, "{angle}");
            }
        }
    }
}
