//! The branches that begin or cross at a special point.

use super::beginning::{Begin, follow, nothing};
use super::branch::Branch;
use super::classes::Classes;
use super::correct::{crossing, product, scaled};
use super::equilibria::Equilibria;
use super::family::{Bodies, Family};
use super::leaving::leaving;
use super::meeting::all;
use super::onset::onset;
use super::orbits::Orbits;
use super::point::{Motion, Point};
use super::problem::{Equations, Problem};
use super::settings::Settings;
use super::special::Special;
use super::tangents::{own_slope, tangents};
use super::tracer::Tracer;
use motiform_analysis::linear::add;
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_dynamics::sample::sort_by_number;
use motiform_dynamics::{Equivariant, Watch};

/// The branches that begin or cross at a special point, each with its legs: one where it begins, two where it crosses; none at a fold, a
/// continuum or a torus, nor where the special point is unresolved.
///
/// Where the two sides of a new branch are images of each other under the symmetry (a pitchfork, a symmetry breaking) or under time (a
/// period doubling, a Hopf bifurcation), there is one: its copies are not followed. A shape with three or more axes may lose its rotations
/// in two ways that are no images of each other: two branches. The first step does not know the direction of
/// the parameter, so the sign of [`Settings::first_step`] means nothing here.
///
/// # Errors
/// [`Error::NotOnABranch`](motiform_analysis::Error::NotOnABranch) if there is no new branch within reach of the point; settings out of
/// range.
pub fn switch<'f>(
    family: &'f dyn Family,
    point: &Point,
    settings: &Settings,
    watch: &'f dyn Watch,
) -> Result<Vec<Vec<Branch<'f>>>> {
    settings.check(point.parameter)?;
    let Some(special) = point.special else { return Ok(Vec::new()) };
    let from = Departure { family, point, settings, watch };
    let sides: &[f64] = if special == Special::BranchPoint { &[1.0, -1.0] } else { &[1.0] };
    match (&point.motion, special) {
        (
            _,
            Special::Fold
            | Special::Continuum
            | Special::Torus { .. }
            | Special::Unresolved { .. }
            | Special::Touch { seen: "hopf", .. },
        )
        | (Motion::Orbit { .. }, Special::Touch { .. }) => Ok(Vec::new()),
        (Motion::Equilibrium(start), Special::Hopf(hopf)) => onset(from, start, hopf.frequency),
        (Motion::Equilibrium(start), _) if point.critical > 1 || matches!(special, Special::Touch { .. }) => {
            all(from, start)
        }
        (Motion::Equilibrium(start), Special::Pitchfork { .. }) => from.fork(start),
        (Motion::Equilibrium(start), _) => {
            let usual = || {
                let (problem, x) = from.crossed(start)?;
                let direction = direction(&problem, &x, point).ok_or_else(|| nothing(point.parameter))?;
                let leg = |&side| {
                    let direction = turned(&direction, side);
                    from.cross(start, &Begin::at(point, &x, &direction))
                };
                sides.iter().map(leg).collect::<Result<_>>().map(|legs| vec![legs])
            };
            // where terms of higher order decide Newton's method finds nothing along a tangent
            usual().or_else(|_| all(from, start))
        }
        (Motion::Orbit { orbit, nodes }, _) => {
            let doubled = matches!(special, Special::PeriodDoubling | Special::SymmetryBreaking);
            let new = |&side| from.leave((orbit, nodes), doubled, side);
            sides.iter().map(new).collect::<Result<_>>().map(|legs| vec![legs])
        }
    }
}

/// Slopes that differ by less than this may be of one branch.
const TURNS: f64 = 1e-6;

/// The directions that the equations do not see to first order: the direction along the parameter, and those that leave the parameter as it
/// is; `most` of them, the least seen ones.
fn unseen<P: Problem>(problem: &P, x: &[f64], most: usize) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
    let local = problem.local(x, &()).ok()?;
    let weights = problem.weights(x);
    let mut null = crossing(problem, &local, &weights);
    null.truncate(most);
    let last = |v: &Vec<f64>| v.last().copied().unwrap_or(0.0);
    let along = null.iter().max_by(|a, b| last(a).abs().total_cmp(&last(b).abs()))?;
    let across = |v: &Vec<f64>| {
        let mut out = v.clone();
        add(&mut out, -last(v) / last(along), along);
        out
    };
    let mut others: Vec<Vec<f64>> = null.iter().filter(|v| !std::ptr::eq(*v, along)).map(across).collect();
    let length = |v: &Vec<f64>| product(&weights, v, v);
    sort_by_number(&mut others, |a| -length(a));
    let others: Option<Vec<Vec<f64>>> = others.into_iter().map(|v| scaled(v, &weights)).collect();
    Some((along.clone(), others?))
}

/// A direction of the new branch: the tangent of the branches that cross at a branch point which is not that of the point's own branch,
/// known by its slope; elsewhere what the equations do not see to first order, and leaves the parameter as it is.
fn direction<P: Problem>(problem: &P, x: &[f64], point: &Point) -> Option<Vec<f64>> {
    let single = point.special == Some(Special::BranchPoint);
    if single {
        let own = own_slope(problem, x, point);
        let slope = |v: &Vec<f64>| (v.last().copied().unwrap_or(0.0).abs() - own).abs();
        let width = problem.weights(x).last().map_or(1.0, |weight| 1.0 / weight.sqrt());
        let other = tangents(problem, x).into_iter().max_by(|a, b| slope(a).total_cmp(&slope(b)));
        if let Some(other) = other.filter(|other| slope(other) > TURNS * width) {
            return Some(other);
        }
    }
    unseen(problem, x, if single { 2 } else { usize::MAX })?.1.into_iter().next()
}

fn turned(direction: &[f64], side: f64) -> Vec<f64> {
    direction.iter().map(|d| side * d).collect()
}

/// A special point that branches leave, and how they are followed.
#[derive(Clone, Copy)]
pub(super) struct Departure<'d, 'f> {
    pub(super) family: &'f dyn Family,
    pub(super) point: &'d Point,
    pub(super) settings: &'d Settings,
    pub(super) watch: &'f dyn Watch,
}

impl<'f> Departure<'_, 'f> {
    /// The equations of all relative equilibria near one, and its unknowns.
    pub(super) fn crossed(&self, start: &RelativeEquilibrium) -> Result<(Equilibria<'f>, Vec<f64>)> {
        let (bodies, parameter) = (Bodies::One(self.family), self.point.parameter);
        let mut problem = Equilibria::near(bodies, &[parameter], &start.shape, &[self.settings.width()])?;
        problem.classes = Classes::of(self.family.at(parameter)?.as_ref(), &[]);
        let x = [&start.shape[..], &[start.turning_rate, parameter]].concat();
        Ok((problem, x))
    }

    /// The branches that leave a pitchfork, one of each kind; those that Newton's method finds, if it finds any.
    fn fork(&self, start: &RelativeEquilibrium) -> Result<Vec<Vec<Branch<'f>>>> {
        let (problem, x) = self.crossed(start)?;
        let body = self.family.at(self.point.parameter)?;
        let none = || nothing(self.point.parameter);
        let (_, critical) = unseen(&problem, &x, usize::MAX).ok_or_else(none)?;
        let directions = leaving(body.as_ref(), &start.shape, &critical, &problem.weights(&x));
        let branch = |direction: &Vec<f64>| self.cross(start, &Begin::at(self.point, &x, direction));
        those_found(directions.iter().map(branch))
    }

    /// Another branch of relative equilibria, which begins so.
    pub(super) fn cross(&self, start: &RelativeEquilibrium, begin: &Begin<'_>) -> Result<Branch<'f>> {
        let (problem, _) = self.crossed(start)?;
        let body = self.family.at(self.point.parameter)?;
        let mut tracer = follow(problem, begin, self.settings, self.watch)?;
        let dim = start.shape.len();
        let shape = tracer.unknowns()[..dim].to_vec();
        tracer.problem_mut().classes = Classes::of(body.as_ref(), &[&shape]);
        tracer.renew();
        Ok(Branch::followed(tracer))
    }

    /// Another branch of orbits, of twice the length if `doubled`.
    fn leave(
        &self,
        (orbit, nodes): (&PeriodicOrbit, &[Vec<f64>]),
        doubled: bool,
        side: f64,
    ) -> Result<Branch<'f>> {
        let body = self.family.at(self.point.parameter)?;
        let mut all = nodes.to_vec();
        let (mut time, mut angle) = (orbit.time, orbit.angle);
        if doubled {
            let image = |node: &Vec<f64>| {
                let mut image = node.clone();
                if orbit.mirrored {
                    body.mirror(&mut image);
                }
                body.rotate(orbit.angle, &mut image);
                image
            };
            all.extend(nodes.iter().map(image));
            time *= 2.0;
            angle = if orbit.mirrored { 0.0 } else { 2.0 * angle };
        }
        let mirrored = orbit.mirrored && !doubled;
        let (problem, x) = self.orbits(body.as_ref(), &all, (time, angle, mirrored));
        let direction = direction(&problem, &x, self.point).ok_or_else(|| nothing(self.point.parameter))?;
        self.oscillate(problem, &Begin::at(self.point, &x, &turned(&direction, side)))
    }

    /// Another branch of orbits, which begins so.
    pub(super) fn oscillate(&self, problem: Orbits<'f>, begin: &Begin<'_>) -> Result<Branch<'f>> {
        let tracer = follow(problem, begin, self.settings, self.watch)?;
        Ok(Branch::followed(symmetric(tracer)))
    }

    /// The equations of all orbits near one with these nodes, and its unknowns.
    pub(super) fn orbits(
        &self,
        body: &dyn Equivariant,
        nodes: &[Vec<f64>],
        along: (f64, f64, bool),
    ) -> (Orbits<'f>, Vec<f64>) {
        let (parameters, widths) = ([self.point.parameter], [self.settings.width()]);
        let classes = Classes::of(body, &[]);
        Orbits::near(
            Bodies::One(self.family),
            (body, classes),
            (nodes, along),
            (&parameters, &widths),
            self.settings,
        )
    }
}

/// Those of several new branches that Newton's method finds; the first error where it finds none.
pub(super) fn those_found<'f>(
    branches: impl Iterator<Item = Result<Branch<'f>>>,
) -> Result<Vec<Vec<Branch<'f>>>> {
    let (found, failed): (Vec<_>, Vec<_>) = branches.partition(Result::is_ok);
    match failed.into_iter().next() {
        Some(Err(error)) if found.is_empty() => Err(error),
        _ => Ok(found.into_iter().flatten().map(|branch| vec![branch]).collect()),
    }
}

/// With the symmetry that all shapes of the first orbit have.
fn symmetric<'f>(mut tracer: Tracer<'f, Orbits<'f>>) -> Tracer<'f, Orbits<'f>> {
    let x = tracer.unknowns().to_vec();
    let problem = tracer.problem_mut();
    if let Ok(body) = problem.bodies.at(&x) {
        let nodes: Vec<&[f64]> = (0..problem.parts).map(|i| problem.node(&x, i)).collect();
        problem.classes = Classes::of(body.as_ref(), &nodes);
        tracer.renew();
    }
    tracer
}
