//! Does a curve of returns shrink onto a stable periodic orbit?
//!
//! Beside a bifurcation of a torus the returns of an orbit fill a closed curve that shrinks as slowly as the
//! multiplier of the periodic orbit inside is near 1: by a tenth in a look. What they shrink by is compared
//! with what the multipliers say.

use super::case::Case;
use super::look::{Extreme, Look};
use super::moments::is_a_point;
use super::place::find_placed;
use super::recurrence::Recurrence;
use super::returns;
use super::shortest::shortest;
use crate::linear::{add, norm};
use crate::periodic::{PeriodicGuess, PeriodicOrbit};
use crate::symmetry::{align, wrap};
use motiform_dynamics::distributions::student_quantile;

/// Most returns per period of the orbit inside.
const LONGEST: usize = 8;

/// Fewest and most returns that are looked at.
const RETURNS: (usize, usize) = (80, 1000);

/// Parts of a look whose mean sizes are compared.
const PARTS: usize = 8;

/// A rate may be slower than the one of the multipliers by this part: the curve has a size.
const LIKE: f64 = 0.3;

/// Closed curves of returns whose sizes differ by less than this part are the same.
const AS_LARGE: f64 = 0.01;

/// The closed curve that the returns of the latest look lay on.
#[derive(Debug, Default)]
pub(super) struct Curve {
    size: Option<f64>,
}

impl Curve {
    /// Takes in a look whose returns lie on a closed curve, or not. Whether it is the second one in a row
    /// with a curve of this size: beside an unstable torus an orbit stays for thousands of turns, while the
    /// curve slowly changes.
    pub(super) fn is_seen_again(&mut self, look: &Look, closed: bool) -> bool {
        let size = closed.then(|| returns::width(&look.minima()));
        let before = std::mem::replace(&mut self.size, size);
        size.zip(before).is_some_and(|(size, before)| (size / before - 1.0).abs() < AS_LARGE)
    }
}

/// The stable periodic orbit that the returns of a look shrink onto, at least as fast as its multipliers say,
/// and its recurrence. `None` where that is not seen: there is none, it is unstable, they stay away from it,
/// or the look is too short to tell.
pub(super) fn shrinking_onto(case: Case<'_>, look: &Look) -> Option<(PeriodicOrbit, Recurrence)> {
    let minima = look.minima();
    let last = &minima[minima.len().saturating_sub(RETURNS.1)..];
    if last.len() < RETURNS.0 {
        return None;
    }
    let is_orbit = |orbit: &PeriodicOrbit| orbit.is_stable() && !is_a_point(case, orbit);
    let (orbit, recurrence) = inside(case, last).filter(|(orbit, _)| is_orbit(orbit))?;
    let centre = minimum_of(case, &orbit, last[last.len() - 1])?;
    let step = if recurrence.mirrored { 2 * recurrence.returns } else { recurrence.returns };
    let sizes: Vec<(f64, f64)> = last
        .iter()
        .rev()
        .step_by(step)
        .map(|minimum| (minimum.t, libm::log(align(case.body, &minimum.shape, &centre, false).distance)))
        .collect();
    let (rate, error) = slope(&sizes)?;
    let expected = libm::log(orbit.growth()) / orbit.time;
    // a curve of some size shrinks faster than a small one beside the bifurcation in which a torus arises
    let as_fast = rate - error <= (1.0 - LIKE) * expected;
    (rate + error < 0.0 && as_fast).then(|| shortest(case, orbit, recurrence))
}

/// The periodic orbit in the middle of the returns, if Newton's method finds one: from the mean of those shapes that are alike.
fn inside(case: Case<'_>, minima: &[&Extreme]) -> Option<(PeriodicOrbit, Recurrence)> {
    let Case { body, settings, watch } = case;
    let images = if body.symmetry().mirror { &[false, true][..] } else { &[false] };
    let pairs = (1..=LONGEST).flat_map(|returns| images.iter().map(move |&mirrored| (returns, mirrored)));
    let apart = |&(returns, mirrored): &(usize, bool)| {
        let last = &minima[minima.len() - 3 * LONGEST..];
        let pairs = last[returns..].iter().zip(last);
        pairs.map(|(a, b)| align(body, &a.shape, &b.shape, mirrored).distance.powi(2)).sum::<f64>()
            / (last.len() - returns) as f64
    };
    let (returns, mirrored) = pairs.min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
    let (last, before) = (minima[minima.len() - 1], minima[minima.len() - 1 - returns]);
    let (mut mean, mut count, mut time) = (vec![0.0; last.shape.len()], 0.0, 0.0);
    for (k, pair) in minima.windows(returns + 1).rev().step_by(returns).enumerate() {
        let alike = align(body, &last.shape, &pair[returns].shape, mirrored && k % 2 == 1);
        let mut shape = pair[returns].shape.clone();
        if mirrored && k % 2 == 1 {
            body.mirror(&mut shape);
        }
        body.rotate(alike.angle, &mut shape);
        add(&mut mean, 1.0, &shape);
        time += pair[returns].t - pair[0].t;
        count += 1.0;
    }
    mean.iter_mut().for_each(|x| *x /= count);
    let time = time / count;
    let angle = align(body, &last.shape, &before.shape, mirrored).angle;
    let guess = PeriodicGuess { shape: &mean, time, angle: wrap(angle), mirrored };
    let mut effort = settings.first_look.max(0.25 * (last.t - minima[0].t));
    let orbit = find_placed(body, &guess, &settings.flow(), &mut effort, watch)?;
    Some((orbit, Recurrence { returns, mirrored, time, angle }))
}

/// The minimum of the size on the orbit that is nearest to `near`.
fn minimum_of(case: Case<'_>, orbit: &PeriodicOrbit, near: &Extreme) -> Option<Vec<f64>> {
    let look = case.look(&orbit.shape, 1.1 * orbit.period()).ok()?;
    let away = |minimum: &&&Extreme| align(case.body, &near.shape, &minimum.shape, false).distance;
    let minima = look.minima();
    let nearest = minima.iter().min_by(|a, b| away(a).total_cmp(&away(b)))?;
    (norm(&nearest.shape) > 0.0).then(|| nearest.shape.clone())
}

/// The slope of a line through the means of parts of these points, with its 95 % error.
fn slope(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let part = points.len() / PARTS;
    if part < 3 {
        return None;
    }
    let mean = |part: &[(f64, f64)], of: fn(&(f64, f64)) -> f64| {
        part.iter().map(of).sum::<f64>() / part.len() as f64
    };
    let means: Vec<(f64, f64)> = points
        .chunks_exact(part)
        .take(PARTS)
        .map(|part| (mean(part, |p| p.0), mean(part, |p| p.1)))
        .collect();
    let (t, x) = (mean(&means, |p| p.0), mean(&means, |p| p.1));
    let width: f64 = means.iter().map(|p| (p.0 - t) * (p.0 - t)).sum();
    let slope = means.iter().map(|p| (p.0 - t) * (p.1 - x)).sum::<f64>() / width;
    let rest: f64 = means.iter().map(|p| (p.1 - x - slope * (p.0 - t)).powi(2)).sum();
    let error = student_quantile(PARTS - 2) * libm::sqrt(rest / (PARTS as f64 - 2.0) / width);
    (slope.is_finite() && error.is_finite()).then_some((slope, error))
}
