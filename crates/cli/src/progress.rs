//! A progress bar with rate and remaining time for what takes longer than two seconds, and Ctrl-C.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use motiform_study::simulate::Monitor;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Nothing is drawn before this: short runs stay quiet.
const QUIET: Duration = Duration::from_secs(2);

static STOPPED: AtomicBool = AtomicBool::new(false);

/// Shows progress on a terminal and listens for Ctrl-C.
pub(crate) struct Watch {
    bar: ProgressBar,
    started: Instant,
    /// Model time in all.
    total: f64,
}

impl Watch {
    /// A watch over `total` model time. The first Ctrl-C asks the run to stop, the second ends the program.
    pub(crate) fn new(total: f64) -> Self {
        // Fails only if a handler is set already: then the first one still works.
        let _ = ctrlc::set_handler(|| {
            if STOPPED.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        });
        let bar = ProgressBar::with_draw_target(Some(total.ceil() as u64), ProgressDrawTarget::hidden());
        let template = "{bar:32} {percent:>3}%  {rate}  {eta} left";
        let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
        let rate = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
            let _ = write!(out, "{:.2e} model time/s", state.per_sec()); // a bar that cannot be written is no loss
        };
        bar.set_style(style.with_key("rate", rate));
        Self { bar, started: Instant::now(), total }
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Monitor for Watch {
    fn progress(&self, done: f64) {
        if self.bar.is_hidden() && self.started.elapsed() > QUIET {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        self.bar.set_position((done * self.total) as u64);
    }

    fn stopped(&self) -> bool {
        STOPPED.load(Ordering::Relaxed)
    }
}
