//! What a command is about: a file or a model, a preset, then what is set by hand.

use motiform_models::ModelInfo;
use motiform_study::{Error, Study, presets};
use std::path::Path;

/// The study of a model's name or a study file, with a preset and parameters.
pub(crate) fn study(subject: &str, preset: Option<&str>, set: &[(String, f64)]) -> Result<Study, Error> {
    let path = Path::new(subject);
    let mut study = if path.extension().is_some_and(|extension| extension == "toml") {
        if let Some(name) = preset {
            return Err(Error::Setting {
                key: "--preset",
                value: name.to_owned(),
                remedy: "a study file names its own preset: write preset = \"...\" in it",
            });
        }
        Study::read(path)?
    } else {
        let info = ModelInfo::find(subject)?;
        match preset {
            Some(name) => presets::find(info, name)?,
            None => Study::of_model(info),
        }
    };
    for (name, value) in set {
        study.set(name, *value)?;
    }
    Ok(study)
}
