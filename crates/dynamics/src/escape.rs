//! When a solution blows up: the time of the singularity, from the law of its growth.
//!
//! For `N(t) ~ C (t* - t)^-q` the ratio `r = N / N'` is `(t* - t) / q`: a straight line in time. Two values of it give
//! the exponent `q` and the time `t*`, whatever `C` and `q` are. Near the singularity of a polynomial field the
//! corrections are of relative order `(t* - t)^2`, so `t*` is far more accurate than the last step's time.

/// Follows `r = N / N'` along a run, with `N` the Euclidean norm.
#[derive(Clone, Debug, Default)]
pub struct GrowthLaw {
    last: Option<Point>,
    before: Option<Point>,
}

#[derive(Clone, Copy, Debug)]
struct Point {
    t: f64,
    ratio: f64,
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
    /// Takes in a state and its slope. States that do not grow reset the record.
    pub fn observe(&mut self, t: f64, u: &[f64], slope: &[f64]) {
        let norm_squared: f64 = u.iter().map(|x| x * x).sum();
        let growth: f64 = u.iter().zip(slope).map(|(x, dx)| x * dx).sum();
        let ratio = norm_squared / growth;
        if growth > 0.0 && ratio.is_finite() {
            self.before = self.last;
            self.last = Some(Point { t, ratio });
        } else {
            *self = Self::default();
        }
    }

    /// The singularity that the last two states point to, if their growth is faster than exponential.
    ///
    /// `None` for exponents outside 0.05..20 (slower growth shows as a ratio that does not shrink).
    #[must_use]
    pub fn singularity(&self) -> Option<Singularity> {
        let (last, before) = (self.last?, self.before?);
        let exponent = (last.t - before.t) / (before.ratio - last.ratio);
        let t = last.t + exponent * last.ratio;
        ((0.05..20.0).contains(&exponent) && t.is_finite()).then_some(Singularity { t, exponent })
    }
}

/// Euclidean norm.
#[must_use]
pub fn norm(u: &[f64]) -> f64 {
    u.iter().map(|x| x * x).sum::<f64>().sqrt()
}
