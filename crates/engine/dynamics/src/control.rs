//! Control of the step size.

use crate::steppers::Tableau;
use crate::steppers::tableau::ErrorEstimate;
use crate::{Bundle, Error, Mask, VectorField, steppers::runge_kutta::Slopes};

/// The choice of step size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepControl {
    /// Every step has this size (the last one may be shorter).
    Fixed {
        /// Step size (model time), above 0.
        step: f64,
    },
    /// The estimated error of a step stays below `atol + rtol |u|` (root mean square over the state).
    Adaptive {
        /// Relative tolerance, from 1e-14 to 0.1.
        rtol: f64,
        /// Absolute tolerance, at least 0 and finite.
        atol: f64,
    },
}

impl StepControl {
    /// Checks the numbers, and that `tableau` supports this control.
    ///
    /// # Errors
    /// [`Error::OutOfRange`], [`Error::NoErrorEstimate`].
    pub fn validate(&self, tableau: &Tableau) -> Result<(), Error> {
        self.validate_for(tableau.name, tableau.is_adaptive())
    }

    /// Checks the numbers, and that the method `stepper` supports this control.
    pub(crate) fn validate_for(&self, stepper: &'static str, is_adaptive: bool) -> Result<(), Error> {
        let in_range = |name, value: f64, ok: bool, range| {
            if ok && value.is_finite() { Ok(()) } else { Err(Error::OutOfRange { name, value, range }) }
        };
        match *self {
            Self::Fixed { step } => in_range("step", step, step > 0.0, "above 0"),
            Self::Adaptive { .. } if !is_adaptive => Err(Error::NoErrorEstimate { stepper }),
            Self::Adaptive { rtol, atol } => {
                in_range("rtol", rtol, (1e-14..=0.1).contains(&rtol), "between 1e-14 and 0.1")?;
                in_range("atol", atol, atol >= 0.0, "of at least 0")
            }
        }
    }
}

/// Proportional-integral step-size control, lane by lane.
///
/// `h_new = h * 0.9 * err^-(1/q - 0.75 beta) * err_old^beta`, within fixed factors; `q` is the order of the estimate
/// plus one. After a rejection the step does not grow immediately. The powers are approximate ([`Bundle::rough_power`]): a factor
/// of step size need not be accurate.
///
/// Source: Gustafsson (1991), ACM Trans. Math. Softw. 17, 533; Hairer, Norsett, Wanner, IV.2.
#[derive(Clone, Debug)]
pub(crate) struct Controller<B> {
    /// Exponents of the squared errors, in 256ths.
    exponent: i64,
    beta: i64,
    shrink: f64,
    grow: f64,
    /// Squared error of the last accepted step.
    previous: B,
    rejected: Mask,
}

/// The decision on a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Judgement<B> {
    /// Lanes whose step is accepted; the others must repeat it.
    pub(crate) accepted: Mask,
    /// Factor of the step size.
    pub(crate) factor: B,
}

impl<B: Bundle> Controller<B> {
    #[inline(always)]
    pub(crate) fn new(tableau: &Tableau) -> Self {
        let (exponent, beta, shrink, grow) = match tableau.error {
            ErrorEstimate::Pair { .. } => (16, 0, 1.0 / 3.0, 6.0), // 1/8
            ErrorEstimate::Embedded { order, .. } => {
                let beta = 5; // 0.039
                (128 / (i64::from(order) + 1) - 3 * beta / 4, beta, 0.2, 10.0)
            }
            ErrorEstimate::None => (0, 0, 0.2, 10.0),
        };
        Self { exponent, beta, shrink, grow, previous: B::splat(1e-8), rejected: Mask::default() }
    }

    /// Resets the lanes of `mask`.
    #[inline(always)]
    pub(crate) fn reset(&mut self, mask: Mask) {
        self.previous = B::select(mask, B::splat(1e-8), self.previous);
        self.rejected &= !mask;
    }

    /// The squared error of the last accepted step.
    #[inline(always)]
    pub(crate) fn previous(&self) -> B {
        self.previous
    }

    /// Continues in one lane from an earlier [`Controller::previous`].
    #[inline(always)]
    pub(crate) fn remember(&mut self, lane: usize, previous: f64) {
        self.previous = self.previous.with_lane(lane, previous);
    }

    /// Accepts or rejects steps by their squared error norms.
    #[inline(always)]
    pub(crate) fn judge(&mut self, error: B) -> Judgement<B> {
        let one = B::splat(1.0);
        let accepted = error.at_most(one);
        let factor = B::splat(1e-60).max(error).rough_power(-self.exponent) * 0.9;
        let down = factor.max(B::splat(self.shrink)).min(one);
        let down = B::select(error.finite(), down, B::splat(self.shrink));
        let up = if self.beta == 0 { factor } else { factor * self.previous.rough_power(self.beta) };
        let grow = B::select(self.rejected, one, B::splat(self.grow));
        let up = up.max(B::splat(self.shrink)).min(grow);
        self.previous = B::select(accepted, error.max(B::splat(1e-8)), self.previous);
        self.rejected = !accepted;
        Judgement { accepted, factor: B::select(accepted, up, down) }
    }
}

/// An entry whose plane no orbit crosses has an absolute tolerance of this size: smaller ones have no relative accuracy.
const LEAST_KEPT: f64 = 1e-290;

/// The entries of a state, as error control sees them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layout {
    /// See [`crate::System::vectors`].
    pub(crate) vectors: Option<usize>,
    /// See [`crate::System::kept`].
    pub(crate) kept: u64,
}

impl Layout {
    #[inline(always)]
    pub(crate) fn of<S: crate::System + ?Sized>(system: &S) -> Self {
        Self { vectors: system.vectors(), kept: system.kept() }
    }
}

/// The tolerances of error control; error norms of one step are against them.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance (unit of the state).
    pub atol: f64,
}

impl Tolerance {
    /// `1 / (atol + rtol max(|u|, |v|))`.
    #[inline(always)]
    pub(crate) fn weight<B: Bundle>(&self, u: B, v: B) -> B {
        B::splat(1.0) / (u.abs().max(v.abs()) * self.rtol + B::splat(self.atol))
    }

    /// The weight of an entry whose plane no orbit crosses: `1 / (rtol max(|u|, |v|))`, infinite for a step that crosses it.
    #[inline(always)]
    fn kept_weight<B: Bundle>(&self, u: B, v: B) -> B {
        let (zero, least) = (B::splat(0.0), B::splat(LEAST_KEPT));
        let crosses = (u.less(zero) & zero.less(v)) | (zero.less(u) & v.less(zero));
        let weight = B::splat(1.0) / (u.abs().max(v.abs()) * self.rtol + least);
        B::select(crosses, B::splat(f64::INFINITY), weight)
    }

    /// The weights of all entries. If the state consists of vectors, those after the first have one weight each:
    /// `1 / (atol + rtol max_i max(|u_i|, |v_i|))`.
    #[inline(always)]
    pub(crate) fn weights<B: Bundle>(&self, layout: Layout, u: &[B], v: &[B], out: &mut [B]) {
        let length = layout.vectors.unwrap_or(u.len()).clamp(1, u.len().max(1));
        for i in 0..length.min(u.len()) {
            out[i] = self.weight(u[i], v[i]);
        }
        if layout.kept != 0 {
            for i in 0..length.min(u.len()).min(64) {
                if layout.kept >> i & 1 != 0 {
                    out[i] = self.kept_weight(u[i], v[i]);
                }
            }
        }
        for from in (length..u.len()).step_by(length) {
            let mut size = u[from].abs().max(v[from].abs());
            for i in from + 1..from + length {
                size = size.max(u[i].abs().max(v[i].abs()));
            }
            let weight = B::splat(1.0) / (size * self.rtol + B::splat(self.atol));
            for i in from..from + length {
                out[i] = weight;
            }
        }
    }

    /// `(weight e)^2`. A zero over a zero counts as no error.
    #[inline(always)]
    pub(crate) fn square<B: Bundle>(error: B, weight: B) -> B {
        let zero = B::splat(0.0);
        let scaled = B::select(error.abs().at_most(zero), zero, error * weight);
        scaled * scaled
    }

    /// `sqrt(mean((e_i / (atol + rtol max(|u_i|, |v_i|)))^2))`.
    #[inline(always)]
    pub(crate) fn norm<B: Bundle>(&self, error: &[B], u: &[B], v: &[B]) -> B {
        let mut sum = B::splat(0.0);
        for i in 0..u.len() {
            sum += Self::square(error[i], self.weight(u[i], v[i]));
        }
        (sum * (1.0 / u.len() as f64)).sqrt()
    }

    /// The squared norm of the estimated error of a step from `u` to `v`; `scratch` has twice the state's length.
    pub(crate) fn step_error<B: Bundle>(
        &self,
        tableau: &Tableau,
        slopes: &Slopes<B>,
        h: B,
        [u, v]: [&[B]; 2],
        layout: Layout,
        scratch: &mut [B],
    ) -> B {
        let (scratch, scales) = scratch.split_at_mut(u.len());
        self.weights(layout, u, v, scales);
        let mean_square = |weights, scratch: &mut [B]| {
            slopes.combine(weights, scratch);
            let mut sum = B::splat(0.0);
            for i in 0..u.len() {
                sum += Self::square(scratch[i], scales[i]);
            }
            sum * (1.0 / u.len() as f64)
        };
        match tableau.error {
            ErrorEstimate::None => B::splat(0.0),
            ErrorEstimate::Embedded { weights, .. } => h * h * mean_square(weights, scratch),
            ErrorEstimate::Pair { fifth, third } => {
                let five = mean_square(fifth, scratch);
                pair_error(h, five, mean_square(third, scratch))
            }
        }
    }

    /// A first step suitable for the field near the start (Hairer, Norsett, Wanner, II.4). `slope` is the field at the
    /// start, `near` and `rate` are room for a state each.
    #[inline(always)]
    pub(crate) fn first_step<B: Bundle, F: VectorField<B> + ?Sized>(
        &self,
        field: &F,
        order: u32,
        t: B,
        u: &[B],
        slope: &[B],
        [near, rate]: [&mut [B]; 2],
    ) -> B {
        let d0 = self.norm(u, u, u);
        let d1 = self.norm(slope, u, u);
        let small = B::splat(1e-5);
        let usual = small.at_most(d0) & small.at_most(d1) & d0.finite() & d1.finite();
        let h0 = B::select(usual, d0 * 0.01 / d1, B::splat(1e-6));
        for i in 0..u.len() {
            near[i] = u[i] + h0 * slope[i];
        }
        field.eval(t + h0, near, rate);
        for i in 0..u.len() {
            near[i] = rate[i] - slope[i];
        }
        let d2 = self.norm(near, u, u) / h0;
        let steepest = d1.max(d2);
        let steep = B::splat(1e-15).less(steepest) & steepest.finite();
        let h1 = (B::splat(0.01) / steepest).rough_power(256 / i64::from(order));
        let h1 = B::select(steep, h1, (h0 * 1e-3).max(B::splat(1e-6)));
        h1.min(h0 * 100.0)
    }
}

/// The squared error of DOP853 from the mean squares of its two estimates: `h^2 e5^4 / (e5^2 + 0.01 e3^2)`.
#[inline(always)]
pub(crate) fn pair_error<B: Bundle>(h: B, five: B, three: B) -> B {
    let zero = B::splat(0.0);
    let denominator = five + three * 0.01;
    let error = h * h * five * five / denominator;
    B::select(denominator.abs().at_most(zero), zero, error)
}
