//! Progress of work that takes longer than some seconds, and Ctrl-C: a bar with rate and remaining time on a terminal, else a line
//! every ten seconds. Work in stages tells the name of the present one, and a remaining time only where it follows from what is done.

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

/// A named stage of the work.
struct Stage {
    /// Its number and its name.
    name: String,
    started: Instant,
    /// Its part of the progress that is told.
    share: [f64; 2],
    /// The whole that its share is of.
    done: &'static str,
    /// `true` if the remaining time follows from the share.
    even: bool,
}

/// Shows progress and handles Ctrl-C.
pub(crate) struct Progress {
    bar: ProgressBar,
    started: Instant,
    /// The total work.
    total: f64,
    /// The present stage, and how many began; of so many.
    stage: Mutex<(Option<Stage>, usize)>,
    stages: usize,
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
        Self { bar, started, total, stage: Mutex::default(), stages: 0, next, stopped: interrupted() }
    }

    /// A watch over work in so many stages, each of which is announced ([`Progress::stage`]).
    pub(crate) fn staged(stages: usize) -> Self {
        Self { stages, ..Self::new(1000.0, "permille") }
    }

    /// A stage begins: a part of the progress that is told, what its share is of, and whether the remaining time follows from that.
    pub(crate) fn stage(&self, name: &str, share: [f64; 2], done: &'static str, even: bool) {
        let Ok(mut stage) = self.stage.lock() else { return };
        stage.1 += 1;
        let name = if self.stages == 1 {
            name.to_owned()
        } else {
            format!("{} of {}, {name}", stage.1, self.stages)
        };
        let template =
            if even { "{msg}: {percent}%, {eta} left" } else { "{msg}: {percent}% {prefix}, {elapsed}" };
        let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
        self.bar.set_style(style);
        self.bar.set_message(name.clone());
        self.bar.set_prefix(done);
        self.bar.reset();
        stage.0 = Some(Stage { name, started: Instant::now(), share, done, even });
    }

    /// Writes how far the work is, if a line is due.
    fn line(&self, next: &Mutex<Instant>, done: f64) {
        let Ok(mut next) = next.try_lock() else { return }; // another thread writes it
        if Instant::now() < *next {
            return;
        }
        *next = Instant::now() + BETWEEN;
        // Nothing is lost if nobody listens.
        let _ = writeln!(std::io::stderr(), "{}", self.sentence(done));
    }

    /// The progress in words, of the present stage if the work has stages.
    fn sentence(&self, done: f64) -> String {
        let stage = self.stage.lock().ok();
        match stage.as_ref().and_then(|stage| stage.0.as_ref()) {
            Some(stage) => stage.sentence(done, stage.started.elapsed().as_secs_f64()),
            None => sentence(done, self.started.elapsed().as_secs_f64()),
        }
    }

    /// The share of the present stage that is done, or of the whole, and `true` if it may become smaller: what is left to do is found on
    /// the way.
    fn share(&self, done: f64) -> (f64, bool) {
        let stage = self.stage.lock().ok();
        let present = stage.as_ref().and_then(|stage| stage.0.as_ref());
        present.map_or((done, false), |stage| (stage.part(done), !stage.even))
    }

    /// A watch over work in one stage, whose remaining time does not follow from its progress.
    pub(crate) fn of_stage(name: &str, done: &'static str) -> Self {
        let watch = Self::staged(1);
        watch.stage(name, [0.0, 1.0], done, false);
        watch
    }

    /// Watches this work; the bar is removed at its end.
    pub(crate) fn over<T>(self, work: impl FnOnce(&Self) -> T) -> T {
        let found = work(&self);
        self.finish();
        found
    }

    /// Removes the bar.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Stage {
    /// The share of it that is done, from that of the progress that is told.
    fn part(&self, done: f64) -> f64 {
        let [from, to] = self.share;
        ((done - from) / (to - from)).clamp(0.0, 1.0)
    }

    /// Its progress after some seconds.
    fn sentence(&self, done: f64, spent: f64) -> String {
        let (name, part) = (&self.name, self.part(done));
        if self.even {
            return format!("{name}: {}", sentence(part, spent));
        }
        format!("{name}: {:.1} % {} after {spent:.0} s", 100.0 * part, self.done)
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
        let (share, back) = self.share(done);
        let done = (share * self.total) as u64;
        // Threads may report out of order.
        if done <= self.bar.position() && !back {
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
    use super::{Stage, sentence};
    use std::time::Instant;

    #[test]
    fn a_line_says_what_is_done_and_what_is_left() {
        assert_eq!(sentence(0.25, 12.0), "25.0 % done after 12 s, about 36 s left");
        assert_eq!(sentence(0.0, 12.0), "0.0 % done after 12 s");
        assert_eq!(sentence(1.0, 12.0), "100.0 % done after 12 s, about 0 s left");
    }

    #[test]
    fn a_stage_has_its_name_and_a_remaining_time_only_where_that_is_known() {
        let stage = |even, done| Stage {
            name: "2 of 3, finer grid".to_owned(),
            started: Instant::now(),
            share: [0.5, 1.0],
            done,
            even,
        };
        let even = stage(true, "done").sentence(0.625, 12.0);
        assert_eq!(even, "2 of 3, finer grid: 25.0 % done after 12 s, about 36 s left");
        let open = stage(false, "of the boundaries named").sentence(0.75, 9.0);
        assert_eq!(open, "2 of 3, finer grid: 50.0 % of the boundaries named after 9 s");
    }
}
