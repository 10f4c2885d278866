//! Members from start to end: the plain ensemble run.

use super::{Entry, Leaving, Members, Turn, Why, run_adaptive, run_fixed};
use crate::drive::drive;
use crate::orbit::check_start;
use crate::scalar::MOST_LANES;
use crate::simd::{InstructionSet, LaneKernel, run_lanes_on};
use crate::steppers::unrolled::{Dop853, Method, Rk4};
use crate::steppers::{DOP853, RK4, Tableau};
use crate::{Bundle, Error, Mask, Orbit, Outcome, Request, StepControl, VectorField};
use std::marker::PhantomData;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A field of one orbit that has a form over lanes, each lane with its own parameters.
pub trait InLanes: VectorField<f64> + Sync {
    /// The field of a bundle.
    type Field<B: Bundle>: VectorField<B>;

    /// The tangent flow of a bundle, with `K` vectors.
    type Tangent<B: Bundle, const K: usize>: VectorField<B> + AsMut<Self::Field<B>>;

    /// The tangent flow of a field.
    fn tangent<B: Bundle, const K: usize>(field: Self::Field<B>) -> Self::Tangent<B, K>;

    /// The infinitesimal rotation of a shape ([`crate::Equivariant::spin`]).
    fn spin<B: Bundle>(shape: &[B], out: &mut [B]);

    /// A bundle with this field in every lane.
    fn bundle<B: Bundle>(&self) -> Self::Field<B>;

    /// Puts this field into one lane.
    fn put<B: Bundle>(&self, lane: usize, field: &mut Self::Field<B>);
}

/// One initial-value problem of an ensemble.
#[derive(Clone, Copy, Debug)]
pub struct Member<F, const D: usize> {
    /// Its field.
    pub field: F,
    /// State at time 0.
    pub start: [f64; D],
    /// End of the time span, not before 0.
    pub t_end: f64,
}

/// Where a member ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End<const D: usize> {
    /// How.
    pub outcome: Outcome,
    /// Last state.
    pub u: [f64; D],
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
}

/// How an ensemble is run.
#[derive(Clone, Copy, Debug)]
pub struct Propagation {
    /// The method: one of [`lane_methods`].
    pub method: &'static Tableau,
    /// Its control.
    pub control: StepControl,
    /// The instructions to use, or the widest ones if this machine does not have them.
    pub instructions: InstructionSet,
    /// A state beyond this norm has escaped.
    pub escape_norm: f64,
    /// Threads to use.
    pub threads: usize,
}

/// The methods that run in lanes.
#[must_use]
pub fn lane_methods() -> [&'static Tableau; 2] {
    [&RK4, &DOP853]
}

/// Runs every member to its end: over `threads` threads, eight at a time on each.
///
/// The ends do not depend on threads or instruction set, and are those of [`crate::Orbit`] to the last bit.
///
/// # Errors
/// What [`StepControl::validate`] and [`Orbit::new`] refuse; [`Error::NoLanes`] for a method without lanes.
pub fn propagate<F: InLanes, const D: usize>(
    members: &[Member<F, D>],
    how: &Propagation,
) -> Result<Vec<End<D>>, Error> {
    how.control.validate(how.method)?;
    if !lane_methods().iter().any(|method| method.name == how.method.name) {
        return Err(Error::NoLanes { stepper: how.method.name });
    }
    for member in members {
        check_start(member.field.dim(), 0.0, &member.start)?;
        check_start(member.field.dim(), member.t_end, &member.start)?; // an end that is a number
    }
    let queue = Queue { members, next: AtomicUsize::new(0), ends: Mutex::new(vec![None; members.len()]) };
    match how.method.name {
        "rk4" => queue.work_through::<Rk4>(how),
        _ => queue.work_through::<Dop853>(how),
    }
    let ends = queue.ends.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    members.iter().zip(ends).map(|(member, end)| end.map_or_else(|| alone(member, how), Ok)).collect()
}

/// A member as a single orbit: what a lane leaves open, how exactly a run failed, is said here.
fn alone<F: InLanes, const D: usize>(member: &Member<F, D>, how: &Propagation) -> Result<End<D>, Error> {
    let mut orbit = Orbit::new(&member.field, how.method, how.control, 0.0, &member.start)?;
    let request = Request { escape_norm: how.escape_norm, ..Request::until(member.t_end, D) };
    let outcome = drive(&mut orbit, &request, &mut ())?;
    let mut u = [0.0; D];
    u.copy_from_slice(orbit.state());
    let work = orbit.counters();
    Ok(End { outcome, u, steps: work.steps, rejected: work.rejected })
}

/// What the threads share.
struct Queue<'m, F, const D: usize> {
    members: &'m [Member<F, D>],
    next: AtomicUsize,
    ends: Mutex<Vec<Option<End<D>>>>,
}

impl<F: InLanes, const D: usize> Queue<'_, F, D> {
    /// Runs all members with method `M`, on as many threads as asked for.
    fn work_through<M: Method>(&self, how: &Propagation) {
        std::thread::scope(|scope| {
            for _ in 1..how.threads.min(self.members.len() / 8) {
                scope.spawn(|| self.work::<M>(how));
            }
            self.work::<M>(how);
        });
    }

    /// The work of one thread.
    fn work<M: Method>(&self, how: &Propagation) {
        run_lanes_on(how.instructions, Run::<F, M, D> { queue: self, how, method: PhantomData });
    }
}

/// The work of one thread, in lanes.
struct Run<'q, F, M, const D: usize> {
    queue: &'q Queue<'q, F, D>,
    how: &'q Propagation,
    method: PhantomData<M>,
}

impl<F: InLanes, M: Method, const D: usize> LaneKernel for Run<'_, F, M, D> {
    type Output = ();

    #[inline(always)]
    fn run<B: Bundle>(self) {
        let Some(first) = self.queue.members.first() else { return };
        let mut crew = Crew::<B, F, D> {
            field: first.field.bundle(),
            queue: self.queue,
            riding: [0; MOST_LANES],
            escape: B::splat(self.how.escape_norm * self.how.escape_norm),
        };
        match self.how.control {
            StepControl::Fixed { step } => run_fixed::<M, B, D, _>(&mut crew, step),
            StepControl::Adaptive { rtol, atol } => {
                if const { M::TABLEAU.is_adaptive() } {
                    run_adaptive::<M, B, D, _>(&mut crew, (rtol, atol));
                }
            }
        }
    }
}

/// The members in the lanes of one thread.
struct Crew<'q, B: Bundle, F: InLanes, const D: usize> {
    field: F::Field<B>,
    queue: &'q Queue<'q, F, D>,
    riding: [usize; MOST_LANES],
    escape: B,
}

impl<B: Bundle, F: InLanes, const D: usize> Members<B, D> for Crew<'_, B, F, D> {
    type Field = F::Field<B>;

    #[inline(always)]
    fn field(&self) -> &Self::Field {
        &self.field
    }

    #[inline(always)]
    fn enter(&mut self, lane: usize) -> Option<Entry<D>> {
        let index = self.queue.next.fetch_add(1, Ordering::Relaxed);
        let member = self.queue.members.get(index)?;
        self.riding[lane] = index;
        member.field.put(lane, &mut self.field);
        Some(Entry { t: 0.0, u: member.start, t_end: member.t_end, pace: None })
    }

    /// Lanes beyond the escape norm.
    #[inline(always)]
    fn outside(&mut self, u: &[B; D]) -> Mask {
        let mut norm = B::splat(0.0);
        for i in 0..D {
            norm = u[i].mul_add(u[i], norm);
        }
        self.escape.less(norm)
    }

    fn leave(&mut self, lane: usize, leaving: &Leaving<D>) -> Turn {
        if leaving.why == Why::Arrived {
            let Leaving { t, u, steps, rejected, .. } = *leaving;
            let end = End { outcome: Outcome::Completed { t }, u, steps, rejected };
            let mut ends = self.queue.ends.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            ends[self.riding[lane]] = Some(end);
        }
        Turn::Done
    }
}
