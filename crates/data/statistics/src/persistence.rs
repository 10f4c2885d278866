//! The persistent random walk: persistence time, speed and diffusion coefficient from the mean-square displacement.

use crate::jackknife::jackknife_ratio;
use crate::{Answer, MeanSquare, four_digits};
use serde::Serialize;

/// Relative accuracy beyond which no point of the curve counts more than the others: the form itself is not more accurate.
const FLOOR: f64 = 0.02;

/// Longest lags, in persistence times, from which on the walk is seen to diffuse, and its persistence time is seen at all.
const REACHED: (f64, f64) = (5.0, 2.0);

/// A relative deviation (root mean square over the lags) from which on the form does not describe the curve, unless errors are as large.
const MISFIT: f64 = 0.05;

/// Points of the first search, per decade.
const SEARCH: f64 = 10.0;

/// The persistent random walk that was fitted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Walk {
    /// Persistence time P.
    pub persistence: Answer,
    /// Speed S.
    pub speed: Answer,
    /// Diffusion coefficient D = S^2 P/2.
    pub diffusion: Answer,
    /// S^2 and P of the fitted curve, for drawing; `None` where nothing moved.
    pub curve: Option<[f64; 2]>,
    /// Root mean square of the relative deviation of the curve from the form.
    pub deviation: f64,
}

/// `2 S^2 P (t - P (1 - e^{-t/P}))`: the mean-square displacement of a persistent random walk in the plane.
///
/// S^2 t^2 for t far below P (ballistic), 4 D t with D = S^2 P/2 far above (diffusive); equal to that of an active Brownian particle with
/// P = 1/Dr, and of an Ornstein-Uhlenbeck velocity with S^2 = <v^2>.
///
/// Source: Fuerth (1920), Z. Phys. 2, 244.
pub fn furth(square: f64, persistence: f64, t: f64) -> f64 {
    let x = t / persistence;
    // x - 1 + e^-x, without cancellation where x is small
    let rise = if x < 0.02 {
        x * x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x / 720.0))))
    } else {
        x + libm::expm1(-x)
    };
    2.0 * square * persistence * persistence * rise
}

/// Fits [`furth`] to the curve: least squares of relative deviations, each point weighted by `1/(e^2 + 0.02^2)` with its relative error e.
///
/// S^2 follows from P linearly; P is searched between a tenth of the shortest and 100 times the longest lag.
/// Intervals: by leaving out groups of units and fitting again, on logarithms. Not known are P and S where
/// the shortest lag exceeds 2 P (no ballistic part), P where the longest lag is below 2 P, D where it is
/// below 5 P (diffusion is not reached), and all three where the form does not describe the curve: a
/// deviation (root mean square) above 5 % and twice the errors.
///
/// # Checked by  tests/all/displacement.rs: exact processes; tests/all/coverage.rs: intervals over 200 data sets
pub fn persistent_walk(curve: &MeanSquare) -> Walk {
    let places = with_errors(curve);
    let points: Vec<[f64; 3]> = places.iter().map(|&place| point(curve, place)).collect();
    if points.is_empty() || points.iter().any(|point| point[1] <= 0.0) {
        return Walk::unknown("nothing moved within the shortest lag");
    }
    let [square, persistence] = fit(&points);
    let deviation = deviation(&points, [square, persistence]);
    let errors = (points.iter().map(|p| p[2] * p[2]).sum::<f64>() / points.len() as f64).sqrt();
    let mut walk = Walk { curve: Some([square, persistence]), deviation, ..Walk::unknown("") };
    if deviation > MISFIT.max(2.0 * errors) {
        let reason = format!(
            "a persistent random walk does not describe the displacements (they deviate by {:.0} %)",
            100.0 * deviation
        );
        return Walk { curve: walk.curve, deviation, ..Walk::unknown(&reason) };
    }
    let without: Vec<[f64; 2]> =
        (0..curve.groups()).map(|group| fit(&left_out(curve, &places, &points, group))).collect();
    let answer = |of: fn([f64; 2]) -> f64| {
        let values: Vec<f64> = without.iter().map(|&fit| of(fit)).collect();
        Answer::Known(jackknife_ratio(of([square, persistence]), &values))
    };
    let (first, last) = (points[0][0], points[points.len() - 1][0]);
    walk.persistence = answer(|fit| fit[1]);
    walk.speed = answer(|fit| fit[0].sqrt());
    walk.diffusion = answer(|fit| 0.5 * fit[0] * fit[1]);
    walk.limit(persistence, first, last);
    walk
}

impl Walk {
    /// No numbers, for this reason.
    pub fn unknown(reason: &str) -> Self {
        let unknown = || Answer::unknown(reason);
        Self { persistence: unknown(), speed: unknown(), diffusion: unknown(), curve: None, deviation: 0.0 }
    }

    /// Takes back what the lags do not reach.
    fn limit(&mut self, persistence: f64, first: f64, last: f64) {
        let reached = four_digits(last / persistence);
        if first > 2.0 * persistence {
            let reason = "not resolved: the motion turns within the shortest lag; record more often";
            self.persistence = Answer::unknown(reason);
            self.speed = Answer::unknown(reason);
        }
        let (diffusive, seen) = REACHED;
        if last < diffusive * persistence {
            self.diffusion = Answer::unknown(format!(
                "not reached: the longest lag is that of {reached} persistence times, and {diffusive} are needed; record longer"
            ));
        }
        if last < seen * persistence {
            self.persistence = Answer::unknown(
                "not reached: the motion is still ballistic at the longest lag; record longer",
            );
        }
    }
}

/// The places whose errors are known, or all where none are: late lags of few long tracks among short ones have none.
fn with_errors(curve: &MeanSquare) -> Vec<usize> {
    let known: Vec<usize> =
        (0..curve.len()).filter(|&place| curve.measured(place).interval.is_some()).collect();
    if known.is_empty() { (0..curve.len()).collect() } else { known }
}

/// Lag, value and relative standard error of a place.
fn point(curve: &MeanSquare, place: usize) -> [f64; 3] {
    let measured = curve.measured(place);
    [curve.lag(place), measured.value, 0.5 * measured.half_width() / measured.value]
}

/// The same with the values without a group.
fn left_out(curve: &MeanSquare, places: &[usize], points: &[[f64; 3]], group: usize) -> Vec<[f64; 3]> {
    let value = |(&place, point): (&usize, &[f64; 3])| [point[0], curve.value(place, Some(group)), point[2]];
    places.iter().zip(points).map(value).collect()
}

/// S^2 and P of the best curve.
fn fit(points: &[[f64; 3]]) -> [f64; 2] {
    let ends = (0.1 * points[0][0], 100.0 * points[points.len() - 1][0]);
    let [low, high] = [libm::log(ends.0), libm::log(ends.1)];
    let count = ((high - low) / std::f64::consts::LN_10 * SEARCH).ceil().max(2.0);
    let at = |k: f64| low + (high - low) * k / count;
    let cost = |logarithm: f64| scaled(points, libm::exp(logarithm))[1];
    let best = (0..=count as usize)
        .map(|k| k as f64)
        .min_by(|a, b| cost(at(*a)).total_cmp(&cost(at(*b))))
        .unwrap_or(0.0);
    let persistence = libm::exp(least(at(best - 1.0).max(low), at(best + 1.0).min(high), cost));
    [scaled(points, persistence)[0], persistence]
}

/// S^2 for this P, and the weighted sum of squared relative deviations.
fn scaled(points: &[[f64; 3]], persistence: f64) -> [f64; 2] {
    let mut sums = [0.0; 3];
    for [t, value, error] in points {
        let form = furth(1.0, persistence, *t) / value;
        let weight = 1.0 / (error * error + FLOOR * FLOOR);
        sums[0] += weight;
        sums[1] += weight * form;
        sums[2] += weight * form * form;
    }
    [sums[1] / sums[2], sums[0] - sums[1] * sums[1] / sums[2]]
}

/// Root mean square of `curve/form - 1`.
fn deviation(points: &[[f64; 3]], [square, persistence]: [f64; 2]) -> f64 {
    let squares = points.iter().map(|[t, value, _]| {
        let off = value / furth(square, persistence, *t) - 1.0;
        off * off
    });
    (squares.sum::<f64>() / points.len() as f64).sqrt()
}

/// The place of the minimum of a function with one minimum, by golden sections, to 1e-9.
fn least(mut low: f64, mut high: f64, cost: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    while high - low > 1e-9 {
        let (a, b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        if cost(a) <= cost(b) { high = b } else { low = a }
    }
    0.5 * (low + high)
}
