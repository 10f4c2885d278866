//! Functions of all levels of a class that are smooth along a branch and vanish where levels pass 0.

use super::levels::Level;
use std::f64::consts::{PI, TAU};

/// The function that vanishes where a level is critical. Levels ranked by their growth have kinks where they change places and where a pair
/// becomes real; these functions of the matrix have none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Smooth {
    /// `prod_j lambda_j`, or `prod_j (mu_j - 1)` for multipliers.
    Steady,
    /// `prod_j (mu_j + 1)`.
    Flip,
    /// `prod_(j<k) (lambda_j + lambda_k)`, or `prod_(j<k) (mu_j mu_k - 1)`.
    Pair,
}

/// A real number: its sign and the logarithm of its modulus.
pub(super) type Number = (f64, f64);

impl Smooth {
    /// Those that are asked for eigenvalues, or for multipliers.
    pub(super) const fn all(orbits: bool) -> &'static [Self] {
        if orbits { &[Self::Steady, Self::Flip, Self::Pair] } else { &[Self::Steady, Self::Pair] }
    }

    /// Its value; `levels` contain the conjugate of each that is not real.
    ///
    /// Source: Kuznetsov (2004), Elements of Applied Bifurcation Theory, section 10.2 (the bialternate product).
    pub(super) fn value(self, levels: &[Level], orbits: bool) -> Number {
        let one = |level: &Level| match (self, orbits) {
            (Self::Flip, _) => multiplier(level.growth, level.angle - PI.copysign(level.angle)),
            (_, true) => multiplier(level.growth, level.angle),
            (_, false) => eigenvalue(level.growth, level.angle),
        };
        if self != Self::Pair {
            return product(levels.iter().map(one));
        }
        let pairs = levels.iter().enumerate().flat_map(|(j, a)| levels[j + 1..].iter().map(move |b| (a, b)));
        product(pairs.map(|(a, b)| {
            let (growth, angle) = (a.growth + b.growth, a.angle + b.angle);
            if orbits { multiplier(growth, angle) } else { eigenvalue(growth, angle) }
        }))
    }
}

fn product(factors: impl Iterator<Item = Number>) -> Number {
    factors.fold((1.0, 0.0), |all, one| (all.0 * one.0, all.1 + one.1))
}

/// Of `growth + i angle`; the sign belongs to real numbers, and the conjugate of others is another factor.
fn eigenvalue(growth: f64, angle: f64) -> Number {
    let sign = if angle == 0.0 { growth.signum() } else { 1.0 };
    (sign, libm::hypot(growth, angle).ln())
}

/// Of `exp(growth + i angle) - 1`, up to the sign of all, which does not change.
fn multiplier(growth: f64, angle: f64) -> Number {
    let turned = angle - TAU * (angle / TAU).round();
    let (sin, cos) = libm::sincos(0.5 * turned);
    // |exp(g + i a) - 1| = 2 exp(g/2) |sinh((g + i a)/2)|
    let size = libm::hypot(libm::sinh(0.5 * growth) * cos, libm::cosh(0.5 * growth) * sin);
    (if turned == 0.0 { growth.signum() } else { 1.0 }, 0.5 * growth + (2.0 * size).ln())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    fn levels(values: &[(f64, f64)], orbits: bool) -> Vec<Level> {
        let of = |&(re, im): &(f64, f64)| {
            if orbits {
                let angle = if im == 0.0 && re < 0.0 { PI } else { im.atan2(re) };
                Level { growth: re.hypot(im).ln(), angle }
            } else {
                Level { growth: re, angle: im }
            }
        };
        values.iter().map(of).collect()
    }

    /// Determinants of matrices with these eigenvalues.
    #[test]
    fn products_are_determinants() {
        let block = |a: f64, b: f64, c: f64, d: f64| {
            DMatrix::from_row_slice(
                4,
                4,
                &[a, -b, 0.3, 0.0, b, a, 0.0, 0.2, 0.0, 0.0, c, 0.0, 0.0, 0.0, 0.4, d],
            )
        };
        for (a, b, c, d) in [(0.5, 0.7, -1.4, 2.0), (-1.2, 0.1, 0.3, -0.4), (0.9, 1.1, 1.5, -2.5)] {
            let matrix = block(a, b, c, d);
            let values = [(a, b), (a, -b), (c, 0.0), (d, 0.0)];
            let sure = |found: Number, expected: f64| {
                let off = found.1 - expected.abs().ln();
                assert!(found.0 == expected.signum() && off.abs() < 1e-12, "{found:?} {expected}");
            };
            sure(Smooth::Steady.value(&levels(&values, false), false), matrix.determinant());
            let pairs = 2.0 * a * (c + d) * ((a + c).powi(2) + b * b) * ((a + d).powi(2) + b * b);
            sure(Smooth::Pair.value(&levels(&values, false), false), pairs);
            let less = |by: f64| (&matrix - by * DMatrix::identity(4, 4)).determinant();
            let of = |smooth: Smooth| smooth.value(&levels(&values, true), true);
            let sign = |values: &[f64]| values.iter().map(|x| x.signum()).product::<f64>();
            assert!((of(Smooth::Steady).1 - less(1.0).abs().ln()).abs() < 1e-12);
            assert!((of(Smooth::Flip).1 - less(-1.0).abs().ln()).abs() < 1e-12);
            let positive: Vec<f64> = [c, d].into_iter().filter(|x| *x > 0.0).map(|x| x - 1.0).collect();
            assert_eq!(of(Smooth::Steady).0, sign(&positive));
            let negative: Vec<f64> = [c, d].into_iter().filter(|x| *x < 0.0).map(|x| -x - 1.0).collect();
            assert_eq!(of(Smooth::Flip).0, sign(&negative));
        }
    }
}
