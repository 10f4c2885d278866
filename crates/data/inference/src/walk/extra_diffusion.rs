//! Additional diffusion of a walker, which the persistent random walk does not have: score test, and wider intervals.

use super::filter::{Law, Step, raw_steps, spread};
use super::{Bounded, Fix};
use nalgebra::{Matrix4, Vector4};

/// Step of the derivatives, relative.
const STEP: f64 = 1e-4;
/// Above this score the intervals also include the walk with additional diffusion.
pub(super) const ALLOWED: f64 = 0.5;
/// Part of the information that is added to it: of steps without a memory P and S are unbounded, and D is known.
const RIDGE: f64 = 1e-6;

/// The derivatives of the log-likelihood at a walk by the logarithms of P and of the variance of its velocity, by the variance of the
/// error, and by that of additional diffusion (the last two relative to that of the velocity).
pub(super) struct Scores {
    /// Information.
    information: Matrix4<f64>,
    /// The score of each piece, and its steps.
    pub(super) pieces: Vec<(Vector4<f64>, f64)>,
    persistence: f64,
    variance: f64,
    error: f64,
}

/// The numbers of a walk that follow from those of [`Scores`]: by how much each of these moves them. The logarithm of all but the error.
#[derive(Clone, Copy)]
pub(super) enum Number {
    Persistence,
    Speed,
    Diffusion,
    Error,
}

impl Scores {
    /// Of the walk of this law whose velocity has this variance in each coordinate.
    ///
    /// An innovation e of variance w adds `-ln w - |e|^2/(2 w)` to the log-likelihood.
    pub(super) fn of(pieces: &[Vec<Fix>], law: Law, variance: f64, interval: f64) -> Self {
        let unit = law.persistence * law.persistence * spread(interval / law.persistence);
        let by = [STEP * law.persistence, STEP * unit, STEP * unit / interval];
        let moved = |which: usize, sign: f64| {
            let by = |number: usize| if number == which { sign * by[which] } else { 0.0 };
            let Law { persistence, error, diffusion } = law;
            let other =
                Law { persistence: persistence + by(0), error: error + by(1), diffusion: diffusion + by(2) };
            raw_steps(pieces, other)
        };
        let scale = [2.0 * STEP, 2.0 * by[1], 2.0 * by[2]];
        let sides = [0, 1, 2].map(|which| [moved(which, -1.0), moved(which, 1.0)]);
        let mut found = Self {
            information: Matrix4::zeros(),
            pieces: vec![(Vector4::zeros(), 0.0); pieces.len()],
            persistence: law.persistence,
            variance,
            error: law.error,
        };
        for (k, step) in raw_steps(pieces, law).into_iter().enumerate() {
            let change = |which: usize, of: &dyn Fn(&Step) -> f64| {
                let [low, high] = &sides[which];
                (of(&high[k]) - of(&low[k])) / scale[which]
            };
            let size = |which| change(which, &|step| step.variance) / step.variance;
            let sizes = Vector4::new(size(0), 1.0, size(1), size(2));
            let w = variance * step.variance;
            let square = step.innovation.iter().map(|e| e * e).sum::<f64>() / w;
            let mut score = sizes * (0.5 * square - 1.0);
            found.information += sizes * sizes.transpose();
            for c in 0..2 {
                let of = |which| change(which, &|step| step.innovation[c]);
                let places = Vector4::new(of(0), 0.0, of(1), of(2));
                score -= places * (step.innovation[c] / w);
                found.information += places * places.transpose() / w;
            }
            found.pieces[step.piece].0 += score;
            found.pieces[step.piece].1 += 1.0;
        }
        found
    }

    /// The inverse of the information, without and with additional diffusion; `None` where there is none. What the places do not tell
    /// apart has errors of a thousand.
    pub(super) fn inverses(&self) -> Option<[Matrix4<f64>; 2]> {
        let of = |count: usize| {
            let mut part = self.information.view((0, 0), (count, count)).into_owned();
            (0..count).for_each(|k| part[(k, k)] *= 1.0 + RIDGE);
            let inverse = part.cholesky()?.inverse();
            let mut whole = Matrix4::zeros();
            whole.view_mut((0, 0), (count, count)).copy_from(&inverse);
            Some(whole)
        };
        Some([of(3)?, of(4)?])
    }

    /// The change of a number with those of the scores; `D = V P + d/2` in each coordinate, d the additional variance per time.
    pub(super) fn gradient(&self, number: Number) -> Vector4<f64> {
        match number {
            Number::Persistence => Vector4::new(1.0, 0.0, 0.0, 0.0),
            Number::Speed => Vector4::new(0.0, 0.5, 0.0, 0.0),
            Number::Diffusion => Vector4::new(1.0, 1.0, 0.0, 0.5 / self.persistence),
            Number::Error => Vector4::new(0.0, self.variance * self.error, self.variance, 0.0),
        }
    }

    /// The part of a score for additional diffusion that the other numbers of the walk do not take up.
    pub(super) fn own(&self, [walk, _]: &[Matrix4<f64>; 2], score: &Vector4<f64>) -> f64 {
        score[3] - (self.information.row(3) * walk * score)[0]
    }

    /// The sum of all scores.
    pub(super) fn sum(&self) -> Vector4<f64> {
        self.pieces.iter().map(|piece| piece.0).sum()
    }
}

/// Additional diffusion on one path.
pub(super) struct ExtraDiffusion {
    scores: Scores,
    inverses: Option<[Matrix4<f64>; 2]>,
}

impl ExtraDiffusion {
    pub(super) fn of(scores: Scores) -> Self {
        Self { inverses: scores.inverses(), scores }
    }

    /// The score of additional diffusion: for a walk a normal number of variance 1; below 0 the displacements from place to place
    /// scatter less than those of the walk, as of places that are means over a time. 0 where nothing tells it from the walk.
    pub(super) fn score(&self) -> f64 {
        let Some(inverses) = &self.inverses else { return 0.0 };
        let all = self.scores.sum();
        self.scores.own(inverses, &all) * inverses[1][(3, 3)].max(0.0).sqrt()
    }

    /// The interval of a number; above the score [`ALLOWED`] it also includes that of the walk with additional diffusion: shifted by one
    /// Newton step, and wider by the ratio of the errors.
    pub(super) fn wider(&self, number: Number, of: Bounded) -> Bounded {
        let Some(inverses) = self.inverses.as_ref().filter(|_| self.score().abs() > ALLOWED) else {
            return of;
        };
        let gradient = self.scores.gradient(number);
        let error = |which: usize| (gradient.transpose() * inverses[which] * gradient)[0].max(0.0).sqrt();
        let shift = gradient.dot(&(inverses[1] * self.scores.sum()));
        let ratio = error(1) / error(0);
        let end = |end: f64| match number {
            Number::Error => of.value + shift + ratio * (end - of.value),
            _ => of.value * libm::exp(shift + ratio * libm::log(end / of.value)),
        };
        let (low, high) = (of.low.map(|low| end(low).min(low)), of.high.map(|high| end(high).max(high)));
        if shift.is_finite() && ratio.is_finite() { Bounded { low, high, ..of } } else { of }
    }
}
