//! Rests of stop-and-go motion: when they begin, how long they last, how they grow.

use crate::{Error, Result, checks};

/// A stretch of time in which the size stays below its threshold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rest {
    /// The time when the size fell below.
    pub start: f64,
    /// The duration of the stay there.
    pub duration: f64,
}

/// The complete rests of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Rests {
    /// The value that the size was compared with.
    pub threshold: f64,
    /// In the order of time.
    pub rests: Vec<Rest>,
}

impl Rests {
    /// Duration of each rest over that of the one before it: about 1 for a periodic motion or with noise; above 1 near an
    /// attracting heteroclinic cycle without noise, where it falls slowly to [`Rests::growth`].
    pub fn ratios(&self) -> Vec<f64> {
        self.rests.windows(2).map(|pair| pair[1].duration / pair[0].duration).collect()
    }

    /// (T_3 - T_2)/(T_2 - T_1) for every three rests in a row that grow.
    ///
    /// Near an attracting heteroclinic cycle T_(n+1) = |lambda_-|/lambda_+ T_n + const: this is the ratio of the
    /// eigenvalues. The constant, which holds the choice of the threshold and the passage between rests, drops out.
    ///
    /// Source: Armbruster, Guckenheimer and Holmes (1988), Physica D 29, 257 (the law); the quotient: Aitken (1926).
    pub fn growth(&self) -> Vec<f64> {
        let steps: Vec<f64> = self.rests.windows(2).map(|pair| pair[1].duration - pair[0].duration).collect();
        let growing = steps.windows(2).filter(|pair| pair[0] > 0.0 && pair[1] > 0.0);
        growing.map(|pair| pair[1] / pair[0]).collect()
    }
}

/// Stretches in which `sizes` (a speed, a distance to an equilibrium) lie below `fraction` of their maximum.
///
/// The ends of a stretch are where the straight line between two samples meets the threshold. A stretch that is under
/// way at the first or at the last sample is incomplete and left out. The threshold is a choice: near a saddle a rest is
/// longer by ln(f/f') (1/lambda_+ + 1/|lambda_-|) for a fraction f > f': see [`Rests::growth`].
///
/// # Shapes    as many times as sizes, at least 3
/// # Errors    [`Error::Shape`], [`Error::TooFew`], [`Error::Order`] and [`Error::NotFinite`] for the samples;
/// [`Error::OutOfRange`] for a negative size or a fraction that is not between 0 and 1; [`Error::Constant`]
/// # Checked by  tests/all/rests.rs: sawtooth (exact), growing rests, incomplete ends; tests/all/heteroclinic.rs and
/// tests/all/bodies.rs: ratios of eigenvalues, with and without noise
pub fn rests(times: &[f64], sizes: &[f64], fraction: f64) -> Result<Rests> {
    check(times, sizes, fraction)?;
    let threshold = fraction * sizes.iter().fold(0.0, |m: f64, x| m.max(*x));
    let (mut rests, mut start) = (Vec::new(), None);
    for (t, x) in times.windows(2).zip(sizes.windows(2)) {
        let meeting = t[0] + (t[1] - t[0]) * (threshold - x[0]) / (x[1] - x[0]);
        match (x[0] < threshold, x[1] < threshold) {
            (false, true) => start = Some(meeting),
            (true, false) => {
                if let Some(start) = start.take() {
                    rests.push(Rest { start, duration: meeting - start });
                }
            }
            _ => {} // no meeting: the quotient is not looked at
        }
    }
    Ok(Rests { threshold, rests })
}

fn check(times: &[f64], sizes: &[f64], fraction: f64) -> Result<()> {
    checks::argument("the fraction", fraction, fraction > 0.0 && fraction < 1.0, "between 0 and 1")?;
    if times.len() != sizes.len() {
        return Err(Error::Shape { what: "the list of sizes", expected: times.len(), got: sizes.len() });
    }
    checks::at_least("a list of rests, in samples,", 3, sizes.len())?;
    checks::growing(times)?;
    checks::finite(sizes)?;
    let smallest = sizes.iter().fold(f64::INFINITY, |m: f64, x| m.min(*x));
    checks::argument("a size", smallest, smallest >= 0.0, "of at least 0")?;
    if sizes.iter().all(|x| *x == sizes[0]) {
        return Err(Error::Constant { value: sizes[0] });
    }
    Ok(())
}
