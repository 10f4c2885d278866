//! Branches of the full tensor model along kappa2 at kappa3 = 0.1, with the time they take: `cargo run --release --example branches`.

#![allow(clippy::unwrap_used, reason = "an example may fail")]

use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::symmetry::align;
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_continuation::{Branch, Point, Settings, Special, switch};
use motiform_dynamics::{Equivariant, Request, drive::drive};
use motiform_models::tensor::{Tensor, TensorParameters};
use std::time::Instant;

fn family(kappa2: f64) -> Result<Box<dyn Equivariant>> {
    Ok(Box::new(Tensor::new(&TensorParameters::full(kappa2, 0.1))))
}

fn follow(name: &str, branch: &mut Branch<'_>) -> Vec<Point> {
    let clock = Instant::now();
    let points: Vec<Point> = branch.collect();
    let time = clock.elapsed().as_secs_f64();
    println!(
        "\n{name}: {} points in {:.1} ms, {:.3} ms each",
        points.len(),
        1e3 * time,
        1e3 * time / points.len() as f64
    );
    for point in &points {
        let period = point.motion.orbit().map_or(0.0, PeriodicOrbit::period);
        if let Some(special) = &point.special {
            println!(
                "  {:.9}  period {period:.6}  unstable {}  {special:?}",
                point.parameter, point.unstable
            );
        }
    }
    let last = points.last().unwrap();
    let period = last.motion.orbit().map_or(0.0, PeriodicOrbit::period);
    println!("  last {:.9} period {period:.6}; {}", last.parameter, branch.end().unwrap());
    points
}

fn switched(name: &str, points: &[Point], which: usize, settings: &Settings) -> Vec<Point> {
    let special = points.iter().filter(|point| point.special.is_some()).nth(which).unwrap();
    let name = format!("{name} from {} at {:.6}", special.special.unwrap().name(), special.parameter);
    match switch(&family, special, settings, &()) {
        Ok(branches) => {
            let mut all = Vec::new();
            for mut branch in branches.into_iter().flatten() {
                all = follow(&name, &mut branch);
            }
            all
        }
        Err(error) => {
            println!("{name}: {error}");
            Vec::new()
        }
    }
}

fn zigzag(kappa2: f64) -> PeriodicOrbit {
    let body = family(kappa2).unwrap();
    let flow = Settings::over(0.0, 1.0).flow;
    let after = |start: &[f64], time: f64| {
        let mut orbit = flow.method.shape_orbit(body.as_ref(), flow.control, 0.0, start).unwrap();
        drive(orbit.as_mut(), &Request::until(time, 6), &mut ()).unwrap();
        orbit.state().to_vec()
    };
    let start = after(&[-0.5, 0.001, 0.0, 0.0, 0.0, 0.0], 1400.0);
    let time = 0.5 * 45.3;
    let angle = align(body.as_ref(), &after(&start, time), &start, true).angle;
    let guess = PeriodicGuess { shape: &start, time, angle, mirrored: true };
    PeriodicOrbit::find(body.as_ref(), &guess, &flow, &()).unwrap()
}

fn main() {
    let equilibria = Settings { largest_step: 0.012, ..Settings::over(0.3, 3.0) };
    let straight =
        RelativeEquilibrium::find(family(3.0).unwrap().as_ref(), &[1.0, 0.0, -0.04, 0.0, 0.0, 0.0]).unwrap();
    let points = follow(
        "straight",
        &mut Branch::of_equilibria(&family, 3.0, &straight, &equilibria.reversed(), &()).unwrap(),
    );
    let circular = switched("circular", &points, 0, &equilibria);
    let orbits = Settings::over(0.3, 1.6);
    let hopf = circular
        .iter()
        .filter(|p| p.special.is_some())
        .position(|p| matches!(p.special, Some(Special::Hopf(_))));
    if let Some(which) = hopf {
        let _ = switched("orbits", &circular, which, &orbits);
    }

    let start = zigzag(0.9);
    println!("\nzigzag at 0.9: period {:.9}", start.period());
    let up = follow("zigzag up", &mut Branch::of_orbits(&family, 0.9, &start, &orbits, &()).unwrap());
    let down =
        follow("zigzag down", &mut Branch::of_orbits(&family, 0.9, &start, &orbits.reversed(), &()).unwrap());
    let fine = Settings { largest_step: 0.0045, ..Settings::over(0.5, 1.3) };
    let some = &mut Branch::of_orbits(&family, 0.9, &start, &fine, &()).unwrap();
    let _ = follow("zigzag in short steps", some);
    let some = &mut Branch::of_orbits(&family, 0.9, &start, &fine.reversed(), &()).unwrap();
    let _ = follow("zigzag in short steps", some);
    if std::env::args().len() < 2 {
        return;
    }
    let rotating = switched("rotating zigzag", &down, 0, &orbits);
    let _ = switched("rotating zigzag", &up, 0, &orbits);
    let _ = switched("doubled", &rotating, 0, &orbits);
}
