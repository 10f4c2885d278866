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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_newtons_within_the_radius_and_ends_at_it_beyond() {
        let curvature = DMatrix::from_row_slice(2, 2, &[4.0, 1.0, 1.0, 1e-3]);
        let definite = DMatrix::from_row_slice(2, 2, &[4.0, 1.0, 1.0, 3.0]);
        let gradient = DVector::from_row_slice(&[1.0, 2.0]);
        let model = Model::new(&definite, &gradient).unwrap();
        let newton = definite.clone().lu().solve(&gradient).unwrap();
        assert!((model.step(10.0) - &newton).norm() < 1e-14);
        assert!((model.promise().unwrap() - 0.5 * newton.dot(&gradient)).abs() < 1e-14);
        for curvature in [&curvature, &definite] {
            let model = Model::new(curvature, &gradient).unwrap();
            let step = model.step(0.1);
            assert!((step.norm() - 0.1).abs() <= ACCURACY * 0.1, "{}", step.norm());
            // no other step of this length gains more
            let gain = |s: &DVector<f64>| gradient.dot(s) - 0.5 * s.dot(&(curvature * s));
            for k in 0..60 {
                let angle = 0.1 * f64::from(k);
                let other = DVector::from_row_slice(&[libm::cos(angle), libm::sin(angle)]) * step.norm();
                assert!(gain(&step) >= gain(&other) - 1e-9);
            }
        }
        assert!(Model::new(&curvature, &gradient).unwrap().promise().is_none());
        assert!(Model::new(&(curvature * f64::NAN), &gradient).is_none());
    }
}
