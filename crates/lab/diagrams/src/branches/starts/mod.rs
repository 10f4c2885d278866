//! Points of earlier results as starts of branches: `FILE[:POINT]`.
//!
//! | FILE | POINT |
//! | --- | --- |
//! | folder of `motiform continue` | `BRANCH:POINT`, as in the columns of its points.parquet |
//! | JSON of `motiform equilibria --json` | number of the equilibrium, from 1 in the order listed |
//! | dataset of `motiform simulate`, or its table | `t=TIME` (the nearest row), or number of the row from 0; the last one, if not given |

mod branches;
mod dataset;
mod equilibria;

use motiform_models::ModelName;
use motiform_models::amplitudes::Definition;
use motiform_store::{Kind, kind_of};
use motiform_study::plan::Named;
use motiform_study::{Error, Given, Study};
use std::path::{Path, PathBuf};

/// A state of an earlier result, with what it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct StartPoint {
    /// The point as it was asked for.
    pub text: String,
    /// The model; `None` for a table without a manifest, which does not say.
    pub model: Option<ModelName>,
    /// The name of the study, where it has one.
    pub name: Option<String>,
    /// Its parameters.
    pub parameters: Named,
    /// The shape in the model's coordinates.
    pub state: Named,
    /// Its kind.
    pub given: Given,
}

/// A point as it is asked for: the text, the file, and which of its points.
struct Asked<'t> {
    text: &'t str,
    path: PathBuf,
    point: Option<&'t str>,
}

impl StartPoint {
    /// Reads `FILE[:POINT]`.
    ///
    /// # Errors
    /// [`Error::StartPoint`] with the points that there are; files that cannot be read.
    pub fn read(text: &str) -> Result<Self, Error> {
        let asked = Asked::of(text)?;
        let path = &asked.path;
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        let folder = match path.is_file() && OURS.contains(&stem) {
            true => path.parent().unwrap_or(path),
            false => path,
        };
        match (kind_of(folder), extension) {
            (Some(Kind::Branches), _) => branches::point(&asked, folder),
            (Some(Kind::Dataset), _) => dataset::folder(&asked, folder),
            (Some(kind), _) => {
                Err(asked
                    .wrong(format!("this folder holds a result of another kind ({}): {KINDS}", kind.name())))
            }
            (None, "csv" | "parquet") if path.is_file() => dataset::table(&asked),
            (None, "json") if path.is_file() => equilibria::point(&asked),
            _ => Err(asked.wrong(format!("this holds no motion to start from: {KINDS}"))),
        }
    }

    /// The study of its model, with nothing else.
    ///
    /// # Errors
    /// [`Error::StartPoint`] for a table that does not say its model.
    pub fn study(&self) -> Result<Study, Error> {
        let model = self.model.as_ref().ok_or_else(|| Error::StartPoint {
            text: self.text.clone(),
            problem:
                "this table does not say of which model it is: name the model, or give the folder of the run"
                    .to_owned(),
        })?;
        let mut study = Study::of_model(model.info()?);
        if let Some(name) = &self.name {
            study.name.clone_from(name);
        }
        Ok(study)
    }

    /// Gives a study the parameters of this point, and its shape as the exact start.
    ///
    /// # Errors
    /// [`Error::StartPoint`] if it is of another model.
    pub fn put(&self, study: &mut Study) -> Result<(), Error> {
        if self.model.as_ref().is_some_and(|model| !is_same(model, &study.model)) {
            return Err(Error::StartPoint { text: self.text.clone(), problem: self.other_model(study) });
        }
        study.set_all(self.parameters.0.iter().map(|(name, value)| (name.as_str(), *value)))?;
        self.put_state(study)
    }

    /// Gives a study with the parameters of this point, or others, its shape as the exact start.
    fn put_state(&self, study: &mut Study) -> Result<(), Error> {
        study.initial.clear();
        (study.random, study.perturb) = (None, 0.0);
        let values = study.values()?;
        let names: Vec<&str> = study.info()?.coordinates(&values).iter().map(|one| one.name).collect();
        for name in names {
            let value =
                self.state.get(name).filter(|value| value.is_finite()).ok_or_else(|| Error::StartPoint {
                    text: self.text.clone(),
                    problem: format!(
                        "it has no value of {name}, a coordinate of the {} model: give a point of this model",
                        study.model
                    ),
                })?;
            study.set_initial(name, value)?;
        }
        Ok(())
    }

    fn other_model(&self, study: &Study) -> String {
        let named = |model: &ModelName| match model {
            ModelName::BuiltIn(name) | ModelName::Own { own: name, .. } => format!("the {name} model"),
            ModelName::Amplitudes { .. } => "equations of its own".to_owned(),
        };
        let there = self.model.as_ref().map_or_else(String::new, named);
        let here = named(&study.model);
        if there == here {
            "it is a point of other equations than those given: give the study file with these equations, or leave the model out"
                .to_owned()
        } else {
            format!(
                "it is a point of {there}, not of {here}: give a point of that model, or leave the model out"
            )
        }
    }
}

/// Files of a folder of branches, which stand for the folder.
const OURS: [&str; 4] = ["points", "branches", "summary", "manifest"];

/// The remedy of errors: the files that can be a start.
const KINDS: &str = "give a folder of branches, a list of equilibria as JSON, or the dataset of a run";

/// Returns `true` if a motion of one model is one of the other: defaults and display of parameters do not matter.
fn is_same(one: &ModelName, other: &ModelName) -> bool {
    let (Some(a), Some(b)) = (one.definition(), other.definition()) else { return one == other };
    let plain = |definition: &Definition| {
        let names: Vec<String> = definition.parameters.iter().map(|one| one.name.clone()).collect();
        (names, Definition { parameters: Vec::new(), ..definition.clone() })
    };
    plain(a) == plain(b)
}

impl<'t> Asked<'t> {
    /// The longest beginning of the text that is a file or folder; what follows its colon is the point.
    fn of(text: &'t str) -> Result<Self, Error> {
        let whole = (text, None);
        let parts = text.rmatch_indices(':').map(|(place, _)| (&text[..place], Some(&text[place + 1..])));
        let found = std::iter::once(whole).chain(parts).find(|(path, _)| Path::new(path).exists());
        let (path, point) = found.ok_or_else(|| Error::StartPoint {
            text: text.to_owned(),
            problem: format!("there is no such file or folder: {KINDS}, FILE or FILE:POINT"),
        })?;
        Ok(Self { text, path: PathBuf::from(path), point })
    }

    /// An error about this point.
    fn wrong(&self, problem: String) -> Error {
        Error::StartPoint { text: self.text.to_owned(), problem }
    }

    /// The file as text.
    fn shown(&self) -> std::path::Display<'_> {
        self.path.display()
    }
}
