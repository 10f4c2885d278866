//! `motiform`: a laboratory for deformable self-propelled domains, on the command line.
//!
//! Parses, calls the library, displays. No physics and no time loop.

mod args;
mod commands;
mod interrupt;
mod output;
mod progress;
mod remedy;
#[cfg(unix)]
mod standard_output;

use args::Arguments;
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    prepare();
    if let Err(error) = output::check() {
        return output::report(&error);
    }
    match Arguments::parse().command.run() {
        Ok(end) => end.into(),
        Err(error) => output::report(&error),
    }
}

/// Settings made before anything runs: a file that grows beyond its limit (`ulimit -f`) is an error instead of ending the process, and
/// panics of the Parquet library on damaged files, which are caught, are not shown.
fn prepare() {
    #[cfg(unix)]
    {
        // If this fails, the system's default stays: the process ends at the limit.
        let seen = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(false));
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, seen);
    }
    let shown = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !motiform_store::decoding() {
            shown(panic);
        }
    }));
}
