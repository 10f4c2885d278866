//! The stiff way of an orbit out of all bounds.

use super::step::Step;
use super::tableau::Tableau;
use super::{Progress, SHORTEST, first_step};
use crate::linear::norm;
use motiform_dynamics::escape::GrowthLaw;
use motiform_dynamics::tangent::Differentiable;
use motiform_dynamics::{Outcome, VectorField, Watch};
use nalgebra::DMatrix;

/// Most steps of an ascent. A growth by a factor of 1000 takes some hundred; an orbit that takes more is not slaved to its slow variables.
const STEPS: usize = 4000;

/// An orbit on its way out of bounds grows all the way: one that falls below this part of its largest norm is on an excursion.
const FALLS: f64 = 0.8;

/// The time at which the bound is passed has been found where the norm differs from it by less than this part.
const MET: f64 = 1e-12;

/// Corrections of that time: the logarithm of the norm is nearly a straight line over a step, and each takes twice the digits.
const CORRECTIONS: usize = 12;

/// An orbit that is followed out of bounds by the implicit method.
pub(crate) struct Ascent<'a> {
    /// The time at the start.
    pub(crate) t: f64,
    /// The orbit is followed to this time at most.
    pub(crate) t_end: f64,
    /// The norm beyond which it has escaped.
    pub(crate) bound: f64,
    /// May stop it.
    pub(crate) watch: &'a dyn Watch,
}

impl Ascent<'_> {
    /// Follows the flow from `start` until its norm passes the bound: the escape, with the same law of growth as that of an explicit run
    /// ([`motiform_dynamics::drive`]).
    ///
    /// `None` where it does not: the norm falls below [`FALLS`] of its largest value, the time is over, or the steps are too many.
    pub(crate) fn follow<F: VectorField<f64> + Differentiable + ?Sized>(
        &self,
        field: &F,
        start: &[f64],
    ) -> Option<Outcome> {
        let (span, mut largest) = (self.t_end - self.t, norm(start));
        let none = |_: &[f64]| Vec::new();
        let mut flow = Progress::without_vectors(field, start, span);
        let (mut t, mut law, mut slope) = (self.t, GrowthLaw::default(), vec![0.0; start.len()]);
        for _ in 0..STEPS {
            let now = flow.h.min(self.t_end - t);
            if now.is_nan() || now <= SHORTEST * span || self.watch.stopped() {
                return None;
            }
            if !flow.step(now, &none) {
                continue;
            }
            if norm(&flow.u) > self.bound {
                let (h, u) = self.passing(&flow)?;
                VectorField::<f64>::eval(field, t + h, &u, &mut slope);
                law.observe(t + h, &u, &slope);
                return Some(self.escaped(t + h, &law));
            }
            t += now;
            VectorField::<f64>::eval(field, t, &flow.u, &mut slope);
            law.observe(t, &flow.u, &slope);
            largest = largest.max(norm(&flow.u));
            if norm(&flow.u) < FALLS * largest {
                return None;
            }
        }
        None
    }

    /// The part of the last step after which the norm is the bound, and the state there.
    fn passing<F: VectorField<f64> + Differentiable + ?Sized>(
        &self,
        flow: &Progress<'_, F>,
    ) -> Option<(f64, Vec<f64>)> {
        let (step, from, size) = flow.before.as_ref()?;
        let level = |u: &[f64]| libm::log(norm(u) / self.bound);
        let (mut left, mut right) = ((0.0, level(from)), (*size, level(&flow.u)));
        for _ in 0..CORRECTIONS {
            let h = left.0 - left.1 * (right.0 - left.0) / (right.1 - left.1);
            let times = Tableau::get().nodes.map(|c| c * h / size);
            let guess: DMatrix<f64> = step.continued(from, times.into_iter());
            let end = Step::solve(flow.field, h, from, guess)?.end();
            let off = level(&end);
            if off.abs() < MET {
                return Some((h, end));
            }
            // the better one of the two ends stays: a secant, kept between them
            if off < 0.0 { left = (h, off) } else { right = (h, off) }
        }
        None
    }

    fn escaped(&self, t_last: f64, law: &GrowthLaw) -> Outcome {
        let found = law.singularity().filter(|found| found.t >= t_last);
        let (t, singular) = found.map_or((t_last, false), |found| (found.t, true));
        Outcome::Escaped { t, norm: self.bound, singular, t_last }
    }
}

impl<'f, F: VectorField<f64> + Differentiable + ?Sized> Progress<'f, F> {
    fn without_vectors(field: &'f F, start: &[f64], span: f64) -> Self {
        Self {
            field,
            u: start.to_vec(),
            vectors: DMatrix::zeros(start.len(), 0),
            h: first_step(field, start, span),
            before: None,
            steps: 0,
        }
    }
}

#[cfg(test)]
#[allow(clippy::panic, reason = "a test may fail")]
mod tests {
    use super::*;
    use motiform_dynamics::{Scalar, System};

    /// `x' = (w - v) x`, `y' = -x^2 (y - x / 2)`, `v' = b`: `y` is a slave of `x = x(0) exp(w t - b t^2 / 2)`, the stiffer the larger `x`
    /// is.
    struct Slaved {
        w: f64,
        b: f64,
    }

    impl System for Slaved {
        fn dim(&self) -> usize {
            3
        }
    }

    impl<T: Scalar> VectorField<T> for Slaved {
        fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
            let lag = u[1] - u[0] * 0.5;
            du[0] = (u[0].constant(self.w) - u[2]) * u[0];
            du[1] = -(u[0] * u[0] * lag);
            du[2] = u[0].constant(self.b);
        }
    }

    fn ascent(t_end: f64) -> Ascent<'static> {
        Ascent { t: 3.0, t_end, bound: 1e6, watch: &() }
    }

    /// `y` is half of `x` up to `w / x^2`, so that `|u| = sqrt(5/4) x` at the bound in twelve digits.
    #[test]
    fn a_stiff_exponential_growth_passes_its_bound_when_the_formula_says() {
        let found = ascent(10.0).follow(&Slaved { w: 20.0, b: 0.0 }, &[1e3, 500.0, 0.0]);
        let Some(Outcome::Escaped { t, norm, singular, t_last }) = found else { panic!("{found:?}") };
        let exact = 3.0 + (1e6 / (1.25_f64.sqrt() * 1e3)).ln() / 20.0;
        assert!((t - exact).abs() < 1e-9, "{t} {exact}");
        assert_eq!((norm, singular, t_last), (1e6, false, t));
    }

    /// The largest `x` is `x(0) exp(w^2 / 2 b)`: 3e5, then it falls; and 3e7, beyond the bound.
    #[test]
    fn an_excursion_within_bounds_is_no_escape() {
        let excursion = |w: f64| ascent(10.0).follow(&Slaved { w, b: 20.0 }, &[1e3, 500.0, 0.0]);
        let highest = |w: f64| 1e3 * (w * w / 40.0).exp();
        assert!(highest(15.1) < 4e5 && excursion(15.1).is_none());
        assert!(highest(20.3) > 1e7 && excursion(20.3).is_some());
    }

    #[test]
    fn the_time_that_is_given_is_not_exceeded() {
        assert!(ascent(3.2).follow(&Slaved { w: 20.0, b: 0.0 }, &[1e3, 500.0, 0.0]).is_none());
    }
}
