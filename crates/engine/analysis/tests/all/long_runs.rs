//! Confident verdicts against long runs by another integrator and another form of the equations (tensor: RK4 with fixed
//! steps on the paper's index form; cell: fixed steps of the exponential method, from moved starts too). The large sample is
//! bench/verdicts.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Random, cell, named, settings};
use motiform_analysis::{Attractor, Regime, RelativeEquilibrium, Settings, Verdict};
use motiform_dynamics::drive::drive;
use motiform_dynamics::{Equivariant, Model, Request, StepControl, Trajectory};
use motiform_models::tensor::indices::{Tensors, rate};
use motiform_models::tensor::{Tensor, TensorParameters};

/// A state as v1, v2, S11, S12, U111, U222.
type State = [f64; 6];

fn slope(p: &TensorParameters, u: &State) -> State {
    rate(p, &Tensors::from_components(*u)).components()
}

/// One step of the classical method.
fn step(p: &TensorParameters, u: &State, h: f64) -> State {
    let ahead = |k: &State, h: f64| std::array::from_fn(|i| u[i] + h * k[i]);
    let a = slope(p, u);
    let b = slope(p, &ahead(&a, 0.5 * h));
    let c = slope(p, &ahead(&b, 0.5 * h));
    let d = slope(p, &ahead(&c, h));
    std::array::from_fn(|i| u[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]))
}

/// Quantities that do not depend on the direction of the body: sizes of the three parts, and two angles
/// between them.
fn reduced(u: &State) -> [f64; 5] {
    let (v, s, w) = (u[0].hypot(u[1]), u[2].hypot(u[3]), u[4].hypot(u[5]));
    let along = u[2] * (u[0] * u[0] - u[1] * u[1]) + 2.0 * u[3] * u[0] * u[1]; // S v v
    let across = u[3] * (u[0] * u[0] - u[1] * u[1]) - 2.0 * u[2] * u[0] * u[1];
    [v, s, w, along, across]
}

/// The end of a long run.
struct Late {
    escaped: bool,
    /// Largest change of the reduced shape over the last quarter.
    change: f64,
    speed: (f64, f64),
    size: f64,
}

fn long_run(p: &TensorParameters, start: &State, time: f64) -> Late {
    const H: f64 = 0.1; // rates here are below 4: an error of (0.4)^4/120 per unit at most, and rest is rest
    let mut u = *start;
    let steps = (time / H).ceil();
    let (mut at, mut reference) = (0.0, reduced(&u));
    let mut late = Late { escaped: false, change: 0.0, speed: (f64::INFINITY, 0.0), size: 0.0 };
    while at < steps {
        u = step(p, &u, H);
        at += 1.0;
        late.size = u.iter().map(|x| x * x).sum::<f64>().sqrt();
        if late.size.is_nan() || late.size > 1e3 {
            return Late { escaped: true, ..late };
        }
        if at < 0.75 * steps {
            reference = reduced(&u);
            continue;
        }
        let now = reduced(&u);
        let moved = now.iter().zip(reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        late.change = late.change.max(moved);
        late.speed = (late.speed.0.min(now[0]), late.speed.1.max(now[0]));
    }
    late
}

/// Returns `true` if a verdict with a clear margin agrees with the run.
fn fits(verdict: &Verdict, late: &Late) -> bool {
    let rests = late.change < 1e-6 * late.size.max(1e-3);
    if late.escaped {
        return matches!(verdict.attractor, Attractor::Escape | Attractor::Chaotic);
    }
    match verdict.attractor {
        Attractor::Equilibrium | Attractor::Unstable => {
            let moves = late.speed.1 > 1e-5;
            let speed = verdict.speed.unwrap().mean;
            rests && moves == (verdict.regime != Regime::Motionless) && (late.speed.1 - speed).abs() < 1e-4
        }
        Attractor::Periodic | Attractor::Torus | Attractor::Chaotic => !rests,
        // a rest of the cycle may be longer than the run
        Attractor::Heteroclinic | Attractor::Unknown => true,
        Attractor::Escape => false,
    }
}

fn sure(verdict: &Verdict) -> bool {
    matches!(verdict.attractor, Attractor::Escape | Attractor::Unstable)
        || verdict.margin.is_some_and(|margin| margin >= 3.0)
}

/// Starts in the invariant subspaces (mirror images at two axes, two-fold, three-fold, rest), at exact equilibria, and one
/// in general position.
fn starts(random: &mut Random, p: &TensorParameters) -> Vec<(&'static str, State)> {
    let mut x = || 0.3 * random.next();
    let mut all = vec![
        ("origin", [0.0; 6]),
        ("velocity alone", [x(), 0.0, 0.0, 0.0, 0.0, 0.0]),
        ("velocity and ellipse", [x(), 0.0, x(), 0.0, 0.0, 0.0]),
        ("mirror image", [x(), 0.0, x(), 0.0, x(), 0.0]),
        ("mirror image, turned", [0.0, x(), x(), 0.0, 0.0, x()]),
        ("two-fold", [0.0, 0.0, x(), x(), 0.0, 0.0]),
        ("three-fold", [0.0, 0.0, 0.0, 0.0, x(), x()]),
        ("at rest", [0.0, 0.0, x(), x(), x(), x()]),
        ("general", [x(), x(), x(), x(), x(), x()]),
    ];
    if p.kappa2 < 0.0 && p.b3 > 0.0 {
        let s11 = (-p.kappa2 / (2.0 * p.b3)).sqrt(); // r2^2 = -kappa2 / (8 b3), S11 = 2 r2
        all.push(("ellipse", [0.0, 0.0, s11, 0.0, 0.0, 0.0]));
    }
    all
}

fn places() -> Vec<TensorParameters> {
    let free = TensorParameters { kappa3: 1.0, a1: 1.0, b1: 0.5, b3: 1.0, ..TensorParameters::default() };
    let fig1 = |kappa2, gamma| TensorParameters { kappa2, gamma, ..free };
    vec![
        fig1(-0.1, 0.1),
        fig1(-0.1, -0.04),
        fig1(-0.1, -0.3),
        fig1(-0.02, -0.044),
        fig1(0.1, -0.1),
        TensorParameters::full(0.5, 0.5),
        TensorParameters::full(0.9, 0.1),
        TensorParameters::full(0.5, 0.1),
    ]
}

/// No verdict that is sure of itself is contradicted: it names what the orbit does, or what a nearby orbit does.
#[test]
fn verdicts_from_invariant_subspaces_agree_with_long_runs() {
    let settings = settings("tensor");
    let mut random = Random(14);
    let (mut asked, mut undecided) = (0, 0);
    for p in places() {
        let body = Tensor::new(&p);
        for (name, start) in starts(&mut random, &p) {
            let mut shape = [0.0; 6];
            body.encode(&start, &mut shape);
            let verdict = named(&body, &shape, &settings);
            asked += 1;
            if !sure(&verdict) {
                undecided += 1;
                continue;
            }
            let time = (3.0 * verdict.time).clamp(1000.0, 4000.0);
            let moved = start.map(|x| x + 1e-6 * random.next());
            let agrees = [start, moved].iter().any(|start| fits(&verdict, &long_run(&p, start, time)));
            assert!(agrees, "{p:?}, {name} {start:?}: {} ({})", verdict.regime, verdict.why);
        }
    }
    println!("{asked} starts, {undecided} undecided");
    assert!(3 * undecided < asked, "{undecided} of {asked}");
}

/// Returns `true` if the reduced shape of a cell rests at the end of a run.
fn cell_rests<B: Equivariant>(body: &B, start: &[f64], time: f64, settings: &Settings) -> bool {
    let control = StepControl::Fixed { step: 0.1 };
    let mut orbit = settings.method.shape_orbit(body, control, 0.0, start).unwrap();
    let mut path = Trajectory::new(start.len());
    let request = Request { sample_every: Some(0.02 * time), ..Request::until(time, start.len()) };
    drive(orbit.as_mut(), &request, &mut path).unwrap();
    let sizes: Vec<Vec<f64>> =
        path.iter().map(|(_, u)| u.chunks_exact(2).map(|z| z[0].hypot(z[1])).collect()).collect();
    let last = sizes.last().unwrap();
    let scale = last.iter().fold(1e-3, |m: f64, x| m.max(*x));
    let late = &sizes[sizes.len() * 3 / 4..];
    late.iter().flat_map(|one| one.iter().zip(last)).all(|(a, b)| (a - b).abs() < 1e-6 * scale)
}

/// A cell that begins in an invariant subspace, or at an equilibrium, is never called chaotic where its shape rests.
#[test]
fn a_cell_at_rest_is_not_chaotic() {
    let settings = Settings { budget: 2e4, ..settings("cell") };
    for length in [7.0, 13.0, 15.5, 23.0] {
        let body = cell(length, 12);
        let mut starts = vec![("circle", vec![0.0; 24])];
        for (name, mode) in [("mode 1", 0), ("mode 2", 2), ("mode 3", 4)] {
            let mut start = vec![0.0; 24];
            start[mode] = 0.05;
            starts.push((name, start));
        }
        if let Some(found) = RelativeEquilibrium::find(&body, &starts[1].1) {
            starts.push(("an equilibrium", found.shape));
        }
        for (name, start) in starts {
            let verdict = named(&body, &start, &settings);
            println!("{length} {name}: {} {:?} ({})", verdict.regime, verdict.margin, verdict.why);
            if verdict.regime == Regime::Chaotic {
                assert!(!cell_rests(&body, &start, 2.0 * verdict.time, &settings), "{length}, {name}");
            }
        }
    }
}

/// Times and headings (rad) where the body leaves a rest: RK4 on the index form, crossings of a speed.
fn departures(p: &TensorParameters, start: &State, time: f64, speed: f64) -> Vec<(f64, f64)> {
    const H: f64 = 0.04;
    let (mut u, mut departures) = (*start, Vec::new());
    let mut before = u[0].hypot(u[1]);
    for i in 1..=(time / H).ceil() as u64 {
        u = step(p, &u, H);
        let now = u[0].hypot(u[1]);
        if before < speed && now >= speed {
            departures.push((H * (i as f64 - (now - speed) / (now - before)), u[1].atan2(u[0])));
        }
        before = now;
    }
    departures
}

fn close_to_gamma_0(kappa2: f64, gamma: f64) -> TensorParameters {
    TensorParameters { kappa2, gamma, kappa3: 1.0, a1: 1.0, b1: 0.5, b3: 1.0, ..TensorParameters::default() }
}

const START: State = [0.1, 0.03, 0.05, 0.02, 0.01, 0.02];

fn named_from_start(p: &TensorParameters) -> Verdict {
    let body = Tensor::new(p);
    let mut shape = [0.0; 6];
    body.encode(&START, &mut shape);
    named(&body, &shape, &settings("tensor"))
}

/// Close to gamma = 0 the quasi-periodic motion of Fig. 1 rests at two-fold ellipses, and what leaves them has decayed to 1e-10 of its
/// size: there a shape nearly comes back after any time.
#[test]
fn periods_of_orbits_with_long_rests_are_those_of_long_runs() {
    const GAPS: usize = 20;
    for (kappa2, gamma) in [(-0.1, 0.005), (-0.2, 0.01)] {
        let p = close_to_gamma_0(kappa2, gamma);
        let verdict = named_from_start(&p);
        let seen = departures(&p, &START, 20_000.0, 0.1);
        let last = seen.len() - 1;
        let (found, want) = (verdict.period.unwrap(), (seen[last].0 - seen[last - GAPS].0) / GAPS as f64);
        println!("kappa2 = {kappa2}, gamma = {gamma}: {found} and {want}");
        // round-off of 1e-16 per step on what has decayed to 1e-10 moves departures by some 1e-4
        assert!((found - want).abs() < 5e-4 * want, "{found} and {want}: {}", verdict.why);
    }
}

/// Closer still round-off decides how long each rest lasts. Where all turns go to one side the motion has its name and no period; where
/// round-off decides the side as well it has none.
#[test]
fn turns_decide_where_round_off_decides_the_rests() {
    // a hundred turns each: of those that have no side twenty would do
    for (kappa2, gamma) in [(-0.05, 0.002), (-0.1, 0.002)] {
        let p = close_to_gamma_0(kappa2, gamma);
        let verdict = named_from_start(&p);
        let seen = departures(&p, &START, 20_000.0, 0.1);
        let turns: Vec<f64> = seen.windows(2).skip(20).map(|pair| (pair[1].1 - pair[0].1).sin()).collect();
        let one_side = turns.iter().all(|turn| turn * turns[0] > 0.0);
        println!("kappa2 = {kappa2}: {} turns to one side: {one_side}; {}", turns.len(), verdict.why);
        let want = if one_side { Regime::QuasiPeriodic } else { Regime::Undetermined };
        assert_eq!((verdict.regime, verdict.period), (want, None), "{}", verdict.why);
    }
}

/// Near the end of a window one rest may last longer than a look: none is seen whole, and the motion has its name all the same.
#[test]
fn a_cycle_is_named_before_a_rest_is_seen_whole() {
    let (body, settings) = (cell(21.0, 21), settings("cell"));
    for seed in 1..=3 {
        let mut random = Random(seed);
        let start: Vec<f64> = (0..42).map(|_| 1e-2 * random.next()).collect();
        let verdict = named(&body, &start, &settings);
        println!("{} ({}), rests {:?}", verdict.regime, verdict.why, verdict.rests);
        assert!(matches!(verdict.regime, Regime::Rectangular | Regime::Undetermined), "{}", verdict.why);
    }
}
