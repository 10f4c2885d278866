//! The first point of a new branch: near enough to the special point that nothing lies between.

use super::correct::{correct, normal, scaled};
use super::levels::Level;
use super::point::{Motion, Point};
use super::problem::Problem;
use super::settings::Settings;
use super::special::{Broken, Special};
use super::tracer::{TOLERANCE, Tracer};
use motiform_analysis::{Error, Result};
use motiform_dynamics::Watch;
use motiform_dynamics::sample::sort_by_number;

/// Distances from the special point at which the new branch is looked for, in the units of [`Settings`].
const DISTANCES: [f64; 8] = [0.005, 0.02, 0.05, 0.1, 0.001, 0.0002, 0.00004, 0.000_008];

/// Changes of the parameter, in parts of the range, from which Newton's method begins.
const LEANS: [f64; 5] = [0.0, 0.01, -0.01, 0.05, -0.05];

/// Factor by which the branch is examined nearer to its beginning, and the ratios of the two changes of the parameter where it begins: this
/// one to the power 1 or 2, within a factor 2.
const NEARER: f64 = 8.0;
const RATIOS: std::ops::RangeInclusive<f64> = 0.5 * NEARER..=2.0 * NEARER * NEARER;

/// At the nearest distance a change of the parameter by its square is this many times what round-off of the equations makes of it.
const CLEAR: f64 = 10.0;

/// Least change of the parameter that tells anything, in tolerances of Newton's method.
const SEEN: f64 = 100.0;

/// Ratios of growths that are about the same.
const ABOUT: std::ops::RangeInclusive<f64> = 0.5..=1.5;

/// A special point: its unknowns, a direction that a new branch leaves in, and in how many directions deviations grow on that branch at
/// first.
pub(super) struct Begin<'b> {
    origin: &'b [f64],
    direction: &'b [f64],
    growing: std::ops::RangeInclusive<usize>,
    /// The growths at the special point, largest first; none where they are not compared.
    there: Vec<f64>,
}

impl<'b> Begin<'b> {
    /// Deviations grow in the directions in which they do at the point, and at most in those of the critical levels too.
    pub(super) fn at(point: &Point, origin: &'b [f64], direction: &'b [f64]) -> Self {
        let twice = matches!(point.special, Some(Special::Pitchfork { breaks: Broken::Rotations }));
        let critical = point.critical.max(if twice { 2 } else { 1 });
        let there = match &point.motion {
            Motion::Equilibrium(at) => at.eigenvalues.iter().map(|value| value.0).collect(),
            Motion::Orbit { .. } => Vec::new(),
        };
        let growing = point.unstable..=point.unstable + critical;
        Self { there, ..Self::new(origin, direction, growing) }
    }

    /// Returns `true` if deviations grow in as many directions as the special point lets expect, and the growths next to the critical ones
    /// are about what they are there: otherwise one of them may have passed 0 in the place of a critical one.
    fn expects(&self, levels: &[Vec<Level>], noise: f64) -> bool {
        let mut here: Vec<f64> = levels.iter().flatten().map(|level| level.growth).collect();
        sort_by_number(&mut here, |growth| -growth);
        let count = here.iter().filter(|growth| **growth > 0.0).count();
        let (above, below) = (*self.growing.start(), *self.growing.end());
        let about = |there: Option<&f64>, here: Option<&f64>| match (there, here) {
            (Some(there), Some(here)) if f64::abs(*there) > noise => ABOUT.contains(&(here / there)),
            _ => true,
        };
        // a direction may have become neutral: those that decay are counted from the other end
        let from_end = self.there.len().checked_sub(below + 1);
        let last = |all: &'_ [f64]| from_end.and_then(|k| all.iter().rev().nth(k).copied());
        let first = |all: &'_ [f64]| above.checked_sub(1).and_then(|k| all.get(k).copied());
        self.growing.contains(&count)
            && (self.there.is_empty()
                || about(first(&self.there).as_ref(), first(&here).as_ref())
                    && about(last(&self.there).as_ref(), last(&here).as_ref()))
    }

    /// Deviations grow in so many directions.
    pub(super) const fn new(
        origin: &'b [f64],
        direction: &'b [f64],
        growing: std::ops::RangeInclusive<usize>,
    ) -> Self {
        Self { origin, direction, growing, there: Vec::new() }
    }
}

/// There is no new branch at this value of the parameter.
pub(super) fn nothing(parameter: f64) -> Error {
    let why = "Newton's method finds none beside the special point".to_owned();
    Error::NotOnABranch { what: "new branch", parameter, why }
}

/// Follows the new branch from a point at which as many deviations grow as the special point lets expect, and up to which the parameter
/// changes as a branch begins: otherwise there may be another special point on the way, and a nearer one is looked for.
pub(super) fn follow<'f, P: Problem>(
    mut problem: P,
    begin: &Begin<'_>,
    settings: &Settings,
    watch: &'f dyn Watch,
) -> Result<Tracer<'f, P>> {
    let origin = begin.origin;
    let direction = scaled(begin.direction.to_vec(), &problem.weights(origin))
        .ok_or_else(|| nothing(origin.last().copied().unwrap_or(f64::NAN)))?;
    let direction = direction.as_slice();
    let (low, high) = settings.range;
    let nearest = libm::cbrt(CLEAR * problem.resolution()).min(DISTANCES[3]);
    let mut farthest = (0.0, f64::INFINITY);
    let mut doubtful = None;
    // where terms of high order decide the parameter is far from that of the point
    for (lean, distance) in LEANS.into_iter().flat_map(|lean| DISTANCES.map(|distance| (lean, distance))) {
        if farthest.0 != lean {
            farthest = (lean, f64::INFINITY);
        }
        if distance > farthest.1 || distance < nearest || lean != 0.0 && doubtful.is_some() {
            continue;
        }
        match Tracer::beside(problem, (origin, direction, distance), lean, settings, watch) {
            Ok(tracer)
                if (low..=high).contains(&tracer.parameter())
                    && begin.expects(&tracer.place.levels, tracer.problem().noise(&tracer.place.levels))
                    && is_beginning(&tracer, (origin, direction, distance), settings, watch) =>
            {
                return Ok(tracer);
            }
            Ok(tracer) => {
                farthest = (lean, distance);
                // one outside of the range is none of this branch
                doubtful =
                    (low..=high).contains(&tracer.parameter()).then_some((lean, distance)).or(doubtful);
                problem = tracer.into_problem();
            }
            Err((back, _)) => problem = back,
        }
    }
    let nothing = || nothing(origin.last().copied().unwrap_or(f64::NAN));
    let (lean, distance) = doubtful.ok_or_else(nothing)?;
    Tracer::beside(problem, (origin, direction, distance), lean, settings, watch).map_err(|_| nothing())
}

/// Returns `true` if nothing happens between the special point and the first point of a new branch: the parameter changes with the distance
/// from the special point, or with its square, and as many deviations grow nearer to it.
fn is_beginning<P: Problem>(
    tracer: &Tracer<'_, P>,
    (origin, direction, distance): (&[f64], &[f64], f64),
    settings: &Settings,
    watch: &dyn Watch,
) -> bool {
    let problem = tracer.problem();
    let row = normal(direction, &problem.weights(origin));
    let guess = origin.iter().zip(direction).map(|(x, d)| x + distance / NEARER * d).collect();
    let tolerance = settings.tolerance.min(TOLERANCE);
    let Ok(near) = correct(problem, guess, &row, tolerance, watch) else { return false };
    let changed = |x: &[f64]| x.last().copied().unwrap_or(f64::NAN) - origin.last().copied().unwrap_or(0.0);
    let (closer, far) = (changed(&near.x), changed(tracer.unknowns()));
    // close to the special point the equations see a change of the parameter the less the nearer it is
    let resolved = problem.resolution() / (distance / NEARER).min(1.0);
    let seen = SEEN * tolerance.max(resolved) * settings.width();
    let begins =
        if closer.abs() > seen { RATIOS.contains(&(far / closer)) } else { far.abs() <= RATIOS.end() * seen };
    begins
        && problem
            .levels(&near.x, &near.local)
            .is_some_and(|levels| growing(&levels, problem.noise(&levels)).contains(&tracer.growing()))
}

/// Number of growing levels: at least, and with those that are 0 within the error `noise`.
fn growing(levels: &[Vec<Level>], noise: f64) -> std::ops::RangeInclusive<usize> {
    let above = |least: f64| levels.iter().flatten().filter(|level| level.growth > least).count();
    above(noise)..=above(-noise)
}
