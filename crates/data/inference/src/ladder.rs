//! Models from the simplest to the richest, compared by frames that their fits did not see.

use crate::filter::{Problem, Theta, Want, evaluate};
use crate::fit::{WithMemory, problem, refit};
use crate::observation::{LEAST_FRAMES, Track};
use crate::{Error, Fit, MOST_MODES, Result, Settings, Term, observation, refit_with, subsets, with_stage};
use motiform_dynamics::Watch;
use motiform_dynamics::digits::with_error;
use serde::{Deserialize, Serialize};

/// Parts of each track, of which one at a time is left out of the fits.
pub const BLOCKS: usize = 5;

motiform_dynamics::named! {
    /// A model of the ladder. In all of them each mode of the shape relaxes at a rate of its own and has noise.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "snake_case")]
    pub enum LadderModel by words {
        /// The velocity relaxes and is renewed by noise: rest, or a persistent random walk; nothing acts on anything else.
        PassiveWalk = "rest or persistent random walk, passive shape",
        /// The same, and the shape acts on the velocity to second order.
        PolarWalk = "persistent random walk, the shape acts on the velocity",
        /// The velocity has a linear and a cubic term: a speed of its own.
        Speed = "velocity with a speed of its own, passive shape",
        /// All terms of z1 and z2.
        TwoModes = "all terms of z1 and z2",
        /// All terms of z1 to z3.
        ThreeModes = "all terms of z1 to z3",
        /// All terms of z1 to z4.
        FourModes = "all terms of z1 to z4",
        /// The terms that the frames of the fit ask for.
        Selected = "terms that the data ask for",
        /// The same with complex coefficients.
        Handed = "terms that the data ask for, handed",
        /// The terms that the frames of the fit ask for, and a velocity of the stage for each track.
        Drifting = "terms that the data ask for, and a drift of the stage",
        /// The terms that the frames of the fit ask for, and noise of the velocity with a memory; of at most three modes.
        Coloured = "terms that the data ask for, and noise of the velocity with a memory",
    }
}

impl LadderModel {
    /// The models of so many amplitudes, from the simplest to the richest.
    fn all(modes: usize) -> Vec<Self> {
        let mut all = vec![Self::PassiveWalk, Self::PolarWalk, Self::Speed, Self::TwoModes];
        all.extend([Self::ThreeModes, Self::FourModes].into_iter().take(modes.saturating_sub(2)));
        all.extend([Self::Selected, Self::Handed, Self::Drifting]);
        all.extend((modes < MOST_MODES).then_some(Self::Coloured)); // the noise takes the place of z4
        all
    }

    /// `true` if it has this term.
    fn has(self, term: &Term) -> bool {
        let among = |modes: usize| term.equation < modes && (modes..4).all(|n| term.degree(n) == 0);
        let of_velocity = term.equation == 0;
        let relaxes = term.order() == 1;
        relaxes
            || match self {
                Self::PassiveWalk | Self::Selected | Self::Handed | Self::Drifting | Self::Coloured => false,
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
    pub model: LadderModel,
    /// Coefficients, velocities of the stage among them; of selected terms the median over the fits.
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
    pub fn is_as_good(&self) -> bool {
        matches!((self.behind, self.error), (Some(behind), Some(error)) if behind <= 2.0 * error)
    }

    /// Its prediction against that of the best model, in words.
    pub fn in_words(&self) -> String {
        match (self.behind, self.error) {
            (Some(0.0), _) => "predicts best".to_owned(),
            (Some(behind), Some(error)) => {
                format!("log-likelihood {} below the best", with_error(behind, error))
            }
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
    pub fn best(&self) -> Option<&Rung> {
        self.rungs.iter().find(|rung| rung.behind == Some(0.0))
    }

    /// Which model predicts best, and which simpler one as well, as a sentence.
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
/// # Checked by  `tests/all/ladder.rs`: walks, chaos of three modes, handed chaos, a drift of the stage, noise with a memory, short records
pub fn ladder(tracks: &[Track], whole: &Fit, watch: &dyn Watch) -> Result<Ladder> {
    observation::check(tracks, whole.library.modes)?;
    let least = BLOCKS * LEAST_FRAMES;
    if let Some((cell, track)) = tracks.iter().enumerate().find(|(_, track)| track.0.len() < least) {
        return Err(Error::TooShort { cell, frames: track.0.len(), least });
    }
    let models = LadderModel::all(whole.library.modes);
    let mut found: Vec<Vec<Block>> = vec![Vec::new(); models.len()];
    for number in 0..BLOCKS {
        let parts = Parts::of(tracks, number);
        let all = refit_with(&parts.seen, whole, &every(whole), watch)?;
        let best = subsets(&all).best().map(|set| set.kept.clone()).unwrap_or_default();
        let selected = refit_with(&parts.seen, &all, &best, watch)?;
        for (model, blocks) in models.iter().zip(&mut found) {
            blocks.push(parts.judged(*model, [&all, &selected], watch)?);
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

/// Tracks without one of their blocks, and these blocks.
struct Parts {
    /// Pieces that are fitted; those that are too short for a fit are left out.
    seen: Vec<Track>,
    /// The track of each piece.
    of: Vec<usize>,
    /// The block of each track.
    left_out: Vec<Track>,
}

impl Parts {
    fn of(tracks: &[Track], number: usize) -> Self {
        let mut parts = Self { seen: Vec::new(), of: Vec::new(), left_out: Vec::new() };
        for (track, Track(frames)) in tracks.iter().enumerate() {
            let [from, to] = [number, number + 1].map(|k| k * frames.len() / BLOCKS);
            for piece in
                [&frames[..from], &frames[to..]].into_iter().filter(|piece| piece.len() >= LEAST_FRAMES)
            {
                parts.seen.push(Track(piece.to_vec()));
                parts.of.push(track);
            }
            parts.left_out.push(Track(frames[from..to].to_vec()));
        }
        parts
    }

    /// The prediction of the blocks by a model that is fitted to the rest; `all` and `selected` are the fits of all terms, and of those
    /// that the rest asks for.
    fn judged(&self, model: LadderModel, [all, selected]: [&Fit; 2], watch: &dyn Watch) -> Result<Block> {
        match model {
            LadderModel::Selected => Ok(Block::of(&self.left_out, selected)),
            LadderModel::Handed => {
                let settings =
                    Settings { library: selected.library.clone(), handed: true, starts: Vec::new() };
                let Theta { mut coefficients, logs } = selected.theta();
                coefficients.resize(2 * coefficients.len(), 0.0);
                let start = Theta { coefficients, logs };
                Ok(Block::of(&self.left_out, &refit(&self.seen, &settings, &selected.scales, &start, watch)?))
            }
            LadderModel::Drifting => self.drifting(selected, watch),
            LadderModel::Coloured => {
                let fitted = WithMemory::of(&self.seen, selected, watch)?;
                let (value, frames) = fitted.likelihood(&self.left_out);
                Ok(Block { value, frames, coefficients: fitted.coefficients() })
            }
            _ => {
                let has = |&i: &usize| model.has(&all.coefficients[i].term);
                let kept: Vec<usize> = every(all).into_iter().filter(has).collect();
                Ok(Block::of(&self.left_out, &refit_with(&self.seen, all, &kept, watch)?))
            }
        }
    }

    /// With the velocity of the stage that the rest of each track has: the mean over its pieces, by their frames.
    fn drifting(&self, selected: &Fit, watch: &dyn Watch) -> Result<Block> {
        let found = with_stage(&self.seen, selected, watch)?;
        let pieces = || self.of.iter().zip(&self.seen).zip(&found.velocities);
        let still = |(number, track): (usize, &Track)| {
            let own = || pieces().filter(|((of, _), _)| **of == number);
            let frames = own().map(|((_, piece), _)| piece.0.len()).sum::<usize>().max(1) as f64;
            let mean =
                |k: usize| own().map(|((_, piece), v)| piece.0.len() as f64 * v[k]).sum::<f64>() / frames;
            track.without_velocity([mean(0), mean(1)])
        };
        let left_out: Vec<Track> = self.left_out.iter().enumerate().map(still).collect();
        let block = Block::of(&left_out, &found.fit);
        Ok(Block { coefficients: block.coefficients + 2 * left_out.len(), ..block })
    }
}

fn every(fit: &Fit) -> Vec<usize> {
    (0..fit.coefficients.len()).collect()
}

fn compared(models: &[LadderModel], found: &[Vec<Block>]) -> Ladder {
    let sum = |blocks: &[Block]| blocks.iter().map(|block| block.value).sum::<f64>();
    let frames: usize = found[0].iter().map(|block| block.frames).sum();
    let first = sum(&found[0]);
    let best = found.iter().max_by(|a, b| sum(a).total_cmp(&sum(b))).unwrap_or(&found[0]);
    let rung = |(model, blocks): (&LadderModel, &Vec<Block>)| {
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
