//! The point where two branches cross, as the solution of equations that are regular there.

use super::correct::TIGHT;
use super::family::apart;
use super::problem::{Equations, Failure, Linear};
use motiform_analysis::singular::svd;
use motiform_dynamics::Watch;
use nalgebra::{DMatrix, DVector};

/// Most steps of Newton's method, and the step (in the units of the unknowns) with which it has converged.
const STEPS: usize = 12;
const CONVERGED: f64 = 1e-12;

/// Steps that round-off of the equations leaves are below so many times its error.
const LEFT: f64 = 10.0;

/// The error that round-off of the equations leaves in a branch point, in the units of the unknowns, by the differences that are its
/// derivatives.
pub(super) fn blurred<P: Equations>(problem: &P) -> f64 {
    problem.resolution() / distance(problem)
}

/// The distance of differences.
fn distance<P: Equations>(problem: &P) -> f64 {
    apart(DIFFERENCE, problem.resolution())
}

/// Half the distance of central differences of the Jacobian, in the units of the unknowns.
const DIFFERENCE: f64 = 1e-5;

/// The branch point near `x`, by Newton's method for `x`, a left null vector `psi` and a number `b`, which is 0 there:
///
/// `F(x) + b psi = 0`, `DF(x)^T psi = 0`, `psi . psi = 1`.
///
/// Next to a branch point the equations of a branch themselves are nearly singular, and the more so the smaller the angle between the
/// branches; these are regular. `None` where they have no solution nearby.
///
/// Source: Moore (1980), Numer. Funct. Anal. Optim. 2, 441; Griewank and Reddien (1984), SIAM J. Numer. Anal. 21, 176.
pub(super) fn branch_point<P: Equations>(problem: &P, x: &[f64], watch: &dyn Watch) -> Option<Vec<f64>> {
    let units: Vec<f64> = problem.weights(x).iter().map(|weight| 1.0 / weight.sqrt()).collect();
    let local = problem.local(x, watch).ok()?;
    let start = scaled(problem.linear(&local), &units);
    let rows = start.nrows();
    let svd = svd(start)?;
    let (least, _) = svd.singular_values.argmin();
    let mut psi: DVector<f64> = svd.u?.column(least).into_owned();
    let (mut x, mut b, mut last) = (x.to_vec(), 0.0, f64::INFINITY);
    // towards a crossing of high order steps shrink as slowly without any round-off
    let (noisy, blurred) = (problem.resolution() > TIGHT, LEFT * blurred(problem));
    for _ in 0..STEPS {
        let step = step(problem, &x, (&psi, b), &units, watch).ok()??;
        let moved: f64 = step.rows(0, units.len()).norm();
        x.iter_mut().zip(&units).zip(step.iter()).for_each(|((x, unit), d)| *x += unit * d);
        psi += step.rows(units.len(), rows);
        b += step[units.len() + rows];
        let stalled = noisy && moved < blurred && moved > 0.1 * last;
        last = moved;
        if moved < CONVERGED.max(LEFT * problem.resolution()) || stalled {
            problem.tidy(&mut x);
            return Some(x);
        }
    }
    None
}

/// The Jacobian by unknowns of unit size.
fn scaled(linear: &Linear, units: &[f64]) -> DMatrix<f64> {
    let mut matrix = linear.matrix.clone();
    units.iter().enumerate().for_each(|(j, unit)| matrix.column_mut(j).scale_mut(*unit));
    matrix
}

/// One step: changes of the unknowns (in units), of `psi` and of `b`; `None` where the system is singular.
fn step<P: Equations>(
    problem: &P,
    x: &[f64],
    (psi, b): (&DVector<f64>, f64),
    units: &[f64],
    watch: &dyn Watch,
) -> Result<Option<DVector<f64>>, Failure> {
    let local = problem.local(x, watch)?;
    let linear = problem.linear(&local);
    let jacobian = scaled(linear, units);
    let (rows, columns) = jacobian.shape();
    let apart = distance(problem);
    let mut all = DMatrix::zeros(rows + columns + 1, rows + columns + 1);
    all.view_mut((0, 0), (rows, columns)).copy_from(&jacobian);
    all.view_mut((0, columns), (rows, rows)).fill_diagonal(b);
    all.view_mut((0, columns + rows), (rows, 1)).copy_from(psi);
    for (j, unit) in units.iter().enumerate() {
        let at = |side: f64| -> Result<DVector<f64>, Failure> {
            let mut moved = x.to_vec();
            moved[j] += side * apart * unit;
            let local = problem.local(&moved, watch)?;
            Ok(scaled(problem.linear(&local), units).tr_mul(psi))
        };
        let change = (at(1.0)? - at(-1.0)?) / (2.0 * apart);
        all.view_mut((rows, j), (columns, 1)).copy_from(&change);
    }
    all.view_mut((rows, columns), (columns, rows)).copy_from(&jacobian.transpose());
    all.view_mut((rows + columns, columns), (1, rows)).copy_from(&(2.0 * psi.transpose()));
    let mut target = DVector::zeros(rows + columns + 1);
    let residual = DVector::from_column_slice(&linear.residual);
    target.rows_mut(0, rows).copy_from(&-(residual + b * psi));
    target.rows_mut(rows, columns).copy_from(&-jacobian.tr_mul(psi));
    target[rows + columns] = 1.0 - psi.norm_squared();
    Ok(all.lu().solve(&target))
}
