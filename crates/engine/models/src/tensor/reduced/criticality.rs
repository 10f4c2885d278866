//! Sub- or supercritical: the kind of the Hopf bifurcation of straight motion.

use super::{Line, Reduced};

impl Reduced {
    /// First Lyapunov coefficient of the Hopf bifurcation of straight motion at the point with the ellipse `-B/2 < s < 0` of the line
    /// [`super::Line::StraightHopf`] (times a positive number): above 0 subcritical, below 0 supercritical.
    ///
    /// With `psi = 0` or `pi` throughout, `p = r1^2` and `s` obey `p' = 2 p (gamma - p - 2 a1 s)`,
    /// `s' = -kappa2 s - 8 b3 s^3 + B p`. At the bifurcation the trace vanishes,
    /// `m = 2 p = -kappa2 - 24 b3 s^2`, and `omega^2 = m (2 a1 B - m)`. In `x = s - s0`,
    /// `y = -(B (p - p0) + m x)/omega` the linear part is a rotation, and
    /// `16 a = f_xxx - (g_xy (g_xx + g_yy) + f_xx g_xx)/omega` (all other terms of the formula vanish).
    ///
    /// Source: Guckenheimer and Holmes (1983), eq. (3.4.11).
    ///
    /// # Checked by  tests/all/reduced.rs: the size of the oscillation in runs beside the line
    pub fn straight_hopf_criticality(&self, s: f64) -> f64 {
        let (a1, b3, b) = (self.a1, self.b3, self.b());
        let m = -self.straight_hopf(s)[0] - 24.0 * b3 * s * s;
        let omega = (m * (2.0 * a1 * b - m)).sqrt();
        let (f_xx, f_xxx) = (-48.0 * b3 * s, -48.0 * b3);
        let g_xx = (4.0 * m * m / b - 8.0 * a1 * m + 48.0 * b3 * m * s) / omega;
        let (g_xy, g_yy) = (4.0 * m / b - 4.0 * a1, 4.0 * omega / b);
        f_xxx - (g_xy * (g_xx + g_yy) + f_xx * g_xx) / omega
    }

    /// The zero of that coefficient between the Hopf line's points at `kappa2` = -0.2 and -0.005, a Bautin
    /// point, by bisection. `None` if its sign does not change from above to below 0 there.
    ///
    /// # Checked by  tests/all/reduced.rs: the measured zero
    pub fn bautin(&self) -> Option<[f64; 2]> {
        let ellipse = |kappa2| self.on_line(Line::StraightHopf, kappa2).map(|at| at.0);
        let (mut low, mut high) = (ellipse(-0.2)?, ellipse(-0.005)?);
        let kind = |s| self.straight_hopf_criticality(s);
        if kind(low) <= 0.0 || kind(high) >= 0.0 {
            return None;
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if kind(middle) > 0.0 { low = middle } else { high = middle }
        }
        Some(self.straight_hopf(0.5 * (low + high)))
    }
}
