//! Connections: each has a thread, is answered once and soon, and only so many wait for an answer.

use crate::server::timed::Timed;
use crate::server::{Shared, Stop};
use crate::server::{http, routes};
use std::collections::VecDeque;
use std::io::Write as _;
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// Maximum number of connections that have not sent their request yet: a further one ends the oldest of them.
const UNANSWERED: usize = 64;

/// An answer that is not read within this time is given up.
const READ_WITHIN: Duration = Duration::from_secs(60);

/// The times for which clients may be silent.
#[derive(Clone, Copy, Debug)]
pub struct Patience {
    /// Time for the head of a request.
    pub head: Duration,
    /// Between two pings to a page.
    pub ping: Duration,
    /// A page that says nothing for so long, not even the answer to a ping, loses its place.
    pub silence: Duration,
}

impl Default for Patience {
    fn default() -> Self {
        let seconds = Duration::from_secs;
        Self { head: seconds(10), ping: seconds(15), silence: seconds(45) }
    }
}

/// Connections without a request so far, the oldest first.
#[derive(Default)]
struct Unanswered(Mutex<VecDeque<Arc<TcpStream>>>);

impl Unanswered {
    /// Enters a connection; where there are too many the oldest one ends.
    fn enter(&self, stream: &Arc<TcpStream>) {
        self.with(|waiting| {
            if waiting.len() >= UNANSWERED {
                waiting.pop_front().as_deref().map(shut);
            }
            waiting.push_back(Arc::clone(stream));
        });
    }

    fn leave(&self, stream: &Arc<TcpStream>) {
        self.with(|waiting| waiting.retain(|other| !Arc::ptr_eq(other, stream)));
    }

    fn end_all(&self) {
        self.with(|waiting| waiting.drain(..).for_each(|stream| shut(&stream)));
    }

    /// The list, even after a panic of another thread: it is consistent at every point.
    fn with(&self, act: impl FnOnce(&mut VecDeque<Arc<TcpStream>>)) {
        act(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner));
    }
}

/// Ends a connection: reads and writes of other threads fail at once.
pub(crate) fn shut(stream: &TcpStream) {
    let _ = stream.shutdown(Shutdown::Both); // it may have ended already
}

/// Accepts connections until the server is stopped; those that are still without a request end with it.
pub(crate) fn accept(listener: &TcpListener, stop: &Stop, shared: &Arc<Shared>) {
    let unanswered = Arc::new(Unanswered::default());
    while !stop.is_set() {
        if begin(listener, stop, shared, &unanswered).is_err() {
            // No file descriptor or no thread, for example: others end meanwhile.
            thread::sleep(Duration::from_millis(50));
        }
    }
    unanswered.end_all();
}

/// Accepts a connection, and gives it a thread.
fn begin(
    listener: &TcpListener,
    stop: &Stop,
    shared: &Arc<Shared>,
    unanswered: &Arc<Unanswered>,
) -> std::io::Result<()> {
    let (stream, _) = listener.accept()?;
    if stop.is_set() {
        return Ok(()); // this connection only wakes the server
    }
    // Frames are small and wanted now: without this each waits up to 40 ms for the answer to the one before. Where it is
    // refused they come late, and that is all.
    let _ = stream.set_nodelay(true);
    let stream = Arc::new(stream);
    unanswered.enter(&stream);
    let (shared, list, its) = (Arc::clone(shared), Arc::clone(unanswered), Arc::clone(&stream));
    let run = move || answer(&its, &shared, &list);
    let begun = thread::Builder::new().name("connection".to_owned()).spawn(run);
    if begun.is_err() {
        unanswered.leave(&stream);
    }
    begun.map(drop)
}

/// Answers one request; a page takes the connection over.
fn answer(stream: &Arc<TcpStream>, shared: &Shared, unanswered: &Unanswered) {
    let mut timed = Timed::new(stream, shared.patience.head);
    let heard = http::head(&mut timed);
    // The request has come, or never will: the connection waits no longer.
    unanswered.leave(stream);
    timed.within(READ_WITHIN);
    let answer = match heard {
        Ok((request, rest)) if routes::is_live(&request) => match routes::opening(&request, shared) {
            Ok(opening) => {
                if timed.write_all(&http::bytes(&opening)).is_ok() {
                    routes::live(stream, rest, shared);
                }
                return shut(stream);
            }
            Err(status) => http::empty(status),
        },
        Ok((request, _)) => routes::file(&request, shared),
        Err(Some(status)) => http::empty(status),
        Err(None) => return shut(stream),
    };
    // What goes wrong with a connection ends it, and concerns nobody else.
    if timed.write_all(&http::bytes(&answer)).is_ok() {
        http::linger(&mut timed);
    }
    shut(stream);
}
