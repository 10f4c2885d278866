//! A fit as a study file.

use super::Fitted;
use crate::Result;
use crate::regime::begin;
use motiform_models::amplitudes::info;
use motiform_study::Study;
use motiform_study::scan::Axis;

/// Samples of the explorer in a natural time.
const SAMPLES: f64 = 20.0;
/// Natural times that the explorer shows in a second.
const PER_SECOND: f64 = 3.0;

impl Fitted {
    /// The model as a study, in the units of the data, with its noise, from a state of the cell where its motion was looked at. It is drawn
    /// with the radius of the cell, and shown at a speed that suits its rates.
    ///
    /// # Errors
    /// Equations that are no model.
    pub fn study(&self, cell: &str, radius: f64) -> Result<Study> {
        let fit = self.model();
        let info = info(&fit.definition())
            .map_err(|error| motiform_models::Error::Equations { problem: error.to_string() })
            .map_err(motiform_study::Error::from)?;
        let mut study = Study::of_model(info);
        if let Some(found) = &self.regime {
            let sizes = fit.scales.amplitudes.iter().flat_map(|size| [size; 2]);
            let start = found.start.iter().zip(sizes).map(|(own, size)| rounded(own * size));
            begin(&mut study, start)?;
        }
        study.title = format!("Cell {cell}");
        study.about = format!(
            "Fitted by maximum likelihood to {} steps from frame to frame; lengths and times in the units of the data.",
            fit.frames
        );
        study.display.plane = plane(&study);
        study.figure.radius = radius;
        study.display.sample = two_digits(fit.scales.time / SAMPLES);
        study.display.speed = two_digits(fit.scales.time * PER_SECOND);
        study.run.noise = fit.noise.eta_shape.value;
        study.run.noise_velocity = Some(fit.noise.eta_v.value);
        Ok(study)
    }
}

/// The plane about the cell: kappa2 with kappa3 or gamma, as in the paper's diagrams, each from 0 to twice its value; that of the model
/// where it has none of these.
fn plane(study: &Study) -> Vec<Axis> {
    let named = |name: &str| {
        let place = study.info().ok()?.parameters().iter().position(|spec| spec.name == name)?;
        study.values().ok()?.get(place).copied()
    };
    let side = |name: &str| {
        let value = named(name).filter(|value| *value != 0.0)?;
        let ends = [0.0, two_digits(2.0 * value)];
        Some(Axis { name: name.to_owned(), values: vec![ends[0].min(ends[1]), ends[0].max(ends[1])] })
    };
    let sides = [side("kappa2"), side("kappa3").or_else(|| side("gamma"))];
    match sides {
        [Some(x), Some(y)] => vec![x, y],
        _ => study.display.plane.clone(),
    }
}

/// A number with five digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.4e}").parse().unwrap_or(x)
}

/// A number with two digits.
fn two_digits(x: f64) -> f64 {
    format!("{x:.1e}").parse().unwrap_or(x)
}
