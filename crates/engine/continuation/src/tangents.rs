//! The tangents of two branches that cross.

use super::correct::{crossing, product, scaled};
use super::point::Point;
use super::problem::Problem;
use motiform_analysis::linear::{add, dot};
use motiform_analysis::singular::svd;

/// Least distance of the second differences, in the units of the unknowns.
const STEP: f64 = 1e-3;

/// The entries that are shapes, of a direction in the unknowns of a problem.
fn shapes<P: Problem>(problem: &P, direction: &[f64]) -> usize {
    problem.time().unwrap_or(direction.len() - 2)
}

/// Weight of the change of the unknowns that are no shapes: that of a turning rate is of the problem's unit of rates; the relative change
/// of a period and angles have no unit.
fn of_others<P: Problem>(problem: &P, weights: &[f64], count: usize) -> f64 {
    if problem.time().is_none() { weights[count] } else { 1.0 }
}

/// A direction as in [`Point::tangent`].
pub(super) fn changes<P: Problem>(problem: &P, x: &[f64], direction: &[f64]) -> [f64; 3] {
    let (weights, last) = (problem.weights(x), direction.len() - 1);
    let count = shapes(problem, direction);
    let square = dot(&direction[..count], &direction[..count]) / count as f64;
    let [others, own] = [direction, &weights].map(|all| &all[count..last]);
    let others = product(own, others, others) / of_others(problem, &weights, count);
    [direction[last].abs(), square.sqrt(), others.sqrt()]
}

/// The slope of a point's own branch, without its sign, in the units of a problem: the branch may have been followed from shapes of another
/// size.
pub(super) fn own_slope<P: Problem>(problem: &P, x: &[f64], point: &Point) -> f64 {
    let Some([change, shape, others]) = point.tangent else { return point.slope.abs() };
    let (weights, count) = (problem.weights(x), shapes(problem, x));
    let all: f64 = weights[..count].iter().sum();
    let along = weights.last().map_or(f64::NAN, |weight| weight * change * change);
    change / (along + all * shape * shape + of_others(problem, &weights, count) * others * others).sqrt()
}

/// The tangents, of length 1, of the branches that cross at `x`, where `equations(x + v)` vanishes to first order for `v` in a plane: the
/// two directions of this plane in which it vanishes to second order,
///
/// `psi . D^2 F(x)[v, v] = 0`, with the left null vector `psi` of `DF`.
///
/// Empty where the plane is none or no real direction solves this.
///
/// Source: Keller (1977), in: Applications of Bifurcation Theory, the algebraic bifurcation equation.
pub(super) fn tangents<P: Problem>(problem: &P, x: &[f64]) -> Vec<Vec<f64>> {
    let weights = problem.weights(x);
    let Some(Plane { a, b, psi, here }) = Plane::at(problem, x, &weights) else { return Vec::new() };
    let step = STEP.max(problem.resolution().sqrt().sqrt()); // where errors by round-off and by terms of fourth order are alike
    let seen = |v: &[f64]| {
        let at = |side: f64| {
            let mut moved = x.to_vec();
            add(&mut moved, side * step, v);
            Some(dot(&psi, &problem.linear(&problem.local(&moved, &()).ok()?).residual))
        };
        Some((at(1.0)? + at(-1.0)? - 2.0 * here) / (step * step))
    };
    let mixed = |side: f64| {
        let mut v = a.clone();
        add(&mut v, side, &b);
        seen(&v)
    };
    let (Some(aa), Some(bb), Some(sum), Some(difference)) = (seen(&a), seen(&b), mixed(1.0), mixed(-1.0))
    else {
        return Vec::new();
    };
    let ab = 0.25 * (sum - difference);
    let combined = |(alpha, beta): (f64, f64)| {
        let mut v: Vec<f64> = a.iter().map(|x| alpha * x).collect();
        add(&mut v, beta, &b);
        scaled(v, &weights)
    };
    roots(aa, ab, bb).into_iter().filter_map(combined).collect()
}

/// The directions `(alpha, beta)` with `aa alpha^2 + 2 ab alpha beta + bb beta^2 = 0`.
fn roots(aa: f64, ab: f64, bb: f64) -> Vec<(f64, f64)> {
    let under = ab * ab - aa * bb;
    if under.is_nan() || under <= 0.0 {
        return Vec::new();
    }
    let larger = -(ab + under.sqrt().copysign(ab));
    vec![(larger, aa), (bb, larger)]
}

/// The two directions that the equations see least, where they do not see them to first order.
struct Plane {
    /// An orthonormal basis.
    a: Vec<f64>,
    b: Vec<f64>,
    /// The left null vector.
    psi: Vec<f64>,
    /// The residual of the equations along it.
    here: f64,
}

impl Plane {
    fn at<P: Problem>(problem: &P, x: &[f64], weights: &[f64]) -> Option<Self> {
        let local = problem.local(x, &()).ok()?;
        let linear = problem.linear(&local);
        let null = crossing(problem, &local, weights);
        let [a, b, ..] = &null[..] else { return None };
        let svd = svd(linear.matrix.clone())?;
        let (least, _) = svd.singular_values.argmin();
        let psi: Vec<f64> = svd.u?.column(least).iter().copied().collect();
        let here = dot(&psi, &linear.residual);
        Some(Self { a: a.clone(), b: b.clone(), psi, here })
    }
}

#[cfg(test)]
mod tests {
    use super::roots;

    #[test]
    fn both_roots_whichever_coefficient_vanishes() {
        for (aa, ab, bb) in
            [(1.0, 0.0, -4.0), (0.0, 1.0, 0.0), (0.0, 1.0, 3.0), (2.0, -3.0, 1.0), (1.0, 2.0, 0.0)]
        {
            let found = roots(aa, ab, bb);
            assert_eq!(found.len(), 2);
            for (x, y) in &found {
                let size = x * x + y * y;
                assert!((aa * x * x + 2.0 * ab * x * y + bb * y * y).abs() < 1e-12 * size && size > 0.0);
            }
            let cross = found[0].0 * found[1].1 - found[0].1 * found[1].0;
            assert!(cross.abs() > 0.1, "{found:?}");
        }
        assert!(roots(1.0, 0.5, 1.0).is_empty() && roots(0.0, 0.0, 0.0).is_empty());
    }
}
