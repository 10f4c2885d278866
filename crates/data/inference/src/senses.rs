//! The handedness of each cell of a joint fit by itself.
//!
//! [`handedness()`] gives all cells one set of imaginary parts. Those of cells that turn to the left and to the right cancel there, and a
//! mirror-symmetric law that circles either way may take their place. Here each cell has coefficients of its own.

use crate::{
    Beside, Fit, HANDED_RATE, Handedness, Result, Settings, Symmetry, Track, handed_beside,
    handed_beside_change, handedness,
};
use crate::{fit::refit, observation};
use motiform_dynamics::Watch;
use motiform_dynamics::distributions::chi_square_tail;
use motiform_dynamics::sample::sort_by_number;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// The cells of a joint fit that are handed by themselves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Senses {
    /// These cells, the clearest one first.
    pub handed: Vec<HandedCell>,
    /// Probability of such tests of all cells, each by itself, where all are mirror symmetric: `-2 sum ln p` of K cells against chi-square
    /// with 2 K degrees of freedom, p the larger one of likelihood ratio and robust Wald statistic. 1 without a cell whose fits converge.
    ///
    /// Source: Fisher (1932), Statistical Methods for Research Workers, 4th ed., sec. 21.1.
    pub p_value: f64,
}

/// A cell that is handed by itself.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HandedCell {
    /// Its number.
    pub cell: usize,
    /// Probability of such tests in one of so many mirror-symmetric cells: the largest one of likelihood ratio, robust Wald statistic, and
    /// the ratios beside a velocity of the stage, stretched images and a change of the law, times the number of cells.
    pub p_value: f64,
    /// `true` if its sense is not that of the clearest one: the mirror image of its imaginary parts is nearer to those.
    pub opposite: bool,
}

impl Senses {
    /// `true` if cells of both senses are handed.
    pub fn are_both(&self) -> bool {
        self.handed.iter().any(|one| one.opposite)
    }
}

/// Tests each cell of a joint fit with real coefficients by itself, with the terms of that fit and real parts of its own, as a single cell
/// is tested, at [`HANDED_RATE`] over the number of cells.
///
/// # Errors    of the input, as [`handedness()`]; [`crate::Error::Interrupted`]
/// # Checked by  `tests/all/together.rs`: cells and their mirror images, and mirror-symmetric ones
pub fn senses(tracks: &[Track], fit: &Fit, watch: &dyn Watch) -> Result<Senses> {
    observation::check(tracks, fit.library.modes)?;
    let settings = Settings { library: fit.library.clone(), handed: false, starts: Vec::new() };
    let (mut found, mut logs) = (Vec::new(), Vec::new());
    for (cell, track) in tracks.iter().enumerate() {
        let own = std::slice::from_ref(track);
        let real = refit(own, &settings, &fit.scales, &fit.theta(), watch)?;
        let test = handedness(own, &real, watch)?;
        let mut p = test.p_value.max(test.robust_p_value);
        if real.converged() && test.fit.converged() {
            logs.push(libm::log(p.max(f64::MIN_POSITIVE)));
        }
        if test.symmetry != Symmetry::Handed {
            continue;
        }
        let count = tracks.len() as f64;
        for beside in [Beside::Stage, Beside::Stretch] {
            if p * count < HANDED_RATE {
                p = p.max(handed_beside(beside, own, [&real, &test.fit], watch)?);
            }
        }
        if p * count < HANDED_RATE {
            p = p.max(handed_beside_change(own, [&real, &test.fit], watch)?);
        }
        if p * count < HANDED_RATE {
            found.push((HandedCell { cell, p_value: p * count, opposite: false }, test));
        }
    }
    sort_by_number(&mut found, |a| a.0.p_value);
    let first = found.first().and_then(|one| parts(&one.1));
    let turned = |test: &Handedness| {
        let [(first, weight), (own, _)] = [first.clone()?, parts(test)?];
        Some(first.dot(&(weight * own)) < 0.0)
    };
    let handed =
        found.iter().map(|(one, test)| HandedCell { opposite: turned(test) == Some(true), ..*one }).collect();
    Ok(Senses { handed, p_value: chi_square_tail(-2.0 * logs.iter().sum::<f64>(), 2.0 * logs.len() as f64) })
}

/// The imaginary parts, and the inverse of their covariance, in natural units.
fn parts(test: &Handedness) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let Fit { coefficients, natural, .. } = &test.fit;
    let places: Vec<usize> = (0..coefficients.len()).filter(|&i| coefficients[i].imaginary).collect();
    let n = places.len();
    let covariance = DMatrix::from_fn(n, n, |i, j| natural.covariance[places[i]][places[j]]);
    Some((DVector::from_fn(n, |i, _| natural.coefficients[places[i]]), covariance.cholesky()?.inverse()))
}
