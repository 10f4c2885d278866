//! The motions of the free equation come out of small random shapes, at the lengths of the known windows.
//!
//! Decided by speed, turning rate and steadiness alone; the analyses proper live in another layer.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_dynamics::drive::drive;
use motiform_dynamics::model::{turning_rate, velocity_and_acceleration};
use motiform_dynamics::steppers::KROGSTAD4;
use motiform_dynamics::{ExponentialOrbit, Integration, Request, StepControl, System, Trajectory};
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

/// The simple motions at the lengths of `shared` knowledge about the free equation, two seeds each.
fn expect(lengths: &[f64], check: impl Fn(&Measures) -> bool) {
    for &length in lengths {
        let cell = cell(length);
        for seed in [1, 2] {
            let measures = measure(&cell, &run(&cell, seed, 4000.0, 1000.0, 2.0));
            assert!(check(&measures), "length {length}, seed {seed}: {measures:?}");
        }
    }
}

#[test]
fn motionless_circle_and_shapes_of_two_three_and_four_folds() {
    expect(&[6.2, 15.5, 18.0, 20.5, 24.0, 28.0, 30.5], |m| m.fastest < 1e-9 && m.wandering < 1e-6);
}

#[test]
fn straight_motion() {
    expect(&[6.5, 9.0, 12.0], |m| {
        m.fastest > 1e-4 && m.steadiness > 0.999 && m.turning.1.max(-m.turning.0) < 1e-9
    });
}

#[test]
fn circular_motion() {
    expect(&[12.5, 12.8, 22.2], |m| {
        let (low, high) = m.turning;
        m.fastest > 1e-4 && m.steadiness > 0.999999 && low * high > 0.0 && high - low < 1e-3 * high.abs()
    });
}

/// Headings (rad) at the tops of the speed: one per leg.
fn legs(cell: &Cell, path: &Trajectory) -> Vec<f64> {
    let velocities: Vec<[f64; 2]> =
        path.iter().map(|(_, shape)| motiform_dynamics::model::velocity(cell, shape)).collect();
    let speed = |v: &[f64; 2]| v[0].hypot(v[1]);
    let fastest = velocities.iter().map(speed).fold(0.0, f64::max);
    let top = |w: &&[[f64; 2]]| {
        speed(&w[1]) > 0.3 * fastest && speed(&w[1]) >= speed(&w[0]) && speed(&w[1]) > speed(&w[2])
    };
    velocities.windows(3).filter(top).map(|w| w[1][1].atan2(w[1][0])).collect()
}

/// Sizes of the turns between legs, in degrees, 0..180.
fn turns(headings: &[f64]) -> Vec<f64> {
    headings.windows(2).map(|w| (w[1] - w[0]).sin().atan2((w[1] - w[0]).cos()).abs().to_degrees()).collect()
}

#[test]
fn rectangular_motion_rests_and_turns_by_90_degrees() {
    for length in [13.2, 14.0, 14.5] {
        let cell = cell(length);
        for seed in [1, 2] {
            let path = run(&cell, seed, 3000.0, 5000.0, 0.5);
            let m = measure(&cell, &path);
            assert!(m.fastest > 1e-3 && m.steadiness < 1e-6, "{length}: {m:?}");
            let turns = turns(&legs(&cell, &path));
            assert!(
                !turns.is_empty() && turns.iter().all(|turn| (turn - 90.0).abs() < 1.0),
                "{length}: {turns:?}"
            );
        }
    }
}

/// The turns at one length for one way to close the boundary; `None` where some shape could not be closed.
fn turns_with(shapes: &Cell, path: &Trajectory, closure_modes: f64, prior: f64) -> Option<Vec<f64>> {
    let cell = Cell::new(&CellParameters { closure_modes, prior, ..*shapes.parameters() }).unwrap();
    let closed = path.iter().all(|(_, shape)| cell.obstacle(shape).is_none());
    closed.then(|| turns(&legs(&cell, path)))
}

/// Zigzag at 29.2: turns of about 41 and 180 degrees in turn, as in the paper (180 +- 45). They hardly depend on the
/// prior; the bare normal gives others.
#[test]
fn turn_angles_at_29_2() {
    let shapes = cell(29.2);
    let path = run(&shapes, 1, 3000.0, 500.0, 0.25);
    for (modes, prior) in [(8.0, 4.0), (8.0, 3.0), (8.0, 6.0), (8.0, 2.0), (8.0, 0.0), (1.0, 4.0)] {
        let turns = turns_with(&shapes, &path, modes, prior).unwrap();
        println!("29.2, {modes} modes, prior {prior}: {turns:.1?}");
        assert!(turns.len() >= 4 && turns.windows(2).all(|w| (w[0] < 90.0) != (w[1] < 90.0)), "{turns:?}");
        for turn in turns {
            assert!((38.0..46.0).contains(&turn) || turn > 174.0, "{modes} {prior}: {turn}");
        }
    }
    let bare = turns_with(&shapes, &path, 0.0, 4.0).unwrap();
    println!("29.2, bare normal: {bare:.1?}");
    assert!(bare.iter().any(|turn| (60.0..160.0).contains(turn)), "{bare:?}");
}

/// At 29.6 the turns are 180 degrees and about 136: +-45 net, as the paper's coarse-grained path has them.
#[test]
fn turn_angles_at_29_6() {
    let shapes = cell(29.6);
    let path = run(&shapes, 1, 3000.0, 4000.0, 0.5);
    for (modes, prior) in [(8.0, 4.0), (8.0, 0.0), (1.0, 4.0)] {
        let turns = turns_with(&shapes, &path, modes, prior).unwrap();
        println!("29.6, {modes} modes, prior {prior}: {turns:.1?}");
        assert!(turns.len() >= 4);
        for turn in turns {
            assert!((130.0..142.0).contains(&turn) || turn > 174.0, "{modes} {prior}: {turn}");
        }
    }
}

/// Largest Lyapunov exponent by a twin orbit, pulled back to a distance of 1e-7 every two time units.
fn largest_exponent(length: f64, span: f64) -> f64 {
    let cell = cell(length);
    let shape = run(&cell, 3, 4000.0, 1.0, 1.0).state(0).to_vec();
    let advance = |shape: &[f64]| {
        let control = StepControl::Fixed { step: 0.1 };
        let mut orbit = ExponentialOrbit::new(&cell, &KROGSTAD4, control, 0.0, shape).unwrap();
        drive(&mut orbit, &Request::until(2.0, cell.dim()), &mut ()).unwrap();
        orbit.state().to_vec()
    };
    let (mut one, mut other, mut sum, mut time) = (shape.clone(), shape, 0.0, 0.0);
    other[0] += 1e-7;
    while time < span {
        (one, other) = (advance(&one), advance(&other));
        time += 2.0;
        let distance = one.iter().zip(&other).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        sum += if time > 200.0 { (distance / 1e-7).ln() } else { 0.0 };
        for (b, a) in other.iter_mut().zip(&one) {
            *b = a + (*b - a) * 1e-7 / distance;
        }
    }
    sum / (span - 200.0)
}

/// Irregular at 21.6 (exponent about +0.008), quasi-periodic at 21.8 (about 0).
#[test]
fn irregular_at_21_6_and_quasi_periodic_at_21_8() {
    let (irregular, regular) = (largest_exponent(21.6, 4000.0), largest_exponent(21.8, 4000.0));
    println!("exponents: {irregular:.4} at 21.6, {regular:.4} at 21.8");
    assert!((0.004..0.013).contains(&irregular) && regular.abs() < 0.003, "{irregular} {regular}");
}

/// The closure never fails nor leaves a residual along irregular motion; the drawn length is L, the area varies.
#[test]
fn closure_holds_along_irregular_motion() {
    let cell = cell(21.6);
    let path = run(&cell, 1, 1000.0, 2000.0, 2.0);
    let (mut areas, mut steps) = (vec![], 0);
    for (_, shape) in path.iter() {
        let boundary = cell.boundary(shape, 16).unwrap();
        assert!(boundary.closure_residual < 1e-12);
        assert!((boundary.length / 21.6 - 1.0).abs() < 1e-6, "{}", boundary.length);
        areas.push(boundary.area);
        steps = steps.max(boundary.steps);
    }
    let (low, high) = areas.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), &a| (l.min(a), h.max(a)));
    println!("area {low:.2} to {high:.2}, at most {steps} Newton steps");
    assert!(steps <= 8 && high > 1.1 * low);
}
