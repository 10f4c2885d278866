//! Curves of special points over two parameters, as their users see them.

use super::branch::shoot_nodes;
use super::curve_tracer::{CurveTracer, Spot, last_two};
use super::degenerate::Degenerate;
use super::equilibria::Equilibria;
use super::family::{Bodies, Family2};
use super::hopf::first_lyapunov;
use super::point::{End, Motion, Point};
use super::problem::{Failure, Problem};
use super::settings::Settings;
use super::special::{Hopf, Special};
use motiform_analysis::equilibrium::{Units, size_beside};
use motiform_analysis::{Error, Result};
use motiform_dynamics::Watch;
use std::collections::VecDeque;

/// One point of a curve of special points.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// The two parameters.
    pub parameters: [f64; 2],
    /// Their derivatives by the length along the curve.
    pub direction: [f64; 2],
    /// Length along the curve from its start, in the units of [`Settings`].
    pub arclength: f64,
    /// The motion, with its eigenvalues or multipliers.
    pub motion: Motion,
    /// Number of growing directions of the reduced motion, the critical ones left out.
    pub unstable: usize,
    /// The critical condition; for a Hopf bifurcation with its frequency and its first Lyapunov coefficient here.
    pub special: Special,
    /// The further degeneracy, if the point was solved for as one of codimension two.
    pub degenerate: Option<Degenerate>,
    /// The residual of the condition that holds along the curve: the product of the two eigenvalues closest to 0 (of multipliers, less the
    /// critical one), or the mean growth of the critical pair.
    pub residual: f64,
    /// The slope of the condition across the curve, by the length in the units of [`Settings`]: where it is not 0 the condition passes 0
    /// there, and the point is `residual / transversality` away from where it does.
    pub transversality: f64,
}

/// A curve of special points over two parameters: an iterator over its points, those of codimension two in their place among the
/// others. Same start, same settings: same bits.
///
/// The motions over two parameters are a surface `F(x, p, q) = 0`; it is smooth at folds too, and, within the deviations that keep the
/// motion's symmetry, at pitchforks. On it the critical condition is one number: the product of the two eigenvalues closest to 0 (of
/// multipliers, to +1 or -1), or the mean growth of a pair. Steps go along the line where it vanishes (pseudo-arclength in all unknowns
/// and both parameters, so that the parameters may turn back); each point is found in a plane across the curve, by secants whose every
/// iterate is a motion.
///
/// Source: Kuznetsov (2004), Elements of Applied Bifurcation Theory, chapter 10; Govaerts (2000), Numerical Methods for Bifurcations of
/// Dynamical Equilibria.
///
/// # Checked by  tests/all/curves.rs: the lines of the reduced model, normal forms, points of the full model
pub struct Curve<'f> {
    tracer: Box<dyn Follow + 'f>,
    queue: VecDeque<CurvePoint>,
    end: Option<End>,
    count: usize,
}

impl<'f> Curve<'f> {
    /// The curve through `point`, a special point of a branch in the first parameter at the value `second` of the second one. The range
    /// of the settings is that of the first parameter, `range` that of the second. The curve starts towards larger values of the second
    /// parameter if [`Settings::first_step`] is positive. The first point is the start.
    ///
    /// # Errors
    /// Settings out of range; [`Error::OutsideRange`]; [`Error::NotOnABranch`] if the point is no special one of this family;
    /// [`Error::NoBody`].
    pub fn of(
        family: &'f dyn Family2,
        point: &Point,
        second: f64,
        settings: &Settings,
        range: (f64, f64),
        watch: &'f dyn Watch,
    ) -> Result<Self> {
        settings.check(point.parameter)?;
        Settings { range, ..*settings }.check(second)?;
        let parameters = [point.parameter, second];
        let expected = family.at(parameters)?.dim();
        let got = point.motion.shape().len();
        if got != expected {
            return Err(Error::Shape { what: "the shape of the start", expected, got });
        }
        let refused =
            |why: String| Error::NotOnABranch { what: "special point", parameter: parameters[0], why };
        let special = match point.special {
            Some(Special::Unresolved { .. }) | None => {
                return Err(refused("the point is not a located special point of a branch".to_owned()));
            }
            Some(special) => special,
        };
        let tracer = start(family, (&point.motion, special), parameters, (settings, range), watch);
        let tracer = tracer.map_err(|failure| match failure {
            Failure::Stopped => refused("stopped from outside".to_owned()),
            Failure::Obstructed(why) => refused(why.to_string()),
        })?;
        let mut curve = Self { tracer, queue: VecDeque::new(), end: None, count: 0 };
        let first = curve.tracer.here();
        curve.queue.push_back(first);
        Ok(curve)
    }

    /// Why the curve ended; `None` while it goes on.
    pub fn end(&self) -> Option<&End> {
        self.end.as_ref().filter(|_| self.queue.is_empty())
    }

    /// The kinds of points of codimension two that are looked for: those that do not come were not found.
    pub fn sought(&self) -> Vec<Degenerate> {
        self.tracer.sought()
    }
}

impl Iterator for Curve<'_> {
    type Item = CurvePoint;

    fn next(&mut self) -> Option<CurvePoint> {
        if let Some(point) = self.queue.pop_front() {
            self.count += usize::from(point.degenerate.is_none());
            return Some(point);
        }
        if self.end.is_some() {
            return None;
        }
        if self.count >= self.tracer.settings().most_points {
            self.end = Some(End::PointLimit);
            return None;
        }
        if self.tracer.is_spent() {
            self.end = Some(End::Spent);
            return None;
        }
        self.end = self.tracer.advance(&mut self.queue);
        self.next()
    }
}

fn start<'f>(
    family: &'f dyn Family2,
    (motion, special): (&Motion, Special),
    parameters: [f64; 2],
    (settings, range): (&Settings, (f64, f64)),
    watch: &'f dyn Watch,
) -> std::result::Result<Box<dyn Follow + 'f>, Failure> {
    let (bodies, ranges) = (Bodies::Two(family), [settings.range, range]);
    let widths = ranges.map(|(low, high)| high - low);
    Ok(match motion {
        Motion::Equilibrium(start) => {
            let problem = Equilibria::near(bodies, &parameters, &start.shape, &widths)?;
            let x = [&start.shape[..], &[start.turning_rate], &parameters].concat();
            Box::new(CurveTracer::start(problem, x, special, (settings, ranges), watch)?)
        }
        Motion::Orbit { orbit, nodes } => {
            let body = family.at(parameters)?;
            let (problem, x) =
                shoot_nodes(bodies, body.as_ref(), (orbit, nodes), (&parameters, &widths), settings);
            Box::new(CurveTracer::start(problem, x, special, (settings, ranges), watch)?)
        }
    })
}

/// A curve being followed, whatever its motions are.
trait Follow {
    fn settings(&self) -> &Settings;
    fn is_spent(&self) -> bool;
    fn sought(&self) -> Vec<Degenerate>;
    fn here(&self) -> CurvePoint;
    /// The points of one step.
    fn advance(&mut self, queue: &mut VecDeque<CurvePoint>) -> Option<End>;
}

impl<P: Problem> Follow for CurveTracer<'_, P> {
    fn settings(&self) -> &Settings {
        &self.settings
    }

    fn is_spent(&self) -> bool {
        self.problem.is_spent()
    }

    fn sought(&self) -> Vec<Degenerate> {
        Degenerate::sought(self.special, self.problem.time().is_some())
    }

    fn here(&self) -> CurvePoint {
        point(self, &self.spot, None)
    }

    fn advance(&mut self, queue: &mut VecDeque<CurvePoint>) -> Option<End> {
        let stretch = match self.step() {
            Ok(stretch) => stretch,
            Err(end) => return Some(end),
        };
        for event in &stretch.degenerate {
            let mut found = point(self, event.spot.as_ref().unwrap_or(&self.spot), Some(event.kind));
            found.parameters = event.at.unwrap_or(found.parameters);
            queue.push_back(found);
        }
        if !matches!(stretch.end, Some(End::Degenerate { .. })) {
            queue.push_back(point(self, &self.spot, None));
        }
        stretch.end
    }
}

fn point<P: Problem>(
    tracer: &CurveTracer<'_, P>,
    spot: &Spot<P::Local>,
    degenerate: Option<Degenerate>,
) -> CurvePoint {
    let special = match tracer.special {
        Special::Hopf(Hopf { part, .. }) => {
            let body = tracer.problem.body(&spot.local);
            let frequency = spot.reading.angle.max(0.0).sqrt();
            let solved = tracer.problem.solved(&spot.x);
            let shape = &spot.x[..body.dim()];
            let scale = (size_beside(body, shape), Units::of(body).length);
            let first_lyapunov = first_lyapunov(body, shape, frequency, solved, scale);
            Special::Hopf(Hopf { frequency, part, first_lyapunov })
        }
        Special::Torus { .. } => Special::Torus { angle: libm::acos(spot.reading.angle.clamp(-1.0, 1.0)) },
        other => other,
    };
    let [real, pairs] = tracer.critical.others(&spot.levels, &spot.reading);
    CurvePoint {
        parameters: spot.parameters(),
        direction: last_two(&spot.frame.along),
        arclength: spot.arclength,
        motion: tracer.problem.motion(&spot.x, &spot.local, &spot.levels),
        unstable: real.0 + pairs.0,
        special,
        degenerate,
        residual: spot.reading.value,
        transversality: spot.steep,
    }
}
