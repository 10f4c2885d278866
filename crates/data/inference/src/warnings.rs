//! The warnings about a fit.

mod drift;
mod noises;
mod stretch;
mod whiteness;

pub use drift::{Drift, DriftPoint, drift};
pub use noises::UnequalNoise;
pub use stretch::Stretch;
pub(crate) use whiteness::ljung_box;
pub use whiteness::{Channel, whiteness};

use crate::field::{Field, Values};
use crate::filter::Frame;
use crate::fit::refit;
use crate::identifiability::unbounded;
use crate::{Fit, PValue, Result, Settings, StageVelocity, Track, observation, stage_velocities};
use motiform_dynamics::digits::with_error;
use motiform_dynamics::eigenvalues::eigenvalues;
use motiform_dynamics::sample::ascending;
use motiform_dynamics::{Complex, Watch};
use serde::{Deserialize, Serialize};

/// Sampling interval times fastest rate from which on the filter's linearisation biases coefficients.
pub const COARSE: f64 = 2.0;
/// Significance of a test of whiteness, of all channels together.
const WHITE: f64 = 1e-3;
/// Ratio of robust to expected standard errors that is worth a warning.
const ERRORS_DIFFER: f64 = 1.5;
/// Significance of a velocity that does not turn with the cell.
const CARRIED: f64 = 1e-3;
/// Its least size, as a part of the root mean square of the speed: a record without noise shows the errors of
/// the filter (zigzag of Fig. 5(a): 3e-4).
const LEAST_CARRIED: f64 = 0.005;
/// Noises of a fit.
const NOISES: [&str; 3] = [
    "s (the factor of the stated errors of the outlines)",
    "eta_v (noise of the velocity)",
    "eta_shape (noise of the shape)",
];
/// Frames whose rates are computed.
const RATES: usize = 60;

/// A reason to doubt a fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Warning {
    /// The sampling is too coarse for the motion.
    CoarseSampling {
        /// Sampling interval times the fastest rate (median over frames).
        product: f64,
    },
    /// Coefficients that the data do not bound.
    Unbounded {
        /// Their names.
        names: Vec<String>,
    },
    /// Process or measurement noise at the upper bound of the search. At the lower one there is none to be seen, which is no fault.
    NoiseAtBound {
        /// The names of the noises.
        names: Vec<String>,
    },
    /// Innovations are not white: noise with memory, or missing terms.
    Coloured {
        /// The channels.
        channels: Vec<Channel>,
    },
    /// Coefficients change with the sampling interval.
    Drifting {
        /// Their names.
        names: Vec<String>,
    },
    /// Coefficients of the first half of the record are not those of the second.
    Changing {
        /// The significance.
        p_value: f64,
    },
    /// Outlines are elongated along one direction whatever the heading, as [`Stretch`] says of one cell: no
    /// equations that keep their form under rotations do this.
    Stretched {
        /// Mean elongation that does not turn with the cell, over the root mean square of `|z2|`.
        share: f64,
        /// Its direction, in degrees from the x axis.
        degrees: f64,
        /// Its significance.
        p_value: f64,
    },
    /// The cell has a velocity that does not turn with it: the stage drifts, or a flow carries the cell.
    Carried {
        /// The velocity of highest likelihood, to first order, with its standard errors (length/time); `None` where it exceeds the
        /// speed of the cell, and first order is not enough.
        velocity: Option<[[f64; 2]; 2]>,
        /// Its significance; `None` where the innovations are not white: then the test does not hold.
        p_value: Option<f64>,
        /// The unit of the velocity; empty where the caller did not say it.
        #[serde(default)]
        unit: String,
        /// The remedy, as a clause.
        #[serde(default)]
        remedy: String,
    },
    /// Robust standard errors are much larger than expected ones.
    ErrorsDiffer {
        /// Median ratio.
        ratio: f64,
    },
    /// Modes of the shape have different noise, and the fit has one amplitude for all of them.
    UnequalNoise(UnequalNoise),
    /// Several cells do not follow one law.
    CellsDiffer {
        /// Coefficients in which they differ.
        names: Vec<String>,
        /// The smallest significance.
        p_value: f64,
    },
    /// The search did not converge.
    NotConverged {
        /// The reason.
        reason: String,
    },
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::CoarseSampling { product } => {
                write!(
                    f,
                    "sampling interval times fastest rate is {product:.2}, above {COARSE}: coefficients are biased; sample more often"
                )
            }
            Self::Unbounded { names } => write!(f, "the data do not bound {}", names.join(", ")),
            Self::NoiseAtBound { names } => write!(
                f,
                "at the upper bound of the search: {}; the equations describe little of the record, or the stated errors are far too small",
                names.join(", ")
            ),
            Self::Coloured { channels } => {
                let names: Vec<&str> = channels.iter().map(|channel| channel.name.as_str()).collect();
                write!(
                    f,
                    "innovations of {} are not white: the noise has memory or terms are missing",
                    names.join(", ")
                )
            }
            Self::Changing { p_value } => write!(
                f,
                "coefficients of the first half of the record are not those of the second ({}): the cell changes",
                PValue(*p_value)
            ),
            Self::Drifting { names } => {
                write!(f, "coefficients change with the sampling interval: {}", names.join(", "))
            }
            Self::Stretched { share, degrees, p_value } => write!(
                f,
                "outlines are elongated at {:.0} degrees from the x axis whatever the heading, by {:.0} % \
                of their root mean square elongation ({}): pixels are not square, or a \
                direction of the surroundings acts on the shape",
                degrees.round() + 0.0, // no minus before 0
                100.0 * share,
                PValue(*p_value)
            ),
            Self::Carried { velocity, p_value, unit, remedy } => {
                let unit = if unit.is_empty() { "in the units of the record" } else { unit };
                let size = velocity.map_or_else(String::new, |[[x, y], [dx, dy]]| {
                    format!(" of ({}, {}) {unit}", with_error(x, dx), with_error(y, dy))
                });
                let p = match p_value {
                    Some(p) => PValue(*p).to_string(),
                    None => {
                        "the innovations are not white, so that no p-value says how sure that is".to_owned()
                    }
                };
                write!(
                    f,
                    "a velocity{size} does not turn with the cell ({p}): the stage drifts, a flow carries it, it is held near a place, \
                    or the equations do not describe it; {remedy}"
                )
            }
            Self::ErrorsDiffer { ratio } => {
                write!(
                    f,
                    "robust standard errors are {ratio:.1} times the expected ones: use the robust ones"
                )
            }
            Self::UnequalNoise(UnequalNoise { modes: [one, two], ratio, p_value }) => write!(
                f,
                "innovations of z{one} have {ratio:.2} times the variance of those of z{two} ({}): their noise differs, and the model has \
                 one amplitude for all modes, so errors are too small for some coefficients and too large for others",
                PValue(*p_value)
            ),
            Self::CellsDiffer { names, p_value } => write!(
                f,
                "cells differ in {} ({}): the coefficients are means over these cells, and their intervals those of a mean over \
                 such cells; \
                 fits of single cells show which differ",
                names.join(", "),
                PValue(*p_value)
            ),
            Self::NotConverged { reason } => write!(f, "the fit did not converge: {reason}"),
        }
    }
}

/// All warnings about a fit; coefficients at other sampling intervals come from [`drift()`], which fits again.
///
/// # Errors    of the input, as [`crate::fit()`]
/// # Checked by  `tests/all/warnings.rs`: each warning by a cell that deserves it, none by one that does not
pub fn warnings(tracks: &[Track], fit: &Fit, drift: Option<&Drift>) -> Result<Vec<Warning>> {
    observation::check(tracks, fit.library.modes)?;
    let mut all = Vec::new();
    if let crate::Ending::Stopped { reason } = &fit.ending {
        all.push(Warning::NotConverged { reason: reason.clone() });
    }
    let product = fastest_rate(tracks, fit) * tracks.iter().map(Track::interval).fold(0.0, f64::max);
    if product > COARSE {
        all.push(Warning::CoarseSampling { product });
    }
    let names = unbounded(fit);
    if !names.is_empty() {
        all.push(Warning::Unbounded { names });
    }
    let at_bound = fit.noise.at_bound.iter().zip(fit.natural.logs).map(|(at, log)| *at && log > 0.0);
    let names: Vec<String> =
        NOISES.into_iter().zip(at_bound).filter(|(_, at)| *at).map(|(name, _)| name.to_owned()).collect();
    if !names.is_empty() {
        all.push(Warning::NoiseAtBound { names });
    }
    let channels = coloured(fit);
    let white = channels.is_empty();
    if !white {
        all.push(Warning::Coloured { channels });
    }
    if let Some(names) = drift.map(Drift::names).filter(|names| !names.is_empty()) {
        all.push(Warning::Drifting { names });
    }
    all.extend(stretched(tracks));
    if fit.converged() {
        let found = stage_velocities(tracks, fit)?.into_iter().flatten();
        all.extend(carried(found.map(|one| (one, white)), tracks.len(), fit));
    }
    all.extend(errors_differ(fit));
    all.extend(UnequalNoise::of(fit).map(Warning::UnequalNoise));
    Ok(all)
}

/// The clearest stretch of a cell, if there is one.
fn stretched(tracks: &[Track]) -> Option<Warning> {
    let found = tracks.iter().filter_map(Stretch::of).filter(|found| found.is_clear(tracks.len()));
    let Stretch { share, degrees, p_value, .. } = found.min_by(|a, b| a.p_value.total_cmp(&b.p_value))?;
    Some(Warning::Stretched { share, degrees, p_value })
}

/// The channels whose innovations are not white.
fn coloured(fit: &Fit) -> Vec<Channel> {
    let mut channels = whiteness(fit);
    let limit = WHITE / channels.len().max(1) as f64;
    channels.retain(|channel| channel.p_value < limit);
    channels
}

/// [`Warning::Carried`] of cells that may differ: each by its own law, with the terms of the joint fit and coefficients and noise of its
/// own. Where cells differ, a law of all of them leaves velocities that none of them has.
///
/// # Errors    of the input; [`crate::Error::Interrupted`]
/// # Checked by  `tests/all/together.rs`: walkers of two persistences, at rest and on a stage that drifts
pub fn carried_cells(tracks: &[Track], fit: &Fit, watch: &dyn Watch) -> Result<Option<Warning>> {
    let settings = Settings { library: fit.library.clone(), handed: fit.handed, starts: Vec::new() };
    let mut found = Vec::new();
    for track in tracks {
        let own = std::slice::from_ref(track);
        let law = refit(own, &settings, &fit.scales, &fit.theta(), watch)?;
        if law.converged() {
            let white = coloured(&law).is_empty();
            found.extend(stage_velocities(own, &law)?.into_iter().flatten().map(|one| (one, white)));
        }
    }
    Ok(carried(found.into_iter(), tracks.len(), fit))
}

/// The clearest velocity of a stage among those of so many tracks, if there is one; each with `true` where the innovations are white.
fn carried(found: impl Iterator<Item = (StageVelocity, bool)>, tracks: usize, fit: &Fit) -> Option<Warning> {
    let clearest = found.min_by(|a, b| a.0.p_value.total_cmp(&b.0.p_value));
    let least = LEAST_CARRIED * fit.scales.amplitudes[0];
    let is_clear = |(found, _): &(StageVelocity, bool)| {
        let size = libm::hypot(found.velocity[0], found.velocity[1]);
        found.p_value * (tracks as f64) < CARRIED && size > least
    };
    let warning = |(StageVelocity { velocity, errors, p_value }, white): (StageVelocity, bool)| {
        let is_small = libm::hypot(velocity[0], velocity[1]) <= fit.scales.amplitudes[0];
        Warning::Carried {
            velocity: is_small.then_some([velocity, errors]),
            p_value: Some(p_value).filter(|_| white),
            unit: String::new(),
            remedy: "the correction 'drift' subtracts a drift".to_owned(),
        }
    };
    clearest.filter(is_clear).map(warning)
}

fn errors_differ(fit: &Fit) -> Option<Warning> {
    let positive = fit.coefficients.iter().filter(|c| c.estimate.error > 0.0);
    let mut ratios: Vec<f64> = positive.map(|c| c.estimate.robust / c.estimate.error).collect();
    ascending(&mut ratios);
    let ratio = *ratios.get(ratios.len() / 2)?;
    (ratio > ERRORS_DIFFER).then_some(Warning::ErrorsDiffer { ratio })
}

/// Largest modulus of the eigenvalues of the field's Jacobian, median over frames (inverse time of the data).
///
/// The velocity of a frame is that from it to the next.
pub fn fastest_rate(tracks: &[Track], fit: &Fit) -> f64 {
    match fit.library.modes {
        2 => fastest::<4>(tracks, fit),
        4 => fastest::<8>(tracks, fit),
        _ => fastest::<6>(tracks, fit),
    }
}

fn fastest<const SHAPE: usize>(tracks: &[Track], fit: &Fit) -> f64 {
    let field = Field::new(&fit.library);
    let mut values = Values::<SHAPE>::new(&field);
    let terms = fit.library.terms.len();
    let natural = &fit.natural.coefficients;
    let imaginary = |i: usize| if fit.handed { natural[terms + i] } else { 0.0 };
    let c: Vec<Complex<f64>> = (0..terms).map(|i| Complex::new(natural[i], imaginary(i))).collect();
    let mut rates = Vec::new();
    for track in tracks {
        let frames = fit.scales.frames(track);
        for pair in frames.windows(2).step_by((frames.len() / RATES).max(1)) {
            field.evaluate(&c, &shape(&pair[0], &pair[1]), false, &mut values);
            let columns: Vec<Vec<f64>> =
                (0..SHAPE).map(|j| values.jacobian.iter().map(|row| row[j]).collect()).collect();
            let moduli = eigenvalues(&columns).unwrap_or_default();
            rates.extend(moduli.iter().map(|value| libm::hypot(value.0, value.1)).reduce(f64::max));
        }
    }
    ascending(&mut rates);
    rates.get(rates.len() / 2).copied().unwrap_or(0.0) / fit.scales.time
}

fn shape<const SHAPE: usize>(frame: &Frame, next: &Frame) -> [f64; SHAPE] {
    let dt = next.t - frame.t;
    let mut shape: [f64; SHAPE] = std::array::from_fn(|i| frame.y[i]);
    (shape[0], shape[1]) = ((next.y[0] - frame.y[0]) / dt, -(next.y[1] - frame.y[1]) / dt);
    shape
}
