//! Connections: each is answered once and soon, and only so many wait for an answer.

use axum::Router;
use axum::body::Body;
use axum::http::{HeaderValue, StatusCode, header};
use hyper::body::Incoming;
use hyper_util::rt::{TokioIo, TokioTimer};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tokio::net::{TcpListener, TcpStream};
use tokio::task::AbortHandle;
use tower_service::Service as _;

/// Maximum number of connections that have not sent their request yet: a further one ends the oldest of them.
const UNANSWERED: usize = 64;

/// A connection that is no page ends after this time, whether its answer was read or not.
const ANSWERED_WITHIN: Duration = Duration::from_secs(60);

/// How long others may be silent.
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

/// The data of a mutex, even after a panic of another thread: they are consistent at every point.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Connections without a request so far, the oldest first.
#[derive(Default)]
struct Unanswered(Mutex<(u64, VecDeque<(u64, AbortHandle)>)>);

impl Unanswered {
    /// Enters a connection; where there are too many the oldest one ends.
    fn enter(&self, spawn: impl FnOnce(u64) -> AbortHandle) {
        let mut inner = lock(&self.0);
        inner.0 += 1;
        let number = inner.0;
        if inner.1.len() >= UNANSWERED
            && let Some((_, oldest)) = inner.1.pop_front()
        {
            oldest.abort();
        }
        inner.1.push_back((number, spawn(number)));
    }

    fn leave(&self, number: u64) {
        lock(&self.0).1.retain(|(other, _)| *other != number);
    }
}

/// Leaves the list however a connection ends.
struct Entry {
    list: Arc<Unanswered>,
    number: u64,
}

impl Drop for Entry {
    fn drop(&mut self) {
        self.list.leave(self.number);
    }
}

/// Accepts connections for as long as it is polled.
pub(crate) async fn accept(listener: TcpListener, router: Router, patience: Patience) {
    let unanswered = Arc::new(Unanswered::default());
    loop {
        let Ok((stream, _)) = listener.accept().await else {
            // No file descriptor, for example: others end meanwhile.
            tokio::time::sleep(Duration::from_millis(50)).await;
            continue;
        };
        // Frames are small and wanted now: without this each waits up to 40 ms for the answer to the one before. Where it is
        // refused they come late, and that is all.
        let _ = stream.set_nodelay(true);
        let (router, list) = (router.clone(), Arc::clone(&unanswered));
        unanswered.enter(|number| {
            tokio::spawn(answer(stream, router, patience, Entry { list, number })).abort_handle()
        });
    }
}

/// Answers one request; a page takes the connection over.
async fn answer(stream: TcpStream, router: Router, patience: Patience, entry: Entry) {
    let entry = Mutex::new(Some(entry));
    let service = hyper::service::service_fn(move |request: hyper::Request<Incoming>| {
        // The request has come: the connection waits no longer.
        drop(lock(&entry).take());
        let answer = router.clone().call(request.map(Body::new));
        async move {
            let mut answer = answer.await?;
            if answer.status() != StatusCode::SWITCHING_PROTOCOLS {
                answer.headers_mut().insert(header::CONNECTION, HeaderValue::from_static("close"));
            }
            Ok::<_, std::convert::Infallible>(answer)
        }
    });
    let mut http = hyper::server::conn::http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(patience.head);
    let connection = http.serve_connection(TokioIo::new(stream), service).with_upgrades();
    // What goes wrong with a connection ends it, and concerns nobody else.
    let _ = tokio::time::timeout(ANSWERED_WITHIN, connection).await;
}
