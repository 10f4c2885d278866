//! Curves over the plane (kappa2, kappa3) along which motions change.

use super::branches::{at, follow};
use super::claims::check;
use super::context::Context;
use super::plane::Plane;
use motiform_analysis::{PeriodicOrbit, Regime};
use motiform_continuation::{CurvePoint, Degenerate, Motion, Point, Settings, Special, WholeCurve};
use motiform_diagrams::{Branches, Followed};
use motiform_dynamics::sample::ascending;
use motiform_figures::report::Claim;
use motiform_figures::{ExpectedLine, LineStyle};
use motiform_study::Error;
use std::sync::Arc;

/// The box in which curves are followed.
const KAPPA2: (f64, f64) = (0.02, 1.75);
const KAPPA3: (f64, f64) = (0.02, 1.1);

/// The row of the branches, and one where straight motion is stable.
const SLOW: f64 = 0.1;
const FAST: f64 = 0.6;

/// Longest step along a curve, and longest time of an orbit.
const STEP: f64 = 0.05;
const LONGEST: f64 = 300.0;

/// Places at which it is asked what begins on a curve.
const PLACES: usize = 8;

/// A cell of the plane with the motions found there.
pub(crate) struct Place {
    /// Across.
    pub kappa2: f64,
    /// Upwards.
    pub kappa3: f64,
    /// Motions found there.
    pub regimes: Vec<Regime>,
}

impl Place {
    /// Returns `true` if a motion was found there.
    pub(crate) fn has(&self, regime: Regime) -> bool {
        self.regimes.contains(&regime)
    }
}

/// The kinds of curves: name, label and style.
const KINDS: [(&str, &str, LineStyle); 4] = [
    ("pitchfork", "straight | circular", LineStyle::LongDashed),
    ("hopf", "circular motion: Hopf", LineStyle::Dotted),
    ("symmetry-breaking", "zigzag: symmetry breaking", LineStyle::Solid),
    ("period-doubling", "rotating zigzag: period doubling", LineStyle::Dashed),
];

/// The curves.
pub(crate) struct Curves {
    plane: Plane,
    settings: Settings,
    all: Arc<Vec<WholeCurve>>,
}

impl Curves {
    /// The curve of every special point of the branches, and that of straight motion at a faster triangle; each once.
    ///
    /// # Errors
    /// A refusal of the continuation; [`Error::Interrupted`].
    pub(crate) fn follow(context: &Context<'_>, found: &Branches) -> Result<Self, Error> {
        let plane = Plane::new(&at(context, 0.9, SLOW)?, ["kappa2", "kappa3"])?;
        let over = Settings::over(KAPPA2.0, KAPPA2.1);
        let settings = Settings { largest_step: STEP, longest_time: LONGEST, ..over };
        let all = context
            .kept
            .once("curves of Fig. 4", || Ok(Arc::new(all(context, &plane, &settings, found)?)))?;
        Ok(Self { plane, settings, all })
    }

    fn of<'s>(&'s self, kind: &'s str) -> impl Iterator<Item = &'s WholeCurve> {
        self.all.iter().filter(move |curve| curve.points.first().is_some_and(|at| at.special.name() == kind))
    }

    /// The curves as lines; those of one kind that come later have no entry of their own in the legend.
    pub(crate) fn lines(&self) -> Vec<ExpectedLine> {
        let line = |curve: &WholeCurve| {
            let name = curve.points.first()?.special.name();
            let (_, label, style) = KINDS.into_iter().find(|kind| kind.0 == name)?;
            let points = curve.points.iter().map(|point| point.parameters).collect();
            Some(ExpectedLine { label: label.to_owned(), style, points })
        };
        self.all.iter().filter_map(line).collect()
    }

    /// The claims that follow from the curves and the motions found on two lattices: over the plane, and
    /// about the zigzags.
    pub(crate) fn claims(&self, context: &Context<'_>, places: &[Place], arch: &[Place]) -> [Claim; 3] {
        [self.straight(context, places), self.circular(context), self.arch(arch)]
    }

    /// Straight and circular motion on the two sides of the drift pitchfork.
    fn straight(&self, context: &Context<'_>, places: &[Place]) -> Claim {
        let points = || self.of("pitchfork").flat_map(|curve| &curve.points);
        let step = (points().count() / PLACES).max(1);
        // The first point is at the edge of the plane, where what begins may lie outside.
        let asked = context.kept.once("what begins on the curve of straight motion", || {
            let ask = |at: &CurvePoint| self.plane.is_continuous(at, &self.settings, &context.quiet());
            Ok(points().skip(step / 2).step_by(step).map(ask).collect::<Vec<_>>())
        });
        let asked: Vec<Option<bool>> = asked.unwrap_or_default();
        let continuous = asked.iter().filter(|is| **is == Some(true)).count();
        let line: Vec<[f64; 2]> = points().map(|point| point.parameters).collect();
        // beyond the box straight motion is unstable throughout
        let edge = |place: &Place| at_height(&line, place.kappa3).first().copied().unwrap_or(f64::INFINITY);
        let right = |place: &&Place| place.kappa2 > edge(place);
        let straight = places.iter().filter(|place| place.has(Regime::Straight));
        let (there, elsewhere): (Vec<&Place>, Vec<&Place>) = straight.partition(right);
        let beyond = places.iter().filter(right).count();
        check(
            "Over the plane of Fig. 4 straight motion turns into circular motion continuously, along one curve.",
            format!(
                "continuous at {continuous} of {} places along it, from (κ_2, κ_3) = {} to {}; straight \
                motion is found in {} of {beyond} cells beyond the curve, and in {} of those before it",
                asked.len(),
                words(line.first()),
                words(line.last()),
                there.len(),
                elsewhere.len()
            ),
            "the pitchfork of straight motion at κ_3 = 0.6 is continued through the plane; what begins is \
            found by switching branches, and is stable; cells from random starts, at least 98 % of those \
            beyond",
            asked.len() >= PLACES
                && continuous == asked.len()
                && elsewhere.is_empty()
                && beyond > 0
                && there.len() as f64 >= 0.98 * beyond as f64,
        )
    }

    /// The kind of the Hopf bifurcation of circular motion.
    fn circular(&self, context: &Context<'_>) -> Claim {
        let points = || self.of("hopf").flat_map(|curve| &curve.points);
        let subcritical = |at: &&CurvePoint| matches!(at.special, Special::Hopf(hopf) if hopf.is_supercritical() == Some(false));
        let inside =
            |at: &&CurvePoint| at.degenerate.is_none() && at.parameters[0] <= 1.6 && at.unstable == 0;
        let (all, jumps) =
            (points().filter(inside).count(), points().filter(inside).filter(subcritical).count());
        let bautin: Vec<String> = points()
            .filter(|at| at.degenerate == Some(Degenerate::Bautin))
            .map(|at| words(Some(&at.parameters)))
            .collect();
        check(
            "Circular motion loses its stability to an oscillation by a jump.",
            format!(
                "the Hopf bifurcation of the stable circular motion is subcritical at {jumps} of {all} \
                points with κ_2 up to 1.6; it changes its kind at {}",
                if bautin.is_empty() { "no point".to_owned() } else { bautin.join("; ") }
            ),
            "first Lyapunov coefficient along the continued curve; Bautin points where it changes its sign",
            all > 3 && context.number(jumps as f64) == all as f64,
        )
    }

    /// The arch of the symmetry breakings, and the cells with zigzags.
    fn arch(&self, places: &[Place]) -> Claim {
        let Some(curve) = self.of("symmetry-breaking").next() else {
            return check("Stable zigzags lie below an arch.", "no curve", "continuation", false);
        };
        let line: Vec<[f64; 2]> = curve.points.iter().map(|point| point.parameters).collect();
        let top = line.iter().copied().fold([0.0; 2], |best, at| if at[1] > best[1] { at } else { best });
        let below = |place: &&Place| match at_height(&line, place.kappa3)[..] {
            [low, .., high] => low < place.kappa2 && place.kappa2 < high,
            _ => false,
        };
        let zigzag = places.iter().filter(|place| place.has(Regime::Zigzag));
        let (inside, outside): (Vec<&Place>, Vec<&Place>) = zigzag.partition(below);
        let count = places.iter().filter(below).count();
        check(
            "The zigzag of Fig. 4(a) is stable below one arch over the plane, on which left and right legs become unequal.",
            format!(
                "the curve joins both ends of the stable range at κ_3 = 0.1; its top is at (κ_2, κ_3) = {}; \
                zigzags in {} of {count} cells below it, and in {} of {} others, which belong to other \
                branches. Below it they are not alone: rotating zigzags, chaos and blow-up are met there as \
                well",
                words(Some(&top)),
                inside.len(),
                outside.len(),
                places.len() - count,
            ),
            "one symmetry breaking of the zigzag is continued through the plane and meets the other; motions of random starts on a finer \
             lattice about it: zigzags in at least a third of the cells below, and at most a fifth as often elsewhere",
            self.of("symmetry-breaking").count() == 1
                && count > 3
                && 3 * inside.len() >= count
                && 5 * outside.len() * count <= inside.len() * (places.len() - count),
        )
    }
}

/// The curve of every special point of the branches found, and of those at a faster triangle.
fn all(
    context: &Context<'_>,
    plane: &Plane,
    settings: &Settings,
    found: &Branches,
) -> Result<Vec<WholeCurve>, Error> {
    let mut all: Vec<WholeCurve> = Vec::new();
    let (_, fast) = follow(context, 1.4, FAST, Regime::Straight, 1)?;
    for (row, branches) in [(SLOW, found), (FAST, &*fast)] {
        let samples = branches.branches.iter().flat_map(Followed::samples);
        for point in samples.map(|sample| &sample.point).filter(|point| point.special.is_some()) {
            if !all.iter().any(|curve| passes(curve, point, row)) {
                all.push(WholeCurve::through(plane, point, row, settings, KAPPA3, &context.quiet())?);
            }
        }
    }
    Ok(all)
}

/// Returns `true` if a curve passes a special point of the row.
fn passes(curve: &WholeCurve, point: &Point, row: f64) -> bool {
    let period = |motion: &Motion| motion.orbit().map_or(1.0, PeriodicOrbit::period);
    let near = |pair: &[CurvePoint]| {
        let [a, b] = [&pair[0], &pair[1]];
        let same = point.special.is_some_and(|special| special.name() == a.special.name());
        let part = (row - a.parameters[1]) / (b.parameters[1] - a.parameters[1]);
        let kappa2 = a.parameters[0] + part * (b.parameters[0] - a.parameters[0]);
        let alike = (period(&a.motion) / period(&point.motion) - 1.0).abs() < 0.2;
        same && alike && (0.0..=1.0).contains(&part) && (kappa2 - point.parameter).abs() < 0.01
    };
    curve.points.windows(2).any(near)
}

/// The crossings of a line with a height, increasing.
fn at_height(line: &[[f64; 2]], height: f64) -> Vec<f64> {
    let crossing = |pair: &[[f64; 2]]| {
        let [[x, y], [u, v]] = [pair[0], pair[1]];
        ((y > height) != (v > height)).then(|| x + (height - y) / (v - y) * (u - x))
    };
    let mut all: Vec<f64> = line.windows(2).filter_map(crossing).collect();
    ascending(&mut all);
    all
}

fn words(at: Option<&[f64; 2]>) -> String {
    at.map_or_else(|| "nowhere".to_owned(), |[kappa2, kappa3]| format!("({kappa2:.4}, {kappa3:.4})"))
}
