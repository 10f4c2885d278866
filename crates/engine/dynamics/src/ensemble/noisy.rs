//! Members under noise, from their starts to one end, in lanes.

use super::extent::Extent;
use super::lane::{AfterStep, Stepped};
use super::noisy_track::Track;
use super::propagate::InLanes;
use super::{Entry, LaneTask, Leaving, Then, Why, run_adaptive};
use crate::control::Tolerance;
use crate::noise_steps::NoiseSteps;
use crate::scalar::MOST_LANES;
use crate::simd::{InstructionSet, LaneKernel, run_wide_on};
use crate::steppers::unrolled::{Dop853, LaneStep, StepSlopes};
use crate::{Bundle, Mask, Watch};

/// One member under noise.
pub struct NoisyMember<F, const D: usize> {
    /// The key that is returned with its states.
    pub key: usize,
    /// The field of its shape.
    pub field: F,
    /// State at the start.
    pub start: [f64; D],
    /// Its noise, from the start on.
    pub noise: NoiseSteps,
}

/// The settings of a run of members under noise: the flow by DOP853 with error control.
#[derive(Clone, Copy, Debug)]
pub struct NoisySpan {
    /// Start and end.
    pub times: (f64, f64),
    /// Time between rows, the first one at the start; `None` for no rows. Not used where the extent has none ([`Extent::ROWS`]).
    pub every: Option<f64>,
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance.
    pub atol: f64,
    /// A shape beyond this norm has escaped.
    pub escape_norm: f64,
    /// Most steps (accepted and rejected).
    pub max_steps: u64,
    /// The instructions; narrower ones give the same bits.
    pub set: InstructionSet,
}

/// The states of a member under noise.
pub struct NoisyTrack<const D: usize> {
    /// Its rows.
    pub rows: Vec<[f64; D]>,
    /// Its state at the end.
    pub last: [f64; D],
}

/// Provides members, and receives their states.
pub struct NoisyQueue<'q, F, const D: usize> {
    /// The next member; `None` if there is none.
    pub next: &'q mut dyn FnMut() -> Option<NoisyMember<F, D>>,
    /// The states of a member with its key; `None` if a single orbit has to determine what happened.
    pub done: &'q mut dyn FnMut(usize, Option<NoisyTrack<D>>),
    /// May stop the work; members in progress are dropped.
    pub watch: &'q dyn Watch,
}

/// Runs the members in lanes on this thread; `false`, without any work, on a machine without lanes. The states are those of
/// [`crate::NoisyOrbit`] over [`crate::Orbit`] driven from the start to the end, to the last bit, on every
/// instruction set: the flow is computed in lanes, the noise lane by lane. A step does not allocate.
///
/// # Checked by  tests/all/noisy_lanes.rs of `kernels`: the bits of single orbits, for every instruction set
pub fn propagate_noisy<F: InLanes, E: Extent, const D: usize>(
    span: &NoisySpan,
    queue: NoisyQueue<'_, F, D>,
) -> bool {
    let kernel = NoisyKernel::<'_, '_, F, E, D> { span, queue, extent: std::marker::PhantomData };
    run_wide_on(span.set, kernel).is_some()
}

struct NoisyKernel<'s, 'q, F, E, const D: usize> {
    span: &'s NoisySpan,
    queue: NoisyQueue<'q, F, D>,
    extent: std::marker::PhantomData<E>,
}

impl<F: InLanes, E: Extent, const D: usize> LaneKernel for NoisyKernel<'_, '_, F, E, D> {
    type Output = ();
    const WIDE: bool = false; // most of the time goes into the noise, which is not in lanes

    #[inline(always)]
    fn run<B: Bundle>(self) {
        let NoisyKernel { span, queue, .. } = self;
        let Some(first) = (queue.next)() else { return };
        let mut lanes = NoisyLanes::<B, F, E, D> {
            field: E::field::<F, B>(first.field.bundle()),
            span,
            queue,
            first: Some(first),
            tracks: [const { None }; MOST_LANES],
            restep: StepSlopes::zero(),
            over: Mask::default(),
            steps: 0,
        };
        run_adaptive::<Dop853, B, D, _>(&mut lanes, Tolerance { rtol: span.rtol, atol: span.atol });
    }
}

/// The members in the lanes of this thread.
struct NoisyLanes<'s, 'q, B: Bundle, F: InLanes, E: Extent, const D: usize> {
    field: E::Field<F, B>,
    span: &'s NoisySpan,
    queue: NoisyQueue<'q, F, D>,
    first: Option<NoisyMember<F, D>>,
    tracks: [Option<Track<D>>; MOST_LANES],
    restep: StepSlopes<B, D>,
    /// Lanes that have used up their steps.
    over: Mask,
    steps: u32,
}

/// The state of one lane.
#[inline(always)]
fn lane_of<B: Bundle, const D: usize>(u: &[B; D], lane: usize) -> [f64; D] {
    let mut one = [0.0; D];
    for i in 0..D {
        one[i] = u[i].lane(lane);
    }
    one
}

impl<B: Bundle, F: InLanes, E: Extent, const D: usize> NoisyLanes<'_, '_, B, F, E, D> {
    /// The rows inside the step just made, by steps of the method from its start, in all lanes that have one at once.
    #[inline(always)]
    fn rows_inside(&mut self, step: &Stepped<'_, B, D, E::Field<F, B>>) {
        loop {
            let (mut inside, mut sizes) = (Mask::default(), [0.0; MOST_LANES]);
            for lane in step.accepted.lanes() {
                let (end, Some(track)) = (step.t.lane(lane), &self.tracks[lane]) else { continue };
                let Some(t) = track.next_row(self.span, end) else { continue };
                if t < end {
                    inside |= Mask::only(lane);
                    sizes[lane] = t - step.t_old.lane(lane);
                }
            }
            if !inside.any() {
                return;
            }
            self.restep.k[0] = step.slopes.k[0];
            let at = LaneStep { t: step.t_old, h: B::load(&sizes), u: step.u_old };
            self.restep.step::<Dop853, _>(&self.field, &at);
            for lane in inside.lanes() {
                let (end, mut state) = (step.t.lane(lane), lane_of(self.restep.arrival(), lane));
                let Some(track) = &mut self.tracks[lane] else { continue };
                if let Some(t) = track.next_row(self.span, end) {
                    track.noise.add(t, &mut state);
                    track.record(state);
                }
            }
        }
    }
}

impl<B: Bundle, F: InLanes, E: Extent, const D: usize> LaneTask<B, D> for NoisyLanes<'_, '_, B, F, E, D> {
    type Field = E::Field<F, B>;
    const WATCHES: bool = true;
    const AFTER_STEP: bool = true;
    const AT_ENTRY: bool = true;

    #[inline(always)]
    fn field(&self) -> &Self::Field {
        &self.field
    }

    fn enter(&mut self, lane: usize) -> Option<Entry<D>> {
        let (t, t_end) = self.span.times;
        loop {
            let member = if self.queue.watch.stopped() {
                None
            } else {
                self.first.take().or_else(|| (self.queue.next)())
            };
            let member = member?;
            if t >= t_end {
                let NoisyMember { key, start, .. } = member;
                (self.queue.done)(key, Some(NoisyTrack { rows: vec![start], last: start }));
                continue;
            }
            member.field.put(lane, E::shape::<F, B>(&mut self.field));
            let u = member.start;
            self.tracks[lane] = Some(Track::new(member, self.span));
            self.over &= !Mask::only(lane);
            return Some(Entry { t, u, t_end, pace: None });
        }
    }

    #[inline(always)]
    fn stepped(&mut self, step: &mut Stepped<'_, B, D, Self::Field>) -> Mask {
        if E::ROWS {
            self.rows_inside(step);
        }
        let mut escaped = Mask::default();
        for lane in step.accepted.lanes() {
            let (end, flow) = (step.t.lane(lane), lane_of(step.u, lane));
            let Some(track) = &mut self.tracks[lane] else { continue };
            if !track.land(self.span, end, flow, D - E::POSITION) {
                escaped |= Mask::only(lane);
            }
        }
        escaped
    }

    /// Lanes without steps left; all if the work is to stop.
    #[inline(always)]
    fn outside(&mut self, _u: &[B; D]) -> Mask {
        self.steps = self.steps.wrapping_add(1);
        let stop = self.steps.is_multiple_of(1024) && self.queue.watch.stopped();
        if stop { Mask::first(B::LANES) } else { self.over }
    }

    /// Lanes at the end of a step of the noise begin the next one.
    #[inline(always)]
    fn after_step(&mut self, landed: &mut AfterStep<'_, B, D>) -> Mask {
        let mut changed = Mask::default();
        for lane in landed.accepted.lanes() {
            let (t, t_end) = (landed.t.lane(lane), self.span.times.1);
            let Some(track) = self.tracks[lane].as_mut().filter(|_| t < t_end) else { continue };
            if landed.steps.lane(lane) + landed.rejected.lane(lane) >= self.span.max_steps as f64 {
                self.over |= Mask::only(lane);
            }
            if t >= track.noise.end() {
                track.noise.begin(&mut track.path);
                for i in 0..D {
                    landed.u[i] = landed.u[i].with_lane(lane, track.path[i]);
                }
                *landed.t_end = landed.t_end.with_lane(lane, t_end.min(track.noise.end()));
                changed |= Mask::only(lane);
            }
        }
        changed
    }

    fn leave(&mut self, lane: usize, leaving: &Leaving<D>) -> Then {
        let Some(track) = self.tracks[lane].take() else { return Then::Leave };
        if leaving.why == Why::Arrived {
            (self.queue.done)(track.key, Some(NoisyTrack { rows: track.rows, last: track.path }));
        } else if !self.queue.watch.stopped() {
            (self.queue.done)(track.key, None);
        }
        Then::Leave
    }
}
