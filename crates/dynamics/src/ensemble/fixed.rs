//! Fixed steps in lanes.

use super::clock::Clock;
use super::lane::{Entry, Leaving, Members, Pace, Stepped, Turn, Why};
use crate::scalar::MOST_LANES;
use crate::steppers::unrolled::{LaneStep, Method, StepSlopes};
use crate::{Bundle, Mask, VectorField as _};
use std::marker::PhantomData;

/// Steps between looks at the clock: a lane that fails wastes this many at most.
const CHUNK: u64 = 64;

/// Runs all members with steps of size `step` of the method `M` (the last of a member may be shorter).
///
/// Call it in a [`crate::simd::LaneKernel`]. Nothing is allocated.
#[inline(always)]
pub fn run_fixed<M: Method, B: Bundle, const D: usize, C: Members<B, D>>(members: &mut C, step: f64) {
    let zero = B::splat(0.0);
    let mut lanes =
        Lanes::<B, D> { u: [zero; D], clocks: [Clock::default(); MOST_LANES], active: Mask::default() };
    lanes.fill(members, Mask::first(B::LANES));
    let mut slopes = StepSlopes::zero();
    while lanes.active.any() {
        lanes.advance::<M, C>(members, step, &mut slopes);
    }
}

/// The state of the bundle between steps.
struct Lanes<B, const D: usize> {
    u: [B; D],
    clocks: [Clock; MOST_LANES],
    active: Mask,
}

impl<B: Bundle, const D: usize> Lanes<B, D> {
    /// As many whole steps as no lane's end is near, or else one step that ends where each lane must.
    #[inline(always)]
    fn advance<M: Method, C: Members<B, D>>(
        &mut self,
        members: &mut C,
        step: f64,
        slopes: &mut StepSlopes<B, D>,
    ) {
        let mut chunk = CHUNK;
        for lane in self.active.lanes() {
            chunk = chunk.min(self.clocks[lane].whole_steps(step, CHUNK));
        }
        let called = self.steps::<M, C>(members, step, chunk, slopes);
        let called = called | members.outside(&self.u);
        let mut finite = Mask::first(B::LANES);
        for i in 0..D {
            finite &= self.u[i].finite();
        }
        let mut vacant = Mask::default();
        for lane in self.active.lanes() {
            let clock = &mut self.clocks[lane];
            let why = match (finite.has(lane), called.has(lane), clock.t >= clock.t_end) {
                (false, ..) => Why::Failed,
                (_, true, _) => Why::Called,
                (.., true) => Why::Arrived,
                _ => continue,
            };
            let mut u = [0.0; D];
            for i in 0..D {
                u[i] = self.u[i].lane(lane);
            }
            let leaving = Leaving {
                why,
                t: clock.t,
                u,
                pace: Pace { h: step, previous: 0.0 },
                steps: clock.steps,
                rejected: 0,
            };
            match members.leave(lane, &leaving) {
                Turn::Done => vacant |= Mask::only(lane),
                Turn::On(t_end) => self.clocks[lane].t_end = t_end,
            }
        }
        if vacant.any() {
            self.active &= !vacant;
            self.fill(members, vacant);
        }
    }

    /// `chunk` whole steps in every lane; for 0 one step, shorter where the end is near.
    #[inline(always)]
    fn steps<M: Method, C: Members<B, D>>(
        &mut self,
        members: &mut C,
        step: f64,
        chunk: u64,
        slopes: &mut StepSlopes<B, D>,
    ) -> Mask {
        let [start, end, h] = self.next_step(step, chunk);
        let last = if chunk == 0 { Mask::first(B::LANES) } else { Mask::default() };
        let mut called = Mask::default();
        for count in 0..chunk.max(1) {
            let t = start + h * count as f64;
            let t_new = B::select(last, end, start + h * (count + 1) as f64);
            called |= self.step::<M, C>(members, (t, t_new, h), slopes);
        }
        for lane in self.active.lanes() {
            let clock = &mut self.clocks[lane];
            if chunk == 0 {
                clock.step(step);
            } else {
                clock.jump(step, chunk);
            }
        }
        called
    }

    /// Start, end and size of each lane's next step: a whole one if there is a `chunk` of them.
    #[inline(always)]
    fn next_step(&self, step: f64, chunk: u64) -> [B; 3] {
        let mut out = [[0.0; MOST_LANES]; 3];
        for lane in self.active.lanes() {
            let clock = &self.clocks[lane];
            let (t_new, h) = match chunk {
                0 => clock.next(step),
                _ => (clock.t, step),
            };
            (out[0][lane], out[1][lane], out[2][lane]) = (clock.t, t_new, h);
        }
        [B::load(&out[0]), B::load(&out[1]), B::load(&out[2])]
    }

    /// One step of the method.
    #[inline(always)]
    fn step<M: Method, C: Members<B, D>>(
        &mut self,
        members: &mut C,
        (t_old, t, h): (B, B, B),
        slopes: &mut StepSlopes<B, D>,
    ) -> Mask {
        let u_old = self.u;
        members.field().eval(t_old, &u_old, &mut slopes.k[0]);
        slopes.step::<M, _>(members.field(), &LaneStep { t: t_old, h, u: &u_old });
        self.u = *slopes.arrival();
        if !C::WATCHES {
            return Mask::default();
        }
        slopes.end::<M, _>(members.field(), t);
        let (accepted, u, end) = (self.active, &self.u, const { M::TABLEAU.stages() });
        members.stepped(&mut Stepped {
            accepted,
            t,
            t_old,
            h,
            u,
            u_old: &u_old,
            slopes,
            end,
            field: PhantomData,
        })
    }

    #[inline(always)]
    fn place(&mut self, lane: usize, u: &[f64; D]) {
        for i in 0..D {
            self.u[i] = self.u[i].with_lane(lane, u[i]);
        }
    }

    #[inline(always)]
    fn fill<C: Members<B, D>>(&mut self, members: &mut C, vacant: Mask) {
        for lane in vacant.lanes() {
            let Some(Entry { t, u, t_end, .. }) = members.enter(lane) else { continue };
            self.clocks[lane] = Clock::new(t, t_end);
            self.place(lane, &u);
            self.active |= Mask::only(lane);
        }
    }
}
