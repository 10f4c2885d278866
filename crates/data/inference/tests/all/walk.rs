//! Persistent random walks: the likelihood against its definition, and intervals of walks with gaps and errors.

use crate::samples::draws;
use motiform_dynamics::Normal;
use motiform_inference::{Fix, Misfit, PersistentWalk, persistent_walk, walk_likelihood};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// A walk of persistence time P and speed S at times `k dt`, by the exact transition in steps of `dt`; each
/// place is seen with an error, and with the probability `seen`.
pub(crate) fn walk(
    [persistence, speed, error]: [f64; 3],
    (dt, frames): (f64, u32),
    seen: f64,
    seed: u64,
) -> Vec<Fix> {
    let mut normal = Normal::new(seed, 0);
    let a = libm::exp(-dt / persistence);
    let variance = 0.5 * speed * speed;
    let q = |part: f64| variance * part;
    let h = dt / persistence;
    let xx = q(persistence * persistence * (2.0 * h - 3.0 + 4.0 * a - a * a));
    let (xv, vv) = (q(persistence * (1.0 - a) * (1.0 - a)), q(1.0 - a * a));
    let (mut x, mut v) = ([0.0; 2], [variance.sqrt() * normal.next(), variance.sqrt() * normal.next()]);
    let mut fixes = Vec::new();
    for frame in 0..frames {
        if normal.uniform() < seen {
            let at = [x[0] + error * normal.next(), x[1] + error * normal.next()];
            fixes.push(Fix { t: dt * f64::from(frame), at });
        }
        for k in 0..2 {
            let (one, two) = (normal.next(), normal.next());
            let root = xx.max(0.0).sqrt();
            x[k] += persistence * (1.0 - a) * v[k] + root * one;
            v[k] = a * v[k] + xv / root * one + (vv - xv * xv / xx).max(0.0).sqrt() * two;
        }
    }
    fixes
}

pub(crate) fn found(fixes: &[Fix]) -> PersistentWalk {
    persistent_walk(&[fixes.to_vec()]).expect("it moves")
}

/// The density of the places relative to the first one, from the covariance of a walk: `(M(s) + M(t) - M(|s - t|))/2` and the errors.
#[test]
fn the_likelihood_is_that_of_a_normal_vector() {
    let fixes = walk([2.0, 1.5, 0.3], (0.5, 12), 0.7, 3);
    for [p, speed, error] in [[2.0, 1.5, 0.3], [0.1, 1.0, 0.0], [50.0, 2.0, 1.0]] {
        let square = |t: f64| {
            let x: f64 = t / p;
            speed
                * speed
                * p
                * p
                * if x < 1e-2 {
                    x * x * (0.5 - x / 6.0 + x * x / 24.0 - x * x * x / 120.0)
                } else {
                    x + libm::expm1(-x)
                }
        };
        let n = fixes.len() - 1;
        let at = |k: usize| fixes[k + 1].t - fixes[0].t;
        let covariance = DMatrix::from_fn(n, n, |i, j| {
            let motion = 0.5 * (square(at(i)) + square(at(j)) - square((at(i) - at(j)).abs()));
            motion + error * error * if i == j { 2.0 } else { 1.0 }
        });
        let root = covariance.cholesky().expect("positive definite");
        let determinant = 2.0 * root.l().diagonal().iter().map(|x| libm::log(*x)).sum::<f64>();
        let exact: f64 = (0..2)
            .map(|c| {
                let y = DVector::from_fn(n, |k, _| fixes[k + 1].at[c] - fixes[0].at[c]);
                -0.5 * (y.dot(&root.solve(&y)) + determinant + n as f64 * libm::log(TAU))
            })
            .sum();
        let own = walk_likelihood(std::slice::from_ref(&fixes), p, speed, error);
        assert!((own - exact).abs() < 1e-7 * exact.abs().max(1.0), "{p}: {own} {exact}");
    }
}

/// The numbers of these walks that have each true value in its interval, and of those that are described.
fn held(truth: [f64; 3], (dt, frames): (f64, u32), seen: f64, runs: u64) -> ([u64; 4], u64) {
    let values = [truth[0], truth[1], 0.5 * truth[1] * truth[1] * truth[0], truth[2]];
    let (mut held, mut described) = ([0; 4], 0);
    for seed in 0..runs {
        let one = found(&walk(truth, (dt, frames), seen, 100 + seed));
        let all = [one.persistence, one.speed, one.diffusion, one.error];
        for (count, (bounded, value)) in held.iter_mut().zip(all.iter().zip(values)) {
            let inside =
                bounded.low.is_none_or(|low| low <= value) && bounded.high.is_none_or(|high| value <= high);
            *count += u64::from(inside);
        }
        described += u64::from(one.describes());
    }
    println!("{truth:?}, {frames} frames of {dt}: held {held:?}, described {described} of {runs}");
    (held, described)
}

/// 95 % intervals of walks of 50 persistence times, a fifth of the frames missing, errors half as large as a
/// step; of short records; of small errors; sampled finely and coarsely.
#[test]
fn intervals_hold_the_truth() {
    let runs = draws(24, 60);
    for (truth, sampling, seen) in [
        ([4.0, 1.2, 0.4], (0.7, 280), 0.8),
        ([4.0, 1.2, 0.4], (0.7, 40), 0.8),
        ([4.0, 1.2, 0.05], (1.0, 200), 1.0),
        ([20.0, 1.0, 0.02], (0.4, 1000), 1.0),
        ([0.5, 1.0, 0.2], (1.0, 300), 0.9),
    ] {
        let (held, described) = held(truth, sampling, seen, runs);
        // 95 % of 60 are 57 -+ 1.7, of 24 less than 17 have a probability of 1e-5; ends that are open hold every value
        assert!(held.iter().all(|&count| count >= draws(17, 52)), "{held:?}");
        // 1 % turn one way and 2 % are held back by chance: of 24 more than five have a probability of 6e-5
        assert!(described >= draws(19, 56), "{described}");
    }
}

/// Steps without memory set no lower bound to P, and D all the same; a path that keeps its velocity sets no upper one.
/// The estimates are those of highest likelihood, and not the nearest ones of a grid: any other walk nearby has a smaller one.
#[test]
fn the_estimates_have_the_highest_likelihood() {
    for seed in 1..=6 {
        let fixes = walk([6.0, 0.8, 0.1], (1.0, 200), 1.0, seed);
        let walk = found(&fixes);
        let [p, s, e] = [walk.persistence.value, walk.speed.value, walk.error.value];
        let likelihood = |p: f64, s: f64, e: f64| walk_likelihood(std::slice::from_ref(&fixes), p, s, e);
        let highest = likelihood(p, s, e);
        assert!((highest - walk.tests.log_likelihood).abs() < 1e-7 * highest.abs().max(1.0));
        for step in [1e-3, 1e-2] {
            for by in [1.0 - step, 1.0 + step] {
                for other in
                    [likelihood(p * by, s, e), likelihood(p, s * by, e), likelihood(p * by, s / by.sqrt(), e)]
                {
                    assert!(other <= highest + 1e-9, "seed {seed}, {by}: {other} above {highest}");
                }
            }
        }
    }
}

#[test]
fn what_the_places_do_not_bound_is_open() {
    let free = found(&walk([0.01, 10.0, 0.0], (1.0, 400), 1.0, 5)); // D = 0.5
    assert!(free.persistence.low.is_none() && free.speed.high.is_none(), "{free:?}");
    let (low, high) = (free.diffusion.low.expect("bounded"), free.diffusion.high.expect("bounded"));
    assert!(low < 0.5 && 0.5 < high && high < 1.6 * low, "{free:?}");
    let kept = found(&walk([1e4, 1.0, 0.1], (1.0, 100), 1.0, 6));
    assert!(kept.persistence.high.is_none() && kept.diffusion.high.is_none(), "{kept:?}");
    let error = kept.error;
    assert!(error.low.expect("bounded") < 0.1 && 0.1 < error.high.expect("bounded"), "{kept:?}");
}

/// A walk that rests, but for errors: its error is known, and the motion is below it.
#[test]
fn errors_alone_are_errors() {
    let mut normal = Normal::new(8, 0);
    let fixes: Vec<Fix> =
        (0..300).map(|k| Fix { t: f64::from(k), at: [0.2 * normal.next(), 0.2 * normal.next()] }).collect();
    let one = found(&fixes);
    assert!((one.error.value - 0.2).abs() < 0.02, "{one:?}");
    assert!(one.speed.value < 0.02, "{one:?}"); // steps of 0.28 are those of errors
}

/// Places at rest with errors: motion has no lower end, and the persistence no bound. Where the diffusion over the record is many errors,
/// rest is excluded. The likelihood of rest is that of walks with a vanishing speed.
#[test]
fn a_walk_that_rests_has_no_lower_ends() {
    let still = |seed: u64| {
        let mut normal = Normal::new(seed, 8);
        let fixes: Vec<Fix> = (0..150)
            .map(|k| Fix { t: f64::from(k), at: [0.2 * normal.next(), 0.2 * normal.next()] })
            .collect();
        let one = found(&fixes);
        let excluded = one.tests.log_likelihood - walk_likelihood(&[fixes], 1.0, 1e-9, one.error.value);
        assert!(one.rests || excluded > 1.9, "{excluded}: {one:?}");
        if one.rests {
            let ends = [one.persistence.low, one.persistence.high, one.speed.low, one.diffusion.low];
            assert_eq!(ends, [None; 4], "{one:?}");
        }
        u32::from(one.rests)
    };
    let rests: u32 = (0..40).map(still).sum();
    assert!(rests >= 34, "{rests} of 40");
    for seed in 0..20 {
        let one = found(&walk([4.0, 0.3, 0.2], (1.0, 150), 1.0, seed));
        assert!(!one.rests && one.speed.low.is_some(), "{one:?}");
    }
}

#[test]
fn units_change_units_alone_and_pieces_are_not_joined() {
    let fixes = walk([3.0, 1.0, 0.2], (1.0, 200), 0.9, 9);
    let scaled: Vec<Fix> =
        fixes.iter().map(|fix| Fix { t: 60.0 * fix.t, at: fix.at.map(|x| 0.25 * x) }).collect();
    let (one, other) = (found(&fixes), found(&scaled));
    let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-6;
    assert!(close(one.persistence.value, other.persistence.value / 60.0));
    assert!(close(one.diffusion.value, other.diffusion.value * 60.0 / 0.0625));
    assert!(close(one.error.value, other.error.value / 0.25));
    assert!(
        close(one.tests.turning_score, other.tests.turning_score)
            && close(one.tests.direction_p_value, other.tests.direction_p_value)
    );
    // axes do not matter, and in a mirror the other way is turned
    let (sin, cos) = libm::sincos(0.7);
    let seen = |sign: f64| {
        let at = |[x, y]: [f64; 2]| [cos * x - sign * sin * y, sin * x + sign * cos * y];
        found(&fixes.iter().map(|fix| Fix { t: fix.t, at: at(fix.at) }).collect::<Vec<_>>())
    };
    for (sign, turned) in [(1.0, seen(1.0)), (-1.0, seen(-1.0))] {
        assert!(close(sign * one.tests.turning_score, turned.tests.turning_score), "{one:?} {turned:?}");
        assert!(close(one.tests.direction_p_value, turned.tests.direction_p_value), "{one:?} {turned:?}");
    }
    // a stage that jumps between two pieces changes nothing
    let (first, second) = fixes.split_at(90);
    let moved: Vec<Fix> =
        second.iter().map(|fix| Fix { t: fix.t, at: [fix.at[0] + 500.0, fix.at[1]] }).collect();
    let apart = persistent_walk(&[first.to_vec(), moved]);
    assert_eq!(
        apart.map(|w| w.tests.steps),
        persistent_walk(&[first.to_vec(), second.to_vec()]).map(|w| w.tests.steps)
    );
}

/// Steady circles are no random walk, and it is said.
#[test]
fn a_circle_is_not_described() {
    let fixes: Vec<Fix> = (0..300)
        .map(|k| Fix {
            t: f64::from(k),
            at: [5.0 * libm::cos(0.2 * f64::from(k)), 5.0 * libm::sin(0.2 * f64::from(k))],
        })
        .collect();
    assert!(!found(&fixes).describes());
    assert!(persistent_walk(&[fixes[..12].to_vec()]).is_none(), "eleven steps");
    let rest = vec![Fix { t: 0.0, at: [1.0, 1.0] }; 9];
    assert!(persistent_walk(&[rest]).is_none());
}

/// A path of unit steps with these headings, with errors of the places.
fn path(headings: impl Iterator<Item = f64>, error: f64, normal: &mut Normal) -> Vec<Fix> {
    let mut at = [0.0; 2];
    let mut fixes = Vec::new();
    for (k, heading) in headings.enumerate() {
        at = [at[0] + libm::cos(heading), at[1] + libm::sin(heading)];
        fixes.push(Fix { t: k as f64, at: at.map(|x| x + error * normal.next()) });
    }
    fixes
}

/// Headings that diffuse, with and without a turn: D of the turning ones is smaller than that of any walk by the factor 1 + (omega/Dr)^2.
#[test]
fn walks_that_keep_turning_are_not_described() {
    for (rate, least, most) in [(0.0, 0, 3), (0.15, 39, 40), (-0.3, 40, 40)] {
        let turning = (0..40).filter(|&seed| {
            let mut normal = Normal::new(seed, 7);
            let mut heading = 0.0;
            let steps: Vec<f64> = (0..300)
                .map(|_| {
                    heading += rate + 0.45 * normal.next();
                    heading
                })
                .collect();
            let walk = found(&path(steps.into_iter(), 0.02, &mut normal));
            assert!(rate == 0.0 || walk.tests.turning_score * rate > 0.0);
            walk.misfit() == Some(Misfit::Turns)
        });
        let count = turning.count();
        assert!((least..=most).contains(&count), "{rate}: {count} of 40");
    }
}

/// Corners of a square, reflections between walls, and a zigzag: 10 to 20 sharp turns, further apart than the lags of the test of
/// whiteness.
#[test]
fn paths_with_a_direction_or_a_sense_are_not_described() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let square = |k: usize| quarter * (k / 25) as f64;
    let zigzag = |k: usize| 0.3 + if (k / 15).is_multiple_of(2) { 0.6 } else { -0.6 };
    let stripe = |k: usize| 1.1 + if (k / 20).is_multiple_of(2) { 0.0 } else { 2.0 * quarter };
    let kinds: [(&dyn Fn(usize) -> f64, Misfit); 3] =
        [(&square, Misfit::Turns), (&zigzag, Misfit::Directed), (&stripe, Misfit::Directed)];
    for (heading, expected) in kinds {
        for seed in 0..10 {
            let walk = found(&path((0..300).map(heading), 0.01, &mut Normal::new(seed, 3)));
            assert_eq!(walk.misfit(), Some(expected), "{walk:?}");
        }
    }
}

/// Runs and reversals at one speed, and a zigzag of sharp turns: what returns after a turn looks like errors of the places, six times the
/// true ones, and the mean square speed without them lay below the square of the mean speed. Walks with any errors are not refused.
#[test]
fn turns_at_one_speed_are_no_errors_of_places() {
    for turn in [std::f64::consts::PI, 1.2] {
        let refused = (0..40).filter(|&seed| {
            let mut normal = Normal::new(seed, 17);
            let (mut heading, mut sense, mut wait) = (normal.next(), 1.0, 0.0);
            let steps: Vec<f64> = (0..200)
                .map(|_| {
                    wait -= 1.0;
                    if wait < 0.0 {
                        wait = 7.0 * (0..3).map(|_| normal.next() * normal.next()).sum::<f64>().abs() + 4.0;
                        heading += sense * turn;
                        sense = -sense;
                    }
                    heading += 0.06 * normal.next();
                    heading
                })
                .collect();
            let walk = found(&path(steps.into_iter(), 0.01, &mut normal));
            walk.misfit().is_some() || walk.error.low.is_none_or(|low| low <= 0.011)
        });
        let count = refused.count();
        assert!(count >= 38, "{turn}: {count} of 40");
    }
    for error in [0.02, 0.3, 1.0] {
        let even = (0..40).filter(|&seed| {
            found(&walk([4.0, 1.0, error], (1.0, 200), 1.0, 7000 + seed)).misfit() == Some(Misfit::Even)
        });
        assert_eq!(even.count(), 0, "{error}");
    }
}

/// The scores of turning of walks are normal: their mean and variance over walks, with and without gaps.
#[test]
fn scores_of_turning_are_normal() {
    for (truth, sampling, seen) in [([4.0, 1.2, 0.05], (1.0, 200), 1.0), ([2.0, 1.0, 0.6], (0.7, 120), 0.8)] {
        let runs = draws(120, 400);
        let scores: Vec<f64> = (0..runs)
            .map(|seed| found(&walk(truth, sampling, seen, 900 + seed)).tests.turning_score)
            .collect();
        let mean = scores.iter().sum::<f64>() / runs as f64;
        let variance = scores.iter().map(|z| z * z).sum::<f64>() / runs as f64;
        // standard errors 0.05 and 0.07 of 400, 0.09 and 0.13 of 120
        assert!(
            mean.abs() < draws(0.35, 0.17) && (variance - 1.0).abs() < draws(0.5, 0.22),
            "{mean} {variance}"
        );
        // 4 of 400 are expected, and 1.2 of 120, where more than 6 have a probability of 3e-4
        let beyond = scores.iter().filter(|z| z.abs() > 2.576).count();
        assert!(beyond <= draws(6, 12), "{beyond} of {runs}");
    }
}

/// The likelihood at each end of an interval of P, highest over speed and error, is 1.92 below the maximum; where there is no end, the
/// places do not exclude P there. Long persistence and small errors: the ridge of the likelihood is narrow.
#[test]
fn ends_of_the_persistence_are_those_of_its_profile() {
    for (truth, sampling) in [([3000.0, 0.05, 0.013], (10.0, 200)), ([300.0, 1.0, 0.2], (1.0, 400))] {
        for seed in 1..=20 {
            let fixes = walk(truth, sampling, 1.0, seed);
            let one = found(&fixes);
            let below = |p: f64| one.tests.log_likelihood - profile(&fixes, p, one.error.value.max(1e-3));
            let [low, high] = [one.persistence.low, one.persistence.high];
            for end in [low, high].into_iter().flatten() {
                let fall = below(end);
                // an interval that allows for diffusion beside the walk is wider than the profile
                let most = if one.tests.diffusion_score.abs() > 0.5 { f64::INFINITY } else { 2.6 };
                assert!((1.6..most).contains(&fall), "seed {seed}: {fall} below at {end}, {one:?}");
            }
            assert!(low.is_some() || below(0.03 * sampling.0) < 2.2, "seed {seed}: {one:?}");
            assert!(
                high.is_some() || below(10.0 * sampling.0 * f64::from(sampling.1)) < 2.2,
                "seed {seed}: {one:?}"
            );
        }
    }
}

/// The highest likelihood of a persistence time, by a plain search over the logarithms of speed and error.
fn profile(fixes: &[Fix], persistence: f64, error: f64) -> f64 {
    let likelihood =
        |[s, e]: [f64; 2]| walk_likelihood(&[fixes.to_vec()], persistence, libm::exp(s), libm::exp(e));
    let path: f64 =
        fixes.windows(2).map(|f| libm::hypot(f[1].at[0] - f[0].at[0], f[1].at[1] - f[0].at[1])).sum();
    let (mut at, mut step) =
        ([libm::log(path / (fixes[fixes.len() - 1].t - fixes[0].t)), libm::log(error)], 1.0);
    let mut best = likelihood(at);
    while step > 1e-4 {
        let tried =
            [[step, 0.0], [-step, 0.0], [0.0, step], [0.0, -step]].map(|d| [at[0] + d[0], at[1] + d[1]]);
        let higher =
            tried.into_iter().map(|place| (likelihood(place), place)).max_by(|a, b| a.0.total_cmp(&b.0));
        match higher {
            Some((value, place)) if value > best => (best, at) = (value, place),
            _ => step *= 0.5,
        }
    }
    best
}

/// A walk with its walls: reflected by a disc of this radius, in twenty steps from place to place.
fn confined(radius: f64, [persistence, speed, error]: [f64; 3], frames: usize, seed: u64) -> Vec<Fix> {
    let mut normal = Normal::new(seed, 11);
    let (h, s) = (0.05, std::f64::consts::FRAC_1_SQRT_2 * speed);
    let (mut x, mut v) = ([0.0; 2], [s * normal.next(), s * normal.next()]);
    let mut fixes = Vec::new();
    for k in 0..20 * frames {
        if k % 20 == 0 {
            fixes.push(Fix { t: (k / 20) as f64, at: x.map(|x| x + error * normal.next()) });
        }
        for c in 0..2 {
            v[c] += -v[c] * h / persistence + s * libm::sqrt(2.0 * h / persistence) * normal.next();
            x[c] += v[c] * h;
        }
        let r = libm::hypot(x[0], x[1]);
        if r > radius {
            let outward = (v[0] * x[0] + v[1] * x[1]) / r;
            for c in 0..2 {
                v[c] -= 2.0 * outward.max(0.0) * x[c] / r;
                x[c] *= (2.0 * radius - r) / r;
            }
        }
    }
    fixes
}

/// Persistent walks inside a reflecting disc, free ones, and free ones that rest or slow down from the middle on: the first are held back,
/// of the second as few as chance makes, and the others are not stationary, whatever their units and axes.
#[test]
fn walks_that_are_held_or_not_stationary_are_not_described() {
    let count = |is: Misfit, path: &dyn Fn(u64) -> Vec<Fix>| {
        (0..40).filter(|&seed| found(&path(seed)).misfit() == Some(is)).count()
    };
    let truth = [8.0, 1.0, 0.02];
    let slower = |part: f64, seed: u64| {
        let mut fixes = walk(truth, (1.0, 400), 1.0, 500 + seed);
        let [x, y] = fixes[200].at;
        let turned = |[a, b]: [f64; 2]| [60.0 * (0.6 * a - 0.8 * b), 60.0 * (0.8 * a + 0.6 * b)];
        for (k, fix) in fixes.iter_mut().enumerate() {
            let wobble = 0.02 * [libm::sin(1.7 * (k * k) as f64), libm::cos(1.1 * (k * k) as f64)][k % 2];
            if k > 200 {
                fix.at = [x + part * (fix.at[0] - x) + wobble, y + part * (fix.at[1] - y)];
            }
            *fix = Fix { t: 0.1 * fix.t, at: turned(fix.at) };
        }
        fixes
    };
    let free = count(Misfit::Held, &|seed| walk(truth, (1.0, 300), 1.0, 3000 + seed));
    let held = count(Misfit::Held, &|seed| confined(12.0, truth, 400, seed));
    let rests = count(Misfit::Unsteady, &|seed| slower(0.0, seed));
    let slows = count(Misfit::Unsteady, &|seed| slower(0.15, seed));
    println!("free {free}, held {held}, rest {rests}, slow down {slows} of 40");
    assert!(free <= 3 && held >= 37 && rests >= 36 && slows >= 36, "{free} {held} {rests} {slows}");
    for seed in 0..10 {
        let still = found(&walk(truth, (1.0, 300), 1.0, 3000 + seed));
        assert!(still.tests.steady_p_value > 1e-3 && still.tests.changes.is_infinite(), "{still:?}");
    }
}

/// Straight, and at rest from one frame on: the record has one change of the velocity, which says neither how long it lasts nor how far the
/// cell diffuses. With a change every ten frames (run and rest) there are enough.
#[test]
fn one_change_of_the_velocity_is_no_walk() {
    for (seed, stop) in [(1, 200), (2, 150), (3, 300)] {
        let mut normal = Normal::new(seed, 13);
        let fixes: Vec<Fix> = (0..400)
            .map(|k| {
                let way = f64::from(k.min(stop));
                let at = [0.8 * way, 0.6 * way].map(|x| x + 0.02 * normal.next());
                Fix { t: f64::from(k), at }
            })
            .collect();
        let one = found(&fixes);
        assert_eq!(one.misfit(), Some(Misfit::Rare), "{one:?}");
    }
}

/// The share of walks with a spread at least as small as that of the limit, by its closed form and among 4000 sums of independent numbers:
/// as the fit of three numbers takes up little of it, the same holds of walks, within a factor of two.
#[test]
fn spreads_have_their_distribution() {
    let runs = draws(60, 150);
    for (truth, sampling, seen, most) in [
        ([4.0, 1.2, 0.4], (0.7, 280), 0.8, draws(5, 6)),
        ([0.5, 1.0, 0.2], (1.0, 300), 0.9, draws(7, 10)),
        ([8.0, 1.0, 0.02], (1.0, 300), 1.0, draws(5, 6)),
    ] {
        let spreads: Vec<f64> =
            (0..runs).map(|seed| found(&walk(truth, sampling, seen, 3000 + seed)).tests.spread).collect();
        let mean = spreads.iter().sum::<f64>() / runs as f64;
        let square = spreads.iter().map(|x| (x - 1.0) * (x - 1.0)).sum::<f64>() / runs as f64;
        // the closed form: 2 % are below .2685
        let below = spreads.iter().filter(|x| **x < 0.2685).count();
        println!("mean {mean}, scatter {}, {below} of {runs} below", square.sqrt());
        let near = (mean - 1.0).abs() < draws(0.25, 0.16);
        assert!(near && draws(0.4..0.85, 0.5..0.75).contains(&square.sqrt()) && below <= most, "{below}");
    }
}
