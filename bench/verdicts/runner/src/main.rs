//! Names motions as `motiform classify` does: one JSON object per line in, one out.
//!
//! In: `{"id": .., "model": "tensor", "parameters": {"kappa2": ..}, "start": {"v1": ..}}`; parameters left out have their
//! defaults, coordinates left out are 0. Out: `{"id": .., "verdict": {..}}` or `{"id": .., "error": ".."}`.

use motiform_analysis::{Settings, classify};
use motiform_dynamics::StepControl;
use motiform_dynamics::steppers::Method;
use motiform_models::ModelInfo;
use serde_json::{Map, Value, json};
use std::error::Error;
use std::io::{BufRead, Write};

fn main() -> Result<(), Box<dyn Error>> {
    let mut out = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let case: Value = serde_json::from_str(&line?)?;
        let answer = match named(&case) {
            Ok(verdict) => json!({ "id": case["id"], "verdict": verdict }),
            Err(error) => json!({ "id": case["id"], "error": error.to_string() }),
        };
        writeln!(out, "{answer}")?;
        out.flush()?;
    }
    Ok(())
}

fn named(case: &Value) -> Result<Value, Box<dyn Error>> {
    let info = ModelInfo::find(case["model"].as_str().ok_or("no model")?)?;
    let given = numbers(&case["parameters"])?;
    let mut values: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
    for (name, value) in given {
        let at = info.parameters().iter().position(|spec| spec.name == name);
        values[at.ok_or_else(|| format!("no parameter {name}"))?] = value;
    }
    let model = info.build(&values)?;
    let mut coordinates = vec![0.0; model.dim()];
    for (name, value) in numbers(&case["start"])? {
        coordinates[info.coordinate(&values, &name)?] = value;
    }
    let mut shape = vec![0.0; model.dim()];
    model.encode(&coordinates, &mut shape);
    let verdict = classify(model.as_ref(), &shape, &settings(info)?, &mut ())?;
    Ok(serde_json::to_value(verdict)?)
}

fn numbers(object: &Value) -> Result<Vec<(String, f64)>, Box<dyn Error>> {
    let empty = Map::new();
    let entries = object.as_object().unwrap_or(&empty).iter();
    entries.map(|(name, x)| Ok((name.clone(), x.as_f64().ok_or("not a number")?))).collect()
}

/// The defaults of `motiform classify`.
fn settings(info: &ModelInfo) -> Result<Settings, Box<dyn Error>> {
    let (rtol, atol) = (info.rtol, info.absolute_tolerance(info.rtol));
    Ok(Settings {
        method: Method::find(info.stepper).ok_or("no stepper")?,
        control: StepControl::Adaptive { rtol, atol },
        first_look: info.look,
        budget: info.budget,
        escape_norm: 1e6,
        max_steps: 100_000_000,
    })
}
