//! Even clocks behind rounded time stamps.

use motiform_dynamics::sample::median;

/// Fewest times that show a clock.
const FEWEST: usize = 8;
/// Most decimals of a rounded time.
const DECIMALS: i32 = 9;
/// Relative difference up to which times are the same: round-off.
const SAME: f64 = 1e-6;
/// Part of an interval from which on rounding matters.
const MATTERS: f64 = 0.01;
/// Multiple of the median interval up to which an interval is that of one frame.
const ONE_FRAME: f64 = 1.75;
/// Steps to the interval of least deviation.
const STEPS: usize = 60;

/// An even clock.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Clock {
    /// Its times, one for each stamp.
    pub(super) times: Vec<f64>,
    /// Its interval.
    pub(super) interval: f64,
    /// The unit to which the stamps are rounded.
    pub(super) unit: f64,
}

impl Clock {
    /// The even clock that explains all of these stamps, which increase, within half a unit of their last digit; `frames`: their numbers,
    /// which are counted from the intervals where there are none. `None` where no such clock does, where the stamps are even themselves,
    /// and where rounding is below a hundredth of the interval.
    ///
    /// `max (t_k - k dt) - min (t_k - k dt)` is a convex function of dt, and its least value is at most a unit.
    pub(super) fn of(stamps: &[f64], frames: Option<&[f64]>) -> Option<Self> {
        if stamps.len() < FEWEST {
            return None;
        }
        let unit = unit(stamps)?;
        match frames {
            Some(frames) => Self::at(stamps, frames, unit),
            None => {
                let in_order: Vec<f64> = (0..stamps.len()).map(|k| k as f64).collect();
                Self::at(stamps, &in_order, unit).or_else(|| Self::at(stamps, &counted(stamps)?, unit))
            }
        }
    }

    /// The clock of stamps of these frames.
    fn at(stamps: &[f64], counted: &[f64], unit: f64) -> Option<Self> {
        let last = stamps.len() - 1;
        let first = (stamps[last] - stamps[0]) / (counted[last] - counted[0]);
        let spread = |interval: f64| {
            let off = stamps.iter().zip(counted).map(|(t, k)| t - (k - counted[0]) * interval);
            off.fold([f64::INFINITY, f64::NEG_INFINITY], |ends, t| [ends[0].min(t), ends[1].max(t)])
        };
        let width = |interval: f64| spread(interval)[1] - spread(interval)[0];
        if !(first > 0.0 && unit > MATTERS * first && unit < first) || width(first) < SAME * unit {
            return None;
        }
        let reach = 2.0 * unit / (counted[last] - counted[0]);
        let [mut low, mut high] = [first - reach, first + reach];
        for _ in 0..STEPS {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if width(a) <= width(b) { high = b } else { low = a }
        }
        let interval = 0.5 * (low + high);
        let [least, most] = spread(interval);
        let start = 0.5 * (least + most);
        let times = counted.iter().map(|k| start + (k - counted[0]) * interval).collect();
        (most - least <= unit * (1.0 + SAME)).then_some(Self { times, interval, unit })
    }
}

/// The power of ten of which all times are multiples; `None` where they have more decimals.
fn unit(times: &[f64]) -> Option<f64> {
    let is_multiple = |unit: f64| times.iter().all(|t| (t / unit - (t / unit).round()).abs() < SAME);
    (0..=DECIMALS).map(|decimals| libm::exp10(-f64::from(decimals))).find(|unit| is_multiple(*unit))
}

/// Frames counted by intervals: each is that of the nearest number of frames, one at least.
fn counted(times: &[f64]) -> Option<Vec<f64>> {
    let gaps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let usual = median(gaps.iter().copied())?;
    let short = || gaps.iter().filter(|gap| **gap <= ONE_FRAME * usual);
    let interval = short().sum::<f64>() / short().count() as f64;
    let mut frames = vec![0.0];
    for gap in gaps {
        let last = frames[frames.len() - 1];
        frames.push(last + (gap / interval).round().max(1.0));
    }
    Some(frames)
}

#[cfg(test)]
mod tests {
    use super::Clock;

    fn rounded(interval: f64, unit: f64, start: f64, missing: impl Fn(usize) -> bool) -> Vec<f64> {
        let times = (0..300).filter(|k| !missing(*k)).map(|k| start + k as f64 * interval);
        times.map(|t| (t / unit).round() * unit).collect()
    }

    #[test]
    fn a_clock_is_found_whatever_its_interval_start_and_gaps() {
        for (interval, unit) in [(1.0 / 6.0, 0.1), (100.0 / 3.0, 1.0), (0.0125, 0.01)] {
            for start in [0.0, 0.377 * interval, -4321.0 * unit] {
                // where a stamp step is one frame or two, missing ones are not told
                for every in if interval < 0.1 { [1000, 1000] } else { [1000, 7] } {
                    let stamps = rounded(interval, unit, start, |k| k % every == every - 1);
                    let found = Clock::of(&stamps, None)
                        .unwrap_or_else(|| panic!("{interval} {unit} {start} {every}"));
                    assert!((found.interval / interval - 1.0).abs() < 0.01 * unit / interval, "{found:?}");
                    assert!((found.unit / unit - 1.0).abs() < 1e-9);
                    let off = found.times.iter().zip(&stamps).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                    assert!(off < 0.501 * unit, "{off}");
                }
            }
        }
    }

    #[test]
    fn even_stamps_and_uneven_times_stay() {
        let even: Vec<f64> = (0..50).map(|k| 0.25 * f64::from(k)).collect();
        assert_eq!(Clock::of(&even, None), None);
        let two_rates: Vec<f64> =
            (0..50).map(f64::from).chain((25..50).map(|k| 2.0 * f64::from(k))).collect();
        assert_eq!(Clock::of(&two_rates, None), None);
        // an uneven camera: times that no clock has within half a unit
        let uneven: Vec<f64> = (0..50).map(|k| f64::from(k) + 0.1 * f64::from((k * k) % 7)).collect();
        assert_eq!(Clock::of(&uneven, None), None);
    }

    /// Frame numbers say how many frames passed, however coarse the stamps.
    #[test]
    fn frames_count_where_they_are_known() {
        let frames: Vec<f64> = (0..80).filter(|k| k % 3 != 1).map(f64::from).collect();
        let stamps: Vec<f64> = frames.iter().map(|k| (k * 1.3).round()).collect();
        let found = Clock::of(&stamps, Some(&frames)).unwrap_or_else(|| panic!("a clock"));
        assert!((found.interval - 1.3).abs() < 0.01, "{}", found.interval);
    }
}
