//! Tests for coefficients that change during the record, and the test of handedness that allows for such changes.
//!
//! A cell that turns one way while its coefficients change needs a different real coefficient at each time. One complex coefficient may
//! describe it better than one real coefficient does, and the cell is called handed. Where the law of each part of the record has real
//! coefficients of its own, this does not help.

use crate::fit::refit;
use crate::{Fit, Result, Settings, Track};
use motiform_dynamics::Watch;
use motiform_dynamics::distributions::chi_square_tail;
use nalgebra::{DMatrix, DVector};

/// Significance of coefficients that differ between the halves of a record: rare enough for a thousand cells.
pub const CHANGED: f64 = 1e-4;

/// The p-value of the coefficients of the first half of the record against those of the second: `d^T (C_1 + C_2)^-1 d` with their
/// difference d against chi-square, the larger one of that with expected and that with robust covariances.
///
/// `None` where a fit does not converge or leaves coefficients without bounds.
///
/// Source: Andrews and Fair (1988), Rev. Econ. Stud. 55, 615.
///
/// # Errors    of the input; [`crate::Error::Interrupted`]
/// # Checked by  `tests/all/change.rs`: chaotic cells whose law changes, zigzags that keep it
pub fn change(tracks: &[Track], fit: &Fit, watch: &dyn Watch) -> Result<Option<f64>> {
    let [(_, first), (_, second)] = cut(&(tracks.to_vec(), fit.clone()), 2, watch)?;
    let [one, other] = [&first.natural, &second.natural];
    let n = fit.coefficients.len();
    let differences = DVector::from_fn(n, |i, _| one.coefficients[i] - other.coefficients[i]);
    let p = |a: &[Vec<f64>], b: &[Vec<f64>]| {
        let factor = DMatrix::from_fn(n, n, |i, j| a[i][j] + b[i][j]).cholesky()?;
        Some(chi_square_tail(differences.dot(&factor.solve(&differences)), n as f64))
    };
    let known = [&first, &second].iter().all(|half| half.converged() && half.is_bounded() && half.frames > n);
    let ps = [p(&one.covariance, &other.covariance), p(&one.robust, &other.robust)];
    Ok(if known { ps.into_iter().reduce(|a, b| Some(a?.max(b?))).flatten() } else { None })
}

/// Times that each part is cut in two.
const LEVELS: usize = 2;

/// The p-value of the likelihood ratio of complex against real coefficients where parts of the record have coefficients and noise of their
/// own: the larger one of two and of four parts.
///
/// The record is cut where the likelihood of real coefficients of both parts is highest, and each part again. The ratios of all parts are
/// added, and so are their degrees of freedom. A part whose fits do not converge adds no ratio.
///
/// # Errors    of the input; [`crate::Error::Interrupted`]
/// # Checked by  `tests/all/change.rs`: circles whose law changes, and handed cells whose law does not
pub fn handed_beside_change(tracks: &[Track], [real, handed]: [&Fit; 2], watch: &dyn Watch) -> Result<f64> {
    let mut parts = vec![(tracks.to_vec(), real.clone())];
    let mut largest: f64 = 0.0;
    for _ in 0..LEVELS {
        let cut: Result<Vec<[Part; 2]>> = parts.iter().map(|part| best_cut(part, watch)).collect();
        parts = cut?.into_iter().flatten().collect();
        largest = largest.max(handed_parts(&parts, handed, watch)?);
    }
    Ok(largest)
}

/// The p-value of the ratios of all parts.
fn handed_parts(parts: &[Part], handed: &Fit, watch: &dyn Watch) -> Result<f64> {
    let mut ratio = 0.0;
    for (tracks, real) in parts {
        let handed = refitted(tracks, handed, watch)?;
        if real.converged() && handed.converged() {
            ratio += 2.0 * (handed.log_likelihood - real.log_likelihood).max(0.0);
        }
    }
    let more = handed.coefficients.len() / 2; // half of them are imaginary
    Ok(chi_square_tail(ratio, (parts.len() * more) as f64))
}

/// A part of each track, and the fit to it.
type Part = (Vec<Track>, Fit);

/// The fit with the terms of another one, from there.
fn refitted(tracks: &[Track], fit: &Fit, watch: &dyn Watch) -> Result<Fit> {
    let settings = Settings { library: fit.library.clone(), handed: fit.handed, starts: Vec::new() };
    refit(tracks, &settings, &fit.scales, &fit.theta(), watch)
}

/// Both parts of a part, cut at the quarter of its frames where the sum of their likelihoods is highest.
fn best_cut(part: &Part, watch: &dyn Watch) -> Result<[Part; 2]> {
    let mut best = cut(part, 2, watch)?;
    for quarters in [1, 3] {
        let other = cut(part, quarters, watch)?;
        let height = |parts: &[Part; 2]| parts[0].1.log_likelihood + parts[1].1.log_likelihood;
        if height(&other) > height(&best) {
            best = other;
        }
    }
    Ok(best)
}

/// The first so many quarters of the frames of each track, and the rest.
fn cut((tracks, fit): &Part, quarters: usize, watch: &dyn Watch) -> Result<[Part; 2]> {
    let at = |track: &Track| {
        let (first, rest) = track.0.split_at(track.0.len() * quarters / 4);
        (Track(first.to_vec()), Track(rest.to_vec()))
    };
    let long = tracks.iter().filter(|track| track.0.len() >= 4); // else a part has no frame
    let (first, rest): (Vec<_>, Vec<_>) = long.map(at).unzip();
    let [one, other] = [refitted(&first, fit, watch)?, refitted(&rest, fit, watch)?];
    Ok([(first, one), (rest, other)])
}
