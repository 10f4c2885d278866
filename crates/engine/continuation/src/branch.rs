//! A branch as its users see it: an iterator over points.

use super::classes::Classes;
use super::equilibria::Equilibria;
use super::family::{Bodies, Family};
use super::orbits::Orbits;
use super::point::{End, Point};
use super::problem::{Failure, Problem};
use super::settings::Settings;
use super::shooting::shape_after;
use super::tracer::{Follow, Tracer};
use motiform_analysis::{Error, PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_dynamics::{Equivariant, Watch};

/// A branch of motions: an iterator over its points, special ones among them. Same start, same settings: same bits.
///
/// ```
/// use motiform_analysis::RelativeEquilibrium;
/// use motiform_continuation::{Branch, Settings, Special};
/// use motiform_dynamics::Equivariant;
/// use motiform_models::zoo::Hopf;
///
/// // z' = (mu + 2i) z - |z|^2 z: the rest loses its stability at mu = 0, and a stable oscillation begins.
/// let family = |mu: f64| Ok(Box::new(Hopf { mu, omega: 2.0 }) as Box<dyn Equivariant>);
/// let rest = RelativeEquilibrium::find(&Hopf { mu: -0.5, omega: 2.0 }, &[0.1, 0.0]).expect("it is stable");
/// let mut branch = Branch::of_equilibria(&family, -0.5, &rest, &Settings::over(-0.5, 0.5), &())?;
/// let special = branch.by_ref().find_map(|point| Some((point.parameter, point.special?))).expect("a Hopf bifurcation");
/// assert!(special.0.abs() < 1e-8);
/// let Special::Hopf(hopf) = special.1 else { unreachable!() };
/// assert!((hopf.frequency - 2.0).abs() < 1e-9 && hopf.is_supercritical() == Some(true));
/// # Ok::<(), motiform_analysis::Error>(())
/// ```
pub struct Branch<'f> {
    tracer: Box<dyn Follow + 'f>,
}

impl<'f> Branch<'f> {
    /// The branch of relative equilibria through `start`, a solution for the parameter `parameter`. The first point is the start.
    ///
    /// # Errors
    /// Settings out of range; [`Error::OutsideRange`]; [`Error::NotOnABranch`] if the start is no such motion of this family;
    /// [`Error::NoBody`].
    pub fn of_equilibria(
        family: &'f dyn Family,
        parameter: f64,
        start: &RelativeEquilibrium,
        settings: &Settings,
        watch: &'f dyn Watch,
    ) -> Result<Self> {
        settings.check(parameter)?;
        check_dim(family, parameter, &start.shape)?;
        let problem = Equilibria::near(Bodies::One(family), &[parameter], &start.shape, &[settings.width()])?;
        let x = [&start.shape[..], &[start.turning_rate, parameter]].concat();
        let tracer = Tracer::start(problem, x, settings, watch)
            .map_err(|f| refused("relative equilibrium", parameter, f))?;
        Ok(Self::followed(tracer))
    }

    /// The branch of relative periodic orbits through `start`, a solution for the parameter `parameter`. The first point is the
    /// start. An orbit that comes back mirrored ([`PeriodicOrbit::mirrored`]) is followed over half its period.
    ///
    /// # Errors
    /// As [`Branch::of_equilibria`].
    pub fn of_orbits(
        family: &'f dyn Family,
        parameter: f64,
        start: &PeriodicOrbit,
        settings: &Settings,
        watch: &'f dyn Watch,
    ) -> Result<Self> {
        settings.check(parameter)?;
        check_dim(family, parameter, &start.shape)?;
        let refused = |failure| refused("relative periodic orbit", parameter, failure);
        let (problem, x) = shoot(family, parameter, start, settings, watch).map_err(refused)?;
        let tracer = Tracer::start(problem, x, settings, watch).map_err(refused)?;
        Ok(Self::followed(tracer))
    }

    pub(super) fn followed(tracer: Tracer<'f, impl Problem + 'f>) -> Self {
        Self { tracer: Box::new(tracer) }
    }

    /// Why the branch ended; `None` while it goes on.
    pub fn end(&self) -> Option<&End> {
        self.tracer.end()
    }
}

impl Iterator for Branch<'_> {
    type Item = Point;

    fn next(&mut self) -> Option<Point> {
        self.tracer.next()
    }
}

fn check_dim(family: &dyn Family, parameter: f64, shape: &[f64]) -> Result<()> {
    let expected = family.at(parameter)?.dim();
    let got = shape.len();
    if got == expected { Ok(()) } else { Err(Error::Shape { what: "the shape of the start", expected, got }) }
}

fn refused(what: &'static str, parameter: f64, failure: Failure) -> Error {
    let why = match failure {
        Failure::Stopped => "stopped from outside".to_owned(),
        Failure::Obstructed(obstruction) => obstruction.to_string(),
    };
    Error::NotOnABranch { what, parameter, why }
}

/// Nodes along an orbit. A mirrored one is turned so that its image is `M u`, without rotation.
fn shoot<'f>(
    family: &'f dyn Family,
    parameter: f64,
    start: &PeriodicOrbit,
    settings: &Settings,
    watch: &dyn Watch,
) -> std::result::Result<(Orbits<'f>, Vec<f64>), Failure> {
    let body = family.at(parameter)?;
    let mut node = start.shape.clone();
    if start.mirrored {
        body.rotate(-0.5 * start.angle, &mut node);
    }
    let (bodies, widths) = (Bodies::One(family), [settings.width()]);
    let length = bodies.vicinity(body.as_ref(), (&[parameter], &widths), &[&node]).units.length;
    let span = start.time / settings.parts as f64;
    let mut nodes = vec![node];
    for _ in 1..settings.parts {
        let last = nodes.last().map_or(&[][..], Vec::as_slice);
        let next = shape_after(body.as_ref(), last, span, (&settings.flow, length), watch)?;
        nodes.push(next);
    }
    let mut start = start.clone();
    start.angle = if start.mirrored { 0.0 } else { start.angle };
    Ok(shoot_nodes(bodies, body.as_ref(), (&start, &nodes), (&[parameter], &widths), settings))
}

/// The equations of an orbit with these nodes, and the unknowns.
pub(super) fn shoot_nodes<'f>(
    bodies: Bodies<'f>,
    body: &dyn Equivariant,
    (orbit, nodes): (&PeriodicOrbit, &[Vec<f64>]),
    (parameters, widths): (&[f64], &[f64]),
    settings: &Settings,
) -> (Orbits<'f>, Vec<f64>) {
    let shapes: Vec<&[f64]> = nodes.iter().map(Vec::as_slice).collect();
    let classes = Classes::of(body, &shapes);
    let along = (orbit.time, orbit.angle, orbit.mirrored);
    Orbits::near(bodies, (body, classes), (nodes, along), (parameters, widths), settings)
}
