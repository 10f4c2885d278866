//! The jackknife of a mean.

use motiform_dynamics::distributions::{student_quantile, unequal_freedom};
use motiform_statistics::jackknife;

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

/// Equal groups, whatever their size, have one less than their number; one long record among many short ones counts for little more than 1.
#[test]
fn unequal_groups_have_fewer_degrees_of_freedom() {
    for groups in 1..=64_u32 {
        for size in [0.1, 1.0 / 3.0, 7.0] {
            assert_eq!(unequal_freedom((0..groups).map(|_| size)), groups as usize - 1);
        }
    }
    assert_eq!(unequal_freedom([1000.0, 1.0, 1.0, 1.0].into_iter()), 0);
    assert_eq!(unequal_freedom(std::iter::empty()), 0);
}
