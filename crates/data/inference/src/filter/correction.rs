//! A frame taken in: its likelihood, and the state after it.

use super::base::{ErrorsOfFrames, Seen, State};
use super::seen;
use crate::linear::{cholesky, invert_lower};

/// The information in a frame, and the corrected state.
#[derive(Clone, Debug)]
pub(crate) struct Correction<const SHAPE: usize, const STATE: usize> {
    /// `L^-1`, with `L L^T = S`.
    pub(crate) whiten: [[f64; SHAPE]; SHAPE],
    /// `L^-1 nu`: independent standard normal deviates, if the model is right.
    pub(crate) standardised: [f64; SHAPE],
    /// `S^-1 nu`.
    pub(crate) weighted: [f64; SHAPE],
    /// `K`.
    pub(crate) gain: [[f64; SHAPE]; STATE],
    /// `N`: `s^2 R` with the centre's own noise.
    pub(crate) noise: [[f64; SHAPE]; SHAPE],
    /// Variance of the centre's own noise.
    pub(crate) centre: f64,
    /// `-(nu^T S^-1 nu + ln det S + N ln 2 pi)/2`.
    pub(crate) value: f64,
}

/// The state after a frame; `None` if the covariance has lost its meaning.
pub(crate) fn correct<const SHAPE: usize, const STATE: usize>(
    state: &mut State<STATE>,
    frame: &Seen<SHAPE>,
    noise: ErrorsOfFrames,
) -> Option<Correction<SHAPE, STATE>> {
    let mut errors = [[0.0; SHAPE]; SHAPE];
    let mut s = errors;
    for i in 0..SHAPE {
        for j in 0..SHAPE {
            errors[i][j] = noise.between(frame, i, j);
            s[i][j] = errors[i][j] + state.p[seen(i)][seen(j)];
        }
    }
    let l = cholesky(&s)?;
    let whiten = invert_lower(&l);
    let nu: [f64; SHAPE] = std::array::from_fn(|i| frame.y[i] - state.m[seen(i)]);
    let standardised: [f64; SHAPE] =
        std::array::from_fn(|i| (0..=i).map(|j| whiten[i][j] * nu[j]).sum::<f64>());
    let weighted = std::array::from_fn(|j| (j..SHAPE).map(|i| whiten[i][j] * standardised[i]).sum());
    let gain = gain(state, &whiten);
    let squares: f64 = standardised.iter().map(|e| e * e).sum();
    let determinant: f64 = (0..SHAPE).map(|i| 2.0 * libm::log(l[i][i])).sum();
    let value = -0.5 * (squares + determinant + SHAPE as f64 * libm::log(std::f64::consts::TAU));
    let correction =
        Correction { whiten, standardised, weighted, gain, noise: errors, centre: noise.centre, value };
    correction.apply(state, &nu);
    Some(correction)
}

fn gain<const SHAPE: usize, const STATE: usize>(
    state: &State<STATE>,
    whiten: &[[f64; SHAPE]; SHAPE],
) -> [[f64; SHAPE]; STATE] {
    let mut gain = [[0.0; SHAPE]; STATE];
    for (row, p) in gain.iter_mut().zip(&state.p) {
        let half: [f64; SHAPE] =
            std::array::from_fn(|i| (0..=i).map(|j| whiten[i][j] * p[seen(j)]).sum::<f64>());
        for j in 0..SHAPE {
            row[j] = (j..SHAPE).map(|i| whiten[i][j] * half[i]).sum();
        }
    }
    gain
}

impl<const SHAPE: usize, const STATE: usize> Correction<SHAPE, STATE> {
    /// `I - K H`.
    fn kept(&self) -> [[f64; STATE]; STATE] {
        let mut kept = [[0.0; STATE]; STATE];
        for i in 0..STATE {
            kept[i][i] = 1.0;
            for j in 0..SHAPE {
                kept[i][seen(j)] -= self.gain[i][j];
            }
        }
        kept
    }

    fn apply(&self, state: &mut State<STATE>, nu: &[f64; SHAPE]) {
        let kept = self.kept();
        let mut half = [[0.0; STATE]; STATE];
        let mut noise = [[0.0; SHAPE]; STATE];
        for i in 0..STATE {
            state.m[i] += (0..SHAPE).map(|j| self.gain[i][j] * nu[j]).sum::<f64>();
            for k in 0..STATE {
                for j in 0..STATE {
                    half[i][j] += kept[i][k] * state.p[k][j];
                }
            }
            for k in 0..SHAPE {
                for j in 0..SHAPE {
                    noise[i][j] += self.gain[i][k] * self.noise[k][j];
                }
            }
        }
        for i in 0..STATE {
            for j in 0..=i {
                let from: f64 = (0..STATE).map(|k| half[i][k] * kept[j][k]).sum();
                let added: f64 = (0..SHAPE).map(|k| noise[i][k] * self.gain[j][k]).sum();
                state.p[i][j] = from + added;
                state.p[j][i] = from + added;
            }
        }
    }
}
