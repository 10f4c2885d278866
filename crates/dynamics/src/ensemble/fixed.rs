//! Fixed steps in lanes.

use super::lane::{Entry, Leaving, Members, Pace, Stepped, Turn, Why};
use crate::orbit::fixed_step;
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

/// Time of one lane: multiples of the step from an origin, as in [`crate::Orbit`].
#[derive(Clone, Copy, Default)]
struct Clock {
    t: f64,
    t_end: f64,
    origin: (f64, u64),
    steps: u64,
}

impl Clock {
    /// How many whole steps there are before the end, at most `most`.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count, and not above `most`"
    )]
    fn whole_steps(&self, step: f64, most: u64) -> u64 {
        let (start, count) = self.origin;
        let left = ((self.t_end - start) / step - count as f64).floor() - 1.0;
        if self.t != start + step * count as f64 { 0 } else { left.clamp(0.0, most as f64) as u64 }
    }

    fn at(&self, step: f64) -> f64 {
        self.origin.0 + step * self.origin.1 as f64
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
        let called = if chunk == 0 {
            self.one::<M, C>(members, step, slopes)
        } else {
            self.many::<M, C>(members, step, chunk, slopes)
        };
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
                Turn::Restart(t_end, u) => {
                    self.clocks[lane].t_end = t_end;
                    self.place(lane, &u);
                }
            }
        }
        if vacant.any() {
            self.active &= !vacant;
            self.fill(members, vacant);
        }
    }

    /// `chunk` whole steps in every lane.
    #[inline(always)]
    fn many<M: Method, C: Members<B, D>>(
        &mut self,
        members: &mut C,
        step: f64,
        chunk: u64,
        slopes: &mut StepSlopes<B, D>,
    ) -> Mask {
        let mut starts = [0.0; MOST_LANES];
        for (start, clock) in starts.iter_mut().zip(&self.clocks) {
            *start = clock.t;
        }
        let (start, h) = (B::load(&starts), B::splat(step));
        let mut called = Mask::default();
        for count in 0..chunk {
            let t = start + h * count as f64;
            called |= self.step::<M, C>(members, (t, start + h * (count + 1) as f64, h), slopes);
        }
        for lane in self.active.lanes() {
            let clock = &mut self.clocks[lane];
            clock.origin.1 += chunk;
            clock.steps += chunk;
            clock.t = clock.at(step);
        }
        called
    }

    /// One step in every lane, shorter where the end is near.
    #[inline(always)]
    fn one<M: Method, C: Members<B, D>>(
        &mut self,
        members: &mut C,
        step: f64,
        slopes: &mut StepSlopes<B, D>,
    ) -> Mask {
        let (mut t, mut t_new, mut h) = ([0.0; MOST_LANES], [0.0; MOST_LANES], [0.0; MOST_LANES]);
        for lane in self.active.lanes() {
            let clock = &mut self.clocks[lane];
            t[lane] = clock.t;
            (t_new[lane], h[lane]) = fixed_step(step, clock.t, clock.origin, clock.t_end);
            let (start, count) = clock.origin;
            clock.origin = if t_new[lane] == clock.t_end { (clock.t_end, 0) } else { (start, count + 1) };
            clock.t = t_new[lane];
            clock.steps += 1;
        }
        self.step::<M, C>(members, (B::load(&t), B::load(&t_new), B::load(&h)), slopes)
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
        self.u = slopes.step::<M, _>(members.field(), &LaneStep { t: t_old, h, u: &u_old });
        if !C::WATCHES {
            return Mask::default();
        }
        slopes.end::<M, _>(members.field(), t, &self.u);
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
            self.clocks[lane] = Clock { t, t_end, origin: (t, 0), steps: 0 };
            self.place(lane, &u);
            self.active |= Mask::only(lane);
        }
    }
}
