//! The path of a body on the motions of branches, against the flow in the plane.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{full, near, reduced};
use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::symmetry::align;
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_continuation::{Branch, Motion, OrbitPath, Settings, path, switch};
use motiform_dynamics::{Equivariant, InPlane, Request, drive::drive};
use motiform_models::tensor::reduced::Reduced;

fn family(kappa2: f64) -> Result<Box<dyn Equivariant>> {
    Ok(Box::new(full(kappa2, 0.1)))
}

/// The position after `time`, by one run of the whole body.
fn place_after(body: &dyn Equivariant, shape: &[f64], time: f64, settings: &Settings) -> [f64; 2] {
    let (plane, state) = (InPlane(body), [shape, &[0.0; 2]].concat());
    let flow = settings.flow;
    let mut orbit = flow.method.shape_orbit(&plane, flow.control, 0.0, &state).unwrap();
    drive(orbit.as_mut(), &Request::until(time, state.len()), &mut ()).unwrap();
    let [.., x, y] = orbit.state() else { unreachable!() };
    [*x, *y]
}

fn zigzag(settings: &Settings) -> PeriodicOrbit {
    let body = full(0.9, 0.1);
    let after = |start: &[f64], time: f64| {
        let mut orbit = settings.flow.method.shape_orbit(&body, settings.flow.control, 0.0, start).unwrap();
        drive(orbit.as_mut(), &Request::until(time, 6), &mut ()).unwrap();
        orbit.state().to_vec()
    };
    let start = after(&[-0.5, 0.001, 0.0, 0.0, 0.0, 0.0], 1400.0);
    let time = 0.5 * 45.3;
    let angle = align(&body, &after(&start, time), &start, true).angle;
    let guess = PeriodicGuess { shape: &start, time, angle, mirrored: true };
    PeriodicOrbit::find(&body, &guess, &settings.flow, &()).unwrap()
}

/// Every tenth point, against a run of the same body: a stable one, over whole periods. (1e-7: the run's own error grows on the way.)
fn compare(body: &dyn Equivariant, motion: &Motion, found: &OrbitPath, settings: &Settings) {
    let steps = found.points.len() - 1;
    for k in (0..=steps).step_by(10) {
        let time = found.time * k as f64 / steps as f64;
        let place = place_after(body, motion.shape(), time, settings);
        for axis in 0..2 {
            near(found.points[k][axis], place[axis], 1e-7);
        }
    }
    // the next period is this one, turned
    let [end, next] = [steps / 4, steps].map(|k| (found.points[k], found.time * k as f64 / steps as f64));
    let place = place_after(body, motion.shape(), found.time + end.1, settings);
    let (sine, cosine) = found.rotation.sin_cos();
    let [x, y] = end.0;
    near(place[0], next.0[0] + cosine * x - sine * y, 1e-7);
    near(place[1], next.0[1] + sine * x + cosine * y, 1e-7);
}

#[test]
fn a_zigzag_and_a_rotating_one_go_where_the_flow_takes_them() {
    let settings = Settings::over(0.7, 1.6);
    let start = zigzag(&settings);
    let mut branch = Branch::of_orbits(&family, 0.9, &start, &settings.reversed(), &()).unwrap();
    let first = branch.next().unwrap();
    let body = family(first.parameter).unwrap();
    let found = path(body.as_ref(), &first.motion, &settings.flow, &()).unwrap();
    near(found.time, first.motion.orbit().unwrap().period(), 1e-12);
    assert_eq!(found.rotation, 0.0, "a zigzag goes straight on");
    compare(body.as_ref(), &first.motion, &found, &settings);

    let breaking = branch.find(|point| point.special.is_some()).unwrap();
    let rotating =
        switch(&family, &breaking, &settings, &()).unwrap().pop().unwrap().pop().unwrap().nth(4).unwrap();
    let body = family(rotating.parameter).unwrap();
    let found = path(body.as_ref(), &rotating.motion, &settings.flow, &()).unwrap();
    assert!(found.rotation != 0.0);
    compare(body.as_ref(), &rotating.motion, &found, &settings);
}

#[test]
fn steady_motions_are_circles_and_straight_lines() {
    let settings = Settings::over(-0.1, 0.1);
    let circular = Reduced::PAPER.circular(-0.06, 0.05).unwrap();
    let sine = (1.0 - circular.cos_psi * circular.cos_psi).sqrt();
    let guess = [circular.speed, 0.0, circular.r2 * circular.cos_psi, circular.r2 * sine, 0.0, 0.0];
    let body = reduced(-0.06, 0.05);
    let mut start = RelativeEquilibrium::find(&body, &guess).unwrap();
    assert!(start.turning_rate != 0.0);
    let motion = Motion::Equilibrium(start.clone());
    let found = path(&body, &motion, &settings.flow, &()).unwrap();
    let half = found.points.len() / 2;
    let time = found.time * half as f64 / (found.points.len() - 1) as f64;
    let place = place_after(&body, motion.shape(), time, &settings);
    near(found.points[half][0], place[0], 1e-7);
    near(found.points[half][1], place[1], 1e-7);
    near(found.rotation, start.turning_rate * found.time, 1e-12);

    (start.turning_rate, start.velocity) = (0.0, [0.5, -0.25]);
    let found = path(&body, &Motion::Equilibrium(start), &settings.flow, &()).unwrap();
    assert_eq!((found.time, found.rotation), (100.0, 0.0));
    assert_eq!(found.points.last(), Some(&[50.0, -25.0]));
}

#[test]
fn an_orbit_without_its_nodes_has_no_path() {
    let settings = Settings::over(0.7, 1.6);
    let orbit = zigzag(&settings);
    let motion = Motion::Orbit { orbit, nodes: Vec::new() };
    assert_eq!(path(&full(0.9, 0.1), &motion, &settings.flow, &()), None);
}
