//! Turns that are always the same, between rests whose length round-off decides.

use super::look::{Look, RESTS};
use super::verdict::{Attractor, Regime, Verdict};
use crate::SteadyMotion;
use crate::equilibrium::RelativeEquilibrium;
use crate::symmetry::{align, reduced_speed};
use motiform_dynamics::Equivariant;
use motiform_dynamics::digits::decimals;

/// Number of turns in a row: by chance, all have one sense with a probability of 2^-12.
const TURNS: usize = 12;

/// Turns that differ by less (rad) are the same.
const SAME: f64 = 1e-3;

/// Shapes that differ by less than this part of the motion's diameter are the same.
const CLOSE: f64 = 0.005;

/// The last turns of a look: their angle, sense and times.
#[derive(Clone, Copy, Debug)]
pub(super) struct SteadyTurns {
    /// Angle of each turn of the body (rad, above 0).
    angle: f64,
    /// `true` if it turned to the left and to the right by turns.
    alternates: bool,
    /// The shortest and the longest time from turn to turn.
    times: (f64, f64),
    /// Rates at the saddle that it rests at.
    rates: (f64, f64),
}

impl SteadyTurns {
    /// The last turns of a look between rests at a saddle whose cycle repels: `None` where they differ, or the body does not rest.
    pub(super) fn of(body: &dyn Equivariant, look: &Look) -> Option<Self> {
        let minima = look.minima();
        let last = &minima[minima.len().checked_sub(TURNS + 1)?..];
        let rate = body.rates(&look.slowest);
        if reduced_speed(body, &look.slowest, &rate) >= RESTS * look.fastest {
            return None;
        }
        let equilibrium = RelativeEquilibrium::find(body, &look.slowest)?;
        let saddle = equilibrium.saddle(body)?;
        let still = !SteadyMotion::of(body, &equilibrium).moves();
        let allowed = CLOSE * look.diameter(body);
        let mut turns = Vec::with_capacity(TURNS);
        for pair in last.windows(2) {
            let turn = align(body, &pair[1].shape, &pair[0].shape, false);
            turns.push((turn.distance < allowed).then_some(turn.angle)?);
        }
        let angle = turns[0].abs();
        let same = turns.iter().all(|turn| (turn.abs() - angle).abs() < SAME) && angle > SAME;
        let flips = turns.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
        let times = last.windows(2).map(|pair| pair[1].t - pair[0].t);
        let times = times.fold((f64::INFINITY, 0.0_f64), |(low, high), t| (low.min(t), high.max(t)));
        let steady = same && (flips == 0 || flips + 1 == turns.len());
        (still && steady && saddle.out + saddle.inward > saddle.error).then_some(Self {
            angle,
            alternates: flips > 0,
            times,
            rates: (saddle.out, saddle.inward),
        })
    }

    /// Turns by this angle (rad), for tests.
    #[cfg(test)]
    pub(super) fn of_angle(angle: f64, alternates: bool) -> Self {
        Self { angle, alternates, times: (1.0, 1.0), rates: (0.3, -0.2) }
    }

    /// Returns `true` if the turns of another look were the same.
    pub(super) fn agrees(&self, other: &Self) -> bool {
        self.alternates == other.alternates && (self.angle - other.angle).abs() < SAME
    }

    /// The verdict, after the model time `time`. It gives no period.
    pub(super) fn verdict(&self, time: f64) -> Verdict {
        let (regime, sense) = if self.alternates {
            (Regime::Zigzag, "to the left and to the right by turns")
        } else {
            (Regime::QuasiPeriodic, "to the same side")
        };
        let why = format!(
            "turns by {:.3} degrees {sense}, {TURNS} times in a row, after rests near motionless shapes \
            that are saddles; lambda_+ = {} and lambda_- = {} have a positive sum, so the rests stay \
            bounded; round-off decides how long they are ({:.1} to {:.1} from turn to turn)",
            self.angle.to_degrees(),
            decimals(self.rates.0, 4),
            decimals(self.rates.1, 4),
            self.times.0,
            self.times.1
        );
        let mut verdict = Verdict::new(regime, Attractor::Periodic, why, time);
        verdict.margin = Some(TURNS as f64 / 4.0); // 2^-12 is as unlikely as three and a half standard deviations
        verdict
    }
}
