//! One orbit of the active cell model at a fixed step: what `bench/cell` times and compares; or with error control.
//!
//! Usage: `cell_orbit STEPPER LENGTH MODES STEP STEPS [position]` for fixed steps, or
//! `cell_orbit STEPPER LENGTH MODES rtol=R TIME [position]` with error control (absolute tolerance R/10).
//! It prints the seconds that the stepping loop took, then the modes; with error control, the numbers of
//! accepted and rejected steps go to standard error.

use motiform_dynamics::steppers::find_exponential;
use motiform_dynamics::{ExponentialOrbit, Integration, StepControl, System};
use motiform_models::cell::{Cell, CellParameters};
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args: Vec<String> = std::env::args().collect();
    let [_, stepper, length, modes, step, steps, rest @ ..] = &args[..] else {
        return Err("usage: cell_orbit STEPPER LENGTH MODES STEP STEPS [position]".into());
    };
    let stepper = find_exponential(stepper).ok_or("the steppers are ifrk4, etdrk4, hochbruck4, krogstad4")?;
    let parameters = CellParameters { length: length.parse()?, modes: modes.parse()?, ..Default::default() };
    let (control, steps, end) = match step.strip_prefix("rtol=") {
        Some(rtol) => {
            let rtol: f64 = rtol.parse()?;
            (StepControl::Adaptive { rtol, atol: 0.1 * rtol }, u32::MAX, steps.parse()?)
        }
        None => (StepControl::Fixed { step: step.parse()? }, steps.parse()?, f64::INFINITY),
    };
    let cell = Cell::new(&parameters)?;
    let mut start = vec![0.0; cell.dim()];
    // phi = 0.1 cos(k s) + 0.1 sin(2 k s) + 0.05 cos(3 k s)
    (start[0], start[3], start[4]) = (0.05, -0.05, 0.025);
    let mut orbit = if rest.is_empty() {
        ExponentialOrbit::new(&cell, stepper, control, 0.0, &start)?
    } else {
        start.extend([0.0; 2]);
        ExponentialOrbit::in_plane(&cell, stepper, control, 0.0, &start)?
    };
    let clock = Instant::now();
    for _ in 0..steps {
        orbit.advance(end).map_err(|failure| format!("{failure:?} at t = {}", orbit.t()))?;
        if orbit.t() >= end {
            break;
        }
    }
    println!("{:?}", clock.elapsed().as_secs_f64());
    if end.is_finite() {
        eprintln!("{} steps, {} rejected", orbit.counters().steps, orbit.counters().rejected);
    }
    for x in orbit.state() {
        println!("{x:?}");
    }
    Ok(())
}
