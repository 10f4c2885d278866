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

/// A place on a curve, and its distance from the beginning of the step.
type At = (f64, Vec<f64>);

impl<L> Event<L> {
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
            let [low, high] = self.closed_in(&part, (length, new.x.clone()))?;
            let middle: Vec<f64> = low.1.iter().zip(&high.1).map(|(a, b)| 0.5 * (a + b)).collect();
            let gained = self.problem.local(&middle, self.watch);
            if gained.is_ok_and(|local| self.problem.gains(&middle, &local, GAINED).is_some()) {
                let [a, b] = [&self.spot, new].map(|spot| last_two(&spot.frame.along));
                // beyond it the curve consists of images of what it was; frequencies that vanish there are rounding beyond
                let images = a[0] * b[0] + a[1] * b[1] < 0.0;
                return Ok(Some(Event {
                    s: 0.5 * (low.0 + high.0),
                    spot: None,
                    kind: Degenerate::GainsSymmetry,
                    at: Some(last_two(&middle)),
                    ends: images || self.critical.condition == Condition::Pair,
                }));
            }
        }
        Ok(None)
    }

    /// The last solutions before and after the place at which `part` changes its sign, as near to it as solutions are found.
    fn closed_in(&self, part: &dyn Fn(&[f64]) -> f64, mut high: At) -> Result<[At; 2], End> {
        let (mut low, length) = ((0.0, self.spot.x.clone()), high.0);
        for _ in 0..TRIES {
            if high.0 - low.0 < CLOSE * length {
                break;
            }
            let s = 0.5 * (low.0 + high.0);
            match self.at(s) {
                Ok((spot, _)) if part(&spot.x) > 0.0 => low = (s, spot.x),
                Ok((spot, _)) => high = (s, spot.x),
                Err(Failure::Stopped) => return Err(End::Stopped),
                Err(Failure::Obstructed(_)) => break,
            }
        }
        Ok([low, high])
    }
}
