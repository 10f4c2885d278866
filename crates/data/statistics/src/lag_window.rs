//! The integral of a sampled correlation under a smooth lag window.

/// Largest share of white noise that is corrected for.
const MOST: f64 = 0.999;

/// The window: 1 up to half of its length, then `1 - 3 x^2 + 2 x^3`, x from 0 to 1 over the second half.
///
/// Flat at lag 0, so nothing is lost of what is forgotten within half of it; smooth at its end, so an
/// oscillation of frequency omega that still goes on there leaks 48/(omega^3 W^2) at most. It is the window
/// that the slope of a least-squares line through MSD(tau), tau from W/2 to W, gives to the correlation of
/// the velocity.
///
/// Source: Politis and Romano (1995), J. Time Ser. Anal. 16, 67 (flat-top windows).
pub(crate) fn weight(lag: usize, length: usize) -> f64 {
    let x = 2.0 * lag as f64 / length as f64 - 1.0;
    if x <= 0.0 { 1.0 } else { (1.0 - x * x * (3.0 - 2.0 * x)).max(0.0) }
}

/// A windowed integral over lags from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Integral {
    /// The integral.
    pub(crate) value: f64,
    /// The correction that was subtracted from the trapezoidal sum.
    pub(crate) correction: f64,
}

/// `int_0^W w C dtau` of samples `correlation[k]` = C(k dt).
///
/// T = dt (C_0/2 + sum_k w_k C_k) exceeds the integral by what the spectrum holds above the Nyquist frequency. The alternating sum
/// Y = dt (C_0/2 + sum_k (-1)^k w_k C_k), the spectrum at that frequency, tells how much: an exponential of
/// rate g has T = (C_0 dt/2) coth(g dt/2) and Y = (C_0 dt/2) tanh(g dt/2), so
///
/// integral = T - (C_0 dt/2) (coth y - 1/y),   y = artanh(2 Y/(C_0 dt)).
///
/// Exact for an exponential at any dt; T - Y/3 where samples are close, exact to order dt^2 for every
/// correlation, with or without a cusp at lag 0.
///
/// # Checked by  unit tests below: exponential, damped cosine, Gaussian
pub(crate) fn integral(correlation: &[f64], length: usize, dt: f64) -> Integral {
    let half = 0.5 * correlation[0];
    let (mut sum, mut alternating) = (half, half);
    for (lag, value) in correlation.iter().enumerate().take(length).skip(1) {
        let term = weight(lag, length) * value;
        sum += term;
        alternating += if lag % 2 == 0 { term } else { -term };
    }
    let part = if half > 0.0 { (alternating / half).clamp(0.0, MOST) } else { 0.0 };
    let correction = dt * half * langevin(libm::atanh(part));
    Integral { value: dt * sum - correction, correction }
}

/// `int_0^W w |C| dtau`.
pub(crate) fn size(correlation: &[f64], length: usize, dt: f64) -> f64 {
    let terms = correlation.iter().enumerate().take(length).skip(1);
    dt * (0.5 * correlation[0] + terms.map(|(lag, value)| weight(lag, length) * value.abs()).sum::<f64>())
}

/// coth y - 1/y.
fn langevin(y: f64) -> f64 {
    if y < 1e-3 { y / 3.0 } else { 1.0 / libm::tanh(y) - 1.0 / y }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(dt: f64, end: f64, correlation: impl Fn(f64) -> f64) -> Integral {
        let count = (end / dt) as usize;
        let values: Vec<f64> = (0..=count).map(|lag| correlation(lag as f64 * dt)).collect();
        integral(&values, count, dt)
    }

    #[test]
    fn an_exponential_is_exact_at_any_sampling() {
        for dt in [0.01, 0.5, 2.0, 4.0] {
            let found = of(dt, 80.0, |t| 3.0 * (-t).exp());
            assert!((found.value / 3.0 - 1.0).abs() < 1e-9, "{dt}: {found:?}");
            let trapezoid = 0.5 * dt / (0.5 * dt).tanh();
            assert!(((found.value + found.correction) / (3.0 * trapezoid) - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn others_are_exact_to_higher_order() {
        // exp(-l t) cos(w t): l/(l^2 + w^2); the next order of the trapezoidal rule is (4/45) Re y^3 dt/2, y = (l + i w) dt/2
        let (l, w) = (0.1, 1.0);
        for (dt, most) in [(0.25, 0.0005), (0.5, 0.004)] {
            let found = of(dt, 300.0, |t| (-l * t).exp() * (w * t).cos());
            assert!((found.value / (l / (l * l + w * w)) - 1.0).abs() < most, "{dt}: {found:?}");
        }
        // smooth at lag 0: the trapezoidal rule has no error to correct
        let found = of(0.5, 20.0, |t| (-0.5 * t * t).exp());
        assert!((found.value - (0.5 * std::f64::consts::PI).sqrt()).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn an_oscillation_beyond_half_of_the_window_leaks_little() {
        for length in [50.0, 200.0, 207.0] {
            let found = of(0.05, length, f64::cos);
            assert!(found.value.abs() < 48.0 / (length * length), "{found:?}");
        }
    }
}
