//! What is computed along the orbits in lanes: a task, its questions and its answers.

use crate::steppers::unrolled::StepSlopes;
use crate::{Bundle, Mask, VectorField};

/// A task for lanes: a queue of initial-value problems (the members), and what is done with each.
///
/// `D` is the length of the state. Everything called once per step is written over the bundle; what is called for a single
/// lane happens rarely. Implementations must be `#[inline(always)]` where they are called per step.
pub trait LaneTask<B: Bundle, const D: usize> {
    /// The field of all lanes, with each lane's own parameters.
    type Field: VectorField<B>;

    /// Whether [`LaneTask::stepped`] wants to be called.
    const WATCHES: bool = false;

    /// Whether [`LaneTask::after_step`] wants to be called.
    const AFTER_STEP: bool = false;

    /// The field.
    fn field(&self) -> &Self::Field;

    /// Puts the parameters of the next member into `lane` of the field and says where it starts; `None` if no member
    /// is left.
    fn enter(&mut self, lane: usize) -> Option<Entry<D>>;

    /// After each step of the bundle. Lanes of the returned mask leave as [`Why::Requested`], at the end of their step.
    #[inline(always)]
    fn stepped(&mut self, _step: &mut Stepped<'_, B, D, Self::Field>) -> Mask {
        Mask::default()
    }

    /// Lanes that shall leave as [`Why::Requested`] for the state they are in: asked after every step.
    #[inline(always)]
    fn outside(&mut self, _u: &[B; D]) -> Mask {
        Mask::default()
    }

    /// After each adaptive step: may give lanes that accepted theirs another state, with the rates there, and another end. The
    /// rates of the lanes of the returned mask are evaluated anew.
    #[inline(always)]
    fn after_step(&mut self, _landed: &mut AfterStep<'_, B, D>) -> Mask {
        Mask::default()
    }

    /// The member in `lane` has come to a stop. What it does next.
    fn leave(&mut self, lane: usize, leaving: &Leaving<D>) -> Then;
}

/// Where a member starts.
#[derive(Clone, Copy, Debug)]
pub struct Entry<const D: usize> {
    /// Time.
    pub t: f64,
    /// State.
    pub u: [f64; D],
    /// End of the time span.
    pub t_end: f64,
    /// The pace of an earlier stretch, to go on as if it had not been left; `None` to begin.
    pub pace: Option<Pace>,
}

/// What step-size control remembers of an orbit.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    pub(crate) h: f64,
    pub(crate) previous: f64,
}

/// Why a member has come to a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Why {
    /// It is at the end of its time span.
    Arrived,
    /// Its members asked for it, see [`LaneTask::stepped`].
    Requested,
    /// It has no next step: the size that error control asks for is below the resolution of time, or a fixed step led to a
    /// state that is not finite. Where exactly and why, [`crate::drive`] says of a single orbit.
    Failed,
}

/// A member that has come to a stop.
#[derive(Clone, Copy, Debug)]
pub struct Leaving<const D: usize> {
    /// Why.
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

/// What a member that has come to a stop does next.
#[derive(Clone, Copy, Debug)]
pub enum Then {
    /// Goes on to this time, as if it had not stopped.
    Continue(f64),
    /// Makes room for the next member.
    Leave,
}

/// Where the lanes stand after a step.
pub struct AfterStep<'s, B, const D: usize> {
    /// Lanes whose step was accepted, and that go on.
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
    /// Lanes whose step was accepted; the others stand where they were.
    pub accepted: Mask,
    /// Time at the end of the step.
    pub t: B,
    /// Time at its start.
    pub t_old: B,
    /// Its size.
    pub h: B,
    /// State at its end.
    pub u: &'s [B; D],
    /// State at its start.
    pub u_old: &'s [B; D],
    /// Its slopes; the slope at its end is there, those of dense output are not.
    pub slopes: &'s mut StepSlopes<B, D>,
    /// Number of the slope at its end.
    pub end: usize,
    /// The field.
    pub field: std::marker::PhantomData<F>,
}
