//! Quantiles of the distributions that intervals are made of.

/// 97.5 % quantile of the normal distribution.
const NORMAL: f64 = 1.959_963_984_540_054;

/// 97.5 % quantiles of Student's t with 1 to 6 degrees of freedom, of which the expansion knows too little (Abramowitz and Stegun 26.10).
const FEW: [f64; 6] = [12.706_205, 4.302_653, 3.182_446, 2.776_445, 2.570_582, 2.446_912];

/// 97.5 % quantile of Student's t with `freedom` degrees of freedom, to 1e-3; infinite for 0.
///
/// Source: Abramowitz and Stegun 26.7.5 (expansion in 1/freedom).
///
/// # Checked by  tests/all/quantiles.rs: tabulated values
#[must_use]
pub fn student_quantile(freedom: usize) -> f64 {
    if freedom == 0 {
        return f64::INFINITY;
    }
    if let Some(few) = FEW.get(freedom - 1) {
        return *few;
    }
    let (z, n) = (NORMAL, freedom as f64);
    let q = z * z;
    let terms = [
        (q + 1.0) / 4.0,
        ((5.0 * q + 16.0) * q + 3.0) / 96.0,
        (((3.0 * q + 19.0) * q + 17.0) * q - 15.0) / 384.0,
        ((((79.0 * q + 776.0) * q + 1482.0) * q - 1920.0) * q - 945.0) / 92160.0,
    ];
    z * terms.iter().rev().fold(0.0, |sum, term| (sum + term) / n) + z
}

/// The factor by which an error of so many degrees of freedom makes an interval of 95 % wider than a known one: [`student_quantile`] over
/// that of the normal distribution.
#[must_use]
pub fn student_factor(freedom: usize) -> f64 {
    student_quantile(freedom) / NORMAL
}

/// Quantile of chi-square: x with P(freedom/2, x/2) = `share`, by bisection of the regularised incomplete gamma function, to 1e-10.
///
/// # Units    `freedom` above 0, need not be whole; `share` between 0 and 1
/// # Checked by  tests/all/quantiles.rs: the exponential distribution (freedom 2), tabulated values
#[must_use]
pub fn chi_square_quantile(share: f64, freedom: f64) -> f64 {
    let below = |x: f64| gamma_share(0.5 * freedom, 0.5 * x) < share;
    let mut high = freedom.max(1.0);
    while below(high) && high < 1e300 {
        high *= 2.0;
    }
    let mut low = 0.0;
    while high - low > 1e-11 * high && high > 1e-300 {
        let middle = 0.5 * (low + high);
        if below(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// P(a, x) = gamma(a, x) / Gamma(a): the series below a + 1, the continued fraction above (Numerical Recipes, 6.2).
fn gamma_share(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let front = libm::exp(a * libm::log(x) - x - libm::lgamma(a));
    if x < a + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
        while term > sum * 1e-16 {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        return front * sum;
    }
    let (mut b, mut c) = (x + 1.0 - a, 1e300);
    let mut d = 1.0 / b;
    let mut fraction = d;
    for i in 1..10_000 {
        let i = f64::from(i);
        b += 2.0;
        let numerator = -i * (i - a);
        d = 1.0 / (numerator * d + b);
        c = b + numerator / c;
        fraction *= d * c;
        if (d * c - 1.0).abs() < 1e-15 {
            break;
        }
    }
    1.0 - front * fraction
}

/// 95 % interval of a share of `trials` (which need not be whole: effective ones), see [`motiform_analysis::Share`].
///
/// Source: Wilson (1927), J. Am. Stat. Assoc. 22, 209.
#[must_use]
pub fn wilson(share: f64, trials: f64) -> [f64; 2] {
    let square = NORMAL * NORMAL / trials;
    let middle = (share + 0.5 * square) / (1.0 + square);
    let half = (share * (1.0 - share) * square + 0.25 * square * square).sqrt() / (1.0 + square);
    let lower = if share <= 0.0 { 0.0 } else { middle - half };
    [lower, if share >= 1.0 { 1.0 } else { middle + half }]
}
