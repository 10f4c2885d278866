//! The subjects that a body can begin with: models, presets, extensions from the literature, a study file,
//! and equations from the page.

use crate::TrackedCell;
use crate::protocol::{self, Registry, SectionKind};
use crate::task::lock;
use motiform_lab::registry;
use motiform_models::{ModelInfo, amplitudes};
use motiform_study::plan::check;
use motiform_study::scan::Axis;
use motiform_study::study::{DisplaySettings, ReturnMapSettings};
use motiform_study::{Error, Study, input, presets};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;
use std::sync::Mutex;

/// Name under which the page's own equations are kept.
pub(crate) const EDITED: &str = "edited";

/// The origin of a study, by which commands name it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Source {
    /// A model of the registry.
    Model(String),
    /// A preset of a model.
    Preset {
        /// The model.
        model: String,
        /// Its preset.
        name: String,
    },
    /// A study file, or the one that the page can save.
    File(String),
}

/// A study that a body can begin with.
#[derive(Clone, Debug)]
pub(crate) struct Subject {
    pub(crate) source: Source,
    pub(crate) study: Study,
    /// Its text, if it was given as text.
    pub(crate) text: Option<String>,
}

/// The most noise that a page can ask for, unless the study itself has more.
const MOST_NOISE: f64 = 1.0;

impl Subject {
    /// Gives a study of this subject noise of this amplitude, the larger one of velocity and shape, in the subject's ratio.
    ///
    /// # Errors
    /// More noise than any body stands, unless the subject has it.
    pub(crate) fn set_noise(&self, study: &mut Study, amplitude: f64) -> Result<(), Error> {
        let own = &self.study.run;
        let remedy = "the explorer takes amplitudes from 0 to 1; for more, write them in a study file";
        let allowed = 0.0..=MOST_NOISE.max(own.largest_noise());
        check("noise", amplitude, allowed.contains(&amplitude), remedy)?;
        study.run.set_largest_noise(amplitude, own);
        Ok(())
    }
}

/// A study file that the explorer opens.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyFile {
    /// As given on the command line.
    pub path: String,
    /// Its content.
    pub text: String,
    /// The study.
    pub study: Study,
    /// The tracked cell that it was fitted to, if there is one.
    pub tracked: Option<TrackedCell>,
}

impl StudyFile {
    /// Reads a study file.
    ///
    /// # Errors
    /// It cannot be read, or is no study: where, and what to write instead.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let study = Study::read(path)?;
        let text = input::text(path, input::STUDY).map_err(|error| Error::unreadable(path, error))?;
        Ok(Self { path: path.display().to_string(), text, study, tracked: None })
    }
}

/// Texts that pages have sent: the models that they define stay in memory as long as the process lives (some 10 kB each).
static TEXTS: Texts = Texts { known: Mutex::new(BTreeSet::new()), most: 2000 };

/// Different texts, up to a number of them.
struct Texts {
    /// By their digests.
    known: Mutex<BTreeSet<u64>>,
    most: usize,
}

impl Texts {
    /// Takes a text, unless there are too many others.
    fn admit(&self, text: &str) -> Result<(), Error> {
        let mut digest = DefaultHasher::new();
        text.hash(&mut digest);
        let digest = digest.finish();
        let mut known = lock(&self.known);
        if known.len() >= self.most && !known.contains(&digest) {
            return Err(Error::Setting {
                key: "text",
                value: format!("one of more than {} studies", self.most),
                remedy: "each stays in memory: save it as a file, and start the explorer again",
            });
        }
        known.insert(digest);
        Ok(())
    }
}

/// Everything that a body can begin with.
#[derive(Clone, Debug)]
pub struct Catalogue {
    /// Subjects beside the registry's, by name.
    own: Vec<(String, Subject)>,
    /// The cell that the study file was fitted to.
    tracked: Option<protocol::Tracked>,
}

impl Catalogue {
    /// The extensions from the literature, and a study file.
    ///
    /// # Errors
    /// A preset that fails its own checks.
    pub fn new(file: Option<&StudyFile>) -> Result<Self, Error> {
        let mut own = Vec::new();
        let tracked = file.and_then(|file| Some(file.tracked.as_ref()?.told(&file_name(&file.path))));
        if let Some(StudyFile { path, text, study, .. }) = file {
            let subject = Subject {
                source: Source::File(path.clone()),
                study: study.clone(),
                text: Some(text.clone()),
            };
            own.push((file_name(path), subject));
        }
        for preset in presets::EXTENSIONS {
            let (name, model) = (preset.name.to_owned(), preset.model.to_owned());
            let study = presets::find_any(preset.name, preset.model)?;
            let source = Source::Preset { model, name: name.clone() };
            own.push((name, Subject { source, study, text: Some(preset.text.to_owned()) }));
        }
        Ok(Self { own, tracked })
    }

    /// The study of a preset, or of a model with its defaults, or of one of the names of this catalogue.
    ///
    /// # Errors
    /// No model or preset has this name.
    pub(crate) fn subject(&self, model: &str, preset: Option<&str>) -> Result<Subject, Error> {
        let mut subject = match self.own.iter().find(|(name, _)| name == model) {
            Some((_, subject)) => subject.clone(),
            None => built_in(model, preset)?,
        };
        subject.study.run.dt_out = subject.study.display.sample;
        Ok(subject)
    }

    /// Keeps a study that the page wrote, under the name [`EDITED`], and describes it.
    ///
    /// # Errors
    /// The text is no study: where, and what to write instead.
    pub(crate) fn define(&mut self, text: &str) -> Result<protocol::Model, Error> {
        TEXTS.admit(text)?;
        let study = Study::parse(text, "the text", EDITED)?;
        let source = Source::File("study.toml".to_owned());
        let subject = Subject { source, study, text: Some(text.to_owned()) };
        let model = typed(described(EDITED, &subject)?)?;
        self.own.retain(|(name, _)| name != EDITED);
        self.own.push((EDITED.to_owned(), subject));
        Ok(model)
    }

    /// The cell that the study file was fitted to, for the page.
    pub(crate) fn tracked(&self) -> Option<protocol::Tracked> {
        self.tracked.clone()
    }

    /// The registry of the library and the subjects of this catalogue, for the page.
    ///
    /// # Errors
    /// A preset or a model that fails its own checks.
    pub(crate) fn registry(&self) -> Result<Registry, Error> {
        let mut all = registry::registry()?;
        for model in list(&mut all, "models") {
            let info = ModelInfo::find(model["name"].as_str().unwrap_or_default())?;
            model["plane"] = plane(&DisplaySettings::of_model(info).plane);
            model["noise"] = json!(Study::of_model(info).run.largest_noise());
            model["editable"] = json!(editable(info));
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
        let own =
            self.own.iter().map(|(name, subject)| described(name, subject)).collect::<Result<Vec<_>, _>>()?;
        all["models"].as_array_mut().into_iter().for_each(|models| models.extend(own.iter().cloned()));
        typed(all)
    }
}

/// The name of a file without its folders.
pub fn file_name(path: &str) -> String {
    Path::new(path).file_name().map_or_else(|| path.to_owned(), |name| name.to_string_lossy().into_owned())
}

/// The initial section of a preset's return map: through the path, if the preset has one. Its height is by default that of the
/// centre of the path: the paper's line for Fig. 3, `y = 3`, lies near the rim of the annulus, and misses some turns.
pub(crate) fn section(settings: Option<&ReturnMapSettings>) -> SectionKind {
    settings.map_or(SectionKind::Speed, |_| SectionKind::Path)
}

fn built_in(model: &str, preset: Option<&str>) -> Result<Subject, Error> {
    let info = ModelInfo::find(model)?;
    let (study, source) = match preset {
        Some(name) => {
            (presets::find(info, name)?, Source::Preset { model: model.to_owned(), name: name.to_owned() })
        }
        None => (Study::of_model(info), Source::Model(model.to_owned())),
    };
    Ok(Subject { source, study, text: None })
}

/// A study as the page shows a model: its values are the defaults.
fn described(name: &str, subject: &Subject) -> Result<Value, Error> {
    let study = &subject.study;
    let info = study.info()?;
    let mut model = registry::entry(info)?;
    model["name"] = json!(name);
    if !study.title.is_empty() {
        model["title"] = json!(study.title);
    }
    for (parameter, value) in list(&mut model, "parameters").zip(study.values()?) {
        parameter["default"] = json!(value);
    }
    model["plane"] = plane(&study.display.plane);
    model["noise"] = json!(study.run.largest_noise());
    model["editable"] = json!(editable(info));
    Ok(model)
}

/// Returns `true` if the equations can be changed as text.
fn editable(info: &ModelInfo) -> bool {
    let defaults: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
    amplitudes::of_model(info, &defaults).is_some()
}

fn typed<T: serde::de::DeserializeOwned>(value: Value) -> Result<T, Error> {
    serde_json::from_value(value).map_err(|error| Error::unreadable(Path::new("the registry"), error))
}

/// The entries of a list of the registry.
fn list<'v>(all: &'v mut Value, key: &str) -> impl Iterator<Item = &'v mut Value> {
    all[key].as_array_mut().into_iter().flatten()
}

fn plane(sides: &[Axis]) -> Value {
    let side = |axis: &Axis| json!({ "name": axis.name, "low": axis.values[0], "high": axis.values[1] });
    json!({ "x": sides.first().map(side), "y": sides.get(1).map(side) })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    /// The registry marks exactly those parameters as whole numbers whose fractions the model rejects.
    #[test]
    fn whole_numbers_are_known() {
        let catalogue = Catalogue::new(None).unwrap();
        for model in catalogue.registry().unwrap().models {
            let info = catalogue.subject(&model.name, None).unwrap().study.info().unwrap();
            let defaults: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
            for (place, parameter) in model.parameters.iter().enumerate() {
                let mut values = defaults.clone();
                values[place] += if values[place] > 0.5 { -0.25 } else { 0.25 };
                let refused = info.build(&values).is_err();
                assert_eq!(parameter.whole, refused, "{}", parameter.name);
            }
        }
    }

    /// Memory is bounded: what was taken is taken again, one more is not.
    #[test]
    fn texts_are_counted() {
        let texts = Texts { known: Mutex::default(), most: 2 };
        assert!(["a", "b", "a", "b"].iter().all(|text| texts.admit(text).is_ok()));
        let why = texts.admit("c").unwrap_err().to_string();
        assert!(why.contains("more than 2 studies") && why.contains("save it as a file"), "{why}");
        assert!(texts.admit("a").is_ok());
    }

    #[test]
    fn extensions_and_the_page_s_own_equations_are_models() {
        let mut catalogue = Catalogue::new(None).unwrap();
        let chiral = catalogue.subject("chiral", None).unwrap();
        assert_eq!(chiral.study.values().unwrap()[1], 0.05);
        assert!(catalogue.subject("edited", None).is_err());
        let model = catalogue.define(&chiral.text.unwrap().replace("value = 0.05", "value = 0.1")).unwrap();
        assert_eq!((model.name.as_str(), model.parameters[1].default), (EDITED, 0.1));
        assert!(catalogue.subject(EDITED, None).is_ok());
    }
}
