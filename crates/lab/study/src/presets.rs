//! The presets: study files that come with the program.

use crate::error::nearest_of;
use crate::{Error, Study};
use motiform_models::ModelInfo;

/// A preset: a study file of the folder `presets/`.
#[derive(Debug)]
pub struct Preset {
    /// Name on the command line.
    pub name: &'static str,
    /// Its model.
    pub model: &'static str,
    /// The study file.
    pub text: &'static str,
}

macro_rules! presets {
    ($(#[$doc:meta])* $list:ident: $($model:literal: $($name:literal),*;)*) => {
        $(#[$doc])*
        pub static $list: &[Preset] = &[$($(
            Preset {
                name: $name,
                model: $model,
                text: include_str!(concat!("../../../../presets/", $name, ".toml")),
            },
        )*)*];
    };
}

presets! {
    /// The paper's presets, in the order of its figures.
    PRESETS:
    "tensor": "fig1", "fig2", "fig3", "fig4", "fig5a", "fig5b";
    "cell": "fig6a", "fig6b", "fig6c", "fig6d";
}

presets! {
    /// Extensions from the literature, as equations given as text.
    EXTENSIONS:
    "amplitudes": "ohta-ohkuma", "chiral", "force", "elongating-field", "noisy-heading";
}

/// All presets.
fn all() -> impl Iterator<Item = &'static Preset> {
    PRESETS.iter().chain(EXTENSIONS)
}

/// The study of a preset of any model.
///
/// # Errors
/// [`Error::UnknownPreset`] with the nearest name, for the model of this name.
pub fn find_any(name: &str, model: &'static str) -> Result<Study, Error> {
    match all().find(|preset| preset.name == name) {
        Some(preset) => Study::parse(preset.text, &format!("preset {name}"), name),
        None => Err(unknown(name, model)),
    }
}

/// A model by its name alone, where it might have been a preset of any model or a file.
///
/// # Errors
/// [`Error::UnknownSubject`] with the nearest name.
pub fn model_or_nearest(name: &str) -> Result<&'static ModelInfo, Error> {
    ModelInfo::find(name).map_err(|error| {
        let motiform_models::Error::UnknownModel { known: models, .. } = error else { return error.into() };
        let presets: Vec<&'static str> = all().map(|preset| preset.name).collect();
        let both: Vec<&'static str> = models.iter().chain(&presets).copied().collect();
        Error::UnknownSubject { name: name.to_owned(), nearest: nearest_of(name, &both), models, presets }
    })
}

/// The names of a model's presets.
pub fn names_of(model: &str) -> Vec<&'static str> {
    all().filter(|preset| preset.model == model).map(|preset| preset.name).collect()
}

fn unknown(name: &str, model: &'static str) -> Error {
    let known = names_of(model);
    Error::UnknownPreset { name: name.to_owned(), model, nearest: nearest_of(name, &known), known }
}

/// The study of a preset.
///
/// # Errors
/// [`Error::UnknownPreset`] with the nearest name.
pub fn find(info: &'static ModelInfo, name: &str) -> Result<Study, Error> {
    let preset = all().find(|preset| preset.model == info.name && preset.name == name);
    let preset = preset.ok_or_else(|| unknown(name, info.name))?;
    Study::parse(preset.text, &format!("preset {name}"), name)
}

/// Returns `true` if a text is the title or the sentence of one of a model's presets.
pub(crate) fn says(model: &str, text: &str) -> bool {
    let theirs = |preset: &&'static Preset| preset.model == model;
    let says = |preset: &Preset| {
        Study::parse(preset.text, preset.name, preset.name)
            .is_ok_and(|study| study.title == text || study.about == text)
    };
    all().filter(theirs).any(says)
}
