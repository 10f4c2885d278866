//! All statistics of a set of tracks.

use crate::blocks::dependent;
use crate::carried::carried;
use crate::correlation::{self, remembered};
use crate::diffusion;
use crate::jackknife::Sums;
use crate::resolution::too_far_apart;
use crate::stationary::not_stationary;
use crate::unlike::unlike;
use crate::{
    Answer, Autocorrelation, Diffusion, Errors, Histogram, MeanSquare, Measured, Passage, PowerSpectrum,
    Quantity, Residence, Result, Seen, Track, Tracks, Turning, Walk, first_passages, histogram,
    local_exponent, mean_square, persistent_walk, power_spectrum, radii, residence, turning_angles,
};
use motiform_dynamics::Watch;
use motiform_dynamics::sample::ascending;
use motiform_dynamics::sample::mean;

/// Steps of the work beside the correlation of each quantity: memory, diffusion, the rest.
const STEPS_BESIDE: usize = 3;

/// Bins of the speed.
const BINS: usize = 40;

/// Settings of the statistics that have no default independent of the data.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Settings {
    /// Radii of the discs; chosen from the displacements if there are none.
    pub radii: Vec<f64>,
    /// Quantity and threshold of the residence times: the speed, and its median, if not given.
    pub threshold: Option<(String, Option<f64>)>,
}

/// All statistics of a set of tracks; what cannot be computed says why in its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Statistics {
    /// Bodies.
    pub bodies: usize,
    /// Time between samples.
    pub dt: f64,
    /// Samples of the shortest and of the longest track.
    pub samples: [usize; 2],
    /// The units that errors refer to.
    pub errors: Errors,
    /// Why the records are not those of a stationary motion; `None` where nothing says so. Else what is defined for stationary motion alone
    /// is unknown: persistence, diffusion coefficients, correlation times, frequencies. All other numbers are those of the records.
    pub not_stationary: Option<String>,
    /// Why the bodies are not of one motion; `None` where nothing says so. Else the same is unknown.
    pub unlike_bodies: Option<String>,
    /// Why numbers have no intervals; `None` where they have. Blocks of few bodies that are not long against the memory of the motion
    /// depend on each other, and intervals over them would be too narrow.
    pub no_intervals: Option<String>,
    /// Mean speed <|v|>.
    pub mean_speed: Measured,
    /// Root-mean-square speed.
    pub rms_speed: Measured,
    /// Mean-square displacement.
    pub displacement: MeanSquare,
    /// The fit of a persistent random walk.
    pub walk: Walk,
    /// Diffusion coefficient without a model of the motion.
    pub diffusion: Diffusion,
    /// Exponents of the mean-square displacement at the shortest lag and over the last octave.
    pub exponents: [Answer; 2],
    /// Autocorrelations of velocity, heading, speed and the modes.
    pub autocorrelations: Vec<Autocorrelation>,
    /// Distribution of the speed; `None` if it does not vary.
    pub speeds: Option<Histogram>,
    /// Distributions of turning angles, by lag.
    pub turning: Vec<Turning>,
    /// First-passage times, by radius.
    pub passages: Vec<Passage>,
    /// Residence times.
    pub residence: Residence,
    /// Power spectra of what varies; none where tracks are too short.
    pub spectra: Vec<PowerSpectrum>,
}

/// All statistics of the tracks.
///
/// # Errors   an unknown quantity, radii that are not finite and above 0
pub fn statistics(tracks: &Tracks, settings: &Settings) -> Result<Statistics> {
    statistics_watched(tracks, settings, &())
}

/// As [`statistics`]; the watch is told how much is done, and is not asked if it stopped.
///
/// # Errors   as [`statistics`]
pub fn statistics_watched(tracks: &Tracks, settings: &Settings, watch: &dyn Watch) -> Result<Statistics> {
    let (residing, threshold) = match &settings.threshold {
        None => (Quantity::Speed, None),
        Some((name, threshold)) => (tracks.sized(name)?, *threshold),
    };
    let displacement = mean_square(tracks);
    let radii = discs(settings, &displacement)?;
    let quantities = tracks.quantities();
    let remembered = remembered(tracks)?;
    let at = |done: usize| watch.progress(done as f64 / (quantities.len() + STEPS_BESIDE) as f64);
    at(1);
    let of = |(number, quantity): (usize, &Quantity)| {
        let found = correlation::remembering(tracks, quantity, &remembered)?;
        at(number + 2);
        Ok(found)
    };
    let autocorrelations = quantities.iter().enumerate().map(of).collect::<Result<Vec<_>>>()?;
    let varying = autocorrelations.iter().filter(|found| !found.lags.is_empty());
    let spectra = varying
        .filter(|found| found.quantity != Quantity::Heading) // it may have gaps
        .filter(|found| found.unresolved.is_none()) // its frequencies are others
        .map(|found| power_spectrum(tracks, &found.quantity))
        .collect::<Result<Vec<_>>>()?;
    let lengths = || tracks.bodies().iter().map(|track| track.position.len());
    let [mean_speed, square] = [1, 2].map(|power| moment(tracks, power));
    let rms_speed = square.map(|x| x.max(0.0).sqrt());
    let exponents = [true, false].map(|first| local_exponent(&displacement, first));
    let carried = carried(tracks);
    let (diffusion, slow) = diffusion::remembering(tracks, &remembered)?;
    let diffusion = diffusion.held_against(&exponents[1]).beside(remembered.kept).doubted(carried.as_deref());
    at(quantities.len() + 2);
    let autocorrelations: Vec<_> =
        autocorrelations.into_iter().map(|found| found.carried(carried.as_deref())).collect();
    let seen =
        Seen { speed: &rms_speed, diffusion: &diffusion.displacements, time: &autocorrelations[0].time };
    let found = Statistics {
        bodies: tracks.bodies().len(),
        dt: tracks.dt(),
        samples: [lengths().min().unwrap_or(0), lengths().max().unwrap_or(0)],
        errors: tracks.errors(),
        not_stationary: None,
        unlike_bodies: None,
        no_intervals: None,
        mean_speed,
        rms_speed,
        walk: persistent_walk(&displacement)
            .held_against(&seen)
            .beside(slow.as_ref(), &diffusion.displacements)
            .carried(carried.is_some()),
        diffusion,
        exponents,
        speeds: speeds(tracks),
        turning: turning_angles(tracks),
        passages: passages(tracks, &radii, rms_speed.value),
        residence: residence(tracks, &residing, threshold),
        displacement,
        autocorrelations,
        spectra: spectra.into_iter().flatten().collect(),
    };
    at(quantities.len() + STEPS_BESIDE);
    let found = found.without_intervals(dependent(tracks)?);
    let (changed, differ) = (not_stationary(tracks), unlike(tracks));
    let reason = match (&changed, &differ) {
        (Some(_), _) => {
            "the records are not stationary: leave out more at their beginning (transient), or record longer"
        }
        (None, Some(_)) => "bodies differ over their whole records, so that these are not of one motion",
        (None, None) => return Ok(found),
    };
    Ok(Statistics { not_stationary: changed, unlike_bodies: differ, ..found.of_records_alone(reason) })
}

/// Smallest radius, in ways that a body goes between samples, of a disc that it is seen to leave where it turns between them.
const STEPS: f64 = 5.0;

/// First passages; of discs about as small as a way between samples that are too far apart for the velocity, the mean is not known.
fn passages(tracks: &Tracks, radii: &[f64], speed: f64) -> Vec<Passage> {
    let coarse = too_far_apart(tracks, &Quantity::Velocity);
    let least = STEPS * speed * tracks.dt();
    let held = |found: Passage| {
        let reason = coarse.as_ref().filter(|_| found.radius < least);
        Passage { time: found.time.unless(reason), ..found }
    };
    first_passages(tracks, radii).into_iter().map(held).collect()
}

/// The radii of the discs, increasing.
fn discs(settings: &Settings, displacement: &MeanSquare) -> Result<Vec<f64>> {
    if settings.radii.is_empty() {
        return Ok(radii(displacement));
    }
    let mut given = settings.radii.clone();
    ascending(&mut given);
    match given.iter().find(|radius| !(**radius > 0.0 && radius.is_finite())) {
        Some(&value) => Err(crate::Error::Setting { key: "disc", value, remedy: "give a radius above 0" }),
        None => Ok(given),
    }
}

/// <|v|^power>.
fn moment(tracks: &Tracks, power: i32) -> Measured {
    let mut sums = Sums::new(tracks.groups());
    for (unit, track) in tracks.units().iter().enumerate() {
        let speeds: Vec<f64> = present(track).collect();
        let sum = speeds.iter().map(|speed| if power == 1 { *speed } else { speed * speed }).sum();
        sums.add(tracks.group(unit), sum, speeds.len() as f64);
    }
    sums.measured()
}

/// The speeds that are there.
fn present(track: &Track) -> impl Iterator<Item = f64> {
    Quantity::Speed.size(track).into_iter().filter(|speed| !speed.is_nan())
}

/// The distribution of the speed between its extremes.
fn speeds(tracks: &Tracks) -> Option<Histogram> {
    let of = |(unit, track)| {
        let group = tracks.group(unit);
        present(track).map(move |speed| (group, speed))
    };
    let samples: Vec<(usize, f64)> = tracks.units().iter().enumerate().flat_map(of).collect();
    let ends = samples.iter().fold((f64::MAX, 0.0_f64), |(low, high), s| (low.min(s.1), high.max(s.1)));
    let centre = mean(samples.iter().map(|s| s.1))?;
    let variance = mean(samples.iter().map(|s| (s.1 - centre) * (s.1 - centre)))?;
    (!Quantity::Speed.is_steady(tracks, variance)).then(|| histogram(&samples, tracks.groups(), ends, BINS))
}
