//! Growth rates whose signs count.

/// An eigenvalue or a multiplier, as a number whose sign says whether it is stable, and an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Level {
    /// Real part of an eigenvalue; logarithm of a multiplier's modulus.
    pub(super) growth: f64,
    /// Imaginary part of an eigenvalue; argument of a multiplier.
    pub(super) angle: f64,
}

impl Level {
    /// Of eigenvalues, largest real part first.
    pub(super) fn of_eigenvalues(values: &[(f64, f64)]) -> Vec<Self> {
        values.iter().map(|&(re, im)| Self { growth: re, angle: im }).collect()
    }

    /// Of multipliers, largest modulus first.
    pub(super) fn of_multipliers(values: &[(f64, f64)]) -> Vec<Self> {
        let level = |&(re, im): &(f64, f64)| Self {
            growth: libm::log(libm::hypot(re, im)),
            angle: libm::atan2(im, re),
        };
        values.iter().map(level).collect()
    }
}

/// How many levels grow.
pub(super) fn unstable(levels: &[Vec<Level>]) -> usize {
    levels.iter().flatten().filter(|level| level.growth > 0.0).count()
}
