//! Residuals of vertices from an outline of given modes, and their derivatives.

use super::normal::Normal;
use super::polar::powers;

/// The unknowns, relative to an origin and in units of a length near the outline: well scaled whatever the data are.
#[derive(Clone)]
pub(super) struct Unknowns {
    pub(super) origin: [f64; 2],
    pub(super) length: f64,
    pub(super) values: Vec<f64>,
}

/// One vertex seen from the centre.
pub(super) struct Seen {
    pub(super) residual: f64,
    pub(super) weight: f64,
    pub(super) sound: bool,
}

impl Unknowns {
    pub(super) fn circle(centre: [f64; 2], r0: f64, unknowns: usize) -> Self {
        let mut values = vec![0.0; unknowns];
        values[2] = 1.0;
        Self { origin: centre, length: r0, values }
    }

    pub(super) fn moved(&self, step: &[f64]) -> Self {
        let values = self.values.iter().zip(step).map(|(value, step)| value + step).collect();
        Self { values, ..self.clone() }
    }

    /// Residual and weight of a vertex; its row of the Jacobian of R(theta) - |P - X| into `row`.
    pub(super) fn see(&self, point: &[f64; 2], row: &mut [f64]) -> Seen {
        let [x, y] = [0, 1].map(|k| (point[k] - self.origin[k]) / self.length - self.values[k]);
        let r = libm::hypot(x, y);
        let (cos, sin) = (x / r, y / r);
        let (mut radius, mut slope) = (self.values[2], 0.0);
        row[2] = 1.0;
        let modes = self.values[3..].as_chunks::<2>().0.iter().zip(row[3..].as_chunks_mut::<2>().0);
        for (n, ((z, row), [c, s])) in (2_u32..).zip(modes.zip(powers(cos, sin))) {
            *row = [2.0 * c, -2.0 * s];
            radius += z[0] * row[0] + z[1] * row[1];
            slope -= 2.0 * f64::from(n) * (z[0] * s + z[1] * c);
        }
        row[0] = cos + slope / r * sin;
        row[1] = sin - slope / r * cos;
        let steepness = slope / radius;
        Seen {
            residual: r - radius,
            weight: 1.0 / (1.0 + steepness * steepness),
            sound: radius > 0.0 && r > 0.0,
        }
    }

    /// The normal equations, and what decides about a step.
    pub(super) fn equations(&self, points: &[[f64; 2]], before: Option<&[f64]>) -> Equations {
        let mut normal = Normal::new(self.values.len());
        let mut row = vec![0.0; self.values.len()];
        let mut weights = Vec::with_capacity(points.len());
        let (mut cost, mut compared, mut sound) = (0.0, 0.0, true);
        for (k, point) in points.iter().enumerate() {
            let seen = self.see(point, &mut row);
            let square = seen.residual * seen.residual;
            normal.add(&row, seen.weight, seen.residual);
            cost += seen.weight * square;
            compared += before.map_or(seen.weight, |weights| weights[k]) * square;
            weights.push(seen.weight);
            sound &= seen.sound;
        }
        Equations {
            normal,
            weights,
            cost,
            compared,
            sound: sound && cost.is_finite() && compared.is_finite(),
        }
    }
}

/// Normal equations of one iterate.
pub(super) struct Equations {
    pub(super) normal: Normal,
    pub(super) weights: Vec<f64>,
    /// Sum of squares with its own weights.
    pub(super) cost: f64,
    /// The same with the weights of the iterate before: what its step reduces.
    pub(super) compared: f64,
    /// R > 0 at every vertex.
    pub(super) sound: bool,
}
