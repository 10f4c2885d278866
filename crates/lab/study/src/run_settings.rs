//! Settings of a run, as typed.

use crate::described::settings;
use serde::Serialize;

settings! {
    /// Settings of a run.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct RunSettings {
        /// Recorded time (model time), above 0; by default that of the preset, without one 200.
        pub t_end: f64,
        /// Time before the recording starts; the position is reset to the start after it.
        pub transient: f64,
        /// Time between recorded states, above 0; by default that of the preset, without one `t_end` / 2000.
        pub dt_out: f64,
        /// Stepper: euler, heun, rk4 (fixed step), dopri5, dop853 (adaptive); for stiff models ifrk4 (fixed step),
        /// etdrk4, hochbruck4, krogstad4 (adaptive). By default that of the model: krogstad4 for cell, which is stiff,
        /// otherwise dop853.
        pub stepper: String,
        /// Relative tolerance of adaptive steppers, 1e-14 to 1e-4: sets the accuracy of the run. By default that of the model: 1e-6 for
        /// cell, otherwise 1e-9.
        pub rtol: f64,
        /// Absolute tolerance of adaptive steppers. By default a tenth of `rtol` for cell, otherwise a thousandth; for
        /// equations of your own in their unit where that is below 1.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub atol: Option<f64>,
        /// Fixed step. By default adaptive steppers control their step, and the others use 1e-3.
        pub step: Option<f64>,
        /// Seed of all random numbers: of the random start, and of noise.
        pub seed: u64,
        /// Maximum number of steps of a run; by default 1e8.
        pub max_steps: u64,
        /// A shape whose norm exceeds this has escaped; by default 1e6, for equations of your own in their unit where that is above 1
        /// (a power of 1000, from the largest size at which their terms balance).
        #[serde(skip_serializing_if = "Option::is_none")]
        pub escape_norm: Option<f64>,
        /// Amplitude eta of additive white noise (0 for none): du = f(u) dt + eta dW for every coordinate u of the shape (s11, s12,
        /// u111, u222; c1, s1, c2, ...), and for v1, v2 unless `noise_velocity` is given. Unit of u per square root of model time.
        pub noise: f64,
        /// Amplitude of the noise on v1 and v2, if it differs from that of the shape. For models whose velocity is an unknown: tensor, and
        /// equations given as text with an amplitude z1.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub noise_velocity: Option<f64>,
    }
}

impl RunSettings {
    /// The larger amplitude of its noise; 0 if there is none.
    pub fn largest_noise(&self) -> f64 {
        self.noise.max(self.noise_velocity.unwrap_or(0.0))
    }

    /// Makes `amplitude` the larger one of its noise. Noise on velocity and shape that `own` distinguishes keeps the ratio that it has
    /// there.
    pub fn set_largest_noise(&mut self, amplitude: f64, own: &Self) {
        let part = if amplitude == own.largest_noise() { 1.0 } else { amplitude / own.largest_noise() };
        (self.noise, self.noise_velocity) = match own.noise_velocity {
            Some(velocity) if own.largest_noise() > 0.0 => (part * own.noise, Some(part * velocity)),
            _ => (amplitude, None),
        };
    }

    /// Removes the noise.
    pub fn silence(&mut self) {
        (self.noise, self.noise_velocity) = (0.0, None);
    }
}

impl Default for RunSettings {
    fn default() -> Self {
        Self {
            t_end: 200.0,
            transient: 0.0,
            dt_out: 0.0,
            stepper: "dop853".to_owned(),
            rtol: 1e-9,
            atol: None,
            step: None,
            seed: 1,
            max_steps: 100_000_000,
            escape_norm: None,
            noise: 0.0,
            noise_velocity: None,
        }
    }
}
