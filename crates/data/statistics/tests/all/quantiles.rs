//! Quantiles against tabulated values and exact cases; the jackknife of a mean.

use motiform_analysis::Share;
use motiform_statistics::{chi_square_quantile, jackknife, student_quantile, wilson};

/// Tables: Abramowitz and Stegun 26.10; `SciPy`'s scipy.stats.t.ppf(0.975, n).
#[test]
fn students_quantiles_are_those_of_the_tables() {
    for (freedom, exact) in [
        (1, 12.706_204_7),
        (2, 4.302_652_7),
        (6, 2.446_911_9),
        (7, 2.364_624_251_593),
        (15, 2.131_449_545_560),
        (30, 2.042_272_456),
        (63, 1.998_340_543),
    ] {
        assert!((student_quantile(freedom) - exact).abs() < 1e-3, "{freedom}: {}", student_quantile(freedom));
    }
}

/// With two degrees of freedom chi-square is exponential: -2 ln(1 - p). Others: Abramowitz and Stegun 26.8.
#[test]
fn chi_square_quantiles_are_exact() {
    for share in [0.025, 0.5, 0.975] {
        let exact = -2.0 * libm::log1p(-share);
        assert!((chi_square_quantile(share, 2.0) / exact - 1.0).abs() < 1e-9);
    }
    for (share, freedom, exact) in
        [(0.975, 10.0, 20.4832), (0.025, 10.0, 3.24697), (0.975, 100.0, 129.561), (0.025, 1.0, 0.000_982_069)]
    {
        let found = chi_square_quantile(share, freedom);
        assert!((found / exact - 1.0).abs() < 1e-5, "{found} {exact}");
    }
}

#[test]
fn whole_trials_give_the_interval_of_a_share() -> Result<(), &'static str> {
    for (count, of) in [(0, 9), (3, 9), (9, 9), (20, 400)] {
        let share = Share::new(count, of).ok_or("a share")?;
        let [lower, upper] = wilson(share.value, f64::from(u32::try_from(of).map_err(|_| "few")?));
        assert!((lower - share.lower).abs() < 1e-15 && (upper - share.upper).abs() < 1e-15);
    }
    Ok(())
}

/// Of a mean, the jackknife's error is the usual standard error; fewer than 8 groups have none.
#[test]
fn the_jackknife_of_a_mean_is_its_standard_error() {
    let x = [1.0, 4.0, 2.0, 8.0, 5.0, 7.0, 3.0, 6.0];
    let mean = x.iter().sum::<f64>() / 8.0;
    let without = x.map(|left_out| (8.0 * mean - left_out) / 7.0);
    let variance = x.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 7.0;
    let exact = student_quantile(7) * (variance / 8.0).sqrt();
    assert!((jackknife(mean, &without).half_width() - exact).abs() < 1e-14);
    assert!(jackknife(mean, &without[1..]).interval.is_none());
}
