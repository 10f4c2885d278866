//! The session of the page, and the jobs of a helper.

use super::boundary::{Channel, milliseconds, send};
use crate::{Answer, Answers, Catalogue, Greeting, Local, Post};
use motiform_lab::clock;
use std::cell::RefCell;
use std::time::Duration;

thread_local! {
    static SESSION: RefCell<Option<Local>> = const { RefCell::new(None) };
}

/// Begins a session; a catalogue that fails its own checks ends the program, and the page says so.
pub(crate) fn begin(mappers: usize) {
    prepare();
    let answers = Answers::new(|answer| {
        match answer {
            Answer::Text(text) => send(Channel::Text, text.as_bytes()),
            Answer::Binary(bytes) => send(Channel::Binary, &bytes),
        }
        Ok(())
    });
    let post = Post::new(|errand| send(Channel::Post, errand.text().as_bytes()));
    let begun = Catalogue::new(None).and_then(|catalogue| {
        let greeting = Greeting::new(&catalogue, "")?;
        Ok((greeting, Local::new(answers, post, mappers, catalogue)))
    });
    match begun {
        Ok((greeting, Ok(session))) => {
            SESSION.set(Some(session));
            send(Channel::Text, greeting.text().as_bytes());
        }
        Ok((_, Err(error))) => send(Channel::Fault, error.to_string().as_bytes()),
        Err(error) => send(Channel::Fault, error.to_string().as_bytes()),
    }
}

/// Answers a message of the page.
pub(crate) fn hear(text: &str) {
    SESSION.with_borrow_mut(|session| session.as_mut().into_iter().for_each(|session| session.hear(text)));
}

/// Takes what a helper sends back.
pub(crate) fn report(text: &str) {
    SESSION.with_borrow_mut(|session| session.as_mut().into_iter().for_each(|session| session.report(text)));
}

/// Does the job of an errand.
pub(crate) fn assist(errand: &str) {
    prepare();
    crate::assist(errand, &|text| send(Channel::Back, text.as_bytes()));
}

/// Sets the clock of the worker, and where the message of a panic goes.
fn prepare() {
    clock::set(|| Duration::from_secs_f64(milliseconds().max(0.0) / 1000.0));
    std::panic::set_hook(Box::new(|fault| send(Channel::Fault, fault.to_string().as_bytes())));
}
