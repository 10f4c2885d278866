//! Shares with Wilson's interval.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_analysis::Share;

/// Newcombe (1998), Statist. Med. 17, 857, table I, method 3 (score, without continuity correction): four digits.
#[test]
fn intervals_are_the_published_ones() {
    for (count, of, lower, upper) in
        [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)]
    {
        let seen = Share::new(count, of).unwrap();
        assert!((seen.lower - lower).abs() < 5e-5 && (seen.upper - upper).abs() < 5e-5, "{seen:?}");
        let rest = Share::new(of - count, of).unwrap();
        assert!(
            (seen.lower + rest.upper - 1.0).abs() < 1e-15 && (seen.value + rest.value - 1.0).abs() < 1e-15
        );
    }
}

#[test]
fn the_ends_of_the_interval_are_shares() {
    for of in 1..50 {
        for count in 0..=of {
            let Share { value, lower, upper, .. } = Share::new(count, of).unwrap();
            assert!(0.0 <= lower && lower <= value && value <= upper && upper <= 1.0 && lower < upper);
        }
    }
    assert_eq!((Share::new(0, 0), Share::new(3, 2)), (None, None));
}
