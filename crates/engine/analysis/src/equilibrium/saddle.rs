//! The rates at a saddle that decide about a cycle through it.

use super::{RelativeEquilibrium, linearisation, matrix_of, neutral_direction, spectrum};
use crate::isotropy::Isotropy;
use crate::linear::{add, basis, complement, dot, norm};
use motiform_dynamics::Equivariant;
use motiform_dynamics::sample::sort_by_number;
use serde::{Deserialize, Serialize};

/// Rates at a saddle of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Saddle {
    /// `lambda_+`: how fast orbits leave.
    pub out: f64,
    /// `lambda_-` (negative): how fast they arrive.
    pub inward: f64,
    /// Bound on the error of their sum: the cycle attracts where the sum is clearly negative.
    #[serde(default)]
    pub error: f64,
}

impl Saddle {
    /// Returns `true` if a cycle through this saddle attracts: `lambda_+ + lambda_- < 0`, beyond the error of
    /// the sum.
    ///
    /// Source: Krupa and Melbourne (1995), Ergod. Th. Dynam. Sys. 15, 121.
    pub fn attracts(&self) -> bool {
        self.out > 0.0 && self.out + self.inward < -self.error
    }
}

impl RelativeEquilibrium {
    /// The rates that decide about a cycle through this saddle: the fastest growth `lambda_+` and the leading rate
    /// `lambda_-` of the directions along which orbits arrive.
    ///
    /// Directions that keep all of the shape's own symmetry (a larger or smaller body of the same kind) carry no orbit
    /// from saddle to saddle and do not count. Where the shape has a mirror axis, orbits leave in one class (even or
    /// odd) and arrive in the other; `lambda_-` is then the leading rate of that other class. `None` unless exactly one
    /// direction grows, or one complex pair (the departure oscillates). Modes whose phase nothing fixes have no part in it: neither the
    /// symmetry of the shape nor the directions are theirs.
    ///
    /// Source: Krupa, Melbourne (1995), Ergod. Theory Dyn. Syst. 15, 121; for 1:2 modes Armbruster, Guckenheimer, Holmes
    /// (1988), Physica D 29, 257.
    pub fn saddle(&self, body: &dyn Equivariant) -> Option<Saddle> {
        let growing = self.growing();
        let pair = growing == 2 && self.eigenvalues[0].1 != 0.0;
        if growing != 1 && !pair {
            return None;
        }
        let matrix = matrix_of(&linearisation(body, &self.shape, self.turning_rate));
        let entries = self.uncertainty(body).of_linearisation(body, &self.shape, self.turning_rate, &matrix);
        let leading = |class: &Vec<Vec<f64>>| {
            let (values, errors) = spectrum::within(class, &matrix, &entries)?;
            Some((values.first()?.0, *errors.first()?))
        };
        let mut rates: Vec<(f64, f64)> = self.classes(body).iter().filter_map(leading).collect();
        sort_by_number(&mut rates, |a| -a.0);
        let (out, inward) = match rates[..] {
            [out, inward, ..] => (out, inward),
            [out] => (out, (self.eigenvalues.get(growing)?.0, *self.errors.get(growing)?)),
            [] => return None,
        };
        let error = out.1 + inward.1;
        (out.0 > 0.0 && inward.0 < 0.0).then_some(Saddle { out: out.0, inward: inward.0, error })
    }

    /// Bases of the directions that break the shape's rotations, split into mirror-even and mirror-odd ones where it has
    /// a mirror axis.
    fn classes(&self, body: &dyn Equivariant) -> Vec<Vec<Vec<f64>>> {
        let dim = self.shape.len();
        let silent = self.silent(body);
        let heard = |x: &mut Vec<f64>| x.iter_mut().zip(&silent).filter(|x| *x.1).for_each(|x| *x.0 = 0.0);
        let mut shape = self.shape.clone();
        heard(&mut shape);
        let neutral = neutral_direction(body, &shape);
        let isotropy = Isotropy::of(body, &shape, Isotropy::SAME);
        let folds = isotropy.folds;
        let mean = |x: &[f64]| {
            let mut sum = vec![0.0; dim];
            for k in 0..folds {
                let mut turned = x.to_vec();
                body.rotate(std::f64::consts::TAU * k as f64 / folds as f64, &mut turned);
                add(&mut sum, 1.0 / folds as f64, &turned);
            }
            sum
        };
        let breaking = |x: &[f64]| {
            let mut out = x.to_vec();
            if folds > 1 {
                add(&mut out, -1.0, &mean(x));
            }
            for direction in &neutral {
                let along = dot(direction, &out);
                add(&mut out, -along, direction);
            }
            out
        };
        let mut all = complement(&[], dim);
        all.iter_mut().for_each(heard);
        let span = |part: &dyn Fn(&[f64]) -> Vec<f64>| {
            let images: Vec<Vec<f64>> = all.iter().map(|x| part(x)).filter(|x| norm(x) > 1e-6).collect();
            basis(&images.iter().map(Vec::as_slice).collect::<Vec<_>>(), 1e-6)
        };
        let Some(axis) = isotropy.mirror else { return vec![span(&breaking)] };
        let reflect = |x: &[f64]| {
            let mut out = x.to_vec();
            body.mirror(&mut out);
            body.rotate(axis, &mut out);
            out
        };
        let half = |sign: f64| {
            move |x: &[f64]| {
                let mut out = breaking(x);
                let mirrored = reflect(&out);
                out.iter_mut().for_each(|x| *x *= 0.5);
                add(&mut out, 0.5 * sign, &mirrored);
                out
            }
        };
        vec![span(&half(1.0)), span(&half(-1.0))]
    }
}
