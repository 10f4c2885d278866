//! The radius of a mode expansion in one direction.

/// Powers `e^{i n theta}` for n = 2, 3, ... from `e^{i theta}` = (cos, sin).
pub(super) fn powers(cos: f64, sin: f64) -> impl Iterator<Item = [f64; 2]> {
    let mut power = [cos, sin];
    std::iter::repeat_with(move || {
        power = [power[0] * cos - power[1] * sin, power[0] * sin + power[1] * cos];
        power
    })
}

/// `R = R0 + sum_{n=2} 2 Re(z_n e^{i n theta})` in the direction (cos, sin). `z[0]` is z2.
pub fn radius(r0: f64, z: &[[f64; 2]], [cos, sin]: [f64; 2]) -> f64 {
    let part = |([re, im], [c, s]): (&[f64; 2], [f64; 2])| 2.0 * (re * c - im * s);
    r0 + z.iter().zip(powers(cos, sin)).map(part).sum::<f64>()
}

/// `dR/dtheta = -sum_{n=2} 2 n Im(z_n e^{i n theta})`.
pub fn radius_slope(z: &[[f64; 2]], [cos, sin]: [f64; 2]) -> f64 {
    let part =
        |(k, ([re, im], [c, s])): (usize, (&[f64; 2], [f64; 2]))| -2.0 * (k + 2) as f64 * (re * s + im * c);
    z.iter().zip(powers(cos, sin)).enumerate().map(part).sum()
}
