//! A session that runs on its own threads: one for the body, and one for each kind of background computation.

use crate::answers::Answers;
use crate::body::{self, Services};
use crate::catalogue::Catalogue;
use crate::protocol::{Ask, Request};
use crate::task::Crew;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::task::Poll;
use std::thread::JoinHandle;

/// Length of the queue of messages.
const WAITING: usize = 1024;

/// The threads that serve one page. All of them end with it.
pub struct Session {
    asks: Option<SyncSender<Ask>>,
    thread: Option<JoinHandle<()>>,
}

/// Messages from another thread. The body's thread waits for them.
struct Channel(Receiver<Ask>);

impl body::Asks for Channel {
    fn next(&self) -> Poll<Option<Ask>> {
        Poll::Ready(self.0.recv().ok())
    }
}

impl Session {
    /// Starts the threads.
    ///
    /// # Errors
    /// The system provides none.
    #[allow(clippy::needless_pass_by_value, reason = "when the services are gone, the page hears no more")]
    pub fn start(answers: Answers, catalogue: Catalogue) -> std::io::Result<Self> {
        let (asks, heard) = sync_channel(WAITING);
        let services = Services::new(&answers, &Crew::Threads, catalogue)?;
        let run = move || {
            // The channel is never pending: once polled, it goes on until the page disconnects.
            let channel = Channel(heard);
            let mut life = std::pin::pin!(body::live(&channel, &services));
            let _ = body::go_on(life.as_mut()); // ready: see above
        };
        let thread = std::thread::Builder::new().name("body".to_owned()).spawn(run)?;
        Ok(Self { asks: Some(asks), thread: Some(thread) })
    }

    /// Sends a request; `false` if the queue is full, or the session has ended.
    pub fn ask(&self, request: Request) -> bool {
        self.asks.as_ref().is_some_and(|asks| asks.try_send(request.0).is_ok())
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
