//! The flow of a stiff field with its exact derivatives, by an implicit method of order 9.
//!
//! Newton's method for orbits needs the flow over parts of an orbit, in ten digits, with the images of all unit vectors. Exponential
//! methods are of order 4, 3 in their error estimate, and need tens of thousands of steps for them. Radau IIA of order 9 takes about a
//! hundred: each solves for five stages at once, and the vectors are carried by the derivative of the same equations, so that they are
//! the derivatives of the computed flow to round-off. Stiff parts of the vectors, which only decay, do not shorten the steps: the
//! method is L-stable.
//!
//! The stages are found by Newton's method with one Jacobian for all of them ([`common`]), which gains two digits or more in each
//! iteration; the vectors need that of every stage ([`blocks`]). Where either fails, all equations are solved at once.
//!
//! Source: Hairer and Wanner, Solving Ordinary Differential Equations II, sections IV.5 and IV.8.

mod blocks;
mod common;
mod escape;
mod modes;
mod product;
mod step;
mod tableau;
mod vectors;
mod whole;

pub(crate) use escape::Ascent;

use crate::linear::norm;
use motiform_dynamics::tangent::Differentiable;
use motiform_dynamics::{Outcome, VectorField, Watch};
use nalgebra::DMatrix;
use step::Step;
use tableau::{STAGES, Tableau};

/// The size of the fifth power over a step, as part of the size of the state. The error of a step is smaller by many orders: tests
/// state it.
const ROUGHNESS: f64 = 1e-6;

/// Up to so many unknowns one matrix for all stages is as quick as several smaller ones.
const FEW: usize = 12;

/// Shortest step, as part of the span.
const SHORTEST: f64 = 1e-12;

/// The state that the flow leads to.
#[derive(Clone, Debug)]
pub struct Flowed {
    /// The state at the end.
    pub end: Vec<f64>,
    /// The vectors there, one after the other.
    pub vectors: Vec<f64>,
    /// Steps taken.
    pub steps: u64,
    /// The step that would be taken next.
    pub step: f64,
}

/// The flow of `field` from `start` over `span`, and of the tangent vectors `vectors`, one after the other. `forced` returns a vector
/// `g` at a state for each of the last of them: these follow `w' = Df w + g`, the others `w' = Df w`. `first` is the first step to try,
/// of a flow that goes on ([`Flowed::step`]); without it, one over which the state changes little.
///
/// # Errors
/// The outcome, where it is not the end of the span: the solution leaves, steps become too short, or `watch` stops it.
pub fn implicit_flow<F: VectorField<f64> + Differentiable + ?Sized>(
    field: &F,
    start: &[f64],
    vectors: &[f64],
    forced: &dyn Fn(&[f64]) -> Vec<Vec<f64>>,
    (span, first): (f64, Option<f64>),
    watch: &dyn Watch,
) -> Result<Flowed, Outcome> {
    let dim = start.len();
    let mut flow = Progress {
        field,
        u: start.to_vec(),
        vectors: DMatrix::from_column_slice(dim, vectors.len() / dim.max(1), vectors),
        h: first.unwrap_or_else(|| first_step(field, start, span)),
        before: None,
        steps: 0,
    };
    let mut t = 0.0;
    while t < span {
        if watch.stopped() {
            return Err(Outcome::Interrupted { t });
        }
        let left = span - t;
        // the last two steps are of one length
        let now = if left > 2.0 * flow.h { flow.h } else { left / (left / flow.h).ceil().max(1.0) };
        if now < SHORTEST * span {
            return Err(Outcome::StepUnderflow { t, step: now });
        }
        if flow.step(now, forced) {
            t = if now == left { span } else { t + now };
        }
    }
    Ok(Flowed { end: flow.u, vectors: flow.vectors.as_slice().to_vec(), steps: flow.steps, step: flow.h })
}

/// A flow on its way.
struct Progress<'f, F: ?Sized> {
    field: &'f F,
    u: Vec<f64>,
    vectors: DMatrix<f64>,
    /// The step to try next.
    h: f64,
    /// The last step, from where it began, and its length: its polynomial is the guess for the next one.
    before: Option<(Step<'f, F>, Vec<f64>, f64)>,
    steps: u64,
}

impl<F: VectorField<f64> + Differentiable + ?Sized> Progress<'_, F> {
    /// Tries a step of length `now`; `false` where it must be shorter.
    fn step(&mut self, now: f64, forced: &dyn Fn(&[f64]) -> Vec<Vec<f64>>) -> bool {
        let Some(step) = Step::solve(self.field, now, &self.u, self.guess(now)) else {
            (self.h, self.before) = (0.4 * now, None);
            return false;
        };
        let rough = step.roughness(&self.u) / (ROUGHNESS * norm(&self.u)).max(f64::MIN_POSITIVE);
        self.h = now * (0.9 * rough.powf(-0.2)).clamp(0.2, 3.0);
        if rough > 3.0 {
            return false;
        }
        if self.vectors.ncols() > 0 && !step.carry(&mut self.vectors, forced) {
            self.h = 0.4 * now;
            return false;
        }
        let end = step.end();
        self.before = Some((step, std::mem::replace(&mut self.u, end), now));
        self.steps += 1;
        true
    }

    /// The stages of the next step by the polynomial of the last one.
    fn guess(&self, now: f64) -> DMatrix<f64> {
        match &self.before {
            Some((step, from, size)) => {
                let times = Tableau::get().nodes.iter().map(|c| 1.0 + c * now / size);
                step.continued(from, times)
            }
            None => DMatrix::from_fn(self.u.len(), STAGES, |k, _| self.u[k]),
        }
    }
}

/// A first step over which the state changes by a small part of itself.
fn first_step<F: VectorField<f64> + ?Sized>(field: &F, start: &[f64], span: f64) -> f64 {
    let mut rate = vec![0.0; start.len()];
    VectorField::<f64>::eval(field, 0.0, start, &mut rate);
    let (size, speed) = (norm(start), norm(&rate));
    if speed * span > 0.05 * size { 0.05 * size / speed } else { span }
}
