//! A progress bar with rate and remaining time for work that takes longer than two seconds, and Ctrl-C.

use crate::interrupt::interrupted;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use motiform_dynamics::Watch;
use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Nothing is drawn before this: short runs show no progress bar.
const QUIET: Duration = Duration::from_secs(2);

/// Shows progress on a terminal and handles Ctrl-C.
pub(crate) struct Progress {
    bar: ProgressBar,
    started: Instant,
    /// The total work.
    total: f64,
    /// Whether Ctrl-C was pressed.
    stopped: Arc<AtomicBool>,
}

impl Progress {
    /// A watch over `total` of `unit` (model time, cells). The first Ctrl-C stops the run, the second ends the program.
    pub(crate) fn new(total: f64, unit: &'static str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total.ceil() as u64), ProgressDrawTarget::hidden());
        let template = "{bar:32} {percent:>3}%  {rate}  {eta} left";
        let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
        let rate = move |state: &ProgressState, out: &mut dyn std::fmt::Write| {
            let per_second = state.per_sec();
            // A bar that cannot be written is no loss.
            let _ = if (0.1..1e4).contains(&per_second) {
                write!(out, "{per_second:.1} {unit}/s")
            } else {
                write!(out, "{per_second:.2e} {unit}/s")
            };
        };
        bar.set_style(style.with_key("rate", rate));
        Self { bar, started: Instant::now(), total, stopped: interrupted() }
    }

    /// Removes the bar.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watch for Progress {
    fn progress(&self, done: f64) {
        if self.bar.is_hidden() && self.started.elapsed() > QUIET {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        // Never back: threads may report out of order.
        let done = (done * self.total) as u64;
        if done <= self.bar.position() {
            return;
        }
        self.bar.set_position(done);
    }

    fn note(&self, text: &str) {
        self.bar.suspend(|| {
            // Nothing is lost if nobody listens.
            let _ = writeln!(std::io::stderr(), "{text}");
        });
    }

    fn stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}
