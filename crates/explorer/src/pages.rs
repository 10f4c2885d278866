//! The pages that are served: so many at a time, each with its place.

use crate::accept::shut;
use crate::outbox::{End, Outbox};
use std::net::TcpStream;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Maximum number of pages at a time: each has its own threads.
const PAGES: usize = 8;

/// The connection of a page, and what waits to be sent over it.
type Page = (Arc<TcpStream>, Arc<Outbox>);

/// All pages that have a place.
#[derive(Default)]
pub(crate) struct Pages {
    open: Mutex<Vec<Page>>,
    left: Condvar,
}

/// A page's place: it is free again when this is dropped.
pub(crate) struct Place<'p> {
    pages: &'p Pages,
    outbox: Arc<Outbox>,
}

impl Place<'_> {
    /// What is sent to the page.
    pub(crate) fn outbox(&self) -> &Arc<Outbox> {
        &self.outbox
    }
}

impl Drop for Place<'_> {
    fn drop(&mut self) {
        self.pages.lock().retain(|(_, outbox)| !Arc::ptr_eq(outbox, &self.outbox));
        self.pages.left.notify_all();
    }
}

impl Pages {
    /// The list, even after a panic of another thread: it is consistent at every point.
    fn lock(&self) -> MutexGuard<'_, Vec<Page>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A place for a page, if one is free.
    pub(crate) fn enter(&self, stream: &Arc<TcpStream>) -> Option<Place<'_>> {
        let mut open = self.lock();
        if open.len() >= PAGES {
            return None;
        }
        let outbox = Arc::new(Outbox::default());
        open.push((Arc::clone(stream), Arc::clone(&outbox)));
        Some(Place { pages: self, outbox })
    }

    /// Closes all pages, and waits until their sessions have ended. A page that does not listen is waited for no longer than `time`.
    pub(crate) fn dismiss(&self, reason: End, time: Duration) {
        let open = self.lock();
        open.iter().for_each(|(_, outbox)| outbox.close(reason));
        let some = |open: &mut Vec<Page>| !open.is_empty();
        let waited = self.left.wait_timeout_while(open, time, some);
        let (open, _) = waited.unwrap_or_else(PoisonError::into_inner);
        open.iter().for_each(|(stream, _)| shut(stream));
        drop(self.left.wait_while(open, some));
    }
}
