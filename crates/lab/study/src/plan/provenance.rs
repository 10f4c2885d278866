//! Provenance of a result: the version, the plan, and its hash, in the manifest of the result's folder.

use super::{Plan, Question};
use crate::{Error, input};
use motiform_store::{Folder, Opening, VERSION, mend};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize, Serializer};
use serde_json::json;
use std::fmt::Display;
use std::path::Path;

/// The manifest of a result that grows in its folder. It contains no host, user, time of day, threads or shards.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(bound = "")]
pub struct Provenance<C: Question> {
    /// Version of motiform that started it.
    pub motiform: String,
    /// SHA-256 of the plan's computation.
    pub plan_hash: String,
    /// `true` for a finished result; absent where the inventory alone states it.
    pub complete: Option<bool>,
    /// The plan, under the key of its question.
    #[serde(alias = "branches", alias = "curves", alias = "atlas")]
    pub plan: Plan<C>,
}

impl<C: Question> Serialize for Provenance<C> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = json!({ "motiform": self.motiform, "plan_hash": self.plan_hash });
        if let Some(complete) = self.complete {
            object["complete"] = complete.into();
        }
        object[C::KEY] = self.plan.value();
        object.serialize(serializer)
    }
}

impl<C: Question> Provenance<C> {
    /// That of a plan computed by this version.
    pub fn new(plan: &Plan<C>, complete: Option<bool>) -> Self {
        Self { motiform: VERSION.to_owned(), plan_hash: plan.hash(), complete, plan: plan.clone() }
    }

    /// Reads the manifest of a folder.
    ///
    /// # Errors
    /// [`Error::NoResult`] where it is missing, damaged, or its plan was changed.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let read: Self = manifest::<C, _>(folder)?;
        read.plan.is_hashed_as(&read.plan_hash, folder)?;
        Ok(read)
    }

    /// The bytes of the manifest; `target` is the folder that errors name.
    ///
    /// # Errors
    /// [`Error::Store`].
    pub fn encode(&self, target: &Path) -> Result<Vec<u8>, Error> {
        pretty(self, target)
    }

    /// Provenance as metadata of a table.
    ///
    /// # Errors
    /// [`Error::Store`].
    pub fn metadata(&self, target: &Path) -> Result<Vec<(&'static str, String)>, Error> {
        let text = serde_json::to_string(self).map_err(|error| Error::write_failed(target, error))?;
        Ok(vec![("motiform", text)])
    }
}

/// The manifest in the folder of an answer.
///
/// # Errors
/// [`Error::NoResult`] where it is missing or damaged.
pub fn manifest<C: Question, M: DeserializeOwned>(folder: &Path) -> Result<M, Error> {
    mend(folder)?;
    input::json(&folder.join(C::MANIFEST)).map_err(|error| no_result::<C>(folder, &error))
}

fn no_result<C: Question>(folder: &Path, reason: &dyn Display) -> Error {
    Error::NoResult { path: folder.to_owned(), kind: C::KIND, reason: format!("{}: {reason}", C::MANIFEST) }
}

impl<C: Question> Plan<C> {
    /// Refuses a hash that the manifest in this folder states, if it is not that of the plan.
    ///
    /// # Errors
    /// [`Error::NoResult`].
    pub fn is_hashed_as(&self, hash: &str, folder: &Path) -> Result<(), Error> {
        let changed: &dyn Display = &"it was changed: its plan does not give its hash";
        (self.hash() == hash).then_some(()).ok_or_else(|| no_result::<C>(folder, changed))
    }

    /// Refuses the folder of another plan, before anything is written in it.
    ///
    /// # Errors
    /// [`Error::OtherPlan`] with the differences; [`Error::NoResult`].
    pub fn check_folder(&self, path: &Path) -> Result<Provenance<C>, Error> {
        let there = Provenance::<C>::read(path)?;
        if there.plan_hash == self.hash() {
            return Ok(there);
        }
        Err(Error::OtherPlan {
            path: path.to_owned(),
            kind: C::KIND,
            differences: there.plan.differences(self),
        })
    }

    /// Opens the folder of this plan's result: a new one, which has its manifest from the beginning, or an
    /// earlier one of the same plan,
    /// to go on with. Returns `true` beside an earlier one.
    ///
    /// # Errors
    /// Those of [`Plan::check_folder`]; [`Error::Store`] where it exists, is not ours, is used by others or
    /// cannot be written.
    pub fn open(
        &self,
        path: &Path,
        opening: Opening,
        complete: Option<bool>,
    ) -> Result<(Folder, bool), Error> {
        if opening == Opening::Resume && path.exists() {
            self.check_folder(path)?;
            return Ok((Folder::resume(path, C::KIND)?, true));
        }
        let manifest = Provenance::new(self, complete).encode(path)?;
        Ok((Folder::open(path, C::KIND, opening, &[(C::MANIFEST, &manifest)])?, false))
    }
}

/// A value as JSON for people to read, with a line end; `target` is what errors name.
///
/// # Errors
/// [`Error::Store`].
pub fn pretty(value: &impl Serialize, target: &Path) -> Result<Vec<u8>, Error> {
    let mut json = serde_json::to_vec_pretty(value).map_err(|error| Error::write_failed(target, error))?;
    json.push(b'\n');
    Ok(json)
}
