//! Messages from the server to the page.

use crate::frames;
use crate::protocol::{Refused, Said};
use tokio::sync::mpsc;

/// A message of the server.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Answer {
    Text(String),
    Binary(Vec<u8>),
}

/// Number of queued answers: threads that are faster than the page wait for it.
const WAITING: usize = 64;

/// Where the threads of a session put their answers.
#[derive(Clone, Debug)]
pub(crate) struct Answers(mpsc::Sender<Answer>);

/// The page has disconnected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Gone;

impl Answers {
    /// A channel to the page, and its receiving end.
    pub(crate) fn new() -> (Self, mpsc::Receiver<Answer>) {
        let (sender, receiver) = mpsc::channel(WAITING);
        (Self(sender), receiver)
    }

    /// Sends a JSON text. Blocks while the queue is full: only for threads of a session.
    pub(crate) fn say(&self, said: impl Into<Said>) -> Result<(), Gone> {
        self.send(Answer::Text(text(&said.into())))
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
        self.0.blocking_send(answer).map_err(|_| Gone)
    }
}

/// A message as JSON. Maps have strings as keys, and numbers that are not finite become `null`, so this cannot fail.
pub(crate) fn text(said: &Said) -> String {
    serde_json::to_string(said).unwrap_or_default()
}
