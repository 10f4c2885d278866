//! The active cell model: lengths and starts as in `cell.py`.

use crate::options::Options;
use motiform_dynamics::ensemble::{StiffMember, StiffPropagation, propagate_stiff};
use motiform_dynamics::simd::InstructionSet;
use motiform_dynamics::steppers;
use motiform_models::cell::{CellField, CellParameters};
use serde_json::{Value, json};
use std::time::Instant;

type Failure = Box<dyn std::error::Error>;

pub fn cell(options: &Options) -> Result<Value, Failure> {
    let (count, modes) = (options.get("members", 64)?, options.get("modes", 42)?);
    let (step, steps) = (options.get("step", 0.02)?, options.get("steps", 2000_u64)?);
    let (low, high) = (options.get("length_low", 21.0)?, options.get("length_high", 21.9)?);
    let how = StiffPropagation {
        method: steppers::find_exponential(options.word("method", "etdrk4")).ok_or("no such method")?,
        step,
        arithmetic: options.arithmetic()?,
        instructions: instructions(options.word("set", ""))?,
        escape_norm: 1e6,
        threads: options.get("threads", 1)?,
    };
    let member = |i: usize| {
        let length = low + (high - low) * i as f64 / (count - 1).max(1) as f64;
        let mut start = vec![0.0; 2 * modes];
        let size = 1.0 + 0.1 * (1.0 + 0.7 * i as f64).sin();
        (start[0], start[3], start[4]) = (0.05 * size, -0.05 * size, 0.025 * size);
        let field = CellField::new(&CellParameters { length, ..CellParameters::default() }, modes);
        StiffMember { field, start, t_end: step * steps as f64 }
    };
    let members: Vec<_> = (0..count).map(member).collect();
    let clock = Instant::now();
    let ends = propagate_stiff(&members, &how)?;
    let seconds = clock.elapsed().as_secs_f64();
    if let Some(end) = ends.iter().find(|end| !end.outcome.is_complete()) {
        return Err(format!("a member did not arrive: {}", end.outcome).into());
    }
    let work: u64 = ends.iter().map(|end| end.steps).sum();
    let check: Vec<_> = ends.iter().take(8).map(|end| &end.u[..6]).collect();
    Ok(json!({ "seconds": seconds, "work": work, "check": check }))
}

/// The instruction set of this name; the widest one for none.
fn instructions(name: &str) -> Result<InstructionSet, Failure> {
    match name {
        "" => Ok(InstructionSet::widest()),
        "portable" => Ok(InstructionSet::Portable),
        "avx2" => Ok(InstructionSet::Avx2),
        "avx512" => Ok(InstructionSet::Avx512),
        other => Err(format!("no instruction set {other:?}: portable, avx2, avx512").into()),
    }
}
