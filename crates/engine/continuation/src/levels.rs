//! Growth rates whose signs count.

use super::correct::TIGHT;
use super::problem::Problem;
use std::f64::consts::PI;

/// An eigenvalue or a multiplier, as a number whose sign says whether it is stable, and an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Level {
    /// Real part of an eigenvalue; logarithm of a multiplier's modulus.
    pub(super) growth: f64,
    /// Imaginary part of an eigenvalue; argument of a multiplier.
    pub(super) angle: f64,
}

impl Level {
    /// Of eigenvalues, largest real part first, or of the logarithms and arguments of multipliers, largest first.
    pub(super) fn of_pairs(values: &[(f64, f64)]) -> Vec<Self> {
        values.iter().map(|&(growth, angle)| Self { growth, angle }).collect()
    }
}

/// The levels without those along a family of solutions of this dimension: they are 0.
pub(super) fn across_family(mut levels: Vec<Vec<Level>>, dimension: usize) -> Vec<Vec<Level>> {
    let size = |level: &Level| libm::hypot(level.growth, level.angle);
    for _ in 0..dimension {
        let all = levels.iter().enumerate();
        let all = all.flat_map(|(class, own)| {
            own.iter().enumerate().map(move |(rank, level)| (class, rank, size(level)))
        });
        let Some((class, rank, _)) = all.min_by(|a, b| a.2.total_cmp(&b.2)) else { break };
        levels[class].remove(rank);
    }
    levels
}

/// The level of a deviation along a family.
pub(super) const ALONG_FAMILY: Level = Level { growth: 0.0, angle: 0.0 };

/// A growth of fewer errors than this is not told from 0 where it should vanish: at special points.
pub(super) const CLEAR: f64 = 100.0;

/// Errors of levels within which one has no sign.
const SIGN: f64 = 3.0;

/// A growth below this may have either sign at a place that is solved for as well as it can be.
pub(super) fn unclear<P: Problem>(problem: &P, levels: &[Vec<Level>]) -> f64 {
    SIGN * problem.noise(levels).max(problem.unclear(levels, TIGHT))
}

/// Number of levels that are 0 within so many of their errors.
pub(super) fn zeros<P: Problem>(problem: &P, levels: &[Vec<Level>], errors: f64) -> usize {
    let least = errors * problem.noise(levels);
    levels.iter().flatten().filter(|level| level.growth.abs() < least).count()
}

/// Number of levels that may be 0, a pair counted once: of eigenvalues, or of multipliers (`orbits`).
pub(super) fn vanishing(levels: &[Vec<Level>], (within, orbits): (f64, bool)) -> usize {
    let real = |level: &Level| level.angle == 0.0 || orbits && level.angle.abs() == PI;
    let all = || levels.iter().flatten().filter(|level| level.growth.abs() <= within);
    let singles = all().filter(|level| real(level)).count();
    singles + (all().count() - singles).div_ceil(2)
}

/// Number of growing levels.
pub(super) fn unstable(levels: &[Vec<Level>]) -> usize {
    levels.iter().flatten().filter(|level| level.growth > 0.0).count()
}
