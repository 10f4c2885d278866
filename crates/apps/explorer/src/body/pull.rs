//! Pulling the outline: the change of the shape, as small as possible, that takes the outline through a point.

use super::setting::{Seen, Setting, state_of};
use crate::protocol::Pull;
use motiform_dynamics::{Model, Outline};
use motiform_study::Error;
use motiform_study::plan::check;

/// Points of the outline that is pulled.
const POINTS: usize = 192;
/// Step of the derivatives, and of an iteration at most, in undeformed radii.
const STEP: f64 = 1e-4;
const MOST: f64 = 0.25;
/// Iterations, and the distance in undeformed radii at which they end.
const ITERATIONS: usize = 30;
const NEAR: f64 = 1e-3;
/// A body can be pulled to so many undeformed radii, and no nearer to its centre than so many.
const REACH: (f64, f64) = (0.25, 2.5);

impl Setting {
    /// The body with its outline pulled to a point. The velocity of a model that has one is left as it is,
    /// for the outline does not depend on it; the path goes on where it is.
    pub(super) fn pulled(&self, pull: &Pull, seen: &Seen<'_>) -> Result<Self, Error> {
        let [x, y] = pull.to;
        let remedy = "the outline is pulled to a finite point other than the centre";
        check("to", x.hypot(y), x.hypot(y) > 0.0, remedy)?;
        let position = seen.state.last_chunk().copied().unwrap_or_default();
        let body = Pulled { model: self.model(), radius: seen.radius, angle: y.atan2(x), position };
        let wanted = x.hypot(y).clamp(REACH.0 * seen.radius, REACH.1 * seen.radius);
        let coordinates = body.reach(pull.state.clone(), wanted)?;
        let state = state_of(self.model(), &coordinates, position)?;
        self.changed(self.study().clone(), seen.t, state, seen.radius)
    }
}

/// A body, and the direction in which it is pulled.
struct Pulled<'p> {
    model: &'p dyn Model,
    radius: f64,
    angle: f64,
    position: [f64; 2],
}

impl Pulled<'_> {
    /// The coordinates whose outline has this extent in the direction: Newton's method with the least change in each step.
    fn reach(&self, mut coordinates: Vec<f64>, wanted: f64) -> Result<Vec<f64>, Error> {
        let mut now = self.extent(&coordinates)?;
        for _ in 0..ITERATIONS {
            let Some(extent) = now else { break };
            let missing = (wanted - extent).clamp(-MOST * self.radius, MOST * self.radius);
            if missing.abs() < NEAR * self.radius {
                break;
            }
            let gradient = self.gradient(&coordinates, extent)?;
            let size: f64 = gradient.iter().map(|g| g * g).sum();
            if size < 1e-12 {
                break;
            }
            // A step that leads to an outline that is no curve is halved.
            let stepped = |part: f64| -> Vec<f64> {
                let step = part * missing / size;
                coordinates.iter().zip(&gradient).map(|(x, g)| x + step * g).collect()
            };
            let mut parts = [1.0, 0.5, 0.25, 0.125].into_iter().map(stepped);
            let found = parts.find_map(|next| match self.extent(&next) {
                Ok(Some(extent)) => Some((next, extent)),
                _ => None,
            });
            let Some((next, extent)) = found else { break };
            (coordinates, now) = (next, Some(extent));
        }
        Ok(coordinates)
    }

    /// Derivative of the extent by each coordinate.
    fn gradient(&self, coordinates: &[f64], extent: f64) -> Result<Vec<f64>, Error> {
        let scale = coordinates.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        let step = STEP * scale;
        let mut moved = coordinates.to_vec();
        let mut gradient = vec![0.0; moved.len()];
        for (k, entry) in gradient.iter_mut().enumerate() {
            moved[k] += step;
            *entry = self.extent(&moved)?.map_or(0.0, |there| (there - extent) / step);
            moved[k] = coordinates[k];
        }
        Ok(gradient)
    }

    /// The reach of the outline in the direction; `None` if it is no curve.
    fn extent(&self, coordinates: &[f64]) -> Result<Option<f64>, Error> {
        let state = state_of(self.model, coordinates, self.position)?;
        let shape = &state[..self.model.dim()];
        match self.model.outline(shape, self.radius, POINTS) {
            Outline::Curve(points) if points.iter().flatten().all(|x| x.is_finite()) => {
                Ok(crossing(&points, self.angle))
            }
            _ => Ok(None),
        }
    }
}

/// The largest distance at which a closed curve about the origin crosses the ray of this angle.
fn crossing(points: &[[f64; 2]], angle: f64) -> Option<f64> {
    let (sine, cosine) = angle.sin_cos();
    // Along the ray, and across it.
    let turned = |[x, y]: [f64; 2]| [cosine * x + sine * y, cosine * y - sine * x];
    let next = points.iter().cycle().skip(1);
    let cut = |(a, b): (&[f64; 2], &[f64; 2])| {
        let (a, b) = (turned(*a), turned(*b));
        let crosses = (a[1] > 0.0) != (b[1] > 0.0);
        crosses.then(|| a[0] + (b[0] - a[0]) * a[1] / (a[1] - b[1])).filter(|along| *along > 0.0)
    };
    points.iter().zip(next).filter_map(cut).reduce(f64::max)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::super::setting::decode;
    use super::super::setting::tests::begin;
    use super::*;

    /// The outline passes through the point, and what it does not depend on stays.
    #[test]
    fn the_outline_goes_where_it_is_pulled() {
        for (model, preset) in [("tensor", "fig5a"), ("tensor", "fig2"), ("cell", "fig6a")] {
            let setting = begin(model, preset);
            let seen = setting.start();
            let dim = setting.model().dim();
            let state = decode(setting.model(), &seen.state[..dim]);
            for (angle, part) in [(0.3, 1.3), (2.0, 0.8), (-2.5, 1.1)] {
                let to =
                    [angle, angle + std::f64::consts::FRAC_PI_2].map(|a: f64| part * seen.radius * a.cos());
                let to = [to[0], -to[1]]; // cos(a + pi/2) = -sin a
                let pulled = setting.pulled(&Pull { state: state.clone(), to }, &seen).unwrap();
                let now = pulled.start();
                let Outline::Curve(points) = setting.model().outline(&now.state[..dim], now.radius, POINTS)
                else {
                    unreachable!("{preset}: no curve")
                };
                let extent = crossing(&points, angle).unwrap();
                let missed = (extent - part * seen.radius).abs() / seen.radius;
                assert!(missed < 0.02, "{preset} at {angle}: {extent} for {}", part * seen.radius);
                assert_eq!(now.state[dim..], seen.state[dim..]);
                let coordinates = decode(setting.model(), &now.state[..dim]);
                if model == "tensor" {
                    assert_eq!(coordinates[..2], state[..2], "the velocity stays");
                }
            }
        }
    }

    #[test]
    fn there_is_no_pull_to_the_centre_or_of_another_shape() {
        let setting = begin("tensor", "fig5a");
        let seen = setting.start();
        let state = vec![0.0; 6];
        assert!(setting.pulled(&Pull { state: state.clone(), to: [0.0, 0.0] }, &seen).is_err());
        assert!(setting.pulled(&Pull { state, to: [f64::INFINITY, 0.0] }, &seen).is_err());
        assert!(setting.pulled(&Pull { state: vec![0.0; 5], to: [1.0, 0.0] }, &seen).is_err());
    }
}
