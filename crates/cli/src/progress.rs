//! Progress of work that takes longer than some seconds, and Ctrl-C: a bar with rate and remaining time on a terminal, else a line
//! every ten seconds.

use crate::interrupt::interrupted;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use motiform_dynamics::Watch;
use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Nothing is drawn before this: short runs show no progress bar.
const QUIET: Duration = Duration::from_secs(2);

/// Time between two lines, where standard error is no terminal.
const BETWEEN: Duration = Duration::from_secs(10);

/// Shows progress and handles Ctrl-C.
pub(crate) struct Progress {
    bar: ProgressBar,
    started: Instant,
    /// The total work.
    total: f64,
    /// When the next line is due, where standard error is no terminal.
    next: Option<Mutex<Instant>>,
    /// `true` if Ctrl-C was pressed.
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
        let started = Instant::now();
        let next = (!std::io::stderr().is_terminal()).then(|| Mutex::new(started + BETWEEN));
        Self { bar, started, total, next, stopped: interrupted() }
    }

    /// Writes how far the work is, if a line is due.
    fn line(&self, next: &Mutex<Instant>, done: f64) {
        let Ok(mut next) = next.try_lock() else { return }; // another thread writes it
        if Instant::now() < *next {
            return;
        }
        *next = Instant::now() + BETWEEN;
        // Nothing is lost if nobody listens.
        let _ = writeln!(std::io::stderr(), "{}", sentence(done, self.started.elapsed().as_secs_f64()));
    }

    /// Removes the bar.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// The progress of the work after some seconds: `34.2 % done after 12 s, about 23 s left`.
fn sentence(done: f64, spent: f64) -> String {
    let line = format!("{:.1} % done after {spent:.0} s", 100.0 * done);
    if done > 0.0 { format!("{line}, about {:.0} s left", spent * (1.0 / done - 1.0)) } else { line }
}

impl Watch for Progress {
    fn progress(&self, done: f64) {
        if self.bar.is_hidden() && self.started.elapsed() > QUIET {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        if let Some(next) = &self.next {
            self.line(next, done);
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

#[cfg(test)]
mod tests {
    use super::sentence;

    #[test]
    fn a_line_says_what_is_done_and_what_is_left() {
        assert_eq!(sentence(0.25, 12.0), "25.0 % done after 12 s, about 36 s left");
        assert_eq!(sentence(0.0, 12.0), "0.0 % done after 12 s");
        assert_eq!(sentence(1.0, 12.0), "100.0 % done after 12 s, about 0 s left");
    }
}
