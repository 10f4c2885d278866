//! The motions of the free equation come out of small random shapes, at the lengths of the known windows.
//!
//! Decided by speed, turning rate and steadiness alone; the analyses proper live in another layer.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_dynamics::drive::drive;
use motiform_dynamics::model::{turning_rate, velocity_and_acceleration};
use motiform_dynamics::steppers::KROGSTAD4;
use motiform_dynamics::{ExponentialOrbit, Request, StepControl, System, Trajectory};
use motiform_models::cell::{Cell, CellParameters};

/// A small deterministic generator, uniform in -1..1 (splitmix64; Steele, Lea, Flood 2014).
struct Uniform(u64);

impl Uniform {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Means and extremes over the end of a long run.
#[derive(Debug)]
struct Measures {
    /// Largest speed; what counts as rest is measured against it.
    fastest: f64,
    /// Smallest over largest speed.
    steadiness: f64,
    /// Smallest and largest turning rate.
    turning: (f64, f64),
    /// Largest distance between two sampled shapes, modulo rotation: 0 for a fixed shape.
    wandering: f64,
}

fn cell(length: f64) -> Cell {
    let modes = (4.0 * length / std::f64::consts::TAU).ceil().max(8.0);
    Cell::new(&CellParameters { length, modes, ..Default::default() }).unwrap()
}

/// Shapes after a transient, sampled.
fn run(cell: &Cell, seed: u64, transient: f64, span: f64, every: f64) -> Trajectory {
    let mut random = Uniform(seed);
    let start: Vec<f64> = (0..cell.dim()).map(|i| if i < 10 { 0.02 * random.next() } else { 0.0 }).collect();
    let control = StepControl::Adaptive { rtol: 1e-7, atol: 1e-9 };
    let mut orbit = ExponentialOrbit::new(cell, &KROGSTAD4, control, 0.0, &start).unwrap();
    assert!(drive(&mut orbit, &Request::until(transient, cell.dim()), &mut ()).unwrap().is_complete());
    let mut path = Trajectory::new(cell.dim());
    let request = Request { sample_every: Some(every), ..Request::until(transient + span, cell.dim()) };
    assert!(drive(&mut orbit, &request, &mut path).unwrap().is_complete());
    path
}

fn measure(cell: &Cell, path: &Trajectory) -> Measures {
    let (mut speeds, mut turns, mut sizes) =
        ((f64::INFINITY, 0.0_f64), (f64::INFINITY, f64::NEG_INFINITY), vec![]);
    for (_, shape) in path.iter() {
        let (v, a) = velocity_and_acceleration(cell, shape);
        let speed = v[0].hypot(v[1]);
        assert!(speed.is_finite(), "the closure converges");
        speeds = (speeds.0.min(speed), speeds.1.max(speed));
        if let Some(rate) = turning_rate(v, a) {
            turns = (turns.0.min(rate), turns.1.max(rate));
        }
        sizes.push([0, 1, 2, 3].map(|n| shape[2 * n].hypot(shape[2 * n + 1])));
    }
    let spread = (0..4).map(|n| {
        let values = sizes.iter().map(|size| size[n]);
        values.clone().fold(0.0, f64::max) - values.fold(f64::INFINITY, f64::min)
    });
    Measures {
        fastest: speeds.1,
        steadiness: speeds.0 / speeds.1,
        turning: turns,
        wandering: spread.fold(0.0, f64::max),
    }
}

#[test]
fn explore() {
    for length in [
        6.2, 6.5, 9.0, 12.0, 12.5, 12.8, 13.2, 14.0, 14.5, 15.5, 18.0, 20.5, 21.3, 21.6, 21.8, 22.2, 24.0,
        28.0, 29.2, 29.6, 30.5,
    ] {
        let cell = cell(length);
        for seed in 1..=2 {
            let clock = std::time::Instant::now();
            let path = run(&cell, seed, 4000.0, 1000.0, 2.0);
            let middle = clock.elapsed().as_secs_f64();
            let m = measure(&cell, &path);
            println!("{length} {seed} {middle:.2}s {:.2}s {m:?}", clock.elapsed().as_secs_f64());
        }
    }
}
