//! One orbit of the active cell model at a fixed step: what `bench/cell` times and compares.
//!
//! Usage: `cell_orbit STEPPER LENGTH MODES STEP STEPS [position]`. Prints seconds of the stepping loop, then the modes.

use motiform_dynamics::steppers::find_exponential;
use motiform_dynamics::{ExponentialOrbit, Integration, StepControl, System};
use motiform_models::cell::{Cell, CellParameters};
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args: Vec<String> = std::env::args().collect();
    let [_, stepper, length, modes, step, steps, rest @ ..] = &args[..] else {
        return Err("usage: cell_orbit STEPPER LENGTH MODES STEP STEPS [position]".into());
    };
    let stepper = find_exponential(stepper).ok_or("the steppers are ifrk4, etdrk4, krogstad4")?;
    let parameters = CellParameters { length: length.parse()?, modes: modes.parse()?, ..Default::default() };
    let (step, steps): (f64, u32) = (step.parse()?, steps.parse()?);
    let cell = Cell::new(&parameters)?;
    let mut start = vec![0.0; cell.dim()];
    // phi = 0.1 cos(k s) + 0.1 sin(2 k s) + 0.05 cos(3 k s)
    (start[0], start[3], start[4]) = (0.05, -0.05, 0.025);
    let control = StepControl::Fixed { step };
    let mut orbit = if rest.is_empty() {
        ExponentialOrbit::new(&cell, stepper, control, 0.0, &start)?
    } else {
        start.extend([0.0; 2]);
        ExponentialOrbit::in_plane(&cell, stepper, control, 0.0, &start)?
    };
    let clock = Instant::now();
    for _ in 0..steps {
        orbit.advance(f64::INFINITY).map_err(|failure| format!("{failure:?} at t = {}", orbit.t()))?;
    }
    println!("{:?}", clock.elapsed().as_secs_f64());
    for x in orbit.state() {
        println!("{x:?}");
    }
    Ok(())
}
