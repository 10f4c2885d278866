//! Output for the user, and the exit code.

use crate::remedy;
use motiform_dynamics::Outcome;
use motiform_figures::Label;
use motiform_lab::answers::Answer;
use motiform_study::Error;
use std::io::{self, Write};
use std::process::ExitCode;

/// The end of a successful command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// All results are as requested.
    Done,
    /// Finished, but some result is not as requested.
    NotAsAsked,
    /// Interrupted by the user.
    Interrupted,
}

impl From<End> for ExitCode {
    fn from(end: End) -> Self {
        Self::from(match end {
            End::Done => 0,
            End::NotAsAsked => 1,
            End::Interrupted => 130,
        })
    }
}

impl From<&Outcome> for End {
    fn from(outcome: &Outcome) -> Self {
        match outcome {
            Outcome::Interrupted { .. } => Self::Interrupted,
            outcome if outcome.is_complete() => Self::Done,
            _ => Self::NotAsAsked,
        }
    }
}

/// Prints an answer: its lines, or with `--json` its object.
pub(crate) fn say(answer: &impl Answer, json: bool) -> anyhow::Result<()> {
    print(&answer.said(json)?)
}

/// Prints `text` and a line end on standard output. A closed pipe is not an error; a full disk is.
pub(crate) fn print(text: &str) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(StdoutFailed(error).into()),
        Ok(()) => Ok(()),
    }
}

/// Checks that there is a standard output, before anything is computed for it.
pub(crate) fn check() -> anyhow::Result<()> {
    #[cfg(unix)]
    if crate::standard_output::was_closed() {
        anyhow::bail!(
            "standard output is closed: what this command says would be lost; give it a place, or `> /dev/null`"
        );
    }
    Ok(())
}

/// A label of figures as text: 10^-3, z_1.
pub(crate) fn plain(label: &str) -> String {
    Label::parse(label).terminal()
}

/// Prints a warning about a result on standard error.
pub(crate) fn warn(text: &str) {
    // Nothing is lost if nobody listens.
    let _ = writeln!(io::stderr(), "warning: {text}");
}

/// Standard output could not be written.
#[derive(Debug)]
struct StdoutFailed(io::Error);

impl std::fmt::Display for StdoutFailed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "writing standard output failed: {}", self.0)
    }
}

impl std::error::Error for StdoutFailed {}

/// Prints an error on standard error. Exit code 2: nothing was found, because of the input or because files could not be written; 1
/// where numbers are there and only a figure cannot be drawn; 130 if it was a stop.
pub(crate) fn report(error: &anyhow::Error) -> ExitCode {
    // Standard error is the last resort: nothing is left to say if it fails too.
    let remedy = remedy::end(error);
    let _ = writeln!(io::stderr(), "error: {error:#}{remedy}");
    match error.downcast_ref() {
        Some(Error::Interrupted) => End::Interrupted.into(),
        Some(Error::Figure(_)) => End::NotAsAsked.into(),
        _ => ExitCode::from(2),
    }
}
