//! The growth of the period of an orbit towards a connection.

use super::homoclinic::{Connection, PeriodLaw};
use motiform_analysis::linear::solve;
use motiform_dynamics::sample::sort_by_number;

/// Laws by which the distance to a connection falls as a power of the time: `|p - p0| ~ 1/T^k`.
#[derive(Clone, Copy, Debug)]
pub(super) enum Algebraic {
    /// [`PeriodLaw::Resonant`].
    Resonant = 1,
    /// [`PeriodLaw::SquareRoot`].
    SquareRoot = 2,
}

/// Times along a branch of orbits, with the slope of the parameter.
#[derive(Debug, Default)]
pub(super) struct Periods {
    /// `(T, p, dp/dT)`, of the last points over which the time grew.
    pub(super) points: Vec<(f64, f64, f64)>,
}

/// The law must hold over as many points.
const POINTS: usize = 6;

/// Rates over the two halves of the points agree up to this part: what remains of the parameter is then known to more than one digit.
const AGREE: f64 = 0.05;

/// The rate is fitted over the times above this part of the last one.
const WINDOW: f64 = 0.85;

/// The same in long steps.
const LONG_WINDOW: f64 = 0.5;

/// The connection is reached where this part of the parameter, or of its unit, remains.
pub(super) const NEAR: f64 = 1e-7;

/// Fits that the best one is compared with.
const COMPARED: usize = 11;

/// The algebraic laws are tried where the time has grown by this factor.
const GROWN: f64 = 2.0;

impl Periods {
    /// A point of the branch: the time with its derivative along the branch, and the same of the parameter.
    pub(super) fn push(&mut self, time: (f64, f64), parameter: (f64, f64)) {
        let grows = self.points.last().is_none_or(|last| time.0 > last.0 && time.1 > 0.0);
        if !grows {
            self.points.clear();
        }
        self.points.push((time.0, parameter.0, parameter.1 / time.1));
    }

    /// Returns `true` if the time grew over the last points.
    pub(super) fn is_growing(&self) -> bool {
        self.points.len() > 2
    }

    /// Returns `true` if the parameter stayed within this error over the last times.
    pub(super) fn stays(&self, times: f64, error: f64) -> bool {
        let (Some(first), Some(last)) = (self.points.first(), self.points.last()) else { return false };
        let late = self.points.iter().filter(|point| point.0 > last.0 - times);
        let most = late.map(|point| (point.1 - last.1).abs()).fold(0.0, f64::max);
        first.0 < last.0 - times && most < error
    }

    /// The connection ahead, where the logarithmic law holds and little remains of a parameter with this unit.
    pub(super) fn connection(&self, unit: f64) -> Option<Connection> {
        let time = self.points.last()?.0;
        // in long steps the times above the window are few: the law is tested over as many points, but not from far away
        let from = self.points.iter().position(|point| point.0 > WINDOW * time)?;
        let from = from.min(self.points.len().checked_sub(POINTS)?);
        let last = &self.points[from..];
        if last[0].0 < LONG_WINDOW * time {
            return None;
        }
        let &(_, parameter, slope) = last.last()?;
        // p - p0 = c exp(-rate T): ln|dp/dT| is linear in T
        let (rate, spread) = exponent(last)?;
        let remaining = slope / rate;
        let place = parameter + remaining;
        let others = others(last).map(|other| (other - place).abs()).fold(0.0, f64::max);
        (remaining.abs() < NEAR * (unit + parameter.abs())).then(|| Connection {
            error: others.max(AGREE * remaining.abs()) + f64::EPSILON * parameter.abs(),
            law_error: spread,
            ..Connection::at(place, remaining.abs(), PeriodLaw::Logarithmic { rate })
        })
    }

    /// The connection ahead by one of the algebraic laws, for a branch whose flow cannot be resolved any further, or whose time has become
    /// very long: there the distance falls so slowly that a branch never comes near. Of the fits to the last half of the times the one that
    /// its points lie on best: the very last points carry the most round-off.
    pub(super) fn algebraic(&self, law: Algebraic) -> Option<Connection> {
        let longest = self.points.last()?.0;
        let late = (0..self.points.len()).filter(|&i| self.points[i].0 > 0.5 * longest);
        let mut fits: Vec<(Connection, f64)> = late.filter_map(|last| self.fit(law, last)).collect();
        sort_by_number(&mut fits, |a| a.1);
        let (best, others) = fits.split_first()?;
        let compared = &others[..others.len().min(COMPARED)];
        // Neighbouring fits have errors in common: of those that are nearly as good, the farthest one counts three times.
        let spread = |value: &dyn Fn(&Connection) -> f64| {
            let away = compared.iter().map(|other| (value(&other.0) - value(&best.0)).abs());
            3.0 * away.fold(0.0, f64::max)
        };
        let (error, law_error) = if compared.is_empty() {
            (best.0.remaining, amplitude(&best.0))
        } else {
            (spread(&|fit| fit.parameter), spread(&amplitude))
        };
        let error = error.max(f64::EPSILON * best.0.parameter.abs());
        Some(Connection { error, law_error, ..best.0.clone() })
    }

    /// `p = p0 + A/T^k + B/T^(k+1) + C/T^(k+2)` through the point number `last` and one well before it, with their slopes, and how far the
    /// points between them are from it, as a part of what remains. The first term must be the largest one. Times are parts of the last one:
    /// whatever the unit of time, the powers have one size.
    fn fit(&self, law: Algebraic, last: usize) -> Option<(Connection, f64)> {
        let power = law as i32;
        let (time, parameter, _) = self.points[last];
        let first = self.points.iter().position(|point| point.0 > time / 1.6)?;
        if last < first + POINTS || self.points.first()?.0 > time / GROWN {
            return None;
        }
        let ends = [self.points[first], self.points[last]];
        let column = |power: i32| {
            let value = |t: f64| [1.0, -f64::from(power)].map(|factor| factor * (t / time).powi(-power)); // and t times the slope
            ends.map(|(t, _, _)| value(t)).concat()
        };
        let powers = [0, power, power + 1, power + 2];
        let fit = solve(&powers.map(column), &ends.map(|(t, p, q)| [p, q * t]).concat(), 1e-14)?;
        let at = |t: f64| {
            let t = t / time;
            fit[0] + (fit[1] + (fit[2] + fit[3] / t) / t) / t.powi(power)
        };
        let remaining = (fit[0] - parameter).abs();
        let off = |&(t, p, _): &(f64, f64, f64)| (at(t) - p).abs() / remaining;
        let worst = self.points[first..last].iter().map(off).fold(0.0, f64::max);
        let term = fit[1].abs();
        let leads = term > 0.7 * remaining && term < 1.3 * remaining;
        let law = match law {
            Algebraic::Resonant => PeriodLaw::Resonant { amplitude: term * time },
            Algebraic::SquareRoot => PeriodLaw::SquareRoot { amplitude: term.sqrt() * time },
        };
        (leads && worst < 1e-3).then_some((Connection::at(fit[0], remaining, law), worst))
    }
}

/// The amplitude of an algebraic law.
fn amplitude(connection: &Connection) -> f64 {
    match connection.law {
        PeriodLaw::Resonant { amplitude } | PeriodLaw::SquareRoot { amplitude } => amplitude,
        PeriodLaw::Logarithmic { .. } | PeriodLaw::Oscillating { .. } => f64::NAN,
    }
}

/// The connection by the logarithmic law from other selections of the points: without the last one, and from the later half.
fn others(points: &[(f64, f64, f64)]) -> impl Iterator<Item = f64> {
    let selections = [&points[..points.len() - 1], &points[points.len() / 2..]];
    selections.into_iter().filter_map(|selection| {
        let (first, last) = (selection.first()?, selection.last()?);
        let rate = slowing(first, last);
        (rate > 0.0).then_some(last.1 + last.2 / rate)
    })
}

/// `-d ln|dp/dT| / dT` between two points; no number where the slope changes its sign.
fn slowing(&(t0, _, s0): &(f64, f64, f64), &(t1, _, s1): &(f64, f64, f64)) -> f64 {
    if s0 * s1 > 0.0 { libm::log(s0 / s1) / (t1 - t0) } else { f64::NAN }
}

/// `-d ln|dp/dT| / dT` over all points, where it is positive and about the same over both halves of them; with the difference between the
/// halves.
fn exponent(points: &[(f64, f64, f64)]) -> Option<(f64, f64)> {
    let (first, middle, last) = (points.first()?, points.get(points.len() / 2)?, points.last()?);
    let (early, late) = (slowing(first, middle), slowing(middle, last));
    let (mean, spread) = (slowing(first, last), (early - late).abs());
    (mean > 0.0 && spread < AGREE * mean).then_some((mean, spread))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    /// `p = 0.4 - 0.009/T - 0.02/T^2` and `p = 0.4 - 0.009/T^2 - 0.02/T^3` up to T = 60, with T in other units.
    #[test]
    fn algebraic_laws_are_those_of_other_units_of_time() {
        for (law, amplitude) in [(Algebraic::Resonant, 0.009), (Algebraic::SquareRoot, 0.009_f64.sqrt())] {
            for unit in [1e-6, 1.0, 1e3, 1e6] {
                let mut periods = Periods::default();
                for time in (20..=60).map(f64::from) {
                    let (first, second) = (0.009 / time.powi(law as i32), 0.02 / time.powi(law as i32 + 1));
                    let slope = (f64::from(law as i32) * first + f64::from(law as i32 + 1) * second) / time;
                    periods.push((unit * time, unit), (0.4 - first - second, slope));
                }
                let found = periods.algebraic(law).unwrap();
                let of_law = super::amplitude(&found) / unit;
                assert!((found.parameter - 0.4).abs() < 1e-12, "{unit}: {found:?}");
                assert!((of_law / amplitude - 1.0).abs() < 1e-9, "{unit}: {found:?}");
            }
        }
    }
}
