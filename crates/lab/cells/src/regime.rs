//! The motion of the models that the data allow.

mod allowed;
mod tally;

use crate::driven::{Driven, driven_share};
use crate::settled::{settles, time_left};
use crate::{Result, start};
use allowed::{Drawn, drawn, ends, sets};
use motiform_analysis::regime::Regime;
use motiform_dynamics::Watch;
use motiform_inference::{Fit, Library, MOST_MODES, Selection, Track, equations, fastest_rate};
use motiform_models::amplitudes::info;
use motiform_study::Study;
use serde::{Deserialize, Serialize};
use tally::{Tally, looks};

/// A motion is named if this share of the models that do not blow up has it.
pub const LEAST_SHARE: f64 = 0.9;
/// Share of the models that the data allow that may blow up. A cell that was tracked did not, and chaos of which some models escape after a
/// long time is chaos in the record; where more of them do, the equations do not describe the cell.
pub(crate) const MOST_LOST: f64 = 0.1;

/// Models of which the share of their motion without noise is computed, at most.
const MOST_SHARES: usize = 20;
/// Fewest e-foldings of a linear rate in a record.
const LEAST_FOLDINGS: f64 = 3.0;
/// Largest sampling interval times fastest rate at which coefficients of a cell that noise moves have intervals.
const CARRIED_COARSELY: f64 = 1.0;

/// The motions of draws from the estimate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FittedRegime {
    /// The motion, if at least [`LEAST_SHARE`] of the models that do not blow up agree, and at most a tenth of all blows up. Never blow-up:
    /// a cell that was tracked did not.
    pub regime: Option<Regime>,
    /// The motion of the best model itself.
    pub best: Regime,
    /// The share of the most frequent motion, blow-up left out, among the models that do not blow up.
    pub share: f64,
    /// Number of draws with each motion.
    pub counts: Vec<(Regime, usize)>,
    /// Number of draws.
    pub draws: usize,
    /// Where the motion of each model begins: a state of the cell, as coordinates of the model in natural units, along the cell's own axes:
    /// it moves to the right.
    #[serde(default)]
    pub start: Vec<f64>,
    /// `true` if noise carries the cell, see [`FittedRegime::is_carried`].
    #[serde(default)]
    pub carried: bool,
    /// `true` if a linear rate of the best model is so slow that the record holds less than three of its e-foldings.
    #[serde(default)]
    pub slow: bool,
    /// `true` if the equations rest, or nearly, without noise, and frames are further apart than its fastest rate takes: between frames the
    /// distribution of the states then has parts that the filter, which is linear in deviations, leaves out.
    #[serde(default)]
    pub coarse: bool,
    /// The part of the motion that the equations make without their noise; `None` with few draws, or where these blow up.
    #[serde(default)]
    pub driven: Option<Driven>,
}

impl FittedRegime {
    /// `true` if the best model blows up: then it is no model of a cell that was tracked.
    pub fn blows_up(&self) -> bool {
        self.best == Regime::BlowUp
    }

    /// Why there is no name although models were classified; `None` where there is one, or where noise carries the cell.
    pub fn why_unnamed(&self) -> Option<String> {
        if self.regime.is_some() || self.carried {
            return None;
        }
        let lost = self.counts.iter().find(|one| one.0 == Regime::BlowUp).map_or(0, |one| one.1);
        let most = self.counts.iter().filter(|one| one.0 != Regime::BlowUp).max_by_key(|one| one.1)?;
        Some(match self.best {
            _ if lost as f64 > MOST_LOST * self.draws as f64 => "more than a tenth of them blow up".to_owned(),
            Regime::Undetermined => {
                "the best model itself has no motion that the classification decides, and the name would be that of it".to_owned()
            }
            best if best != most.0 => {
                format!("the best model itself is {}, and not as most of them", best.name())
            }
            _ => format!(
                "{:.0} % of those that do not blow up agree with the best model, and {:.0} % are needed",
                100.0 * self.share,
                100.0 * LEAST_SHARE
            ),
        })
    }

    /// `true` if the equations make next to nothing of the motion, although the cell moves: then the displacement is that of the noise, and
    /// the motion is no rest. They rest without their noise, or have at most a fifth of the mean square speed (upper end of [`Driven`])
    /// while nine of ten models rest or have no name: a velocity that decays as a power of time has none.
    pub fn is_carried(&self) -> bool {
        self.carried
    }

    /// Why neither intervals of the coefficients nor a place are stated: of steady motions they hold the truth too rarely. Such a cell
    /// stays next to one point of the shape, and what noise moves it off that point is known with errors of the same size, which the
    /// likelihood takes for information. In a record of less than three e-foldings of a linear rate this and a nonlinear term do the same:
    /// the set with one of them alone has small errors, and both are wrong.
    pub fn no_intervals(&self) -> Option<&'static str> {
        if self.slow {
            return Some(
                "a linear rate of the equations is below three e-foldings in the record: it is too short to tell \
                 linear from nonlinear terms",
            );
        }
        if self.coarse {
            return Some(
                "noise moves the cell, and the sampling interval times the fastest rate is above 1: what the filter leaves out \
                 between frames biases the coefficients",
            );
        }
        matches!(self.best, Regime::Straight | Regime::Circular).then_some(
            "the motion is steady: the cell stays next to one point of the shape, and intervals from its noise about \
             it hold the truth in 81 to 86 % of cases only (simulated cells)",
        )
    }
}

/// Classifies models drawn from the estimate, at most `count`: from the sets of terms that the data do not tell apart, each with the share
/// of its weight `exp(-excess/2)`, and from the normal distribution of each set's coefficients. Fewer are drawn where the first ones decide
/// (`Tally::is_clear`). Noise is left out: the motion is that of the
/// equations, from a state that the cell had in the middle of its record. Equations with several motions, or with states that blow up,
/// have that of the cell. A steady motion that equations reach only after the end of the record counts as undetermined: the cell did
/// not show it.
///
/// # Errors
/// Equations that are no model; [`motiform_study::Error::Interrupted`].
pub fn regime_of(
    tracks: &[Track],
    whole: &Fit,
    selection: &Selection,
    count: usize,
    seed: u64,
    watch: &dyn Watch,
) -> Result<FittedRegime> {
    let start = start::observed(tracks, &selection.fit.scales, !selection.fit.handed).unwrap_or_default();
    let left = time_left(tracks, &selection.fit);
    let sets = sets(tracks, whole, selection, watch)?;
    let own = Drawn { fit: &sets[0].0, values: sets[0].0.natural.coefficients.clone() };
    let models: Vec<Drawn<'_>> = std::iter::once(own).chain(drawn(&sets, count, seed)).collect();
    let mut tally = Tally::default();
    for look in looks(models.len()) {
        let more = &models[tally.seen()..look];
        for (one, end) in more.iter().zip(ends(whole, &sets, more, &start, watch)?) {
            tally.add(end, |end| shown(end, || settles(one.fit, &one.values, &start, left)));
        }
        if tally.is_clear() {
            break;
        }
    }
    let driven = |(number, one): (usize, &Drawn<'_>)| {
        driven_share(one.fit, &one.values, &start, seed.wrapping_add(number as u64))
    };
    let shares = models.iter().enumerate().skip(1).take(MOST_SHARES).filter_map(driven).collect();
    let (best, (share, named), quiet) = (tally.best(), tally.agreement(), tally.is_quiet());
    let draws = tally.models();
    let counts = tally.counts();
    // the speed of a cell that rests is within its errors, and its equations are not identifiable
    let moves = selection.fit.scales.signal.first().is_some_and(|signal| *signal >= 1.0);
    let driven = Driven::of(shares);
    let nearly = quiet && driven.as_ref().is_some_and(Driven::is_none);
    let rests = best == Regime::Motionless;
    let carried = moves && (nearly || named && rests);
    let regime = (named && !carried).then_some(best);
    Ok(FittedRegime {
        regime,
        best,
        share,
        counts,
        draws,
        start,
        carried,
        slow: is_slow(&selection.fit, 2.0 * left),
        coarse: moves && (nearly || rests) && is_coarse(tracks, &selection.fit),
        driven,
    })
}

/// The motion that a record shows of one that the equations end in: a steady one that they reach after its end is undetermined.
fn shown(end: Regime, settles: impl Fn() -> bool) -> Regime {
    match end {
        Regime::Straight | Regime::Circular if !settles() => Regime::Undetermined,
        end => end,
    }
}

/// `true` if a linear rate has less than three e-foldings in this many natural times. Imaginary parts turn the mode, and may be any small.
fn is_slow(fit: &Fit, time: f64) -> bool {
    let linear = |name: &str| (1..=MOST_MODES).any(|n| name == format!("z{n}: z{n}"));
    let mut all = fit.coefficients.iter().zip(&fit.natural.coefficients);
    all.any(|(c, rate)| !c.imaginary && linear(&c.name) && rate.abs() * time < LEAST_FOLDINGS)
}

/// `true` if frames are further apart than the fastest rate takes.
fn is_coarse(tracks: &[Track], fit: &Fit) -> bool {
    let interval = tracks.iter().map(Track::interval).fold(0.0, f64::max);
    fastest_rate(tracks, fit) * interval > CARRIED_COARSELY
}

/// A study of the equations with these coefficients in natural units, in which every number is of order 1. The names of a model are
/// kept as long as the process: they are those of the set of terms, and the values are given apart. It begins at these coordinates of
/// the model.
pub(crate) fn natural_study(
    library: &Library,
    handed: bool,
    values: &[f64],
    start: &[f64],
) -> std::result::Result<Study, motiform_study::Error> {
    let names = info(&equations(library, handed, &[]))
        .map_err(|error| motiform_models::Error::Equations { problem: error.to_string() })?;
    let mut study = Study::of_model(names);
    for parameter in equations(library, handed, values).parameters {
        study.set(&parameter.name, parameter.default)?;
    }
    begin(&mut study, start.iter().copied())?;
    Ok(study)
}

/// Lets a study begin at these coordinates of its model; those that are not given stay.
pub(crate) fn begin(
    study: &mut Study,
    start: impl Iterator<Item = f64>,
) -> std::result::Result<(), motiform_study::Error> {
    let names: Vec<String> =
        study.info()?.coordinates(&study.values()?).iter().map(|c| c.name.to_owned()).collect();
    for (name, value) in names.iter().zip(start) {
        study.set_initial(name, value)?;
    }
    Ok(())
}
