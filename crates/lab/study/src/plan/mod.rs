//! Plans: questions made explicit. A plan contains exactly the numbers that its result depends on, in one
//! form for every kind of
//! result: a name, a title, and the computation that its hash covers.

mod difference;
mod provenance;
mod run;

pub use crate::checks::{check, check_closed, check_figure, check_no_noise, check_stability, check_steps};
pub use crate::control::{Control, NoiseSettings};
pub use crate::named::Named;
pub use difference::other_version;
pub use motiform_store::sha256_hex;
pub use provenance::{Provenance, manifest, pretty};
pub use run::{Computation, DEFAULT_STEP, MOST_IN_MEMORY, MOST_ROWS, PLAN_FORMAT, RunPlan, stepper};
pub(crate) use run::{control, escape_norm};

use crate::Error;
use motiform_models::{ModelInfo, ModelName};
use motiform_store::Kind;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::fmt::Debug;

/// A question about a body whose answer is a set of numbers: everything that the numbers depend on.
pub trait Question: Clone + PartialEq + Debug + Serialize + DeserializeOwned {
    /// Settings of the figures that a plan carries; `()` where there are none.
    type Figure: Clone + PartialEq + Debug + Default + Serialize + DeserializeOwned;
    /// The kind of result that answers it.
    const KIND: Kind;
    /// File of the manifest in the result's folder.
    const MANIFEST: &'static str = "manifest.json";
    /// Key of the plan in that manifest.
    const KEY: &'static str;

    /// Its serialized form, which the hash is taken of. A function of each question, so that it is compiled
    /// once and not wherever it is
    /// used.
    fn value(&self) -> Value;

    /// The model of the body.
    fn model(&self) -> &ModelName;

    /// Title of the figures where none was typed. Markup: italic letters between `*`.
    fn title(&self, name: &str) -> String;

    /// Parts that a difference between two plans states in words of their own: key of the serialized form, and text.
    fn stated(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }
}

/// A computation, its name and its title.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct Plan<C: Question = Computation> {
    /// Short name of the study.
    pub name: String,
    /// Title of the figures as typed, or nothing: see [`Plan::title`].
    pub title: String,
    /// The computation; the hash covers this.
    pub computation: C,
    /// Settings of the figures.
    #[serde(default, skip_serializing_if = "is_nothing")]
    pub figure: C::Figure,
}

/// Returns `true` for values without content: `()`, and settings that are all left out.
fn is_nothing<T: Serialize>(settings: &T) -> bool {
    let value = serde_json::to_value(settings).unwrap_or_default();
    value.is_null() || value.as_object().is_some_and(serde_json::Map::is_empty)
}

impl<C: Question> Plan<C> {
    /// A plan without settings of figures.
    pub fn of(name: &str, title: &str, computation: C) -> Self {
        Self { name: name.to_owned(), title: title.to_owned(), computation, figure: C::Figure::default() }
    }

    /// SHA-256 of the computation as compact JSON, in hexadecimal: equal hashes mean equal numbers.
    pub fn hash(&self) -> String {
        sha256_hex(self.computation.value().to_string().as_bytes())
    }

    /// The registry entry of its model.
    ///
    /// # Errors
    /// An unknown model (for example in a plan written by a newer version).
    pub fn info(&self) -> Result<&'static ModelInfo, Error> {
        Ok(self.computation.model().info()?)
    }

    /// The plan as an object, with the key `figure` where it carries settings of figures.
    fn value(&self) -> Value {
        let mut object =
            json!({ "name": self.name, "title": self.title, "computation": self.computation.value() });
        if !is_nothing(&self.figure) {
            object["figure"] = serde_json::to_value(&self.figure).unwrap_or_default();
        }
        object
    }

    /// Title of its figures: as typed, otherwise that of its question.
    pub fn title(&self) -> String {
        if self.title.is_empty() { self.computation.title(&self.name) } else { self.title.clone() }
    }

    /// Folder of the result where none is given: `MODEL-NAME-KIND`, without the name where it is that of the
    /// model; of a run, without
    /// the kind.
    pub fn default_folder(&self) -> String {
        let model = self.computation.model().as_str();
        let name = Some(self.name.as_str()).filter(|name| *name != model);
        let kind = Some(C::KIND.name()).filter(|_| C::KIND != Kind::Dataset);
        [Some(model), name, kind].into_iter().flatten().collect::<Vec<_>>().join("-")
    }

    /// Differences between the computation of this plan, which a folder holds, and that of a requested one:
    /// each key with both values.
    /// Empty where they are the same.
    pub fn differences(&self, requested: &Self) -> String {
        difference::between(
            (self.computation.value(), self.computation.stated()),
            (requested.computation.value(), requested.computation.stated()),
        )
    }
}
