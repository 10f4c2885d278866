//! The way back to the page.

use crate::frames;
use serde_json::Value;
use tokio::sync::mpsc;

/// What the server says.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Answer {
    Text(String),
    Binary(Vec<u8>),
}

/// Answers that wait to be sent: threads that are faster than the page wait for it.
const WAITING: usize = 64;

/// Where the threads of a session put their answers.
#[derive(Clone, Debug)]
pub(crate) struct Answers(mpsc::Sender<Answer>);

/// The page has gone: there is nobody to work for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Gone;

impl Answers {
    /// A way back, and its end.
    pub(crate) fn new() -> (Self, mpsc::Receiver<Answer>) {
        let (sender, receiver) = mpsc::channel(WAITING);
        (Self(sender), receiver)
    }

    /// Sends a JSON text. Waits while too many answers wait: only for threads of a session.
    pub(crate) fn json(&self, value: &Value) -> Result<(), Gone> {
        self.send(Answer::Text(value.to_string()))
    }

    pub(crate) fn binary(&self, bytes: Vec<u8>) -> Result<(), Gone> {
        self.send(Answer::Binary(bytes))
    }

    /// A file that the page asked for by this number.
    pub(crate) fn file(&self, id: u32, name: &str, mime: &str, content: &[u8]) -> Result<(), Gone> {
        self.binary(frames::file(id, name, mime, content))
    }

    /// Says why something cannot be done.
    pub(crate) fn refused(&self, id: Option<u32>, why: &str) -> Result<(), Gone> {
        self.json(&refused(id, why))
    }

    fn send(&self, answer: Answer) -> Result<(), Gone> {
        self.0.blocking_send(answer).map_err(|_| Gone)
    }
}

/// What is said to a message that cannot be answered.
pub(crate) fn refused(id: Option<u32>, why: &str) -> Value {
    serde_json::json!({ "is": "refused", "id": id, "why": why })
}
