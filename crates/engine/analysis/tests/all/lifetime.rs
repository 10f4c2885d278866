//! Mean lives and their laws against lives drawn from known laws.

use motiform_analysis::{Error, LifeCount, LifeLaws, Stay, compare_life_laws, mean_life, memory};
use motiform_dynamics::Normal;

/// A number from the exponential law of mean 1: half a chi-square with two degrees of freedom.
fn exponential(normal: &mut Normal) -> f64 {
    let (x, y) = (normal.next(), normal.next());
    0.5 * (x * x + y * y)
}

/// Lives of mean `tau` after a dead time, watched until `until`.
fn stays(stream: u64, count: usize, tau: f64, dead: f64, until: f64) -> Vec<Stay> {
    let mut normal = Normal::new(1984, stream);
    let mut one = || dead + tau * exponential(&mut normal);
    let stay = |time: f64| Stay { time: time.min(until), escaped: time < until };
    (0..count).map(|_| stay(one())).collect()
}

/// 0 events in 100 and 2 in 1000: limits by hand from chi-square quantiles 7.3778 (2), 14.4494 and 0.4844 (6 and 4).
#[test]
fn limits_are_those_of_chi_square() {
    let stay = |time, escaped| Stay { time, escaped };
    let none = mean_life(&[stay(60.0, false), stay(60.0, false)], 10.0).expect("a life");
    assert_eq!((none.events, none.watched, none.value, none.upper), (0, 100.0, None, None));
    assert!((none.lower - 200.0 / 7.3778).abs() < 1e-3, "{none:?}");
    let two = mean_life(&[stay(5.0, true), stay(310.0, true), stay(310.0, true), stay(410.0, false)], 10.0);
    let two = two.expect("a life");
    assert_eq!((two.events, two.watched, two.early, two.value), (2, 1000.0, 1, Some(500.0)));
    assert!((two.lower - 2000.0 / 14.4494).abs() < 1e-2, "{two:?}");
    assert!((two.upper.expect("events") - 2000.0 / 0.484_42).abs() < 0.1, "{two:?}");
    let nothing = mean_life(&[stay(5.0, true)], 10.0).expect("a value");
    assert_eq!((nothing.watched, nothing.value, nothing.lower, nothing.early), (0.0, None, 0.0, 1));
    assert!(matches!(mean_life(&[stay(f64::NAN, true)], 0.0), Err(Error::NotFinite { .. })));
    assert!(mean_life(&[stay(-1.0, true)], 0.0).is_err() && mean_life(&[], -1.0).is_err());
}

#[test]
fn the_interval_covers_the_mean_life() {
    for (count, dead, until) in [(40, 0.0, f64::MAX), (40, 0.0, 2.0), (40, 3.0, 8.0), (8, 0.0, 1.0)] {
        let mut covered = 0.0;
        for stream in 0..2000 {
            let life = mean_life(&stays(stream, count, 5.0, dead, until), dead).expect("a life");
            let inside = life.lower <= 5.0 && life.upper.is_none_or(|upper| upper >= 5.0);
            covered += f64::from(u8::from(inside)) / 2000.0;
        }
        println!("{count} runs, dead time {dead}, until {until:e}: {covered}");
        assert!((0.94..=0.99).contains(&covered), "{covered}");
    }
}

/// Counts of lives of mean `tau(p)`, `count` at each value, watched until `until`.
fn counts(seed: u64, values: &[f64], count: usize, until: f64, tau: impl Fn(f64) -> f64) -> Vec<LifeCount> {
    let one = |(i, &p): (usize, &f64)| {
        let life = mean_life(&stays(100 * seed + i as u64, count, tau(p), 0.0, until), 0.0).expect("a life");
        LifeCount { parameter: p, events: life.events, watched: life.watched }
    };
    values.iter().enumerate().map(one).collect()
}

#[test]
fn a_crisis_is_recognised_and_its_place_and_exponent_are_covered() {
    let values = [1.199, 1.2005, 1.201, 1.202, 1.204, 1.208, 1.216];
    let tau = |p: f64| if p <= 1.2 { 1e15 } else { 3.0 / (p - 1.2) };
    let (mut right, mut place, mut exponent) = (0, 0, 0);
    for seed in 0..100 {
        let LifeLaws::PowerLaw { power, .. } =
            compare_life_laws(&counts(seed, &values, 64, 1e5, tau)).expect("an answer")
        else {
            continue;
        };
        right += 1;
        let inside = power.critical.lower.is_none_or(|low| low <= 1.2)
            && power.critical.upper.is_some_and(|high| high >= 1.2);
        place += usize::from(inside);
        exponent += usize::from(power.exponent.covers(1.0));
        assert!(power.above && power.life(1.199).is_infinite() && !power.critical.at_end);
    }
    println!("{right} of 100 recognised; place {place}, exponent {exponent}");
    assert!(right >= 97 && place >= 88 && exponent >= 85, "{right} {place} {exponent}");
}

/// The mirror image: transient below the crisis.
#[test]
fn a_crisis_may_lie_above() {
    let values = [0.2, 0.3, 0.36, 0.38, 0.39, 0.395];
    let found =
        compare_life_laws(&counts(3, &values, 300, 1e9, |p| 10.0 * (0.4 - p).powf(-1.5))).expect("an answer");
    let LifeLaws::PowerLaw { power, .. } = &found else { panic!("{}", found.words()) };
    assert!(
        !power.above && power.exponent.covers(1.5) && (power.critical.value - 0.4).abs() < 5e-3,
        "{}",
        found.words()
    );
}

#[test]
fn lives_without_a_crisis_are_recognised_where_they_change_much() {
    let values = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0];
    let (mut right, mut covered) = (0, 0);
    for seed in 0..40 {
        let found = compare_life_laws(&counts(seed, &values, 400, 1e9, |p| 1e3 * (6.0 * p).exp()))
            .expect("an answer");
        right += usize::from(matches!(found, LifeLaws::Exponential { .. }));
        let (exponential, power) = found.fits().expect("fits");
        assert!(
            power.critical.at_end && power.exponent.error.is_infinite(),
            "a crisis as far away as can be: {power:?}"
        );
        covered += usize::from(exponential.k.covers(-6.0));
        assert!(!matches!(found, LifeLaws::PowerLaw { .. }), "{}", found.words());
    }
    println!("{right} of 40 recognised; k covered {covered}");
    assert!(right >= 36 && covered >= 34, "{right} {covered}");
}

#[test]
fn what_the_data_cannot_decide_is_left_open() {
    let values = [0.36, 0.38, 0.40, 0.42, 0.44, 0.46];
    let found = compare_life_laws(&counts(1, &values, 40, 1e9, |p| 4e4 * (30.0 * (p - 0.36)).exp()))
        .expect("an answer");
    assert!(matches!(found, LifeLaws::CannotBeToldApart { .. }), "{}", found.words());
    assert!(found.words().starts_with("the laws cannot be told apart"));
    let few = compare_life_laws(&counts(1, &values, 2, 1e4, |_| 4e4)).expect("an answer");
    assert!(matches!(few, LifeLaws::TooFew { values: 6, .. }) && few.fits().is_none(), "{}", few.words());
    assert!(matches!(compare_life_laws(&[]).expect("an answer"), LifeLaws::TooFew { events: 0, .. }));
}

#[test]
fn a_law_that_is_neither_is_refused() {
    let values = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0];
    let bump = |p: f64| 1e3 * (-8.0 * (p - 0.5) * (p - 0.5)).exp();
    let found = compare_life_laws(&counts(1, &values, 400, 1e9, bump)).expect("an answer");
    assert!(matches!(found, LifeLaws::Neither { .. }), "{}", found.words());
    let bad = LifeCount { parameter: f64::NAN, events: 1, watched: 1.0 };
    assert!(compare_life_laws(&[bad]).is_err());
}

/// Lives after a delay of 1 as functions of a uniform number, watched until 20: the number of 200 data sets in which they are not
/// exponential at 5 %.
fn refused(life: impl Fn(f64, f64) -> f64) -> usize {
    let of = |seed: u64| {
        let mut normal = Normal::new(seed, 7);
        let mut set = |mean: f64| {
            let stay = |u: f64| {
                let time = 1.0 + life(u, mean);
                Stay { time: time.min(20.0), escaped: time < 20.0 }
            };
            let uniform = |x: f64| 0.5 * libm::erfc(x / std::f64::consts::SQRT_2);
            ((0..20).map(|_| stay(uniform(normal.next()))).collect::<Vec<_>>(), 1.0)
        };
        let sets = [2.0, 5.0, 10.0, 30.0].map(&mut set);
        memory(&sets).expect("sound").expect("enough").probability
    };
    (0..200).filter(|&seed| of(seed) < 0.05).count()
}

#[test]
fn lives_with_a_memory_are_told_from_exponential_ones() {
    let exponential = refused(|u, mean| -mean * u.ln());
    let looks = refused(|u, mean| 0.1 * ((-10.0 * mean * u.ln()).floor() + 0.5));
    let passage = refused(|u, mean| mean * (1.0 + 0.05 * u));
    let power = refused(|u, mean| 0.1 * mean / u);
    println!("{exponential} {looks} {passage} {power} of 200");
    assert!((1..=22).contains(&exponential) && looks <= 22, "{exponential} {looks}"); // 10, and three standard deviations
    assert!(passage == 200 && power >= 180, "{passage} {power}");
    let few = vec![Stay { time: 2.0, escaped: true }; 5];
    assert_eq!(memory(&[(few, 1.0)]).expect("sound"), None);
}

/// Quantiles of Weibull's laws of the shapes 2 and 2/3: lives that end more and more often, and less and less often. The places of both
/// sets together have p = 0.19.
#[test]
fn opposite_memories_do_not_cancel() {
    let set = |power: f64| {
        let time = |k: u32| (-((f64::from(k) + 0.5) / 60.0).ln()).powf(power);
        ((0..60).map(|k| Stay { time: time(k), escaped: true }).collect::<Vec<_>>(), 0.0)
    };
    let found = memory(&[set(0.5), set(1.5)]).expect("sound").expect("enough");
    assert!(found.probability < 1e-15 && found.events == 59 && found.place > 0.6, "{found:?}");
}

#[test]
fn no_crisis_of_lives_that_are_not_exponential() {
    let values = [1.199, 1.2005, 1.201, 1.202, 1.204, 1.208, 1.216];
    let tau = |p: f64| if p <= 1.2 { 1e15 } else { 3.0 / (p - 1.2) };
    let laws = compare_life_laws(&counts(1, &values, 64, 1e5, tau)).expect("an answer");
    let alike: Vec<Stay> =
        (0..40).map(|k| Stay { time: 10.0 + 0.01 * f64::from(k), escaped: true }).collect();
    let found = laws.clone().held_against(memory(&[(alike, 1.0)]).expect("sound"));
    assert!(found.words().starts_with("none: the lives are not exponential (p = ") && found.fits().is_none());
    assert_eq!(laws.clone().held_against(None), laws);
}
