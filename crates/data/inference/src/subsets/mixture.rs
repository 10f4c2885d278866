//! Numbers over all sets of terms that the data do not tell apart.

use super::{Conditional, Subset, Subsets};
use crate::Fit;
use crate::between::{DIFFER, differ};
use nalgebra::{DMatrix, DVector};

/// A number over the tied sets: of each its weight, and mean and standard deviation of its normal distribution.
#[derive(Clone, Debug)]
pub(crate) struct Mixture(Vec<[f64; 3]>);

impl Mixture {
    /// The mixture of these parts, with weights that need not sum to 1.
    pub(crate) fn new(mut parts: Vec<[f64; 3]>) -> Self {
        let all: f64 = parts.iter().map(|part| part[0]).sum();
        parts.iter_mut().for_each(|part| part[0] /= all);
        Self(parts)
    }

    /// Its mean.
    pub(crate) fn mean(&self) -> f64 {
        self.0.iter().map(|[w, m, _]| w * m).sum()
    }

    /// Its standard deviation: within the sets and between them.
    pub(crate) fn deviation(&self) -> f64 {
        let mean = self.mean();
        self.0.iter().map(|[w, m, s]| w * (s * s + (m - mean) * (m - mean))).sum::<f64>().sqrt()
    }

    /// Its 2.5 % and 97.5 % quantiles.
    pub(crate) fn interval(&self) -> [f64; 2] {
        [0.025, 0.975].map(|share| self.quantile(share))
    }

    /// A quantile, by bisection.
    fn quantile(&self, share: f64) -> f64 {
        let below = |x: f64| -> f64 {
            let normal = |[w, m, s]: &[f64; 3]| {
                let step = if x >= *m { 1.0 } else { 0.0 };
                w * if *s > 0.0 { 0.5 * libm::erfc((m - x) / (s * std::f64::consts::SQRT_2)) } else { step }
            };
            self.0.iter().map(normal).sum()
        };
        let end =
            |sign: f64| self.0.iter().map(|[_, m, s]| sign * m + 10.0 * s).fold(f64::NEG_INFINITY, f64::max);
        let (mut low, mut high) = (-end(-1.0), end(1.0));
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if below(middle) < share { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }
}

/// The robust covariance of all terms, and that between cells, for sets of them.
pub(crate) struct Scatter {
    robust: Option<DMatrix<f64>>,
    /// Also the number of cells, and the factor for few of them.
    cells: Option<(DMatrix<f64>, usize, f64)>,
}

impl Scatter {
    /// `C^-1 R C^-1` of the expected covariance C and each robust one R; none where C has no inverse.
    pub(crate) fn of(whole: &Fit) -> Self {
        let n = whole.coefficients.len();
        let inverse = whole.covariance().try_inverse();
        let within = |rows: &[Vec<f64>]| {
            let inner = DMatrix::from_fn(n, n, |i, j| rows[i][j]);
            inverse.as_ref().map(|inverse| inverse * inner * inverse)
        };
        let cells = whole.natural.cells.as_ref();
        Self {
            robust: within(&whole.natural.robust),
            cells: cells.and_then(|all| Some((within(&all.covariance)?, all.cells, all.factor))),
        }
    }

    /// The robust standard error of a number of a set, from `D g`: the expected covariance D of the set, and the gradient g. The estimates
    /// of the set are `D C^-1` times those of all terms, so their robust covariance is `D C^-1 R C^-1 D`. 0 where it is not known. Of
    /// several cells, that between them where it is larger. `expected` is the variance by D.
    pub(crate) fn error(&self, carried: &DVector<f64>, expected: f64) -> f64 {
        let variance = |scatter: &DMatrix<f64>| carried.dot(&(scatter * carried)).max(0.0);
        let robust = self.robust.as_ref().map_or(0.0, variance);
        let between = self.cells.as_ref().map_or(0.0, |(scatter, cells, factor)| {
            let between = variance(scatter);
            let differ = differ(between, robust.max(expected), *cells) < DIFFER;
            between.sqrt() * if differ { *factor } else { 1.0 }
        });
        robust.sqrt().max(between)
    }
}

/// A value of every tied set, with the weight `exp(-excess/2)`: the best set has 1.
///
/// The value of a set follows from the estimates and errors that it has from the fit with all terms, the others set to 0 (no set is
/// fitted again). Of a set that lacks coefficients which the value needs, it is taken with these added.
pub(crate) fn over_sets<T>(
    whole: &Fit,
    subsets: &Subsets,
    needed: &[usize],
    value: impl Fn(&Conditional) -> T,
) -> Vec<(f64, T)> {
    let full = Conditional::new(&whole.natural.coefficients, whole.covariance());
    let of_set = |set: &Subset| {
        let dropped = |i: &usize| !set.kept.contains(i) && !needed.contains(i);
        let own = full.without((0..whole.coefficients.len()).filter(dropped));
        (libm::exp(-0.5 * set.excess), value(&own))
    };
    subsets.ties.iter().map(of_set).collect()
}
