//! The weak-form estimate: a cheap witness beside the likelihood.
//!
//! With a smooth test function phi that vanishes at both ends of a window, integration by parts leaves no derivative of noisy data:
//!
//! ```text
//! - int phi' z_n dt = sum_k c_k int phi M_k dt,        n = 2, 3, ..
//!   int phi'' (x - i y) dt = sum_k c_k int phi M_k dt, n = 1  (z1 = x' - i y')
//! ```
//!
//! Least squares over windows; the velocity inside of `M_k` comes from a parabola through five frames. Process noise adds
//! `eta int phi dW` to the left side, which goes with `int phi M_k` and not away with more frames. Of a stationary process that noise
//! sustains (`dz = -c z dt + eta dW`) the estimate is 0: the left side is odd in time, and the correlations are even. So an equation has
//! coefficients where noise makes at most a tenth of the mean square of its left side without the part of the errors of the observations;
//! what the terms explain is then wrong by at most `sqrt(0.1)` of the left side (Cauchy and Schwarz). It is a check of sign and order of
//! magnitude of the large terms, and no estimate to quote.
//!
//! Source: Messenger and Bortz (2021), Multiscale Model. Simul. 19, 1474.

use crate::field::{Field, Values};
use crate::filter::Frame;
use crate::{Library, Result, Scales, Track, observation};
use motiform_dynamics::Complex;
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use serde::{Deserialize, Serialize};

/// A window's half-width in natural units of time.
const HALF: f64 = 1.5;
/// Fewest frames on each side of a window's centre.
const LEAST: usize = 4;

/// Largest share of noise in the mean square of the left sides of an equation.
const MOST_NOISE: f64 = 0.1;
/// Integral of the square of the test function over its half-width: int (1 - u^2)^8 du = 2^17 (8!)^2/17!.
const SQUARE: f64 = 65536.0 / 109_395.0;

/// Coefficients of the weak form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Weak {
    /// Names of the terms.
    pub names: Vec<String>,
    /// Real coefficients in the units of the data; `None` where their equation has none.
    pub coefficients: Vec<Option<f64>>,
    /// The reasons of the equations that have none.
    pub reasons: Vec<String>,
    /// Windows used.
    pub windows: usize,
}

/// Real coefficients by the weak form, beside noise of these amplitudes (of the velocity and of the modes, in the units of the data);
/// tracks with gaps contribute the windows without any.
///
/// # Errors    of the input, as [`crate::fit()`]
/// # Checked by  `tests/all/weak.rs`: exact tracks; none of what noise sustains
pub fn weak(tracks: &[Track], library: &Library, noise: [f64; 2]) -> Result<Weak> {
    crate::fit::check_library(library)?;
    observation::check(tracks, library.modes)?;
    let scales = Scales::of(tracks, library.modes);
    let field = Field::new(library);
    let mut sums: Vec<Normal> = (0..library.modes).map(|n| Normal::new(library.of_equation(n))).collect();
    let add = match library.modes {
        2 => add_track::<4>,
        4 => add_track::<8>,
        _ => add_track::<6>,
    };
    let windows = tracks.iter().map(|track| add(&mut sums, &field, track, &scales)).sum();
    let mut coefficients = vec![None; library.terms.len()];
    let mut reasons = Vec::new();
    for (n, sum) in sums.iter().enumerate() {
        let eta = noise[n.min(1)] * scales.time.sqrt() / scales.amplitudes[n];
        match sum.solution(eta) {
            Ok(found) => sum.terms.iter().zip(found).for_each(|(&term, c)| coefficients[term] = Some(c)),
            Err(why) => reasons.push(format!("equation of z{}: {why}", n + 1)),
        }
    }
    for (c, term) in coefficients.iter_mut().zip(&library.terms) {
        *c = c.map(|c: f64| c * scales.coefficient(term));
    }
    Ok(Weak { names: library.names(), coefficients, reasons, windows })
}

/// Adds the windows of a track that have no gap; returns their number.
fn add_track<const SHAPE: usize>(
    sums: &mut [Normal],
    field: &Field,
    track: &Track,
    scales: &Scales,
) -> usize {
    let frames = scales.frames(track);
    let dt = track.interval() / scales.time;
    let half = ((HALF / dt).round() as usize).max(LEAST);
    let shapes = shapes::<SHAPE>(&frames, dt);
    let mut windows = 0;
    for centre in (half + 2..frames.len().saturating_sub(half + 2)).step_by((half / 2).max(1)) {
        let range = centre - half..=centre + half;
        let span = frames[centre + half + 2].t - frames[centre - half - 2].t;
        if (span - (2 * half + 4) as f64 * dt).abs() < 1e-6 * span {
            windows += 1;
            add(sums, field, &frames[range.clone()], &shapes[range], dt);
        }
    }
    windows
}

/// Normal equations of one equation.
struct Normal {
    terms: Vec<usize>,
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    /// Sum of the squares of the left sides.
    left: f64,
    /// Sum of the integrals of the squared test functions, of both parts of the amplitude, over the square of the interval, as sums over
    /// frames have it.
    test: f64,
    /// Expected sum of the squares of what the errors of the observations add to the left sides.
    errors: f64,
}

impl Normal {
    fn new(terms: Vec<usize>) -> Self {
        let n = terms.len();
        Self {
            terms,
            matrix: DMatrix::zeros(n, n),
            right: DVector::zeros(n),
            left: 0.0,
            test: 0.0,
            errors: 0.0,
        }
    }

    fn add(&mut self, integrals: &[Complex<f64>], left: Complex<f64>, errors: f64, test: f64) {
        self.left += left.re * left.re + left.im * left.im;
        self.errors += errors;
        self.test += test;
        let row = |part: fn(&Complex<f64>) -> f64| {
            DVector::from_iterator(self.terms.len(), self.terms.iter().map(|&term| part(&integrals[term])))
        };
        for (row, left) in [(row(|z| z.re), left.re), (row(|z| z.im), left.im)] {
            self.matrix.ger(1.0, &row, &row, 1.0);
            self.right.axpy(left, &row, 1.0);
        }
    }

    /// The coefficients beside noise of this amplitude, or why there are none.
    fn solution(&self, eta: f64) -> std::result::Result<Vec<f64>, String> {
        let noise = eta * eta * self.test / (self.left - self.errors).max(f64::MIN_POSITIVE);
        if !self.terms.is_empty() && noise > MOST_NOISE {
            return Err(format!(
                "noise makes {:.0} % of the mean square of its rates over a window, above {:.0} %, and biases the estimate towards 0",
                100.0 * noise.min(1.0),
                100.0 * MOST_NOISE
            ));
        }
        self.solve().ok_or_else(|| "the windows do not determine its coefficients".to_owned())
    }

    fn solve(&self) -> Option<Vec<f64>> {
        let n = self.terms.len();
        if n == 0 {
            return Some(Vec::new()); // an equation without terms
        }
        let scale: Vec<f64> = (0..n).map(|i| self.matrix[(i, i)].sqrt()).collect();
        if scale.iter().any(|s| *s <= 0.0 || !s.is_finite()) {
            return None;
        }
        let scaled = DMatrix::from_fn(n, n, |i, j| self.matrix[(i, j)] / (scale[i] * scale[j]));
        let right = DVector::from_fn(n, |i, _| self.right[i] / scale[i]);
        let eigen = SymmetricEigen::new(scaled);
        if eigen.eigenvalues.min() < 1e-12 * eigen.eigenvalues.max() {
            return None;
        }
        let along = (eigen.eigenvectors.transpose() * right).component_div(&eigen.eigenvalues);
        let solution = eigen.eigenvectors * along;
        Some((0..n).map(|i| solution[i] / scale[i]).collect())
    }
}

/// The shape of each frame; the velocity is the slope of the parabola through five frames.
fn shapes<const SHAPE: usize>(frames: &[Frame], dt: f64) -> Vec<[f64; SHAPE]> {
    let at = |k: usize, i: usize| frames[k.min(frames.len() - 1)].y[i];
    let slope = |k: usize, i: usize| {
        let (far, near) =
            (at(k + 2, i) - at(k.saturating_sub(2), i), at(k + 1, i) - at(k.saturating_sub(1), i));
        (2.0 * far + near) / (10.0 * dt)
    };
    let of = |k: usize| {
        let mut shape: [f64; SHAPE] = std::array::from_fn(|i| frames[k].y[i]);
        (shape[0], shape[1]) = (slope(k, 0), -slope(k, 1));
        shape
    };
    (0..frames.len()).map(of).collect()
}

/// Adds a window: the test function `(1 - u^2)^4`, u from -1 to 1, and the rule of the trapezium.
fn add<const SHAPE: usize>(
    sums: &mut [Normal],
    field: &Field,
    frames: &[Frame],
    shapes: &[[f64; SHAPE]],
    dt: f64,
) {
    let half = (frames.len() / 2) as f64;
    let width = half * dt;
    let mut values = Values::new(field);
    let zero = Complex::new(0.0, 0.0);
    let origin = [0, 1].map(|axis| frames[frames.len() / 2].y[axis]);
    let c = vec![zero; values.monomials.len()];
    let (mut integrals, mut left) = (c.clone(), vec![(zero, 0.0); SHAPE / 2]);
    for (k, (frame, shape)) in frames.iter().zip(shapes).enumerate() {
        let u = (k as f64 - half) / half;
        let w = 1.0 - u * u;
        let phi = w.powi(4);
        let first = -8.0 * u * w.powi(3) / width;
        let second = (48.0 * u * u * w * w - 8.0 * w.powi(3)) / (width * width);
        field.rate(&c, shape, &mut values);
        for (integral, monomial) in integrals.iter_mut().zip(&values.monomials) {
            *integral += *monomial * phi;
        }
        // the sum of phi'' is 0 but for the rule of integration: far from the origin this rest would be a rate
        left[0].0 += Complex::new(frame.y[0] - origin[0], origin[1] - frame.y[1]) * second;
        for n in 1..SHAPE / 2 {
            left[n].0 += Complex::new(shape[2 * n], shape[2 * n + 1]) * -first;
        }
        for (n, left) in left.iter_mut().enumerate() {
            let weight = if n == 0 { second } else { first };
            left.1 +=
                weight * weight * (frame.covariance[2 * n][2 * n] + frame.covariance[2 * n + 1][2 * n + 1]);
        }
    }
    for (sum, (left, errors)) in sums.iter_mut().zip(left) {
        sum.add(&integrals, left, errors, 2.0 * SQUARE * width / (dt * dt));
    }
}
