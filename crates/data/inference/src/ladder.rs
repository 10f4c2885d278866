//! Models from the simplest to the richest, compared by frames that their fits did not see.

use crate::filter::{Problem, Theta, Want, evaluate};
use crate::fit::{problem, refit};
use crate::observation::{LEAST_FRAMES, Track};
use crate::{Error, Fit, Result, Settings, Term, observation, refit_with, subsets};
use motiform_dynamics::Watch;
use serde::{Deserialize, Serialize};

/// Parts of each track, of which one at a time is left out of the fits.
pub const BLOCKS: usize = 5;

/// A model of the ladder. In all of them each mode of the shape relaxes at a rate of its own and has noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Model {
    /// The velocity relaxes and is renewed by noise: rest, or a persistent random walk; nothing acts on anything else.
    PassiveWalk,
    /// The same, and the shape acts on the velocity to second order.
    PolarWalk,
    /// The velocity has a linear and a cubic term: a speed of its own.
    Speed,
    /// All terms of z1 and z2.
    TwoModes,
    /// All terms of z1 to z3.
    ThreeModes,
    /// All terms of z1 to z4.
    FourModes,
    /// The terms that the frames of the fit ask for.
    Selected,
    /// The same with complex coefficients.
    Handed,
}

impl Model {
    /// The model in words.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::PassiveWalk => "rest or persistent random walk, passive shape",
            Self::PolarWalk => "persistent random walk, the shape acts on the velocity",
            Self::Speed => "velocity with a speed of its own, passive shape",
            Self::TwoModes => "all terms of z1 and z2",
            Self::ThreeModes => "all terms of z1 to z3",
            Self::FourModes => "all terms of z1 to z4",
            Self::Selected => "terms that the data ask for",
            Self::Handed => "the same, handed",
        }
    }

    /// The models of so many amplitudes, from the simplest to the richest.
    fn all(modes: usize) -> Vec<Self> {
        let mut all = vec![Self::PassiveWalk, Self::PolarWalk, Self::Speed, Self::TwoModes];
        all.extend([Self::ThreeModes, Self::FourModes].into_iter().take(modes.saturating_sub(2)));
        all.extend([Self::Selected, Self::Handed]);
        all
    }

    /// `true` if it has this term.
    fn has(self, term: &Term) -> bool {
        let among = |modes: usize| term.equation < modes && (modes..4).all(|n| term.degree(n) == 0);
        let of_velocity = term.equation == 0;
        let relaxes = term.order() == 1;
        relaxes
            || match self {
                Self::PassiveWalk | Self::Selected | Self::Handed => false,
                Self::PolarWalk => of_velocity && term.order() == 2,
                Self::Speed => of_velocity && term.degree(0) == 3,
                Self::TwoModes => among(2),
                Self::ThreeModes => among(3),
                Self::FourModes => true,
            }
    }
}

/// A model with what it says of frames that its fit did not see.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rung {
    /// The model.
    pub model: Model,
    /// Coefficients; of selected terms the median over the fits.
    pub coefficients: usize,
    /// Log-likelihood per frame above that of the first model; `None` where a filter diverges on frames that its fit did not see.
    pub gain: Option<f64>,
    /// Log-likelihood of all frames below that of the best model.
    pub behind: Option<f64>,
    /// Its standard error, from the differences between blocks; 0 for the best model.
    pub error: Option<f64>,
}

impl Rung {
    /// Returns `true` if it predicts as well as the best model, within two standard errors of their difference.
    #[must_use]
    pub fn is_as_good(&self) -> bool {
        matches!((self.behind, self.error), (Some(behind), Some(error)) if behind <= 2.0 * error)
    }

    /// Its prediction against that of the best model, in words.
    #[must_use]
    pub fn in_words(&self) -> String {
        match (self.behind, self.error) {
            (Some(0.0), _) => "predicts best".to_owned(),
            (Some(behind), Some(error)) => format!("log-likelihood {behind:.1} ± {error:.1} below the best"),
            _ => "its filter diverges on frames that its fit did not see".to_owned(),
        }
    }
}

/// The models, from the simplest to the richest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ladder {
    /// Blocks of each track.
    pub blocks: usize,
    /// Frames that have a likelihood.
    pub frames: usize,
    /// The models.
    pub rungs: Vec<Rung>,
}

impl Ladder {
    /// The model that predicts best.
    #[must_use]
    pub fn best(&self) -> Option<&Rung> {
        self.rungs.iter().find(|rung| rung.behind == Some(0.0))
    }

    /// Which model predicts best, and which simpler one as well, as a sentence.
    #[must_use]
    pub fn sentence(&self) -> String {
        let Some(best) = self.best() else {
            return "no model predicts frames that its fit did not see: all filters diverge".to_owned();
        };
        let simpler = self.simplest().filter(|rung| rung.model != best.model);
        let simpler = simpler.map_or_else(String::new, |rung| {
            format!("; within two standard errors as well: {}", rung.model.words())
        });
        format!("frames that fits did not see are predicted best by: {}{simpler}", best.model.words())
    }

    /// The model of fewest coefficients that predicts as well as the best one: what others have beyond it is not in these data.
    #[must_use]
    pub fn simplest(&self) -> Option<&Rung> {
        self.rungs.iter().filter(|rung| rung.is_as_good()).min_by_key(|rung| rung.coefficients)
    }
}

/// Compares models from the persistent random walk to the handed one by cross-validation: each track is cut into [`BLOCKS`] blocks; a
/// model is fitted to all frames but those of one block in each track, and the log-likelihood of the block is that of its prediction from
/// each frame to the next, with all that was estimated, terms included, from the other blocks. So a model gains nothing by terms that fit
/// noise, whatever their number.
///
/// `whole` is a fit of all terms to all frames, from whose estimates the searches begin. The differences
/// between models have standard errors from their scatter over blocks, `sqrt(B) sd`.
///
/// Source: Stone (1974), J. R. Stat. Soc. B 36, 111; blocks of records: Burman, Chow and Nolan (1994), Biometrika 81, 351.
///
/// # Errors    of the input; [`Error::TooShort`] for tracks whose blocks are too short to be fitted; [`Error::Interrupted`]
/// # Checked by  `tests/all/ladder.rs`: walks, chaos of three modes, handed chaos, short records
pub fn ladder(tracks: &[Track], whole: &Fit, watch: &dyn Watch) -> Result<Ladder> {
    observation::check(tracks, whole.library.modes)?;
    let least = BLOCKS * LEAST_FRAMES;
    if let Some((cell, track)) = tracks.iter().enumerate().find(|(_, track)| track.0.len() < least) {
        return Err(Error::TooShort { cell, frames: track.0.len(), least });
    }
    let models = Model::all(whole.library.modes);
    let mut found: Vec<Vec<Block>> = vec![Vec::new(); models.len()];
    for number in 0..BLOCKS {
        let (seen, left_out) = parted(tracks, number);
        let all = refit_with(&seen, whole, &every(whole), watch)?;
        for (model, blocks) in models.iter().zip(&mut found) {
            blocks.push(Block::of(&left_out, &fitted(*model, &seen, &all, watch)?));
        }
    }
    Ok(compared(&models, &found))
}

/// The prediction of a block's frames by a fit.
#[derive(Clone, Copy, Debug)]
struct Block {
    value: f64,
    frames: usize,
    coefficients: usize,
}

impl Block {
    fn of(left_out: &[Track], fit: &Fit) -> Self {
        let settings = Settings { library: fit.library.clone(), handed: fit.handed, starts: Vec::new() };
        let there: Problem = problem(left_out, &settings, &fit.scales);
        let frames = there.frames();
        let value = evaluate(&there, &fit.theta(), Want::Value, false).value;
        let value = value + frames as f64 * fit.scales.log_density();
        Self { value, frames, coefficients: fit.coefficients.len() }
    }
}

/// All tracks without their block of this number, and these blocks. Pieces that are too short for a fit are in neither.
fn parted(tracks: &[Track], number: usize) -> (Vec<Track>, Vec<Track>) {
    let (mut seen, mut left_out) = (Vec::new(), Vec::new());
    for Track(frames) in tracks {
        let [from, to] = [number, number + 1].map(|k| k * frames.len() / BLOCKS);
        let pieces = [&frames[..from], &frames[to..]].map(|piece| Track(piece.to_vec()));
        seen.extend(pieces.into_iter().filter(|piece| piece.0.len() >= LEAST_FRAMES));
        left_out.push(Track(frames[from..to].to_vec()));
    }
    (seen, left_out)
}

fn every(fit: &Fit) -> Vec<usize> {
    (0..fit.coefficients.len()).collect()
}

/// The fit of a model to these frames, of which `all` is the fit of all terms.
fn fitted(model: Model, seen: &[Track], all: &Fit, watch: &dyn Watch) -> Result<Fit> {
    let best = || subsets(all).best().map(|set| set.kept.clone()).unwrap_or_default();
    match model {
        Model::Selected => refit_with(seen, all, &best(), watch),
        Model::Handed => {
            let real = refit_with(seen, all, &best(), watch)?;
            let settings = Settings { library: real.library.clone(), handed: true, starts: Vec::new() };
            let Theta { mut coefficients, logs } = real.theta();
            coefficients.resize(2 * coefficients.len(), 0.0);
            refit(seen, &settings, &real.scales, &Theta { coefficients, logs }, watch)
        }
        _ => {
            let has = |&i: &usize| model.has(&all.coefficients[i].term);
            refit_with(seen, all, &every(all).into_iter().filter(has).collect::<Vec<_>>(), watch)
        }
    }
}

fn compared(models: &[Model], found: &[Vec<Block>]) -> Ladder {
    let sum = |blocks: &[Block]| blocks.iter().map(|block| block.value).sum::<f64>();
    let frames: usize = found[0].iter().map(|block| block.frames).sum();
    let first = sum(&found[0]);
    let best = found.iter().max_by(|a, b| sum(a).total_cmp(&sum(b))).unwrap_or(&found[0]);
    let rung = |(model, blocks): (&Model, &Vec<Block>)| {
        let total = sum(blocks);
        let known = |value: f64| value.is_finite().then_some(value);
        let mut coefficients: Vec<usize> = blocks.iter().map(|block| block.coefficients).collect();
        coefficients.sort_unstable();
        Rung {
            model: *model,
            coefficients: coefficients[coefficients.len() / 2],
            gain: known((total - first) / frames.max(1) as f64),
            behind: known(sum(best) - total),
            error: known(scatter(blocks, best)),
        }
    };
    Ladder { blocks: BLOCKS, frames, rungs: models.iter().zip(found).map(rung).collect() }
}

/// The standard error of the sum of the differences between two models over blocks.
fn scatter(a: &[Block], b: &[Block]) -> f64 {
    let n = a.len() as f64;
    let differences: Vec<f64> = a.iter().zip(b).map(|(a, b)| b.value - a.value).collect();
    let mean = differences.iter().sum::<f64>() / n;
    let square = differences.iter().map(|d| (d - mean) * (d - mean)).sum::<f64>() / (n - 1.0);
    (n * square).sqrt()
}
