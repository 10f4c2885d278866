//! Quantities of a body, and their series along a track.

use crate::{Track, Tracks};

/// A quantity along a track.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Quantity {
    /// The velocity, a vector.
    Velocity,
    /// Its direction, a unit vector; none at rest.
    Heading,
    /// Its size, a number.
    Speed,
    /// A mode of the shape, a vector; its number and name.
    Mode(usize, String),
}

/// A quantity of one track.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// One or two components.
    pub components: Vec<Vec<f64>>,
    /// `true` for each sample that is defined (and, for a heading, not at rest); all are defined if `None`.
    /// Undefined samples are 0.
    pub defined: Option<Vec<bool>>,
}

impl Series {
    /// Samples that are not a number are not defined.
    pub(crate) fn new(mut components: Vec<Vec<f64>>) -> Self {
        let samples = components.first().map_or(0, Vec::len);
        let defined: Vec<bool> =
            (0..samples).map(|at| components.iter().all(|series| !series[at].is_nan())).collect();
        if defined.iter().all(|&there| there) {
            return Self { components, defined: None };
        }
        for series in &mut components {
            series.iter_mut().zip(&defined).filter(|(_, there)| !**there).for_each(|(x, _)| *x = 0.0);
        }
        Self { components, defined: Some(defined) }
    }

    /// The ranges without a gap.
    pub(crate) fn runs(&self) -> Vec<std::ops::Range<usize>> {
        let samples = self.components.first().map_or(0, Vec::len);
        let there = |at: usize| self.defined.as_ref().is_none_or(|defined| defined[at]);
        let mut runs = Vec::new();
        let mut begin = None;
        for at in 0..=samples {
            match (begin, at < samples && there(at)) {
                (None, true) => begin = Some(at),
                (Some(from), false) => {
                    runs.push(from..at);
                    begin = None;
                }
                _ => {}
            }
        }
        runs
    }

    /// Subtracts a number where it is defined.
    pub(crate) fn less(&mut self, mean: f64) {
        let defined = self.defined.as_deref();
        for component in &mut self.components {
            let there = |at: usize| defined.is_none_or(|defined| defined[at]);
            component.iter_mut().enumerate().filter(|(at, _)| there(*at)).for_each(|(_, x)| *x -= mean);
        }
    }

    /// Defined samples.
    pub(crate) fn count(&self) -> f64 {
        let all = self.components.first().map_or(0, Vec::len);
        self.defined.as_ref().map_or(all, |defined| defined.iter().filter(|there| **there).count()) as f64
    }
}

impl Quantity {
    /// Its name in tables.
    pub fn name(&self) -> &str {
        match self {
            Self::Velocity => "velocity",
            Self::Heading => "heading",
            Self::Speed => "speed",
            Self::Mode(_, name) => name,
        }
    }

    /// Returns `true` if it is a number, whose mean is subtracted from its fluctuations; a vector has the
    /// mean 0 by isotropy.
    pub fn is_number(&self) -> bool {
        matches!(self, Self::Speed)
    }

    /// Its series along a track.
    pub fn of(&self, track: &Track) -> Series {
        let vector = |pairs: &[[f64; 2]]| {
            Series::new((0..2).map(|k| pairs.iter().map(|pair| pair[k]).collect()).collect())
        };
        match self {
            Self::Velocity => vector(&track.velocity),
            Self::Speed => Series::new(vec![self.size(track)]),
            Self::Mode(number, _) => vector(&track.modes[*number]),
            Self::Heading => {
                let sizes = Self::Speed.size(track);
                let unit =
                    |(v, s): (&[f64; 2], &f64)| if *s > 0.0 { v.map(|x| x / s) } else { [f64::NAN; 2] };
                vector(&track.velocity.iter().zip(&sizes).map(unit).collect::<Vec<_>>())
            }
        }
    }

    /// Its size along a track: the speed, or the amplitude of a mode; NaN where it is missing.
    pub fn size(&self, track: &Track) -> Vec<f64> {
        let pairs = match self {
            Self::Mode(number, _) => &track.modes[*number],
            _ => &track.velocity,
        };
        pairs.iter().map(|[a, b]| libm::hypot(*a, *b)).collect()
    }
    /// Returns `true` if a quantity whose fluctuations have this variance does not vary: their size is below 1e-6 of its own, which
    /// round-off and the tolerance of a simulation leave.
    pub(crate) fn is_steady(&self, tracks: &Tracks, variance: f64) -> bool {
        let squares = tracks.units().iter().map(|track| {
            let series = self.of(track);
            series.components.iter().flatten().map(|x| x * x).sum::<f64>() / series.count().max(1.0)
        });
        variance.is_nan() || variance <= STEADY * STEADY * squares.fold(0.0, f64::max)
    }
}

/// Largest size of fluctuations of a quantity that does not vary, as a part of its own.
pub(crate) const STEADY: f64 = 1e-6;
