//! A test that lives have no memory: that they are exponential after their delay.

use crate::{Result, Stay, ascending, checks};

/// Fewest ends of lives that are tested.
const LEAST: usize = 8;

/// The difference of lives from exponential ones.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Memory {
    /// The probability of lives as far from exponential ones, or farther, if they are.
    pub probability: f64,
    /// Ends of lives that are tested.
    pub events: usize,
    /// Mean place of the ends on the scale of the time on test, 0 to 1: below 1/2 lives end less and less often, above more and more often.
    pub place: f64,
}

/// The test that lives after their delay are exponential, each set with its own mean; `None` with fewer than eight ends.
///
/// Where the rate of ends is constant, ends are a Poisson process on the scale of the total time on test, that of all lives still watched:
/// given their number they are independent and uniform, whatever the mean, and with lives that are not watched to their end. So the
/// places of each set, and of all together, are held against the uniform distribution (Anderson and Darling): where one set ends more and
/// more often and another less and less, all together may look uniform. The answer is that of the least probable places, their
/// probability times the number of tests (Bonferroni). Ends at one time, known to a look, are spread evenly over the time before them.
///
/// Source: Barlow, Campo (1975), in Reliability and Fault Tree Analysis, 451 (time on test); Anderson, Darling (1954), J. Am. Stat. Assoc.
/// 49, 765; Marsaglia, Marsaglia (2004), J. Stat. Softw. 9, 2 (its distribution).
///
/// # Errors    [`crate::Error::OutOfRange`] for a negative time
/// # Checked by  tests/all/lifetime.rs: exponential lives with and without censoring; deterministic ones, powers of time
pub fn memory(sets: &[(Vec<Stay>, f64)]) -> Result<Option<Memory>> {
    let mut tested = Vec::new();
    for (stays, delay) in sets {
        checks::argument("delay", *delay, *delay >= 0.0, "of at least 0")?;
        tested.push(on_test(stays, *delay));
    }
    if sets.len() > 1 {
        tested.push(tested.concat());
    }
    tested.retain(|places| places.len() >= LEAST);
    let tests = tested.len() as f64;
    let found = tested.into_iter().map(uniform).min_by(|a, b| a.probability.total_cmp(&b.probability));
    Ok(found.map(|found| Memory { probability: (tests * found.probability).min(1.0), ..found }))
}

/// The test that places are uniform.
fn uniform(mut places: Vec<f64>) -> Memory {
    ascending(&mut places);
    let events = places.len();
    let place = places.iter().sum::<f64>() / events as f64;
    Memory { probability: anderson_darling(&places), events, place }
}

/// The places of ends after the delay, as parts of the total time on test. Where the last life ends, that end is no place: the time on test
/// ends with it.
fn on_test(stays: &[Stay], delay: f64) -> Vec<f64> {
    let mut late: Vec<Stay> = stays.iter().copied().filter(|stay| stay.time > delay).collect();
    late.sort_by(|a, b| a.time.total_cmp(&b.time).then(b.escaped.cmp(&a.escaped)));
    let (mut total, mut before, mut places) = (0.0, delay, Vec::new());
    let mut first = 0;
    while first < late.len() {
        let time = late[first].time;
        let alike = late[first..].iter().take_while(|stay| stay.time == time).count();
        let ends = late[first..first + alike].iter().filter(|stay| stay.escaped).count();
        let passed = (time - before) * (late.len() - first) as f64;
        places.extend(
            (1..=ends).map(|k| total + passed * if ends > 1 { k as f64 / (ends + 1) as f64 } else { 1.0 }),
        );
        total += passed;
        before = time;
        first += alike;
    }
    places.iter().map(|place| place / total).filter(|place| *place < 1.0).collect()
}

/// The probability of places, sorted, as far from the uniform distribution or farther.
fn anderson_darling(places: &[f64]) -> f64 {
    let n = places.len() as f64;
    let inner = |place: f64| place.clamp(1e-12, 1.0 - 1e-12);
    let term = |(k, place): (usize, &f64)| {
        let other = inner(places[places.len() - 1 - k]);
        (2 * k + 1) as f64 * (libm::log(inner(*place)) + libm::log1p(-other))
    };
    let square = -n - places.iter().enumerate().map(term).sum::<f64>() / n;
    beyond(square)
}

/// 1 - P(A^2 < z) for many places.
fn beyond(z: f64) -> f64 {
    let polynomial = |c: &[f64]| c.iter().rev().fold(0.0, |sum, c| sum * z + c);
    if z <= 0.0 {
        return 1.0;
    }
    if z < 2.0 {
        let sum = polynomial(&[2.00012, 0.247_105, -0.064_982_1, 0.034_796_2, -0.011_672, 0.001_686_91]);
        return 1.0 - libm::exp(-1.233_714_1 / z) / z.sqrt() * sum;
    }
    let sum = polynomial(&[1.0776, -2.306_95, 0.434_24, -0.082_433, 0.008_056, -0.000_314_6]);
    -libm::expm1(-libm::exp(sum))
}
