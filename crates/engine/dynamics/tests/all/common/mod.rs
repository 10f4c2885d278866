//! Problems with known solutions, shared by the tests of this crate.
#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part")]

use motiform_dynamics::{Scalar, Semilinear, System, VectorField};

macro_rules! field {
    ($(#[$doc:meta])* $name:ident, $dim:expr, |$t:ident, $u:ident, $du:ident| $body:block) => {
        $(#[$doc])*
        pub struct $name;
        impl System for $name {
            fn dim(&self) -> usize { $dim }
        }
        impl<T: Scalar> VectorField<T> for $name {
            fn eval(&self, $t: T::Real, $u: &[T], $du: &mut [T]) $body
        }
    };
}

field!(
    /// Linear: u'' = -u, solution (cos t, -sin t) from (1, 0).
    Oscillator, 2, |_t, u, du| { du[0] = u[1]; du[1] = -u[0]; });

field!(
    /// Driven: u' = -2 t u^2, solution 1/(1 + t^2) from 1.
    Lorentzian, 1, |t, u, du| { du[0] = (u[0] * u[0]).scale(t) * -2.0; });

field!(
/// Stuart-Landau with shear: z' = (1 + 3i) z + (-1 + i) |z|^2 z. From z = r0: |z|^2 = 1/(1 + c e^(-2t)) with
/// c = 1/r0^2 - 1, arg z = 4 t + ln((1 + c e^(-2t)) / (1 + c)) / 2.
StuartLandau, 2, |_t, u, du| {
    let (x, y) = (u[0], u[1]);
    let square = x * x + y * y;
    du[0] = x - y * 3.0 - (x + y) * square;
    du[1] = x * 3.0 + y + (x - y) * square;
});

/// The solution of [`StuartLandau`] from (1/2, 0).
pub fn stuart_landau(t: f64) -> Vec<f64> {
    let c = 3.0;
    let decay = 1.0 + c * (-2.0 * t).exp();
    let (r, angle) = (decay.powf(-0.5), 4.0 * t + 0.5 * (decay / (1.0 + c)).ln());
    vec![r * angle.cos(), r * angle.sin()]
}

field!(
    /// u' = u^2, solution 1/(t* - t), t* = 1/u0.
    Quadratic, 1, |_t, u, du| { du[0] = u[0] * u[0]; });

field!(
    /// u' = u^3, solution (2 (t* - t))^(-1/2), t* = 1/(2 u0^2).
    Cubic, 1, |_t, u, du| { du[0] = u[0] * u[0] * u[0]; });

field!(
    /// u' = u: grows without bound, but has no singularity.
    Growth, 1, |_t, u, du| { du[0] = u[0]; });

field!(
/// The circular restricted three-body problem in rotating coordinates (x, y, x', y').
Arenstorf, 4, |_t, u, du| {
    let (x, y, vx, vy) = (u[0], u[1], u[2], u[3]);
    let mu = 0.012_277_471;
    let one = x.constant(1.0);
    let (near, far) = (x + one * mu, x - one * (1.0 - mu));
    let (d1, d2) = (near * near + y * y, far * far + y * y);
    // d^(3/2) by Newton on s^2 = d, so that no square root is needed of a scalar
    let cube_root_free = |d: T| { let s = root(d); d * s };
    let (d1, d2) = (cube_root_free(d1), cube_root_free(d2));
    du[0] = vx;
    du[1] = vy;
    du[2] = x + vy * 2.0 - near * (1.0 - mu) / d1 - far * mu / d2;
    du[3] = y - vx * 2.0 - y * (1.0 - mu) / d1 - y * mu / d2;
});

/// Square root over any scalar by Newton's iteration (test use only).
pub fn root<T: Scalar>(d: T) -> T {
    let mut s = d + d.constant(1.0);
    for _ in 0..40 {
        s = (s + d / s) * 0.5;
    }
    s
}

/// The slope of `log(error)` against `log(h)` by least squares.
pub fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|&(h, e)| (h.ln(), e.ln())).collect();
    let (mx, my) = (logs.iter().map(|p| p.0).sum::<f64>() / n, logs.iter().map(|p| p.1).sum::<f64>() / n);
    let covariance: f64 = logs.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum();
    covariance / logs.iter().map(|p| (p.0 - mx).powi(2)).sum::<f64>()
}

/// The part of [`StuartLandau`] that is linear and real: growth with rate 1.
impl<T: Scalar> Semilinear<T> for StuartLandau {
    fn linear(&self, lambda: &mut [T::Real]) {
        for rate in lambda {
            *rate = rate.constant(1.0);
        }
    }

    fn nonlinear(&self, t: T::Real, u: &[T], du: &mut [T]) {
        self.eval(t, u, du);
        for (rate, &x) in du.iter_mut().zip(u) {
            *rate -= x;
        }
    }
}

/// Sine modes of `u_t = -u u_x` with damping `-n^4/50`: stiff, coupled by a quadratic term, energy conserved by it.
pub struct Modes;

impl Modes {
    pub const COUNT: usize = 8;
}

impl System for Modes {
    fn dim(&self) -> usize {
        Self::COUNT
    }
}

impl<T: Scalar> VectorField<T> for Modes {
    fn eval(&self, t: T::Real, u: &[T], du: &mut [T]) {
        self.nonlinear(t, u, du);
        for (i, (rate, &x)) in du.iter_mut().zip(u).enumerate() {
            *rate -= x * ((i as f64 + 1.0).powi(4) / 50.0);
        }
    }
}

impl<T: Scalar> Semilinear<T> for Modes {
    fn linear(&self, lambda: &mut [T::Real]) {
        for (i, rate) in lambda.iter_mut().enumerate() {
            *rate = rate.constant(-(i as f64 + 1.0).powi(4) / 50.0);
        }
    }

    /// `u = sum a_n sin(n x)`: `a_n' = -(n/4) sum_{p+q=n} a_p a_q + (n/2) sum_q a_{n+q} a_q`.
    fn nonlinear(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        for n in 1..=u.len() {
            let mut sum = u[0].zero();
            for q in 1..n {
                sum -= u[q - 1] * u[n - q - 1] * (0.25 * n as f64);
            }
            for q in 1..=u.len() - n {
                sum += u[q - 1] * u[n + q - 1] * (0.5 * n as f64);
            }
            du[n - 1] = sum;
        }
    }
}
