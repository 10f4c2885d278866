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

use args::{Arguments, Command};
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    prepare();
    if let Err(error) = output::check() {
        return output::report(&error);
    }
    let arguments = Arguments::parse();
    let done = match arguments.command {
        Command::Models(options) => commands::models::run(&options),
        Command::Simulate(options) => commands::simulate::run(&options),
        Command::Scan(options) => commands::scan::run(&options),
        Command::Merge(options) => commands::merge::run(&options),
        Command::Classify(options) => commands::classify::run(&options),
        Command::Lyapunov(options) => commands::lyapunov::run(&options),
        Command::Continue(options) => commands::continuation::run(&options),
        Command::Atlas(options) => commands::atlas::run(&options),
        Command::Equilibria(options) => commands::equilibria::run(&options),
        Command::Section(options) => commands::section::run(&options),
        Command::Lifetimes(options) => commands::lifetimes::run(&options),
        Command::Statistics(options) => commands::statistics::run(&options),
        Command::Observe(options) => commands::observe::run(&options),
        Command::Fit(options) => commands::fit::run(&options),
        Command::Reproduce(options) => commands::reproduce::run(&options),
        #[cfg(feature = "explorer")]
        Command::Explore(options) => commands::explore::run(&options),
        Command::New(options) => commands::new::run(&options),
        Command::Doctor(options) => commands::doctor::run(&options),
        Command::Check(options) => commands::check::run(&options),
        Command::Verify(options) => commands::verify::run(&options),
        Command::Figure(options) => commands::figure::run(&options),
        Command::Completions(options) => commands::completions::run(&options),
    };
    match done {
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
