//! Where a branch begins.

use super::family::Bodies;
use super::follow::{Followed, Leg, Sample};
use super::settle::{Start, closed};
use motiform_analysis::continuation::{Branch, End, Settings, Special, switch};
use motiform_analysis::symmetry::align;
use motiform_analysis::{Error as Refused, PeriodicOrbit, RelativeEquilibrium};
use motiform_dynamics::drive::drive;
use motiform_dynamics::{Equivariant, Request, Watch};
use serde::{Deserialize, Serialize};

/// What a branch was followed from. Branches, their legs and points are counted from 0 in the order in which they were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Origin {
    /// The motion that the plan's start settles on.
    Start,
    /// A special point: what begins or crosses there.
    Special {
        /// The branch.
        branch: usize,
        /// Its leg.
        leg: usize,
        /// The point of the leg.
        point: usize,
    },
    /// The end of a leg at a homoclinic connection: the saddle.
    Saddle {
        /// The branch.
        branch: usize,
        /// Its leg.
        leg: usize,
    },
    /// The same where both loops of the connection belong to one orbit, which is its own mirror image: an orbit along one of them.
    Loop {
        /// The branch.
        branch: usize,
        /// Its leg.
        leg: usize,
    },
    /// The end of a leg where an orbit shrinks to a steady motion: that motion.
    Shrinks {
        /// The branch.
        branch: usize,
        /// Its leg.
        leg: usize,
    },
}

impl Origin {
    /// What may begin on a branch, in the order of its legs.
    pub(super) fn on(number: usize, followed: &Followed) -> Vec<Self> {
        let mut all = Vec::new();
        for (leg, done) in followed.legs.iter().enumerate() {
            for (point, sample) in done.samples.iter().enumerate() {
                let leads_on = |special| !matches!(special, Special::Fold | Special::Torus { .. });
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
                _ => {}
            }
        }
        all
    }

    /// The time over which what begins is computed, as far as it is known before: 0 for steady motions.
    pub(super) fn cost(self, branches: &[Followed]) -> f64 {
        let period = |sample: Option<&Sample>| sample.and_then(|sample| sample.reading.period).unwrap_or(0.0);
        match self {
            Self::Start | Self::Saddle { .. } | Self::Shrinks { .. } => 0.0,
            Self::Special { branch, leg, point } => {
                let sample = &branches[branch].legs[leg].samples[point];
                match sample.point.special {
                    Some(Special::Hopf(hopf)) => hopf.period(),
                    Some(Special::PeriodDoubling) => 2.0 * period(Some(sample)),
                    _ => period(Some(sample)),
                }
            }
            // the loop is entered where its time is about half of the leg's longest
            Self::Loop { branch, leg } => 0.25 * period(branches[branch].legs[leg].samples.last()),
        }
    }

    /// The branch on which it lies.
    #[must_use]
    pub const fn branch(self) -> Option<usize> {
        match self {
            Self::Start => None,
            Self::Special { branch, .. }
            | Self::Saddle { branch, .. }
            | Self::Loop { branch, .. }
            | Self::Shrinks { branch, .. } => Some(branch),
        }
    }

    /// The legs that begin here: one to each side, or those on which new motions leave.
    pub(super) fn legs<'f>(
        self,
        bodies: &'f Bodies<'_>,
        branches: &[Followed],
        watch: &'f dyn Watch,
    ) -> Result<Vec<Branch<'f>>, Refused> {
        let settings = bodies.settings();
        match self {
            Self::Start => Ok(Vec::new()),
            Self::Special { branch, leg, point } => {
                switch(bodies, &branches[branch].legs[leg].samples[point].point, &settings, watch)
            }
            Self::Saddle { branch, leg } => {
                let leg = &branches[branch].legs[leg];
                let saddle = saddle(leg).ok_or_else(|| nothing("saddle", leg))?;
                both(bodies, parameter(leg), &Start::Equilibrium(saddle.clone()), watch)
            }
            Self::Loop { branch, leg } => {
                let leg = &branches[branch].legs[leg];
                let found = single_loop(bodies, leg, &settings, watch)?;
                let (parameter, found) = found.ok_or_else(|| nothing("loop", leg))?;
                both(bodies, parameter, &Start::Orbit(found), watch)
            }
            Self::Shrinks { branch, leg } => {
                let leg = &branches[branch].legs[leg];
                let body = bodies.model(parameter(leg))?;
                let shape = leg.samples.last().map_or(&[][..], |sample| sample.point.motion.shape());
                let found = RelativeEquilibrium::find(body.as_ref(), shape)
                    .ok_or_else(|| nothing("steady motion", leg))?;
                both(bodies, parameter(leg), &Start::Equilibrium(found), watch)
            }
        }
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
    let settings = bodies.settings();
    let (low, high) = settings.range;
    let sides = [(parameter > low, settings.reversed()), (parameter < high, settings)];
    let leg = |settings: &Settings| match start {
        Start::Equilibrium(start) => Branch::of_equilibria(bodies, parameter, start, settings, watch),
        Start::Orbit(start) => Branch::of_orbits(bodies, parameter, start, settings, watch),
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

fn nothing(what: &'static str, leg: &Leg) -> Refused {
    let why = "Newton's method finds none from the last orbit of the branch".to_owned();
    Refused::NotOnABranch { what, parameter: parameter(leg), why }
}

/// An orbit along one loop of a connection, where the orbits of the leg pass one loop and then its mirror image. Beside the saddle both
/// are nearly the same, up to the side on which they leave it: so the first guess is the shape closest to it. The closer an orbit is to
/// the connection the better the guess, but the more Newton's method amplifies: several are tried, from the end backwards.
fn single_loop(
    bodies: &Bodies<'_>,
    leg: &Leg,
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<Option<(f64, PeriodicOrbit)>, Refused> {
    let (Some(saddle), Some(longest)) = (saddle(leg), leg.samples.last().and_then(time)) else {
        return Ok(None);
    };
    for part in PARTS {
        let Some(sample) = leg.samples.iter().rev().find(|s| time(s) <= Some(part * longest)) else { break };
        let (parameter, Some(orbit)) = (sample.point.parameter, sample.point.motion.orbit()) else { break };
        let body = bodies.model(parameter)?;
        let beside = beside(body.as_ref(), orbit, saddle, settings);
        let found = beside
            .and_then(|shape| closed(body.as_ref(), &shape, (orbit.time, false), &settings.flow, watch));
        if let Some(found) = found {
            return Ok(Some((parameter, found)));
        }
    }
    Ok(None)
}

/// Times of the orbits that are tried, as parts of the longest.
const PARTS: [f64; 6] = [1.0, 0.8, 0.65, 0.5, 0.4, 0.3];

/// Shapes of an orbit of which the one closest to a saddle is taken.
const PLACES: usize = 400;

fn time(sample: &Sample) -> Option<f64> {
    sample.point.motion.orbit().map(|orbit| orbit.time)
}

/// The shape of an orbit that is closest to a saddle, up to rotations and the mirror.
fn beside(
    body: &dyn Equivariant,
    orbit: &PeriodicOrbit,
    saddle: &RelativeEquilibrium,
    settings: &Settings,
) -> Option<Vec<f64>> {
    let flow = &settings.flow;
    let mut solution = flow.method.shape_orbit(body, flow.control, 0.0, &orbit.shape).ok()?;
    let mut best = (f64::INFINITY, orbit.shape.clone());
    for place in 0..PLACES {
        let t = orbit.time * place as f64 / PLACES as f64;
        drive(solution.as_mut(), &Request::until(t, orbit.shape.len()), &mut ()).ok()?;
        let away = |mirrored| align(body, solution.state(), &saddle.shape, mirrored).distance;
        let distance = away(false).min(away(true));
        if distance < best.0 {
            best = (distance, solution.state().to_vec());
        }
    }
    Some(best.1)
}
