//! Tails of the chi-square distribution.

/// Probability that a chi-square variable with `n` degrees of freedom exceeds `x`: `Q(n/2, x/2)`.
///
/// Source: Press et al., Numerical Recipes, 3rd ed., 6.2 (series and continued fraction).
pub fn chi_square_tail(x: f64, n: usize) -> f64 {
    let (a, x) = (0.5 * n as f64, 0.5 * x);
    if n == 0 || x <= 0.0 {
        return 1.0;
    }
    let front = libm::exp(a * libm::log(x) - x - libm::lgamma(a));
    if x < a + 1.0 { 1.0 - front * series(a, x) } else { front * fraction(a, x) }
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

/// Lentz's method.
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

#[cfg(test)]
mod tests {
    use super::chi_square_tail;

    /// Exact: exp(-x/2) for 2 degrees of freedom, its Erlang sum for 22; erfc for 1.
    #[test]
    fn closed_forms() {
        for x in [0.01, 0.5, 3.0, 20.0, 90.0] {
            assert!((chi_square_tail(x, 2) / libm::exp(-0.5 * x) - 1.0).abs() < 1e-12);
            assert!((chi_square_tail(x, 1) / libm::erfc((0.5 * x).sqrt()) - 1.0).abs() < 1e-10);
            let (mut sum, mut term) = (1.0, 1.0);
            for k in 1..11 {
                term *= 0.5 * x / f64::from(k);
                sum += term;
            }
            assert!((chi_square_tail(x, 22) / (libm::exp(-0.5 * x) * sum) - 1.0).abs() < 1e-10);
        }
    }
}
