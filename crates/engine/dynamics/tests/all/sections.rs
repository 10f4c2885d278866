//! Sections are located to 1e-12 in time on smooth problems, in the right sense, and none is missed or doubled.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{Arenstorf, Oscillator};
use motiform_dynamics::section::Crossing;
use motiform_dynamics::steppers::{DOP853, DOPRI5, STEPPERS};
use motiform_dynamics::{
    Direction, Integration, Orbit, Outcome, Request, Section, Sink, StepControl, Trajectory, drive::drive,
};
use std::f64::consts::{PI, TAU};

fn crossings(section: Section<'_>, t_end: f64, rtol: f64) -> (Trajectory, Outcome, f64) {
    let control = StepControl::Adaptive { rtol, atol: rtol };
    let mut orbit = Orbit::new(&Oscillator, &DOP853, control, 0.0, &[1.0, 0.0]).unwrap();
    let mut trajectory = Trajectory::new(2);
    let sections = [section];
    let request = Request { sections: &sections, ..Request::until(t_end, 2) };
    let outcome = drive(&mut orbit, &request, &mut trajectory).unwrap();
    (trajectory, outcome, orbit.t())
}

#[test]
fn times_are_exact_to_1e_12() {
    // cos t = 0.3 at t = +-acos(0.3) + 2 pi k
    let g = |_t: f64, u: &[f64]| u[0] - 0.3;
    let section = Section { g: &g, direction: Direction::Either, terminal: false };
    let (trajectory, ..) = crossings(section, 20.0, 1e-13);
    let first = 0.3_f64.acos();
    let expected: Vec<f64> =
        (0..4).flat_map(|k| [first + TAU * f64::from(k), TAU * f64::from(k + 1) - first]).collect();
    let expected: Vec<f64> = expected.into_iter().filter(|&t| t < 20.0).collect();
    assert_eq!(trajectory.crossings().len(), expected.len());
    for (found, exact) in trajectory.crossings().iter().zip(expected) {
        assert!((found.t - exact).abs() < 1e-12, "{} against {exact}", found.t);
        assert!((found.state[0] - 0.3).abs() < 1e-13);
    }
}

#[test]
fn direction_selects() {
    let g = |_t: f64, u: &[f64]| u[0];
    for (direction, first) in [(Direction::Falling, 0.5 * PI), (Direction::Rising, 1.5 * PI)] {
        let (trajectory, ..) = crossings(Section { g: &g, direction, terminal: false }, 4.0 * TAU, 1e-12);
        assert_eq!(trajectory.crossings().len(), 4);
        assert!((trajectory.crossings()[0].t - first).abs() < 1e-12);
        assert!(trajectory.crossings().iter().all(|c| c.rising == (direction == Direction::Rising)));
    }
}

#[test]
fn a_start_on_the_section_is_no_crossing_and_a_return_is_found() {
    let g = |_t: f64, u: &[f64]| u[1]; // -sin t: zero at the start, falls first, then rises at pi
    let (trajectory, ..) =
        crossings(Section { g: &g, direction: Direction::Either, terminal: false }, 7.0, 1e-13);
    let times: Vec<f64> = trajectory.crossings().iter().map(|c| c.t).collect();
    assert_eq!(times.len(), 2, "{times:?}");
    assert!((times[0] - PI).abs() < 1e-12 && (times[1] - TAU).abs() < 1e-12, "{times:?}");
}

#[test]
fn a_terminal_section_ends_the_run_there() {
    let g = |_t: f64, u: &[f64]| u[0];
    let (trajectory, outcome, t) =
        crossings(Section { g: &g, direction: Direction::Falling, terminal: true }, 9.0, 1e-13);
    assert!(matches!(outcome, Outcome::Stopped { .. }));
    assert!((t - 0.5 * PI).abs() < 1e-12 && trajectory.crossings().len() == 1);
}

/// Two crossings inside one long step of a loose tolerance are both found.
#[test]
fn close_pairs_are_found() {
    let g = |_t: f64, u: &[f64]| u[0] - 0.98;
    let (trajectory, ..) =
        crossings(Section { g: &g, direction: Direction::Either, terminal: false }, TAU + 1.0, 1e-6);
    assert_eq!(trajectory.crossings().len(), 3);
}

/// Every stepper, fixed or adaptive, agrees with itself: the crossing lies where its own orbit crosses.
#[test]
fn every_stepper_locates_on_its_own_orbit() {
    struct Times(Vec<(f64, f64)>);
    impl Sink for Times {
        fn crossing(&mut self, crossing: &Crossing<'_>) {
            self.0.push((crossing.t, crossing.state[0]));
        }
    }
    let g = |_t: f64, u: &[f64]| u[0];
    for tableau in STEPPERS {
        let mut orbit =
            Orbit::new(&Oscillator, tableau, StepControl::Fixed { step: 0.01 }, 0.0, &[1.0, 0.0]).unwrap();
        let sections = [Section { g: &g, direction: Direction::Either, terminal: false }];
        let mut times = Times(vec![]);
        drive(&mut orbit, &Request { sections: &sections, ..Request::until(10.0, 2) }, &mut times).unwrap();
        assert_eq!(times.0.len(), 3, "{}", tableau.name);
        assert!(times.0.iter().all(|&(_, x)| x.abs() < 1e-13), "{}: {:?}", tableau.name, times.0);
    }
}

/// The Arenstorf orbit closes after its period: `reference/arenstorf.toml`, Hairer, Norsett, Wanner, I, (0.1)-(0.2).
#[test]
fn arenstorf_orbit_returns() {
    let reference: toml::Table = include_str!("../../../../../reference/arenstorf.toml").parse().unwrap();
    let start: Vec<f64> =
        reference["start"].as_array().unwrap().iter().map(|x| x.as_float().unwrap()).collect();
    let period = reference["period"].as_float().unwrap();
    for (tableau, rtol, tolerance) in [(&DOP853, 1e-14, 2e-8), (&DOPRI5, 1e-13, 1e-6)] {
        let control = StepControl::Adaptive { rtol, atol: 1e-14 };
        let mut orbit = Orbit::new(&Arenstorf, tableau, control, 0.0, &start).unwrap();
        drive(&mut orbit, &Request::until(period, 4), &mut ()).unwrap();
        // The orbit amplifies errors by about 1e6 over a period, so a tolerance of 1e-14 leaves about 1e-8.
        let miss = orbit.state().iter().zip(&start).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(miss < tolerance, "{}: misses by {miss:e}", tableau.name);
    }
}
