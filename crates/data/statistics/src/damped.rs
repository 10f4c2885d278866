//! Least squares of a damped cosine, by Levenberg's and Marquardt's method.

use motiform_analysis::linear::solve;

/// Most steps: from each start, and from the best end.
const STEPS: [usize; 2] = [12, 40];

/// Least ratio of singular values of the normal equations.
const SINGULAR: f64 = 1e-14;

/// A relative step below which the minimum is reached.
const CONVERGED: f64 = 1e-7;

/// `e^{-lambda k} (a cos omega k + b sin omega k)` at the places k = 0, 1, ...
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Damped {
    /// Decay per place.
    pub(crate) lambda: f64,
    /// Angle per place.
    pub(crate) omega: f64,
    /// Part of the cosine.
    pub(crate) a: f64,
    /// Part of the sine.
    pub(crate) b: f64,
}

/// The sum of squares (the first one half, so that it is an integral by the trapezoidal rule), with its
/// normal equations: J^T J and J^T r for (lambda, omega, a, b).
struct Normal {
    cost: f64,
    matrix: [[f64; 4]; 4],
    right: [f64; 4],
}

impl Normal {
    /// The step of the damped normal equations, in units in which their diagonal is 1; `None` if they are singular.
    fn step(&self, damping: f64) -> Option<[f64; 4]> {
        let scale: [f64; 4] = std::array::from_fn(|k| self.matrix[k][k].sqrt().max(f64::MIN_POSITIVE));
        let entry = |row: usize, column: usize| {
            let more = if row == column { 1.0 + damping } else { 1.0 };
            more * self.matrix[row][column] / (scale[row] * scale[column])
        };
        let columns: Vec<Vec<f64>> =
            (0..4).map(|column| (0..4).map(|row| entry(row, column)).collect()).collect();
        let right: Vec<f64> = (0..4).map(|k| self.right[k] / scale[k]).collect();
        let found = solve(&columns, &right, SINGULAR)?;
        Some(std::array::from_fn(|k| found[k] / scale[k]))
    }
}

impl Damped {
    fn normal(&self, values: &[f64]) -> Normal {
        let mut found = Normal { cost: 0.0, matrix: [[0.0; 4]; 4], right: [0.0; 4] };
        let size = libm::exp(-self.lambda);
        let turn = [size * libm::cos(self.omega), size * libm::sin(self.omega)];
        let [mut c, mut s] = [1.0, 0.0];
        for (place, value) in values.iter().enumerate() {
            let k = place as f64;
            let (form, quarter) = (self.a * c + self.b * s, self.b * c - self.a * s);
            let residual = value - form;
            let slopes = [-k * form, k * quarter, c, s];
            let weight = if place == 0 { 0.5 } else { 1.0 };
            found.cost += weight * residual * residual;
            for (i, one) in slopes.iter().enumerate() {
                found.right[i] += weight * one * residual;
                for (entry, other) in found.matrix[i].iter_mut().zip(slopes) {
                    *entry += weight * one * other;
                }
            }
            (c, s) = (c * turn[0] - s * turn[1], c * turn[1] + s * turn[0]);
        }
        found
    }

    /// The same function, its place 0 at this one.
    pub(crate) fn at(&self, place: f64) -> Self {
        let (size, angle) = (libm::exp(-self.lambda * place), self.omega * place);
        let (c, s) = (size * libm::cos(angle), size * libm::sin(angle));
        Self { a: self.a * c + self.b * s, b: self.b * c - self.a * s, ..*self }
    }

    fn plus(&self, step: [f64; 4]) -> Self {
        let [lambda, omega, a, b] = step;
        Self { lambda: self.lambda + lambda, omega: self.omega + omega, a: self.a + a, b: self.b + b }
    }

    /// A sign of omega is none of the form: it goes to b.
    fn positive(self) -> Self {
        if self.omega < 0.0 { Self { omega: -self.omega, b: -self.b, ..self } } else { self }
    }
}

/// The nearest damped cosine from these starts; `None` if no start leads to a minimum.
pub(crate) fn fit(values: &[f64], starts: &[Damped]) -> Option<Damped> {
    let ends = starts.iter().filter_map(|start| descend(values, *start, STEPS[0]));
    let best = ends.min_by(|one, other| one.1.total_cmp(&other.1))?;
    Some(descend(values, best.0, STEPS[1])?.0.positive())
}

/// Root mean square of `values - form` over that of the values.
pub(crate) fn deviation(values: &[f64], found: &Damped) -> f64 {
    let squares: f64 = values.iter().map(|value| value * value).sum();
    (found.normal(values).cost / squares).sqrt()
}

fn descend(values: &[f64], start: Damped, steps: usize) -> Option<(Damped, f64)> {
    let mut at = start;
    let mut normal = at.normal(values);
    let mut damping = 1e-3;
    for _ in 0..steps {
        let step = normal.step(damping)?;
        let next = at.plus(step);
        let found = next.normal(values);
        let small = step[0].abs().max(step[1].abs()) <= CONVERGED * (at.lambda.abs() + at.omega.abs());
        if found.cost <= normal.cost && next.lambda > -1.0 / values.len() as f64 {
            (at, normal) = (next, found);
            damping = (damping * 0.2).max(1e-12);
        } else {
            damping *= 8.0;
        }
        if small || damping > 1e12 {
            break;
        }
    }
    normal.cost.is_finite().then_some((at, normal.cost))
}
