//! Ticks of a logarithmic axis: powers of ten, with 2 to 9 times them between.

use super::geometry::Range;
use super::ticks::{Step, Ticks};

/// Multiples of a power of ten that are labelled where few powers are in sight.
const LABELLED: [u8; 3] = [1, 2, 5];

impl Ticks {
    /// Ticks for an axis whose unit is log10 of the quantity, `pixels` long; `extent` is the length of a label.
    ///
    /// Powers of ten "10^{-3}", every k-th where they would crowd. With less than two of them inside the range, 1, 2
    /// and 5 times each power ("0.2", "2 × 10^{-5}") are labelled, so that a range of one decade or more has at least
    /// three ticks. Between labelled ticks stand minor ones, where there is room: 2 to 9
    /// times each power, or the skipped powers.
    pub fn decades(range: Range, pixels: f64, extent: impl Fn(&str) -> f64) -> Self {
        let (first, last) = Step { mantissa: 1, power: 0 }.multiples(range);
        if last <= first {
            return Self::within_decade(range);
        }
        let decade = pixels / range.span();
        let power = |k: i64| format!("10^{{{k}}}");
        let widest = [first, last].map(|k| extent(&power(k))).into_iter().fold(0.0, f64::max);
        let every = [1, 2, 3, 5, 10, 20, 50].into_iter().find(|n| decade * f64::from(*n) >= widest + 12.0);
        let every = i64::from(every.unwrap_or(100));
        let (labelled, skipped): (Vec<_>, Vec<_>) = (first..=last).partition(|k| k.rem_euclid(every) == 0);
        let minor = match every {
            1 if decade >= 36.0 => between(range).map(|(k, m)| position(k, m)).collect(),
            _ if decade < 5.0 => Vec::new(),
            _ => skipped.iter().map(|k| *k as f64).collect(),
        };
        let values = labelled.iter().map(|k| *k as f64).collect();
        Self { values, labels: labelled.into_iter().map(power).collect(), minor, ..Self::none() }
    }

    /// 1, 2 and 5 times each power of ten, labelled.
    fn within_decade(range: Range) -> Self {
        let all = powers(range).flat_map(|k| (1..=9).map(move |m| (k, m)));
        let inside = all.filter(|(k, m)| holds(range, position(*k, *m)));
        let (labelled, rest): (Vec<_>, Vec<_>) = inside.partition(|(_, m)| LABELLED.contains(m));
        let place = |list: &[(i64, u8)]| list.iter().map(|(k, m)| position(*k, *m)).collect();
        let labels = labelled.iter().map(|(k, m)| number(*k, *m)).collect();
        Self { values: place(&labelled), labels, minor: place(&rest), ..Self::none() }
    }

    fn none() -> Self {
        let step = Step { mantissa: 1, power: 0 };
        Self { values: Vec::new(), labels: Vec::new(), minor: Vec::new(), exponent: 0, step }
    }
}

/// 2 to 9 times each power of ten inside the range.
fn between(range: Range) -> impl Iterator<Item = (i64, u8)> {
    let all = powers(range).flat_map(|k| (2..=9).map(move |m| (k, m)));
    all.filter(move |(k, m)| holds(range, position(*k, *m)))
}

/// The powers of ten that begin in the range or right below it.
fn powers(range: Range) -> impl Iterator<Item = i64> {
    range.min.floor() as i64..=range.max.floor() as i64
}

/// log10(`multiple` * 10^`power`).
fn position(power: i64, multiple: u8) -> f64 {
    power as f64 + libm::log10(f64::from(multiple))
}

fn holds(range: Range, value: f64) -> bool {
    value >= range.min - 1e-9 && value <= range.max + 1e-9
}

/// "0.02", "500" or "2 × 10^{-5}".
fn number(power: i64, multiple: u8) -> String {
    match power {
        0..=3 => format!("{multiple}{}", "0".repeat(power as usize)),
        -3..=-1 => format!("0.{}{multiple}", "0".repeat((-power - 1) as usize)),
        _ if multiple == 1 => format!("10^{{{power}}}"),
        _ => format!("{multiple} × 10^{{{power}}}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn labels(min: f64, max: f64, pixels: f64) -> String {
        Ticks::decades(Range { min, max }, pixels, |_| 12.0).labels.join(" ")
    }

    #[test]
    fn decades_are_powers_of_ten() {
        assert_eq!(labels(-3.2, 0.4, 300.0), "10^{-3} 10^{-2} 10^{-1} 10^{0}");
        assert_eq!(labels(-8.0, 0.0, 100.0), "10^{-8} 10^{-6} 10^{-4} 10^{-2} 10^{0}");
        assert_eq!(
            labels(-300.0, 300.0, 300.0),
            "10^{-300} 10^{-250} 10^{-200} 10^{-150} 10^{-100} 10^{-50} \
            10^{0} 10^{50} 10^{100} 10^{150} 10^{200} 10^{250} 10^{300}"
        );
    }

    #[test]
    fn a_short_axis_labels_multiples() {
        assert_eq!(labels(-1.5, -0.5, 300.0), "0.05 0.1 0.2");
        assert_eq!(labels(4.6, 5.6, 300.0), "5 × 10^{4} 10^{5} 2 × 10^{5}");
        assert_eq!(labels(1.1, 2.1, 300.0), "20 50 100");
    }

    proptest! {
        #[test]
        fn every_range_gets_ticks_inside_it(min in -320.0..300.0f64, span in 1.0..300.0f64) {
            let range = Range { min, max: min + span };
            let ticks = Ticks::decades(range, 300.0, |_| 12.0);
            prop_assert!(ticks.values.len() >= 2 && ticks.values.len() == ticks.labels.len());
            prop_assert!(ticks.values.windows(2).all(|w| w[0] < w[1]));
            prop_assert!(ticks.values.iter().chain(&ticks.minor).all(|v| holds(range, *v)));
            prop_assert!(ticks.values.iter().all(|v| !ticks.minor.contains(v)));
            prop_assert!(ticks.values.len() + ticks.minor.len() <= 100);
        }
    }
}
