//! The evidence of the classifier of simulated motions (docs/regimes.md), taken from the samples of a record: spectra with their peaks,
//! rests, legs and turns, rotation, the 0-1 test. Definitions: docs/cells.md, section 'Observed motion'.

mod legs;
mod rests;
mod rotation;
mod spectra;
mod zero_one;

pub use legs::ObservedLegs;
pub use rests::ObservedRests;
pub use rotation::Rotation;
pub use spectra::{ObservedSpectrum, SpectralPeak};
pub use zero_one::ObservedChaos;

use super::measures::{Measures, Series};
use motiform_inference::Observation;
use serde::Serialize;

/// Something that a record shows, or why it does not.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Finding<T> {
    /// It is shown.
    Found(T),
    /// It is not.
    Missing {
        /// Why, as a clause.
        reason: String,
    },
}

impl<T> Finding<T> {
    /// The findings.
    pub fn found(&self) -> Option<&T> {
        match self {
            Self::Found(found) => Some(found),
            Self::Missing { .. } => None,
        }
    }

    fn missing(reason: impl Into<String>) -> Self {
        Self::Missing { reason: reason.into() }
    }
}

/// All of them, of the longest stretch without gaps.
///
/// # Units   of the data
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Relatives {
    /// Power spectra of speed, |z2| and z2 across the motion.
    pub spectra: Vec<ObservedSpectrum>,
    /// Rests.
    pub rests: Finding<ObservedRests>,
    /// Legs and turns.
    pub legs: Finding<ObservedLegs>,
    /// Rotation of the heading and of the shape.
    pub rotation: Rotation,
    /// The 0-1 test.
    pub zero_one: Finding<ObservedChaos>,
}

impl Relatives {
    pub(super) fn of(measures: &Measures) -> Self {
        Self {
            spectra: spectra::of(&measures.series),
            rests: rests::of(measures),
            legs: legs::of(measures),
            rotation: rotation::of(&measures.series),
            zero_one: zero_one::of(&measures.series),
        }
    }
}

/// The frames in the middle of the displacements, one for each heading and speed.
fn middles(series: &Series) -> &[Observation] {
    &series.frames[series.lag / 2..][..series.speeds.len()]
}

/// `z2 exp(2 i heading)`: its real part is the elongation along the motion, its imaginary part that at 45 degrees to it, which the
/// mirror reverses.
fn along_and_across(series: &Series) -> Vec<[f64; 2]> {
    let turned = |(frame, heading): (&Observation, &f64)| {
        let (sin, cos) = libm::sincos(2.0 * heading);
        let (re, im) = (frame.y[2], frame.y[3]);
        [re * cos - im * sin, re * sin + im * cos]
    };
    middles(series).iter().zip(&series.headings).map(turned).collect()
}
