//! Round numbers along an axis: steps of 1, 2 or 5 times a power of ten.

use super::geometry::Range;

/// Fewest ticks an axis gets.
pub const FEWEST: usize = 3;
/// Most ticks an axis gets.
pub const MOST: usize = 10;

/// Ticks inside a range, with labels that share their decimals.
#[derive(Debug, Clone, PartialEq)]
pub struct Ticks {
    /// Positions in data units, increasing.
    pub values: Vec<f64>,
    /// Label of each tick, with a true minus sign; to be multiplied by ten to the `exponent`.
    pub labels: Vec<String>,
    /// Positions of short ticks without label, between the others; only logarithmic axes have them.
    pub minor: Vec<f64>,
    /// Power of ten taken out of the labels; 0 for numbers of ordinary size.
    pub exponent: i32,
    pub(super) step: Step,
}

/// The step `mantissa` * 10^`power`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    pub(super) mantissa: i64,
    pub(super) power: i32,
}

impl Step {
    /// `k` steps; correctly rounded, since powers of ten up to 10^22 are exact.
    fn times(self, k: i64, shift: i32) -> f64 {
        let (whole, power) = ((k * self.mantissa) as f64, self.power - shift);
        if power < 0 { whole / 10f64.powi(-power) } else { whole * 10f64.powi(power) }
    }

    fn finer(self) -> Self {
        match self.mantissa {
            1 => Self { mantissa: 5, power: self.power - 1 },
            5 => Self { mantissa: 2, ..self },
            _ => Self { mantissa: 1, ..self },
        }
    }

    /// First and last multiple inside the range, a rounding error beyond its ends allowed.
    pub(super) fn multiples(self, range: Range) -> (i64, i64) {
        let (step, slack) = (self.times(1, 0), 1e-9);
        ((range.min / step - slack).ceil() as i64, (range.max / step + slack).floor() as i64)
    }

    /// Number of multiples inside the range.
    fn count(self, range: Range) -> usize {
        let (first, last) = self.multiples(range);
        usize::try_from(last - first + 1).unwrap_or(0)
    }
}

impl Ticks {
    /// At most `target` ticks (clamped to 3..=10), as many as round steps allow; at least three.
    ///
    /// A range that is empty or reversed is first widened as [`Range::padded`] does.
    pub fn new(range: Range, target: usize) -> Self {
        let range = if range.span() > 0.0 { range } else { range.padded(0.0) };
        let target = target.clamp(FEWEST, MOST);
        let mut step = Step { mantissa: 1, power: range.span().log10().ceil() as i32 };
        loop {
            let finer = step.finer();
            if step.count(range) >= FEWEST && finer.count(range) > target {
                break;
            }
            step = finer;
        }
        Self::with_step(step, range)
    }

    fn with_step(step: Step, range: Range) -> Self {
        let (first, last) = step.multiples(range);
        let values: Vec<_> = (first..=last).map(|k| step.times(k, 0)).collect();
        let largest = values.iter().fold(step.times(1, 0), |m, v| m.max(v.abs()));
        let exponent = if (1e-3..1e5).contains(&largest) { 0 } else { largest.log10().floor() as i32 };
        let decimals = (exponent - step.power).max(0) as usize;
        let label = |k| {
            let text = format!("{:.decimals$}", step.times(k, exponent));
            text.replace('-', "\u{2212}")
        };
        let labels = (first..=last).map(label).collect();
        Self { labels, values, minor: Vec::new(), exponent, step }
    }

    /// As many ticks as fit: neighbouring labels, `extent` pixels long each, keep their distance on an axis of
    /// `pixels`.
    pub fn fitting(range: Range, pixels: f64, spacing: f64, extent: impl Fn(&str) -> f64) -> Self {
        let most = (pixels / spacing).clamp(FEWEST as f64, 8.0) as usize;
        let fits = |ticks: &Self| {
            let widest = ticks.labels.iter().map(|l| extent(l)).fold(0.0, f64::max);
            let gap = (ticks.values[1] - ticks.values[0]) / range.span() * pixels;
            gap >= widest + 0.3 * spacing.min(30.0)
        };
        let mut best = (FEWEST..=most).rev().map(|n| Self::new(range, n));
        let ticks = best.find(fits).unwrap_or_else(|| Self::new(range, FEWEST));
        if fits(&ticks) { ticks } else { ticks.thinned() }
    }

    /// Gives two axes of one unit the coarser of their steps, unless one of them would be left with fewer than three
    /// ticks.
    pub fn share_step(first: (&mut Self, Range), second: (&mut Self, Range)) {
        let coarser =
            if first.0.step.times(1, 0) > second.0.step.times(1, 0) { first.0.step } else { second.0.step };
        for (ticks, range) in [first, second] {
            if ticks.step != coarser && coarser.count(range) >= FEWEST {
                *ticks = Self::with_step(coarser, range);
            }
        }
    }

    /// A tick at 0, 1, 2, .. for each of some values, `pixels` apart, with the value as its label, which is left out where it would touch
    /// the one before; `extent` is the length of a label.
    pub fn listed(values: &[f64], pixels: f64, extent: impl Fn(&str) -> f64) -> Self {
        let mut free = f64::NEG_INFINITY;
        let label = |(place, value): (usize, &f64)| {
            let text = value.to_string().replace('-', "\u{2212}");
            let (at, half) = (place as f64 * pixels, 0.5 * extent(&text));
            if at - half < free {
                return String::new();
            }
            free = at + half + 4.0;
            text
        };
        let labels = values.iter().enumerate().map(label).collect();
        let step = Step { mantissa: 1, power: 0 };
        Self {
            values: (0..values.len()).map(|place| place as f64).collect(),
            labels,
            minor: Vec::new(),
            exponent: 0,
            step,
        }
    }

    /// Only every other label, for an axis too short for three.
    fn thinned(mut self) -> Self {
        for label in self.labels.iter_mut().skip(1).step_by(2) {
            label.clear();
        }
        self
    }

    /// `label` with the power of ten of these ticks put before its unit: "*x* (10^{4} model length)".
    pub fn scaled_label(&self, label: &str) -> String {
        let power = format!("10^{{{}}}", self.exponent);
        match (self.exponent, label.find(" (")) {
            (0, _) => label.to_owned(),
            (_, Some(unit)) => format!("{} ({power} {}", &label[..unit], &label[unit + 2..]),
            (_, None) => format!("{label} ({power})"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn ticks_cover_the_range(a in -1.0..1.0f64, span in 1e-3..1.0f64, power in -12..12i32, target in 0..20usize) {
            let scale = 10f64.powi(power);
            let range = Range { min: a * scale, max: (a + span) * scale };
            let Ticks { values, labels, .. } = Ticks::new(range, target);
            prop_assert!((FEWEST..=MOST).contains(&values.len()), "{values:?}");
            let step = values[1] - values[0];
            prop_assert!(values.windows(2).all(|w| w[0] < w[1] && ((w[1] - w[0]) / step - 1.0).abs() < 1e-6));
            // inside, and no further tick would be
            prop_assert!(values[0] >= range.min - 1e-6 * step && values[0] - step < range.min);
            prop_assert!(values[values.len() - 1] <= range.max + 1e-6 * step);
            prop_assert!(values[values.len() - 1] + step > range.max);
            let minus_zero = |l: &String| l.starts_with('\u{2212}') && l[3..].chars().all(|c| "0.".contains(c));
            let bad = labels.iter().any(|l| l.contains('-') || minus_zero(l));
            prop_assert!(!bad, "{:?}", labels);
            let mut seen = labels.clone();
            seen.dedup();
            prop_assert_eq!(seen, labels);
        }
    }

    #[test]
    fn labels_are_what_one_would_write() {
        let labels = |min, max| Ticks::new(Range { min, max }, 6).labels.join(" ");
        assert_eq!(labels(-0.26, 0.21), "\u{2212}0.2 \u{2212}0.1 0.0 0.1 0.2");
        assert_eq!(labels(0.0, 150.0), "0 50 100 150");
        assert_eq!(labels(0.0, 3e-5), "0 1 2 3");
    }

    #[test]
    fn axes_of_one_unit_share_a_step_where_it_leaves_ticks() {
        let steps = |min, max| {
            let (long, short) = (Range { min: 0.0, max: 150.0 }, Range { min, max });
            let (mut a, mut b) = (Ticks::new(long, 4), Ticks::new(short, 4));
            Ticks::share_step((&mut a, long), (&mut b, short));
            (a.values[1] - a.values[0], b.values[1] - b.values[0])
        };
        assert_eq!(steps(-60.0, 60.0), (50.0, 50.0));
        assert_eq!(steps(-1.0, 1.0), (50.0, 1.0));
        assert_eq!(steps(3.0, 4.0).0, 50.0);
    }

    #[test]
    fn the_power_of_ten_goes_to_the_unit() {
        let ticks = Ticks::new(Range { min: 0.0, max: 2e6 }, 5);
        assert_eq!(ticks.scaled_label("*x* (model length)"), "*x* (10^{6} model length)");
        assert_eq!(ticks.scaled_label("*x*"), "*x* (10^{6})");
    }
}
