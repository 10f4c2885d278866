//! The vector field in the named coordinates.

use motiform_dynamics::model::velocity;
use motiform_dynamics::{Model, VectorField};

/// Rates and velocities of a model in its named coordinates ([`Model::coordinates`]), for external integrators.
#[derive(Debug)]
pub struct Flow<M> {
    model: M,
    shape: Vec<f64>,
    rate: Vec<f64>,
}

impl<M: AsRef<dyn Model>> Flow<M> {
    /// The flow of `model`.
    #[must_use]
    pub fn new(model: M) -> Self {
        let dim = model.as_ref().dim();
        Self { model, shape: vec![0.0; dim], rate: vec![0.0; dim] }
    }

    /// Number of coordinates of the shape.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.shape.len()
    }

    /// `d(coordinates)/dt`; for a state that ends in `x, y` the velocity is appended. Lengths: [`Flow::dim`] or 2 more.
    pub fn rates(&mut self, state: &[f64], rates: &mut [f64]) {
        let (model, dim) = (self.model.as_ref(), self.shape.len());
        model.encode(&state[..dim], &mut self.shape);
        VectorField::<f64>::eval(model, 0.0, &self.shape, &mut self.rate);
        model.decode(&self.rate, &mut rates[..dim]);
        if rates.len() > dim {
            rates[dim..].copy_from_slice(&velocity(model, &self.shape));
        }
    }

    /// The velocity of the centre of mass for these coordinates.
    pub fn velocity(&mut self, coordinates: &[f64]) -> [f64; 2] {
        let model = self.model.as_ref();
        model.encode(coordinates, &mut self.shape);
        velocity(model, &self.shape)
    }
}

#[cfg(test)]
mod tests {
    use motiform_models::MODELS;

    /// Property of [`Model::encode`] that rates in coordinates need: both maps are linear, and inverse to each other.
    #[test]
    fn coordinates_are_linear_in_the_state() {
        for info in MODELS {
            let values: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
            let model = info.build(&values).unwrap();
            let dim = model.dim();
            let a: Vec<f64> = (0..dim).map(|i| 0.3 + i as f64).collect();
            let b: Vec<f64> = (0..dim).map(|i| 1.7 - 0.5 * i as f64).collect();
            let sum: Vec<f64> = a.iter().zip(&b).map(|(a, b)| 2.0 * a + b).collect();
            let read = |state: &[f64]| model.decoded(state);
            for ((a, b), sum) in read(&a).iter().zip(read(&b)).zip(read(&sum)) {
                assert!((2.0 * a + b - sum).abs() < 1e-12 * sum.abs().max(1.0), "{}", info.name);
            }
            let back = model.encoded(&read(&a));
            assert!(back.iter().zip(&a).all(|(x, y)| (x - y).abs() < 1e-13 * y.abs().max(1.0)));
        }
    }
}
