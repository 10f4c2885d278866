//! Oscillation of the parameter towards a connection of a saddle-focus with itself.

use super::homoclinic::{Connection, PeriodLaw, leading_sides};
use super::periods::{NEAR, Periods};
use motiform_analysis::linear::solve;

/// The law must hold over as many points.
const POINTS: usize = 10;

/// It is fitted over as many half turns of the pair: between two of its folds there is one.
const HALF_TURNS: f64 = 4.0;

/// The branch must have turned so often in these half turns.
const FOLDS: usize = 3;

/// The residual of a good fit, as a part of the amplitude.
const AGREE: f64 = 0.1;

impl Periods {
    /// The connection with a saddle-focus ahead, where a parameter of this unit has converged to [`NEAR`] over the last [`HALF_TURNS`] of
    /// its leading pair `+-rate +- i frequency`, and there is
    ///
    /// `p = p0 + exp(-rate T) (a cos(frequency T) + b sin(frequency T))`
    ///
    /// with the rate and the frequency of the saddle: `p0`, `a` and `b` are fitted, every point with the weight `exp(rate T)`. `None` where
    /// the pair is not the slowest of all, or the branch does not turn back as it should. The error is the largest difference from the same
    /// fits up to one half turn earlier and to every other point, and what the fit leaves.
    ///
    /// Source: Glendinning and Sparrow (1984), J. Stat. Phys. 35, 645.
    pub(super) fn oscillating(&self, rates: &[(f64, f64)], unit: f64) -> Option<Connection> {
        let pair = leading(rates)?;
        let &(end, parameter, _) = self.points.last()?;
        let late = self.late(pair, end);
        let changes = late.iter().map(|point| (point.1 - parameter).abs()).fold(0.0, f64::max);
        let turns = late.windows(2).filter(|pair| pair[0].2 * pair[1].2 < 0.0).count();
        if late.len() < POINTS || turns < FOLDS || changes > NEAR * (unit + parameter.abs()) {
            return None;
        }
        let (place, rest) = fit(&late, pair, end)?;
        let others = self.other_fits(&late, pair, end)?;
        let away = others.iter().map(|other| (place - other).abs()).fold(0.0, f64::max);
        let law = PeriodLaw::Oscillating { rate: pair.0, frequency: pair.1 };
        let error = away + rest + f64::EPSILON * parameter.abs();
        Some(Connection { error, ..Connection::at(place, (parameter - place).abs(), law) })
    }

    /// The same limit from other selections of points: those up to earlier times, and every other one of the last.
    fn other_fits(&self, late: &[Seen], pair: (f64, f64), end: f64) -> Option<Vec<f64>> {
        let half_turn = std::f64::consts::PI / pair.1;
        let mut all = Vec::new();
        for part in [0.25, 0.5, 0.75, 1.0] {
            let before = end - part * half_turn;
            all.push(fit(&self.late(pair, before), pair, before)?.0);
        }
        for first in [0, 1] {
            let every_other: Vec<Seen> = late.iter().skip(first).step_by(2).copied().collect();
            all.push(fit(&every_other, pair, end)?.0);
        }
        Some(all)
    }

    /// The points of the half turns before a time.
    fn late(&self, (_, frequency): (f64, f64), end: f64) -> Vec<Seen> {
        let from = end - HALF_TURNS * std::f64::consts::PI / frequency;
        self.points.iter().filter(|point| (from..=end).contains(&point.0)).copied().collect()
    }
}

/// `(T, p, dp/dT)`.
type Seen = (f64, f64, f64);

/// `p0`, and the root mean square of what the fit to these points leaves at the time `end`.
fn fit(points: &[Seen], (rate, frequency): (f64, f64), end: f64) -> Option<(f64, f64)> {
    let centre = points.last()?.1;
    let row = |t: f64| {
        let (sin, cos) = libm::sincos(frequency * (t - end));
        [libm::exp(rate * (t - end)), cos, sin]
    };
    // normal equations of three unknowns, with weights that make all turns equal
    let (mut columns, mut right) = (vec![vec![0.0; 3]; 3], vec![0.0; 3]);
    for &(t, p, _) in points {
        let row = row(t);
        for i in 0..3 {
            right[i] += row[i] * row[0] * (p - centre);
            (0..3).for_each(|j| columns[j][i] += row[i] * row[j]);
        }
    }
    let [p0, a, b] = solve(&columns, &right, 1e-12)?[..] else { return None };
    let left = |&(t, p, _): &Seen| {
        let row = row(t);
        row[0] * (p - centre - p0) - a * row[1] - b * row[2]
    };
    let rest = points.iter().map(left).map(|rest| rest * rest).sum::<f64>() / points.len() as f64;
    let amplitude = libm::hypot(a, b);
    (rest.sqrt() < AGREE * amplitude).then_some((centre + p0, rest.sqrt()))
}

/// The time between two folds beside a connection of a saddle with these rates, where the parameter oscillates towards it.
pub(super) fn half_turn(rates: &[(f64, f64)]) -> Option<f64> {
    leading(rates).map(|pair| std::f64::consts::PI / pair.1)
}

/// The rate and the frequency of the leading pair, if it is slower than all eigenvalues of the other side: the parameter oscillates towards
/// a connection.
pub(super) fn leading(rates: &[(f64, f64)]) -> Option<(f64, f64)> {
    let [grows, decays] = leading_sides(rates)?;
    let (first, other) = if grows.0.abs() < decays.0.abs() { (grows, decays) } else { (decays, grows) };
    (first.1 > 0.0 && first.0.abs() < other.0.abs()).then_some((first.0.abs(), first.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on `p = 0.5 + exp(-0.15 T) cos(0.3 T) + 0.3 exp(-0.3 T)`.
    fn periods(count: usize) -> Periods {
        let mut all = Periods::default();
        for i in 0..count {
            let t = 20.0 * libm::exp(0.02 * i as f64);
            let (sin, cos) = libm::sincos(0.3 * t);
            let (slow, fast) = (libm::exp(-0.15 * t), 0.3 * libm::exp(-0.3 * t));
            let slope = -slow * (0.15 * cos + 0.3 * sin) - 0.3 * fast;
            all.push((t, 1.0), (0.5 + slow * cos + fast, slope));
        }
        all
    }

    #[test]
    fn the_limit_of_an_oscillating_parameter_is_within_its_error() {
        let rates = [(0.8, 0.0), (-0.15, 0.3), (-0.15, -0.3), (-2.0, 0.0)];
        for count in [85, 90, 95] {
            let all = periods(count);
            let found = all.oscillating(&rates, 1e4).expect("it oscillates");
            assert!((found.parameter - 0.5).abs() <= found.error && found.error < 1e-5, "{found:?}");
        }
        let all = periods(95);
        for other in [
            [(0.8, 0.0), (-0.15, 0.2), (-0.15, -0.2), (-2.0, 0.0)],
            [(0.1, 0.0), (-0.15, 0.3), (-0.15, -0.3), (-2.0, 0.0)],
            [(0.8, 0.0), (-0.3, 0.3), (-0.3, -0.3), (-2.0, 0.0)],
        ] {
            assert!(all.oscillating(&other, 1e4).is_none(), "{other:?}");
        }
    }
}
