//! A session without threads: each message is answered at once, and what takes longer goes to helpers.

use crate::answers::Answers;
use crate::body::{self, Asks, Services};
use crate::catalogue::Catalogue;
use crate::protocol::{Ask, Request};
use crate::task::{Crew, Errand, Post};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::pin::Pin;
use std::rc::Rc;
use std::task::Poll;

/// A session inside the page itself.
///
/// [`Local::hear`] answers a message of the page. Errands that the session posts are done by other instances of this program
/// ([`assist`]); what they send back comes in by [`Local::report`].
pub struct Local {
    asks: Rc<Queue>,
    services: Rc<Services>,
    answers: Answers,
    /// `None` once nobody listens any more.
    life: Option<Pin<Box<dyn Future<Output = ()>>>>,
}

/// Messages that wait to be answered: between two calls, none.
#[derive(Default)]
struct Queue(RefCell<VecDeque<Ask>>);

impl Asks for Rc<Queue> {
    fn next(&self) -> Poll<Option<Ask>> {
        self.0.borrow_mut().pop_front().map_or(Poll::Pending, |ask| Poll::Ready(Some(ask)))
    }
}

impl Local {
    /// A session that answers to `answers`, with so many helpers for the cells of maps.
    ///
    /// # Errors
    /// None: a session without threads needs nothing of the system.
    pub fn new(answers: Answers, post: Post, mappers: usize, catalogue: Catalogue) -> std::io::Result<Self> {
        let services = Rc::new(Services::new(&answers, &Crew::Away { post, mappers }, catalogue)?);
        let asks = Rc::<Queue>::default();
        let (heard, serving) = (Rc::clone(&asks), Rc::clone(&services));
        let life = Box::pin(async move { body::live(&heard, &serving).await });
        Ok(Self { asks, services, answers, life: Some(life) })
    }

    /// Answers a message of the page.
    pub fn hear(&mut self, text: &str) {
        match Request::parse(text) {
            Ok(Request(ask)) => {
                self.asks.0.borrow_mut().push_back(ask);
                if self.life.as_mut().is_some_and(|life| body::go_on(life.as_mut()).is_ready()) {
                    self.life = None;
                }
            }
            Err(why) => {
                let _ = self.answers.refused(None, &why);
            }
        }
    }

    /// Takes the text of an errand that comes back from a helper.
    pub fn report(&mut self, text: &str) {
        if let Some(errand) = Errand::parse(text) {
            let _ = self.services.report(&errand);
        }
    }
}

/// Does the job of an errand, given as text, in a helper: each report is the text of an errand that goes back to the session.
pub fn assist(errand: &str, back: &(dyn Fn(&str) + Sync)) {
    if let Some(errand) = Errand::parse(errand).filter(|errand| !errand.json.is_empty()) {
        body::perform(&errand, back);
    }
}
