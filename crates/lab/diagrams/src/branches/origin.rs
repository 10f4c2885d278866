//! Where a branch begins.

use super::aside::aside;
use super::family::{Bodies, lasting};
use super::result::{Followed, Leg, Sample};
use super::settle::Start;
use super::single_loop::single_loop;
use motiform_analysis::{Error as Refused, Isotropy, PeriodicOrbit, RelativeEquilibrium};
use motiform_continuation::{Branch, Broken, End, Motion, Settings, Special, switch};
use motiform_dynamics::{Equivariant, Watch};
use motiform_study::Towards;
use serde::{Deserialize, Serialize};

/// The origin of a branch. Branches, their legs and points are counted from 0 in the order in which they were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
#[allow(missing_docs, reason = "a branch, a leg of it, a point of the leg")]
pub enum Origin {
    /// The motion that the plan's start settles on.
    Start,
    /// A special point: what begins or crosses there.
    Special { branch: usize, leg: usize, point: usize },
    /// The end of a leg at a homoclinic connection: the saddle.
    Saddle { branch: usize, leg: usize },
    /// The same where both loops of the connection belong to one orbit, which is its own mirror image: an orbit along one of them.
    Loop { branch: usize, leg: usize },
    /// The end of a leg where its motion gains a symmetry: the motion of more symmetry there.
    Meets { branch: usize, leg: usize },
    /// The end of a leg where an orbit shrinks to a steady motion: that motion.
    Shrinks { branch: usize, leg: usize },
}

impl Origin {
    /// Origins of further branches on a branch, in the order of its legs.
    pub(super) fn on(number: usize, followed: &Followed) -> Vec<Self> {
        let mut all = Vec::new();
        for (leg, done) in followed.legs.iter().enumerate() {
            for (point, sample) in done.samples.iter().enumerate().filter(|(point, _)| !done.meets_at(*point))
            {
                let leads_on = |special| {
                    let touches = matches!(special, Special::Touch { .. });
                    let unfollowed = matches!(
                        special,
                        Special::Fold
                            | Special::Continuum
                            | Special::Torus { .. }
                            | Special::Unresolved { .. }
                            | Special::Touch { seen: "hopf", .. }
                    );
                    !(unfollowed || touches && sample.point.motion.orbit().is_some())
                };
                if sample.point.special.is_some_and(leads_on) {
                    all.push(Self::Special { branch: number, leg, point });
                }
            }
            match &done.end {
                End::Homoclinic(_) => {
                    all.push(Self::Saddle { branch: number, leg });
                    let last = done.samples.last().and_then(|sample| sample.point.motion.orbit());
                    if last.is_some_and(|orbit| orbit.mirrored) {
                        all.push(Self::Loop { branch: number, leg });
                    }
                }
                End::Shrinks { .. } => all.push(Self::Shrinks { branch: number, leg }),
                End::Meets { .. } => all.push(Self::Meets { branch: number, leg }),
                _ => {}
            }
        }
        all
    }

    /// The period of what begins at a special point, and 0 at the end of a branch: ends are few, and lead to other kinds of motion.
    pub(super) fn cost(self, branches: &[Followed]) -> f64 {
        let period = |sample: Option<&Sample>| sample.and_then(|sample| sample.reading.period).unwrap_or(0.0);
        match self {
            Self::Start
            | Self::Saddle { .. }
            | Self::Loop { .. }
            | Self::Meets { .. }
            | Self::Shrinks { .. } => 0.0,
            Self::Special { branch, leg, point } => {
                let sample = &branches[branch].legs[leg].samples[point];
                match sample.point.special {
                    Some(Special::Hopf(hopf)) => hopf.period(),
                    Some(Special::PeriodDoubling) => 2.0 * period(Some(sample)),
                    _ => period(Some(sample)),
                }
            }
        }
    }

    /// Returns `true` if steady motions begin here: at a Hopf bifurcation those of a circle that begins to turn.
    pub(super) fn is_steady(self, bodies: &Bodies<'_>, branches: &[Followed]) -> bool {
        match self {
            Self::Special { branch, leg, point } => {
                let point = &branches[branch].legs[leg].samples[point].point;
                match (&point.motion, point.special) {
                    (Motion::Orbit { .. }, _) => false,
                    (Motion::Equilibrium(at), Some(Special::Hopf(_))) => {
                        let body = bodies.model(point.parameter);
                        body.is_ok_and(|body| Isotropy::of(body.as_ref(), &at.shape, Isotropy::SAME).circle)
                    }
                    _ => true,
                }
            }
            Self::Loop { .. } => false,
            _ => true,
        }
    }

    /// `true` if a motion that is stable on one side of it loses its stability here, and at the ends of branches, which lead to steady
    /// motions.
    pub(super) fn is_on_stable(self, branches: &[Followed]) -> bool {
        let stable = |sample: Option<&Sample>| sample.is_some_and(|sample| sample.point.unstable == 0);
        let ordinary = |sample: &&Sample| sample.point.special.is_none();
        match self {
            Self::Special { branch, leg, point } => {
                let samples = &branches[branch].legs[leg].samples;
                stable(samples[..point].iter().rev().find(ordinary))
                    || stable(samples[point..].iter().find(ordinary))
            }
            Self::Loop { branch, leg } => stable(branches[branch].legs[leg].samples.last()),
            _ => true,
        }
    }

    /// Doublings of the period in a row that lead here, this one included.
    pub(super) fn doublings(self, branches: &[Followed]) -> u64 {
        match self {
            Self::Special { branch, leg, point } => {
                let here = &branches[branch];
                match here.legs[leg].samples[point].point.special {
                    Some(Special::PeriodDoubling) => 1 + here.origin.doublings(branches),
                    _ => 0,
                }
            }
            _ => 0,
        }
    }

    /// The branches that begin here, each with its legs: one to each side, or those on which new motions leave.
    pub(super) fn branches<'f>(
        self,
        bodies: &'f Bodies<'_>,
        branches: &[Followed],
        watch: &'f dyn Watch,
    ) -> Result<Vec<Vec<Branch<'f>>>, Refused> {
        let mut settings = bodies.settings();
        settings.steady |= bodies.plan.computation.stride.from_stable && !self.is_on_stable(branches);
        let legs = match self {
            Self::Start => Ok(Vec::new()),
            Self::Special { branch, leg, point } => {
                let point = &branches[branch].legs[leg].samples[point].point;
                return switch(bodies, point, &lasting(&settings, self.cost(branches)), watch);
            }
            Self::Saddle { branch, leg } => {
                let leg = &branches[branch].legs[leg];
                let saddle = saddle(leg).ok_or_else(|| nothing("saddle", leg))?;
                both(bodies, parameter(leg), &Start::Equilibrium(saddle.clone()), watch)
            }
            Self::Loop { branch, leg } => {
                let leg = &branches[branch].legs[leg];
                let saddle = saddle(leg).ok_or_else(|| nothing("saddle", leg))?;
                single_loop(bodies, leg, saddle, watch)?.ok_or_else(|| nothing("loop", leg))
            }
            Self::Meets { branch, leg } => {
                let leg = &branches[branch].legs[leg];
                let body = bodies.model(parameter(leg))?;
                let met = met(body.as_ref(), leg, &settings, watch)
                    .ok_or_else(|| nothing("motion of more symmetry", leg))?;
                let (parameter, met) = aside(bodies, parameter(leg), met, &settings, watch);
                both(bodies, parameter, &met, watch)
            }
            Self::Shrinks { branch, leg } => {
                let leg = &branches[branch].legs[leg];
                let body = bodies.model(parameter(leg))?;
                let shape = leg.samples.last().map_or(&[][..], |sample| sample.point.motion.shape());
                let found = RelativeEquilibrium::find(body.as_ref(), shape)
                    .ok_or_else(|| nothing("steady motion", leg))?;
                let start = Start::Equilibrium(found);
                let (parameter, start) = aside(bodies, parameter(leg), start, &settings, watch);
                both(bodies, parameter, &start, watch)
            }
        };
        legs.map(|legs| vec![legs])
    }
}

/// The branch through a motion, towards smaller values of the parameter and towards larger ones; where it lies at the edge of the range,
/// to one side.
pub(super) fn both<'f>(
    bodies: &'f Bodies<'_>,
    parameter: f64,
    start: &Start,
    watch: &'f dyn Watch,
) -> Result<Vec<Branch<'f>>, Refused> {
    sides(bodies, parameter, start, &bodies.settings(), Towards::Both, watch)
}

/// The same with these settings, as far as the sides are asked for.
pub(super) fn sides<'f>(
    bodies: &'f Bodies<'_>,
    parameter: f64,
    start: &Start,
    settings: &Settings,
    towards: Towards,
    watch: &'f dyn Watch,
) -> Result<Vec<Branch<'f>>, Refused> {
    let (low, high) = settings.range;
    let sides = [
        (towards.is_down() && parameter > low, settings.reversed()),
        (towards.is_up() && parameter < high, *settings),
    ];
    let leg = |settings: &Settings| match start {
        Start::Equilibrium(start) => {
            let body = bodies.model(parameter)?;
            Branch::of_equilibria(bodies, parameter, &upright(body.as_ref(), start), settings, watch)
        }
        Start::Orbit(start) => {
            Branch::of_orbits(bodies, parameter, start, &lasting(settings, start.time), watch)
        }
    };
    sides.iter().filter(|(inside, _)| *inside).map(|(_, settings)| leg(settings)).collect()
}

/// The parameter of a leg's last point.
fn parameter(leg: &Leg) -> f64 {
    leg.samples.last().map_or(f64::NAN, |sample| sample.point.parameter)
}

fn saddle(leg: &Leg) -> Option<&RelativeEquilibrium> {
    match &leg.end {
        End::Homoclinic(connection) => connection.saddle.as_ref(),
        _ => None,
    }
}

/// The motion of more symmetry at the end of a leg: the steady motion or the orbit there, or the orbit of half of the period.
pub(super) fn met(
    body: &dyn Equivariant,
    leg: &Leg,
    settings: &Settings,
    watch: &dyn Watch,
) -> Option<Start> {
    let mirrored = match leg.end {
        End::Meets { gains: Broken::MirrorAfterHalf, .. } => true,
        End::Meets { gains: Broken::HalfPeriod, .. } => false,
        _ => {
            return Some(match &leg.samples.last()?.point.motion {
                Motion::Equilibrium(met) => Start::Equilibrium(met.clone()),
                Motion::Orbit { orbit, .. } => Start::Orbit(orbit.clone()),
            });
        }
    };
    let orbit = leg.samples.last()?.point.motion.orbit()?;
    let found = PeriodicOrbit::near(body, &orbit.shape, 0.5 * orbit.time, mirrored, &settings.flow, watch);
    found.map(Start::Orbit)
}

fn nothing(what: &'static str, leg: &Leg) -> Refused {
    let why = "Newton's method finds none from the last orbit of the branch".to_owned();
    Refused::NotOnABranch { what, parameter: parameter(leg), why }
}

/// The same motion turned so that its mirror axis, if it has one, is that of the plane.
fn upright(body: &dyn Equivariant, start: &RelativeEquilibrium) -> RelativeEquilibrium {
    let mut turned = start.clone();
    if let Some(axis) = Isotropy::of(body, &start.shape, Isotropy::SAME).mirror {
        body.rotate(-0.5 * axis, &mut turned.shape);
    }
    turned
}
