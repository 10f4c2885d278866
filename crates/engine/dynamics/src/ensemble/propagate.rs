//! Members from their starts to given times, in the plane.

use super::{Entry, LaneTask, Leaving, Then, Why, run_adaptive};
use crate::Watch;
use crate::control::Tolerance;
use crate::scalar::MOST_LANES;
use crate::simd::{InstructionSet, LaneKernel, run_wide_on};
use crate::steppers::unrolled::Dop853;
use crate::{Bundle, InPlane, Mask, Shape, VectorField};

/// A field of one orbit that has a form over lanes, each lane with its own parameters.
pub trait InLanes: VectorField<f64> + Sync {
    /// See [`LaneKernel::WIDE`].
    const WIDE: bool = true;

    /// The field of a bundle.
    type Field<B: Bundle>: Shape<B>;

    /// The tangent flow of a bundle, with `K` vectors.
    type Tangent<B: Bundle, const K: usize>: VectorField<B> + AsMut<Self::Field<B>>;

    /// The tangent flow of a field.
    fn tangent<B: Bundle, const K: usize>(field: Self::Field<B>) -> Self::Tangent<B, K>;

    /// The infinitesimal rotation of a shape ([`crate::Equivariant::spin`]).
    fn spin<B: Bundle>(field: &Self::Field<B>, shape: &[B], out: &mut [B]);

    /// A bundle with this field in every lane.
    fn bundle<B: Bundle>(&self) -> Self::Field<B>;

    /// Puts this field into one lane.
    fn put<B: Bundle>(&self, lane: usize, field: &mut Self::Field<B>);
}

/// One initial-value problem of an ensemble. The state is the shape, then the position: `D` numbers.
#[derive(Clone, Copy, Debug)]
pub struct Member<F, const D: usize> {
    /// The key that is returned with its states.
    pub key: usize,
    /// The field of its shape.
    pub field: F,
    /// State at time 0.
    pub start: [f64; D],
}

/// The settings of a run of an ensemble: DOP853 with error control.
#[derive(Clone, Copy, Debug)]
pub struct Propagation<'t> {
    /// Times at which the states are computed, increasing, the first one at least 0.
    pub times: &'t [f64],
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance.
    pub atol: f64,
    /// A shape beyond this norm has escaped.
    pub escape_norm: f64,
    /// The instructions; narrower ones give the same bits.
    pub set: InstructionSet,
}

/// Provides members, and receives their states.
pub struct Queue<'q, F, const D: usize> {
    /// The next member; `None` if there is none.
    pub next: &'q mut dyn FnMut() -> Option<Member<F, D>>,
    /// The states of a member at all times, with its key. `None` if a single orbit has to determine what
    /// happened: it escaped, or no further step is possible.
    pub done: &'q mut dyn FnMut(usize, Option<Vec<[f64; D]>>),
    /// May stop the work; members in progress are dropped.
    pub watch: &'q dyn Watch,
}

/// Runs the members in lanes on this thread, as many side by side as a register holds; `false`, without any work, on a machine
/// without lanes. The states are those of [`crate::Orbit`] over [`InPlane`] driven from one time to the next, to the last bit, on
/// every instruction set.
pub fn propagate<F: InLanes, const D: usize>(how: &Propagation<'_>, queue: Queue<'_, F, D>) -> bool {
    run_wide_on(how.set, PropagationKernel { how, queue }).is_some()
}

struct PropagationKernel<'h, 'q, F, const D: usize> {
    how: &'h Propagation<'h>,
    queue: Queue<'q, F, D>,
}

impl<F: InLanes, const D: usize> LaneKernel for PropagationKernel<'_, '_, F, D> {
    type Output = ();
    const WIDE: bool = F::WIDE;

    #[inline(always)]
    fn run<B: Bundle>(self) {
        let PropagationKernel { how, queue } = self;
        let Some(first) = (queue.next)() else { return };
        let mut lanes = LaneMembers::<B, F, D> {
            field: InPlane(first.field.bundle()),
            times: how.times,
            queue,
            first: Some(first),
            tracks: [const { None }; MOST_LANES],
            escape: B::splat(how.escape_norm * how.escape_norm),
            steps: 0,
        };
        run_adaptive::<Dop853, B, D, _>(&mut lanes, Tolerance { rtol: how.rtol, atol: how.atol });
    }
}

/// A member in its lane: its key, and its states so far.
struct Track<const D: usize> {
    key: usize,
    states: Vec<[f64; D]>,
}

/// The members in the lanes of this thread.
struct LaneMembers<'h, 'q, B: Bundle, F: InLanes, const D: usize> {
    field: InPlane<F::Field<B>>,
    times: &'h [f64],
    queue: Queue<'q, F, D>,
    first: Option<Member<F, D>>,
    tracks: [Option<Track<D>>; MOST_LANES],
    escape: B,
    steps: u32,
}

impl<B: Bundle, F: InLanes, const D: usize> LaneMembers<'_, '_, B, F, D> {
    /// The next member, unless the work is to stop.
    fn take(&mut self) -> Option<Member<F, D>> {
        if self.queue.watch.stopped() { None } else { self.first.take().or_else(|| (self.queue.next)()) }
    }
}

impl<B: Bundle, F: InLanes, const D: usize> LaneTask<B, D> for LaneMembers<'_, '_, B, F, D> {
    type Field = InPlane<F::Field<B>>;

    #[inline(always)]
    fn field(&self) -> &Self::Field {
        &self.field
    }

    fn enter(&mut self, lane: usize) -> Option<Entry<D>> {
        loop {
            let member = self.take()?;
            let mut states = Vec::with_capacity(self.times.len());
            states.extend(self.times.iter().take_while(|t| **t <= 0.0).map(|_| member.start));
            let Some(&t_end) = self.times.get(states.len()) else {
                (self.queue.done)(member.key, Some(states));
                continue;
            };
            member.field.put(lane, &mut self.field.0);
            self.tracks[lane] = Some(Track { key: member.key, states });
            return Some(Entry { t: 0.0, u: member.start, t_end, pace: None });
        }
    }

    /// Lanes whose shape is beyond the escape norm; all if the work is to stop.
    #[inline(always)]
    fn outside(&mut self, u: &[B; D]) -> Mask {
        self.steps = self.steps.wrapping_add(1);
        if self.steps.is_multiple_of(1024) && self.queue.watch.stopped() {
            return Mask::first(B::LANES);
        }
        let mut norm = B::splat(0.0);
        for i in 0..const { D - 2 } {
            norm = u[i].mul_add(u[i], norm);
        }
        self.escape.less(norm)
    }

    fn leave(&mut self, lane: usize, leaving: &Leaving<D>) -> Then {
        let Some(mut track) = self.tracks[lane].take() else { return Then::Leave };
        if leaving.why != Why::Arrived {
            if !self.queue.watch.stopped() {
                (self.queue.done)(track.key, None);
            }
            return Then::Leave;
        }
        track.states.push(leaving.u);
        if let Some(&t_end) = self.times.get(track.states.len()) {
            self.tracks[lane] = Some(track);
            return Then::Continue(t_end);
        }
        (self.queue.done)(track.key, Some(track.states));
        Then::Leave
    }
}
