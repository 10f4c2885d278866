//! Sizes at which the terms of the equations balance.

use crate::linear::norm;
use motiform_dynamics::Equivariant;
use motiform_dynamics::sample::ascending;

/// Powers of 2 between which sizes are looked at.
const POWERS: std::ops::RangeInclusive<i32> = -40..=40;

/// A rate below this part of that of the whole shape may be round-off: a coefficient that vanishes at a bifurcation, terms that cancel.
const ROUND_OFF: f64 = 1e-13;

/// A slope is that of one term if it is this close to a whole number.
const WHOLE: f64 = 0.1;

/// The sizes at which terms of different degree balance along these directions, ascending.
///
/// Along a ray `t w` every equation is a sum of powers of t. The slope `d ln|f_i(t w)| / d ln t` is a whole number wherever one power
/// dominates, and two of them balance where it changes. This needs nothing but values of f, and also finds sizes at which terms of equal
/// sign balance: other equations may have roots there. Linear equations have none.
///
/// # Checked by  tests/all/deflation.rs: a field with a known balance, in any units
pub fn balances(body: &dyn Equivariant, directions: &[Vec<f64>]) -> Vec<f64> {
    let mut sizes: Vec<f64> =
        directions.iter().filter(|ray| norm(ray) > 0.0).flat_map(|ray| along(body, ray)).collect();
    ascending(&mut sizes);
    sizes
}

/// The same along one direction.
fn along(body: &dyn Equivariant, ray: &[f64]) -> Vec<f64> {
    beside(body, &vec![0.0; ray.len()], &[], ray, 1.0, f64::NEG_INFINITY).concat()
}

/// The sizes of changes of a shape at which terms balance along a ray, for each equation, from changes by the unit times powers of 2. Rates
/// of no more than their `noise` say nothing; without noise those of the shape 0 are exact. The larger of two terms that balance is of at
/// least the degree `least`.
pub(super) fn beside(
    body: &dyn Equivariant,
    shape: &[f64],
    noise: &[f64],
    ray: &[f64],
    unit: f64,
    least: f64,
) -> Vec<Vec<f64>> {
    let length = norm(ray);
    let rate = |power: i32| {
        let t = unit * libm::exp2(f64::from(power));
        let at: Vec<f64> = shape.iter().zip(ray).map(|(u, w)| u + w / length * t).collect();
        body.rates(&at)
    };
    let rates: Vec<Vec<f64>> = POWERS.map(rate).collect();
    let seen = |rate: &[f64], i: usize| {
        let value: f64 = rate[i].abs();
        let least = (ROUND_OFF * norm(rate)).max(noise.get(i).copied().unwrap_or(0.0));
        if value > least { value } else { f64::NAN }
    };
    let of = |i: usize| changes(&rates.iter().map(|rate| seen(rate, i)).collect::<Vec<_>>(), least);
    (0..ray.len()).map(|i| of(i).into_iter().map(|size| unit * size).collect()).collect()
}

/// The powers of 2 at which the logarithmic slope of these values, taken at successive powers of 2, grows
/// from one whole number to another of at least `least`.
fn changes(values: &[f64], least: f64) -> Vec<f64> {
    let slope = |(power, pair): (i32, &[f64])| (f64::from(power) + 0.5, libm::log2(pair[1] / pair[0]));
    let of_one_term = |&(_, slope): &(f64, f64)| slope.is_finite() && (slope - slope.round()).abs() < WHOLE;
    let slopes: Vec<(f64, f64)> = POWERS.zip(values.windows(2)).map(slope).filter(of_one_term).collect();
    let grows = |pair: &[(f64, f64)]| {
        let (before, beyond) = (pair[0].1.round(), pair[1].1.round());
        (before < beyond && beyond >= least).then(|| libm::exp2(0.5 * (pair[0].0 + pair[1].0)))
    };
    slopes.windows(2).filter_map(grows).collect()
}
