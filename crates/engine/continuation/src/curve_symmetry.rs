//! Where a curve of special points passes a motion of more symmetry.

use super::classes::GAINED;
use super::critical::Condition;
use super::curve_steps::Event;
use super::curve_tracer::{CurveTracer, Spot, last_two};
use super::degenerate::Degenerate;
use super::point::End;
use super::problem::{Failure, Problem};

/// Steps in which such a place is closed in on, and the part of a step to which it is.
const TRIES: usize = 60;
const CLOSE: f64 = 1e-9;

/// Part of a step within which the symmetry that is gained explains what else happens.
const BESIDE: f64 = 1e-2;

/// A place on a curve: its distance from the beginning of the step, the unknowns, and what changes its sign.
pub(super) type Side = (f64, Vec<f64>, f64);

impl<L> Event<L> {
    /// The place in the middle of two sides, at which the equations may be singular.
    pub(super) fn between([low, high]: &[Side; 2], kind: Degenerate, ends: bool) -> Self {
        let ([a, b], [c, d]) = (last_two(&low.1), last_two(&high.1));
        Self { s: 0.5 * (low.0 + high.0), spot: None, kind, at: Some([0.5 * (a + c), 0.5 * (b + d)]), ends }
    }

    /// Returns `true` if a sign change of the same step is due to the symmetry gained here. Near this point everything that belongs to the
    /// symmetry vanishes, and signs are those of rounding; a sign change that could not be located is taken for one of these.
    pub(super) fn explains(&self, other: &Self, length: f64) -> bool {
        other.kind == Degenerate::Unresolved || (other.s - self.s).abs() < BESIDE * length
    }
}

impl<P: Problem> CurveTracer<'_, P> {
    /// The place before `new` at which the motion gains a symmetry: a part of its shape (the unknowns that rotations mix) changes its sign
    /// there.
    ///
    /// Other branches cross there, so that the equations are singular: the place is the middle of the last solutions on both sides.
    pub(super) fn symmetric(
        &self,
        new: &Spot<P::Local>,
        length: f64,
    ) -> Result<Option<Event<P::Local>>, End> {
        for mode in self.problem.modes(&self.spot.local) {
            let part = |x: &[f64]| -> f64 {
                let own = mode.iter().zip(x.iter().zip(&self.spot.x)).filter(|(inside, _)| **inside);
                own.map(|(_, (x, y))| x * y).sum()
            };
            if part(&new.x) >= 0.0 {
                continue;
            }
            let sides = self.closed_in(&|spot| part(&spot.x), (new, length))?;
            let middle: Vec<f64> = sides[0].1.iter().zip(&sides[1].1).map(|(a, b)| 0.5 * (a + b)).collect();
            let gained = self.problem.local(&middle, self.watch);
            if gained.is_ok_and(|local| self.problem.gains(&middle, &local, GAINED).is_some()) {
                let [a, b] = [&self.spot, new].map(|spot| last_two(&spot.frame.along));
                // beyond it the curve consists of images of what it was; frequencies that vanish there are rounding beyond
                let images = a[0] * b[0] + a[1] * b[1] < 0.0;
                let ends = images || self.critical.condition == Condition::Pair;
                return Ok(Some(Event::between(&sides, Degenerate::GainsSymmetry, ends)));
            }
        }
        Ok(None)
    }

    /// The last solutions before and after the place at which `part` changes its sign, as near to it as solutions are found.
    pub(super) fn closed_in(
        &self,
        part: &dyn Fn(&Spot<P::Local>) -> f64,
        (new, length): (&Spot<P::Local>, f64),
    ) -> Result<[Side; 2], End> {
        let side = |spot: &Spot<P::Local>, s| (s, spot.x.clone(), part(spot));
        let (mut low, mut high) = (side(&self.spot, 0.0), side(new, length));
        for _ in 0..TRIES {
            if high.0 - low.0 < CLOSE * length {
                break;
            }
            let attempt = |share: f64| {
                let s = low.0 + share * (high.0 - low.0);
                self.at(s).map(|(spot, _)| side(&spot, s))
            };
            // the middle may be the very place, where there is no solution
            match attempt(0.5).or_else(|_| attempt(0.35)) {
                Ok(found) => {
                    let same = if found.2 * low.2 > 0.0 { &mut low } else { &mut high };
                    *same = found;
                }
                Err(Failure::Stopped) => return Err(End::Stopped),
                Err(Failure::Obstructed(_)) => break,
            }
        }
        Ok([low, high])
    }
}
