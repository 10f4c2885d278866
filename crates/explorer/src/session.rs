//! The session of one page: its threads, and the greeting.

use crate::answers::Answers;
use crate::answers::text;
use crate::body::{self, Services};
use crate::catalogue::Catalogue;
use crate::protocol::Ask;
use crate::protocol::{Hello, Registry};
use motiform_study::dataset::VERSION;
use std::sync::Arc;
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread::JoinHandle;

/// Length of the queue of messages.
const WAITING: usize = 1024;

/// The first message to every page.
#[derive(Clone)]
pub(crate) struct Greeting(Arc<str>);

impl Greeting {
    /// With the registry, and the command that restarts this server.
    pub(crate) fn new(registry: &Registry, restart: &str) -> Self {
        let hello = Hello { version: VERSION, restart: restart.to_owned(), registry: registry.clone() };
        Self(text(&hello.into()).into())
    }

    pub(crate) fn text(&self) -> &str {
        &self.0
    }
}

/// The threads that serve one page. All of them end with it.
pub(crate) struct Session {
    asks: Option<SyncSender<Ask>>,
    thread: Option<JoinHandle<()>>,
}

impl Session {
    /// Starts the threads.
    ///
    /// # Errors
    /// The system provides none.
    pub(crate) fn start(answers: Answers, catalogue: Catalogue) -> std::io::Result<Self> {
        let (asks, heard) = sync_channel(WAITING);
        let services = Services::new(&answers, catalogue)?;
        drop(answers); // the services have their own: when they are gone, the page hears no more
        let run = move || body::run(&heard, &services);
        let thread = std::thread::Builder::new().name("body".to_owned()).spawn(run)?;
        Ok(Self { asks: Some(asks), thread: Some(thread) })
    }

    /// Sends a request; `false` if the queue is full, or the session has ended.
    pub(crate) fn ask(&self, ask: Ask) -> bool {
        self.asks.as_ref().is_some_and(|asks| asks.try_send(ask).is_ok())
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.asks = None; // ends the body, and with it the services
        if let Some(thread) = self.thread.take() {
            let _ = thread.join(); // its panic was reported by the thread itself
        }
    }
}
