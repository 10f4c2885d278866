//! The samples: tracks of bodies, and the units over which errors are taken.

use crate::{Error, Quantity, Result};
use serde::Serialize;

/// From this number of bodies on, errors are those over bodies.
const BODIES: usize = 8;

/// Fewest blocks into which fewer bodies are cut.
const BLOCKS: usize = 16;

/// Blocks of starting times into which few records are cut.
const STARTS: usize = 8;

/// Fewest samples of a body, and of a block.
const LEAST: usize = 16;

/// Largest number whose square, summed over a track, is finite.
const LARGEST: f64 = 1e150;

/// Most groups of units: each is left out once.
const GROUPS: usize = 64;

/// One body, sampled evenly.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Track {
    /// Positions.
    pub position: Vec<[f64; 2]>,
    /// Velocities at the same times.
    pub velocity: Vec<[f64; 2]>,
    /// Modes of the shape, two components each, which the plane's rotations turn.
    pub modes: Vec<Vec<[f64; 2]>>,
    /// Time derivatives of the velocity and of each mode by the equations of the body, without noise; none where equations are not known.
    pub rates: Vec<Vec<[f64; 2]>>,
}

/// The units that errors refer to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(tag = "over", rename_all = "kebab-case")]
pub enum Errors {
    /// Bodies, which are independent.
    Bodies {
        /// Their number.
        count: usize,
    },
    /// Blocks of the tracks, independent if they are long compared with all correlation times. Lags end
    /// within a block, or, by [`Tracks::of_records`], are as long as one.
    Blocks {
        /// Their number.
        count: usize,
        /// Samples of the shortest one.
        samples: usize,
    },
}

/// Tracks of bodies, sampled every `dt`; lengths may differ.
///
/// With 8 bodies and more, a unit is a body. Fewer are cut into at least 16 blocks altogether, and a unit is
/// a block: then nothing longer than a block is seen. Intervals are Student's, by leaving out each unit in
/// turn (of more than 64 units: each of 64 groups).
#[derive(Debug, Clone, PartialEq)]
pub struct Tracks {
    dt: f64,
    /// The unit of times in sentences; empty in model units.
    unit: String,
    names: Vec<String>,
    bodies: Vec<Track>,
    /// Blocks, where units are not bodies.
    blocks: Option<Vec<Track>>,
    /// Blocks of starting times of each body, where windows may end beyond.
    pieces: Option<usize>,
    errors: Errors,
    /// `true` under noise, `false` without; `None` where that is not known.
    noise: Option<bool>,
}

impl Tracks {
    /// Tracks sampled every `dt`, with the names of their modes.
    ///
    /// # Errors   no body, `dt` not positive, series of different lengths, fewer than 16 samples, a sample that is not finite
    pub fn new(dt: f64, names: Vec<String>, bodies: Vec<Track>) -> Result<Self> {
        check_all(dt, &names, &bodies, false)?;
        Self::in_units(dt, names, bodies)
    }

    /// The same of tracks with gaps, such as those of cells: what is missing is NaN, in each series by itself
    /// ([`Track::without`] marks whole samples). A displacement, a pair of a correlation or a turn counts
    /// where its samples are there; a duration that meets a gap is one that was not watched to its end;
    /// spectra use stretches without gaps.
    ///
    /// # Errors   as [`Tracks::new`]; fewer than 16 positions of a body that are there
    /// # Checked by  tests/all/gaps.rs: exact processes with samples left out, direct sums
    pub fn with_gaps(dt: f64, names: Vec<String>, bodies: Vec<Track>) -> Result<Self> {
        check_all(dt, &names, &bodies, true)?;
        for (body, track) in bodies.iter().enumerate() {
            let samples = track.position.iter().filter(|pair| !pair[0].is_nan() && !pair[1].is_nan()).count();
            if samples < LEAST {
                return Err(Error::TooShort { body, samples, least: LEAST });
            }
        }
        Self::in_units(dt, names, bodies)
    }

    /// The same of bodies whose equations are known to have noise, or none: without it they are smooth between samples.
    #[must_use]
    pub fn with_noise(self, is_noisy: bool) -> Self {
        Self { noise: Some(is_noisy), ..self }
    }

    /// The same with this unit of times, which sentences have: `s`, `frames`.
    #[must_use]
    pub fn with_times_in(self, unit: &str) -> Self {
        Self { unit: unit.to_owned(), ..self }
    }

    /// The unit of times.
    pub(crate) fn unit(&self) -> &str {
        &self.unit
    }

    /// Returns `true` if it is known that there is noise.
    pub(crate) fn is_noisy(&self) -> bool {
        self.noise == Some(true)
    }

    /// Returns `true` if all is smooth between samples, and its rates are known.
    pub(crate) fn is_smooth(&self) -> bool {
        self.noise == Some(false) && self.bodies.iter().all(|track| !track.rates.is_empty())
    }

    fn in_units(dt: f64, names: Vec<String>, bodies: Vec<Track>) -> Result<Self> {
        let (blocks, errors) = units(&bodies)?;
        Ok(Self { dt, unit: String::new(), names, bodies, blocks, pieces: None, errors, noise: None })
    }

    /// The same for few short records, such as an observed cell: with fewer than 8 bodies, windows are
    /// grouped into at least 8 blocks by where they begin, and may end in the next block. So lags reach an
    /// eighth of the record. Neighbouring groups share samples: at lags of a block's length intervals are
    /// somewhat too short.
    ///
    /// # Errors   as [`Tracks::new`]
    /// # Checked by  tests/all/records.rs: coverage
    pub fn of_records(dt: f64, names: Vec<String>, bodies: Vec<Track>) -> Result<Self> {
        if bodies.is_empty() || bodies.len() >= BODIES {
            return Self::new(dt, names, bodies);
        }
        check_all(dt, &names, &bodies, false)?;
        let pieces = STARTS.div_ceil(bodies.len());
        let length = |track: &Track| track.position.len() / pieces;
        let cut = |track: &Track| {
            let length = length(track);
            let parts = (0..pieces).map(|block| track.part(block * length, length));
            parts.collect::<Vec<_>>()
        };
        let errors = Errors::Blocks {
            count: pieces * bodies.len(),
            samples: bodies.iter().map(length).min().unwrap_or(0),
        };
        let blocks = Some(bodies.iter().flat_map(cut).collect());
        Ok(Self { dt, unit: String::new(), names, bodies, blocks, pieces: Some(pieces), errors, noise: None })
    }

    /// Blocks of starting times of each body, where there are some.
    pub(crate) fn pieces(&self) -> Option<usize> {
        self.pieces
    }

    /// Time between samples.
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// The bodies.
    pub fn bodies(&self) -> &[Track] {
        &self.bodies
    }

    /// The units: bodies, or blocks of them.
    pub fn units(&self) -> &[Track] {
        self.blocks.as_ref().unwrap_or(&self.bodies)
    }

    /// The units that errors refer to.
    pub fn errors(&self) -> Errors {
        self.errors
    }

    /// Number of groups of units, each left out once: at most 64.
    pub fn groups(&self) -> usize {
        self.units().len().min(GROUPS)
    }

    /// The group of a unit.
    pub fn group(&self, unit: usize) -> usize {
        unit % self.groups()
    }

    /// Longest lag in samples: half of the longest unit; a whole one where windows may end in the next one.
    pub fn longest_lag(&self) -> usize {
        let longest = self.units().iter().map(|unit| unit.position.len()).max().unwrap_or(0);
        if self.pieces.is_some() { longest } else { longest / 2 }
    }

    /// Velocity, heading, speed and the modes.
    pub fn quantities(&self) -> Vec<Quantity> {
        let modes = self.names.iter().enumerate().map(|(number, name)| Quantity::Mode(number, name.clone()));
        [Quantity::Velocity, Quantity::Heading, Quantity::Speed].into_iter().chain(modes).collect()
    }

    /// The speed or a mode, by its name.
    ///
    /// # Errors   [`Error::Quantity`]
    pub fn sized(&self, name: &str) -> Result<Quantity> {
        let mut known =
            self.quantities().into_iter().filter(|q| !matches!(q, Quantity::Velocity | Quantity::Heading));
        known.find(|quantity| quantity.name() == name).ok_or_else(|| Error::Quantity {
            name: name.to_owned(),
            known: std::iter::once("speed".to_owned()).chain(self.names.iter().cloned()).collect(),
        })
    }
}

fn check_all(dt: f64, names: &[String], bodies: &[Track], gaps: bool) -> Result<()> {
    if !(dt > 0.0 && dt.is_finite()) {
        return Err(Error::Interval { dt });
    }
    if bodies.is_empty() {
        return Err(Error::NoBody);
    }
    bodies.iter().enumerate().try_for_each(|(body, track)| check(body, track, names, gaps))
}

fn check(body: usize, track: &Track, names: &[String], gaps: bool) -> Result<()> {
    let samples = track.position.len();
    if samples < LEAST {
        return Err(Error::TooShort { body, samples, least: LEAST });
    }
    if track.modes.len() != names.len() {
        return Err(Error::Modes { body, got: track.modes.len(), expected: names.len() });
    }
    let modes = names.iter().map(String::as_str).zip(&track.modes);
    let all = [("position", &track.position), ("velocity", &track.velocity)].into_iter().chain(modes);
    for (what, series) in all {
        let what = what.to_owned();
        if series.len() != samples {
            return Err(Error::Lengths { body, what, got: series.len(), expected: samples });
        }
        let bad = series.iter().enumerate().find_map(|(i, pair)| {
            pair.iter().find(|x| (x.is_nan() && !gaps) || x.abs() > LARGEST).map(|&value| (i, value))
        });
        if let Some((sample, value)) = bad {
            return Err(Error::NotFinite { body, what, sample, value });
        }
    }
    let short = |series: &&Vec<[f64; 2]>| series.len() != samples;
    let (got, expected) = match track.rates.iter().find(short) {
        Some(series) => (series.len(), samples),
        None if track.rates.is_empty() => return Ok(()),
        None => (track.rates.len(), 1 + names.len()),
    };
    let what = "rates".to_owned();
    if got == expected { Ok(()) } else { Err(Error::Lengths { body, what, got, expected }) }
}

/// No blocks where units are bodies; else blocks of equal length of each.
fn units(bodies: &[Track]) -> Result<(Option<Vec<Track>>, Errors)> {
    if bodies.len() >= BODIES {
        return Ok((None, Errors::Bodies { count: bodies.len() }));
    }
    let pieces = BLOCKS.div_ceil(bodies.len());
    let mut blocks = Vec::new();
    let mut shortest = usize::MAX;
    for (body, track) in bodies.iter().enumerate() {
        let samples = track.position.len();
        let length = samples / pieces;
        if length < LEAST {
            return Err(Error::TooShort { body, samples, least: LEAST * pieces });
        }
        shortest = shortest.min(length);
        blocks.extend((0..pieces).map(|block| track.part(block * length, length)));
    }
    let errors = Errors::Blocks { count: blocks.len(), samples: shortest };
    Ok((Some(blocks), errors))
}

impl Track {
    /// The track without the samples that are marked as missing: they become NaN in all series ([`Tracks::with_gaps`]).
    #[must_use]
    pub fn without(mut self, missing: &[bool]) -> Self {
        let all = [&mut self.position, &mut self.velocity].into_iter();
        let all = all.chain(&mut self.modes).chain(&mut self.rates);
        for series in all {
            series
                .iter_mut()
                .zip(missing)
                .filter(|(_, gone)| **gone)
                .for_each(|(pair, _)| *pair = [f64::NAN; 2]);
        }
        self
    }

    fn part(&self, from: usize, length: usize) -> Self {
        let cut = |series: &[[f64; 2]]| series[from..from + length].to_vec();
        Self {
            position: cut(&self.position),
            velocity: cut(&self.velocity),
            modes: self.modes.iter().map(|mode| cut(mode)).collect(),
            rates: self.rates.iter().map(|rate| cut(rate)).collect(),
        }
    }
}
