//! Adaptive steps near an unstable shape: a deviation far below the tolerance grows at the shape's own rate.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Random, cell, named, near, settings};
use motiform_analysis::{Regime, RelativeEquilibrium};
use motiform_dynamics::{Request, drive::drive};

/// A two-fold shape of the cell, whose departure oscillates with a growth rate of .005 and a frequency of .083. The adaptive steps are
/// not limited by their error there.
#[test]
fn a_small_deviation_from_an_unstable_cell_grows_at_its_rate() {
    let body = cell(21.0, 21);
    let settings = settings("cell");
    let mut orbit =
        settings.method.shape_orbit(&body, settings.control, 0.0, &Random(5).state(42, 0.01)).unwrap();
    // the first rest is near the shape
    drive(orbit.as_mut(), &Request::until(2000.0, 42), &mut ()).unwrap();
    let shape = RelativeEquilibrium::find(&body, orbit.state()).unwrap();
    let (growth, frequency) = shape.eigenvalues[0];
    assert!(growth > 0.004 && frequency > 0.08, "{:?}", shape.eigenvalues);

    let mut start = shape.shape.clone();
    start.iter_mut().zip(Random(9).state(42, 1e-9)).for_each(|(x, kick)| *x += kick);
    let mut orbit = settings.method.shape_orbit(&body, settings.control, 0.0, &start).unwrap();
    let mut largest = [0.0_f64; 2]; // over a period of the oscillation, early and late
    let (early, late, period) = (500.0, 1500.0, std::f64::consts::TAU / frequency);
    for (place, from) in [early, late].into_iter().enumerate() {
        for part in 0..40 {
            let t = from + period * f64::from(part) / 40.0;
            drive(orbit.as_mut(), &Request::until(t, 42), &mut ()).unwrap();
            largest[place] = largest[place].max(shape.distance(&body, orbit.state()));
        }
    }
    let seen = (largest[1] / largest[0]).ln() / (late - early);
    println!("{seen} {growth} {largest:?}");
    // fixed steps of 1 err by 5e-5, of .1 by 8e-5 (the kick leaves the linear range)
    near(seen, growth, 1e-4);
}

/// Rests of some 5000 time units between 90-degree turns; the saddles have a complex pair of growing directions.
#[test]
fn turns_between_shapes_whose_departure_oscillates_are_rectangular_motion() {
    let verdict = named(&cell(21.0, 21), &Random(5).state(42, 0.01), &settings("cell"));
    println!("{} ({:?}) {}, rests {:?}", verdict.regime, verdict.margin, verdict.why, verdict.rests);
    assert_eq!(verdict.regime, Regime::Rectangular, "{}", verdict.why);
    let saddle = verdict.saddle.unwrap();
    assert!(saddle.out > 0.0 && saddle.out + saddle.inward < 0.0);
    assert!(!verdict.legs.is_empty());
    assert!(verdict.legs.iter().all(|turn| (turn.abs() - std::f64::consts::FRAC_PI_2).abs() < 1e-3));
}
