//! One body under noise, in steps of fixed length.

use motiform_dynamics::steppers::RK4;
use motiform_dynamics::{InPlane, Integration, Model, Noise, NoisyOrbit, Normal, Orbit, StepControl};

/// The times at which a sample path is looked at: `0, steps step, 2 steps step, ..`.
#[derive(Clone, Copy, Debug)]
pub struct Looks {
    /// Length of a step of the classical Runge-Kutta method.
    pub step: f64,
    /// Steps from one look to the next.
    pub steps: usize,
    /// Number of looks.
    pub count: usize,
}

/// Follows a body under noise from a state (shape, then position) and gives each look, by its number, to `take`, until that is `false`.
///
/// Returns `false` if `take` ended it, a step failed, or the noise does not fit the body.
///
/// # Units   those of the model
pub fn sample_path(
    body: &dyn Model,
    state: &[f64],
    noise: Noise,
    normal: Normal,
    looks: Looks,
    take: &mut dyn FnMut(usize, &[f64]) -> bool,
) -> bool {
    let Looks { step, steps, count } = looks;
    let body = InPlane(body);
    let orbit = Orbit::new(&body, &RK4, StepControl::Fixed { step }, 0.0, state);
    let Some(mut orbit) = orbit.ok().and_then(|orbit| NoisyOrbit::new(orbit, noise, normal).ok()) else {
        return false;
    };
    for look in 0..count {
        let t = step * (look * steps) as f64; // as the orbit counts
        while orbit.t() < t {
            if orbit.advance(t).is_err() {
                return false;
            }
        }
        if !take(look, orbit.state()) {
            return false;
        }
    }
    true
}
