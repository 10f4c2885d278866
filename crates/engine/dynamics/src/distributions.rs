//! The distributions that intervals and tests are made of: normal, Student's, chi-square, and Wilson's interval of a share.

/// 97.5 % quantile of the normal distribution: half of a 95 % interval in standard errors.
pub const NORMAL_95: f64 = 1.959_963_984_540_054;

/// 97.5 % quantiles of Student's t with 1 to 16 degrees of freedom, of which the expansion knows too little.
///
/// Source: the closed form of its distribution for whole degrees of freedom (Abramowitz and Stegun 26.7.3-4), inverted to
/// 1e-12; `SciPy`'s `scipy.stats.t.ppf(0.975, nu)` has the same digits.
const FEW: [f64; 16] = [
    12.706_204_736_432,
    4.302_652_729_912,
    3.182_446_305_284,
    2.776_445_105_198,
    2.570_581_835_636,
    2.446_911_851_145,
    2.364_624_251_593,
    2.306_004_135_204,
    2.262_157_162_798,
    2.228_138_851_986,
    2.200_985_160_092,
    2.178_812_829_667,
    2.160_368_656_463,
    2.144_786_687_918,
    2.131_449_545_560,
    2.119_905_299_221,
];

/// 97.5 % quantile of Student's t with `freedom` degrees of freedom, to 1e-6; infinite for 0.
///
/// Source: a table below 17, and from there on Abramowitz and Stegun 26.7.5 (expansion in 1/freedom).
pub fn student_quantile(freedom: usize) -> f64 {
    if freedom == 0 {
        return f64::INFINITY;
    }
    if let Some(few) = FEW.get(freedom - 1) {
        return *few;
    }
    let (z, n) = (NORMAL_95, freedom as f64);
    let q = z * z;
    let terms = [
        (q + 1.0) / 4.0,
        ((5.0 * q + 16.0) * q + 3.0) / 96.0,
        (((3.0 * q + 19.0) * q + 17.0) * q - 15.0) / 384.0,
        ((((79.0 * q + 776.0) * q + 1482.0) * q - 1920.0) * q - 945.0) / 92160.0,
    ];
    z * terms.iter().rev().fold(0.0, |sum, term| (sum + term) / n) + z
}

/// Degrees of freedom of the spread over groups of unequal size, `(sum n)^2/sum n^2 - 1` of n terms each, rounded down: G - 1 of G equal
/// groups, and few where few groups have most of the terms.
///
/// Source: Satterthwaite (1946), Biometrics Bull. 2, 110, for terms whose number is the inverse of the variance of their mean.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a number from 0 to that of the groups"
)]
pub fn unequal_freedom(sizes: impl Iterator<Item = f64>) -> usize {
    let [sum, squares] = sizes.fold([0.0; 2], |[s, q], n| [s + n, q + n * n]);
    // equal groups have a whole number but for round-off
    if squares > 0.0 { (sum * sum / squares - 1.0 + 1e-9).max(0.0) as usize } else { 0 }
}

/// The factor by which an error of so many degrees of freedom makes an interval of 95 % wider than a known one: [`student_quantile`] over
/// that of the normal distribution.
pub fn student_factor(freedom: usize) -> f64 {
    student_quantile(freedom) / NORMAL_95
}

/// Probability that a chi-square variable with `freedom` degrees of freedom (which need not be whole) exceeds `x`:
/// `Q(freedom/2, x/2)`; 1 for no freedom.
pub fn chi_square_tail(x: f64, freedom: f64) -> f64 {
    if freedom <= 0.0 || x <= 0.0 { 1.0 } else { gamma_shares(0.5 * freedom, 0.5 * x)[1] }
}

/// Quantile of chi-square: x with P(freedom/2, x/2) = `share`, by bisection of the regularised incomplete gamma function, to 1e-10.
///
/// # Units    `freedom` above 0, need not be whole; `share` between 0 and 1
pub fn chi_square_quantile(share: f64, freedom: f64) -> f64 {
    let below = |x: f64| x <= 0.0 || gamma_shares(0.5 * freedom, 0.5 * x)[0] < share;
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

/// P(a, x) = gamma(a, x) / Gamma(a) and Q = 1 - P for x above 0, the smaller one to rounding: the series below a + 1, Lentz's continued
/// fraction above.
///
/// Source: Press et al., Numerical Recipes, 3rd ed., 6.2.
fn gamma_shares(a: f64, x: f64) -> [f64; 2] {
    let front = libm::exp(a * libm::log(x) - x - libm::lgamma(a));
    if x < a + 1.0 {
        let below = front * series(a, x);
        [below, 1.0 - below]
    } else {
        let above = front * fraction(a, x);
        [1.0 - above, above]
    }
}

fn series(a: f64, x: f64) -> f64 {
    let (mut sum, mut term, mut n) = (1.0 / a, 1.0 / a, a);
    for _ in 0..10_000 {
        n += 1.0;
        term *= x / n;
        sum += term;
        if term < 1e-16 * sum {
            break;
        }
    }
    sum
}

fn fraction(a: f64, x: f64) -> f64 {
    let tiny = 1e-300;
    let mut b = x + 1.0 - a;
    let mut c = 1.0 / tiny;
    let mut d = 1.0 / b;
    let mut value = d;
    for i in 1..10_000 {
        let k = f64::from(i);
        let numerator = -k * (k - a);
        b += 2.0;
        d = numerator * d + b;
        d = 1.0 / if d.abs() < tiny { tiny } else { d };
        c = b + numerator / c;
        c = if c.abs() < tiny { tiny } else { c };
        value *= d * c;
        if (d * c - 1.0).abs() < 1e-15 {
            break;
        }
    }
    value
}

/// 95 % interval of a share of `trials` (which need not be whole: effective ones).
///
/// (p + z^2/2n -+ z sqrt(p (1 - p)/n + z^2/4n^2)) / (1 + z^2/n),   p = share, n = trials, z = 1.96
///
/// The shares that a score test does not refuse: within 0..1, and not empty where none or all trials have the outcome.
///
/// Source: Wilson (1927), J. Am. Stat. Assoc. 22, 209.
pub fn wilson(share: f64, trials: f64) -> [f64; 2] {
    let square = NORMAL_95 * NORMAL_95 / trials;
    let middle = (share + 0.5 * square) / (1.0 + square);
    let half = (share * (1.0 - share) * square + 0.25 * square * square).sqrt() / (1.0 + square);
    let lower = if share <= 0.0 { 0.0 } else { middle - half };
    [lower, if share >= 1.0 { 1.0 } else { middle + half }]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tables: Abramowitz and Stegun 26.10; `SciPy`'s `scipy.stats.t.ppf(0.975, n)`.
    #[test]
    fn students_quantiles_are_those_of_the_tables() {
        let known = [
            (1, 12.706_204_736),
            (7, 2.364_624_251_593),
            (17, 2.109_815_577_833),
            (30, 2.042_272_456),
            (63, 1.998_340_543),
        ];
        for (freedom, exact) in known {
            assert!(
                (student_quantile(freedom) - exact).abs() < 1e-6,
                "{freedom}: {}",
                student_quantile(freedom)
            );
        }
    }

    /// With two degrees of freedom chi-square is exponential: -2 ln(1 - p). Others: Abramowitz and Stegun 26.8.
    #[test]
    fn chi_square_quantiles_are_exact() {
        for share in [0.025, 0.5, 0.975] {
            let exact = -2.0 * libm::log1p(-share);
            assert!((chi_square_quantile(share, 2.0) / exact - 1.0).abs() < 1e-9);
        }
        for (share, freedom, exact) in [
            (0.975, 10.0, 20.4832),
            (0.025, 10.0, 3.24697),
            (0.975, 100.0, 129.561),
            (0.025, 1.0, 0.000_982_069),
        ] {
            let found = chi_square_quantile(share, freedom);
            assert!((found / exact - 1.0).abs() < 1e-5, "{found} {exact}");
        }
    }

    /// Exact: exp(-x/2) for 2 degrees of freedom, its Erlang sum for 22; erfc for 1.
    #[test]
    fn chi_square_tails_have_closed_forms() {
        for x in [0.01, 0.5, 3.0, 20.0, 90.0] {
            assert!((chi_square_tail(x, 2.0) / libm::exp(-0.5 * x) - 1.0).abs() < 1e-12);
            assert!((chi_square_tail(x, 1.0) / libm::erfc((0.5 * x).sqrt()) - 1.0).abs() < 1e-10);
            let (mut sum, mut term) = (1.0, 1.0);
            for k in 1..11 {
                term *= 0.5 * x / f64::from(k);
                sum += term;
            }
            assert!((chi_square_tail(x, 22.0) / (libm::exp(-0.5 * x) * sum) - 1.0).abs() < 1e-10);
        }
    }
}
