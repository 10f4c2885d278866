//! Exponents of many orbits, in lanes.

use super::frame::orthonormalise;
use super::renormalisation::{Renormalisation, Stretch};
use super::{Lyapunov, LyapunovSettings, first_state, lyapunov};
use crate::Result;
use crate::symmetry::speed_beside;
use motiform_dynamics::ensemble::{AfterStep, Entry, InLanes, LaneTask, Leaving, Then, Why, run_adaptive};
use motiform_dynamics::scalar::MOST_LANES;
use motiform_dynamics::simd::{LaneKernel, has_lanes, run_wide};
use motiform_dynamics::steppers::Method;
use motiform_dynamics::steppers::unrolled::Dop853;
use motiform_dynamics::{Bundle, Equivariant, Mask, Outcome, StepControl, Tolerance, Watch};

/// One orbit whose exponents are asked for.
#[derive(Clone, Debug)]
pub struct TangentMember<B, F, const N: usize> {
    /// The key that its exponents are returned with.
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

/// Returns `true` if exponents with these settings are computed in lanes: DOP853 with error control, on a
/// machine that has them.
pub fn runs_in_lanes(settings: &LyapunovSettings) -> bool {
    let Method::Explicit(tableau) = settings.method else { return false };
    has_lanes() && tableau.name == "dop853" && matches!(settings.control, StepControl::Adaptive { .. })
}

/// The `K` largest exponents of every member, each handed to `done` with its key:
/// the same bits as [`super::lyapunov()`] gives one by one. `D` must be `N (1 + K)`, the
/// members' settings must ask for `K` exponents with the same control, see [`runs_in_lanes`].
///
/// A member that escapes, fails or loses the direction of a vector is run again alone. When `watch` stops it, the rest is left.
pub fn lyapunov_in_lanes<B, F, const N: usize, const K: usize, const D: usize>(
    tolerance: Tolerance,
    next: &mut dyn FnMut() -> Option<TangentMember<B, F, N>>,
    done: &mut dyn FnMut(usize, Result<Lyapunov>),
    watch: &dyn Watch,
) where
    B: AsRef<dyn Equivariant>,
    F: InLanes,
{
    let _ = run_wide(ExponentKernel::<B, F, N, K, D> { tolerance, next, done, watch });
}

/// The work of one thread.
struct ExponentKernel<'r, B, F, const N: usize, const K: usize, const D: usize> {
    tolerance: Tolerance,
    next: &'r mut dyn FnMut() -> Option<TangentMember<B, F, N>>,
    done: &'r mut dyn FnMut(usize, Result<Lyapunov>),
    watch: &'r dyn Watch,
}

impl<B: AsRef<dyn Equivariant>, F: InLanes, const N: usize, const K: usize, const D: usize> LaneKernel
    for ExponentKernel<'_, B, F, N, K, D>
{
    type Output = ();
    const WIDE: bool = F::WIDE;

    #[inline(always)]
    fn run<L: Bundle>(self) {
        let Some(first) = (self.next)() else { return };
        let mut lanes = TangentLanes::<L, B, F, N, K, D> {
            field: F::tangent(first.field.bundle()),
            first: Some(first),
            escape: L::splat(0.0),
            stop: L::splat(0.0),
            in_lanes: std::array::from_fn(|_| None),
            steps: 0,
            next: self.next,
            done: self.done,
            watch: self.watch,
        };
        run_adaptive::<Dop853, L, D, _>(&mut lanes, self.tolerance);
    }
}

/// A member in its lane.
struct InLane<B, F, const N: usize> {
    member: TangentMember<B, F, N>,
    renormalisation: Renormalisation,
    /// The direction of a vector was lost.
    lost: bool,
}

/// The members in the lanes of one thread.
struct TangentLanes<'r, L: Bundle, B, F: InLanes, const N: usize, const K: usize, const D: usize> {
    field: F::Tangent<L, K>,
    first: Option<TangentMember<B, F, N>>,
    escape: L,
    /// Ends of the stretches under way.
    stop: L,
    in_lanes: [Option<InLane<B, F, N>>; 16],
    steps: u32,
    next: &'r mut dyn FnMut() -> Option<TangentMember<B, F, N>>,
    done: &'r mut dyn FnMut(usize, Result<Lyapunov>),
    watch: &'r dyn Watch,
}

impl<L: Bundle, B: AsRef<dyn Equivariant>, F: InLanes, const N: usize, const K: usize, const D: usize>
    TangentLanes<'_, L, B, F, N, K, D>
{
    /// A member that its lane cannot finish, as a single orbit.
    fn alone(&mut self, in_lane: &InLane<B, F, N>) {
        let TangentMember { body, start, settings, .. } = &in_lane.member;
        (self.done)(in_lane.member.key, lyapunov(body.as_ref(), start, settings, self.watch));
    }

    /// Tells the lanes in `due` what their vectors have grown to, and takes the ends of their next stretches. A lane that has
    /// none, has spent its steps, or has lost a direction, is at its end.
    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts")]
    fn stretched(&mut self, due: Mask, landed: &mut AfterStep<'_, L, D>, lengths: &[L; K], speed: L) {
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
            let Some(in_lane) = &mut self.in_lanes[lane] else { continue };
            let lengths = grown.map(|lanes| lanes[lane]);
            let next = in_lane.renormalisation.stretched(t[lane], &lengths, speeds[lane], steps[lane] as u64);
            in_lane.lost = lengths.contains(&0.0);
            let next =
                next.filter(|_| !in_lane.lost && (work[lane] as u64) < in_lane.member.settings.max_steps);
            (stop[lane], end[lane]) = next.map_or((t[lane], t[lane]), |next| (next.stop, next.limit));
        }
        self.stop = L::load(&stop);
        *landed.t_end = L::load(&end);
    }
}

impl<L: Bundle, B: AsRef<dyn Equivariant>, F: InLanes, const N: usize, const K: usize, const D: usize>
    LaneTask<L, D> for TangentLanes<'_, L, B, F, N, K, D>
{
    type Field = F::Tangent<L, K>;
    const AFTER_STEP: bool = true;

    #[inline(always)]
    fn field(&self) -> &Self::Field {
        &self.field
    }

    fn enter(&mut self, lane: usize) -> Option<Entry<D>> {
        loop {
            if self.watch.stopped() {
                return None;
            }
            let member = self.first.take().or_else(|| (self.next)())?;
            let renormalisation = Renormalisation::new(&member.settings, &member.start);
            let mut in_lane = InLane { renormalisation, member, lost: false };
            let Some(Stretch { stop, limit }) = in_lane.renormalisation.begin(0.0) else {
                self.alone(&in_lane);
                continue;
            };
            in_lane.member.field.put(lane, self.field.as_mut());
            let norm = in_lane.member.settings.escape_norm;
            self.escape = self.escape.with_lane(lane, norm * norm);
            let mut u = [0.0; D];
            u.copy_from_slice(&first_state(&in_lane.member.start, K));
            self.in_lanes[lane] = Some(in_lane);
            self.stop = self.stop.with_lane(lane, stop);
            return Some(Entry { t: 0.0, u, t_end: limit, pace: None });
        }
    }

    /// Lanes whose shape is beyond the escape norm; all of them, now and then, where a stop was asked for.
    #[inline(always)]
    fn outside(&mut self, u: &[L; D]) -> Mask {
        self.steps = self.steps.wrapping_add(1);
        if self.steps.is_multiple_of(1024) && self.watch.stopped() {
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
    fn after_step(&mut self, landed: &mut AfterStep<'_, L, D>) -> Mask {
        let due = self.stop.at_most(landed.t) & landed.accepted;
        if !due.any() {
            return due;
        }
        let mut lengths = [L::splat(0.0); K];
        let lost = orthonormalise(due, N, &mut landed.u[N..], &mut landed.rates[N..], &mut lengths);
        let mut spin = [L::splat(0.0); N];
        F::spin(self.field.as_mut(), &landed.u[..N], &mut spin);
        let speed = speed_beside(&spin, &landed.rates[..N]);
        self.stretched(due, landed, &lengths, speed);
        lost
    }

    fn leave(&mut self, lane: usize, leaving: &Leaving<D>) -> Then {
        let Some(in_lane) = self.in_lanes[lane].take() else { return Then::Leave };
        if self.watch.stopped() {
            return Then::Leave;
        }
        let work = leaving.steps + leaving.rejected;
        if leaving.why != Why::Arrived || in_lane.lost || work >= in_lane.member.settings.max_steps {
            self.alone(&in_lane);
            return Then::Leave;
        }
        let (body, outcome) = (in_lane.member.body.as_ref(), Outcome::Completed { t: leaving.t });
        let result = in_lane.renormalisation.result(body, &leaving.u[..N], outcome, leaving.steps);
        (self.done)(in_lane.member.key, result);
        Then::Leave
    }
}
