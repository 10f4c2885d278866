//! How Python watches and stops what runs without the interpreter's lock.

use motiform_dynamics::Watch;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Time between two looks at signals: Ctrl-C is answered within a few of these.
const EVERY: Duration = Duration::from_millis(40);

/// Looks at the interpreter's signals now and then, and tells a callable (`progress(fraction)`, or `None`) how far it is.
pub(crate) struct Caller {
    progress: Option<Py<PyAny>>,
    done: AtomicU64,
    stop: AtomicBool,
    last: Mutex<Instant>,
    error: Mutex<Option<PyErr>>,
    /// Whether the working thread looks by itself; otherwise another one does.
    own: bool,
}

impl Caller {
    fn new(progress: Option<Py<PyAny>>, own: bool) -> Self {
        Self {
            progress,
            done: AtomicU64::new(0),
            stop: AtomicBool::new(false),
            last: Mutex::new(Instant::now()),
            error: Mutex::new(None),
            own,
        }
    }

    /// Runs `work` on this thread without the interpreter's lock. Nothing but that is spent on work that is short.
    ///
    /// # Errors
    /// What a signal handler or the callable raised: `work` was stopped then, and what it gave comes with the error.
    pub(crate) fn here<T: Send>(
        py: Python<'_>,
        progress: Option<Py<PyAny>>,
        work: impl FnOnce(&dyn Watch) -> T + Send,
    ) -> (T, Option<PyErr>) {
        let watch = Self::new(progress, true);
        let result = py.detach(|| work(&watch));
        (result, watch.raised())
    }

    /// Runs `work`, which may use many threads, on a thread of its own, while this one looks at signals.
    ///
    /// # Errors
    /// As [`Caller::here`].
    pub(crate) fn beside<T: Send>(
        py: Python<'_>,
        progress: Option<Py<PyAny>>,
        work: impl FnOnce(&dyn Watch) -> T + Send,
    ) -> (T, Option<PyErr>) {
        let watch = Self::new(progress, false);
        let result = py.detach(|| {
            std::thread::scope(|scope| {
                let (sender, receiver) = channel();
                let worker = scope.spawn(|| {
                    let result = work(&watch);
                    drop(sender); // wakes the other side
                    result
                });
                while receiver.recv_timeout(EVERY) == Err::<(), _>(RecvTimeoutError::Timeout) {
                    watch.look();
                }
                worker.join()
            })
        });
        match result {
            Ok(result) => (result, watch.raised()),
            Err(panic) => std::panic::resume_unwind(panic), // PyO3 makes it an exception
        }
    }

    fn raised(&self) -> Option<PyErr> {
        self.error.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Signals, and the callable.
    fn look(&self) {
        let fraction = f64::from_bits(self.done.load(Ordering::Relaxed));
        let said = Python::attach(|py| {
            py.check_signals()?;
            match &self.progress {
                Some(progress) => progress.call1(py, (fraction,)).map(drop),
                None => Ok(()),
            }
        });
        if let Err(error) = said {
            self.error.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
            self.stop.store(true, Ordering::Relaxed);
        }
    }
}

impl Watch for Caller {
    fn progress(&self, done: f64) {
        self.done.store(done.to_bits(), Ordering::Relaxed);
    }

    fn stopped(&self) -> bool {
        if self.own
            && let Ok(mut last) = self.last.try_lock()
            && last.elapsed() >= EVERY
        {
            self.look();
            *last = Instant::now();
        }
        self.stop.load(Ordering::Relaxed)
    }
}
