//! The subject of a command: a file or a model, a preset, then the options.

use crate::args::{MethodOptions, MotionOptions, ParameterOptions, SamplesOptions, SubjectOptions};
use crate::commands::remarks::remark;
use crate::output::warn;
use motiform_lab::samples::Samples;
use motiform_models::ModelInfo;
use motiform_models::amplitudes::NAME;
use motiform_study::presets::{self, Preset};
use motiform_study::{Error, Random, RunPlan, Study};
use std::path::Path;

/// The study of a command about one motion.
pub(crate) fn motion(options: &MotionOptions) -> Result<Study, Error> {
    let mut study = study(&options.subject)?;
    note_noise(&mut study);
    apply(&options.method, &mut study)?;
    remark(&study, &[])?;
    Ok(study)
}

/// The plan of a study for the analysis of one motion, and the samples if there are several.
pub(crate) fn plan(mut study: Study, many: &SamplesOptions) -> Result<(RunPlan, Option<Samples>), Error> {
    let random = study.starts(many.samples.map_or(1, u64::from))?;
    study.random = Some(random); // the first of many is drawn like the others
    let plan = RunPlan::new(&study)?;
    let samples = samples(many, &study, random);
    Ok((plan, samples))
}

/// Several initial states of a study's model, if requested.
fn samples(options: &SamplesOptions, study: &Study, random: Random) -> Option<Samples> {
    let count = options.samples? as usize;
    let given = study.initial.iter().any(|(name, _)| !["x", "y"].contains(&name.as_str()));
    Some(Samples { count, random, given, threads: options.threads.count() })
}

/// Leaves out the noise of a study, and says so: the answer of an analysis is that of the equations alone.
pub(crate) fn note_noise(study: &mut Study) {
    if study.run.largest_noise() > 0.0 {
        study.run.silence();
        warn("the noise of the study is left out here: the answer is that of the equations without it");
    }
    if study.model.definition().is_some_and(|definition| !definition.noise.is_empty()) {
        warn("the noise of the equations is left out here: the answer is that of the equations without it");
    }
}

/// Applies the options of initial state and method to a study.
pub(crate) fn apply(options: &MethodOptions, study: &mut Study) -> Result<(), Error> {
    for (name, value) in &options.initial {
        study.set_initial(name, *value)?;
    }
    study.random = options.random.or(study.random);
    options.run.apply(&mut study.run)
}

/// The study of a model's name or a study file, or of a preset of any model, with parameters.
pub(crate) fn study(options: &SubjectOptions) -> Result<Study, Error> {
    let SubjectOptions { subject, preset, parameters } = options;
    let Some(subject) = subject else {
        return with(of_preset(preset.as_deref().unwrap_or_default())?, parameters);
    };
    let path = Path::new(subject);
    let study = if path.extension().is_some_and(|extension| extension == "toml") {
        if let Some(name) = preset {
            return Err(Error::Setting {
                key: "--preset",
                value: name.to_owned(),
                remedy: "a study file sets its own preset: write preset = \"...\" in the file",
            });
        }
        Study::read(path)?
    } else {
        if let (NAME, Some(name)) = (subject.as_str(), preset) {
            return with(presets::find_any(name, NAME)?, parameters);
        }
        if let (Some(named), None) = (find_preset(subject), preset) {
            return with(presets::find_any(named.name, named.model)?, parameters);
        }
        match preset {
            Some(name) => presets::find(ModelInfo::find(subject)?, name)?,
            None => Study::of_model(presets::model_or_nearest(subject)?),
        }
    };
    with(study, parameters)
}

/// The study of a preset, whatever its model.
fn of_preset(name: &str) -> Result<Study, Error> {
    match find_preset(name) {
        Some(preset) => presets::find_any(name, preset.model),
        None => Err(Error::Setting {
            key: "--preset",
            value: name.to_owned(),
            remedy: "no model has such a preset; `motiform models` lists them",
        }),
    }
}

/// The preset of this name, whatever its model.
pub(crate) fn find_preset(name: &str) -> Option<&'static Preset> {
    presets::PRESETS.iter().chain(presets::EXTENSIONS).find(|preset| preset.name == name)
}

/// The study with these parameters.
fn with(mut study: Study, parameters: &ParameterOptions) -> Result<Study, Error> {
    put(parameters, &mut study)?;
    Ok(study)
}

/// Gives a study these parameters.
pub(crate) fn put(parameters: &ParameterOptions, study: &mut Study) -> Result<(), Error> {
    for (name, formula) in &parameters.ties {
        study.tie(name, formula)?;
    }
    study.set_all(parameters.set.iter().map(|(name, value)| (name.as_str(), *value)))
}
