//! The boundary of the body: `R(theta) = R0 + dR(theta)`.

use motiform_dynamics::Outline;

/// `dR(theta) = 2 Re(z2 e^{2 i theta}) + 2 Re(z3 e^{3 i theta}) = S_ij n_i n_j + U_ijk n_i n_j n_k`.
///
/// Source: paper, eq. for delta R, with z_{-n} = conj(z_n). `shape` is the Fourier state.
#[must_use]
pub fn radius_change(shape: &[f64], theta: f64) -> f64 {
    let (sin2, cos2) = libm::sincos(2.0 * theta);
    let (sin3, cos3) = libm::sincos(3.0 * theta);
    2.0 * (shape[2] * cos2 - shape[3] * sin2) + 2.0 * (shape[4] * cos3 - shape[5] * sin3)
}

/// `points` points of the closed curve `R(theta) (cos theta, sin theta)`, or where and by how much `R <= 0`.
#[must_use]
pub fn outline(shape: &[f64], radius: f64, points: usize) -> Outline {
    let angles = (0..points).map(|i| std::f64::consts::TAU * i as f64 / points as f64);
    let rays: Vec<(f64, f64)> = angles.map(|theta| (theta, radius + radius_change(shape, theta))).collect();
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

/// `2 |z2| + 2 |z3|`: a bound of `|dR|` over all directions, reached to within a few per cent.
#[must_use]
pub fn deformation(shape: &[f64]) -> f64 {
    2.0 * libm::hypot(shape[2], shape[3]) + 2.0 * libm::hypot(shape[4], shape[5])
}
