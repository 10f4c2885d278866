//! Closing the boundary: the maximum a posteriori estimate of the error function.
//!
//! The free solution violates (CLOSE), `int n ds = 0`. The paper adds an error function to phi and maximises its
//! likelihood. Here: minimise `sum |eps_n|^2 / (2 tau_n^2)`, `tau_n = n^-p`, over the modes `n = 1 ..= m` subject to
//! (CLOSE) for `phi + eps`, by full Newton steps on the optimality (KKT) system from `eps = -(mode 1 of phi)`. With the
//! smooth prior `p = 4` that start lies near the one solution that continues from the circle; flat priors have several.
//! The start depends on phi alone, never on an earlier time, so the estimate is a function of the shape. The error
//! function is not fed back into phi, unless `feedback = 1`.
//!
//! Source: paper, Simulations III; the prior is ours (the paper does not give one).
//! Unknowns are in angles, `k_1 eps(s) = sum_n a_n cos(k_n s) + b_n sin(k_n s)`, divided by `tau_n`.

use super::circle::{Circle, MAX_POINTS};
use super::kkt::{Factors, MAX_UNKNOWNS, Matrix};
use motiform_dynamics::Scalar;

/// Maximum number of modes of the error function.
pub const MAX_CLOSURE_MODES: usize = MAX_UNKNOWNS / 2 - 1;

/// A closure has converged when `|int n ds| / L` is below this, and the optimality conditions hold as well.
const TOLERANCE: f64 = 1e-13;

/// Newton steps before giving up; it takes two to five where it converges.
const STEPS: usize = 30;

/// The method of closing a boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Closure {
    /// Number of modes `m` of the error function; 0 for the bare normal.
    modes: usize,
    /// Widths `tau_n = n^-p` of the prior, `n = 1 ..= MAX_CLOSURE_MODES`.
    widths: [f64; MAX_CLOSURE_MODES],
}

/// The normals `n = (cos theta, sin theta)` at the points of the boundary.
pub(super) struct Normals<T> {
    pub(super) cos: [T; MAX_POINTS],
    pub(super) sin: [T; MAX_POINTS],
}

/// A closed boundary.
pub(super) struct Closed<T> {
    pub(super) normals: Normals<T>,
    /// The residual `|int n ds| / L`.
    pub(super) residual: f64,
    /// Root mean square of `k_1 eps` (rad): the deviation of the shape from a closed one.
    pub(super) correction: f64,
    /// Newton steps taken.
    pub(super) steps: usize,
}

/// The Newton iterate: `a_n / tau_n, b_n / tau_n, ..` and the two multipliers.
type Unknowns<T> = [T; MAX_UNKNOWNS];

impl<T: Scalar> Normals<T> {
    /// The normals at angles `theta_j + sum_n a_n cos + b_n sin`; the coefficients are `unknowns` times `tau`.
    #[inline(always)]
    fn new(closure: Closure, circle: &Circle, theta: &[T], unknowns: &Unknowns<T>) -> Self {
        let mut normals = Self { cos: [theta[0].zero(); MAX_POINTS], sin: [theta[0].zero(); MAX_POINTS] };
        let angles = &mut normals.sin[..theta.len()]; // in the place of their sines: filling arrays takes time
        angles.copy_from_slice(theta);
        for n in 1..=closure.modes {
            let tau = closure.width(n);
            circle.add_wave(n, [unknowns[2 * n - 2] * tau, unknowns[2 * n - 1] * tau], angles);
        }
        for (angle, cos) in angles.iter_mut().zip(&mut normals.cos) {
            (*angle, *cos) = angle.sin_cos();
        }
        normals
    }

    /// `(CLOSE)`: the mean normal.
    #[inline(always)]
    fn mean(&self, circle: &Circle) -> [T; 2] {
        let points = ..circle.points();
        [circle.mean(&self.cos[points]), circle.mean(&self.sin[points])]
    }
}

impl Closure {
    /// An error function of `modes` modes with prior widths `tau_n = n^-prior`.
    pub(super) fn new(modes: usize, prior: f64) -> Self {
        Self { modes, widths: std::array::from_fn(|i| libm::pow(i as f64 + 1.0, -prior)) }
    }

    /// Number of modes.
    pub(super) fn modes(self) -> usize {
        self.modes
    }

    /// `tau_n`.
    fn width(self, n: usize) -> f64 {
        self.widths[n - 1]
    }

    /// Number of unknowns: coefficients and multipliers.
    fn unknowns(self) -> usize {
        2 * self.modes + 2
    }

    /// Closes the boundary with normal angles `theta` at the points; `first` is mode 1 of the angle as
    /// `c cos(k_1 s) + s sin(k_1 s)`.
    ///
    /// # Errors
    /// The residual, if Newton's method does not converge.
    #[inline(always)]
    pub(super) fn solve<T: Scalar<Real = f64>>(
        self,
        circle: &Circle,
        theta: &[T],
        first: [f64; 2],
    ) -> Result<Closed<T>, f64> {
        if self.modes == 0 {
            let normals = Normals::new(self, circle, theta, &[theta[0].zero(); MAX_UNKNOWNS]);
            let [x, y] = normals.mean(circle).map(Scalar::real);
            return Ok(Closed { normals, residual: libm::hypot(x, y), correction: 0.0, steps: 0 });
        }
        let mut angles = [0.0; MAX_POINTS];
        for (x, angle) in angles.iter_mut().zip(theta) {
            *x = angle.real();
        }
        let mut unknowns = Self::guess(first);
        let (factors, steps) = self.newton(circle, &angles[..theta.len()], &mut unknowns)?;
        Ok(self.lift(circle, theta, &unknowns, &factors, steps))
    }

    /// The error function that closes the boundary, `a_1, b_1, a_2, ..` of `k_1 eps`; arguments as for
    /// [`Closure::solve`]. There is none of no modes.
    ///
    /// # Errors
    /// The residual, if Newton's method does not converge.
    pub(super) fn estimate(
        self,
        circle: &Circle,
        theta: &[f64],
        first: [f64; 2],
    ) -> Result<[f64; 2 * MAX_CLOSURE_MODES], f64> {
        let mut waves = [0.0; 2 * MAX_CLOSURE_MODES];
        if self.modes > 0 {
            let mut unknowns = Self::guess(first);
            self.newton(circle, theta, &mut unknowns)?;
            for (i, wave) in waves[..2 * self.modes].iter_mut().enumerate() {
                *wave = unknowns[i] * self.width(i / 2 + 1);
            }
        }
        Ok(waves)
    }

    /// The initial guess of Newton's method: `eps = -(mode 1 of phi)`, a width of 1.
    fn guess(first: [f64; 2]) -> Unknowns<f64> {
        let mut unknowns = [0.0; MAX_UNKNOWNS];
        (unknowns[0], unknowns[1]) = (-first[0], -first[1]);
        unknowns
    }

    /// Newton's method over the numbers alone; leaves the factors of the last matrix.
    #[inline(always)]
    fn newton(
        self,
        circle: &Circle,
        theta: &[f64],
        unknowns: &mut Unknowns<f64>,
    ) -> Result<(Factors, usize), f64> {
        let mut residual = f64::INFINITY;
        for step in 0..STEPS {
            let normals = Normals::new(self, circle, theta, unknowns);
            let mut defect = self.defect(circle, &normals, unknowns);
            residual = libm::hypot(defect[self.unknowns() - 2], defect[self.unknowns() - 1]);
            let Some(factors) = Factors::new(self.matrix(circle, &normals, unknowns), self.unknowns()) else {
                return Err(residual);
            };
            let gradient = defect[..2 * self.modes].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            if residual < TOLERANCE && gradient < 1e-10 {
                return Ok((factors, step));
            }
            factors.solve(&mut defect);
            for (x, change) in unknowns.iter_mut().zip(defect) {
                *x -= change;
            }
        }
        Err(residual)
    }

    /// One more step with the converged matrix, over the scalar of the shape: exact derivatives by the implicit
    /// function theorem (first ones; nested duals would need a step each).
    #[inline(always)]
    fn lift<T: Scalar<Real = f64>>(
        self,
        circle: &Circle,
        theta: &[T],
        unknowns: &Unknowns<f64>,
        factors: &Factors,
        steps: usize,
    ) -> Closed<T> {
        let mut lifted = unknowns.map(|x| theta[0].constant(x));
        let normals = Normals::new(self, circle, theta, &lifted);
        let mut change = self.defect(circle, &normals, &lifted);
        factors.solve(&mut change);
        for (x, change) in lifted.iter_mut().zip(change) {
            *x -= change;
        }
        let normals = Normals::new(self, circle, theta, &lifted);
        let [x, y] = normals.mean(circle).map(Scalar::real);
        let squares = (1..=self.modes).map(|n| {
            let (a, b) = (unknowns[2 * n - 2] * self.width(n), unknowns[2 * n - 1] * self.width(n));
            0.5 * (a * a + b * b)
        });
        Closed { normals, residual: libm::hypot(x, y), correction: squares.sum::<f64>().sqrt(), steps }
    }

    /// The optimality conditions: `y + tau (lambda . dC/d eps)` for each coefficient, then `C = <n>`.
    #[inline(always)]
    fn defect<T: Scalar>(self, circle: &Circle, normals: &Normals<T>, unknowns: &Unknowns<T>) -> Unknowns<T> {
        let points = circle.points();
        let mut defect = *unknowns;
        let [lx, ly] = [unknowns[2 * self.modes], unknowns[2 * self.modes + 1]];
        // lambda . dn/d theta, n = (cos, sin)
        let mut pull = [lx.zero(); MAX_POINTS];
        for ((x, &cos), &sin) in pull[..points].iter_mut().zip(&normals.cos).zip(&normals.sin) {
            *x = ly * cos - lx * sin;
        }
        let moments = circle.moments(self.modes + 1, &pull[..points]);
        for n in 1..=self.modes {
            defect[2 * n - 2] += moments[n][0] * self.width(n);
            defect[2 * n - 1] += moments[n][1] * self.width(n);
        }
        let mean = normals.mean(circle);
        (defect[2 * self.modes], defect[2 * self.modes + 1]) = (mean[0], mean[1]);
        defect
    }

    /// The derivative of [`Closure::defect`].
    #[inline(always)]
    fn matrix(self, circle: &Circle, normals: &Normals<f64>, unknowns: &Unknowns<f64>) -> Matrix {
        let (m, points) = (self.modes, circle.points());
        let (lx, ly) = (unknowns[2 * m], unknowns[2 * m + 1]);
        let x = circle.moments(2 * m + 1, &normals.cos[..points]);
        let y = circle.moments(2 * m + 1, &normals.sin[..points]);
        // moments of lambda . d2n/d theta2 = -(lambda . n)
        let bend = |n: usize| [-(lx * x[n][0] + ly * y[n][0]), -(lx * x[n][1] + ly * y[n][1])];
        let mut matrix = [[0.0; MAX_UNKNOWNS]; MAX_UNKNOWNS];
        for p in 1..=m {
            for q in 1..=m {
                let scale = 0.5 * self.width(p) * self.width(q);
                let ([sum_c, sum_s], [diff_c, diff_s]) = (bend(p + q), bend(p.abs_diff(q)));
                let diff_s = if p >= q { diff_s } else { -diff_s }; // sin(p - q)
                matrix[2 * p - 2][2 * q - 2] = scale * (diff_c + sum_c); // cos cos
                matrix[2 * p - 1][2 * q - 1] = scale * (diff_c - sum_c); // sin sin
                matrix[2 * p - 1][2 * q - 2] = scale * (sum_s + diff_s); // sin cos
                matrix[2 * p - 2][2 * q - 1] = scale * (sum_s - diff_s); // cos sin
            }
            for part in 0..2 {
                let row = 2 * p - 2 + part;
                matrix[row][row] += 1.0;
                let (pull_x, pull_y) = (-self.width(p) * y[p][part], self.width(p) * x[p][part]);
                (matrix[row][2 * m], matrix[row][2 * m + 1]) = (pull_x, pull_y);
                (matrix[2 * m][row], matrix[2 * m + 1][row]) = (pull_x, pull_y);
            }
        }
        matrix
    }
}
