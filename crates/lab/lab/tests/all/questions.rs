//! Questions about a plan: its steady motions, and where its orbit crosses a surface.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::Direction;
use motiform_dynamics::Watch;
use motiform_lab::analyse::Spans;
use motiform_lab::equilibria::equilibria;
use motiform_lab::samples::{self, Samples};
use motiform_lab::section::section;
use motiform_study::{Random, RunPlan, Study};
use std::sync::Mutex;

fn plan(text: &str) -> RunPlan {
    RunPlan::new(&Study::parse(text, "text", "test").unwrap()).unwrap()
}

/// The uncoupled model: a circle at rest, a circle that moves with |v| = sqrt(gamma), an ellipse at rest with
/// S:S = -kappa2 / b3, and both at once.
const UNCOUPLED: &str = "[model.tensor]\ngamma = 0.25\nkappa2 = -0.5\nb3 = 2.0\nkappa3 = 1.0";

#[test]
fn the_uncoupled_model_has_four_kinds_of_equilibria() {
    let found = equilibria(&plan(UNCOUPLED), 120, &()).unwrap().unwrap();
    let size = |name: &str, place: usize| found[place].shape.get(name).unwrap();
    let mut kinds: Vec<(f64, f64)> = Vec::new();
    for (place, equilibrium) in found.iter().enumerate() {
        let ellipse = 2.0 * (size("s11", place).powi(2) + size("s12", place).powi(2));
        kinds.push((equilibrium.speed, ellipse));
        assert!(equilibrium.residual < 1e-12 && equilibrium.turning_rate.abs() < 1e-12);
        assert_eq!(
            equilibrium.unstable,
            2 * usize::from(ellipse < 1e-9) + usize::from(equilibrium.speed < 1e-9) * 2
        );
    }
    for (speed, ellipse) in [(0.0, 0.0), (0.5, 0.0), (0.0, 0.25), (0.5, 0.25)] {
        let near = |&(v, s): &(f64, f64)| (v - speed).abs() < 1e-9 && (s - ellipse).abs() < 1e-9;
        assert!(kinds.iter().any(near), "speed {speed}, S:S {ellipse} in {kinds:?}");
    }
    let shares: f64 = found.iter().map(|equilibrium| equilibrium.share).sum();
    assert!(0.5 < shares && shares <= 1.0 + 1e-12, "{shares}");
    assert!(equilibria(&plan(UNCOUPLED), 0, &()).is_err());
}

/// The straight motion of a circle: x = speed t crosses every line once, at a time that is known.
#[test]
fn a_straight_path_crosses_a_line_when_it_should() {
    let text =
        "[model.tensor]\ngamma = 0.25\nkappa2 = 1.0\nkappa3 = 1.0\n[initial]\nv1 = 0.5\n[run]\nt_end = 10.0";
    let plan = plan(text);
    for (direction, expected) in [(Direction::Rising, 1), (Direction::Falling, 0), (Direction::Either, 1)] {
        let (table, outcome) = section(&plan, "x", 2.0, direction, &()).unwrap();
        assert!(outcome.is_complete());
        assert_eq!(table.rows(), expected);
        if expected == 1 {
            assert!((table.get("t").unwrap()[0] - 4.0).abs() < 1e-12);
            assert!((table.get("x").unwrap()[0] - 2.0).abs() < 1e-12);
            assert_eq!((table.get("v1").unwrap()[0], table.get("rising").unwrap()[0]), (0.5, 1.0));
        }
    }
    for (coordinate, value) in [("w", 0.0), ("x", f64::NAN)] {
        assert!(section(&plan, coordinate, value, Direction::Either, &()).is_err());
    }
}

struct Stopped;

impl Watch for Stopped {
    fn stopped(&self) -> bool {
        true
    }
}

#[test]
fn a_stop_is_heard() {
    assert_eq!(equilibria(&plan(UNCOUPLED), 10, &Stopped).unwrap(), None);
}

/// The parts that were done.
#[derive(Default)]
struct Parts(Mutex<Vec<f64>>);

impl Watch for Parts {
    fn progress(&self, done: f64) {
        self.0.lock().unwrap().push(done);
    }
}

/// Of several starts each is a part of the work: how far the orbit of one has come is none.
#[test]
fn the_progress_of_several_starts_only_grows() {
    let plan = plan("preset = \"fig5b\"");
    let samples = Samples { count: 4, random: Random::basins(1.0), given: false, threads: 1 };
    let [motions, exponents] = [Parts::default(), Parts::default()];
    samples::classify(&plan, samples, 1000.0, &motions).unwrap().unwrap();
    samples::lyapunov(&plan, samples, 1, Spans { transient: Some(10.0), t_end: Some(100.0) }, &exponents)
        .unwrap()
        .unwrap();
    for Parts(parts) in [motions, exponents] {
        assert_eq!(parts.into_inner().unwrap(), [0.25, 0.5, 0.75, 1.0]);
    }
}
