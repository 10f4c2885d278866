//! The initial data of the page: the registry, and for each preset its map window and speed.

use crate::protocol::{Registry, SectionKind};
use motiform_lab::registry;
use motiform_models::ModelInfo;
use motiform_study::study::ReturnMapSettings;
use motiform_study::{Error, Study, presets};
use serde_json::{Value, json};

/// A side of a plane of parameters: name, low, high.
type Side = (&'static str, f64, f64);

/// The initial display of a preset.
struct Showing {
    name: &'static str,
    /// Model time between samples.
    sample: f64,
    /// Model time per second.
    speed: f64,
    plane: (Side, Option<Side>),
}

/// The planes of the paper: Fig. 1, Fig. 4, and the windows of lengths of Fig. 6.
const REDUCED: (Side, Option<Side>) = (("kappa2", -0.22, 0.22), Some(("gamma", -0.16, 0.12)));
const FULL: (Side, Option<Side>) = (("kappa2", 0.05, 1.65), Some(("kappa3", 0.05, 1.05)));
const LENGTHS: (Side, Option<Side>) = (("length", 6.0, 32.0), None);

const SHOWINGS: [Showing; 12] = [
    showing("fig1", 0.25, 40.0, REDUCED),
    showing("fig2", 0.25, 60.0, REDUCED),
    showing("fig3", 0.5, 90.0, REDUCED),
    showing("fig4", 0.05, 8.0, FULL),
    showing("fig5a", 0.05, 8.0, FULL),
    showing("fig5b", 0.05, 8.0, FULL),
    showing("fig6a", 0.5, 80.0, LENGTHS),
    showing("fig6b", 0.5, 80.0, LENGTHS),
    showing("fig6c", 0.5, 80.0, LENGTHS),
    showing("fig6d", 0.5, 80.0, LENGTHS),
    // models without a preset
    showing("tensor", 0.05, 5.0, FULL),
    showing("cell", 0.5, 80.0, LENGTHS),
];

const fn showing(name: &'static str, sample: f64, speed: f64, plane: (Side, Option<Side>)) -> Showing {
    Showing { name, sample, speed, plane }
}

/// The speed at which a body is shown, in model time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tempo {
    /// Between samples.
    pub(crate) sample: f64,
    /// Per second, at first.
    pub(crate) speed: f64,
    /// Per second, at least and at most.
    pub(crate) speeds: [f64; 2],
}

/// Samples per second at the highest speed that the page offers: 50 in each of 60 pictures.
const MOST_SAMPLES: f64 = 3000.0;

/// The speed of a preset or a model.
pub(crate) fn tempo(name: &str) -> Tempo {
    let known = SHOWINGS.iter().find(|showing| showing.name == name);
    let (sample, speed) = known.map_or((0.05, 5.0), |showing| (showing.sample, showing.speed));
    Tempo { sample, speed, speeds: [2.0 * sample, MOST_SAMPLES * sample] }
}

/// The initial section of a preset's return map: through the path, if the preset has one. Its height is by default that of the
/// centre of the path: the paper's line for Fig. 3, `y = 3`, lies near the rim of the annulus, and misses some turns.
pub(crate) fn section(settings: Option<&ReturnMapSettings>) -> SectionKind {
    settings.map_or(SectionKind::Speed, |_| SectionKind::Path)
}

/// The registry of the library, with additional data for the page.
///
/// # Errors
/// A preset or a model that fails its own checks.
pub(crate) fn registry() -> Result<Registry, Error> {
    let mut all = registry::registry()?;
    for model in list(&mut all, "models") {
        let name = model["name"].as_str().unwrap_or_default().to_owned();
        model["plane"] = plane(&name);
    }
    for preset in list(&mut all, "presets") {
        let name = preset["name"].as_str().unwrap_or_default().to_owned();
        let model = preset["model"].as_str().unwrap_or_default();
        let study = presets::find(ModelInfo::find(model)?, &name)?;
        let kind = section(study.return_map.as_ref());
        preset["speed"] = json!(tempo(&name).speed);
        preset["plane"] = plane(&name);
        preset["section"] = json!(if kind == SectionKind::Path { "path" } else { "speed" });
    }
    serde_json::from_value(all)
        .map_err(|error| Error::unreadable(std::path::Path::new("the registry"), error))
}

/// The entries of a list of the registry.
fn list<'v>(all: &'v mut Value, key: &str) -> impl Iterator<Item = &'v mut Value> {
    all[key].as_array_mut().into_iter().flatten()
}

fn plane(name: &str) -> Value {
    let side = |(name, low, high): Side| json!({ "name": name, "low": low, "high": high });
    SHOWINGS
        .iter()
        .find(|showing| showing.name == name)
        .map_or(Value::Null, |showing| json!({ "x": side(showing.plane.0), "y": showing.plane.1.map(side) }))
}

/// The study of a preset, or of a model with its defaults.
pub(crate) fn study(model: &str, preset: Option<&str>) -> Result<Study, Error> {
    let info = ModelInfo::find(model)?;
    let mut study = match preset {
        Some(name) => presets::find(info, name)?,
        None => Study::of_model(info),
    };
    let tempo = tempo(preset.unwrap_or(model));
    study.run.dt_out = tempo.sample;
    Ok(study)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use motiform_models::MODELS;

    #[test]
    fn every_preset_and_model_has_its_showing() {
        let names = presets::PRESETS.iter().map(|preset| (preset.model, preset.name));
        for (model, name) in names.chain(MODELS.iter().map(|info| (info.name, info.name))) {
            let showing = SHOWINGS.iter().find(|showing| showing.name == name).unwrap();
            let tempo = tempo(name);
            assert!(tempo.speeds[0] < tempo.speed && tempo.speed < tempo.speeds[1], "{name}");
            let info = ModelInfo::find(model).unwrap();
            for (side, low, high) in [Some(showing.plane.0), showing.plane.1].into_iter().flatten() {
                let spec = info.parameters().iter().find(|spec| spec.name == side).unwrap();
                assert!(spec.allowed.0 <= low && low < high && high <= spec.allowed.1, "{name} {side}");
            }
        }
    }

    /// The registry marks exactly those parameters as whole numbers whose fractions the model refuses.
    #[test]
    fn whole_numbers_are_known() {
        for model in registry().unwrap().models {
            let info = ModelInfo::find(&model.name).unwrap();
            let defaults: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
            for (place, parameter) in model.parameters.iter().enumerate() {
                let mut values = defaults.clone();
                values[place] += if values[place] > 0.5 { -0.25 } else { 0.25 };
                let refused = info.build(&values).is_err();
                assert_eq!(parameter.whole, refused, "{}", parameter.name);
            }
        }
    }
}
