//! Noise has the law it claims: normal moments and tails, Brownian motion, the Ornstein-Uhlenbeck process.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::StuartLandau;
use motiform_dynamics::steppers::{DOP853, KROGSTAD4, RK4};
use motiform_dynamics::{
    Direction, Error, ExponentialOrbit, Integration, Noise, NoisyOrbit, Normal, Orbit, Request, Scalar,
    Section, Semilinear, StepControl, System, Trajectory, VectorField, drive::drive,
};

/// u' = -k u in `dim` entries.
struct Relaxation {
    k: f64,
    dim: usize,
}

impl System for Relaxation {
    fn dim(&self) -> usize {
        self.dim
    }
}

impl<T: Scalar> VectorField<T> for Relaxation {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        for (rate, &x) in du.iter_mut().zip(u) {
            *rate = x * -self.k;
        }
    }
}

impl<T: Scalar> Semilinear<T> for Relaxation {
    fn linear(&self, lambda: &mut [T::Real]) {
        for rate in lambda {
            *rate = rate.constant(-self.k);
        }
    }

    fn nonlinear(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        du.fill(u[0].zero());
    }
}

/// The same noise on `entries` entries with the same rate.
fn even(amplitude: f64, rate: f64, step: f64, entries: usize) -> Noise {
    Noise { amplitudes: vec![amplitude; entries], rates: vec![rate; entries], step }
}

/// The states at `t0 + n h`, n = 1 ..= count, with h the step of the noise.
fn samples<O: Integration>(orbit: O, noise: Noise, seed: u64, count: u32) -> Vec<Vec<f64>> {
    let h = noise.step;
    let mut noisy = NoisyOrbit::new(orbit, noise, Normal::new(seed, 7)).unwrap();
    let times = (1..=count).map(|n| h * f64::from(n));
    times
        .map(|t| {
            while noisy.t() < t {
                noisy.advance(t).unwrap();
            }
            noisy.state().to_vec()
        })
        .collect()
}

#[test]
fn normal_deviates_have_normal_moments_and_tails() {
    let mut normal = Normal::new(2026, 0);
    let n = 4_000_000;
    let (mut sums, mut beyond, mut product, mut last) = ([0.0; 4], [0.0; 3], 0.0, 0.0);
    for _ in 0..n {
        let x = normal.next();
        for (power, sum) in sums.iter_mut().enumerate() {
            *sum += x.powi(i32::try_from(power).unwrap() + 1) / f64::from(n);
        }
        for (bound, count) in beyond.iter_mut().enumerate() {
            *count += f64::from(u8::from(x.abs() > bound as f64 + 1.0)) / f64::from(n);
        }
        product += x * last / f64::from(n);
        last = x;
    }
    // E x^2p = (2p - 1)!!; standard errors sqrt(Var x^p / n) = sqrt(1, 2, 15, 96) / 2000; five of them
    for (seen, (want, variance)) in sums.iter().zip([(0.0, 1.0), (1.0, 2.0), (0.0, 15.0), (3.0, 96.0_f64)]) {
        assert!((seen - want).abs() < 5.0 * variance.sqrt() / 2000.0, "{seen} {want}");
    }
    // P(|x| > 1, 2, 3) = erfc(k / sqrt 2)
    for (k, seen) in beyond.iter().enumerate() {
        let p = libm::erfc((k as f64 + 1.0) / 2.0_f64.sqrt());
        assert!((seen - p).abs() < 5.0 * p.sqrt() / 2000.0, "{seen} {p}");
    }
    assert!(product.abs() < 5.0 / 2000.0);
}

#[test]
fn deviates_are_addressed_by_seed_and_stream() {
    let draw = |seed, stream| {
        let mut normal = Normal::new(seed, stream);
        std::array::from_fn::<u64, 5, _>(|_| normal.next().to_bits())
    };
    assert_eq!(draw(1, 2), draw(1, 2));
    assert_ne!(draw(1, 2), draw(1, 3));
    assert_ne!(draw(1, 2), draw(2, 2));
    // seen on x86-64; any machine must show the same
    assert_eq!(draw(0, 0)[..2], [13_831_866_017_044_014_666, 13_832_355_515_073_347_708]);
}

#[test]
fn without_a_flow_it_is_brownian_motion() {
    let still = Relaxation { k: 0.0, dim: 2000 };
    let noise = even(0.3, 0.0, 0.25, 1900);
    let control = StepControl::Fixed { step: 0.1 };
    let u = vec![1.0; 2000];
    let orbit = Orbit::new(&still, &RK4, control, 0.0, &u).unwrap();
    let last = samples(orbit, noise, 3, 20).pop().unwrap();
    let variance = last[..1900].iter().map(|x| (x - 1.0) * (x - 1.0)).sum::<f64>() / 1900.0;
    // eta^2 t with t = 5; standard error sqrt(2/1900) = 3.2 %; four of them
    assert!((variance / (0.09 * 5.0) - 1.0).abs() < 0.13, "{variance}");
    assert!(last[1900..].iter().all(|x| *x == 1.0), "no noise beyond its entries");
}

/// Stationary variance and autocorrelation after `lag` intervals.
fn stationary(states: &[Vec<f64>], lag: usize) -> (f64, f64) {
    let settled = &states[500..];
    let (mut variance, mut covariance, mut count) = (0.0, 0.0, 0.0);
    for (i, state) in settled[..settled.len() - lag].iter().enumerate() {
        for (x, y) in state.iter().zip(&settled[i + lag]) {
            variance += x * x;
            covariance += x * y;
            count += 1.0;
        }
    }
    (variance / count, covariance / variance)
}

#[test]
fn ornstein_uhlenbeck_has_its_stationary_law_with_any_integration() {
    let (k, eta, h) = (2.0, 0.5, 0.05);
    let field = Relaxation { k, dim: 10 };
    let noise = even(eta, -k, h, 10);
    let fixed = StepControl::Fixed { step: h };
    let start = [0.0; 10];
    let explicit = samples(Orbit::new(&field, &RK4, fixed, 0.0, &start).unwrap(), noise.clone(), 5, 60_000);
    let exponential =
        samples(ExponentialOrbit::new(&field, &KROGSTAD4, fixed, 0.0, &start).unwrap(), noise, 6, 60_000);
    for states in [explicit, exponential] {
        let (variance, correlation) = stationary(&states, 5);
        // eta^2/(2 k), exp(-k 5 h); 6e5 values with correlation time 1/(2 k h) = 5 for squares: relative standard error
        // sqrt(2 (2 * 5) / 6e5) = 0.6 %; four of them
        assert!((variance / (eta * eta / (2.0 * k)) - 1.0).abs() < 0.023, "{variance}");
        assert!((correlation - (-k * 5.0 * h).exp()).abs() < 0.015, "{correlation}");
    }
}

/// An entry whose rate the noise does not know has u_(n+1) = e^(-kh) (u_n + K) + K' with two halves of eta^2 h: the stationary
/// variance eta^2 (h/2) coth(kh) = eta^2/(2k) (1 + (kh)^2/3 + ...) is of second order, and at kh = 1 clearly not eta^2/(2k).
#[test]
fn an_unknown_rate_has_an_error_of_second_order() {
    let field = Relaxation { k: 1.0, dim: 10 };
    for h in [1.0, 2.0_f64] {
        let control = StepControl::Fixed { step: h };
        let orbit = ExponentialOrbit::new(&field, &KROGSTAD4, control, 0.0, &[0.0; 10]).unwrap();
        let (variance, _) = stationary(&samples(orbit, even(1.0, 0.0, h, 10), 8, 40_000), 1);
        // standard error sqrt(2/4e5 coth(kh)) = 0.26 %; four of them
        assert!((variance / (0.5 * h / h.tanh()) - 1.0).abs() < 0.0105, "{variance}");
    }
}

/// The variance eta^2/(2k) whatever k h is, and wherever the rows lie: at the ends of steps and between them.
#[test]
fn a_stiff_entry_has_its_exact_law_at_every_row() {
    let (eta, h) = (0.5, 0.25);
    for k in [0.1, 4.0, 400.0, 4e6] {
        let field = Relaxation { k, dim: 400 };
        let control = StepControl::Adaptive { rtol: 1e-6, atol: 1e-7 };
        // begins in its stationary law
        let mut normal = Normal::new(3, 0);
        let start: Vec<f64> = (0..400).map(|_| eta / (2.0 * k).sqrt() * normal.next()).collect();
        let orbit = ExponentialOrbit::new(&field, &KROGSTAD4, control, 0.0, &start).unwrap();
        let mut noisy = NoisyOrbit::new(orbit, even(eta, -k, h, 400), Normal::new(4, 0)).unwrap();
        let mut rows = Trajectory::new(400);
        let request = Request { sample_every: Some(0.11), ..Request::until(33.0, 400) };
        assert!(drive(&mut noisy, &request, &mut rows).unwrap().is_complete());
        // 11 n mod 25 / 25 of a step: 25 places in it
        for place in 0..25 {
            let states: Vec<&[f64]> = (place..rows.len()).step_by(25).map(|row| rows.state(row)).collect();
            let squares: f64 = states.iter().flat_map(|u| u.iter()).map(|x| x * x).sum();
            let variance = squares / (400 * states.len()) as f64 / (eta * eta / (2.0 * k));
            // at least 400 independent squares: standard error 7 %; at k = 0.1 those of other times help little
            assert!((variance - 1.0).abs() < 0.28, "{k} {place} {variance}");
        }
        let squares: f64 = rows.iter().flat_map(|(_, u)| u.iter()).map(|x| x * x).sum();
        let all = squares / (400 * rows.len()) as f64 / (eta * eta / (2.0 * k));
        // 400 paths of 33 time units, correlated over 1/(2k) or a row: at k = 0.1 some 1300 independent squares, 4 %; three
        assert!((all - 1.0).abs() < if k < 1.0 { 0.12 } else { 0.025 }, "{k} {all}");
        // rows a step and more apart: e^(-0.33 k)
        let products: f64 = (3..rows.len())
            .flat_map(|row| rows.state(row).iter().zip(rows.state(row - 3)))
            .map(|(x, y)| x * y)
            .sum();
        assert!(
            (products / squares * 300.0 / 297.0 - (-0.33 * k).exp()).abs() < 0.02,
            "{k} {}",
            products / squares
        );
    }
}

/// u' = -u - u^3 in every entry.
struct Cubic;

impl System for Cubic {
    fn dim(&self) -> usize {
        2000
    }
}

impl<T: Scalar> VectorField<T> for Cubic {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        for (rate, &x) in du.iter_mut().zip(u) {
            *rate = -x - x * x * x;
        }
    }
}

/// The stationary mean square of 2000 copies under noise of amplitude 1, with steps of length h.
fn mean_square<F: VectorField<f64>>(field: &F, rate: f64, h: f64) -> f64 {
    let control = StepControl::Fixed { step: h / 8.0 };
    let orbit = Orbit::new(field, &RK4, control, 0.0, &[0.6; 2000]).unwrap();
    let mut noisy = NoisyOrbit::new(orbit, even(1.0, rate, h, 2000), Normal::new(21, 0)).unwrap();
    let (mut sum, mut count) = (0.0, 0.0);
    while noisy.t() < 600.0 {
        for _ in 0..8 {
            noisy.advance(1e9).unwrap();
        }
        if noisy.t() > 10.0 {
            sum += noisy.state().iter().map(|x| x * x).sum::<f64>();
            count += 2000.0;
        }
    }
    sum / count
}

/// Weak order 2: the error of the mean square falls by four when the step is halved. Two flows: a linear one whose rate the
/// noise does not know (else it were exact), with the mean square 1/2, and the cubic one, with the density exp(-u^2 - u^4/2).
#[test]
fn the_weak_order_is_two() {
    // the trapezoidal rule is exact for such densities
    let moment = |power: i32| -> f64 {
        (-600..=600)
            .map(|i| f64::from(i) * 0.01)
            .map(|u| u.powi(power) * (-u * u - 0.5 * u.powi(4)).exp())
            .sum()
    };
    let linear = Relaxation { k: 1.0, dim: 2000 };
    let linear = [1.0, 0.5].map(|h| mean_square(&linear, 0.0, h) - 0.5);
    let cubic = [0.25, 0.125].map(|h| mean_square(&Cubic, -1.0, h) - moment(2) / moment(0));
    for errors in [linear, cubic] {
        let order = (errors[0] / errors[1]).log2();
        assert!((order - 2.0).abs() < 0.1, "{order}: {linear:?} {cubic:?}");
    }
}

/// The law commutes with rotations of the pair: the phase of a noisy limit cycle is uniform, and diffuses alike from
/// every start.
#[test]
fn the_law_does_not_know_directions() {
    let noise = even(0.2, 0.0, 0.05, 2);
    let spread = |angle: f64, seed: u64| {
        let mut sums = [0.0; 3];
        for run in 0..2000 {
            let u = [angle.cos(), angle.sin()];
            let orbit = Orbit::new(&StuartLandau, &RK4, StepControl::Fixed { step: 0.05 }, 0.0, &u).unwrap();
            let mut noisy = NoisyOrbit::new(orbit, noise.clone(), Normal::new(seed, run)).unwrap();
            while noisy.t() < 1.0 {
                noisy.advance(1.0).unwrap();
            }
            let (s, c) = (4.0 + angle).sin_cos(); // the angle without noise: rate 3 + |z|^2 = 4
            let (x, y) = (noisy.state()[0], noisy.state()[1]);
            let (along, across) = (c * x + s * y - 1.0, c * y - s * x);
            for (sum, value) in sums.iter_mut().zip([along * along, along * across, across * across]) {
                *sum += value / 2000.0;
            }
        }
        sums
    };
    let (reference, turned) = (spread(0.0, 11), spread(2.2, 12));
    // two variances of 2000 runs each differ by sqrt(2 * 2/2000) = 4.5 %; four of them
    for (a, b) in reference.iter().zip(turned) {
        assert!((a - b).abs() < 0.18 * reference[2].max(reference[0]), "{reference:?} {turned:?}");
    }
}

#[test]
fn the_same_seed_gives_the_same_bits_whatever_is_watched() {
    let run = |seed: u64, every: f64, sections: &[Section<'_>]| {
        let control = StepControl::Adaptive { rtol: 1e-8, atol: 1e-8 };
        let orbit = Orbit::new(&StuartLandau, &DOP853, control, 0.0, &[0.5, 0.0]);
        let mut noisy =
            NoisyOrbit::new(orbit.unwrap(), even(0.1, 0.0, 0.05, 2), Normal::new(seed, 0)).unwrap();
        let mut trajectory = Trajectory::new(2);
        let request = Request { sections, sample_every: Some(every), ..Request::until(20.0, 2) };
        assert!(drive(&mut noisy, &request, &mut trajectory).unwrap().is_complete());
        trajectory
    };
    let g = |_t: f64, u: &[f64]| u[1];
    let section = Section { g: &g, direction: Direction::Rising, terminal: false };
    let (plain, watched, other) = (run(1, 0.05, &[]), run(1, 0.05, &[section]), run(2, 0.05, &[]));
    assert!(plain.iter().eq(watched.iter()));
    assert!(!plain.iter().eq(other.iter()));
    // rate 4 with diffusion: 80/(2 pi) = 12.7 turns; kicks through the section may add pairs of crossings
    assert!(watched.crossings().len() >= 11, "{}", watched.crossings().len());
    // rows wherever they lie are rows of the same path: 0.03 is no part of a step, 0.01 is
    let (rare, dense) = (run(1, 0.03, &[]), run(1, 0.01, &[]));
    for (row, (t, u)) in rare.iter().enumerate() {
        let same = dense.state(3 * row);
        assert!((u[0] - same[0]).abs() < 1e-12 && (u[1] - same[1]).abs() < 1e-12, "{t}: {u:?} {same:?}");
    }
    // and the path is continuous: 0.1 sqrt(0.01) = 0.01 per row from the noise, 0.04 from the turning
    let jump = |pair: [&[f64]; 2]| (pair[0][0] - pair[1][0]).hypot(pair[0][1] - pair[1][1]);
    let largest =
        (1..dense.len()).map(|row| jump([dense.state(row - 1), dense.state(row)])).fold(0.0, f64::max);
    assert!(largest < 0.13, "{largest}");
}

#[test]
fn noise_that_makes_no_sense_is_refused() {
    let field = Relaxation { k: 1.0, dim: 3 };
    let good = even(0.1, -1.0, 0.1, 3);
    let refused = |noise| {
        let control = StepControl::Fixed { step: 0.1 };
        let orbit = Orbit::new(&field, &RK4, control, 0.0, &[0.0; 3]).unwrap();
        NoisyOrbit::new(orbit, noise, Normal::new(0, 0)).err()
    };
    assert_eq!(refused(good.clone()), None);
    for bad in [even(-0.1, -1.0, 0.1, 3), even(f64::NAN, -1.0, 0.1, 3), even(0.1, f64::INFINITY, 0.1, 3)] {
        assert!(matches!(refused(bad), Some(Error::OutOfRange { .. })));
    }
    assert!(matches!(refused(Noise { step: 0.0, ..good.clone() }), Some(Error::OutOfRange { .. })));
    assert!(matches!(refused(even(0.1, -1.0, 0.1, 4)), Some(Error::Shape { got: 4, .. })));
    assert!(matches!(refused(Noise { rates: vec![0.0], ..good }), Some(Error::Shape { got: 1, .. })));
}

#[test]
fn the_step_resolves_growth_and_what_decays_with_it() {
    let step = |rates: &[f64]| Noise::step_for(rates, 10.0);
    // at most slow/100 = 0.1; then a tenth of the fastest rate's time; then a tenth of 20 times the growth's
    assert_eq!(step(&[0.01, -0.1]), 0.0625);
    assert_eq!(step(&[1.0, -0.9, -20.0]), 0.003_906_25);
    assert_eq!(step(&[1.0, -1e9]), 0.003_906_25);
    assert_eq!(step(&[-1e9, -1.0]), 0.007_812_5); // nothing grows: 5/slow takes its place
}
