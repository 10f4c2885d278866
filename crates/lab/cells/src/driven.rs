//! The share of a cell's motion that its equations make without their noise.

use crate::natural::{STEP, model, noise};
use motiform_dynamics::sample::{ascending, quantile};
use motiform_dynamics::{Model, Noise, Normal};
use motiform_inference::Fit;
use motiform_lab::sample_path::{Looks, sample_path};
use serde::{Deserialize, Serialize};

/// Time that is looked at, in natural times; the first half is left to transients.
const TIME: f64 = 100.0;
/// A speed larger than this, in natural units, has left all bounds.
const BOUND: f64 = 30.0;
/// Largest upper end of a share that is next to none: noise makes at least four fifths of the mean square speed. Velocities that decay as a
/// power of time still have some per cent after [`TIME`].
const NONE: f64 = 0.2;
/// Fewest models for an interval.
const LEAST_MODELS: usize = 8;

/// The share of the motion that the equations make without their noise.
///
/// The mean square speed without noise over that of the same equations with the fitted noise, both from the same state of the cell,
/// over 50 natural times after as many: 0 where the body rests without noise, 1 where the noise adds nothing; above 1 where it slows
/// the body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Driven {
    /// The median over models that the data allow.
    pub share: f64,
    /// Their 2.5 % and 97.5 % quantiles: the uncertainty of the coefficients, and the scatter of a run with noise.
    pub interval: [f64; 2],
    /// Number of models.
    pub models: usize,
}

impl Driven {
    /// The share over these models; `None` with too few of them.
    pub(crate) fn of(mut shares: Vec<f64>) -> Option<Self> {
        if shares.len() < LEAST_MODELS {
            return None;
        }
        ascending(&mut shares);
        let at = |part: f64| quantile(&shares, part);
        Some(Self { share: at(0.5)?, interval: [at(0.025)?, at(0.975)?], models: shares.len() })
    }

    /// `true` if the equations make next to nothing of the motion.
    pub(crate) fn is_none(&self) -> bool {
        self.interval[1] <= NONE
    }

    /// The share of the motion that the equations make, as a clause.
    pub fn in_words(&self) -> String {
        let percent = |share: f64| format!("{:.0}", 100.0 * share);
        let [low, high] = self.interval.map(percent);
        format!(
            "the mean square speed of the equations without noise is {} % ({low} to {high} %) of that with it",
            percent(self.share)
        )
    }
}

/// The share of one model, with these coefficients in natural units, from these coordinates; `None` where a run leaves all bounds.
pub(crate) fn driven_share(fit: &Fit, values: &[f64], start: &[f64], seed: u64) -> Option<f64> {
    let model = model(fit, values)?;
    let noise = noise(fit, model.as_ref(), STEP);
    let alone = without(noise.clone());
    let [with, without] =
        [noise, alone].map(|noise| mean_square_speed(model.as_ref(), start, noise, Normal::new(seed, 3)));
    let share = without? / with?;
    share.is_finite().then_some(share)
}

/// No noise, with the same steps.
pub(crate) fn without(noise: Noise) -> Noise {
    Noise { amplitudes: vec![0.0; noise.amplitudes.len()], ..noise }
}

fn mean_square_speed(model: &dyn Model, start: &[f64], noise: Noise, normal: Normal) -> Option<f64> {
    let steps = (TIME / STEP) as usize;
    let states = states(model, start, noise, normal, steps)?;
    let squares = states[steps / 2..].iter().map(|at| at[0] * at[0] + at[1] * at[1]);
    Some(squares.sum::<f64>() / (steps - steps / 2) as f64)
}

/// Coordinates of the model after each step of [`STEP`]; `None` where the run leaves all bounds.
pub(crate) fn states(
    model: &dyn Model,
    start: &[f64],
    noise: Noise,
    normal: Normal,
    steps: usize,
) -> Option<Vec<Vec<f64>>> {
    let mut state = model.encoded(start);
    state.extend([0.0; 2]);
    let looks = Looks { step: STEP, steps: 1, count: steps + 1 };
    let mut all = Vec::with_capacity(steps);
    let whole = sample_path(model, &state, noise, normal, looks, &mut |look, state| {
        let coordinates = model.decoded(&state[..model.dim()]);
        let square = coordinates[0] * coordinates[0] + coordinates[1] * coordinates[1];
        if look > 0 {
            all.push(coordinates);
        }
        square <= BOUND * BOUND
    });
    whole.then_some(all)
}

#[cfg(test)]
mod tests {
    use super::Driven;

    #[test]
    fn next_to_none_is_a_fifth_at_most_with_its_interval() {
        let share = |upper: f64| Driven { share: 0.0, interval: [0.0, upper], models: 20 };
        assert!(share(0.19).is_none() && !share(0.21).is_none());
        let words = Driven { share: 1.02, interval: [0.95, 1.05], models: 20 }.in_words();
        assert!(words.ends_with("without noise is 102 % (95 to 105 %) of that with it"), "{words}");
    }
}
