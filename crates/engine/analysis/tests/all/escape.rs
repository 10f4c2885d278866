//! Survival curves and escape rates against a textbook's numbers and against exponential times.

use motiform_analysis::{Error, Stay, SurvivalStep, escape_limits, escape_rate, survival};
use motiform_dynamics::Normal;

fn stays(times: &[(f64, bool)]) -> Vec<Stay> {
    times.iter().map(|&(time, escaped)| Stay { time, escaped }).collect()
}

/// Weeks of remission under 6-MP: Freireich et al. (1963), Blood 21, 699; Gehan (1965), Biometrika 52, 203. The curve is
/// worked out by hand in Kleinbaum and Klein, Survival Analysis (3rd ed., 2012), ch. 2: S after 6, 7, 10, 13, 16, 22, 23
/// weeks.
#[test]
fn freireichs_trial() {
    let times = [
        (6.0, true),
        (6.0, true),
        (6.0, true),
        (6.0, false),
        (7.0, true),
        (9.0, false),
        (10.0, true),
        (10.0, false),
        (11.0, false),
        (13.0, true),
        (16.0, true),
        (17.0, false),
        (19.0, false),
        (20.0, false),
        (22.0, true),
        (23.0, true),
        (25.0, false),
        (32.0, false),
        (32.0, false),
        (34.0, false),
        (35.0, false),
    ];
    let mut shuffled = times.to_vec();
    shuffled.reverse();
    let steps = survival(&stays(&shuffled)).expect("a curve");
    let seen: Vec<(f64, usize, usize)> = steps.iter().map(|s| (s.time, s.at_risk, s.escaped)).collect();
    let want = [(6., 21, 3), (7., 17, 1), (10., 15, 1), (13., 12, 1), (16., 11, 1), (22., 7, 1), (23., 6, 1)];
    assert_eq!(seen, want);
    for (step, share) in steps.iter().zip([0.857, 0.807, 0.753, 0.690, 0.627, 0.538, 0.448]) {
        assert!((step.share - share).abs() < 5.1e-4, "{step:?}");
    }
    // after 6 weeks: S = 18/21, s^2 = 3/(21 18); S^exp(+-1.96 s/ln S) by hand
    let SurvivalStep { lower, upper, .. } = steps[0];
    assert!((lower - 0.620).abs() < 6e-4 && (upper - 0.952).abs() < 6e-4, "{lower} {upper}");
    // 9 escapes in 359 weeks of watching
    let times_sum: f64 = times.iter().map(|t| t.0).sum();
    assert_eq!(times_sum, 359.0);
    assert!(matches!(escape_rate(&stays(&times), 0.0), Err(Error::TooFew { got: 9, .. })));
}

/// Exponential times of rate 0.2 after a dead time, censored at `until`.
fn exponential(stream: u64, count: usize, dead: f64, until: f64) -> Vec<Stay> {
    let mut normal = Normal::new(1958, stream);
    let mut draw = || {
        let (x, y) = (normal.next(), normal.next());
        dead + 0.5 * (x * x + y * y) / 0.2 // half a chi-squared with two degrees of freedom is exponential
    };
    let mut stay = || draw();
    (0..count)
        .map(|_| {
            let time = stay();
            Stay { time: time.min(until), escaped: time < until }
        })
        .collect()
}

#[test]
fn the_rate_is_covered_with_and_without_censoring() {
    for (dead, until) in [(0.0, f64::MAX), (0.0, 4.0), (3.0, 8.0)] {
        let mut covered = 0.0;
        for stream in 0..2000 {
            let rate = escape_rate(&exponential(stream, 100, dead, until), dead).expect("a rate").rate;
            covered += f64::from(u8::from(rate.covers(0.2))) / 2000.0;
        }
        println!("dead time {dead}, until {until:e}: {covered}");
        // standard error of a share of 0.95: 0.5 %; three of them, and the normal interval's own 0.5 %
        assert!((0.93..=0.97).contains(&covered), "{covered}");
    }
}

#[test]
fn the_band_covers_the_survival_function() {
    let (mut covered, mut asked) = (0.0, 0.0);
    for stream in 0..2000 {
        let steps = survival(&exponential(stream, 60, 0.0, 9.0)).expect("a curve");
        for t in [2.0, 5.0, 8.0_f64] {
            let step = steps.iter().rev().find(|step| step.time <= t).expect("some escape early");
            let truth = (-0.2 * t).exp();
            covered += f64::from(u8::from((step.lower..=step.upper).contains(&truth)));
            asked += 1.0;
        }
        assert!(steps.windows(2).all(|pair| pair[1].share < pair[0].share));
        assert!(
            steps
                .iter()
                .all(|s| 0.0 <= s.lower && s.lower <= s.share && s.share <= s.upper && s.upper <= 1.0)
        );
    }
    println!("band: {}", covered / asked);
    assert!((0.93..=0.97).contains(&(covered / asked)), "{}", covered / asked);
}

#[test]
fn the_ends_of_a_curve_are_defined() {
    let all_gone = survival(&stays(&[(1.0, true), (2.0, true)])).expect("a curve");
    assert_eq!((all_gone[1].share, all_gone[1].lower), (0.0, 0.0));
    assert_eq!(all_gone[1].upper, all_gone[0].upper);
    let at_once = survival(&stays(&[(1.0, true)])).expect("a curve");
    assert_eq!((at_once[0].lower, at_once[0].upper), (0.0, 1.0));
    assert!(survival(&stays(&[(1.0, false)])).expect("a curve").is_empty());
}

/// The usual table of Poisson limits (Garwood 1936; Ulm 1990, Am. J. Epidemiol. 131, 373), four and five digits.
#[test]
fn limits_of_a_rate_are_the_published_ones() {
    for (events, lower, upper) in [
        (0, 0.0, 3.6889),
        (1, 0.0253, 5.5716),
        (2, 0.2422, 7.2247),
        (5, 1.6235, 11.6683),
        (10, 4.7954, 18.3904),
        (100, 81.364, 121.627),
    ] {
        let (seen_lower, seen_upper) = escape_limits(events, 2.0).expect("limits");
        assert!(
            (2.0 * seen_lower - lower).abs() < 6e-4 && (2.0 * seen_upper - upper).abs() < 6e-4,
            "{events}"
        );
    }
    // far out: the normal law of escape_rate, a little to the right
    let (lower, upper) = escape_limits(10_000, 1.0).expect("limits");
    assert!((lower - 9804.0).abs() < 2.0 && (upper - 10_196.0).abs() < 4.0, "{lower} {upper}");
    assert!(matches!(escape_limits(3, 0.0), Err(Error::OutOfRange { .. })));
}

#[test]
fn bad_input_is_refused() {
    assert!(matches!(survival(&[]), Err(Error::TooFew { .. })));
    assert!(matches!(survival(&stays(&[(-1.0, true)])), Err(Error::OutOfRange { .. })));
    assert!(matches!(
        survival(&stays(&[(1.0, true), (f64::NAN, true)])),
        Err(Error::NotFinite { index: 1, .. })
    ));
    assert!(matches!(escape_rate(&exponential(0, 50, 0.0, 9.0), f64::NAN), Err(Error::OutOfRange { .. })));
}
