//! The pages that are served: so many at a time, each with its place.

use crate::server::accept::shut;
use crate::server::connection::NO_PLACE;
use crate::server::outbox::{End, Outbox};
use std::net::TcpStream;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Maximum number of pages at a time: each has its own threads.
const PAGES: usize = 8;

/// The connection of a page, and what waits to be sent over it.
type Page = (Arc<TcpStream>, Arc<Outbox>);

#[derive(Default)]
struct Inner {
    open: Vec<Page>,
    /// The reason why no more pages are admitted, once there is one.
    dismissed: Option<End>,
}

/// All pages that have a place.
#[derive(Default)]
pub(crate) struct Pages {
    inner: Mutex<Inner>,
    left: Condvar,
}

/// A page's place: it is free again when this is dropped.
pub(crate) struct Place<'p> {
    pages: &'p Pages,
    outbox: Arc<Outbox>,
}

impl Place<'_> {
    /// The queue of messages to the page.
    pub(crate) fn outbox(&self) -> &Arc<Outbox> {
        &self.outbox
    }
}

impl Drop for Place<'_> {
    fn drop(&mut self) {
        self.pages.lock().open.retain(|(_, outbox)| !Arc::ptr_eq(outbox, &self.outbox));
        self.pages.left.notify_all();
    }
}

impl Pages {
    /// The list, even after a panic of another thread: it is consistent at every point.
    fn lock(&self) -> MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A place for a page.
    ///
    /// # Errors
    /// The reason why there is none.
    pub(crate) fn enter(&self, stream: &Arc<TcpStream>) -> Result<Place<'_>, End> {
        let mut inner = self.lock();
        if let Some(end) = inner.dismissed {
            return Err(end);
        }
        if inner.open.len() >= PAGES {
            return Err(NO_PLACE);
        }
        let outbox = Arc::new(Outbox::default());
        inner.open.push((Arc::clone(stream), Arc::clone(&outbox)));
        Ok(Place { pages: self, outbox })
    }

    /// Closes all pages, and waits until their sessions have ended. A page that does not listen is waited for no longer than `time`; none
    /// comes after this.
    pub(crate) fn dismiss(&self, reason: End, time: Duration) {
        let mut inner = self.lock();
        inner.dismissed = Some(reason);
        inner.open.iter().for_each(|(_, outbox)| outbox.close(reason));
        let some = |inner: &mut Inner| !inner.open.is_empty();
        let waited = self.left.wait_timeout_while(inner, time, some);
        let (inner, _) = waited.unwrap_or_else(PoisonError::into_inner);
        inner.open.iter().for_each(|(stream, _)| shut(stream));
        drop(self.left.wait_while(inner, some));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A page whose request was on its way when the server was stopped finds no place.
    #[test]
    fn nobody_enters_after_the_end() -> std::io::Result<()> {
        let listener = std::net::TcpListener::bind("127.0.0.1:0")?;
        let stream = Arc::new(TcpStream::connect(listener.local_addr()?)?);
        let pages = Pages::default();
        drop(pages.enter(&stream).expect("a place"));
        let end = (1001, "the end");
        pages.dismiss(end, Duration::ZERO);
        assert_eq!(pages.enter(&stream).err(), Some(end));
        Ok(())
    }
}
