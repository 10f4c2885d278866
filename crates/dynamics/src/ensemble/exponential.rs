//! Stiff members from start to end: exponential methods with a fixed step, each lane with its own linear part.
//!
//! A lane has its own coefficients (functions of `h lambda`), so a table holds one bundle where a single orbit's has one
//! number. Real and imaginary parts share theirs ([`StiffInLanes::COMPLEX`]). The length of the state is known when the
//! program runs: all room is made once per thread.

use super::clock::Clock;
use super::lane_table::LaneTable;
use crate::drive::drive;
use crate::orbit::check_start;
use crate::scalar::MOST_LANES;
use crate::simd::{InstructionSet, LaneKernel, run_lanes_on};
use crate::steppers::ExponentialTableau;
use crate::steppers::exponential::Node;
use crate::{
    Bundle, Error, ExponentialOrbit, Integration as _, Mask, Outcome, Request, Semilinear, StepControl,
};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// A field `u' = Lambda u + N(t, u)` of one orbit that has a form over lanes, each lane with its own parameters.
///
/// Not for fields that correct the ends of steps ([`crate::System::project`]).
pub trait StiffInLanes: Semilinear<f64> + Sync {
    /// The nonlinear part of a bundle, with the room it needs.
    type Lanes<B: Bundle>: StiffLanes<B>;

    /// Whether the state is complex numbers, two entries each, that share their entry of `Lambda`.
    const COMPLEX: bool = false;

    /// A bundle with this field in every lane.
    fn lanes<B: Bundle>(&self) -> Self::Lanes<B>;

    /// Puts this field into one lane; it must be of the bundle's dimension.
    fn put<B: Bundle>(&self, lane: usize, lanes: &mut Self::Lanes<B>);
}

/// The nonlinear part of the fields of a bundle.
pub trait StiffLanes<B: Bundle> {
    /// Writes `N(t, u)` into `du`. Must be `#[inline(always)]`.
    fn nonlinear(&mut self, t: B, u: &[B], du: &mut [B]);
}

/// One initial-value problem of a stiff ensemble.
#[derive(Clone, Debug)]
pub struct StiffMember<F> {
    /// Its field.
    pub field: F,
    /// State at time 0.
    pub start: Vec<f64>,
    /// End of the time span, not before 0.
    pub t_end: f64,
}

/// Where a member ended.
#[derive(Clone, Debug, PartialEq)]
pub struct StiffEnd {
    /// How.
    pub outcome: Outcome,
    /// Last state.
    pub u: Vec<f64>,
    /// Steps made.
    pub steps: u64,
}

/// How a stiff ensemble is run.
#[derive(Clone, Copy, Debug)]
pub struct StiffPropagation {
    /// The method.
    pub method: &'static ExponentialTableau,
    /// Its step (the last one of a member may be shorter).
    pub step: f64,
    /// Instructions to use, if this machine has them.
    pub instructions: InstructionSet,
    /// A state beyond this norm has escaped.
    pub escape_norm: f64,
    /// Threads to use.
    pub threads: usize,
}

/// Runs every member to its end, over `threads` threads, each with as many at a time as there are lanes.
///
/// The ends do not depend on threads or instruction set, and are those of [`ExponentialOrbit`] to the last bit.
///
/// # Errors
/// [`Error::OutOfRange`] for a step or a start that makes no sense, [`Error::Shape`] if the members differ in dimension.
pub fn propagate_stiff<F: StiffInLanes>(
    members: &[StiffMember<F>],
    how: &StiffPropagation,
) -> Result<Vec<StiffEnd>, Error> {
    how.control().validate_for(how.method.name, false)?;
    let Some(first) = members.first() else { return Ok(Vec::new()) };
    for member in members {
        check_start(first.field.dim(), 0.0, &member.start)?;
        check_start(member.field.dim(), member.t_end, &member.start)?;
    }
    let queue = Queue { members, next: AtomicUsize::new(0), ends: Mutex::new(vec![None; members.len()]) };
    let work = || run_lanes_on(how.instructions, Run { queue: &queue, how });
    std::thread::scope(|scope| {
        for _ in 1..how.threads.min(members.len() / 8) {
            scope.spawn(work);
        }
        work();
    });
    let ends = queue.ends.into_inner().unwrap_or_else(PoisonError::into_inner);
    members.iter().zip(ends).map(|(member, end)| end.map_or_else(|| alone(member, how), Ok)).collect()
}

impl StiffPropagation {
    fn control(&self) -> StepControl {
        StepControl::Fixed { step: self.step }
    }
}

/// A member as a single orbit: what a lane leaves open, how exactly a run failed, is said here.
fn alone<F: StiffInLanes>(member: &StiffMember<F>, how: &StiffPropagation) -> Result<StiffEnd, Error> {
    let mut orbit = ExponentialOrbit::new(&member.field, how.method, how.control(), 0.0, &member.start)?;
    let request =
        Request { escape_norm: how.escape_norm, ..Request::until(member.t_end, member.start.len()) };
    let outcome = drive(&mut orbit, &request, &mut ())?;
    Ok(StiffEnd { outcome, u: orbit.state().to_vec(), steps: orbit.counters().steps })
}

/// What the threads share.
struct Queue<'m, F> {
    members: &'m [StiffMember<F>],
    next: AtomicUsize,
    ends: Mutex<Vec<Option<StiffEnd>>>,
}

impl<F: StiffInLanes> Queue<'_, F> {
    /// Notes the end of a member, unless a single orbit has to say what is wrong with it.
    fn arrived(&self, index: usize, u: Vec<f64>, clock: &Clock) {
        let mut slope = vec![0.0; u.len()];
        self.members[index].field.eval(clock.t, &u, &mut slope);
        if slope.iter().all(|x| x.is_finite()) {
            let end = StiffEnd { outcome: Outcome::Completed { t: clock.t }, u, steps: clock.steps };
            self.ends.lock().unwrap_or_else(PoisonError::into_inner)[index] = Some(end);
        }
    }
}

/// The work of one thread.
struct Run<'q, F> {
    queue: &'q Queue<'q, F>,
    how: &'q StiffPropagation,
}

impl<F: StiffInLanes> LaneKernel for Run<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run<B: Bundle>(self) {
        let Some(first) = self.queue.members.first() else { return };
        let mut crew = Crew {
            queue: self.queue,
            how: self.how,
            riding: [0; MOST_LANES],
            clocks: [Clock::default(); MOST_LANES],
            active: Mask::default(),
            lambda: vec![0.0; first.field.dim()],
            lanes: Lanes::<B, F>::new(&first.field, self.how.method),
        };
        crew.fill(Mask::first(B::LANES));
        while crew.active.any() {
            crew.advance();
        }
    }
}

/// The members in the lanes of one thread.
struct Crew<'q, B: Bundle, F: StiffInLanes> {
    queue: &'q Queue<'q, F>,
    how: &'q StiffPropagation,
    riding: [usize; MOST_LANES],
    clocks: [Clock; MOST_LANES],
    active: Mask,
    lambda: Vec<f64>,
    lanes: Lanes<B, F>,
}

impl<B: Bundle, F: StiffInLanes> Crew<'_, B, F> {
    /// One step in every lane, shorter where the end is near.
    #[inline(always)]
    fn advance(&mut self) {
        let step = self.how.step;
        let (mut t, mut h) = ([0.0; MOST_LANES], [step; MOST_LANES]);
        let mut arrived = Mask::default();
        for lane in 0..B::LANES {
            let clock = &mut self.clocks[lane];
            if !self.active.has(lane) {
                continue;
            }
            t[lane] = clock.t;
            h[lane] = clock.step(step);
            if clock.t >= clock.t_end {
                arrived |= Mask::only(lane);
            }
            if h[lane] != step {
                self.set_size(lane, h[lane]);
            }
        }
        self.lanes.step(self.how.method, B::load(&t), B::load(&h));
        let leaving = (arrived | !self.lanes.within(self.how.escape_norm)) & self.active;
        if leaving.any() {
            self.leave(leaving);
        }
    }

    /// Ends the members in the lanes of `leaving` and fills these anew.
    #[inline(always)]
    fn leave(&mut self, leaving: Mask) {
        let within = self.lanes.within(self.how.escape_norm);
        for lane in leaving.lanes() {
            let u = self.lanes.u.iter().map(|x| x.lane(lane)).collect();
            if within.has(lane) {
                self.queue.arrived(self.riding[lane], u, &self.clocks[lane]);
            }
        }
        self.active &= !leaving;
        self.fill(leaving);
    }

    /// Gives the lanes of `vacant` to the next members.
    #[inline(always)]
    fn fill(&mut self, vacant: Mask) {
        for lane in vacant.lanes() {
            // A member without a time span is no work for a lane.
            let member = loop {
                let index = self.queue.next.fetch_add(1, Ordering::Relaxed);
                let Some(member) = self.queue.members.get(index) else { return };
                self.riding[lane] = index;
                if member.t_end > 0.0 {
                    break member;
                }
            };
            self.clocks[lane] = Clock::new(0.0, member.t_end);
            self.active |= Mask::only(lane);
            self.lanes.place(lane, member);
            self.set_size(lane, self.how.step);
        }
    }

    /// Computes the coefficients of one lane for step size `h`.
    #[inline(always)]
    fn set_size(&mut self, lane: usize, h: f64) {
        self.queue.members[self.riding[lane]].field.linear(&mut self.lambda);
        self.lanes.table.fill(lane, self.how.method, &self.lambda, h);
    }
}

/// The states of a bundle and what a step needs.
struct Lanes<B: Bundle, F: StiffInLanes> {
    field: F::Lanes<B>,
    u: Vec<B>,
    argument: Vec<B>,
    /// `N_i`, stage after stage.
    stages: Vec<B>,
    table: LaneTable<B>,
    /// Time of the state as stage 0 knows it: that of the last step's end stage.
    t: B,
    /// Lanes whose member is new: their stage 0 is at the step's start.
    fresh: Mask,
}

impl<B: Bundle, F: StiffInLanes> Lanes<B, F> {
    #[inline(always)]
    fn new(field: &F, method: &ExponentialTableau) -> Self {
        let (zero, dim) = (B::splat(0.0), field.dim());
        Self {
            field: field.lanes(),
            u: vec![zero; dim],
            argument: vec![zero; dim],
            stages: vec![zero; method.stages() * dim],
            table: LaneTable::new(method, dim, if F::COMPLEX { 2 } else { 1 }),
            t: zero,
            fresh: Mask::default(),
        }
    }

    #[inline(always)]
    fn place(&mut self, lane: usize, member: &StiffMember<F>) {
        member.field.put(lane, &mut self.field);
        for (x, &start) in self.u.iter_mut().zip(&member.start) {
            *x = x.with_lane(lane, start);
        }
        self.fresh |= Mask::only(lane);
    }

    /// Lanes whose norm is below `bound` beyond doubt.
    #[inline(always)]
    fn within(&self, bound: f64) -> Mask {
        let mut norm = B::splat(0.0);
        for &x in &self.u {
            norm = x.mul_add(x, norm);
        }
        norm.at_most(B::splat(bound * bound * (1.0 - 1e-12)))
    }

    /// One step of size `h` from time `t`: see [`crate::steppers::exponential`].
    #[inline(always)]
    fn step(&mut self, method: &ExponentialTableau, t: B, h: B) {
        let dim = self.u.len();
        let start = B::select(self.fresh, t, self.t);
        self.fresh = Mask::default();
        self.t = t + h;
        let mut row = 0;
        // One place where N is evaluated: it is inlined, and long.
        for stage in 0..method.stages() {
            let (mut time, mut argument) = (start, &self.u);
            if stage > 0 {
                let (node, terms) = method.rows[stage - 1];
                self.table.combine((node, row, terms), (&self.u, &self.stages), &mut self.argument);
                row += terms.len();
                (time, argument) = (if node == Node::Full { self.t } else { t + h * 0.5 }, &self.argument);
            }
            let slope = &mut self.stages[stage * dim..(stage + 1) * dim];
            self.field.nonlinear(time, argument, slope);
        }
        self.table.combine((Node::Full, row, method.weights), (&self.u, &self.stages), &mut self.argument);
        std::mem::swap(&mut self.u, &mut self.argument);
    }
}
