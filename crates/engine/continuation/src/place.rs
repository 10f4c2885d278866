//! A solution with its tangent and its levels.

use super::certificate::Certificate;
use super::correct::{Corrected, scaled};
use super::elimination::newton_step;
use super::levels::Level;
use super::point::Obstruction;
use super::problem::{Failure, Problem};
use motiform_analysis::linear::dot;

/// A solution with all that is known there.
pub(super) struct Place<L> {
    pub(super) x: Vec<f64>,
    pub(super) local: L,
    pub(super) tangent: Vec<f64>,
    pub(super) levels: Vec<Vec<Level>>,
    pub(super) arclength: f64,
    /// At a special point, what shows that it is one.
    pub(super) certificate: Option<Certificate>,
}

/// The place before the present one.
pub(super) struct Before {
    pub(super) x: Vec<f64>,
    pub(super) tangent: Vec<f64>,
    pub(super) levels: Vec<Vec<Level>>,
    /// Length of the step from there.
    pub(super) length: f64,
}

impl<L> Place<L> {
    pub(super) fn parameter(&self) -> f64 {
        self.x.last().copied().unwrap_or(f64::NAN)
    }

    pub(super) fn slope(&self) -> f64 {
        self.tangent.last().copied().unwrap_or(f64::NAN)
    }
}

/// A solution, with its tangent on the side of `row`.
pub(super) fn place<P: Problem>(
    problem: &P,
    found: Corrected<P::Local>,
    row: &[f64],
    arclength: f64,
) -> Result<Place<P::Local>, Failure> {
    let Corrected { x, mut local, mut direction, .. } = found;
    let broken = || Failure::Obstructed(Obstruction::Singular);
    if problem.time().is_none() {
        // close to a crossing a step that is shorter than the tolerance turns the direction
        local = problem.local(&x, &())?;
        direction = newton_step(problem.linear(&local), row).map_or(direction, |(_, there)| there);
    }
    let mut tangent = scaled(direction, &problem.weights(&x)).ok_or_else(broken)?;
    if dot(row, &tangent) < 0.0 {
        tangent.iter_mut().for_each(|t| *t = -*t);
    }
    let levels = problem.levels(&x, &local).ok_or_else(broken)?;
    Ok(Place { x, local, tangent, levels, arclength, certificate: None })
}
