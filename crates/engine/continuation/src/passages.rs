//! The saddles that an orbit passes one after the other.

use super::homoclinic::{RATES, Saddle};
use super::joins::Joins;
use super::orbits::{Local, Orbits, reduced};
use super::shooting::shape_after;
use motiform_analysis::RelativeEquilibrium;
use motiform_analysis::equilibrium::Units;
use motiform_analysis::linear::norm;
use motiform_analysis::symmetry::align;
use motiform_dynamics::{Equivariant, Watch};
use std::ops::RangeInclusive;

/// Shapes along an orbit that are looked at.
const SHAPES: usize = 2048;

/// An equilibrium is looked for where an orbit is slower than this part of its largest speed.
const SLOW: f64 = 0.1;

/// An orbit passes an equilibrium that it comes closer to than this part of its own extent,
const CLOSE: f64 = 0.02;

/// and the passage lasts as long as it is within this part of it.
const NEAR: f64 = 0.1;

/// Closer than this multiple of the least distance the orbit neither comes nor goes along one direction.
const TURNING: f64 = 3.0;

/// The passages take at least this part of the time.
const MOST: f64 = 0.5;

/// One passage of an orbit by an equilibrium.
pub(super) struct Passage {
    /// The equilibrium.
    pub(super) saddle: Saddle,
    /// Part of the time of all passages.
    pub(super) share: f64,
    /// `true` if the distance falls and grows again as eigenvalues of the equilibrium say.
    is_clear: bool,
}

/// The equilibria that an orbit passes on its way.
pub(super) struct Passages {
    /// The passages, in their order.
    pub(super) all: Vec<Passage>,
    /// The relation of their equilibria.
    pub(super) joins: Joins,
}

impl Passages {
    /// Returns `true` if each of them is by a saddle, and they take most of the time.
    pub(super) fn is_clear(&self) -> bool {
        self.all.iter().all(|passage| passage.is_clear)
    }
}

impl Orbits<'_> {
    /// The equilibria that the orbit passes: one is looked for by Newton's method from every shape at which the orbit is slower than just
    /// before and just after. `None` where there is no passage, or they take less than half of the time.
    ///
    /// Beside a saddle the distance falls as `exp(-s t)` on the way in and grows as `exp(u t)` on the way out, with a decaying eigenvalue
    /// of real part `-s` and a growing one `u`: a passage is clear where both rates are measured along the orbit.
    pub(super) fn passed(&self, x: &[f64], local: &Local, watch: &dyn Watch) -> Option<Passages> {
        let way = Way::of(self, x, local, watch)?;
        let mut found: Vec<(RangeInclusive<isize>, Passage)> = Vec::new();
        for place in way.slow_places() {
            if found.iter().any(|(during, _)| way.is_within(place, during)) {
                continue;
            }
            let at = RelativeEquilibrium::find(way.body, &way.shapes[place]);
            found.extend(at.and_then(|at| way.passage(self, at, place.cast_signed())));
        }
        let steps: f64 = found.iter().map(|(_, passage)| passage.share).sum();
        let mut all: Vec<Passage> = found.into_iter().map(|(_, passage)| passage).collect();
        all.iter_mut().for_each(|passage| passage.share /= steps);
        let joins = joins(way.body, self.mirrored, &all)?;
        (steps > MOST * way.shapes.len() as f64).then_some(Passages { all, joins })
    }
}

/// The relation of the equilibria that an orbit passes; `None` without any.
fn joins(body: &dyn Equivariant, mirrored: bool, all: &[Passage]) -> Option<Joins> {
    let first = &all.first()?.saddle.found;
    let mut image = first.clone();
    body.mirror(&mut image.shape);
    let (mirrors, unit) = (body.symmetry().mirror, Units::of(body).length);
    let own = mirrors && image.is_same(body, first, unit);
    let is = |passage: &Passage| passage.saddle.found.is_same(body, first, unit);
    let is_image = |passage: &Passage| mirrors && passage.saddle.found.is_same(body, &image, unit);
    Some(if all.iter().all(is) && (own || !mirrored) {
        Joins::Itself
    } else if all.iter().all(|passage| is(passage) || is_image(passage)) {
        Joins::Images
    } else {
        Joins::Different
    })
}

/// The shapes of an orbit at equal times; by its symmetry it goes on to both sides.
struct Way<'w> {
    body: &'w dyn Equivariant,
    shapes: Vec<Vec<f64>>,
    step: f64,
    mirrored: bool,
}

impl<'w> Way<'w> {
    fn of(orbits: &Orbits<'_>, x: &[f64], local: &'w Local, watch: &dyn Watch) -> Option<Self> {
        let (body, each) = (local.body.as_ref(), SHAPES.div_ceil(orbits.parts));
        let step = orbits.span(x) / each as f64;
        let mut shapes = Vec::with_capacity(each * orbits.parts);
        for part in 0..orbits.parts {
            let mut shape = orbits.node(x, part).to_vec();
            for _ in 1..each {
                let next = shape_after(body, &shape, step, (&orbits.flow, orbits.length), watch).ok()?;
                shapes.push(std::mem::replace(&mut shape, next));
            }
            shapes.push(shape);
        }
        Some(Self { body, shapes, step, mirrored: orbits.mirrored })
    }

    /// The shapes at which the reduced orbit is slow, and slower than at its neighbours.
    fn slow_places(&self) -> Vec<usize> {
        let speed = |shape: &Vec<f64>| {
            let (rate, spin) = (self.body.rates(shape), self.body.spun(shape));
            norm(&reduced(&rate, &spin))
        };
        let speeds: Vec<f64> = self.shapes.iter().map(speed).collect();
        let (count, most) = (speeds.len(), speeds.iter().copied().fold(0.0, f64::max));
        let is_slow = |&i: &usize| {
            let beside = [speeds[(i + count - 1) % count], speeds[(i + 1) % count]];
            speeds[i] < SLOW * most && speeds[i] <= beside[0] && speeds[i] < beside[1]
        };
        (0..count).filter(is_slow).collect()
    }

    /// Returns `true` if a shape lies in a passage, which may begin before the first shape or end after the last one.
    fn is_within(&self, place: usize, during: &RangeInclusive<isize>) -> bool {
        let count = self.shapes.len().cast_signed();
        [-count, 0, count].iter().any(|turn| during.contains(&(place.cast_signed() + turn)))
    }

    /// The distance of a shape, of any whole number, from an equilibrium.
    fn distance(&self, at: &RelativeEquilibrium, place: isize) -> f64 {
        let count = self.shapes.len().cast_signed();
        let mirrored = self.mirrored && place.div_euclid(count) % 2 != 0;
        align(self.body, &at.shape, &self.shapes[place.rem_euclid(count) as usize], mirrored).distance
    }

    /// The passage by an equilibrium about a shape: when, and how. (Its share is the number of shapes.)
    fn passage(
        &self,
        orbits: &Orbits<'_>,
        at: RelativeEquilibrium,
        place: isize,
    ) -> Option<(RangeInclusive<isize>, Passage)> {
        let count = self.shapes.len().cast_signed();
        let distances: Vec<f64> = (place - count..=place + count).map(|i| self.distance(&at, i)).collect();
        let extent = distances.iter().copied().fold(0.0, f64::max);
        let (middle, near) = (count as usize, NEAR * extent);
        let begin = (0..=middle).rev().find(|&i| distances[i] > near)?;
        let end = (middle..distances.len()).find(|&i| distances[i] > near)?;
        let closest = (begin..=end).min_by(|&a, &b| distances[a].total_cmp(&distances[b]))?;
        if distances[closest] > CLOSE * extent || end - begin >= middle {
            return None;
        }
        let turning = TURNING * distances[closest];
        let inner = |i: &usize| distances[*i] < turning;
        let (comes, goes) = ((begin..=closest).find(inner)?, (closest..=end).rev().find(inner)?);
        let rate = |from: usize, to: usize| {
            libm::log(distances[to] / distances[from]) / ((to - from) as f64 * self.step)
        };
        let rates = orbits.kept_rates(self.body, &at, self.shapes.iter().map(Vec::as_slice));
        let all = if rates.is_empty() { &at.eigenvalues } else { &rates };
        let has = |rate: f64| all.iter().any(|value| (value.0 / rate - 1.0).abs() < RATES);
        let is_clear = has(rate(begin, comes)) && has(rate(goes, end));
        let during = place + begin.cast_signed() - count..=place + end.cast_signed() - count;
        let saddle = Saddle { found: at, rates, near: distances[closest] / extent };
        Some((during, Passage { saddle, share: (end - begin) as f64, is_clear }))
    }
}
