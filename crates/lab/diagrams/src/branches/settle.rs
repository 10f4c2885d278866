//! The motion that a start settles on, as Newton's method has it.

use super::family::Bodies;
use motiform_analysis::regime::settle as settled;
use motiform_analysis::{Attractor, PeriodicOrbit, Regime, RelativeEquilibrium, Verdict};
use motiform_continuation::Settings;
use motiform_dynamics::digits::given;
use motiform_dynamics::{Equivariant, StopOnly, Watch};
use motiform_study::branches::Along;
use motiform_study::{BranchPlan, Error};

/// A motion to begin with.
#[derive(Clone, Debug, PartialEq)]
pub enum Start {
    /// A shape that does not change but for a steady rotation.
    Equilibrium(RelativeEquilibrium),
    /// A shape that comes back.
    Orbit(PeriodicOrbit),
}

/// The motion that the plan's start settles on, with its verdict; `None` if the watch stopped it.
///
/// # Errors
/// [`Error::Start`] if it is not the motion asked for, or none that can be followed.
pub fn settle(plan: &BranchPlan, watch: &dyn Watch) -> Result<Option<(Start, Verdict)>, Error> {
    let bodies = Bodies::new(plan)?;
    let model = bodies.model(plan.start_value())?;
    let shape = model.encoded(&plan.computation.start.initial.values()[..model.dim()]);
    let found = settled(model.as_ref(), &shape, &bodies.looks(), &StopOnly(watch))?;
    let Some((verdict, shape)) = found else { return Ok(None) };
    check(plan, &verdict)?;
    let start = polish(model.as_ref(), &verdict, &shape, &bodies.settings(), watch);
    match start {
        Some(start) => Ok(Some((start, verdict))),
        None if watch.stopped() => Ok(None),
        None => Err(refused(&verdict, "where Newton's method finds no such motion: start elsewhere")),
    }
}

/// Refuses a motion that is not the one asked for, or is neither steady nor repeats. One that is undetermined may be at its bifurcation:
/// a start farther from it may decide, and its branch passes here.
fn check(plan: &BranchPlan, verdict: &Verdict) -> Result<(), Error> {
    if verdict.regime == Regime::Undetermined {
        let (Along { name, from, to }, here) = (&plan.computation.along, plan.start_value());
        let there = 0.5 * (here + if here - from > to - here { from } else { to });
        let problem = format!(
            "so that it is not known what to follow; if that is a bifurcation, a start elsewhere may decide: {name} = {}",
            given(there)
        );
        return Err(refused(verdict, &problem));
    }
    if !matches!(verdict.attractor, Attractor::Equilibrium | Attractor::Unstable | Attractor::Periodic) {
        return Err(refused(
            verdict,
            "which neither is steady nor repeats, so that there is no branch of it: choose another start or other \
             parameters",
        ));
    }
    match plan.computation.origin {
        Some(asked) if asked != verdict.regime => Err(refused(
            verdict,
            &format!(
                "not on {asked} motion as asked for: choose another start (an initial state, a seed) or other parameters, \
                 or begin with the motion it settles on"
            ),
        )),
        _ => Ok(()),
    }
}

fn refused(verdict: &Verdict, problem: &str) -> Error {
    Error::Start { found: verdict.regime.name(), why: verdict.why.clone(), problem: problem.to_owned() }
}

/// The motion as Newton's method has it, from a shape close to it.
fn polish(
    body: &dyn Equivariant,
    verdict: &Verdict,
    shape: &[f64],
    settings: &Settings,
    watch: &dyn Watch,
) -> Option<Start> {
    if verdict.period.is_none() {
        return RelativeEquilibrium::find(body, shape).map(Start::Equilibrium);
    }
    verdict.orbit(body, shape, &settings.flow, &StopOnly(watch)).map(Start::Orbit)
}
