//! Many motions classified at once: their orbits in lanes, their decisions one by one.
//!
//! A [`Search`] asks for looks and exponents. Here a lane of a bundle makes each look; a search that asks for an exponent
//! leaves its lane and waits until some tens of them can be measured together. Verdicts are those of [`super::classify()`], to
//! the last bit of every number in them.

use super::ask::Ask;
use super::chaos::exponent_settings;
use super::far::FAR;
use super::lane_look::LaneObserver;
use super::look::{Look, Seen, pause};
use super::search::Search;
use super::settings::Settings;
use super::verdict::Verdict;
use crate::Result;
use crate::linear::norm;
use crate::lyapunov::{TangentMember, lyapunov_in_lanes, runs_in_lanes};
use motiform_dynamics::ensemble::{
    Entry, InLanes, LaneTask, Leaving, Pace, Stepped, Then, Why, run_adaptive,
};
use motiform_dynamics::simd::{LaneKernel, run_wide};
use motiform_dynamics::steppers::unrolled::Dop853;
use motiform_dynamics::{
    Bundle, Equivariant, Integration, Mask, Orbit, Outcome, StepControl, Tolerance, Watch,
};
use std::collections::VecDeque;

/// A motion to classify.
pub struct Candidate<F, const N: usize> {
    /// The key that its verdict is returned with.
    pub key: usize,
    /// The body.
    pub body: Box<dyn Equivariant>,
    /// Its field.
    pub field: F,
    /// Its shape at the start.
    pub start: [f64; N],
}

/// Searches that wait for an exponent before they are measured together.
const WAITING: usize = 48;

/// Returns `true` if motions with these settings are classified in lanes.
pub fn classifies_in_lanes(settings: &Settings) -> bool {
    runs_in_lanes(&exponent_settings(settings, 1.0))
}

/// Classifies all motions that `next` gives, in lanes on this thread; each verdict is handed to `done` with the motion's
/// key, as soon as it is there. `settings` must be such that [`classifies_in_lanes`]; `D` is `2 N`. When `stopped` says
/// so, what is under way is left.
pub fn classify_in_lanes<F: InLanes + Clone, const N: usize, const D: usize>(
    settings: &Settings,
    next: &mut dyn FnMut() -> Option<Candidate<F, N>>,
    done: &mut dyn FnMut(usize, Result<Option<Verdict>>),
    watch: &dyn Watch,
) {
    let StepControl::Adaptive { rtol, atol } = settings.control else { return };
    let mut scheduler =
        Scheduler { settings, next, done, watch, ready: VecDeque::new(), waiting: Vec::new() };
    loop {
        let ran = run_wide(Looks::<F, N> { scheduler: &mut scheduler });
        if ran.is_none() || scheduler.waiting.is_empty() || scheduler.watch.stopped() {
            return;
        }
        scheduler.measure::<D>(Tolerance { rtol, atol });
    }
}

/// A motion whose orbit is in no lane.
struct Classification<F, const N: usize> {
    candidate: Candidate<F, N>,
    search: Search,
    t: f64,
    u: [f64; N],
    pace: Option<Pace>,
    /// The duration of the look or of the run for an exponent.
    span: f64,
}

/// The motions of one thread that are in no lane, and what each waits for.
struct Scheduler<'d, F, const N: usize> {
    settings: &'d Settings,
    next: &'d mut dyn FnMut() -> Option<Candidate<F, N>>,
    done: &'d mut dyn FnMut(usize, Result<Option<Verdict>>),
    watch: &'d dyn Watch,
    /// For a lane.
    ready: VecDeque<Classification<F, N>>,
    /// For an exponent.
    waiting: Vec<Classification<F, N>>,
}

impl<F: InLanes + Clone, const N: usize> Scheduler<'_, F, N> {
    /// The next search for a lane.
    fn take(&mut self) -> Option<Classification<F, N>> {
        if self.watch.stopped() {
            return None;
        }
        if let Some(motion) = self.ready.pop_front() {
            return Some(motion);
        }
        if self.waiting.len() >= WAITING {
            return None;
        }
        let candidate = (self.next)()?;
        let (search, ask) = Search::new(self.settings, &candidate.start);
        let span = if let Ask::Look(span) = ask { span } else { 0.0 };
        Some(Classification { u: candidate.start, candidate, search, t: 0.0, pace: None, span })
    }

    /// Files a search by what it asks for; gives it back if that is a look.
    fn file(&mut self, mut motion: Classification<F, N>, ask: Result<Ask>) -> Option<Classification<F, N>> {
        if self.watch.stopped() {
            return None; // what was decided while it stopped may rest on half of a run
        }
        match ask {
            Ok(Ask::Look(span)) => {
                motion.span = span;
                return Some(motion);
            }
            Ok(Ask::Exponent(span)) => {
                motion.span = span;
                self.waiting.push(motion);
            }
            Ok(Ask::Nothing(verdict)) => {
                (self.done)(motion.candidate.key, Ok(verdict.map(|verdict| *verdict)));
            }
            Err(error) => (self.done)(motion.candidate.key, Err(error)),
        }
        None
    }

    /// Measures the exponents of all searches that wait for one.
    fn measure<const D: usize>(&mut self, tolerance: Tolerance) {
        let waiting = std::mem::take(&mut self.waiting);
        let mut left = waiting.iter().enumerate();
        let mut next = || {
            let (key, motion) = left.next()?;
            Some(TangentMember {
                key,
                body: Borrowed(motion.candidate.body.as_ref()),
                field: motion.candidate.field.clone(),
                start: motion.u,
                settings: exponent_settings(self.settings, motion.span),
            })
        };
        let mut runs: Vec<_> = waiting.iter().map(|_| None).collect();
        let mut done = |key: usize, run| runs[key] = Some(run);
        lyapunov_in_lanes::<_, F, N, 1, D>(tolerance, &mut next, &mut done, self.watch);
        for (mut motion, run) in waiting.into_iter().zip(runs) {
            let Some(run) = run else { continue }; // stopped
            let ask = run.and_then(|run| {
                motion.u.copy_from_slice(&run.shape);
                motion.search.measured(motion.candidate.body.as_ref(), &run, self.watch)
            });
            let again = self.file(motion, ask);
            self.ready.extend(again);
        }
    }

    /// A look that a lane could not finish, by a single orbit from where it began.
    fn alone(
        &mut self,
        motion: &mut Classification<F, N>,
        begun: (f64, [f64; N], Option<Pace>),
    ) -> Result<Ask> {
        let (t, u, pace) = begun;
        let body = motion.candidate.body.as_ref();
        let mut orbit = Orbit::resume(body, self.settings.control, t, &u, pace)?;
        let request = self.settings.request(t + motion.span, N);
        let search = &mut motion.search;
        let mut ends = |seen: &Seen, shape: &[f64]| search.arrives(body, seen, shape);
        let look = Look::take_until(body, &mut orbit, motion.span, Some(&mut ends), &request, self.watch)?;
        (motion.t, motion.pace) = (orbit.t(), Some(orbit.pace()));
        motion.u.copy_from_slice(orbit.state());
        motion.search.looked(body, look, self.watch)
    }
}

/// A borrowed body.
struct Borrowed<'b>(&'b (dyn Equivariant + 'static));

impl AsRef<dyn Equivariant> for Borrowed<'_> {
    fn as_ref(&self) -> &(dyn Equivariant + 'static) {
        self.0
    }
}

/// The looks of one thread, until all are decided or wait for an exponent.
struct Looks<'l, 'd, F, const N: usize> {
    scheduler: &'l mut Scheduler<'d, F, N>,
}

impl<F: InLanes + Clone, const N: usize> LaneKernel for Looks<'_, '_, F, N> {
    type Output = ();
    const WIDE: bool = F::WIDE;

    #[inline(always)]
    fn run<L: Bundle>(self) {
        let StepControl::Adaptive { rtol, atol } = self.scheduler.settings.control else { return };
        let Some(first) = self.scheduler.take() else { return };
        let mut lanes = SearchLanes::<L, F, N> {
            field: first.candidate.field.bundle(),
            scheduler: self.scheduler,
            first: Some(first),
            in_lanes: std::array::from_fn(|_| None),
            singles: std::array::from_fn(|_| None),
            observer: LaneObserver::new(),
            pauses: L::splat(f64::INFINITY),
            far: L::splat(0.0),
            steps: 0,
        };
        run_adaptive::<Dop853, L, N, _>(&mut lanes, Tolerance { rtol, atol });
    }
}

/// A search in its lane, and where its look began.
struct InLane<F, const N: usize> {
    motion: Classification<F, N>,
    begun: (f64, [f64; N], Option<Pace>),
}

/// The searches in the lanes.
struct SearchLanes<'l, 'd, L: Bundle, F: InLanes, const N: usize> {
    field: F::Field<L>,
    scheduler: &'l mut Scheduler<'d, F, N>,
    first: Option<Classification<F, N>>,
    in_lanes: [Option<InLane<F, N>>; 16],
    /// The fields of the lanes, one by one.
    singles: [Option<F>; 16],
    observer: LaneObserver<L, N>,
    /// The times at which looks pause next.
    pauses: L,
    /// The square of the norm beyond which a lane gives its orbit up: it may crawl there, or escape ([`Far`](super::far::Far)).
    far: L,
    steps: u32,
}

impl<L: Bundle, F: InLanes + Clone, const N: usize> LaneTask<L, N> for SearchLanes<'_, '_, L, F, N> {
    type Field = F::Field<L>;
    const WATCHES: bool = true;

    #[inline(always)]
    fn field(&self) -> &Self::Field {
        &self.field
    }

    fn enter(&mut self, lane: usize) -> Option<Entry<N>> {
        let motion = self.first.take().or_else(|| self.scheduler.take())?;
        motion.candidate.field.put(lane, &mut self.field);
        self.singles[lane] = Some(motion.candidate.field.clone());
        let Classification { t, u, pace, span, .. } = motion;
        self.begin(lane, motion, (t, u, pace));
        Some(Entry { t, u, t_end: t + span, pace })
    }

    #[inline(always)]
    fn outside(&mut self, u: &[L; N]) -> Mask {
        self.steps = self.steps.wrapping_add(1);
        if self.steps.is_multiple_of(1024) && self.scheduler.watch.stopped() {
            return Mask::first(L::LANES);
        }
        let mut norm = L::splat(0.0);
        for i in 0..N {
            norm += u[i] * u[i];
        }
        self.far.less(norm)
    }

    #[inline(always)]
    fn stepped(&mut self, step: &mut Stepped<'_, L, N, F::Field<L>>) -> Mask {
        self.observer.stepped(step, &self.field, &self.singles);
        step.accepted & self.pauses.at_most(step.t)
    }

    fn leave(&mut self, lane: usize, leaving: &Leaving<N>) -> Then {
        let paused = self.pauses(lane, leaving);
        if paused && let Some(end) = self.goes_on(lane, leaving) {
            return Then::Continue(end);
        }
        let (in_lane, seen) = (self.in_lanes[lane].take(), self.observer.end(lane));
        let (Some(InLane { mut motion, begun }), Some(seen)) = (in_lane, seen) else { return Then::Leave };
        if self.scheduler.watch.stopped() {
            return Then::Leave;
        }
        let Leaving { why, t, u, pace, .. } = *leaving;
        let work = leaving.steps + leaving.rejected;
        if !(paused || why == Why::Arrived) || work >= self.scheduler.settings.max_steps {
            let ask = self.scheduler.alone(&mut motion, begun);
            let again = self.scheduler.file(motion, ask);
            self.scheduler.ready.extend(again);
            return Then::Leave;
        }
        let look = seen.look((begun.0, t), Outcome::Completed { t }, u.to_vec());
        let ask = motion.search.looked(motion.candidate.body.as_ref(), look, self.scheduler.watch);
        (motion.t, motion.u, motion.pace) = (t, u, Some(pace));
        let Some(motion) = self.scheduler.file(motion, ask) else { return Then::Leave };
        let span = motion.span;
        self.begin(lane, motion, (t, u, Some(pace)));
        Then::Continue(t + span)
    }
}

impl<L: Bundle, F: InLanes + Clone, const N: usize> SearchLanes<'_, '_, L, F, N> {
    /// Begins a look in a lane.
    fn begin(&mut self, lane: usize, motion: Classification<F, N>, begun: (f64, [f64; N], Option<Pace>)) {
        let (t, u, _) = begun;
        self.observer.begin(lane, motion.candidate.body.as_ref(), t, &u);
        self.pauses = self.pauses.with_lane(lane, pause(N, (t, t + motion.span), t));
        let (escape, size) = (self.scheduler.settings.escape_norm, norm(&u));
        // an orbit that is always far out stays in its lane
        let bound = if size < 0.1 * FAR * escape { FAR * escape } else { escape };
        self.far = self.far.with_lane(lane, bound * bound);
        self.in_lanes[lane] = Some(InLane { motion, begun });
    }

    /// Returns `true` if a lane has stopped for a pause of its look, within bounds.
    fn pauses(&self, lane: usize, leaving: &Leaving<N>) -> bool {
        let bounded = leaving.u.iter().map(|x| x * x).sum::<f64>() <= self.far.lane(lane);
        leaving.why != Why::Failed && bounded && self.pauses.lane(lane) <= leaving.t
    }

    /// The end of the look of a lane that pauses; `None` if the look ends here.
    fn goes_on(&mut self, lane: usize, leaving: &Leaving<N>) -> Option<f64> {
        let InLane { motion, begun } = self.in_lanes[lane].as_mut()?;
        let look = (begun.0, begun.0 + motion.span);
        let work = leaving.steps + leaving.rejected;
        let over = leaving.t >= look.1 || work >= self.scheduler.settings.max_steps;
        if over || motion.search.arrives(motion.candidate.body.as_ref(), self.observer.now(lane)?, &leaving.u)
        {
            return None;
        }
        self.pauses = self.pauses.with_lane(lane, pause(N, look, leaving.t));
        Some(look.1)
    }
}
