//! All steady motions at one value of the parameter, by Newton's method from many random states.

use super::curve::LARGEST;
use super::text::Text;
use crate::common::Random;
use nalgebra::{DMatrix, DVector};

/// A steady motion: its state and its turning rate.
pub(super) type Found = (DVector<f64>, f64);

/// The motions found from `starts` random states, each once.
pub(super) fn everything(text: &Text, p: f64, starts: usize, random: &mut Random) -> Vec<Found> {
    let dim = text.dim();
    let mut all: Vec<Found> = Vec::new();
    for start in 0..starts {
        let size = 2.0 * random.between(0.0, 1.0);
        // some amplitudes are left out of some starts: motions of more symmetry are found too
        let mask = if start % 2 == 0 {
            vec![1.0; dim]
        } else {
            (0..dim).map(|_| f64::from(u8::from(random.next() > 0.0))).collect()
        };
        let guess = DVector::from_fn(dim, |i, _| size * mask[i] * random.next());
        let Some(found) = solve(text, guess, p).filter(|found| is_alone(text, found, p)) else { continue };
        let same = |other: &Found| distance(text, &other.0, &found.0) < 1e-6;
        if found.0.norm() < LARGEST && !all.iter().any(same) {
            all.push(found);
        }
    }
    all
}

/// Of the quantities that symmetry leaves.
pub(super) fn distance(text: &Text, a: &DVector<f64>, b: &DVector<f64>) -> f64 {
    apart(&text.invariants(a), &text.invariants(b))
}

/// The largest difference.
pub(super) fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Returns `true` if the motion has no neighbours at the same value of the parameter but its own images. (Terms that are missing by chance
/// may leave a symmetry that the text does not name.)
fn is_alone(text: &Text, (u, omega): &Found, p: f64) -> bool {
    let dim = text.dim();
    let mut all = DMatrix::zeros(dim, dim + 1);
    let by_u = text.rate(u, p).1;
    for j in 0..dim {
        let mut unit = DVector::zeros(dim);
        unit[j] = 1.0;
        all.set_column(j, &(by_u.column(j) - *omega * text.spin(&unit)));
    }
    all.set_column(dim, &text.spin(u));
    all.singular_values().min() > 1e-7
}

/// The shortest steps that solve `f - omega G u = 0` to first order, none longer than 1.
fn solve(text: &Text, mut u: DVector<f64>, p: f64) -> Option<Found> {
    let dim = text.dim();
    let mut omega = 0.0;
    if text.rotates() {
        let spin = text.spin(&u);
        omega = text.rate(&u, p).0.dot(&spin) / spin.norm_squared().max(1e-12);
    }
    for _ in 0..60 {
        let (rate, by_u, _) = text.rate(&u, p);
        let spin = text.spin(&u);
        let left = rate - omega * &spin;
        let mut all = DMatrix::zeros(dim, dim + 1);
        for j in 0..dim {
            let mut unit = DVector::zeros(dim);
            unit[j] = 1.0;
            all.set_column(j, &(by_u.column(j) - omega * text.spin(&unit)));
        }
        all.set_column(dim, &(-&spin));
        let weights = (&all * all.transpose()).lu().solve(&left)?;
        let change = -(all.transpose() * weights);
        let length = change.norm();
        if !length.is_finite() {
            return None;
        }
        let part = if length > 1.0 { 1.0 / length } else { 1.0 };
        u += part * change.rows(0, dim);
        omega += part * change[dim];
        if length < 1e-12 {
            return Some((u, if text.rotates() { omega } else { 0.0 }));
        }
    }
    None
}
