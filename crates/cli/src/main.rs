//! `motiform`: the laboratory for deformable self-propelled domains, on the command line.
//!
//! Parses, calls the study layer, shows. No physics and no time loop here.

mod args;
mod commands;
mod output;
mod progress;

use args::{Arguments, Command};
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match arguments.command {
        Command::Models(options) => commands::models::run(&options),
        Command::Simulate(options) => commands::simulate::run(&options),
        Command::Scan(options) => commands::scan::run(&options),
        Command::Merge(options) => commands::merge::run(&options),
        Command::Classify(options) => commands::classify::run(&options),
        Command::Lyapunov(options) => commands::lyapunov::run(&options),
        Command::Reproduce(options) => commands::reproduce::run(&options),
        #[cfg(feature = "explorer")]
        Command::Explore(options) => commands::explore::run(&options),
        Command::Check(options) => commands::check::run(&options),
        Command::Figure(options) => commands::figure::run(&options),
        Command::Completions(options) => commands::completions::run(&options),
    };
    match done {
        Ok(end) => end.into(),
        Err(error) => output::report(&error),
    }
}
