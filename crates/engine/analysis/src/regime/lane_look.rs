//! A look in lanes: what [`Look`](super::look::Look) sees of one orbit, seen of all lanes at once.
//!
//! The same bits as a single look. What happens at every step is computed over the bundle; an extreme of the size, or a step of
//! a rest, is looked at in its lane alone.

use super::look::{Extreme, RESTS, Seen};
use crate::linear::{dot, norm};
use crate::symmetry::Gauge;
use motiform_dynamics::ensemble::{InLanes, LaneDense, Stepped};
use motiform_dynamics::section::{PIECES, polished, slope_at, zero_between};
use motiform_dynamics::steppers::unrolled::{Dop853, LaneStep, StepSlopes};
use motiform_dynamics::{Bundle, Equivariant, Mask, VectorField};

/// The observations in all lanes so far.
pub(super) struct LaneObserver<L, const N: usize> {
    /// The last time and value at which the rate of the size was not zero, in the lanes of `known`.
    t: L,
    value: L,
    known: Mask,
    fastest: L,
    speed: L,
    smallest: L,
    largest: L,
    slowest: (L, [L; N]),
    /// Lanes with a rest under way.
    resting: Mask,
    /// The vector of the size ([`Gauge`]), the same for all lanes; `None` where it is the norm.
    form: Option<[f64; N]>,
    /// The observations that are kept lane by lane; `None` in vacant lanes.
    pub(super) seen: [Option<Seen>; 16],
}

/// The rate of the size: that of [`along`] with the rates at `u`.
#[inline(always)]
fn size_rate<L: Bundle, F: VectorField<L>, const N: usize>(
    form: &Option<[f64; N]>,
    field: &F,
    t: L,
    u: &[L; N],
) -> L {
    let mut rate = *u;
    field.eval(t, u, &mut rate);
    along(form, u, &rate)
}

/// `u . f`, or `l . f` with the vector of the size.
#[inline(always)]
fn along<L: Bundle, const N: usize>(form: &Option<[f64; N]>, u: &[L; N], rate: &[L; N]) -> L {
    let mut sum = L::splat(0.0);
    for i in 0..N {
        let own = match form {
            None => u[i],
            Some(form) => L::splat(form[i]),
        };
        sum += own * rate[i];
    }
    sum
}

#[inline(always)]
fn length<L: Bundle, const N: usize>(u: &[L; N]) -> L {
    let mut sum = L::splat(0.0);
    for i in 0..N {
        sum += u[i] * u[i];
    }
    sum.sqrt()
}

impl<L: Bundle, const N: usize> LaneObserver<L, N> {
    #[inline(always)]
    pub(super) fn new() -> Self {
        let zero = L::splat(0.0);
        Self {
            t: zero,
            value: zero,
            known: Mask::default(),
            fastest: zero,
            speed: zero,
            smallest: zero,
            largest: zero,
            slowest: (zero, [zero; N]),
            resting: Mask::default(),
            form: None,
            seen: std::array::from_fn(|_| None),
        }
    }

    /// Begins a look in one lane.
    pub(super) fn begin(&mut self, lane: usize, body: &dyn Equivariant, t: f64, u: &[f64; N]) {
        let gauge = Gauge::of(body);
        let rate = gauge.rate(body, u);
        self.form = gauge.form().and_then(|form| form.try_into().ok());
        self.t = self.t.with_lane(lane, t);
        self.value = self.value.with_lane(lane, rate);
        self.known = if rate == 0.0 { self.known & !Mask::only(lane) } else { self.known | Mask::only(lane) };
        self.fastest = self.fastest.with_lane(lane, 0.0);
        self.speed = self.speed.with_lane(lane, 0.0);
        let size = norm(u);
        self.smallest = self.smallest.with_lane(lane, size);
        self.largest = self.largest.with_lane(lane, size);
        self.slowest.0 = self.slowest.0.with_lane(lane, f64::INFINITY);
        for i in 0..N {
            self.slowest.1[i] = self.slowest.1[i].with_lane(lane, u[i]);
        }
        self.resting &= !Mask::only(lane);
        self.seen[lane] = Some(Seen::new(u));
    }

    /// The observations of a look so far, as far as [`super::search::Search::arrives`] needs them.
    pub(super) fn now(&mut self, lane: usize) -> Option<&Seen> {
        let seen = self.seen[lane].as_mut()?;
        seen.fastest = self.fastest.lane(lane);
        seen.last_speed = self.speed.lane(lane);
        seen.sizes = (self.smallest.lane(lane), self.largest.lane(lane));
        Some(seen)
    }

    /// Ends the look in one lane.
    pub(super) fn end(&mut self, lane: usize) -> Option<Seen> {
        self.now(lane)?;
        let mut seen = self.seen[lane].take()?;
        seen.slowest.0 = self.slowest.0.lane(lane);
        for i in 0..N {
            seen.slowest.1[i] = self.slowest.1[i].lane(lane);
        }
        Some(seen)
    }

    /// Takes in a step of the bundle. `single` says which field a lane has.
    #[inline(always)]
    pub(super) fn stepped<F: InLanes>(
        &mut self,
        step: &mut Stepped<'_, L, N, F::Field<L>>,
        field: &F::Field<L>,
        singles: &[Option<F>; 16],
    ) {
        self.extremes::<F>(step, field, singles);
        let mut spin = *step.u;
        F::spin(field, step.u, &mut spin);
        let (mut along, mut square) = (L::splat(0.0), L::splat(0.0));
        for i in 0..N {
            along += spin[i] * step.slopes.k[step.end][i];
            square += spin[i] * spin[i];
        }
        let zero = L::splat(0.0);
        let omega = L::select(zero.less(square), along / square, zero);
        let mut rest = *step.u;
        for i in 0..N {
            rest[i] = step.slopes.k[step.end][i] - omega * spin[i];
        }
        let (size, speed, made) = (length(step.u), length(&rest), step.accepted);
        self.smallest = L::select(made & size.less(self.smallest), size, self.smallest);
        self.largest = L::select(made & self.largest.less(size), size, self.largest);
        self.speed = L::select(made, speed, self.speed);
        let slower = made & speed.less(self.slowest.0);
        self.slowest.0 = L::select(slower, speed, self.slowest.0);
        for i in 0..N {
            self.slowest.1[i] = L::select(slower, step.u[i], self.slowest.1[i]);
        }
        self.fastest = L::select(made & self.fastest.less(speed), speed, self.fastest);
        let slow = speed.less(self.fastest * RESTS);
        if (made & (slow | self.resting)).any() {
            self.rests(made & (slow | self.resting), step.t, step.u, speed);
        }
    }

    /// Rests of the lanes in `mask`.
    fn rests(&mut self, mask: Mask, t: L, u: &[L; N], speed: L) {
        for lane in mask.lanes() {
            let Some(seen) = &mut self.seen[lane] else { continue };
            let mut shape = [0.0; N];
            for i in 0..N {
                shape[i] = u[i].lane(lane);
            }
            seen.rests(t.lane(lane), &shape, speed.lane(lane), self.fastest.lane(lane));
            self.resting = if seen.resting() {
                self.resting | Mask::only(lane)
            } else {
                self.resting & !Mask::only(lane)
            };
        }
    }

    /// Looks for sign changes of the size's rate at several points of the step.
    #[inline(always)]
    fn extremes<F: InLanes>(
        &mut self,
        step: &mut Stepped<'_, L, N, F::Field<L>>,
        field: &F::Field<L>,
        singles: &[Option<F>; 16],
    ) {
        let dense = LaneDense::of::<Dop853, _>(step, field);
        let (zero, span) = (L::splat(0.0), step.t - step.t_old);
        // Kept from the compiler, which would write the field out once per piece.
        for piece in 1..=std::hint::black_box(PIECES) {
            let last = piece == PIECES;
            let t = if last { step.t } else { step.t_old + span * piece as f64 / L::splat(PIECES as f64) };
            let value = if last {
                along(&self.form, step.u, &step.slopes.k[step.end])
            } else {
                size_rate(&self.form, field, t, &dense.at((t - step.t_old) / span))
            };
            let (falls, rises) = (value.less(zero), zero.less(value));
            let before = self.value.less(zero);
            let counts = (falls | rises) & step.accepted;
            let changed = counts & self.known & ((before & rises) | (!before & falls));
            for lane in changed.lanes() {
                let Some(single) = &singles[lane] else { continue };
                let dense = dense.lane(lane);
                let right = (t.lane(lane), value.lane(lane));
                let guess = self.locate(lane, right, step, &dense, single);
                self.record(lane, guess, rises.has(lane), &dense, step, single);
            }
            self.t = L::select(counts, t, self.t);
            self.value = L::select(counts, value, self.value);
            self.known |= counts;
        }
    }

    /// The time of a sign change, on the interpolant.
    fn locate<F: VectorField<f64> + InLanes>(
        &self,
        lane: usize,
        right: (f64, f64),
        step: &Stepped<'_, L, N, F::Field<L>>,
        dense: &LaneDense<f64, N>,
        field: &F,
    ) -> f64 {
        let span = (step.t_old.lane(lane), step.t.lane(lane));
        let left = (self.t.lane(lane).max(span.0), self.value.lane(lane));
        zero_between(left, right, |t| rate_in(&self.form, field, dense, span, t))
    }

    /// Polishes an extreme and keeps it.
    fn record<F: VectorField<f64> + InLanes>(
        &mut self,
        lane: usize,
        guess: f64,
        rising: bool,
        dense: &LaneDense<f64, N>,
        step: &Stepped<'_, L, N, F::Field<L>>,
        field: &F,
    ) {
        let Some(seen) = &mut self.seen[lane] else { return };
        let span = (step.t_old.lane(lane), step.t.lane(lane));
        let form = self.form;
        let slope = slope_at(span, guess, |t| rate_in(&form, field, dense, span, t));
        let mut slopes = StepSlopes::<f64, N>::zero();
        let mut start = [0.0; N];
        for i in 0..N {
            slopes.k[0][i] = step.slopes.k[0][i].lane(lane);
            start[i] = step.u_old[i].lane(lane);
        }
        let to = |t: f64, state: &mut [f64]| {
            let at = LaneStep { t: span.0, h: t - span.0, u: &start };
            slopes.step::<Dop853, _>(field, &at);
            state.copy_from_slice(slopes.arrival());
            size_rate(&form, field, t, slopes.arrival())
        };
        let mut state = [0.0; N];
        let t = polished(span, guess, slope, to, &mut state);
        let size = form.map_or_else(|| norm(&state), |form| dot(&form, &state));
        seen.extreme(Extreme { t, minimum: rising, size, shape: state.to_vec() });
    }
}

/// The size's rate on the interpolant of a step.
fn rate_in<F: VectorField<f64>, const N: usize>(
    form: &Option<[f64; N]>,
    field: &F,
    dense: &LaneDense<f64, N>,
    (start, end): (f64, f64),
    t: f64,
) -> f64 {
    let state = if t == end { *dense.end() } else { dense.at((t - start) / (end - start)) };
    size_rate(form, field, t, &state)
}
