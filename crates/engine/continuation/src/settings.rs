//! Settings of the continuation of a branch.

use super::tracer::TOLERANCE;
use motiform_analysis::periodic::Flow;
use motiform_analysis::{Error, Result};
use motiform_dynamics::StepControl;
use motiform_dynamics::steppers::{DOP853, Method};

/// Settings of the continuation of a branch.
///
/// Lengths along a branch are measured with the parameter in units of the width of the range, shapes in units of the first shape's
/// size (root mean square over the nodes of an orbit) or a quarter of their own, turning rates and angles in radians, and the period in
/// units of itself.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// The branch ends where the parameter leaves this range; its last point lies exactly at the edge.
    pub range: (f64, f64),
    /// First step along the branch; it points to larger values of the parameter where it is positive.
    pub first_step: f64,
    /// The branch ends where steps as short as this fail.
    pub smallest_step: f64,
    /// No step is longer.
    pub largest_step: f64,
    /// Newton's method has converged on a branch with a step shorter than this. Special points are located to a tolerance of their own.
    pub tolerance: f64,
    /// Most points of the branch (special points not counted).
    pub most_points: usize,
    /// The branch ends where a shape is larger: its amplitude blows up.
    pub largest_size: f64,
    /// The branch ends where the time of an orbit is longer (model time; half the period of a zigzag).
    pub longest_time: f64,
    /// Parts of an orbit to begin with, at least 1; more follow where it amplifies deviations.
    pub parts: usize,
    /// Of the motions that begin at a Hopf bifurcation, steady ones alone.
    pub steady: bool,
    /// Method and tolerance of the flow, for orbits.
    pub flow: Flow,
}

impl Settings {
    /// Settings for a parameter between `from` and `to`: at least 50 points from one end of the range to the other.
    pub fn over(from: f64, to: f64) -> Self {
        Self {
            range: (from.min(to), from.max(to)),
            first_step: if to < from { -0.005 } else { 0.005 },
            smallest_step: 1e-7,
            largest_step: 0.02,
            tolerance: TOLERANCE,
            most_points: 10_000,
            largest_size: 1e6,
            longest_time: f64::INFINITY,
            parts: 4,
            steady: false,
            flow: Flow {
                method: Method::Explicit(&DOP853),
                control: StepControl::Adaptive { rtol: 1e-12, atol: 1e-16 },
                max_steps: 1_000_000,
            },
        }
    }

    /// The same, first towards the other side.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self { first_step: -self.first_step, ..self }
    }

    /// Width of the range.
    pub fn width(&self) -> f64 {
        self.range.1 - self.range.0
    }

    /// Checks the numbers, and that the range holds the start.
    pub(super) fn check(&self, start: f64) -> Result<()> {
        let check = |name, value: f64, ok: bool, range| {
            if ok && !value.is_nan() { Ok(()) } else { Err(Error::OutOfRange { name, value, range }) }
        };
        let (low, high) = self.range;
        check(
            "end of the range",
            high,
            high.is_finite() && low.is_finite() && low < high,
            "above its beginning",
        )?;
        let small = self.smallest_step;
        check("smallest step", small, small > 0.0 && small.is_finite(), "above 0")?;
        let large = self.largest_step;
        check("largest step", large, large >= small && large.is_finite(), "of at least the smallest step")?;
        let first = self.first_step;
        check("first step", first, first != 0.0 && first.is_finite(), "other than 0")?;
        let close = self.tolerance;
        check("tolerance", close, close > 0.0 && close < large, "above 0 and below the largest step")?;
        check("largest size", self.largest_size, self.largest_size > 0.0, "above 0")?;
        check("longest time", self.longest_time, self.longest_time > 0.0, "above 0")?;
        check("parts", self.parts as f64, self.parts > 0, "of at least 1")?;
        self.flow.method.validate(self.flow.control)?;
        if (low..=high).contains(&start) { Ok(()) } else { Err(Error::OutsideRange { start, low, high }) }
    }
}
