//! Branches that end where others would begin.

use super::family::Bodies;
use super::origin::{Origin, met};
use super::result::{Followed, Leg};
use super::settle::Start;
use motiform_continuation::{Broken, End, Motion, Special, same_motion};
use motiform_dynamics::Watch;

/// Orbits at one special point, located on two branches, agree up to this part of their size.
const SAME: f64 = 1e-4;

/// Part of the range by which the parameters of two such points may differ beside their errors.
const ROUND_OFF: f64 = 1e-9;

/// The branch that ends where a period doubles (or an orbit loses that it is its own mirror image half a period later): one alone begins
/// there, so it need not be followed back from this end.
pub(super) fn arrives(
    bodies: &Bodies<'_>,
    branches: &[Followed],
    origin: Origin,
    watch: &dyn Watch,
) -> Option<usize> {
    let Origin::Special { branch, leg, point } = origin else { return None };
    let here = &branches[branch].legs[leg].samples[point].point;
    let gained = match here.special {
        Some(Special::PeriodDoubling) => Broken::HalfPeriod,
        Some(Special::SymmetryBreaking) => Broken::MirrorAfterHalf,
        _ => return None,
    };
    let settings = bodies.settings();
    let body = bodies.model(here.parameter).ok()?;
    let room = ROUND_OFF * settings.width() + here.certificate.map_or(0.0, |shown| shown.error);
    let ends_here = |leg: &Leg| {
        let error =
            leg.samples.last().and_then(|last| last.point.certificate).map_or(0.0, |shown| shown.error);
        let near = |parameter: f64| (parameter - here.parameter).abs() <= room + error;
        let End::Meets { parameter, gains } = leg.end else { return false };
        if gains != gained || !near(parameter) {
            return false;
        }
        let Some(Start::Orbit(orbit)) = met(body.as_ref(), leg, &settings, watch) else { return false };
        let motion = Motion::Orbit { orbit, nodes: Vec::new() };
        same_motion(body.as_ref(), &here.motion, &motion, &settings.flow, SAME)
    };
    branches.iter().position(|followed| followed.legs.iter().any(ends_here))
}
