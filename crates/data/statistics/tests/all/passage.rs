//! First-passage and residence times.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{agrees, along, holds, known, many, ornstein_uhlenbeck};
use motiform_dynamics::Normal;
use motiform_statistics::{Duration, Quantity, Track, Tracks, first_passages, mean_time, residence};

/// Brownian motion, exactly, `d` per component.
fn brownian(d: f64, dt: f64, samples: usize, normal: &mut Normal) -> Track {
    let mut x = [0.0; 2];
    let mut track = Track::default();
    for _ in 0..samples {
        track.position.push(x);
        track.velocity.push([1.0, 0.0]);
        x = x.map(|x| x + (2.0 * d * dt).sqrt() * normal.next());
    }
    track
}

/// The mean time to leave a disc is r^2/(4 D); seen every dt, that of a disc larger by 0.5826 sqrt(2 D dt).
#[test]
fn brownian_motion_leaves_a_disc_after_r_squared_over_four_d() {
    let (d, dt): (f64, f64) = (0.5, 1e-3);
    let tracks = many(dt, 200, |normal| brownian(d, dt, 10_000, normal), 1);
    let found = first_passages(&tracks, &[0.5, 1.0, 2.0]);
    for passage in &found {
        let seen = passage.radius + 0.5826 * (2.0 * d * dt).sqrt();
        let exact = seen * seen / (4.0 * d);
        let mean = known(&passage.time.mean);
        assert!(agrees(mean, exact, 1.6), "{passage:?} {exact}");
        let free = passage.radius * passage.radius / (4.0 * d);
        assert!((mean.value / free - 1.0).abs() < 0.12, "{} {free}", mean.value);
    }
    assert!(found[0].time.censored < 0.02 && found[2].time.censored > 0.1, "{found:?}");
}

#[test]
fn straight_motion_leaves_after_r_over_v() {
    let line = |t: f64| ([0.3 * t, 0.4 * t], [0.3, 0.4]);
    let tracks = Tracks::new(0.1, vec![], vec![along(0.1, 4000, line)]).unwrap();
    let found = first_passages(&tracks, &[0.11, 1.0, 100.0]);
    assert!((known(&found[0].time.mean).value - 0.22).abs() < 1e-12);
    assert!((known(&found[1].time.mean).value - 2.0).abs() < 1e-12);
    assert!(found[2].time.censored == 1.0 && found[2].time.mean.reason().unwrap().starts_with("not reached"));
}

/// Exponential durations of which 40 % are cut off at random: the mean is as if all were seen.
#[test]
fn censored_durations_have_the_mean_of_all() {
    let (mean, sets) = (3.0, 200);
    let mut held = 0;
    for seed in 0..sets {
        let mut normal = Normal::new(seed, 5);
        let mut exponential = |mean: f64| 0.5 * mean * (normal.next().powi(2) + normal.next().powi(2));
        let durations: Vec<Duration> = (0..640)
            .map(|k| {
                let (time, cut) = (exponential(mean), exponential(1.5 * mean));
                Duration { time: time.min(cut), ended: time <= cut, group: k % 64 }
            })
            .collect();
        let found = mean_time(&durations, 64).unwrap();
        held += usize::from(holds(known(&found.mean), mean));
        assert!((found.censored - 0.4).abs() < 0.1, "{found:?}");
    }
    assert!(held >= 181, "{held} of {sets}"); // as in coverage.rs
}

/// Of points of a circle that are watched from its rim inwards, 30 % never leave: no mean, whatever the time watched.
#[test]
fn what_never_ends_has_no_mean() {
    for watched in [500.0, 4000.0] {
        let durations: Vec<Duration> = (0..640)
            .map(|k| {
                let (start, leaves) = (watched * f64::from(k % 64) / 64.0, k % 10 < 7);
                let (time, left) = (0.01 * f64::from(k), watched - start);
                Duration {
                    time: if leaves { time.min(left) } else { left },
                    ended: leaves && time <= left,
                    group: k as usize % 8,
                }
            })
            .collect();
        let found = mean_time(&durations, 8).unwrap();
        assert!(found.mean.reason().unwrap().starts_with("ends become rarer"), "{found:?}");
    }
}

/// 5 and an exponential time, of 97 % with the mean 1 and of 3 % with 10/3: the rate of ends falls, and all end.
#[test]
fn a_rate_that_falls_among_the_last_ends_leaves_the_mean_known() {
    let exact = 5.0 + 0.97 + 0.1;
    let mut held = 0;
    for seed in 0..20 {
        let mut normal = Normal::new(77, seed);
        let durations: Vec<Duration> = (0..20_000)
            .map(|k| {
                let half = if k % 100 < 3 { 5.0 / 3.0 } else { 0.5 };
                let time = 5.0 + half * (normal.next().powi(2) + normal.next().powi(2));
                Duration { time: time.min(16.0), ended: time < 16.0, group: k % 40 }
            })
            .collect();
        let found = mean_time(&durations, 40).unwrap();
        assert!(found.censored > 0.0, "{found:?}");
        held += usize::from(holds(known(&found.mean), exact));
    }
    assert!(held >= 17, "{held} of 20");
}

#[test]
fn durations_that_are_all_seen_have_their_plain_mean() {
    let times = [1.0, 5.0, 2.0, 2.0];
    let seen = times.map(|time| Duration { time, ended: true, group: 0 });
    let found = mean_time(&seen, 1).unwrap();
    assert!((known(&found.mean).value - 2.5).abs() < 1e-14 && found.beyond == 0.0 && found.censored == 0.0);
    let unseen = times.map(|time| Duration { time, ended: false, group: 0 });
    assert!(mean_time(&unseen, 1).unwrap().mean.known().is_none());
    assert_eq!(mean_time(&[], 1), None);
}

/// |v| = 1 + sin(t)/2 is above 1 for pi of every 2 pi, above 1.25 for 2 pi/3.
#[test]
fn a_sine_stays_half_its_period_above_its_mean() {
    let pi = std::f64::consts::PI;
    let sine = |t: f64| ([t, 0.0], [1.0 + 0.5 * (t + 1.0).sin(), 0.0]);
    let tracks = Tracks::new(0.01, vec![], vec![along(0.01, 160_000, sine)]).unwrap();
    for (threshold, above) in [(Some(1.0), pi), (Some(1.25), 2.0 * pi / 3.0), (None, pi)] {
        let found = residence(&tracks, &Quantity::Speed, threshold);
        let [up, down] =
            [&found.above, &found.below].map(|side| known(&side.time.as_ref().unwrap().mean).value);
        assert!((up - above).abs() < 0.01 && (down - (2.0 * pi - above)).abs() < 0.01, "{found:?}");
        assert!((found.above.share - above / (2.0 * pi)).abs() < 0.01);
    }
    assert_eq!(residence(&tracks, &Quantity::Speed, Some(9.0)).above.time, None);
}

/// The same with its rates: stays of a deterministic motion do not depend on the time between samples, until four samples a period.
#[test]
fn stays_do_not_depend_on_the_time_between_samples() {
    let found = |dt: f64| {
        let body = |k: u32| {
            let phase = |t: f64| t + 0.7 * f64::from(k);
            let sine = |t: f64| ([t, 0.0], [1.0 + 0.5 * phase(t).sin(), 0.0]);
            let samples = (1600.0 / dt) as usize;
            let rate = (0..samples).map(|j| [0.5 * phase(j as f64 * dt).cos(), 0.0]).collect();
            Track { rates: vec![rate], ..along(dt, samples, sine) }
        };
        let tracks = Tracks::new(dt, vec![], (0..9).map(body).collect()).unwrap().with_noise(false);
        let found = residence(&tracks, &Quantity::Speed, Some(1.25));
        assert!(found.seen_every.is_none());
        [found.above, found.below].map(|side| side.time.unwrap().mean)
    };
    let exact = [1.0, 2.0].map(|part| part * std::f64::consts::TAU / 3.0);
    for dt in [0.01, 0.1, 0.5, 1.0, 1.4] {
        for (mean, exact) in found(dt).iter().zip(exact) {
            let off = (known(mean).value / exact - 1.0).abs(); // the cubic is off by x^4/384 of the amplitude
            assert!(off < 0.002 + 0.02 * dt.powi(4), "{dt}: {off}");
        }
    }
    for dt in [1.7, 3.1, 6.2, 6.4] {
        assert!(
            found(dt).iter().all(|mean| mean.reason().is_some_and(|why| why.contains("too coarsely"))),
            "{dt}"
        );
    }
}

/// Under noise rates do not give the changes between samples: stays are those of lines, with and without rates.
#[test]
fn noise_is_no_cubic() {
    let body = |k: u64| {
        let mut track = ornstein_uhlenbeck(0.5, 1.0, 0.1, 2000, &mut Normal::new(9, k));
        track.rates = vec![track.velocity.iter().map(|v| v.map(|x| -0.5 * x)).collect()];
        track
    };
    let bodies: Vec<Track> = (0..9).map(body).collect();
    let plain = bodies.iter().map(|track| Track { rates: Vec::new(), ..track.clone() }).collect();
    let [with, without] = [bodies, plain].map(|bodies| {
        let tracks = Tracks::new(0.1, vec![], bodies).unwrap().with_noise(true);
        residence(&tracks, &Quantity::Speed, Some(1.2))
    });
    assert!(with.above.time.is_some() && with.seen_every == Some(0.1) && with == without);
}
