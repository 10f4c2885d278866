//! From tracks and settings to a problem in natural units.

use super::Settings;
use crate::field::Field;
use crate::filter::{ETA_SHAPE, ETA_V, Problem, ProcessNoise};
use crate::library::LEAST_MODES;
use crate::{Error, Library, MOST_MODES, Result, Scales, Track, observation};
use motiform_dynamics::Complex;

/// Checks that the filter can take a library.
pub(crate) fn check_library(library: &Library) -> Result<()> {
    if !(LEAST_MODES..=MOST_MODES).contains(&library.modes) {
        let value = library.modes as f64;
        return Err(Error::Setting { key: "modes", value, remedy: "give 2, 3 or 4" });
    }
    if library.terms.is_empty() {
        return Err(Error::Setting { key: "terms", value: 0.0, remedy: "give at least one term" });
    }
    Ok(())
}

/// Checks tracks and settings; the natural units.
pub(super) fn check(tracks: &[Track], settings: &Settings) -> Result<Scales> {
    check_library(&settings.library)?;
    observation::check(tracks, settings.library.modes)?;
    match settings.starts.iter().find(|start| !(1e-4..=10.0).contains(*start)) {
        Some(&value) => Err(Error::Setting { key: "starts", value, remedy: "give 1e-4 to 10" }),
        None => Ok(Scales::of(tracks, settings.library.modes)),
    }
}

/// Refuses z4 where it is not seen. Of z2 and z3 [`crate::identifiability()`] says so; where z3 is not seen,
/// [`Library::seen`] leaves it out.
pub(super) fn check_seen(scales: &Scales) -> Result<()> {
    match scales.signal.get(3) {
        Some(&signal) if signal < 1.0 => Err(Error::NotSeen { mode: "z4", signal }),
        _ => Ok(()),
    }
}

/// The problem in natural units, as [`followed`].
pub(super) fn checked(tracks: &[Track], settings: &Settings, scales: &Scales) -> Result<Problem> {
    followed(problem(tracks, settings, scales), tracks, scales)
}

/// This problem, if frames are close enough to follow each other.
pub(super) fn followed(problem: Problem, tracks: &[Track], scales: &Scales) -> Result<Problem> {
    let usual = tracks.iter().map(Track::interval).fold(0.0, f64::max) / scales.time;
    let longest = Problem::longest_gap(usual) * scales.time;
    if problem.frames() == 0 { Err(Error::Gaps { longest }) } else { Ok(problem) }
}

/// The problem in natural units.
pub(crate) fn problem(tracks: &[Track], settings: &Settings, scales: &Scales) -> Problem {
    let library = &settings.library;
    Problem {
        field: Field::new(library),
        parts: Field::parts(&library.terms, settings.handed),
        given: vec![Complex::new(0.0, 0.0); library.terms.len()],
        stretches: tracks.iter().flat_map(|track| Problem::cut(scales.frames(track))).collect(),
        noise: scales.noise_of_modes().into_iter().enumerate().map(process).collect(),
        centre: scales.centre / (scales.length() * scales.length()),
        unseen: 0,
    }
}

/// The noise of an amplitude, from 0, by its variance for amplitude 1.
fn process((amplitude, variance): (usize, f64)) -> ProcessNoise {
    ProcessNoise { by: if amplitude == 0 { ETA_V } else { ETA_SHAPE }, variance }
}
