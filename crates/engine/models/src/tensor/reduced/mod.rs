//! The reduced model of the paper's Fig. 1-3, solved by formulas: velocity and ellipse alone, a1 b1 > 0, b3 > 0.
//!
//! With `z1 = r1 e^(i p1)`, `z2 = r2 e^(i p2)`, `psi = p2 - 2 p1` and `B = b1/4`
//!
//! ```text
//! r1'  = r1 (gamma - r1^2 - 2 a1 r2 cos psi)
//! r2'  = -kappa2 r2 - 8 b3 r2^3 + B r1^2 cos psi
//! psi' = (4 a1 r2 - B r1^2 / r2) sin psi
//! ```
//!
//! Source: paper, eqs. (V) and (S) without U; Armbruster, Guckenheimer, Holmes (1988), Physica D 29, 257, the 'minus' case of
//! the interaction of modes 1 and 2 with O(2) symmetry.

mod criticality;
mod cubic;
mod lines;

pub use lines::Line;

use super::TensorParameters;
use cubic::real_roots;

/// The couplings of the reduced model: what spans the plane (kappa2, gamma) is left free.
///
/// # Not         for `a1 b1 <= 0` or `b3 <= 0`: other motions, other lines
/// # Checked by  tests/all/reduced.rs: states and stability against Newton's method and numerical eigenvalues
///
/// ```
/// use motiform_models::tensor::reduced::{Motion, Reduced};
/// let expected = Reduced::PAPER.expected(-0.1, -0.04);
/// assert_eq!(expected.stable, [Motion::Rectangular]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduced {
    /// The ellipse steers the velocity.
    pub a1: f64,
    /// Motion stretches the body.
    pub b1: f64,
    /// Saturation of the ellipse.
    pub b3: f64,
}

motiform_dynamics::named! {
    /// A motion of the reduced model.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Motion by name {
        /// A circle or an ellipse at rest.
        Motionless = "motionless",
        /// `sin psi = 0`: the ellipse lies along or across the path.
        Straight = "straight",
        /// `sin psi != 0`, constant.
        Circular = "circular",
        /// The shape repeats, turned.
        QuasiPeriodic = "quasi-periodic",
        /// A heteroclinic cycle between motionless ellipses.
        Rectangular = "rectangular",
    }
}

/// The motions predicted by the formulas at a point of the plane.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expected {
    /// Motions that are stable.
    pub stable: Vec<Motion>,
    /// Motions that fulfil every local condition, but whose existence depends on an orbit that no formula gives: the
    /// rectangular motion beside a stable straight one, where the connection from ellipse to ellipse may end on the latter.
    pub possible: Vec<Motion>,
}

impl Expected {
    /// Returns `true` if a motion of this name is stable or possible.
    pub fn allows(&self, name: &str) -> bool {
        self.stable.iter().chain(&self.possible).any(|motion| motion.name() == name)
    }
}

/// A straight motion: `r1^2 = gamma - 2 a1 s`, `kappa2 s + 8 b3 s^3 = B r1^2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Straight {
    /// `s = r2 cos psi`: the ellipse, above 0 if it lies along the path, below if across.
    pub s: f64,
    /// Speed `r1`.
    pub speed: f64,
    /// Largest real part of an eigenvalue: below 0 if stable.
    pub growth: f64,
}

/// A circular motion: `16 a1 r2^2 = b1 r1^2`, `r2^2 = (2 gamma - kappa2)/(32 a1/b1 + 8 b3)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circular {
    /// Speed `r1`.
    pub speed: f64,
    /// Size of the ellipse `r2`.
    pub r2: f64,
    /// `cos psi = (gamma - r1^2)/(2 a1 r2)`.
    pub cos_psi: f64,
    /// Size of the turning rate, `|2 a1 r2 sin psi|`.
    pub turning_rate: f64,
    /// `true` if it is stable (Routh and Hurwitz).
    pub stable: bool,
}

impl Reduced {
    /// The couplings of the paper's Fig. 1-3.
    pub const PAPER: Self = Self { a1: 1.0, b1: 0.5, b3: 1.0 };

    /// The couplings of a tensor model that is this one; `None` if another coupling counts, the triangle does not decay, or
    /// the signs are others.
    pub fn of(p: &TensorParameters) -> Option<Self> {
        let others = [p.a2, p.a3, p.a4, p.a5, p.a6, p.b2, p.b4, p.b5, p.b6, p.d1, p.d2, p.d6];
        let alone = others.iter().all(|&value| value == 0.0) && p.kappa3 > 0.0 && p.d3 >= 0.0;
        (alone && p.d4 >= 0.0 && p.d5 >= 0.0 && p.a1 > 0.0 && p.b1 > 0.0 && p.b3 > 0.0).then_some(Self {
            a1: p.a1,
            b1: p.b1,
            b3: p.b3,
        })
    }

    /// `B = b1/4`.
    fn b(&self) -> f64 {
        0.25 * self.b1
    }

    /// Size `r2` of the motionless ellipse, `r2^2 = -kappa2/(8 b3)`; `None` for `kappa2 >= 0`.
    pub fn ellipse(&self, kappa2: f64) -> Option<f64> {
        (kappa2 < 0.0).then(|| (-kappa2 / (8.0 * self.b3)).sqrt())
    }

    /// Rates at which a velocity grows and decays on the motionless ellipse, `lambda_pm = gamma +- 2 a1 r2`.
    pub fn saddle_rates(&self, kappa2: f64, gamma: f64) -> Option<[f64; 2]> {
        self.ellipse(kappa2).map(|r2| [gamma + 2.0 * self.a1 * r2, gamma - 2.0 * self.a1 * r2])
    }

    /// Straight motions, by increasing `s`.
    pub fn straight(&self, kappa2: f64, gamma: f64) -> Vec<Straight> {
        let (a1, b3, b) = (self.a1, self.b3, self.b());
        let roots = real_roots((kappa2 + 2.0 * a1 * b) / (8.0 * b3), -b * gamma / (8.0 * b3));
        let state = |s: f64| {
            let square = gamma - 2.0 * a1 * s;
            let trace = -2.0 * square - kappa2 - 24.0 * b3 * s * s;
            let determinant = 2.0 * square * (kappa2 + 24.0 * b3 * s * s + 2.0 * a1 * b);
            let root = trace * trace - 4.0 * determinant;
            let along = 0.5 * (trace + root.max(0.0).sqrt());
            let across = 4.0 * a1 * s - kappa2 - 8.0 * b3 * s * s;
            let growth = if square > 0.0 { along.max(across) } else { f64::NAN };
            Straight { s, speed: square.max(0.0).sqrt(), growth }
        };
        roots.into_iter().map(state).filter(|found| found.speed > 0.0 && found.s != 0.0).collect()
    }

    /// The circular motion (to the left or to the right); `None` where there is none.
    pub fn circular(&self, kappa2: f64, gamma: f64) -> Option<Circular> {
        let (a1, b3) = (self.a1, self.b3);
        let rho = (2.0 * gamma - kappa2) / (32.0 * a1 / self.b1 + 8.0 * b3);
        if rho <= 0.0 {
            return None;
        }
        let (r2, square) = (rho.sqrt(), 16.0 * a1 / self.b1 * rho);
        let cos_psi = (gamma - square) / (2.0 * a1 * r2);
        let sine = 1.0 - cos_psi * cos_psi;
        (sine > 0.0).then(|| Circular {
            speed: square.sqrt(),
            r2,
            cos_psi,
            turning_rate: (2.0 * a1 * r2 * sine.sqrt()).abs(),
            stable: self.hurwitz(kappa2, rho) > 0.0 && 2.0 * square + kappa2 + 24.0 * b3 * rho > 0.0,
        })
    }

    /// `c2 c1 - c0` of the characteristic polynomial `lambda^3 + c2 lambda^2 + c1 lambda + c0` of the circular motion with
    /// `r2^2 = rho`, over `rho`; `c0 = 64 a1 (a1 + B b3) rho r1^2 sin^2 psi` is positive throughout.
    fn hurwitz(&self, kappa2: f64, rho: f64) -> f64 {
        let (a1, b3, b) = (self.a1, self.b3, self.b());
        let square = 4.0 * a1 / b * rho;
        let k = kappa2 + 24.0 * b3 * rho;
        let cosine = (kappa2 + 8.0 * b3 * rho) / (4.0 * a1 * rho.sqrt());
        let sine = 1.0 - cosine * cosine;
        let c1 = 2.0 * square * k + 16.0 * a1 * a1 * rho * (1.0 + 2.0 * sine);
        ((2.0 * square + k) * c1 - 64.0 * a1 * (a1 + b * b3) * rho * square * sine) / rho
    }

    /// The motions that are stable at a place of the plane.
    ///
    /// Motionless, straight and circular motions by their eigenvalues; the rectangular one where the ellipse is a saddle
    /// that attracts as a cycle, `lambda_+ > 0 > lambda_+ + lambda_-`; the quasi-periodic one where the ellipse is a saddle
    /// whose cycle repels and the circular motion has lost its stability: it is what either leaves behind.
    pub fn expected(&self, kappa2: f64, gamma: f64) -> Expected {
        let (mut stable, mut possible) = (Vec::new(), Vec::new());
        let rates = self.saddle_rates(kappa2, gamma);
        let still = rates.map_or(gamma < 0.0 && kappa2 > 0.0, |[out, _]| out < 0.0);
        let straight = self.straight(kappa2, gamma).iter().any(|found| found.growth < 0.0);
        let circular = self.circular(kappa2, gamma);
        let turning = circular.is_some_and(|found| found.stable);
        for (motion, there) in
            [(Motion::Motionless, still), (Motion::Straight, straight), (Motion::Circular, turning)]
        {
            stable.extend(there.then_some(motion));
        }
        if let Some([out, inward]) = rates.filter(|rates| rates[0] > 0.0) {
            if out + inward < 0.0 {
                if straight { &mut possible } else { &mut stable }.push(Motion::Rectangular);
            } else if circular.is_some() && !turning {
                stable.push(Motion::QuasiPeriodic);
            }
        }
        Expected { stable, possible }
    }
}
