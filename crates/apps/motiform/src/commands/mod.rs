//! One file per command.

mod atlas;
mod check;
mod classify;
mod completions;
mod continuation;
mod curves;
mod doctor;
mod equilibria;
#[cfg(feature = "explorer")]
mod explore;
mod figure;
mod film;
mod fit;
mod lifetimes;
mod lyapunov;
mod merge;
mod models;
mod new;
mod observe;
mod pages;
mod population;
mod remarks;
mod reproduce;
mod scan;
mod section;
mod simulate;
mod statistics;
mod subject;
mod verify;

use crate::args::Command;
use crate::output::End;

/// Carries out a command.
pub(crate) fn run(command: Command) -> anyhow::Result<End> {
    match command {
        Command::Models(options) => models::run(&options),
        Command::Simulate(options) => simulate::run(&options),
        Command::Scan(options) => scan::run(&options),
        Command::Merge(options) => merge::run(&options),
        Command::Classify(options) => classify::run(&options),
        Command::Lyapunov(options) => lyapunov::run(&options),
        Command::Continue(options) => continuation::run(&options),
        Command::Atlas(options) => atlas::run(&options),
        Command::Equilibria(options) => equilibria::run(&options),
        Command::Section(options) => section::run(&options),
        Command::Lifetimes(options) => lifetimes::run(&options),
        Command::Statistics(options) => statistics::run(&options),
        Command::Observe(options) => observe::run(&options),
        Command::Fit(options) => fit::run(&options),
        Command::Reproduce(options) => reproduce::run(&options),
        #[cfg(feature = "explorer")]
        Command::Explore(options) => explore::run(&options),
        Command::New(options) => new::run(&options),
        Command::Doctor(options) => doctor::run(&options),
        Command::Check(options) => check::run(&options),
        Command::Verify(options) => verify::run(&options),
        Command::Figure(options) => figure::run(&options),
        Command::Completions(options) => completions::run(&options),
    }
}
