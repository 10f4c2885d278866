//! The boundary of a body as a radius in every direction: `R(theta) = R0 + sum_n 2 Re(z_n e^{i n theta})`.
//!
//! Source: paper, eq. for delta R, with z_{-n} = conj(z_n).

use motiform_dynamics::Outline;

/// An angular index with its amplitude (real and imaginary part).
pub type Mode = (u32, [f64; 2]);

/// `dR(theta) = sum_n 2 Re(z_n e^{i n theta})`.
pub fn radius_change(modes: impl Iterator<Item = Mode>, theta: f64) -> f64 {
    let part = |(n, [re, im]): Mode| {
        let (sin, cos) = libm::sincos(f64::from(n) * theta);
        2.0 * (re * cos - im * sin)
    };
    modes.map(part).sum()
}

/// `points` points of the closed curve `R(theta) (cos theta, sin theta)`, or where and by how much `R <= 0`.
pub fn outline(modes: &(impl Iterator<Item = Mode> + Clone), radius: f64, points: usize) -> Outline {
    let angles = (0..points).map(|i| std::f64::consts::TAU * i as f64 / points as f64);
    let rays: Vec<(f64, f64)> =
        angles.map(|theta| (theta, radius + radius_change(modes.clone(), theta))).collect();
    match rays.iter().min_by(|a, b| a.1.total_cmp(&b.1)) {
        Some(&(angle, radius)) if radius <= 0.0 || !radius.is_finite() => {
            Outline::NotACurve { radius, angle }
        }
        _ => Outline::Curve(
            rays.iter()
                .map(|&(theta, r)| {
                    let (sin, cos) = libm::sincos(theta);
                    [r * cos, r * sin]
                })
                .collect(),
        ),
    }
}

/// `sum_n 2 |z_n|`: a bound of `|dR|` over all directions, reached to within a few per cent.
pub fn deformation(modes: impl Iterator<Item = Mode>) -> f64 {
    modes.map(|(_, [re, im])| 2.0 * libm::hypot(re, im)).sum()
}
