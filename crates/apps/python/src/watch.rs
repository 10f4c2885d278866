//! Progress and interruption of computations that run without the interpreter's lock.

use motiform_dynamics::Watch;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Time between two checks for signals: Ctrl-C is handled within a few of these.
const EVERY: Duration = Duration::from_millis(40);

/// Regularly checks the interpreter's signals, and reports progress to a callable (`progress(fraction)`, or `None`).
pub(crate) struct Caller {
    progress: Option<Py<PyAny>>,
    done: AtomicU64,
    stop: AtomicBool,
    last: Mutex<Instant>,
    error: Mutex<Option<PyErr>>,
    /// `true` if the working thread checks signals itself; otherwise another thread does.
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

    /// Runs `work` on this thread without the interpreter's lock. Short work has no further overhead.
    ///
    /// # Errors
    /// The exception of a signal handler or the callable, which stopped `work`; its result so far is returned with the error.
    pub(crate) fn here<T: Send>(
        py: Python<'_>,
        progress: Option<Py<PyAny>>,
        work: impl FnOnce(&dyn Watch) -> T + Send,
    ) -> (T, Option<PyErr>) {
        let watch = Self::new(progress, true);
        let result = py.detach(|| work(&watch));
        (result, watch.raised())
    }

    /// Runs `work`, which may use many threads, on a separate thread, while this one checks for signals.
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
