//! The first message to every page.

use crate::answers::text;
use crate::catalogue::Catalogue;
use crate::protocol::Hello;
use motiform_study::Error;
use motiform_study::dataset::VERSION;
use std::sync::Arc;

/// The greeting, with the registry of models and presets.
#[derive(Clone)]
pub struct Greeting(Arc<str>);

impl Greeting {
    /// With the registry of a catalogue, and the command that restarts its server (empty where there is none).
    ///
    /// # Errors
    /// A preset or a model that fails its own checks.
    pub fn new(catalogue: &Catalogue, restart: &str) -> Result<Self, Error> {
        let (registry, tracked) = (catalogue.registry()?, catalogue.tracked());
        let hello = Hello { version: VERSION, restart: restart.to_owned(), registry, tracked };
        Ok(Self(text(&hello.into()).into()))
    }

    /// The message.
    pub fn text(&self) -> &str {
        &self.0
    }
}
