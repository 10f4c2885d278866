//! The command line: its arguments and their help texts.

mod atlas;
mod cells;
#[cfg(test)]
mod documented;
mod drawing;
mod folder;
#[cfg(test)]
mod fuzz;
mod help;
mod lifetimes;
mod motions;
mod scan;
mod settings;
mod statistics;
mod subject;
mod threads;
mod tools;
#[cfg(test)]
mod vocabulary;

use crate::commands;
use crate::output::End;
pub(crate) use atlas::AtlasOptions;
pub(crate) use cells::{CellsOptions, FitCellsOptions, ObserveOptions};
use clap::{Args, Parser, Subcommand, ValueEnum};
pub(crate) use drawing::{DrawingOptions, FilmFormat, StyleOptions, UnitsOptions};
pub(crate) use folder::FolderOptions;
#[cfg(feature = "explorer")]
use help::EXPLORE_HELP;
use help::{
    ATLAS_HELP, CLASSIFY_HELP, CONTINUE_HELP, EQUILIBRIA_HELP, EXAMPLES, FIGURE_HELP, LYAPUNOV_HELP,
    NEW_HELP, REPRODUCE_HELP, SCAN_HELP, SECTION_HELP, SIMULATE_HELP, VERIFY_HELP,
};
pub(crate) use lifetimes::LifetimesOptions;
use motiform_models::spelling::ascii;
use motiform_study::Random;
use motiform_study::scan::number;
pub(crate) use motions::{ContinueOptions, Crossing, EquilibriaOptions, Observable, SectionOptions};
pub(crate) use scan::{MergeOptions, ScanOptions};
pub(crate) use settings::{Bodies, Cells, Following, Method, Recording, SettingOptions, Span};
pub(crate) use statistics::StatisticsOptions;
use std::path::PathBuf;
pub(crate) use subject::{MethodOptions, ParameterOptions, SamplesOptions, SubjectOptions};
pub(crate) use threads::ThreadOptions;
pub(crate) use tools::{
    CheckOptions, CompletionsOptions, DoctorOptions, FigureOptions, NewOptions, VerifyOptions,
};

/// A laboratory for deformable self-propelled domains: cells, droplets and other bodies whose shape and motion
/// are coupled.
#[derive(Parser)]
#[command(name = "motiform", version, max_term_width = 100, arg_required_else_help = true, after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands: help, name, options, and the module of `commands` that carries it out, if the program is built with this feature.
macro_rules! commands {
    ($($(#[$help:meta])* $name:ident($options:ty) => $module:ident $(if $feature:literal)?,)*) => {
        #[derive(Subcommand)]
        pub(crate) enum Command {
            $($(#[$help])* $(#[cfg(feature = $feature)])? $name($options),)*
        }

        impl Command {
            /// Carries it out.
            pub(crate) fn run(self) -> anyhow::Result<End> {
                match self {
                    $($(#[cfg(feature = $feature)])? Self::$name(options) => commands::$module::run(&options),)*
                }
            }
        }
    };
}

commands! {
    /// List the models, or one model's equations, parameters and presets
    #[command(after_help = "More: docs/equations.md; units: docs/units.md.")]
    Models(ModelsOptions) => models,
    /// Simulate one body: write its path, shape and figures
    #[command(after_help = SIMULATE_HELP)]
    Simulate(Box<SimulateOptions>) => simulate,
    /// Compute a phase diagram over one or two parameters, or a map of basins over coordinates of the start, on all cores
    #[command(after_help = SCAN_HELP)]
    Scan(Box<ScanOptions>) => scan,
    /// Merge the folders of a scan that was computed in shards
    #[command(
        after_help = "Example: motiform merge shard1 shard2 shard3 --out whole\n\nMore: docs/clusters.md."
    )]
    Merge(MergeOptions) => merge,
    /// Classify a motion: its regime, the evidence for it, and how certain it is
    #[command(after_help = CLASSIFY_HELP)]
    Classify(Box<ClassifyOptions>) => classify,
    /// Compute Lyapunov exponents with errors: do neighbouring orbits separate?
    #[command(after_help = LYAPUNOV_HELP)]
    Lyapunov(Box<LyapunovOptions>) => lyapunov,
    /// Follow a motion along a parameter, stable or not: where it is born, changes and ends
    #[command(after_help = CONTINUE_HELP)]
    Continue(Box<ContinueOptions>) => continuation,
    /// Map a plane of two parameters: which motions happen where, and by which bifurcation each begins or ends
    #[command(after_help = ATLAS_HELP)]
    Atlas(Box<AtlasOptions>) => atlas,
    /// Find the steady motions at one point, stable or not: at rest, straight, circular
    #[command(after_help = EQUILIBRIA_HELP)]
    Equilibria(Box<EquilibriaOptions>) => equilibria,
    /// Find where a motion crosses a surface: one coordinate at a fixed value
    #[command(after_help = SECTION_HELP)]
    Section(Box<SectionOptions>) => section,
    /// Measure how long transient chaos lives along a parameter, and by which law: is there a crisis?
    #[command(after_help = lifetimes::LIFETIMES_HELP)]
    Lifetimes(Box<LifetimesOptions>) => lifetimes,
    /// Measure many bodies: mean-square displacement, diffusion, correlations, distributions, first-passage times, spectra
    #[command(after_help = statistics::STATISTICS_HELP)]
    Statistics(Box<StatisticsOptions>) => statistics,
    /// Say how tracked cells move: read outlines, compute modes and their quality, name the motion or what is missing
    #[command(after_help = cells::OBSERVE_HELP)]
    Observe(Box<ObserveOptions>) => observe,
    /// Fit the symmetric equations that describe tracked cells, with errors, regime and place on the paper's planes
    #[command(after_help = cells::FIT_HELP)]
    Fit(Box<FitCellsOptions>) => fit,
    /// Reproduce the paper: every figure, every claim, one HTML report
    #[command(after_help = REPRODUCE_HELP)]
    Reproduce(ReproduceOptions) => reproduce,
    /// Explore the models in a browser: a map of motions, and a body that moves at the chosen parameters
    #[command(after_help = EXPLORE_HELP)]
    Explore(ExploreOptions) => explore if "explorer",
    /// Write a commented study, or a model of your own, to start from
    #[command(after_help = NEW_HELP)]
    New(NewOptions) => new,
    /// Say what this machine has (vector instructions, ffmpeg, browser, Python), and time it: about a second
    #[command(after_help = "More: docs/recipes.md.")]
    Doctor(DoctorOptions) => doctor,
    /// Check a study file and print the resulting plan, without computing
    #[command(after_help = "More: docs/recipes.md, 'Study files'.")]
    Check(CheckOptions) => check,
    /// Check a result: digests of its files, the hash of its plan, and a sample of rows computed again and compared bit by bit
    #[command(after_help = VERIFY_HELP)]
    Verify(VerifyOptions) => verify,
    /// Redraw the figures of a result, without computing it again
    #[command(after_help = FIGURE_HELP)]
    Figure(FigureOptions) => figure,
    /// Print shell completions
    #[command(
        after_help = "Example: motiform completions bash > ~/.local/share/bash-completion/completions/motiform\n\nMore: docs/recipes.md."
    )]
    Completions(CompletionsOptions) => completions,
}

#[derive(Args)]
pub(crate) struct ModelsOptions {
    /// Show all details of this model, or of a study file with your own equations
    pub(crate) model: Option<String>,
    /// Show the values of this preset, too; `motiform models NAME` does so for the name of a preset
    #[arg(long, value_name = "NAME", requires = "model", conflicts_with = "json")]
    pub(crate) preset: Option<String>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct SimulateOptions {
    #[command(flatten)]
    pub(crate) subject: SubjectOptions,
    #[command(flatten)]
    pub(crate) method: MethodOptions,
    #[command(flatten)]
    pub(crate) run: SettingOptions<Recording>,
    /// Output folder (default: MODEL-PRESET in the current folder), or a single table if it ends in .parquet or .csv
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace an existing dataset; what motiform did not write stays
    #[arg(long)]
    pub(crate) force: bool,
    /// Print the result as one JSON object; writes files only with --out
    #[arg(long)]
    pub(crate) json: bool,
    /// Format of the tables in an output folder
    #[arg(long, value_enum, default_value_t = TableFormat::Parquet)]
    pub(crate) format: TableFormat,
    /// Write the tables without drawing
    #[arg(long)]
    pub(crate) no_figures: bool,
    #[command(flatten)]
    pub(crate) drawing: DrawingOptions,
}

/// The motion that a command analyses.
#[derive(Args)]
pub(crate) struct MotionOptions {
    #[command(flatten)]
    pub(crate) subject: SubjectOptions,
    #[command(flatten)]
    pub(crate) method: MethodOptions,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct ClassifyOptions {
    #[command(flatten)]
    pub(crate) motion: MotionOptions,
    #[command(flatten)]
    pub(crate) many: SamplesOptions,
    /// Replace zeros of a given start by random values within SIZE times its largest value (default: 1e-6), because an
    /// orbit never leaves an exact symmetry; 0 keeps the exact start
    #[arg(long, value_name = "SIZE", value_parser = number, allow_hyphen_values = true)]
    pub(crate) perturb: Option<f64>,
    /// Maximum model time to integrate; 0 is the model's default
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) budget: Option<f64>,
}

#[derive(Args)]
pub(crate) struct LyapunovOptions {
    #[command(flatten)]
    pub(crate) motion: MotionOptions,
    #[command(flatten)]
    pub(crate) many: SamplesOptions,
    /// Number of exponents, from the largest (default: all, but at most 6)
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u16), allow_hyphen_values = true)]
    pub(crate) count: Option<u16>,
    /// Model time to integrate before averaging (default: four looks of the model, 800 for tensor)
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) transient: Option<f64>,
    /// Model time to average over (default: twenty looks of the model, 4000 for tensor)
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) t_end: Option<f64>,
    /// For transient chaos: compute the exponent of the chaotic saddle from this many initial states, with the rate of
    /// escape; with --random, from starts of these sizes
    #[arg(long, value_name = "M", value_parser = clap::value_parser!(u16).range(2..), allow_hyphen_values = true)]
    #[arg(conflicts_with = "samples")]
    pub(crate) saddle: Option<u16>,
}

#[derive(Args)]
pub(crate) struct ReproduceOptions {
    /// fig1, fig2, ... fig6, equations (consequences of the equations as written), models (what both models have in common); all of these
    /// if none is given. Further: extensions (the presets with equations given as text)
    #[arg(value_name = "FIGURE")]
    pub(crate) figures: Vec<String>,
    /// Coarser scans and shorter runs, in about a minute of CPU time; claims for which this is too little evidence are not judged
    #[arg(long)]
    pub(crate) quick: bool,
    /// Output folder; an interrupted run continues there
    #[arg(long, value_name = "DIR", default_value = "reproduction")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) threads: ThreadOptions,
    #[command(flatten)]
    pub(crate) style: StyleOptions,
    /// Print the claims as one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[cfg(feature = "explorer")]
#[derive(Args)]
pub(crate) struct ExploreOptions {
    /// Start with this model, or with a study file ending in .toml, such as one with your own equations
    #[arg(value_name = "MODEL|STUDY.toml")]
    pub(crate) subject: Option<String>,
    /// Start with this preset, e.g. fig5a
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
    /// Port on this machine (default: 7373, or any free one)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..), allow_hyphen_values = true)]
    pub(crate) port: Option<u16>,
    /// The secret part of the address (default: a new random one); with that of an earlier start, its open pages reconnect
    #[arg(long, value_name = "TOKEN")]
    pub(crate) token: Option<String>,
    /// Print the address without opening a browser
    #[arg(long)]
    pub(crate) no_open: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum TableFormat {
    Parquet,
    Csv,
}

fn whole(text: &str) -> Result<u64, String> {
    text.parse()
        .map_err(|_| format!("{text:?} is not a whole number from 0 to {}: write it like 7", u64::MAX))
}

fn random(text: &str) -> Result<Random, String> {
    Random::parse(text).map_err(|error| error.to_string())
}

fn assignment(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("write NAME=VALUE, e.g. kappa2=0.9")?;
    Ok((ascii(name.trim()), number(value.trim())?))
}

fn tie(text: &str) -> Result<(String, String), String> {
    let (name, formula) =
        text.split_once('=').ok_or("write NAME=EXPRESSION, e.g. b3=d3 or kappa3=2*kappa2")?;
    Ok((ascii(name.trim()), ascii(formula.trim())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    /// A help is at most 100 columns wide: a row of a table fits in, and a paragraph is one line, which is broken where it is shown.
    #[test]
    fn rows_of_helps_fit_and_paragraphs_are_lines() {
        for command in std::iter::once(&Arguments::command()).chain(Arguments::command().get_subcommands()) {
            let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            let lines: Vec<&str> = help.lines().chain([""]).collect();
            for pair in lines.windows(2).filter(|pair| pair[0].len() > 100) {
                let (typed, row) = (pair[0].starts_with("  motiform "), pair[0].starts_with(' '));
                let ends = pair[1].is_empty() || pair[1].starts_with(' ');
                assert!(typed || !row && ends, "{}: {}", command.get_name(), pair[0]);
            }
        }
    }

    #[test]
    fn assignments_need_a_name_and_a_finite_number() {
        assert_eq!(assignment("kappa2 = -0.1"), Ok(("kappa2".to_owned(), -0.1)));
        for bad in ["kappa2", "kappa2=", "kappa2=a", "kappa2=nan", "kappa2=inf", "kappa2=1e999"] {
            assert!(assignment(bad).is_err(), "{bad}");
        }
    }
}
