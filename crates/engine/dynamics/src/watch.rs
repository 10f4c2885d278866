//! The watch on a long computation: progress, and whether to stop.

use std::sync::atomic::{AtomicBool, Ordering};

/// Observes a long computation for its caller: receives its progress, and may stop it. Every method has a default that does nothing.
pub trait Watch: Sync {
    /// Receives the fraction of the work that is done, 0 to 1; called often.
    fn progress(&self, _done: f64) {}

    /// Called when a part of the work is finished; the text states which part, and its result.
    fn note(&self, _text: &str) {}

    /// Returns `true` if the work is to stop now and keep its results so far; called often.
    fn stopped(&self) -> bool {
        false
    }
}

/// No watch: the computation runs to its end.
impl Watch for () {}

/// A flag that stops a computation.
impl Watch for AtomicBool {
    fn stopped(&self) -> bool {
        self.load(Ordering::Relaxed)
    }
}

/// A watch that ignores progress: for a computation of unknown length.
pub struct StopOnly<'w>(pub &'w dyn Watch);

impl Watch for StopOnly<'_> {
    fn stopped(&self) -> bool {
        self.0.stopped()
    }
}

/// The watch on a part of the work, from the share `from` to the share `to` of the whole.
pub struct Part<'w> {
    /// The watch on the whole.
    pub watch: &'w dyn Watch,
    /// Share of the whole that is done when the part starts.
    pub from: f64,
    /// Share of the whole that is done when the part ends.
    pub to: f64,
}

impl Watch for Part<'_> {
    fn progress(&self, done: f64) {
        self.watch.progress(self.from + (self.to - self.from) * done);
    }

    fn stopped(&self) -> bool {
        self.watch.stopped()
    }
}
