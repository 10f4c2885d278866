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
    pub fn new(model: M) -> Self {
        let dim = model.as_ref().dim();
        Self { model, shape: vec![0.0; dim], rate: vec![0.0; dim] }
    }

    /// Number of coordinates of the shape.
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
