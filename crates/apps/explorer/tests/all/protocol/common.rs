//! A page with a session inside it, and a page with a session on threads.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_explorer::{Answer, Answers, Catalogue, Errand, Local, Post, Request, Session, assist};
use serde_json::Value;
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// The page's side of a session: messages to it, and its answers.
pub(crate) trait Page {
    /// Sends a message.
    fn say(&mut self, text: &str);
    /// Everything that was answered until a text of this type came.
    fn until(&mut self, is: &str) -> Vec<Answer>;

    /// The next text of this type.
    fn next(&mut self, is: &str) -> Value {
        let Some(Answer::Text(text)) = self.until(is).pop() else { unreachable!() };
        serde_json::from_str(&text).unwrap()
    }
}

/// A session without threads; its errands are done at once, in this thread.
pub(crate) struct Alone {
    pub(crate) session: Local,
    pub(crate) errands: Arc<Mutex<VecDeque<String>>>,
    answers: Receiver<Answer>,
}

impl Alone {
    pub(crate) fn new(mappers: usize) -> Self {
        let (send, answers) = channel();
        let errands = Arc::<Mutex<VecDeque<String>>>::default();
        let posted = Arc::clone(&errands);
        let post = Post::new(move |errand| posted.lock().unwrap().push_back(errand.text()));
        let answers_to = Answers::new(move |answer| {
            send.send(answer).unwrap();
            Ok(())
        });
        let session = Local::new(answers_to, post, mappers, Catalogue::new(None).unwrap()).unwrap();
        Self { session, errands, answers }
    }

    /// Does the next errand; `false` if there is none.
    pub(crate) fn work(&mut self) -> bool {
        let Some(text) = self.errands.lock().unwrap().pop_front() else { return false };
        let back = Mutex::new(Vec::new());
        assist(&text, &|report| back.lock().unwrap().push(report.to_owned()));
        back.into_inner().unwrap().iter().for_each(|report| self.session.report(report));
        let errand = Errand::parse(&text).unwrap();
        self.session.report(&Errand { json: "", ..errand }.text());
        true
    }

    /// Everything that was answered so far.
    pub(crate) fn answered(&self) -> Vec<Answer> {
        self.answers.try_iter().collect()
    }
}

impl Page for Alone {
    fn say(&mut self, text: &str) {
        self.session.hear(text);
    }

    fn until(&mut self, is: &str) -> Vec<Answer> {
        let mut all = Vec::new();
        loop {
            for answer in self.answers.try_iter() {
                let last = is_of(&answer, is);
                all.push(answer);
                if last {
                    return all;
                }
            }
            assert!(self.work(), "no {is} among {all:?}");
        }
    }
}

/// A session on threads.
pub(crate) struct Served {
    session: Session,
    answers: Receiver<Answer>,
}

impl Served {
    pub(crate) fn new() -> Self {
        let (send, answers) = channel();
        // A page that has gone hears nothing.
        let answers_to = Answers::new(move |answer| {
            let _ = send.send(answer);
            Ok(())
        });
        Self { session: Session::start(answers_to, Catalogue::new(None).unwrap()).unwrap(), answers }
    }
}

impl Page for Served {
    fn say(&mut self, text: &str) {
        assert!(self.session.ask(Request::parse(text).unwrap()));
    }

    fn until(&mut self, is: &str) -> Vec<Answer> {
        let mut all = Vec::new();
        loop {
            let answer = self.answers.recv_timeout(Duration::from_secs(120)).unwrap();
            let last = is_of(&answer, is);
            all.push(answer);
            if last {
                return all;
            }
        }
    }
}

/// Returns `true` if an answer is a text of this type.
pub(crate) fn is_of(answer: &Answer, is: &str) -> bool {
    matches!(answer, Answer::Text(text) if text.starts_with(&format!("{{\"is\":\"{is}\"")))
}

/// The binary messages of this kind.
pub(crate) fn binaries(answers: &[Answer], kind: u8) -> Vec<&[u8]> {
    let bytes = answers.iter().filter_map(|answer| match answer {
        Answer::Binary(bytes) if bytes[0] == kind => Some(&bytes[..]),
        _ => None,
    });
    bytes.collect()
}
