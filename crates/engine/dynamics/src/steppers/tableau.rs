//! Explicit Runge-Kutta methods as data.

/// One term of a linear combination of stages: `(stage, coefficient)`. Zero coefficients are left out.
pub type Term = (usize, f64);

/// An explicit Runge-Kutta method: all data of a step, printable and comparable.
///
/// With stages `k_i = f(t + c_i h, u + h sum_j a_ij k_j)` the step is `u_new = u + h sum_i b_i k_i`.
/// Index `s = stages()` stands for the slope at the end of the step, `f(t + h, u_new)`; dense output may add stages
/// after it.
#[derive(Debug)]
pub struct Tableau {
    /// Name on the command line and in files.
    pub name: &'static str,
    /// Order of the global error, `|error| ~ h^order`.
    pub order: u32,
    /// Nodes `c_i`, one per stage.
    pub nodes: &'static [f64],
    /// Rows `a_ij`, one per stage (the first is empty).
    pub rows: &'static [&'static [Term]],
    /// Weights `b_i`.
    pub weights: &'static [Term],
    /// The estimate of a step's error.
    pub error: ErrorEstimate,
    /// The interpolant inside a step.
    pub dense: Dense,
}

/// The error estimate of a method for one step (all weights multiply `h k_i`).
#[derive(Debug)]
pub enum ErrorEstimate {
    /// None: the method runs with fixed steps only.
    None,
    /// The difference to an embedded method.
    Embedded {
        /// Order of the estimate's leading term minus one: the exponent of step control is `1 / (order + 1)`.
        order: u32,
        /// Weights of the difference.
        weights: &'static [Term],
    },
    /// Two estimates of order 5 and 3, combined as `e5^2 / sqrt(e5^2 + 0.01 e3^2)` (DOP853).
    Pair {
        /// Weights of the difference to the embedded method of order 5.
        fifth: &'static [Term],
        /// Weights of the difference to the embedded method of order 3.
        third: &'static [Term],
    },
}

/// The interpolant of a step in nested form, with `x = (t - t_old) / h`:
///
/// `u(x) = u_old + x (F0 + (1-x) (F1 + x (F2 + (1-x) (F3 + ...))))`,
/// `F0 = u_new - u_old`, `F1 = h f_old - F0`, `F2 = 2 F0 - h (f_old + f_new)`, `F_{3+m} = h sum_i d_mi k_i`.
///
/// The first three terms alone are the cubic Hermite interpolant; each method adds its own.
#[derive(Debug)]
pub struct Dense {
    /// Order with which the interpolated solution converges, uniformly in time: the degree of the interpolant plus
    /// one, at most the method's own order.
    pub order: u32,
    /// Nodes of the extra stages.
    pub nodes: &'static [f64],
    /// Rows of the extra stages (indices up to and including the stages before them).
    pub rows: &'static [&'static [Term]],
    /// Weights `d_m` of the terms after the third.
    pub weights: &'static [&'static [Term]],
}

impl Dense {
    /// Cubic Hermite interpolation, for a method of the given order.
    pub const fn hermite(method_order: u32) -> Self {
        let order = if method_order < 4 { method_order } else { 4 };
        Self { order, nodes: &[], rows: &[], weights: &[] }
    }

    /// Number of coefficient vectors `F`.
    pub const fn terms(&self) -> usize {
        3 + self.weights.len()
    }
}

impl Tableau {
    /// Number of stages `s` (evaluations per step; the slope at the end is the next step's first stage).
    pub const fn stages(&self) -> usize {
        self.rows.len()
    }

    /// Number of slopes a step may hold: the stages, the slope at the end, the extra stages of dense output.
    pub const fn slopes(&self) -> usize {
        self.stages() + 1 + self.dense.rows.len()
    }

    /// Returns `true` if the method can control its step.
    pub const fn is_adaptive(&self) -> bool {
        !matches!(self.error, ErrorEstimate::None)
    }

    /// Returns `true` if the error estimate needs the slope at the end of the step.
    pub fn error_needs_end(&self) -> bool {
        let end = self.stages();
        let reaches = |weights: &[Term]| weights.iter().any(|&(stage, _)| stage == end);
        match self.error {
            ErrorEstimate::None => false,
            ErrorEstimate::Embedded { weights, .. } => reaches(weights),
            ErrorEstimate::Pair { fifth, third } => reaches(fifth) || reaches(third),
        }
    }
}
