//! The initial state of a run: given values, or a small random state.

use crate::Error;
use crate::plan::Named;
use crate::study::Study;
use motiform_dynamics::{Model, Normal};
use motiform_models::ModelInfo;

/// The complete start: if any shape value is given, the others are 0; if none is, they are drawn
/// from the study's distribution ([`Study::starts`]) by a counter-based generator. The position is `x = y = 0`
/// unless given.
pub(crate) fn resolve(study: &Study, info: &ModelInfo) -> Result<Named, Error> {
    let values = study.values()?;
    let coordinates = info.coordinates(&values);
    let given = |name: &str| study.initial.iter().find(|(known, _)| known == name).map(|entry| entry.1);
    for (name, value) in &study.initial {
        info.coordinate(&values, name)?;
        if !value.is_finite() {
            return Err(Error::Setting {
                key: "initial",
                value: format!("{name}={value}"),
                remedy: "give a finite number",
            });
        }
    }
    let draw = !coordinates.iter().any(|coordinate| given(coordinate.name).is_some());
    let random = study.starts(1)?.coordinates(info, coordinates.len(), study.run.seed, 0);
    let mut entries: Vec<(String, f64)> = Vec::new();
    for (coordinate, drawn) in coordinates.iter().zip(random) {
        let value = if draw { drawn } else { given(coordinate.name).unwrap_or(0.0) };
        entries.push((coordinate.name.to_owned(), value));
    }
    for name in ["x", "y"] {
        entries.push((name.to_owned(), given(name).unwrap_or(0.0)));
    }
    Ok(Named(entries))
}

/// A guess for Newton's method in the model's representation: each coordinate uniform in `-size..size`, from this seed and stream.
/// (Starts of
/// orbits are those of [`Study::starts`].)
pub fn random_shape(model: &dyn Model, size: f64, seed: u64, stream: u64) -> Vec<f64> {
    let mut random = Uniform::new(seed, stream);
    let coordinates: Vec<f64> = model.coordinates().iter().map(|_| size * random.draw()).collect();
    model.encoded(&coordinates)
}

/// Uniform numbers in -1..1 from ChaCha8, addressed by (seed, stream): the same on every machine.
pub struct Uniform(Normal);

impl Uniform {
    /// The stream of this number of the generator with this seed.
    pub fn new(seed: u64, stream: u64) -> Self {
        Self(Normal::new(seed, stream))
    }

    /// The next number, within -1 to 1.
    pub fn draw(&mut self) -> f64 {
        2.0 * self.0.uniform() - 1.0
    }
}
