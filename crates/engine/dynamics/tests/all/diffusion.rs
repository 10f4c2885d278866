//! Noise whose strength depends on the state: laws, weak and strong order against exact solutions (Stratonovich).

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::steppers::RK4;
use motiform_dynamics::{
    Diffusion, Integration, Noise, NoisyOrbit, Normal, Orbit, Scalar, StepControl, System, VectorField,
};
use std::sync::{Arc, Mutex};

/// `u' = a - k u` in every entry.
struct Pull {
    a: f64,
    k: f64,
    dim: usize,
}

impl System for Pull {
    fn dim(&self) -> usize {
        self.dim
    }
}

impl<T: Scalar> VectorField<T> for Pull {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        for (rate, &x) in du.iter_mut().zip(u) {
            *rate = x * -self.k + x.constant(self.a);
        }
    }
}

/// `du = s u o dW`, a process for each entry; keeps its increments.
struct Geometric {
    s: f64,
    dim: usize,
    increments: Arc<Mutex<Vec<f64>>>,
}

impl Diffusion for Geometric {
    fn processes(&self) -> usize {
        self.dim
    }

    fn kick(&self, process: usize, w: f64, u: &mut [f64]) {
        self.increments.lock().unwrap().push(w);
        u[process] *= libm::exp(self.s * w);
    }

    fn rate(&self) -> f64 {
        self.s * self.s
    }

    fn moves(&self, entry: usize) -> bool {
        entry < self.dim
    }
}

/// Entries of `du = (a - k u) dt + s u o dW` from 1 on at the time `t`, by steps of length `h`, and the increments in their order.
fn entries(field: &Pull, s: f64, h: f64, t: f64, seed: u64) -> (Vec<f64>, Vec<f64>) {
    let increments = Arc::new(Mutex::new(Vec::new()));
    let diffusion = Geometric { s, dim: field.dim, increments: Arc::clone(&increments) };
    let orbit =
        Orbit::new(field, &RK4, StepControl::Fixed { step: h.min(0.125) }, 0.0, &vec![1.0; field.dim])
            .unwrap();
    let noise = Noise { amplitudes: Vec::new(), rates: Vec::new(), step: h };
    let mut noisy = NoisyOrbit::new(orbit, noise, Normal::new(seed, 1)).unwrap().with(Box::new(diffusion));
    while noisy.t() < t {
        noisy.advance(t).unwrap();
    }
    let state = noisy.state().to_vec();
    let increments = increments.lock().unwrap().clone();
    (state, increments)
}

fn mean(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / n;
    (mean, (variance / n).sqrt())
}

/// `u(t) = exp(-k t + s W(t))`: the logarithm is normal with the variance `s^2 t`, at the ends of steps and inside them.
#[test]
fn geometric_brownian_motion_has_its_exact_law() {
    let (s, k) = (0.7, 0.3);
    for (h, t) in [(0.5, 2.0), (0.5, 1.75), (1.0, 0.25)] {
        let (states, _) = entries(&Pull { a: 0.0, k, dim: 20_000 }, s, h, t, 3);
        let logarithms: Vec<f64> = states.iter().map(|u| libm::log(*u) + k * t).collect();
        let (average, error) = mean(&logarithms);
        let squares: Vec<f64> = logarithms.iter().map(|x| x * x / (s * s * t)).collect();
        let (variance, spread) = mean(&squares);
        assert!(average.abs() < 4.0 * error + 1e-4, "{h} {t} {average} {error}");
        assert!((variance - 1.0).abs() < 4.0 * spread, "{h} {t} {variance} {spread}");
    }
}

/// The mean of `du = (a - k u) dt + s u o dW` obeys `m' = a + (s^2/2 - k) m`. A step of the scheme has the mean
/// `q (a (1 - e^(-kh))/k + e^(-kh) q m)` with `q = e^(s^2 h/4)`: it converges with order 2, and the program has this mean.
#[test]
fn the_weak_order_is_two() {
    let (a, k, s, t) = (1.0, 1.0, 1.0, 2.0);
    let rate: f64 = 0.5 * s * s - k;
    let exact = (1.0 + a / rate) * libm::exp(rate * t) - a / rate;
    let scheme = |h: f64| {
        let (q, decay) = (libm::exp(s * s * h / 4.0), libm::exp(-k * h));
        let mut m = 1.0;
        for _ in 0..(t / h).round() as u32 {
            m = q * (a * (1.0 - decay) / k + decay * q * m);
        }
        m
    };
    for h in [1.0, 0.5, 0.25] {
        let order = libm::log2((scheme(h) - exact) / (scheme(0.5 * h) - exact));
        assert!((order - 2.0).abs() < 0.1, "{h} {order}");
    }
    // At a step of 1 the scheme's own error is 0.04.
    let (states, _) = entries(&Pull { a, k, dim: 100_000 }, s, 1.0, t, 5);
    let (found, error) = mean(&states);
    assert!((found - scheme(1.0)).abs() < 4.0 * error && error < 0.012, "{found} {} {error}", scheme(1.0));
}

/// Root mean square of the difference from the path with steps of 1/1024 of the same Brownian motion.
#[test]
fn the_strong_order_is_one_where_processes_commute() {
    let (a, k, s, t, fine, dim) = (1.0, 1.0, 0.5, 1.0, 1.0 / 1024.0, 300);
    let field = Pull { a, k, dim };
    let (exact, increments) = entries(&field, s, fine, t, 7);
    // Of each fine step: first increments in the order of the processes, then second ones in the opposite order.
    let steps: Vec<&[f64]> = increments.chunks_exact(2 * dim).collect();
    assert_eq!(steps.len(), 1024);
    let coarse = |size: usize| {
        let (h, mut square) = (size as f64 * fine, 0.0);
        for process in 0..dim {
            let whole = |part: &[&[f64]]| -> f64 {
                part.iter().map(|step| step[process] + step[2 * dim - 1 - process]).sum()
            };
            let mut u = 1.0;
            for step in steps.chunks_exact(size) {
                let (first, second) = step.split_at(size / 2);
                u *= libm::exp(s * whole(first));
                u = a / k + (u - a / k) * libm::exp(-k * h);
                u *= libm::exp(s * whole(second));
            }
            square += (u - exact[process]) * (u - exact[process]) / dim as f64;
        }
        square.sqrt()
    };
    let order = libm::log2(coarse(256) / coarse(16)) / 4.0;
    assert!((order - 1.0).abs() < 0.1, "{order} {} {}", coarse(256), coarse(16));
}

/// Pairs `du = o dW_1`, `dv = u o dW_2`: their fields do not commute; keeps its increments.
struct Areas {
    pairs: usize,
    increments: Arc<Mutex<Vec<f64>>>,
}

impl Diffusion for Areas {
    fn processes(&self) -> usize {
        2 * self.pairs
    }

    fn kick(&self, process: usize, w: f64, u: &mut [f64]) {
        self.increments.lock().unwrap().push(w);
        u[process] += if process.is_multiple_of(2) { w } else { u[process - 1] * w };
    }

    fn rate(&self) -> f64 {
        1.0
    }

    fn moves(&self, entry: usize) -> bool {
        entry < 2 * self.pairs
    }
}

/// The last entries of the pairs from 0 on at time 1, by steps of length `h`, and the increments in their order.
fn areas(pairs: usize, h: f64) -> (Vec<f64>, Vec<f64>) {
    let increments = Arc::new(Mutex::new(Vec::new()));
    let diffusion = Areas { pairs, increments: Arc::clone(&increments) };
    let field = Pull { a: 0.0, k: 0.0, dim: 2 * pairs };
    let control = StepControl::Fixed { step: h };
    let orbit = Orbit::new(&field, &RK4, control, 0.0, &vec![0.0; 2 * pairs]).unwrap();
    let noise = Noise { amplitudes: Vec::new(), rates: Vec::new(), step: h };
    let mut noisy = NoisyOrbit::new(orbit, noise, Normal::new(11, 1)).unwrap().with(Box::new(diffusion));
    while noisy.t() < 1.0 {
        noisy.advance(1.0).unwrap();
    }
    let last = noisy.state().iter().skip(1).step_by(2).copied().collect();
    let increments = increments.lock().unwrap().clone();
    (last, increments)
}

/// The scheme knows the increments of the processes, not the areas between them: in a step it takes `W_1` at its middle for `W_1`. The mean
/// square of what it misses is `E sum_steps (int (W_1 - W_1(middle)) dW_2)^2 = t h/4`: strong order 1/2, with a known constant.
#[test]
fn the_strong_order_is_one_half_where_processes_do_not_commute() {
    let (pairs, fine) = (1000, 1.0 / 1024.0);
    let (exact, increments) = areas(pairs, fine);
    let processes = 2 * pairs;
    let steps: Vec<&[f64]> = increments.chunks_exact(2 * processes).collect();
    let whole = |part: &[&[f64]], process: usize| -> f64 {
        part.iter().map(|step| step[process] + step[2 * processes - 1 - process]).sum()
    };
    let coarse = |size: usize| {
        let mut square = 0.0;
        for pair in 0..pairs {
            let (mut u, mut v) = (0.0, 0.0);
            for step in steps.chunks_exact(size) {
                let (first, second) = step.split_at(size / 2);
                u += whole(first, 2 * pair);
                v += u * (whole(first, 2 * pair + 1) + whole(second, 2 * pair + 1));
                u += whole(second, 2 * pair);
            }
            square += (v - exact[pair]).powi(2) / pairs as f64;
        }
        square.sqrt()
    };
    let order = libm::log2(coarse(256) / coarse(16)) / 4.0;
    assert!((order - 0.5).abs() < 0.1, "{order}");
    for size in [16, 64, 256] {
        // Against the fine steps, which miss a part of their own.
        let expected = (0.25 * (size as f64 - 1.0) * fine).sqrt();
        assert!((coarse(size) / expected - 1.0).abs() < 0.1, "{size} {} {expected}", coarse(size));
    }
}
