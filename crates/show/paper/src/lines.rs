//! The lines of Fig. 1 once more, without formulas: special points of branches, followed through the plane.

use super::claims::check;
use super::context::Context;
use super::plane::{Plane, walked};
use motiform_analysis::RelativeEquilibrium;
use motiform_continuation::{
    Branch, CurvePoint, Degenerate, Family2, Point, Settings, Special, WholeCurve, switch,
};
use motiform_figures::report::{Claim, ReportFigure};
use motiform_figures::{Chart, ErrorBarSeries, ExpectedLine, Measured};
use motiform_models::tensor::reduced::{Line, Reduced};
use motiform_study::Error;

/// The box of the figure, without a strip about kappa2 = 0, where lines of different kinds meet.
const GAMMA: (f64, f64) = (-0.16, 0.12);
const RIGHT: (f64, f64) = (0.002, 0.22);
const LEFT: (f64, f64) = (-0.22, -0.002);

/// The largest distance of continued points from the formulas, in units of gamma and kappa2.
const CLOSE: f64 = 1e-8;

/// Places of a line at which it is asked what begins there.
const PLACES: usize = 7;

/// A line as it is continued; the parameters of its points are (gamma, kappa2) or (kappa2, gamma).
#[derive(Clone)]
struct Track {
    line: Line,
    swapped: bool,
    points: Vec<CurvePoint>,
    /// `true` where the transition is continuous, at some places.
    continuous: Vec<Option<bool>>,
}

/// All of them.
#[derive(Clone)]
pub(crate) struct Continued(Vec<Track>);

/// The condition for points of curves of a kind.
type Kind = fn(&CurvePoint) -> bool;

/// A walk through the plane.
struct Walk<'c> {
    context: &'c Context<'c>,
    /// Over (gamma, kappa2), and over (kappa2, gamma).
    planes: [Plane; 2],
    found: Vec<Track>,
}

impl Continued {
    /// From a circle at rest, right and left of kappa2 = 0, everything is reached by following branches and switching between them.
    ///
    /// # Errors
    /// A refusal of the continuation; [`Error::Interrupted`].
    pub(crate) fn follow(context: &Context<'_>) -> Result<Self, Error> {
        let mut found = context.kept.once("lines of Fig. 1", || Self::followed(context))?;
        // A fault makes the points other ones along gamma.
        for point in found.0.iter_mut().flat_map(|track| &mut track.points) {
            point.parameters = point.parameters.map(|x| context.number(x));
        }
        Ok(found)
    }

    fn followed(context: &Context<'_>) -> Result<Self, Error> {
        let study = context.preset("fig1", |_| Ok(()))?;
        let planes = [Plane::new(&study, ["gamma", "kappa2"])?, Plane::new(&study, ["kappa2", "gamma"])?];
        let mut walk = Walk { context, planes, found: Vec::new() };
        walk.right()?;
        walk.left()?;
        Ok(Self(walk.found))
    }
}

impl Walk<'_> {
    /// Circle at rest, straight, circular motion with growing gamma; then circular motion with falling kappa2.
    fn right(&mut self) -> Result<(), Error> {
        let (second, settings) = (0.1, Settings::over(GAMMA.0, 0.08));
        let at_rest = self.circle(0, [GAMMA.0, second])?;
        let start = self.from(0, [GAMMA.0, second], &at_rest, &settings)?;
        let straight = self.next(0, second, &start.0, &settings)?;
        let circular = self.next(0, second, &straight.0, &settings)?;
        let circular = circular.1.motion.equilibrium().cloned().ok_or(Error::Interrupted)?;
        let down = Settings::over(LEFT.0, second).reversed();
        let oscillates = self.from(1, [second, 0.08], &circular, &down)?;
        self.add(0, Line::CircleToStraight, &start.0, second, RIGHT)?;
        self.add(0, Line::StraightToCircular, &straight.0, second, RIGHT)?;
        self.add(1, Line::CircularToQuasiPeriodic, &oscillates.0, 0.08, (1e-3, GAMMA.1))
    }

    /// Circle and ellipse at rest with falling kappa2; then ellipse and straight motion with growing gamma.
    fn left(&mut self) -> Result<(), Error> {
        let (low, second) = (-0.15, -0.02);
        let across = Settings::over(second, 0.1).reversed();
        let circle = self.circle(1, [0.1, low])?;
        let circle = self.from(1, [0.1, low], &circle, &across)?;
        let ellipse = self.next(1, low, &circle.0, &across)?;
        let ellipse = ellipse.1.motion.equilibrium().cloned().ok_or(Error::Interrupted)?;
        let settings = Settings::over(low, GAMMA.1);
        let ellipse = self.from(0, [low, second], &ellipse, &settings)?;
        let straight = self.next(0, second, &ellipse.0, &settings)?;
        self.add(1, Line::CircleToEllipse, &circle.0, low, (GAMMA.0, -0.002))?;
        self.add(0, Line::EllipseToStraight, &ellipse.0, second, LEFT)?;
        self.add(0, Line::StraightHopf, &straight.0, second, LEFT)
    }

    fn circle(&self, plane: usize, at: [f64; 2]) -> Result<RelativeEquilibrium, Error> {
        let body = self.planes[plane].at(at)?;
        RelativeEquilibrium::find(body.as_ref(), &vec![0.0; body.dim()]).ok_or(Error::Interrupted)
    }

    /// The first special point of a branch, and its last point.
    fn from(
        &self,
        plane: usize,
        at: [f64; 2],
        start: &RelativeEquilibrium,
        settings: &Settings,
    ) -> Result<(Option<Point>, Point), Error> {
        let row = self.planes[plane].row(at[1]);
        let watch = self.context.quiet();
        let (special, last) = walked(&mut Branch::of_equilibria(&row, at[0], start, settings, &watch)?)?;
        Ok((special.into_iter().next(), last))
    }

    /// The same of the branch that begins at a special point.
    fn next(
        &self,
        plane: usize,
        second: f64,
        point: &Option<Point>,
        settings: &Settings,
    ) -> Result<(Option<Point>, Point), Error> {
        let row = self.planes[plane].row(second);
        let (watch, point) = (self.context.quiet(), point.as_ref().ok_or(Error::Interrupted)?);
        let mut new = switch(&row, point, settings, &watch)?
            .pop()
            .and_then(|mut legs| legs.pop())
            .ok_or(Error::Interrupted)?;
        let (special, last) = walked(&mut new)?;
        Ok((special.into_iter().next(), last))
    }

    /// Follows a special point through the plane.
    fn add(
        &mut self,
        plane: usize,
        line: Line,
        point: &Option<Point>,
        second: f64,
        range: (f64, f64),
    ) -> Result<(), Error> {
        let (swapped, plane) = (plane == 1, &self.planes[plane]);
        let settings = match swapped {
            false => Settings::over(GAMMA.0, GAMMA.1),
            true => Settings::over(LEFT.0, RIGHT.1),
        };
        let (watch, point) = (self.context.quiet(), point.as_ref().ok_or(Error::Interrupted)?);
        let points = WholeCurve::through(plane, point, second, &settings, range, &watch)?.points;
        let step = (points.len() / PLACES).max(1);
        // where lines meet, what begins has changed again within a step
        let apart = |at: &&CurvePoint| libm::hypot(at.parameters[0], at.parameters[1]) > 0.03;
        let ordinary = points.iter().filter(|point| point.degenerate.is_none()).filter(apart);
        let ask = |at: &CurvePoint| match at.special {
            Special::Hopf(hopf) => hopf.is_supercritical().map(|is| is && at.unstable == 0),
            _ => plane.is_continuous(at, &settings, &watch),
        };
        let hopf = matches!(point.special, Some(Special::Hopf(_)));
        let continuous = ordinary.step_by(if hopf { 1 } else { step }).map(ask).collect();
        self.found.push(Track { line, swapped, points, continuous });
        Ok(())
    }
}

impl Track {
    fn places(&self) -> impl Iterator<Item = ([f64; 2], &CurvePoint)> {
        let place = |point: &CurvePoint| {
            let [a, b] = point.parameters;
            if self.swapped { [a, b] } else { [b, a] }
        };
        self.points.iter().map(move |point| (place(point), point))
    }

    /// The largest distance from the formula, along gamma (where the line is upright, along kappa2).
    fn off(&self) -> f64 {
        let off = |[kappa2, gamma]: [f64; 2]| match self.line {
            Line::CircleToEllipse => kappa2.abs(),
            line => Reduced::PAPER.on_line(line, kappa2).map_or(f64::INFINITY, |at| (at.1 - gamma).abs()),
        };
        self.places().map(|place| off(place.0)).fold(0.0, f64::max)
    }

    fn words(&self) -> String {
        let yes = self.continuous.iter().filter(|is| **is == Some(true)).count();
        format!("{}: {yes} of {}", self.line.title(), self.continuous.len())
    }
}

impl Continued {
    /// The claims that follow.
    pub(crate) fn claims(&self) -> [Claim; 2] {
        [self.agree(), self.kinds()]
    }

    fn agree(&self) -> Claim {
        let words = self.0.iter().map(|track| {
            format!("{}: {} points, {:.0e}", track.line.title(), track.points.len(), track.off())
        });
        check(
            "The lines of Fig. 1, continued numerically from special points of branches, are those of the formulas.",
            format!("largest distances: {}", words.collect::<Vec<_>>().join("; ")),
            "one circle at rest on each side of *κ*_2 = 0 is followed, and what begins on its branch, and \
            so on; each special point found is continued through the plane, without any formula; distance \
            along *γ* (circle to ellipse: along *κ*_2) below 10^{-8}. The edge of the rectangular motion is \
            no bifurcation of one motion and is not continued",
            self.0.len() == 6 && self.0.iter().all(|track| track.points.len() > 10 && track.off() < CLOSE),
        )
    }

    /// The claim on the transitions that are continuous.
    fn kinds(&self) -> Claim {
        let (hopf, others): (Vec<&Track>, Vec<&Track>) =
            self.0.iter().partition(|track| track.line == Line::StraightHopf);
        let all = |track: &&Track| track.continuous.iter().all(|is| *is == Some(true));
        let turns: Vec<[f64; 2]> = hopf
            .iter()
            .flat_map(|track| track.places())
            .filter(|place| place.1.degenerate == Some(Degenerate::Bautin))
            .map(|place| place.0)
            .collect();
        let expected = Reduced::PAPER.bautin().unwrap_or([f64::NAN; 2]);
        let near = |at: &[f64; 2]| (at[0] - expected[0]).abs().max((at[1] - expected[1]).abs()) < 1e-6;
        let one = turns.first().copied().unwrap_or([f64::NAN; 2]);
        let words: Vec<String> = self.0.iter().map(Track::words).collect();
        check(
            "All transitions of Fig. 1 that are bifurcations are continuous but one: straight motion ends \
            in a jump left of a Bautin point.",
            format!(
                "continuous at: {}. The kind of the last changes at *κ*_2 = {:.7}, *γ* = {:.7}; by the formulas at {:.7}, {:.7}",
                words.join("; "),
                one[0],
                one[1],
                expected[0],
                expected[1]
            ),
            "what begins is followed by switching branches at places along each line, and is stable as the \
            motion before it was; a Hopf bifurcation at every point by the sign of its first Lyapunov \
            coefficient; one Bautin point, where the formula has it to 10^{-6}",
            others.len() == 5 && others.iter().all(all) && turns.len() == 1 && turns.iter().all(near),
        )
    }

    /// The continued points on the analytic lines.
    ///
    /// # Errors
    /// Numbers that no axis can hold.
    pub(crate) fn figure(
        &self,
        context: &Context<'_>,
        lines: &[ExpectedLine],
    ) -> Result<ReportFigure, Error> {
        let kinds: [(&str, Kind); 4] = [
            ("pitchfork, continued", |p| matches!(p.special, Special::Pitchfork { .. })),
            ("Hopf, supercritical, continued", |p| kind(p) == Some(true)),
            ("Hopf, subcritical, continued", |p| kind(p) == Some(false)),
            ("Bautin point", |p| p.degenerate == Some(Degenerate::Bautin)),
        ];
        let series = |(label, of): (&str, Kind)| {
            let thin =
                |track: &Track| thinned(track.places().filter(|place| of(place.1)).map(|place| place.0));
            let points = self.0.iter().flat_map(thin).map(|[x, y]| Measured { x, y, error: 0.0 }).collect();
            ErrorBarSeries { label: label.to_owned(), points, joined: false }
        };
        let figure = Chart {
            title: "The lines of Fig. 1, continued".to_owned(),
            caption: vec![
                "Lines: formulas. Markers: special points of branches, followed through the plane."
                    .to_owned(),
            ],
            x_label: "*κ*_2".to_owned(),
            y_label: "*γ*".to_owned(),
            ..Chart::default()
        }
        .with(lines.iter().cloned())
        .with(kinds.into_iter().map(series).filter(|series| !series.points.is_empty()));
        let caption = "The lines of Fig. 1 by continuation, which knows none of the formulas, on top of the analytic ones.";
        Ok(ReportFigure::new(context.sheet(figure)?, caption))
    }
}

/// Points so far apart that the line below remains visible.
fn thinned(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for [x, y] in points {
        let far = |[a, b]: &[f64; 2]| libm::hypot(x - a, 1.5 * (y - b)) > 0.016;
        if kept.last().is_none_or(far) {
            kept.push([x, y]);
        }
    }
    kept
}

/// Returns `true` if an ordinary point of a Hopf curve is supercritical.
fn kind(point: &CurvePoint) -> Option<bool> {
    match (point.degenerate, point.special) {
        (None, Special::Hopf(hopf)) => hopf.is_supercritical(),
        _ => None,
    }
}
