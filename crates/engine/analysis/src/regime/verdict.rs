//! The result of a classification: the regime, the evidence for it, and its margin.

use crate::Estimate;
use crate::equilibrium::Saddle;
use crate::regime::course::{Course, Direction};
use crate::regime::form::Form;
use crate::regime::resolution::Resolution;
use motiform_dynamics::{Equivariant, in_words};
use serde::{Deserialize, Serialize};

motiform_dynamics::named! {
    /// The motions, defined by the reduced dynamics and the drift of the group (never by eye).
    ///
    /// 'Reduced' means: shapes that differ by a rotation count as one. Their order is that of legends.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Regime by name {
        /// A fixed shape at rest: a circle, or a deformed body.
        Motionless = "motionless",
        /// A fixed shape that moves without turning.
        Straight = "straight",
        /// A shape that repeats and is mirror symmetric at every moment: constant heading, changing speed.
        PulsatingStraight = "pulsating-straight",
        /// A fixed shape that moves and turns at a constant rate: the body goes round a circle.
        Circular = "circular",
        /// A fixed shape that turns at a constant rate and does not move: the body stays in its place.
        Spinning = "spinning",
        /// A heteroclinic cycle between motionless shapes: rests, and turns in between.
        Rectangular = "rectangular",
        /// A shape that repeats up to a rotation, with a net rotation per period (a 2-torus in the plane); or a torus of
        /// reduced shapes.
        QuasiPeriodic = "quasi-periodic",
        /// A shape that repeats up to a rotation without net rotation: the body travels on.
        Zigzag = "zigzag",
        /// The largest Lyapunov exponent is positive.
        Chaotic = "chaotic",
        /// The shape leaves every bound in finite time.
        BlowUp = "blow-up",
        /// The evidence does not decide.
        #[default]
        Undetermined = "undetermined",
    }
}

impl Regime {
    /// Its name in sentences, on pages and in figures; [`Self::name`] is that of tables and options.
    pub fn words(self) -> String {
        in_words(self.name())
    }

    /// The motion of a body in this regime, in one sentence.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Motionless => "A fixed shape at rest: a circle, or a deformed body.",
            Self::Straight => "A fixed shape that moves without turning.",
            Self::PulsatingStraight => "A shape that repeats while the body keeps to a straight line.",
            Self::Circular => {
                "A fixed shape that moves and turns at a constant rate: the body goes round a circle."
            }
            Self::Spinning => "A fixed shape that turns in its place at a constant rate.",
            Self::Rectangular => {
                "Straight runs, rests, and turns in between: a cycle between motionless shapes."
            }
            Self::QuasiPeriodic => {
                "A shape that repeats up to a rotation, with a net rotation per period: a rosette that never closes."
            }
            Self::Zigzag => {
                "A shape that repeats up to a rotation, without net rotation: the body travels on, left and right by turns."
            }
            Self::Chaotic => "Neighbouring motions move apart: the largest Lyapunov exponent is positive.",
            Self::BlowUp => "The shape grows beyond every bound, in finite time or at a constant rate.",
            Self::Undetermined => "The evidence does not decide.",
        }
    }
}

motiform_dynamics::named! {
    /// The kind of set that the reduced orbit ends on: what the mathematics decides, before it is called a motion.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Attractor by name {
        /// A stable relative equilibrium: a fixed point of the reduced dynamics.
        Equilibrium = "equilibrium",
        /// An unstable relative equilibrium, on which only an orbit of exact symmetry stays. No attractor: a typical start leaves it.
        Unstable = "unstable",
        /// A relative periodic orbit.
        Periodic = "periodic",
        /// A torus of the reduced dynamics.
        Torus = "torus",
        /// A cycle of saddles and the orbits that connect them.
        Heteroclinic = "heteroclinic",
        /// A chaotic set.
        Chaotic = "chaotic",
        /// None: the orbit leaves every bound.
        Escape = "escape",
        /// Not decided.
        #[default]
        Unknown = "unknown",
    }
}

/// Mean and extremes of a quantity over the motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Time average.
    pub mean: f64,
    /// Smallest value of the samples (720 of a period, in equal steps of time).
    pub min: f64,
    /// Largest value of the samples.
    pub max: f64,
    /// 95 % error of the average; absent where it has the accuracy of the motion itself, or a part of the motion is too short for one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<f64>,
}

/// A classified motion. What has no meaning for the regime is absent.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// The motion.
    pub regime: Regime,
    /// The kind of reduced attractor.
    pub attractor: Attractor,
    /// The symmetry of a motion that repeats.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub form: Option<Form>,
    /// Its direction, where the model prefers one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub course: Option<Course>,
    /// Direction of the velocity, or of the drift of a motion that repeats (rad, from the x axis), in a model without rotations.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub heading: Option<f64>,
    /// The evidence in one sentence, with its numbers.
    pub why: String,
    /// The distance of the deciding number from the value at which the decision would change, in units of its
    /// own uncertainty or tolerance: 1 and less is weak, 10 is clear. Absent where nothing was decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// The change of its numbers with more modes, where the model has a parameter for their number.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub resolution: Option<Resolution>,
    /// Speed of the centre of mass (model length per model time).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed: Option<Spread>,
    /// Mean turning rate (rad per model time): the heading's, over the motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turning_rate: Option<f64>,
    /// Its 95 % error, where it is an average over a part of the motion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turning_error: Option<f64>,
    /// Period (model time): after it the body is as it was, but for the net rotation. Two returns of the
    /// shape where it comes back mirrored, or turned by half a turn on a line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub period: Option<f64>,
    /// Net rotation of the body per period (rad, in -pi..pi).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub net_rotation: Option<f64>,
    /// Distance travelled per period (model length), for motions that repeat.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift: Option<f64>,
    /// Lyapunov exponents, largest first (inverse model time): of the equilibrium, of the periodic orbit, or measured.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub exponents: Vec<Estimate>,
    /// The rates of the saddles that a heteroclinic cycle rests at (inverse model time).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub saddle: Option<Saddle>,
    /// Turns from leg to leg (rad, in -pi..pi).
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub legs: Vec<f64>,
    /// Peak-to-peak swing of the heading over one period (rad), where it does not turn on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub swing: Option<f64>,
    /// Durations of the rests (model time), in order.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub rests: Vec<f64>,
    /// For chaos: the model time for which it was seen to last, at least. A chaotic transient looks the same until it ends.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub lasted: Option<f64>,
    /// The blow-up time t*.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub escape_time: Option<f64>,
    /// Model time that the decision took.
    pub time: f64,
}

impl Verdict {
    /// Notes the direction of a motion of this turning rate (rad per model time) and this drift (model length), as far as the
    /// symmetry of the model distinguishes directions.
    pub(super) fn directed(&mut self, body: &dyn Equivariant, turning: Option<f64>, drift: [f64; 2]) {
        Direction { course: self.course, heading: self.heading } = Direction::of(body, turning, drift);
    }

    /// This verdict, or 'undetermined' where its margin is below 1: what was found, and that its errors do not let it be told.
    #[must_use]
    pub(super) fn or_undetermined(mut self) -> Self {
        let Some(margin) = self.margin.filter(|margin| *margin < 1.0 || margin.is_nan()) else { return self };
        let named = self.regime;
        self.why = format!(
            "{}; but the quantity that decides between {named} and another motion is {margin:.2} times its uncertainty: not resolved",
            self.why
        );
        (self.regime, self.attractor, self.form, self.margin) =
            (Regime::Undetermined, Attractor::Unknown, None, None);
        self.course = None;
        self
    }

    /// A verdict without evidence beyond `why`.
    pub fn new(regime: Regime, attractor: Attractor, why: String, time: f64) -> Self {
        Self { regime, attractor, why, time, ..Self::default() }
    }
}
