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
    /// The connection with a saddle-focus ahead, where the parameter has converged to [`NEAR`] over the last [`HALF_TURNS`] of its leading
    /// pair `+-rate +- i frequency`, and there is
    ///
    /// `p = p0 + exp(-rate T) (a cos(frequency T) + b sin(frequency T))`
    ///
    /// with the rate and the frequency of the saddle: `p0`, `a` and `b` are fitted, every point with the weight `exp(rate T)`. `None` where
    /// the pair is not the slowest of all, or the branch does not turn back as it should. The error is the difference from the same fit one
    /// half turn earlier, and what the fit leaves.
    ///
    /// Source: Glendinning and Sparrow (1984), J. Stat. Phys. 35, 645.
    pub(super) fn oscillating(&self, rates: &[(f64, f64)]) -> Option<Connection> {
        let pair = leading(rates)?;
        let half_turn = std::f64::consts::PI / pair.1;
        let &(end, parameter, _) = self.points.last()?;
        let last = self.fit_turns(pair, end)?;
        let before = self.fit_turns(pair, end - half_turn)?;
        let error = (last.0 - before.0).abs() + last.1 + f64::EPSILON * parameter.abs();
        Some(Connection {
            parameter: last.0,
            remaining: (parameter - last.0).abs(),
            error,
            law: PeriodLaw::Oscillating { rate: pair.0, frequency: pair.1 },
            saddle: None,
            rates: Vec::new(),
            joins: None,
            passed: Vec::new(),
        })
    }

    /// Returns `true` if the parameter, with this unit, hardly changes any more over the last times.
    pub(super) fn has_converged(&self, unit: f64) -> bool {
        let Some(&(end, parameter, _)) = self.points.last() else { return false };
        let late = self.points.iter().rev().take_while(|point| point.0 > 0.7 * end);
        let (mut count, mut most) = (0, 0.0_f64);
        for point in late {
            (count, most) = (count + 1, most.max((point.1 - parameter).abs()));
        }
        count >= POINTS && most < NEAR * (unit + parameter.abs())
    }

    /// `p0`, and the root mean square of what the fit leaves at the time `end`, from the points of the half turns before it.
    fn fit_turns(&self, (rate, frequency): (f64, f64), end: f64) -> Option<(f64, f64)> {
        let from = end - HALF_TURNS * std::f64::consts::PI / frequency;
        let points: Vec<_> = self.points.iter().filter(|point| (from..=end).contains(&point.0)).collect();
        let turns = points.windows(2).filter(|pair| pair[0].2 * pair[1].2 < 0.0).count();
        if points.len() < POINTS || turns < FOLDS {
            return None;
        }
        let centre = points.last()?.1;
        let row = |t: f64| {
            let (sin, cos) = libm::sincos(frequency * (t - end));
            [libm::exp(rate * (t - end)), cos, sin]
        };
        // normal equations of three unknowns, with weights that make all turns equal
        let (mut columns, mut right) = (vec![vec![0.0; 3]; 3], vec![0.0; 3]);
        for &&(t, p, _) in &points {
            let row = row(t);
            for i in 0..3 {
                right[i] += row[i] * row[0] * (p - centre);
                (0..3).for_each(|j| columns[j][i] += row[i] * row[j]);
            }
        }
        let [p0, a, b] = solve(&columns, &right, 1e-12)?[..] else { return None };
        let left = |&&(t, p, _): &&(f64, f64, f64)| {
            let row = row(t);
            row[0] * (p - centre - p0) - a * row[1] - b * row[2]
        };
        let rest = points.iter().map(left).map(|rest| rest * rest).sum::<f64>() / points.len() as f64;
        let amplitude = libm::hypot(a, b);
        (rest.sqrt() < AGREE * amplitude).then_some((centre + p0, rest.sqrt()))
    }
}

/// The rate and the frequency of the leading pair, if it is slower than all eigenvalues of the other side.
fn leading(rates: &[(f64, f64)]) -> Option<(f64, f64)> {
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
            let found = all.oscillating(&rates).expect("it oscillates");
            assert!((found.parameter - 0.5).abs() <= found.error && found.error < 1e-5, "{found:?}");
        }
        let all = periods(95);
        for other in [
            [(0.8, 0.0), (-0.15, 0.2), (-0.15, -0.2), (-2.0, 0.0)],
            [(0.1, 0.0), (-0.15, 0.3), (-0.15, -0.3), (-2.0, 0.0)],
            [(0.8, 0.0), (-0.3, 0.3), (-0.3, -0.3), (-2.0, 0.0)],
        ] {
            assert!(all.oscillating(&other).is_none(), "{other:?}");
        }
    }
}
