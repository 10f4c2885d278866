//! The lines of the plane (kappa2, gamma) at which motions lose their stability.

use super::Reduced;

motiform_dynamics::named! {
    /// A line of Fig. 1.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Line by title {
        /// `gamma = 0`, `kappa2 > 0`: the circle starts to move. The paper's solid line.
        CircleToStraight = "circle at rest to straight",
        /// `gamma = -2 a1 r2`, `kappa2 = -8 b3 r2^2`: the ellipse starts to move. The paper's solid line.
        EllipseToStraight = "ellipse at rest to straight",
        /// `kappa2 = 0`, `gamma < 0`: the circle becomes an ellipse; both are motionless.
        CircleToEllipse = "circle to ellipse, both at rest",
        /// `gamma = (16 a1/b1) s^2 + 2 a1 s`, `kappa2 = 4 a1 s - 8 b3 s^2`, `s > 0`: the path bends. The paper's broken line.
        StraightToCircular = "straight to circular",
        /// `kappa2 = -(8 b3 s^3 + 12 b3 B s^2)/(s + B/2)`, `gamma = 2 a1 s - kappa2/2 - 12 b3 s^2`, `-B/2 < s < 0`, `B = b1/4`:
        /// Hopf bifurcation of straight motion; its kind is [`Reduced::straight_hopf_criticality`]. The paper's dotted line.
        StraightHopf = "straight motion loses its stability (Hopf)",
        /// Hopf bifurcation of circular motion (of the circle's radius and the ellipse): `c2 c1 = c0` (Routh and Hurwitz). For
        /// the paper's couplings exactly `gamma = -(2/5) kappa2`.
        CircularToQuasiPeriodic = "circular to quasi-periodic",
        /// `gamma = 0`, `kappa2 < 0`: `lambda_+ + lambda_- = 0`, the cycle between ellipses starts to repel.
        QuasiPeriodicToRectangular = "quasi-periodic to rectangular",
    }
}

/// The extent to which lines are followed along the open ends of their parameters, in the parameters' natural
/// units.
const FAR: f64 = 8.0;

/// Steps in which a root is followed from the origin.
const HOMOTOPY: i32 = 64;

impl Reduced {
    /// `count` points `[kappa2, gamma]` of a line inside or just outside the box of these ranges, in the order of its
    /// parameter; empty where the line does not meet the box.
    pub fn line(&self, line: Line, kappa2: (f64, f64), gamma: (f64, f64), count: usize) -> Vec<[f64; 2]> {
        let (extent, steps) = (kappa2.0.abs().max(kappa2.1.abs()), count.max(2) - 1);
        let part = |i: usize| i as f64 / steps as f64;
        let point = |i: usize| {
            let x = part(i);
            match line {
                Line::CircleToStraight => [x * extent, 0.0],
                Line::QuasiPeriodicToRectangular => [-x * extent, 0.0],
                Line::CircleToEllipse => [0.0, -x * gamma.0.abs()],
                // equal steps in s: dense where the lines turn
                Line::EllipseToStraight => self.ellipse_to_straight(x * (extent / (8.0 * self.b3)).sqrt()),
                Line::StraightToCircular => self.straight_to_circular(x * self.a1 / (4.0 * self.b3)),
                Line::StraightHopf => self.straight_hopf(-x * (1.0 - 1e-3) * 0.5 * self.b()),
                Line::CircularToQuasiPeriodic => self.circular_hopf(x * FAR * extent / self.unit()),
            }
        };
        let inside =
            |p: &[f64; 2]| (kappa2.0..=kappa2.1).contains(&p[0]) && (gamma.0..=gamma.1).contains(&p[1]);
        let all: Vec<[f64; 2]> = (0..=steps).map(point).filter(|p| p.iter().all(|x| x.is_finite())).collect();
        let first = all.iter().position(inside);
        let last = all.iter().rposition(inside);
        match (first, last) {
            (Some(first), Some(last)) => {
                all[first.saturating_sub(1)..(last + 2).min(all.len())].to_vec() // one point beyond each end
            }
            _ => Vec::new(),
        }
    }

    /// The point with the ellipse `r2 >= 0` of the line [`Line::EllipseToStraight`].
    pub fn ellipse_to_straight(&self, r2: f64) -> [f64; 2] {
        [-8.0 * self.b3 * r2 * r2, -2.0 * self.a1 * r2]
    }

    /// The point with the ellipse `s > 0` of the line [`Line::StraightToCircular`].
    pub fn straight_to_circular(&self, s: f64) -> [f64; 2] {
        let kappa2 = 4.0 * self.a1 * s - 8.0 * self.b3 * s * s;
        [kappa2, 16.0 * self.a1 / self.b1 * s * s + 2.0 * self.a1 * s]
    }

    /// The point with the ellipse `-B/2 < s <= 0` of the line [`Line::StraightHopf`].
    pub fn straight_hopf(&self, s: f64) -> [f64; 2] {
        let (b3, b) = (self.b3, self.b());
        let kappa2 = -(8.0 * b3 * s * s * s + 12.0 * b3 * b * s * s) / (s + 0.5 * b);
        [kappa2, 2.0 * self.a1 * s - 0.5 * kappa2 - 12.0 * b3 * s * s]
    }

    /// The point with the ellipse `r2^2 = rho >= 0` of the line [`Line::CircularToQuasiPeriodic`]; NaN where the line has ended.
    ///
    /// With `kappa2 = q rho` the condition `c2 c1 = c0` is linear in rho: `D(q) rho + 48 a1^2 (q - q0) = 0`, D a cubic and q0 the
    /// slope at the origin. The root is followed from there in small steps of rho; where two roots meet, the line turns back.
    pub fn circular_hopf(&self, rho: f64) -> [f64; 2] {
        let (a1, b3, b) = (self.a1, self.b3, self.b());
        let (free, coupling) = (8.0 * a1 / b, 256.0 * a1 * a1 * (a1 + b * b3) / b);
        let origin = coupling / (48.0 * a1 * a1) - free - 24.0 * b3;
        let mut q = origin;
        for step in 1..=HOMOTOPY {
            let rho = rho * f64::from(step) / f64::from(HOMOTOPY);
            for _ in 0..4 {
                let (first, ellipse) = (free + q + 24.0 * b3, q + 8.0 * b3);
                let second = free * (q + 24.0 * b3) - 2.0 * ellipse * ellipse;
                let weight = coupling / (16.0 * a1 * a1);
                let d = first * second + weight * ellipse * ellipse;
                let slope = second + first * (free - 4.0 * ellipse) + 2.0 * weight * ellipse;
                let steepness = slope * rho + 48.0 * a1 * a1;
                if steepness <= 1e-3 * a1 * a1 {
                    return [f64::NAN, f64::NAN];
                }
                q -= (d * rho + 48.0 * a1 * a1 * (q - origin)) / steepness;
            }
        }
        let cosine = (q + 8.0 * b3) * rho.sqrt() / (4.0 * a1);
        let gamma = (4.0 * a1 / b + 0.5 * (q + 8.0 * b3)) * rho;
        if cosine.abs() < 1.0 { [q * rho, gamma] } else { [f64::NAN, f64::NAN] }
    }

    /// The point of a line with this `kappa2`: its parameter there, and `gamma`; by bisection. `None` where
    /// it has no such point, and on [`Line::CircleToEllipse`], along which `kappa2` does not change.
    ///
    /// # Checked by  tests/all/reduced.rs: points of the lines
    pub fn on_line(&self, line: Line, kappa2: f64) -> Option<(f64, f64)> {
        let point = |x: f64| match line {
            Line::EllipseToStraight => self.ellipse_to_straight(x),
            Line::StraightToCircular => self.straight_to_circular(x),
            Line::StraightHopf => self.straight_hopf(-x),
            _ => self.circular_hopf(x),
        };
        let last = match line {
            Line::CircleToStraight => return (kappa2 > 0.0).then_some((kappa2, 0.0)),
            Line::QuasiPeriodicToRectangular => return (kappa2 < 0.0).then_some((kappa2, 0.0)),
            Line::CircleToEllipse => return None,
            Line::EllipseToStraight => (kappa2.abs() / self.b3).sqrt(),
            Line::StraightToCircular => self.a1 / (4.0 * self.b3),
            Line::StraightHopf => 0.5 * self.b() * (1.0 - 1e-9),
            Line::CircularToQuasiPeriodic => FAR * kappa2.abs() / self.unit(),
        };
        let (mut low, mut high) = (0.0, last);
        // kappa2 begins at 0 and moves to one side, up to where the line ends
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if point(middle)[0].abs() < kappa2.abs() { low = middle } else { high = middle }
        }
        let x = 0.5 * (low + high);
        if (point(x)[0] - kappa2).abs() > 1e-9 * kappa2.abs() {
            return None;
        }
        Some((if line == Line::StraightHopf { -x } else { x }, point(x)[1]))
    }

    /// Divisor of kappa2 that gives the square of an ellipse.
    fn unit(&self) -> f64 {
        32.0 * self.a1 / self.b1 + 8.0 * self.b3
    }
}
