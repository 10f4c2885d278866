//! Exponents of many orbits, in lanes.

use super::frame::orthonormalise;
use super::protocol::{Protocol, Stretch};
use super::{Lyapunov, LyapunovSettings, first_state, lyapunov};
use crate::Result;
use crate::symmetry::speed_beside;
use motiform_dynamics::drive::Sink;
use motiform_dynamics::ensemble::{Entry, InLanes, Landed, Leaving, Members, Turn, Why, run_adaptive};
use motiform_dynamics::scalar::MOST_LANES;
use motiform_dynamics::simd::{LaneKernel, has_lanes, run_wide};
use motiform_dynamics::steppers::Method;
use motiform_dynamics::steppers::unrolled::Dop853;
use motiform_dynamics::{Bundle, Equivariant, Mask, Outcome, StepControl};
use std::ops::ControlFlow;

/// One orbit whose exponents are asked for.
#[derive(Clone, Debug)]
pub struct TangentMember<B, F, const N: usize> {
    /// What its exponents are handed back with.
    pub key: usize,
    /// The body.
    pub body: B,
    /// Its field.
    pub field: F,
    /// Its shape at the start.
    pub start: [f64; N],
    /// The averages asked for.
    pub settings: LyapunovSettings,
}

/// Whether exponents with these settings are computed in lanes: DOP853 with error control, on a machine that has them.
#[must_use]
pub fn runs_in_lanes(settings: &LyapunovSettings) -> bool {
    let Method::Explicit(tableau) = settings.method else { return false };
    has_lanes() && tableau.name == "dop853" && matches!(settings.control, StepControl::Adaptive { .. })
}

/// The `K` largest exponents of every member, each handed to `done` with its key:
/// the same bits as [`super::lyapunov()`] gives one by one. `D` must be `N (1 + K)`, the
/// members' settings must ask for `K` exponents with the same control, see [`runs_in_lanes`].
///
/// A member that escapes or fails is run again alone, which says how it ended. When `stopped` says so, the rest is left.
pub fn lyapunov_in_lanes<B, F, const N: usize, const K: usize, const D: usize>(
    control: (f64, f64),
    next: &mut dyn FnMut() -> Option<TangentMember<B, F, N>>,
    done: &mut dyn FnMut(usize, Result<Lyapunov>),
    stopped: &dyn Fn() -> bool,
) where
    B: AsRef<dyn Equivariant>,
    F: InLanes,
{
    let _ = run_wide(Run::<B, F, N, K, D> { control, next, done, stopped });
}

/// The work of one thread.
struct Run<'r, B, F, const N: usize, const K: usize, const D: usize> {
    control: (f64, f64),
    next: &'r mut dyn FnMut() -> Option<TangentMember<B, F, N>>,
    done: &'r mut dyn FnMut(usize, Result<Lyapunov>),
    stopped: &'r dyn Fn() -> bool,
}

impl<B: AsRef<dyn Equivariant>, F: InLanes, const N: usize, const K: usize, const D: usize> LaneKernel
    for Run<'_, B, F, N, K, D>
{
    type Output = ();

    #[inline(always)]
    fn run<L: Bundle>(self) {
        let Some(first) = (self.next)() else { return };
        let mut crew = Crew::<L, B, F, N, K, D> {
            field: F::tangent(first.field.bundle()),
            first: Some(first),
            escape: L::splat(0.0),
            stop: L::splat(0.0),
            riding: std::array::from_fn(|_| None),
            steps: 0,
            next: self.next,
            done: self.done,
            stopped: self.stopped,
        };
        run_adaptive::<Dop853, L, D, _>(&mut crew, self.control);
    }
}

/// A member in its lane.
struct Rider<B, F, const N: usize> {
    member: TangentMember<B, F, N>,
    protocol: Protocol,
}

/// The members in the lanes of one thread.
struct Crew<'r, L: Bundle, B, F: InLanes, const N: usize, const K: usize, const D: usize> {
    field: F::Tangent<L, K>,
    first: Option<TangentMember<B, F, N>>,
    escape: L,
    /// Ends of the stretches under way.
    stop: L,
    riding: [Option<Rider<B, F, N>>; 16],
    steps: u32,
    next: &'r mut dyn FnMut() -> Option<TangentMember<B, F, N>>,
    done: &'r mut dyn FnMut(usize, Result<Lyapunov>),
    stopped: &'r dyn Fn() -> bool,
}

impl<L: Bundle, B: AsRef<dyn Equivariant>, F: InLanes, const N: usize, const K: usize, const D: usize>
    Crew<'_, L, B, F, N, K, D>
{
    /// A member that its lane cannot finish, as a single orbit.
    fn alone(&mut self, rider: &Rider<B, F, N>) {
        let TangentMember { body, start, settings, .. } = &rider.member;
        let mut stop = Stop(self.stopped);
        (self.done)(rider.member.key, lyapunov(body.as_ref(), start, settings, &mut stop));
    }

    /// Tells the lanes in `due` what their vectors have grown to, and takes the ends of their next stretches. A lane that has
    /// none, or has spent its steps, is at its end.
    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts")]
    fn stretched(&mut self, due: Mask, landed: &mut Landed<'_, L, D>, lengths: &[L; K], speed: L) {
        let mut grown = [[0.0; MOST_LANES]; K];
        for (to, &from) in grown.iter_mut().zip(lengths) {
            from.store(to);
        }
        let [mut t, mut speeds, mut steps, mut work] = [[0.0; MOST_LANES]; 4];
        landed.t.store(&mut t);
        speed.store(&mut speeds);
        landed.steps.store(&mut steps);
        (landed.steps + landed.rejected).store(&mut work);
        let (mut stop, mut end) = (t, t);
        self.stop.store(&mut stop);
        landed.t_end.store(&mut end);
        for lane in due.lanes() {
            let Some(rider) = &mut self.riding[lane] else { continue };
            let lengths = grown.map(|lanes| lanes[lane]);
            let next = rider.protocol.stretched(t[lane], &lengths, speeds[lane], steps[lane] as u64);
            let next = next.filter(|_| (work[lane] as u64) < rider.member.settings.max_steps);
            (stop[lane], end[lane]) = next.map_or((t[lane], t[lane]), |next| (next.stop, next.limit));
        }
        self.stop = L::load(&stop);
        *landed.t_end = L::load(&end);
    }
}

impl<L: Bundle, B: AsRef<dyn Equivariant>, F: InLanes, const N: usize, const K: usize, const D: usize>
    Members<L, D> for Crew<'_, L, B, F, N, K, D>
{
    type Field = F::Tangent<L, K>;
    const LANDS: bool = true;

    #[inline(always)]
    fn field(&self) -> &Self::Field {
        &self.field
    }

    fn enter(&mut self, lane: usize) -> Option<Entry<D>> {
        loop {
            if (self.stopped)() {
                return None;
            }
            let member = self.first.take().or_else(|| (self.next)())?;
            let mut rider = Rider { protocol: Protocol::new(&member.settings, N), member };
            let Some(Stretch { stop, limit }) = rider.protocol.begin(0.0) else {
                self.alone(&rider);
                continue;
            };
            rider.member.field.put(lane, self.field.as_mut());
            let norm = rider.member.settings.escape_norm;
            self.escape = self.escape.with_lane(lane, norm * norm);
            let mut u = [0.0; D];
            u.copy_from_slice(&first_state(&rider.member.start, K));
            self.riding[lane] = Some(rider);
            self.stop = self.stop.with_lane(lane, stop);
            return Some(Entry { t: 0.0, u, t_end: limit, pace: None });
        }
    }

    /// Lanes whose shape is beyond the escape norm; all of them, now and then, where a stop was asked for.
    #[inline(always)]
    fn outside(&mut self, u: &[L; D]) -> Mask {
        self.steps = self.steps.wrapping_add(1);
        if self.steps.is_multiple_of(1024) && (self.stopped)() {
            return Mask::first(L::LANES);
        }
        let mut norm = L::splat(0.0);
        for i in 0..N {
            norm += u[i] * u[i];
        }
        self.escape.less(norm)
    }

    /// Lanes at the end of a stretch: their vectors are made orthonormal, all at once.
    #[inline(always)]
    fn landed(&mut self, landed: &mut Landed<'_, L, D>) -> Mask {
        let due = self.stop.at_most(landed.t) & landed.accepted;
        if !due.any() {
            return due;
        }
        let mut lengths = [L::splat(0.0); K];
        let lost = orthonormalise(due, N, &mut landed.u[N..], &mut landed.rates[N..], &mut lengths);
        let mut spin = [L::splat(0.0); N];
        F::spin(&landed.u[..N], &mut spin);
        let speed = speed_beside(&spin, &landed.rates[..N]);
        self.stretched(due, landed, &lengths, speed);
        lost
    }

    fn leave(&mut self, lane: usize, leaving: &Leaving<D>) -> Turn {
        let Some(rider) = self.riding[lane].take() else { return Turn::Done };
        if (self.stopped)() {
            return Turn::Done;
        }
        let work = leaving.steps + leaving.rejected;
        if leaving.why != Why::Arrived || work >= rider.member.settings.max_steps {
            self.alone(&rider);
            return Turn::Done;
        }
        let (body, outcome) = (rider.member.body.as_ref(), Outcome::Completed { t: leaving.t });
        let result = rider.protocol.result(body, &leaving.u[..N], outcome, leaving.steps);
        (self.done)(rider.member.key, result);
        Turn::Done
    }
}

/// Listens to `stopped`.
struct Stop<'s>(&'s dyn Fn() -> bool);

impl Sink for Stop<'_> {
    fn tick(&mut self, _t: f64) -> ControlFlow<()> {
        if (self.0)() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
