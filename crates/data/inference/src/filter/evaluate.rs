//! The likelihood of all frames, and what it says about the parameters.

use super::LONGEST_STEP;
use super::base::{self, ErrorsOfFrames, Law, Seen, Stage, State};
use super::blocks::Blocks;
use super::correction::{self, Correction};
use super::problem::{Frame, Problem, Theta};
use super::sums::Sums;
use motiform_dynamics::simd::{self, LaneKernel, run_lanes};
use motiform_dynamics::{Bundle, Complex};
use nalgebra::{DMatrix, DVector};

/// Largest row sum of the Jacobian times the interval between frames that is far too much (from 2 on coefficients are biased).
const TOO_FAST: f64 = 12.0;

/// The quantities that an evaluation computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Want {
    /// The likelihood alone.
    Value,
    /// Derivatives by the coefficients with the covariances taken as fixed, for first steps: a quarter of the work.
    Rough,
    /// Exact derivatives.
    Exact,
}

/// The likelihood at some values of the parameters.
#[derive(Clone, Debug)]
pub(crate) struct Evaluation {
    /// Log-likelihood; minus infinity where the filter diverges.
    pub(crate) value: f64,
    /// Its gradient, in the order of the coefficients, then the logarithms of the noise.
    pub(crate) gradient: DVector<f64>,
    /// Expected (Fisher) information.
    pub(crate) information: DMatrix<f64>,
    /// Standardised innovations of each frame, if kept; stretches in turn.
    pub(crate) innovations: Vec<Vec<Vec<f64>>>,
    /// Gradient of each frame's log-likelihood, if kept.
    pub(crate) scores: Vec<Vec<DVector<f64>>>,
    /// Largest variance of a velocity or mode that is predicted for a frame, and the time of that frame after the first one.
    pub(crate) vaguest: (f64, f64),
    /// Steps of the integration: what the evaluation cost.
    pub(crate) steps: usize,
    /// `true` if rates are too fast for the interval before every second frame or more.
    pub(crate) too_fast: bool,
}

/// Evaluates the likelihood; innovations and scores of frames are kept if `keep`.
pub(crate) fn evaluate(problem: &Problem, theta: &Theta, want: Want, keep: bool) -> Evaluation {
    let work = Asked { problem, theta, want, keep };
    let mut found = match problem.modes() {
        2 => run_lanes(Kernel::<4, 6>(work)),
        4 => run_lanes(Kernel::<8, 10>(work)),
        _ => run_lanes(Kernel::<6, 8>(work)),
    };
    if problem.unseen > 0 {
        problem.without_unseen(theta, &mut found);
    }
    found
}

/// The work on states of one size: `STATE = SHAPE + 2`.
struct Kernel<'a, const SHAPE: usize, const STATE: usize>(Asked<'a>);

struct Asked<'a> {
    problem: &'a Problem,
    theta: &'a Theta,
    want: Want,
    keep: bool,
}

impl<const SHAPE: usize, const STATE: usize> LaneKernel for Kernel<'_, SHAPE, STATE> {
    type Output = Evaluation;
    const WIDE: bool = SHAPE == 6; // z2 alone, and z4, are rarely fitted

    #[inline(always)]
    fn run<B: Bundle>(self) -> Evaluation {
        let work = &self.0;
        let c = work.problem.complex(work.theta);
        let mut run = Run::<B, SHAPE, STATE>::new(work, &c);
        let mut sound = true;
        for stretch in &work.problem.stretches {
            sound = sound && run.stretch(stretch);
        }
        run.finish(sound)
    }
}

/// An evaluation under way.
struct Run<'a, B, const SHAPE: usize, const STATE: usize> {
    work: &'a Asked<'a>,
    law: Law<'a, SHAPE, STATE>,
    noise: ErrorsOfFrames,
    stages: [Stage<SHAPE, STATE>; 4],
    blocks: Blocks<B, SHAPE, STATE>,
    sums: Sums<B>,
    value: f64,
    innovations: Vec<Vec<Vec<f64>>>,
    scores: Vec<Vec<DVector<f64>>>,
    vaguest: (f64, f64),
    steps: usize,
    /// Frames whose interval is too long for the rates.
    fast: usize,
}

/// A step of the law, with the instructions of the lanes: a function of its own, see [`Law::step`].
struct Step<'s, 'l, const SHAPE: usize, const STATE: usize> {
    law: &'s Law<'l, SHAPE, STATE>,
    state: &'s mut State<STATE>,
    h: f64,
    known: bool,
    stages: &'s mut [Stage<SHAPE, STATE>; 4],
}

impl<const SHAPE: usize, const STATE: usize> simd::Kernel for Step<'_, '_, SHAPE, STATE> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.law.step(self.state, self.h, self.known, self.stages);
    }
}

impl<'a, B: Bundle, const SHAPE: usize, const STATE: usize> Run<'a, B, SHAPE, STATE> {
    #[inline(always)]
    fn new(work: &'a Asked<'a>, c: &'a [Complex<f64>]) -> Self {
        let problem = work.problem;
        let second = work.want == Want::Exact;
        let stage = Stage::new(&problem.field);
        let law = Law { field: &problem.field, c, q: problem.process(work.theta), second };
        let [centre, by_centre] = problem.own_noise(work.theta);
        let blocks = Blocks::new(problem, work.want, &law.q, by_centre);
        Self {
            work,
            law,
            noise: ErrorsOfFrames { s2: libm::exp(2.0 * work.theta.logs[0]), centre },
            stages: [stage.clone(), stage.clone(), stage.clone(), stage],
            sums: Sums::new::<SHAPE>(blocks.counts(work.want)),
            blocks,
            value: 0.0,
            innovations: Vec::new(),
            scores: Vec::new(),
            vaguest: (0.0, 0.0),
            steps: 0,
            fast: 0,
        }
    }

    /// Goes through a stretch; false where the filter diverges.
    #[inline(always)]
    fn stretch(&mut self, frames: &[Frame]) -> bool {
        let [first, second] = [0, 1].map(|i| Seen::of(&frames[i]));
        let mut state = base::start::<SHAPE, STATE>(&first, &second, self.noise);
        self.blocks.start(&state, self.noise.centre);
        self.innovations.push(Vec::new());
        self.scores.push(Vec::new());
        for pair in 0..frames.len() - 1 {
            let dt = frames[pair + 1].t - frames[pair].t;
            let steps = (dt / LONGEST_STEP - 1e-9).ceil().max(1.0);
            let h = dt / steps;
            let mut turns = 0.0;
            let refinement = if pair == 0 { state.refinement() } else { 1 };
            for _ in 0..steps as usize {
                let (parts, turn) = self.law.parts(&state, h, &mut self.stages[0].values);
                turns += turn;
                let parts = refinement * parts;
                self.steps += parts;
                let h = h / parts as f64;
                for part in 0..parts {
                    let (law, stages, known) = (&self.law, &mut self.stages, part == 0);
                    B::apart(Step { law, state: &mut state, h, known, stages });
                    if !state.is_sound() {
                        return false;
                    }
                    self.blocks.step(&self.stages, self.work.problem, self.work.want, h);
                }
            }
            self.fast += usize::from(turns > TOO_FAST);
            for i in 2..STATE {
                if state.p[i][i] > self.vaguest.0 {
                    self.vaguest = (state.p[i][i], frames[pair + 1].t);
                }
            }
            let Some(correction) = correction::correct(&mut state, &Seen::of(&frames[pair + 1]), self.noise)
            else {
                return false;
            };
            self.take(&correction);
        }
        true
    }

    /// Takes a frame in.
    #[inline(always)]
    fn take(&mut self, correction: &Correction<SHAPE, STATE>) {
        self.value += correction.value;
        if self.blocks.len() > 0 {
            self.blocks.correct(correction, self.work.want, &mut self.sums);
            self.sums.add();
        }
        if self.work.keep {
            keep(&mut self.innovations, correction.standardised.to_vec());
            let score = self.blocks.unpadded(&self.sums.take_scores());
            keep(&mut self.scores, DVector::from_vec(score));
        }
    }

    #[inline(always)]
    fn finish(self, sound: bool) -> Evaluation {
        let (gradient, information) = self.sums.finish();
        let places = self.blocks.places();
        let width = self.sums.width();
        let n = places.len();
        let mut whole = DMatrix::zeros(n, n);
        for i in 0..n {
            for j in i..n {
                whole[(i, j)] = information[places[i] * width + places[j]];
                whole[(j, i)] = whole[(i, j)];
            }
        }
        Evaluation {
            value: if sound && self.value.is_finite() { self.value } else { f64::NEG_INFINITY },
            gradient: DVector::from_vec(self.blocks.unpadded(&gradient)),
            information: whole,
            innovations: self.innovations,
            scores: self.scores,
            vaguest: self.vaguest,
            steps: self.steps,
            too_fast: 2 * self.fast > self.work.problem.frames(),
        }
    }
}

fn keep<T>(all: &mut [Vec<T>], one: T) {
    if let Some(last) = all.last_mut() {
        last.push(one);
    }
}
