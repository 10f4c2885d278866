//! Error control in lanes: each lane accepts, repeats and sizes its own steps.

use super::lane::{AfterStep, Entry, LaneTask, Leaving, Pace, Stepped, Then, Why};
use crate::control::{Controller, Layout, Tolerance, pair_error};
use crate::scalar::MOST_LANES;
use crate::simd::Kernel;
use crate::steppers::tableau::ErrorEstimate;
use crate::steppers::unrolled::{LaneStep, Method, StepSlopes};
use crate::{Bundle, Mask, VectorField as _};
use std::marker::PhantomData;

/// Runs all members with the adaptive method `M`.
///
/// Call it in a [`crate::simd::LaneKernel`]. It does not allocate.
#[inline(always)]
pub fn run_adaptive<M: Method, B: Bundle, const D: usize, C: LaneTask<B, D>>(
    members: &mut C,
    tolerance: Tolerance,
) {
    let mut lanes = Lanes::<B, D>::new::<M>(tolerance);
    let mut slopes = StepSlopes::zero();
    loop {
        if lanes.vacant.any() {
            B::apart(Fill::<M, B, C, D> {
                lanes: &mut lanes,
                members,
                slopes: &mut slopes,
                method: PhantomData,
            });
        }
        if !lanes.active.any() {
            return;
        }
        lanes.advance::<M, C>(members, &mut slopes);
    }
}

/// Lanes to be filled, see [`Lanes::fill`]: rare, so a function of its own.
struct Fill<'l, M, B, C, const D: usize> {
    lanes: &'l mut Lanes<B, D>,
    members: &'l mut C,
    slopes: &'l mut StepSlopes<B, D>,
    method: PhantomData<M>,
}

impl<M: Method, B: Bundle, C: LaneTask<B, D>, const D: usize> Kernel for Fill<'_, M, B, C, D> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.lanes.fill::<M, C>(self.members, self.slopes);
    }
}

/// Lanes that have stopped, see [`Lanes::stop`]: rare, so a function of its own.
struct Stop<'l, B, C, const D: usize> {
    lanes: &'l mut Lanes<B, D>,
    members: &'l mut C,
    failed: Mask,
    called: Mask,
    arrived: Mask,
}

impl<B: Bundle, C: LaneTask<B, D>, const D: usize> Kernel for Stop<'_, B, C, D> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.lanes.stop::<C>(self.members, self.failed, self.called, self.arrived);
    }
}

/// The state of the bundle between steps; the slope there is the first one of the next step.
struct Lanes<B, const D: usize> {
    tolerance: Tolerance,
    active: Mask,
    /// Lanes to be filled with the next members.
    vacant: Mask,
    t: B,
    t_end: B,
    h: B,
    u: [B; D],
    controller: Controller<B>,
    steps: B,
    rejected: B,
}

impl<B: Bundle, const D: usize> Lanes<B, D> {
    #[inline(always)]
    fn new<M: Method>(tolerance: Tolerance) -> Self {
        let zero = B::splat(0.0);
        Self {
            tolerance,
            active: Mask::default(),
            vacant: Mask::first(B::LANES),
            t: zero,
            t_end: zero,
            h: zero,
            u: [zero; D],
            controller: Controller::new(M::TABLEAU),
            steps: zero,
            rejected: zero,
        }
    }

    /// Tries one step in every lane.
    #[inline(always)]
    fn advance<M: Method, C: LaneTask<B, D>>(&mut self, members: &mut C, slopes: &mut StepSlopes<B, D>) {
        let remaining = self.t_end - self.t;
        let last = remaining.at_most(self.h);
        // Two equal steps to the end rather than a full one and a crumb.
        let h = B::select(last, remaining, self.h.min(remaining * 0.5));
        let crumb = h.at_most(self.t.abs() * (16.0 * f64::EPSILON)) & !last;
        let failed = (crumb | h.less(B::splat(f64::MIN_POSITIVE))) & self.active;

        slopes.step::<M, _>(members.field(), &LaneStep { t: self.t, h, u: &self.u });
        let t_new = B::select(last, self.t_end, self.t + h);
        slopes.end::<M, _>(members.field(), t_new);
        let judgement = self.controller.judge(self.error::<M>(slopes, Layout::of(members.field()), h));
        let accepted = judgement.accepted & self.active & !failed;

        let next = h * judgement.factor;
        // A step cut short by the end says little about the next one.
        let after = B::select(last, self.h.max(next), next);
        self.h = B::select(judgement.accepted, after, next);
        let (t_old, u_old) = (self.t, self.u);
        self.t = B::select(accepted, t_new, self.t);
        let one = B::splat(1.0);
        self.steps += B::select(accepted, one, B::splat(0.0));
        self.rejected += B::select(accepted, B::splat(0.0), one);
        for i in 0..D {
            self.u[i] = B::select(accepted, slopes.arrival()[i], self.u[i]);
        }
        let mut called = members.outside(&self.u);
        if C::WATCHES {
            let (t, u, end) = (self.t, &self.u, const { M::TABLEAU.stages() });
            let mut step = Stepped { accepted, t, t_old, u, u_old: &u_old, slopes, end, field: PhantomData };
            called |= members.stepped(&mut step);
        }
        called &= self.active;
        for i in 0..D {
            slopes.k[0][i] = B::select(accepted, slopes.k[const { M::TABLEAU.stages() }][i], slopes.k[0][i]);
        }
        if C::AFTER_STEP {
            self.after_step::<C>(members, accepted & !called, &mut slopes.k[0]);
        }
        let arrived = self.t_end.at_most(self.t) & self.active;
        if (failed | called | arrived).any() {
            B::apart(Stop { lanes: self, members, failed, called, arrived });
        }
    }

    /// Lets the members change lanes that have accepted a step, or have entered.
    #[inline(always)]
    fn after_step<C: LaneTask<B, D>>(&mut self, members: &mut C, accepted: Mask, rates: &mut [B; D]) {
        let changed = members.after_step(&mut AfterStep {
            accepted,
            t: self.t,
            t_end: &mut self.t_end,
            u: &mut self.u,
            rates,
            steps: self.steps,
            rejected: self.rejected,
        });
        if changed.any() {
            self.slopes_of::<C>(members, changed, rates);
        }
    }

    /// The squared error norm of a step.
    #[inline(always)]
    fn error<M: Method>(&self, slopes: &StepSlopes<B, D>, layout: Layout, h: B) -> B {
        let [first, third] = slopes.errors::<M>(self.tolerance, layout);
        match M::TABLEAU.error {
            ErrorEstimate::None => B::splat(0.0),
            ErrorEstimate::Embedded { .. } => h * h * first,
            ErrorEstimate::Pair { .. } => pair_error(h, first, third),
        }
    }

    /// Asks the members of the lanes that have stopped for their next action.
    #[inline(always)]
    fn stop<C: LaneTask<B, D>>(&mut self, members: &mut C, failed: Mask, called: Mask, arrived: Mask) {
        for lane in (failed | called | arrived).lanes() {
            let why = match (failed.has(lane), called.has(lane)) {
                (true, _) => Why::Failed,
                (_, true) => Why::Requested,
                _ => Why::Arrived,
            };
            match members.leave(lane, &self.leaving(lane, why)) {
                Then::Leave => self.vacant |= Mask::only(lane),
                Then::Continue(t_end) => self.t_end = self.t_end.with_lane(lane, t_end),
            }
        }
        self.active &= !self.vacant;
    }

    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts")]
    fn leaving(&self, lane: usize, why: Why) -> Leaving<D> {
        let mut u = [0.0; D];
        for i in 0..D {
            u[i] = self.u[i].lane(lane);
        }
        let (steps, rejected) = (self.steps.lane(lane) as u64, self.rejected.lane(lane) as u64);
        let pace = Pace { h: self.h.lane(lane), previous: self.controller.previous().lane(lane) };
        Leaving { why, t: self.t.lane(lane), u, pace, steps, rejected }
    }

    #[inline(always)]
    fn place(&mut self, lane: usize, u: &[f64; D]) {
        for i in 0..D {
            self.u[i] = self.u[i].with_lane(lane, u[i]);
        }
    }

    /// Evaluates the slopes of the lanes in `mask`.
    #[inline(always)]
    fn slopes_of<C: LaneTask<B, D>>(&self, members: &C, mask: Mask, rates: &mut [B; D]) {
        let mut slope = *rates;
        members.field().eval(self.t, &self.u, &mut slope);
        for i in 0..D {
            rates[i] = B::select(mask, slope[i], rates[i]);
        }
    }

    /// Fills the vacant lanes with the next members.
    #[inline(always)]
    fn fill<M: Method, C: LaneTask<B, D>>(&mut self, members: &mut C, slopes: &mut StepSlopes<B, D>) {
        let (mut entered, mut paces) = (Mask::default(), [None; MOST_LANES]);
        for lane in std::mem::take(&mut self.vacant).lanes() {
            let Some(Entry { t, u, t_end, pace }) = members.enter(lane) else { continue };
            entered |= Mask::only(lane);
            paces[lane] = pace;
            (self.t, self.t_end) = (self.t.with_lane(lane, t), self.t_end.with_lane(lane, t_end));
            self.place(lane, &u);
        }
        if !entered.any() {
            return;
        }
        self.active |= entered;
        self.controller.reset(entered);
        self.steps = B::select(entered, B::splat(0.0), self.steps);
        self.rejected = B::select(entered, B::splat(0.0), self.rejected);
        self.slopes_of::<C>(members, entered, &mut slopes.k[0]);
        let [slope, near, rate, ..] = &mut slopes.k;
        let (field, order) = (members.field(), M::TABLEAU.order);
        let h = self.tolerance.first_step(field, order, self.t, &self.u, slope, [near, rate]);
        self.h = B::select(entered, h, self.h);
        for lane in entered.lanes() {
            if let Some(Pace { h, previous }) = paces[lane] {
                self.h = self.h.with_lane(lane, h);
                self.controller.remember(lane, previous);
            }
        }
        if C::AT_ENTRY {
            self.after_step::<C>(members, entered, &mut slopes.k[0]);
        }
    }
}
