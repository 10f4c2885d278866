//! Mean and covariance, over plain numbers: the steps that everything else is a derivative of.

use super::{Frame, seen};
use crate::field::{Field, Values};
use motiform_dynamics::Complex;

/// Longest step of the integration times the largest row sum of the Jacobian.
const LONGEST_TURN: f64 = 1.0;
/// Most parts of a step for the rates, and as many again for the covariance of the first frame.
const MOST_PARTS: usize = 16;
/// Largest ratio of two variances for which steps of [`LONGEST_TURN`] do: the first frame, whose velocity is
/// hardly known, has up to 1e5, later ones 50 to 100.
const CONDITION: f64 = 1e3;

/// Mean and covariance of the state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State<const STATE: usize> {
    pub(crate) m: [f64; STATE],
    pub(crate) p: [[f64; STATE]; STATE],
}

/// The observation in a frame.
pub(crate) struct Seen<const SHAPE: usize> {
    t: f64,
    pub(super) y: [f64; SHAPE],
    covariance: [[f64; SHAPE]; SHAPE],
}

impl<const SHAPE: usize> Seen<SHAPE> {
    pub(crate) fn of(frame: &Frame) -> Self {
        let covariance = std::array::from_fn(|i| std::array::from_fn(|j| frame.covariance[i][j]));
        Self { t: frame.t, y: std::array::from_fn(|i| frame.y[i]), covariance }
    }
}

/// The errors of observation beside the stated covariances.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ErrorsOfFrames {
    /// `s^2`, which multiplies them.
    pub(crate) s2: f64,
    /// Variance of each coordinate of the centre that is added.
    pub(crate) centre: f64,
}

impl ErrorsOfFrames {
    #[inline(always)]
    pub(super) fn between<const SHAPE: usize>(self, frame: &Seen<SHAPE>, i: usize, j: usize) -> f64 {
        let own = if i == j && i < 2 { self.centre } else { 0.0 };
        self.s2 * frame.covariance[i][j] + own
    }
}

/// A stage of a Runge-Kutta step: the covariance and the field there.
#[derive(Clone, Debug)]
pub(crate) struct Stage<const SHAPE: usize, const STATE: usize> {
    pub(crate) p: [[f64; STATE]; STATE],
    pub(crate) values: Values<SHAPE>,
    /// `curved[i][l][j] = sum_k H_ikl P_kj`: what a change of entry l of the shape does to `A P`. Only with second derivatives.
    pub(crate) curved: [[[f64; STATE]; SHAPE]; SHAPE],
}

impl<const SHAPE: usize, const STATE: usize> Stage<SHAPE, STATE> {
    pub(crate) fn new(field: &Field) -> Self {
        let (p, curved) = ([[0.0; STATE]; STATE], [[[0.0; STATE]; SHAPE]; SHAPE]);
        Self { p, values: Values::new(field), curved }
    }

    #[inline(always)]
    fn curve(&mut self) {
        for i in 0..SHAPE {
            for l in 0..SHAPE {
                let mut row = [0.0; STATE];
                for k in 0..SHAPE {
                    let h = self.values.hessian[i][l][k];
                    for j in 0..STATE {
                        row[j] += h * self.p[k + 2][j];
                    }
                }
                self.curved[i][l] = row;
            }
        }
    }
}

/// The coefficients and the noise that a step is made with.
pub(crate) struct Law<'a, const SHAPE: usize, const STATE: usize> {
    pub(crate) field: &'a Field,
    pub(crate) c: &'a [Complex<f64>],
    pub(crate) q: [f64; STATE],
    /// `true` if the stages need second derivatives.
    pub(crate) second: bool,
}

/// The initial state of the filter: the first frame, and a velocity from the first two with generous errors.
///
/// The covariance of the observed entries is `s^2 R`, that of the centre with its own noise.
pub(crate) fn start<const SHAPE: usize, const STATE: usize>(
    first: &Seen<SHAPE>,
    second: &Seen<SHAPE>,
    noise: ErrorsOfFrames,
) -> State<STATE> {
    let dt = second.t - first.t;
    let mut state = State { m: [0.0; STATE], p: [[0.0; STATE]; STATE] };
    for i in 0..SHAPE {
        state.m[seen(i)] = first.y[i];
        for j in 0..SHAPE {
            state.p[seen(i)][seen(j)] = noise.between(first, i, j);
        }
    }
    for i in 0..2 {
        let sign = if i == 0 { 1.0 } else { -1.0 };
        state.m[2 + i] = sign * (second.y[i] - first.y[i]) / dt;
        let errors = (first.covariance[i][i] + second.covariance[i][i]) / (dt * dt);
        state.p[2 + i][2 + i] = 4.0 * errors + (dt * dt).min(1.0) + 0.01;
    }
    state
}

impl<const SHAPE: usize, const STATE: usize> Law<'_, SHAPE, STATE> {
    /// The field at a state.
    #[inline(always)]
    fn field(&self, at: &State<STATE>, values: &mut Values<SHAPE>) {
        let mut shape = [0.0; SHAPE];
        shape.copy_from_slice(&at.m[2..]);
        self.field.evaluate(self.c, &shape, self.second, values);
    }

    /// Rates of mean and covariance at `at`, which become a stage.
    #[inline(always)]
    fn rate(&self, at: &State<STATE>, stage: &mut Stage<SHAPE, STATE>) -> State<STATE> {
        self.field(at, &mut stage.values);
        self.moved(at, stage)
    }

    /// The rates where the stage has the field of `at`.
    #[inline(always)]
    fn moved(&self, at: &State<STATE>, stage: &mut Stage<SHAPE, STATE>) -> State<STATE> {
        stage.p = at.p;
        if self.second {
            stage.curve();
        }
        let a = &stage.values.jacobian;
        let mut product = [[0.0; STATE]; STATE]; // A P
        for j in 0..STATE {
            product[0][j] = at.p[2][j];
            product[1][j] = -at.p[3][j];
        }
        for i in 0..SHAPE {
            for k in 0..SHAPE {
                for j in 0..STATE {
                    product[i + 2][j] += a[i][k] * at.p[k + 2][j];
                }
            }
        }
        let mut rate = State { m: [0.0; STATE], p: product };
        rate.m[0] = at.m[2];
        rate.m[1] = -at.m[3];
        rate.m[2..].copy_from_slice(&stage.values.rate);
        for i in 0..STATE {
            for j in 0..STATE {
                rate.p[i][j] += product[j][i];
            }
            rate.p[i][i] += self.q[i];
        }
        rate
    }

    /// The number of parts in which a step must be made: a power of two, so that the fastest rate is resolved. Where it
    /// is not, the covariance is no longer positive definite, and the likelihood has maxima that are errors
    /// of the integration. With it the fastest rate times `h`; `values` becomes the field at `state`.
    #[inline(always)]
    pub(crate) fn parts(&self, state: &State<STATE>, h: f64, values: &mut Values<SHAPE>) -> (usize, f64) {
        self.field(state, values);
        let mut fastest = 0.0_f64;
        for row in &values.jacobian {
            let mut sum = 0.0;
            for entry in row {
                sum += entry.abs();
            }
            fastest = fastest.max(sum);
        }
        let mut parts = 1;
        while parts < MOST_PARTS && h * fastest > LONGEST_TURN * parts as f64 {
            parts *= 2;
        }
        (parts, h * fastest)
    }

    /// One step of the classical Runge-Kutta method; the stages are kept. `known`: the first one has the field at `state` ([`Law::parts`]).
    #[inline(always)]
    pub(crate) fn step(
        &self,
        state: &mut State<STATE>,
        h: f64,
        known: bool,
        stages: &mut [Stage<SHAPE, STATE>; 4],
    ) {
        if !known {
            self.field(state, &mut stages[0].values);
        }
        let k1 = self.moved(state, &mut stages[0]);
        let k2 = self.rate(&state.plus(&k1, 0.5 * h), &mut stages[1]);
        let k3 = self.rate(&state.plus(&k2, 0.5 * h), &mut stages[2]);
        let k4 = self.rate(&state.plus(&k3, h), &mut stages[3]);
        let sum = state.plus(&k1, h / 6.0).plus(&k2, h / 3.0);
        *state = sum.plus(&k3, h / 3.0).plus(&k4, h / 6.0);
    }
}

impl<const STATE: usize> State<STATE> {
    #[inline(always)]
    fn plus(&self, rate: &Self, h: f64) -> Self {
        let mut sum = *self;
        for i in 0..STATE {
            sum.m[i] += h * rate.m[i];
            for j in 0..STATE {
                sum.p[i][j] += h * rate.p[i][j];
            }
        }
        sum
    }

    /// The factor on the number of parts in which steps after the first frame must be made, so that errors of its large
    /// variances stay below the small ones: the square root of the ratio of variances over [`CONDITION`], as
    /// a power of two. Otherwise the covariance may lose its positive definiteness there, and the search for
    /// the maximum ends between points where the filter breaks down.
    #[inline(always)]
    pub(crate) fn refinement(&self) -> usize {
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for i in 0..STATE {
            least = least.min(self.p[i][i]);
            most = most.max(self.p[i][i]);
        }
        let mut parts = 1;
        while parts < MOST_PARTS && most > CONDITION * (parts * parts) as f64 * least {
            parts *= 2;
        }
        parts
    }

    /// Returns `true` if the filter can continue from it: finite, and not far beyond natural units.
    #[inline(always)]
    pub(crate) fn is_sound(&self) -> bool {
        let mut sound = true;
        for i in 0..STATE {
            sound &= (i < 2 || self.m[i].abs() < 1e3) && self.p[i][i] < 1e6;
        }
        sound
    }
}
