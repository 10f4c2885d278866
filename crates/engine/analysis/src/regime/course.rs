//! The direction of a motion, where the model prefers one: the hand of a handed body, the angle to a field.

use motiform_dynamics::{Equivariant, Symmetry};
use serde::{Deserialize, Serialize};

/// Angles below this (rad) are none.
const NO_ANGLE: f64 = 1e-6;

motiform_dynamics::named! {
    /// The direction of a motion, among those that the symmetry distinguishes. With rotations and the mirror
    /// there are none.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Course by name {
        /// The heading turns anticlockwise, in a model without the mirror.
        Anticlockwise = "anticlockwise",
        /// The heading turns clockwise, in a model without the mirror.
        Clockwise = "clockwise",
        /// Along the field: towards +x, the mirror's axis; where half a turn is a symmetry, towards +x or -x.
        AlongField = "along-field",
        /// Against the field: towards -x.
        AgainstField = "against-field",
        /// Across the field: towards +y or -y.
        AcrossField = "across-field",
        /// At another angle to the field.
        ObliqueToField = "oblique-to-field",
    }
}

/// The direction of a motion, as far as the symmetry of the model distinguishes directions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Direction {
    /// Sense of rotation, or direction to the field.
    pub course: Option<Course>,
    /// Direction of the displacement (rad from the x-axis), where rotations are no symmetry.
    pub heading: Option<f64>,
}

impl Direction {
    /// Of a motion of this turning rate (rad per model time) and this displacement (model length); 0 for none.
    pub fn of(body: &dyn Equivariant, turning: Option<f64>, drift: [f64; 2]) -> Self {
        let symmetry = body.symmetry();
        let heading = (!symmetry.rotations && drift != [0.0; 2]).then(|| libm::atan2(drift[1], drift[0]));
        let turning = turning.and_then(|rate| Course::of_turning(symmetry, rate));
        let along = heading.and_then(|heading| Course::of_drift(symmetry, body.half_turn(), heading));
        Self { course: turning.or(along), heading }
    }
}

impl Course {
    /// Its name in sentences.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Anticlockwise | Self::Clockwise => self.name(),
            Self::AlongField => "along the field",
            Self::AgainstField => "against the field",
            Self::AcrossField => "across the field",
            Self::ObliqueToField => "oblique to the field",
        }
    }

    /// The hand of a motion whose heading turns at `rate` (rad per model time), where left and right differ.
    pub(super) fn of_turning(symmetry: Symmetry, rate: f64) -> Option<Self> {
        let turns = rate.is_finite() && rate != 0.0;
        (turns && !symmetry.mirror).then_some(if rate > 0.0 { Self::Anticlockwise } else { Self::Clockwise })
    }

    /// The direction of a drift against the mirror's axis, where rotations are no symmetry but the mirror is.
    /// A field that half a turn leaves as it is (`half_turn`) has no sense: both directions are along it.
    pub(super) fn of_drift(symmetry: Symmetry, half_turn: bool, angle: f64) -> Option<Self> {
        if symmetry.rotations || !symmetry.mirror || !angle.is_finite() {
            return None;
        }
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        Some(match (sin.abs() < NO_ANGLE, cos.abs() < NO_ANGLE) {
            (true, _) if cos > 0.0 || half_turn => Self::AlongField,
            (true, _) => Self::AgainstField,
            (_, true) => Self::AcrossField,
            _ => Self::ObliqueToField,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn only_what_the_symmetry_distinguishes_has_a_name() {
        let [full, handed, field, none] = Symmetry::NAMES.map(|named| named.1);
        assert_eq!(Course::of_turning(full, 1.0), None);
        assert_eq!(Course::of_turning(handed, -0.1), Some(Course::Clockwise));
        assert_eq!(Course::of_turning(none, 0.1), Some(Course::Anticlockwise));
        assert_eq!(Course::of_turning(handed, 0.0), None);
        for (angle, course) in [
            (0.0, Course::AlongField),
            (-PI, Course::AgainstField),
            (-FRAC_PI_2, Course::AcrossField),
            (0.3, Course::ObliqueToField),
        ] {
            assert_eq!(Course::of_drift(field, false, angle), Some(course));
            let axis = if course == Course::AgainstField { Course::AlongField } else { course };
            assert_eq!(Course::of_drift(field, true, angle), Some(axis));
            assert_eq!(Course::of_drift(handed, false, angle).or(Course::of_drift(none, false, angle)), None);
        }
    }
}
