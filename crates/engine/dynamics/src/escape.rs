//! The blow-up of a solution: the time of the singularity, from the law of growth.
//!
//! For `N(t) ~ C (t* - t)^-q` the ratio `r = N / N'` is `(t* - t) / q`: near the singularity time is a smooth function
//! of `r`, and `t*` is its value at `r = 0`, for all `C` and `q`. Four states give it by polynomial
//! extrapolation in `r` (Neville), far more accurately than the last step's time. They are taken where `r` has shrunk
//! by a fixed factor since the last one: a stiff approach takes steps much shorter than `t* - t`.

/// Number of states used for the extrapolation.
const POINTS: usize = 4;

/// A state is recorded when its ratio is below this multiple of the last recorded one.
const SPACING: f64 = 0.8;

/// Exponents from one recorded state to the next that differ by more than this part of the largest one follow
/// no law. In a stiff approach the slope of a fast variable has a large error, and the ratio is that of this
/// error.
const APART: f64 = 0.3;

/// Follows `r = N / N'` along a run, with `N` the Euclidean norm.
#[derive(Clone, Debug, Default)]
pub struct GrowthLaw {
    /// `(r, t)` of the recorded states, newest last; `count` of them.
    points: [(f64, f64); POINTS],
    count: usize,
}

/// A finite-time singularity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singularity {
    /// Blow-up time `t*`.
    pub t: f64,
    /// Exponent `q` of `|u| ~ (t* - t)^-q`.
    pub exponent: f64,
}

impl GrowthLaw {
    /// Adds a state and its slope. If the ratio grows again, the record restarts.
    pub fn observe(&mut self, t: f64, u: &[f64], slope: &[f64]) {
        let norm_squared: f64 = u.iter().map(|x| x * x).sum();
        let growth: f64 = u.iter().zip(slope).map(|(x, dx)| x * dx).sum();
        let ratio = norm_squared / growth;
        let last = self.points[..self.count].last().map_or(f64::INFINITY, |point| point.0);
        if growth <= 0.0 || !ratio.is_finite() || ratio > 1.01 * last {
            self.count = 0;
        } else if ratio <= SPACING * last {
            if self.count == POINTS {
                self.points.rotate_left(1);
                self.count -= 1;
            }
            self.points[self.count] = (ratio, t);
            self.count += 1;
        }
    }

    /// The singularity implied by the recorded states, if their growth is faster than exponential.
    ///
    /// `None` for fewer than two of them, where their exponents differ, and for exponents outside 0.05..20
    /// (slower growth shows as a ratio that hardly shrinks).
    pub fn singularity(&self) -> Option<Singularity> {
        let points = &self.points[..self.count];
        let mut exponents = points.windows(2).map(|pair| (pair[1].1 - pair[0].1) / (pair[0].0 - pair[1].0));
        let extremes = |(low, high): (f64, f64), q: f64| (low.min(q), high.max(q));
        let (low, high) = exponents.clone().fold((f64::INFINITY, 0.0), extremes);
        let exponent = exponents.next_back()?;
        let t = extrapolate_to_zero(points);
        let lawful = high - low <= APART * high;
        (lawful && (0.05..20.0).contains(&exponent) && t.is_finite()).then_some(Singularity { t, exponent })
    }
}

/// The value at `x = 0` of the polynomial through the points `(x, y)`: Neville's scheme.
fn extrapolate_to_zero(points: &[(f64, f64)]) -> f64 {
    let mut values: [f64; POINTS] = std::array::from_fn(|i| points.get(i).map_or(0.0, |point| point.1));
    for level in 1..points.len() {
        for i in 0..points.len() - level {
            let (x, y) = (points[i].0, points[i + level].0);
            values[i] = values[i + 1] + (values[i + 1] - values[i]) * y / (x - y);
        }
    }
    values[0]
}

/// Euclidean norm.
pub fn norm(u: &[f64]) -> f64 {
    u.iter().map(|x| x * x).sum::<f64>().sqrt()
}
