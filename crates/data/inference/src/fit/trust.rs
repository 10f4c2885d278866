//! The longest useful step of a quadratic model within a radius.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Relative accuracy of the length of a step at the radius.
const ACCURACY: f64 = 0.05;

/// A quadratic model of the log-likelihood, `gradient . s - s^T curvature s/2`, in the coordinates in which the curvature is diagonal.
pub(super) struct Model {
    values: DVector<f64>,
    vectors: DMatrix<f64>,
    /// Gradient in these coordinates.
    gradient: DVector<f64>,
}

impl Model {
    /// `None` where the numbers are not finite.
    pub(super) fn new(curvature: &DMatrix<f64>, gradient: &DVector<f64>) -> Option<Self> {
        if !curvature.iter().chain(gradient.iter()).all(|x| x.is_finite()) {
            return None;
        }
        let eigen = SymmetricEigen::new(curvature.clone());
        let gradient = eigen.eigenvectors.transpose() * gradient;
        Some(Self { values: eigen.eigenvalues, vectors: eigen.eigenvectors, gradient })
    }

    fn least(&self) -> f64 {
        self.values.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The gain of the step to the model's maximum; `None` where it has none.
    pub(super) fn promise(&self) -> Option<f64> {
        let parts = self.gradient.iter().zip(&self.values).map(|(g, value)| 0.5 * g * g / value);
        (self.least() > 0.0).then(|| parts.sum())
    }

    /// The step to the model's maximum within the radius.
    ///
    /// `(curvature + damping) s = gradient` with the least damping that keeps the length; found by bisection
    /// of its logarithm, as the length falls with it. Source: Moré and Sorensen (1983), SIAM J. Sci. Stat.
    /// Comput. 4, 553.
    pub(super) fn step(&self, radius: f64) -> DVector<f64> {
        let damped = |damping: f64| self.gradient.zip_map(&self.values, |g, value| g / (value + damping));
        let scale =
            self.values.iter().fold(0.0_f64, |most, value| most.max(value.abs())).max(f64::MIN_POSITIVE);
        let floor = (-self.least()).max(0.0) + 1e-14 * scale;
        let mut step = damped(if self.least() > 0.0 { 0.0 } else { floor });
        if step.norm() > radius {
            let (mut low, mut high) = (floor, floor + self.gradient.norm() / radius);
            for _ in 0..200 {
                let middle = (low * high).sqrt();
                step = damped(middle);
                if step.norm() > radius {
                    low = middle;
                } else {
                    high = middle;
                }
                if (step.norm() - radius).abs() < ACCURACY * radius {
                    break;
                }
            }
        }
        &self.vectors * step
    }
}
