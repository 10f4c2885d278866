//! Lyapunov exponents: of one orbit, and means over many.

use super::{About, decimals, estimate};
use crate::naming;
use crate::samples::{self, Escapes, Starts};
use motiform_analysis::{Estimate, Lyapunov, Regime};
use motiform_dynamics::Outcome;
use motiform_study::{Error, Plan};
use serde::Serialize;
use std::fmt::{Display, Formatter, Result};

/// The exponents of one orbit.
#[derive(Clone, Debug, Serialize)]
pub struct OfOrbit<'a> {
    exponents: &'a [Estimate],
    zeros: Vec<Estimate>,
    neutral: usize,
    time: f64,
    transient: f64,
    outcome: &'a Outcome,
    #[serde(skip_serializing_if = "Option::is_none")]
    dimension: Option<Estimate>,
    #[serde(skip)]
    widened: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    without_error: Option<String>,
}

impl<'a> OfOrbit<'a> {
    /// The exponents of an orbit.
    pub fn new(found: &'a Lyapunov) -> Self {
        Self {
            exponents: &found.exponents,
            zeros: found.zeros(),
            neutral: found.neutral,
            time: found.time,
            transient: found.transient,
            outcome: &found.outcome,
            dimension: found.dimension(),
            widened: found.widened,
            without_error: found.without_error(),
        }
    }
}

/// An unstable motion that a run of exact symmetry stays on, and its growth rate.
#[derive(Clone, Copy, Debug, Serialize)]
struct Unstable {
    motion: Regime,
    growth: f64,
}

/// The exponents of the motion of a plan.
#[derive(Clone, Debug, Serialize)]
pub struct Exponents<'a> {
    #[serde(flatten)]
    about: About<'a>,
    #[serde(flatten)]
    orbit: OfOrbit<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    unstable: Option<Unstable>,
    #[serde(skip)]
    plan: &'a Plan,
}

impl<'a> Exponents<'a> {
    /// The exponents of the motion of a plan.
    ///
    /// # Errors
    /// An unknown model.
    pub fn new(plan: &'a Plan, found: &'a Lyapunov) -> std::result::Result<Self, Error> {
        let unstable = naming::unstable_under(plan, found)?;
        let unstable = unstable.map(|(motion, growth)| Unstable { motion, growth });
        Ok(Self { about: About::of(plan), orbit: OfOrbit::new(found), unstable, plan })
    }
}

impl Display for Exponents<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let found = &self.orbit;
        if found.exponents.is_empty() {
            return write!(f, "no exponents: the run {}", found.outcome);
        }
        values(f, found.exponents, found.without_error.as_deref())?;
        check(f, found)?;
        if let Some(dimension) = found.dimension {
            let dimension = estimate(&dimension, 0, 4);
            writeln!(f, "dimension  {dimension} (Kaplan-Yorke; of all shapes, rotated copies included)")?;
        }
        if let Some(Unstable { motion, growth }) = self.unstable {
            writeln!(
                f,
                "unstable   the run stays on {motion} motion, growth rate {growth:.2e}: its start has an exact symmetry, and \
                 these are the exponents of that motion; a typical start leaves it"
            )?;
        }
        let digits = if found.time < 10.0 { 4 } else { 0 };
        let c = &self.plan.computation;
        write!(
            f,
            "averaged over {:.digits$} model time after {:.0} ({}, {})",
            found.time, found.transient, c.stepper, c.control
        )
    }
}

/// The values, and why they have no error.
fn values(f: &mut Formatter<'_>, exponents: &[Estimate], without_error: Option<&str>) -> Result {
    let digits = decimals(exponents, 6);
    for (i, exponent) in exponents.iter().enumerate() {
        writeln!(f, "lambda_{}   {}", i + 1, estimate(exponent, digits + 5, digits))?;
    }
    without_error.map_or(Ok(()), |why| writeln!(f, "no error   {why}"))
}

/// The exponents that must be 0.
fn check(f: &mut Formatter<'_>, found: &OfOrbit<'_>) -> Result {
    if found.neutral == 0 || found.exponents.len() <= found.neutral {
        return Ok(());
    }
    let zeros = &found.zeros;
    let worst = zeros.iter().map(|zero| zero.value.abs()).fold(0.0, f64::max);
    let known = zeros.iter().all(Estimate::has_error);
    let verdict = match (known, found.widened) {
        (false, _) => "which is inconclusive: run longer",
        (true, false) => "within their errors (bounds, which decrease like 1/time)",
        (true, true) => "more than averages scatter, so that all errors are at least twice that: run longer",
    };
    writeln!(f, "self-check {} exponents must be 0: at most {worst:.1e} off, {verdict}", found.neutral)
}

/// An orbit among many.
#[derive(Clone, Copy, Debug, Serialize)]
struct Orbit<'a> {
    exponents: &'a [Estimate],
    outcome: &'a Outcome,
}

/// Means of exponents over the orbits of many initial states.
#[derive(Clone, Debug, Serialize)]
pub struct MeanExponents<'a> {
    #[serde(flatten)]
    about: About<'a>,
    exponents: &'a [Estimate],
    agree: bool,
    lasted: usize,
    starts: &'a Starts,
    orbits: Vec<Orbit<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    escapes: Option<&'a Escapes>,
    #[serde(skip_serializing_if = "Option::is_none")]
    without_error: Option<String>,
}

impl<'a> MeanExponents<'a> {
    /// The exponents of the orbits of a plan that begin at these starts.
    pub fn new(
        plan: &'a Plan,
        found: &'a samples::Exponents,
        starts: &'a Starts,
        escapes: Option<&'a Escapes>,
    ) -> Self {
        let orbit = |orbit: &'a Lyapunov| Orbit { exponents: &orbit.exponents, outcome: &orbit.outcome };
        Self {
            about: About::of(plan),
            exponents: &found.means,
            agree: found.agree,
            lasted: found.orbits.iter().filter(|orbit| orbit.outcome.is_complete()).count(),
            starts,
            orbits: found.orbits.iter().map(orbit).collect(),
            escapes,
            without_error: found.without_error(),
        }
    }

    /// Returns `true` if all orbits lasted and agree, and the means have errors.
    pub fn is_whole(&self) -> bool {
        self.lasted == self.orbits.len() && self.agree && self.without_error.is_none()
    }
}

impl Display for MeanExponents<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        values(f, self.exponents, self.without_error.as_deref())?;
        let (lasted, all) = (self.lasted, self.orbits.len());
        write!(f, "means over {lasted} of {all} orbits; {}", self.starts.sentence())?;
        if lasted < all {
            write!(f, "; the others ended early")?;
        }
        for line in self.escapes.into_iter().flat_map(|escapes| escapes.words(all)) {
            write!(f, "\nescape     {line}")?;
        }
        if !self.agree {
            write!(f, "\nThe orbits do not agree: they lead to different motions")?;
        }
        Ok(())
    }
}
