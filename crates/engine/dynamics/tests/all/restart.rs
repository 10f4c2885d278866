//! A restarted orbit is the orbit that begins at that time and state, with any kind of stepper and step.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::StuartLandau;
use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::{DOP853, KROGSTAD4, RK4};
use motiform_dynamics::{ExponentialOrbit, Integration, Orbit, Request, StepControl};

const FROM: [f64; 2] = [0.5, 0.0];
const TO: [f64; 2] = [-0.3, 0.9];
const ADAPTIVE: StepControl = StepControl::Adaptive { rtol: 1e-12, atol: 1e-12 };

/// Three steps, a restart from [`TO`], on to t = 2.
fn restarted(orbit: &mut dyn Integration) -> Vec<f64> {
    for _ in 0..3 {
        orbit.advance(2.0).unwrap();
    }
    let t = orbit.t();
    orbit.restart(&TO);
    assert_eq!((orbit.t(), orbit.t_old(), orbit.state()), (t, t, &TO[..]));
    let mut slope = [0.0; 2];
    motiform_dynamics::VectorField::<f64>::eval(&StuartLandau, t, &TO, &mut slope);
    for (seen, want) in orbit.slope().iter().zip(slope) {
        assert!((seen - want).abs() < 1e-14); // Lambda u + N rounds in another order than f
    }
    let mut state = [0.0; 2];
    orbit.dense().at(t, &mut state);
    assert_eq!(state, TO);
    while orbit.t() < 2.0 {
        orbit.advance(2.0).unwrap();
    }
    let mut rest = Orbit::new(&StuartLandau, &DOP853, ADAPTIVE, t, &TO).unwrap();
    while rest.t() < 2.0 {
        rest.advance(2.0).unwrap();
    }
    orbit.state().iter().zip(rest.state()).map(|(a, b)| (a - b).abs()).collect()
}

#[test]
fn an_orbit_goes_on_from_the_state_given() {
    let fixed = StepControl::Fixed { step: 1e-3 };
    let mut orbits: Vec<Box<dyn Integration>> = vec![
        Box::new(Orbit::new(&StuartLandau, &DOP853, ADAPTIVE, 0.0, &FROM).unwrap()),
        Box::new(Orbit::new(&StuartLandau, &RK4, fixed, 0.0, &FROM).unwrap()),
        Box::new(ExponentialOrbit::new(&StuartLandau, &KROGSTAD4, ADAPTIVE, 0.0, &FROM).unwrap()),
        Box::new(ExponentialOrbit::new(&StuartLandau, &KROGSTAD4, fixed, 0.0, &FROM).unwrap()),
    ];
    for orbit in &mut orbits {
        // tolerances of 1e-12 per step, and (1e-3 |4 i|)^4 of the fixed fourth-order steps
        assert!(restarted(orbit.as_mut()).iter().all(|d| *d < 1e-9));
    }
}

#[test]
fn rates_that_are_known_need_no_evaluation() {
    let end = |known: bool| {
        let mut orbit = Orbit::new(&StuartLandau, &DOP853, ADAPTIVE, 0.0, &FROM).unwrap();
        orbit.advance(2.0).unwrap();
        let mut rates = [0.0; 2];
        motiform_dynamics::VectorField::<f64>::eval(&StuartLandau, orbit.t(), &TO, &mut rates);
        if known {
            orbit.restart_with(&TO, &rates);
        } else {
            orbit.restart(&TO);
        }
        while orbit.t() < 2.0 {
            orbit.advance(2.0).unwrap();
        }
        orbit.state().to_vec()
    };
    assert_eq!(end(true), end(false));
}

/// The steps of the run are those of a run that does not stop.
#[test]
fn a_run_that_stops_after_a_time_cuts_no_step_short() {
    let mut orbit = Orbit::new(&StuartLandau, &DOP853, ADAPTIVE, 0.0, &FROM).unwrap();
    let mut whole = Orbit::new(&StuartLandau, &DOP853, ADAPTIVE, 0.0, &FROM).unwrap();
    let request = Request { stop_after: 1.0, ..Request::until(5.0, 2) };
    assert!(drive(&mut orbit, &request, &mut ()).unwrap().is_complete());
    while whole.t() < 1.0 {
        whole.advance(5.0).unwrap();
    }
    assert!(orbit.t_old() < 1.0 && orbit.t() >= 1.0 && orbit.t() < 5.0);
    assert_eq!((orbit.t(), orbit.state()), (whole.t(), whole.state()));
}
