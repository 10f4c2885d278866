//! Times -> numbers of frames.

use motiform_dynamics::sample::ascending;

/// Deviation from a multiple of the interval, in intervals, from which times count as uneven: files round times.
const UNEVEN: f64 = 0.1;

/// Frames beyond which times are not multiples of an interval.
const FAR: f64 = 1e9;

/// The median of the differences of times.
pub(crate) fn median_difference(times: &[f64]) -> Option<f64> {
    let mut differences: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    ascending(&mut differences);
    differences.get(differences.len() / 2).copied().filter(|d| d.is_finite() && *d > 0.0)
}

/// Frame numbers from the steps of time: the first is t/interval, rounded. `None` where a step is no multiple of the interval.
pub(crate) fn numbers(times: &[f64], interval: Option<f64>) -> Option<Vec<i64>> {
    let Some(interval) = interval else { return Some(vec![0; times.len()]) };
    let first = times.first()? / interval;
    let mut at = if first.abs() < FAR { first.round() as i64 } else { return None };
    let mut numbers = vec![at];
    for pair in times.windows(2) {
        let step = (pair[1] - pair[0]) / interval;
        if (step - step.round()).abs() > UNEVEN || step.round() < 1.0 || step > FAR {
            return None;
        }
        at += step.round() as i64;
        numbers.push(at);
    }
    Some(numbers)
}
