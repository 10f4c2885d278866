//! The computation along the orbits in lanes: a task, its requests and its results.

use crate::steppers::unrolled::StepSlopes;
use crate::{Bundle, Mask, VectorField};

/// A task for lanes: a queue of initial-value problems (the members), and what is computed for each.
///
/// `D` is the length of the state. Everything called once per step is written over the bundle; functions called for a single
/// lane are called rarely. Implementations called per step must be `#[inline(always)]`.
pub trait LaneTask<B: Bundle, const D: usize> {
    /// The field of all lanes, with each lane's own parameters.
    type Field: VectorField<B>;

    /// `true` if [`LaneTask::stepped`] is to be called.
    const WATCHES: bool = false;

    /// `true` if [`LaneTask::after_step`] is to be called.
    const AFTER_STEP: bool = false;

    /// `true` if [`LaneTask::after_step`] is also called for lanes that have just entered, with steps
    /// estimated at their entry.
    const AT_ENTRY: bool = false;

    /// The field.
    fn field(&self) -> &Self::Field;

    /// Puts the parameters of the next member into `lane` of the field and returns its start; `None` if no member
    /// is left.
    fn enter(&mut self, lane: usize) -> Option<Entry<D>>;

    /// After each step of the bundle. Lanes of the returned mask leave as [`Why::Requested`], at the end of their step.
    #[inline(always)]
    fn stepped(&mut self, _step: &mut Stepped<'_, B, D, Self::Field>) -> Mask {
        Mask::default()
    }

    /// Lanes that leave as [`Why::Requested`] because of their state; called after every step.
    #[inline(always)]
    fn outside(&mut self, _u: &[B; D]) -> Mask {
        Mask::default()
    }

    /// After each adaptive step: may give lanes that accepted theirs another state, with the rates there, and another end. The
    /// rates of the lanes of the returned mask are re-evaluated.
    #[inline(always)]
    fn after_step(&mut self, _landed: &mut AfterStep<'_, B, D>) -> Mask {
        Mask::default()
    }

    /// The member in `lane` has stopped. Returns its next action.
    fn leave(&mut self, lane: usize, leaving: &Leaving<D>) -> Then;
}

/// The start of a member: time, state and end of the time span.
#[derive(Clone, Copy, Debug)]
pub struct Entry<const D: usize> {
    /// Time.
    pub t: f64,
    /// State.
    pub u: [f64; D],
    /// End of the time span.
    pub t_end: f64,
    /// The pace of an earlier stretch, to continue it seamlessly; `None` to start.
    pub pace: Option<Pace>,
}

/// The state of step-size control for an orbit.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    pub(crate) h: f64,
    pub(crate) previous: f64,
}

/// The reason why a member has stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Why {
    /// It reached the end of its time span.
    Arrived,
    /// The task requested it, see [`LaneTask::stepped`].
    Requested,
    /// No further step is possible: the size required by error control is below the resolution of time, or a fixed step led to a
    /// state that is not finite. [`crate::drive`] determines where exactly and why for a single orbit.
    Failed,
}

/// A member that has stopped.
#[derive(Clone, Copy, Debug)]
pub struct Leaving<const D: usize> {
    /// The reason.
    pub why: Why,
    /// Time.
    pub t: f64,
    /// State.
    pub u: [f64; D],
    /// Its pace.
    pub pace: Pace,
    /// Accepted steps so far.
    pub steps: u64,
    /// Rejected steps so far.
    pub rejected: u64,
}

/// The next action of a member that has stopped.
#[derive(Clone, Copy, Debug)]
pub enum Then {
    /// Continues to this time, as if it had not stopped.
    Continue(f64),
    /// Leaves, so that the next member can enter.
    Leave,
}

/// The state of the lanes after a step.
pub struct AfterStep<'s, B, const D: usize> {
    /// Lanes whose step was accepted, and that continue.
    pub accepted: Mask,
    /// Time.
    pub t: B,
    /// End of the time span.
    pub t_end: &'s mut B,
    /// State.
    pub u: &'s mut [B; D],
    /// Rates there.
    pub rates: &'s mut [B; D],
    /// Accepted steps so far.
    pub steps: B,
    /// Rejected steps so far.
    pub rejected: B,
}

/// A step of the bundle, just made.
pub struct Stepped<'s, B, const D: usize, F> {
    /// Lanes whose step was accepted; the others are unchanged.
    pub accepted: Mask,
    /// Time at the end of the step.
    pub t: B,
    /// Time at its start.
    pub t_old: B,
    /// State at its end.
    pub u: &'s [B; D],
    /// State at its start.
    pub u_old: &'s [B; D],
    /// Its slopes, including the slope at its end but not those of dense output.
    pub slopes: &'s mut StepSlopes<B, D>,
    /// Number of the slope at its end.
    pub end: usize,
    /// The field.
    pub field: std::marker::PhantomData<F>,
}
