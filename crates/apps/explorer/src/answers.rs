//! Messages from a session to its page.

use crate::frames;
use crate::protocol::{Refused, Said};
use std::sync::Arc;

/// A message to the page.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// A JSON text.
    Text(String),
    /// A binary message.
    Binary(Vec<u8>),
}

/// The receiver of a session's answers.
#[derive(Clone)]
pub struct Answers(Arc<dyn Fn(Answer) -> Result<(), Gone> + Send + Sync>);

/// The page has disconnected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gone;

impl Answers {
    /// Answers that `send` delivers. It may wait while the page is slower than the session.
    pub fn new(send: impl Fn(Answer) -> Result<(), Gone> + Send + Sync + 'static) -> Self {
        Self(Arc::new(send))
    }

    /// Sends a JSON text.
    pub(crate) fn say(&self, said: impl Into<Said>) -> Result<(), Gone> {
        self.text(text(&said.into()))
    }

    /// Sends a message that is a JSON text already.
    pub(crate) fn text(&self, text: String) -> Result<(), Gone> {
        self.send(Answer::Text(text))
    }

    pub(crate) fn binary(&self, bytes: Vec<u8>) -> Result<(), Gone> {
        self.send(Answer::Binary(bytes))
    }

    /// A file that the page requested with this number.
    pub(crate) fn file(&self, id: u32, name: &str, mime: &str, content: &[u8]) -> Result<(), Gone> {
        self.binary(frames::file(id, name, mime, content))
    }

    /// States why a request is refused.
    pub(crate) fn refused(&self, id: Option<u32>, why: &str) -> Result<(), Gone> {
        self.say(Refused { id, why: why.to_owned() })
    }

    fn send(&self, answer: Answer) -> Result<(), Gone> {
        (self.0)(answer)
    }
}

/// A message as JSON. Maps have strings as keys, and numbers that are not finite become `null`, so this cannot fail.
pub(crate) fn text(said: &Said) -> String {
    serde_json::to_string(said).unwrap_or_default()
}

/// The message that refuses a request for this reason.
pub fn refusal(why: &str) -> Answer {
    Answer::Text(text(&Refused { id: None, why: why.to_owned() }.into()))
}
