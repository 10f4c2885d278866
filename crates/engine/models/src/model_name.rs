//! The model that a study or a plan is about.

use crate::amplitudes::{self, Definition};
use crate::{Error, ModelInfo};
use serde::{Deserialize, Serialize};

/// A model of the registry by its name, amplitude equations by their definition, or a model of one's own by its name and equations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum ModelName {
    /// A name of the registry.
    BuiltIn(String),
    /// Equations given as text.
    Amplitudes {
        /// The equations.
        amplitudes: Box<Definition>,
    },
    /// A model that was [registered](crate::register).
    Own {
        /// Its name.
        own: String,
        /// Digits that change with its equations ([`ModelInfo::field`]).
        field: String,
    },
}

impl ModelName {
    /// The model.
    ///
    /// # Errors
    /// An unknown name, or equations that are no model (in a damaged file, or one of a newer version).
    pub fn info(&self) -> Result<&'static ModelInfo, Error> {
        match self {
            Self::BuiltIn(name) => ModelInfo::find(name),
            Self::Amplitudes { amplitudes: definition } => {
                amplitudes::info(definition).map_err(|error| Error::Equations { problem: error.to_string() })
            }
            Self::Own { own, field } => match ModelInfo::find(own)? {
                info if info.field() == Some(field) => Ok(info),
                _ => Err(Error::OwnModel {
                    name: own.clone(),
                    problem: "this result was computed with other equations of the same name: register \
                        those, or compute it again"
                        .to_owned(),
                }),
            },
        }
    }

    /// Its name for messages and titles: `amplitudes` for equations given as text.
    pub fn as_str(&self) -> &str {
        match self {
            Self::BuiltIn(name) | Self::Own { own: name, .. } => name,
            Self::Amplitudes { .. } => amplitudes::NAME,
        }
    }

    /// The equations, if they are given as text.
    pub fn definition(&self) -> Option<&Definition> {
        match self {
            Self::BuiltIn(_) | Self::Own { .. } => None,
            Self::Amplitudes { amplitudes } => Some(amplitudes),
        }
    }
}

impl std::fmt::Display for ModelName {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.as_str())
    }
}

impl PartialEq<str> for ModelName {
    fn eq(&self, name: &str) -> bool {
        self.as_str() == name
    }
}

impl From<&ModelInfo> for ModelName {
    fn from(info: &ModelInfo) -> Self {
        match (info.definition(), info.field()) {
            (Some(definition), _) => Self::Amplitudes { amplitudes: Box::new(definition.clone()) },
            (None, Some(field)) => Self::Own { own: info.name.to_owned(), field: field.to_owned() },
            (None, None) => Self::BuiltIn(info.name.to_owned()),
        }
    }
}
