//! The initial data of the page: the registry, and for each preset its initial map and speed.

use crate::protocol::{Registry, SectionKind};
use motiform_lab::registry;
use motiform_models::ModelInfo;
use motiform_study::scan::Axis;
use motiform_study::study::{DisplaySettings, ReturnMapSettings};
use motiform_study::{Error, Study, presets};
use serde_json::{Value, json};

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
        let display = DisplaySettings::of_model(ModelInfo::find(&name)?);
        model["plane"] = plane(&display.plane);
    }
    for preset in list(&mut all, "presets") {
        let name = preset["name"].as_str().unwrap_or_default().to_owned();
        let model = preset["model"].as_str().unwrap_or_default();
        let study = presets::find(ModelInfo::find(model)?, &name)?;
        let kind = section(study.return_map.as_ref());
        preset["speed"] = json!(study.display.speed);
        preset["plane"] = plane(&study.display.plane);
        preset["section"] = json!(if kind == SectionKind::Path { "path" } else { "speed" });
    }
    serde_json::from_value(all)
        .map_err(|error| Error::unreadable(std::path::Path::new("the registry"), error))
}

/// The entries of a list of the registry.
fn list<'v>(all: &'v mut Value, key: &str) -> impl Iterator<Item = &'v mut Value> {
    all[key].as_array_mut().into_iter().flatten()
}

fn plane(sides: &[Axis]) -> Value {
    let side = |axis: &Axis| json!({ "name": axis.name, "low": axis.values[0], "high": axis.values[1] });
    json!({ "x": sides.first().map(side), "y": sides.get(1).map(side) })
}

/// The study of a preset, or of a model with its defaults.
pub(crate) fn study(model: &str, preset: Option<&str>) -> Result<Study, Error> {
    let info = ModelInfo::find(model)?;
    let mut study = match preset {
        Some(name) => presets::find(info, name)?,
        None => Study::of_model(info),
    };
    study.run.dt_out = study.display.sample;
    Ok(study)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    /// The registry marks exactly those parameters as whole numbers whose fractions the model rejects.
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
