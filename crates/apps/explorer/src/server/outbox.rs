//! The queue of messages to a page: answers of its session, and at last the reason why the connection is
//! closed.

use crate::Gone;
use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Instant;
use tungstenite::Message;

/// Number of messages that wait: threads that are faster than the page wait for it.
const WAITING: usize = 64;

/// The reason why a connection is closed: a code (RFC 6455, 7.4.1) and words.
pub(crate) type End = (u16, &'static str);

/// The next action of the writer of a page.
pub(crate) enum Next {
    Send(Message),
    /// Nothing came until the given time.
    Nothing,
    Close(End),
    /// The connection has ended.
    Gone,
}

#[derive(Default)]
struct Inner {
    waiting: VecDeque<Message>,
    end: Option<End>,
    gone: bool,
}

/// Messages on their way to one page.
#[derive(Default)]
pub(crate) struct Outbox {
    inner: Mutex<Inner>,
    changed: Condvar,
}

impl Outbox {
    /// The data, even after a panic of another thread: they are consistent at every point.
    fn lock(&self) -> MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds a message, once there is room for it.
    ///
    /// # Errors
    /// The connection ends: nobody will read the message.
    pub(crate) fn push(&self, message: Message) -> Result<(), Gone> {
        let full = |inner: &mut Inner| inner.waiting.len() >= WAITING && inner.end.is_none() && !inner.gone;
        let mut inner = self.changed.wait_while(self.lock(), full).unwrap_or_else(PoisonError::into_inner);
        if inner.gone || inner.end.is_some() {
            return Err(Gone);
        }
        inner.waiting.push_back(message);
        self.changed.notify_all();
        Ok(())
    }

    /// Closes the connection, for the first reason that is given. Messages that wait are not sent any more.
    pub(crate) fn close(&self, end: End) {
        self.lock().end.get_or_insert(end);
        self.changed.notify_all();
    }

    /// The connection has ended: nobody waits any longer.
    pub(crate) fn leave(&self) {
        self.lock().gone = true;
        self.changed.notify_all();
    }

    /// Waits until the connection has ended, no longer than until a point in time.
    pub(crate) fn left_until(&self, end: Instant) {
        let left = end.saturating_duration_since(Instant::now());
        drop(self.changed.wait_timeout_while(self.lock(), left, |inner| !inner.gone));
    }

    /// Waits for something to do, until a point in time.
    pub(crate) fn next(&self, until: Instant) -> Next {
        let idle = |inner: &mut Inner| inner.waiting.is_empty() && inner.end.is_none() && !inner.gone;
        let left = until.saturating_duration_since(Instant::now());
        let waited = self.changed.wait_timeout_while(self.lock(), left, idle);
        let (mut inner, _) = waited.unwrap_or_else(PoisonError::into_inner);
        if inner.gone {
            return Next::Gone;
        }
        if let Some(end) = inner.end {
            return Next::Close(end);
        }
        let next = inner.waiting.pop_front();
        self.changed.notify_all();
        next.map_or(Next::Nothing, Next::Send)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    /// A thread that waits for a page that does not read is released by the end of the connection, and the
    /// reason is sent before the queue.
    #[test]
    fn an_end_goes_first_and_frees_who_waits() {
        let outbox = Outbox::default();
        let later = Instant::now() + Duration::from_secs(60);
        let fill = || (0..).take_while(|_| outbox.push(Message::text("x")).is_ok()).count();
        let pushed = std::thread::scope(|scope| {
            let filled = scope.spawn(fill);
            while outbox.lock().waiting.len() < WAITING {
                std::thread::yield_now();
            }
            assert!(matches!(outbox.next(later), Next::Send(_)));
            while outbox.lock().waiting.len() < WAITING {
                std::thread::yield_now();
            }
            outbox.close((1001, "first"));
            outbox.close((1008, "second"));
            filled.join()
        });
        assert_eq!(pushed.ok(), Some(WAITING + 1));
        assert!(matches!(outbox.next(later), Next::Close((1001, "first"))));
        outbox.leave();
        assert!(matches!(outbox.next(later), Next::Gone));
        assert!(outbox.push(Message::text("y")).is_err());
    }

    #[test]
    fn nothing_comes_in_time() {
        assert!(matches!(Outbox::default().next(Instant::now()), Next::Nothing));
    }
}
