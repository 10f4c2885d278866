//! Continuation of special points over two parameters, over any equations.

use super::correct::{TIGHT, correct, normal, product, scaled};
use super::critical::{Critical, Reading};
use super::levels::Level;
use super::point::Obstruction;
use super::problem::{Failure, Problem};
use super::section::{Cut, Frame, Section};
use super::settings::Settings;
use super::special::Special;
use motiform_dynamics::Watch;
use std::cell::OnceCell;

/// The condition is solved for until a step across the curve is shorter than this: the error left is about its square.
const ACROSS: f64 = 1e-9;

/// The same, in the unit of levels: the range may be wide against what changes them. Multipliers are less exact.
const CRITICAL: f64 = 1e-8;
const CRITICAL_ORBITS: f64 = 1e-5;

/// Motions on the way are solved for to this part of the step that led to them.
const FINER: f64 = 1e-5;

/// Steps that the condition is solved in.
const TRIES: usize = 12;

/// Length over which slopes on the surface are taken where none are known. In units of a wide range it is shortened down to the second one,
/// until what is left of a straight line is below this part of the slope.
const PROBE: f64 = 1e-4;
const LEAST: f64 = 1e-9;
const BENT: f64 = 0.1;

/// The start is this close to a special point.
const NEAR: f64 = 1e-3;

fn singular() -> Failure {
    Failure::Obstructed(Obstruction::Singular)
}

/// A special point with all that is known there.
pub(super) struct Spot<L> {
    pub(super) x: Vec<f64>,
    pub(super) local: L,
    pub(super) levels: Vec<Vec<Level>>,
    pub(super) reading: Reading,
    pub(super) frame: Frame,
    /// Slope of the condition across the curve.
    pub(super) steep: f64,
    pub(super) arclength: f64,
    /// Of [`CurveTracer::turn`], once it was asked for.
    bend: OnceCell<Option<(Vec<f64>, f64)>>,
}

impl<L> Spot<L> {
    pub(super) fn parameters(&self) -> [f64; 2] {
        last_two(&self.x)
    }
}

pub(super) fn last_two(x: &[f64]) -> [f64; 2] {
    match x {
        [.., p, q] => [*p, *q],
        _ => [f64::NAN; 2],
    }
}

/// A motion near the curve, and the condition there.
struct Probe<L> {
    x: Vec<f64>,
    local: L,
    levels: Vec<Vec<Level>>,
    reading: Reading,
}

/// A curve being followed.
pub(super) struct CurveTracer<'f, P: Problem> {
    pub(super) watch: &'f dyn Watch,
    pub(super) problem: P,
    pub(super) settings: Settings,
    /// Ranges of the parameters.
    pub(super) ranges: [(f64, f64); 2],
    pub(super) critical: Critical,
    pub(super) special: Special,
    pub(super) spot: Spot<P::Local>,
    /// The place before, with its levels, and the length of the step from there.
    pub(super) before: Option<(Vec<f64>, Vec<Vec<Level>>, f64)>,
    pub(super) step: f64,
    /// Sizes of the orbits at the last places, with the parameters.
    pub(super) sizes: Vec<(f64, [f64; 2])>,
}

impl<'f, P: Problem> CurveTracer<'f, P> {
    /// From a special point at `x`.
    pub(super) fn start(
        problem: P,
        x: Vec<f64>,
        special: Special,
        (settings, ranges): (&Settings, [(f64, f64); 2]),
        watch: &'f dyn Watch,
    ) -> Result<Self, Failure> {
        let local = problem.local(&x, watch)?;
        let levels = problem.levels(&x, &local).ok_or_else(singular)?;
        let (critical, reading) = Critical::of(special, &levels, (problem.time().is_some(), problem.rate()))
            .ok_or_else(singular)?;
        let frame = Frame::any(problem.linear(&local), &problem.weights(&x)).ok_or_else(singular)?;
        let step = settings.first_step.abs().min(settings.largest_step);
        let spot =
            Spot { x, local, levels, reading, frame, steep: 1.0, arclength: 0.0, bend: OnceCell::new() };
        let settings = *settings;
        let (before, sizes) = (None, Vec::new());
        let mut tracer =
            Self { problem, watch, settings, ranges, critical, special, spot, before, step, sizes };
        tracer.spot = tracer.polished()?;
        let [p, q] = last_two(&tracer.spot.frame.along);
        let side = if q.abs() > 1e-6 * p.abs() { q } else { p };
        if side * settings.first_step < 0.0 {
            tracer.spot.frame.turn();
        }
        Ok(tracer)
    }

    /// The special point at the present place, which must be close to one.
    fn polished(&self) -> Result<Spot<P::Local>, Failure> {
        let Spot { x, frame, steep, .. } = self.framed()?;
        let (Probe { x: found, local, levels, reading }, steep, _) = self.solve(&x, &frame, steep)?;
        let weights = self.problem.weights(&x);
        let moved: Vec<f64> = found.iter().zip(&x).map(|(a, b)| a - b).collect();
        if product(&weights, &moved, &moved).sqrt() > NEAR {
            return Err(Failure::Obstructed(Obstruction::Newton));
        }
        Ok(Spot { x: found, local, levels, reading, frame, steep, arclength: 0.0, bend: OnceCell::new() })
    }

    /// The present place with a frame along the curve, from differences of the condition.
    pub(super) fn framed(&self) -> Result<Spot<P::Local>, Failure> {
        let x = &self.spot.x;
        let weights = self.problem.weights(x);
        let local = self.problem.local(x, self.watch)?;
        let levels = self.problem.levels(x, &local).ok_or_else(singular)?;
        let any = Frame::any(self.problem.linear(&local), &weights).ok_or_else(singular)?;
        let here = self.critical.read(&levels, self.spot.reading.angle).ok_or_else(singular)?.value;
        let mut length = PROBE;
        let [a, b] = loop {
            let all = [
                self.sides(x, (&any.along, &any.across), length)?,
                self.sides(x, (&any.across, &any.along), length)?,
            ];
            let slopes = all.map(|[low, high]| (high - low) / (2.0 * length));
            let bent = all.map(|[low, high]| (high + low - 2.0 * here).abs());
            if bent[0].max(bent[1]) <= BENT * length * libm::hypot(slopes[0], slopes[1]) || length <= LEAST {
                break slopes;
            }
            length *= 0.1;
        };
        let (frame, steep) = any.level(a, b).ok_or_else(singular)?;
        let reading = self.spot.reading.clone();
        let arclength = self.spot.arclength;
        Ok(Spot { x: x.clone(), local, levels, reading, frame, steep, arclength, bend: OnceCell::new() })
    }

    /// The condition on the surface, the length before `x` in a direction and after it; `other` is normal to the direction.
    fn sides(
        &self,
        x: &[f64],
        (direction, other): (&[f64], &[f64]),
        length: f64,
    ) -> Result<[f64; 2], Failure> {
        let at = |length: f64| {
            let guess = x.iter().zip(direction).map(|(x, d)| x + length * d).collect();
            self.probe(guess, x, (other, direction), TIGHT).map(|probe| probe.reading.value)
        };
        Ok([at(-length)?, at(length)?])
    }

    /// The direction of the surface in which neither parameter changes, as there is one at a fold, and the slope of the condition in this
    /// direction: at a cusp it is 0.
    fn bend<'s>(&self, spot: &'s Spot<P::Local>) -> Option<&'s (Vec<f64>, f64)> {
        let bend = || {
            let Frame { along, across } = &spot.frame;
            let units = self.ranges.map(|(low, high)| high - low);
            let [[p, q], [r, s]] = [last_two(along), last_two(across)];
            let rows = [[p / units[0], r / units[0]], [q / units[1], s / units[1]]];
            let [a, b] = rows.into_iter().max_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])))?;
            let (frame, _) = spot.frame.level(a, b)?;
            let [low, high] = self.sides(&spot.x, (&frame.along, &frame.across), PROBE).ok()?;
            Some((frame.along, (high - low) / (2.0 * PROBE)))
        };
        spot.bend.get_or_init(bend).as_ref()
    }

    /// The slope of [`CurveTracer::bend`] at `spot`, in the direction that goes on from the one at the present place.
    pub(super) fn turn(&self, spot: &Spot<P::Local>) -> f64 {
        let Some((before, (now, slope))) = self.bend(&self.spot).zip(self.bend(spot)) else {
            return f64::NAN;
        };
        slope * product(&self.problem.weights(&spot.x), &before.0, now).signum()
    }

    /// The motion near `guess` in the plane through `centre` normal to `normal_to`, at the guess's height along `along`.
    fn probe(
        &self,
        guess: Vec<f64>,
        centre: &[f64],
        (normal_to, along): (&[f64], &[f64]),
        tolerance: f64,
    ) -> Result<Probe<P::Local>, Failure> {
        let weights = self.problem.weights(centre);
        let row = normal(normal_to, &weights);
        let section = Section { equations: &self.problem, row, centre: centre.to_vec() };
        let found = correct(&section, guess, &normal(along, &weights), tolerance, self.watch)?;
        let (x, Cut { inner: local, .. }) = (found.x, found.local);
        let levels = self.problem.levels(&x, &local).ok_or_else(singular)?;
        let reading = self.critical.read(&levels, self.spot.reading.angle).ok_or_else(singular)?;
        Ok(Probe { x, local, levels, reading })
    }

    /// The special point in the plane through `centre` normal to the curve, by secants; with the slope of the condition, and its distance
    /// from the centre.
    fn solve(
        &self,
        centre: &[f64],
        frame: &Frame,
        mut steep: f64,
    ) -> Result<(Probe<P::Local>, f64, f64), Failure> {
        let directions = (frame.along.as_slice(), frame.across.as_slice());
        let mut probe = self.probe(centre.to_vec(), centre, directions, TIGHT)?;
        let critical = if self.critical.orbits { CRITICAL_ORBITS } else { CRITICAL };
        let (mut off, mut last) = (0.0, f64::INFINITY);
        for count in 0..TRIES {
            let change = (-probe.reading.value / steep).clamp(-0.1, 0.1);
            if !change.is_finite() {
                break;
            }
            let guess: Vec<f64> = probe.x.iter().zip(&frame.across).map(|(x, d)| x + change * d).collect();
            let stalled = count > 3 && change.abs() < 1000.0 * ACROSS && change.abs() > 0.5 * last;
            if change.abs() < ACROSS && probe.reading.off < critical || stalled {
                // so short a step leaves nothing that another solution would show
                let x = if stalled { probe.x } else { guess };
                return Ok((Probe { x, ..probe }, steep, off));
            }
            let tolerance = TIGHT.max(FINER * change.abs());
            let next = self.probe(guess, centre, directions, tolerance)?;
            let secant = (next.reading.value - probe.reading.value) / change;
            if change.abs() > 1e-8 && secant.is_finite() && secant != 0.0 {
                steep = secant;
            }
            (probe, off) = (next, off + change);
            last = change.abs();
        }
        Err(Failure::Obstructed(Obstruction::Newton))
    }

    /// The special point after the length `s`, and how far it is from where it was expected.
    pub(super) fn at(&self, s: f64) -> Result<(Spot<P::Local>, f64), Failure> {
        let Spot { x, frame, steep, arclength, .. } = &self.spot;
        let mut centre: Vec<f64> = x.iter().zip(&frame.along).map(|(x, t)| x + s * t).collect();
        if let Some((before, _, length)) = self.before.as_ref().filter(|before| s < 2.0 * before.2) {
            for (i, value) in centre.iter_mut().enumerate() {
                let chord = (x[i] - before[i]) / length;
                *value += s * s / length * (frame.along[i] - chord);
            }
        }
        let (found, steep, off) = self.solve(&centre, frame, *steep)?;
        let weights = self.problem.weights(&found.x);
        let along = scaled(self.tangent(&found.x, s), &weights).ok_or_else(singular)?;
        let guess = Frame { along, across: frame.across.clone() };
        let frame = guess.within(self.problem.linear(&found.local), &weights).ok_or_else(singular)?;
        let Probe { x, local, levels, reading } = found;
        let (arclength, bend) = (arclength + s, OnceCell::new());
        Ok((Spot { x, local, levels, reading, frame, steep, arclength, bend }, off))
    }

    /// The direction at `x`, the length `s` after the present place: that of the parabola through the last places.
    fn tangent(&self, x: &[f64], s: f64) -> Vec<f64> {
        let now = &self.spot.x;
        let along = |i: usize| {
            let chord = (x[i] - now[i]) / s;
            match &self.before {
                Some((before, _, length)) => {
                    let old = (now[i] - before[i]) / length;
                    chord + (chord - old) * s / (length + s)
                }
                None => 2.0 * chord - self.spot.frame.along[i],
            }
        };
        (0..x.len()).map(along).collect()
    }
}
