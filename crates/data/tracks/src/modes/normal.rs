//! Normal equations of weighted least squares with few unknowns.

/// `J^T W J` and `J^T W r`, summed row by row; of the matrix the lower triangle.
pub(super) struct Normal {
    unknowns: usize,
    matrix: Vec<f64>,
    right: Vec<f64>,
}

impl Normal {
    pub(super) fn new(unknowns: usize) -> Self {
        Self { unknowns, matrix: vec![0.0; unknowns * unknowns], right: vec![0.0; unknowns] }
    }

    pub(super) fn add(&mut self, row: &[f64], weight: f64, residual: f64) {
        let lines = self.matrix.chunks_exact_mut(self.unknowns).zip(&mut self.right);
        for (j, (&value, (line, right))) in row.iter().zip(lines).enumerate() {
            let weighted = weight * value;
            *right += weighted * residual;
            for (sum, &other) in line.iter_mut().zip(&row[..=j]) {
                *sum += weighted * other;
            }
        }
    }

    /// Cholesky's factor of the matrix with its diagonal times `1 + damping`; `None` where the unknowns are not determined.
    fn factor(&self, damping: f64) -> Option<Vec<f64>> {
        let n = self.unknowns;
        let mut factor = self.matrix.clone();
        for j in 0..n {
            for k in 0..=j {
                let sum: f64 = (0..k).map(|m| factor[j * n + m] * factor[k * n + m]).sum();
                let raised = if j == k { 1.0 + damping } else { 1.0 };
                let rest = self.matrix[j * n + k] * raised - sum;
                if j > k {
                    factor[j * n + k] = rest / factor[k * n + k];
                } else if rest > 1e-14 * self.matrix[j * n + j] {
                    factor[j * n + j] = rest.sqrt();
                } else {
                    return None;
                }
            }
        }
        Some(factor)
    }

    /// The step that reduces the residuals.
    pub(super) fn step(&self, damping: f64) -> Option<Vec<f64>> {
        let step = self.solve(&self.factor(damping)?, self.right.clone());
        step.iter().all(|value| value.is_finite()).then_some(step)
    }

    /// `(J^T W J)^{-1}`, row by row.
    pub(super) fn inverse(&self) -> Option<Vec<f64>> {
        let (n, factor) = (self.unknowns, self.factor(0.0)?);
        let unit = |k: usize| (0..n).map(|j| f64::from(u8::from(j == k))).collect();
        let mut inverse: Vec<f64> = (0..n).flat_map(|k| self.solve(&factor, unit(k))).collect();
        for j in 0..n {
            for k in 0..j {
                inverse[k * n + j] = inverse[j * n + k]; // symmetric to the last bit
            }
        }
        inverse.iter().all(|value| value.is_finite()).then_some(inverse)
    }

    /// Forward and back through the factor.
    fn solve(&self, factor: &[f64], mut x: Vec<f64>) -> Vec<f64> {
        let n = self.unknowns;
        for j in 0..n {
            let sum: f64 = (0..j).map(|k| factor[j * n + k] * x[k]).sum();
            x[j] = (x[j] - sum) / factor[j * n + j];
        }
        for j in (0..n).rev() {
            let sum: f64 = (j + 1..n).map(|k| factor[k * n + j] * x[k]).sum();
            x[j] = (x[j] - sum) / factor[j * n + j];
        }
        x
    }
}
