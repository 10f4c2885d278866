//! The command line: one place for its words.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// The laboratory for deformable self-propelled domains: cells, droplets and other bodies whose shape and motion
/// drive each other.
#[derive(Parser)]
#[command(name = "motiform", version, max_term_width = 100, arg_required_else_help = true, after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXAMPLES: &str = "\
Start here:
  motiform simulate tensor --preset fig5a       a zigzagging domain: numbers, figures, animation
  motiform models tensor                        its equations, parameters and presets

Exit codes: 0 done; 1 finished, but some result is not what was asked (a run escaped, a disk is full);
2 bad input; 130 interrupted (what was computed until then is kept).";

#[derive(Subcommand)]
pub(crate) enum Command {
    /// List the models, or one model's equations, parameters and presets
    Models(ModelsOptions),
    /// Move one body: write its path, shape and figures
    #[command(after_help = SIMULATE_HELP)]
    Simulate(Box<SimulateOptions>),
    /// Map the motions over one or two parameters, several initial states per cell, on all cores
    #[command(after_help = SCAN_HELP)]
    Scan(Box<ScanOptions>),
    /// Put folders with shards of one scan together
    #[command(after_help = "Example: motiform merge shard1 shard2 shard3 --out whole")]
    Merge(MergeOptions),
    /// Name a motion: the regime, the evidence for it, and how sure it is
    #[command(after_help = CLASSIFY_HELP)]
    Classify(Box<ClassifyOptions>),
    /// Lyapunov exponents with errors: do neighbouring motions part?
    #[command(after_help = LYAPUNOV_HELP)]
    Lyapunov(Box<LyapunovOptions>),
    /// Rebuild the paper: every figure, every claim, one HTML report
    #[command(after_help = REPRODUCE_HELP)]
    Reproduce(ReproduceOptions),
    /// Check a study file and print the plan it stands for, without computing
    Check(CheckOptions),
    /// Draw the figures of datasets and scans again, without computing
    Figure(FigureOptions),
    /// Print shell completions
    #[command(
        after_help = "Example: motiform completions bash > ~/.local/share/bash-completion/completions/motiform"
    )]
    Completions(CompletionsOptions),
}

const SIMULATE_HELP: &str = "\
Examples:
  motiform simulate tensor --preset fig5b --t-end 600
  motiform simulate tensor --preset fig4 --set kappa2=0.2 --set kappa3=0.1 --seed 7
  motiform simulate tensor --set gamma=1 --set a1=-1 --initial v1=0.1 --out run.csv
  motiform simulate cell --set length=13.2 --transient 4000 --t-end 4000
  motiform simulate tensor --preset fig2 --noise 1e-6 --t-end 5000
  motiform simulate my-study.toml --json

The output folder holds
  manifest.json        plan, hash, version, seed, outcome
  trajectory.parquet   time, position, shape, speed, turning rate
  path, series         figures, as .svg and .png; motion.png is the animation
  crossings.parquet    and the figure return-map, for studies with a return map
  fields.h5            phi(s, t) and outlines, and the figures phi and spectrum, for the cell";

const SCAN_HELP: &str = "\
Examples:
  motiform scan tensor --preset fig1 --axis kappa2=0.1:1.6:64 --axis gamma=0.1:1.5:64 --samples 4
  motiform scan tensor --preset fig4 --axis kappa2=0.1,0.2,0.5 --resume
  motiform scan my-study.toml --shard 1/3 --out shard1

The output folder holds
  _manifest.json       plan, hash, version
  part-*.parquet       one row per cell and initial state; pandas.read_parquet(DIR) reads them all
  _diagram             which motion occurs where, as .svg and .png; _exponent with one axis, where exponents are known
A scan that was interrupted or killed goes on with --resume. The numbers are the same for any number of threads, any
shards and any interruption. Exit code 1: some cells are undetermined.";

const CLASSIFY_HELP: &str = "\
Examples:
  motiform classify tensor --preset fig5a
  motiform classify cell --set length=21.6 --json
  motiform classify tensor --preset fig4 --set kappa2=0.2 --set kappa3=0.1 --seed 7

Regimes, by the dynamics of the shape with rotations divided out:
  motionless, straight, circular   a fixed shape (at rest, moving, turning), stable by its eigenvalues
  zigzag, quasi-periodic           a shape that comes back after a period, without or with a net rotation
  rectangular                      rests near motionless shapes, along a heteroclinic cycle that attracts
  chaotic                          the largest Lyapunov exponent is positive beyond its error
  blow-up                          the shape leaves every bound in finite time
  undetermined                     the evidence does not decide; it says what is missing (exit code 1)
The transient of a preset does not matter here: looks at the motion get longer until the evidence decides.";

const REPRODUCE_HELP: &str = "\
Examples:
  motiform reproduce --quick
  motiform reproduce fig4 fig5 --out paper

The output folder holds report.html (figures, parameters, claim by claim: what the paper says, what we find, how it was
decided, and why where they differ) and the scans behind it. Exit code 1: a claim failed.";

const LYAPUNOV_HELP: &str = "\
Examples:
  motiform lyapunov tensor --preset fig5b
  motiform lyapunov cell --set length=21.6 --count 3
  motiform lyapunov tensor --preset fig4 --set kappa2=0.3 --set kappa3=0.1 --saddle 200

Errors are half widths of 95 % confidence intervals. The exponents that must be zero (the flow's own direction and
the rotations') are a self-check. A run that escapes has no exponents: ask for the chaotic saddle's.";

#[derive(Args)]
pub(crate) struct ModelsOptions {
    /// Show this model whole
    pub(crate) model: Option<String>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct SimulateOptions {
    /// A model (`motiform models` lists them) or a study file ending in .toml
    #[arg(value_name = "MODEL|STUDY.toml")]
    pub(crate) subject: String,
    /// Start from a preset of the model, e.g. fig5a
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
    /// Set a parameter (repeatable)
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, f64)>,
    /// Set an initial value (repeatable); values not given are 0. Without any, the start is small and random
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) initial: Vec<(String, f64)>,
    /// Model time to record
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) t_end: Option<f64>,
    /// Model time to run before recording
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) transient: Option<f64>,
    /// Model time between recorded states (default: t-end / 2000)
    #[arg(long, value_name = "D", value_parser = number, allow_hyphen_values = true)]
    pub(crate) dt_out: Option<f64>,
    /// euler, heun, rk4 (fixed step), dopri5, dop853 (adaptive); for the stiff cell model ifrk4 (fixed step), etdrk4,
    /// krogstad4 (adaptive). Default: dop853 for tensor, krogstad4 for cell
    #[arg(long, value_name = "NAME")]
    pub(crate) stepper: Option<String>,
    /// Fixed step (without it, adaptive steppers control their own; the others take 1e-3)
    #[arg(long, value_name = "H", value_parser = number, allow_hyphen_values = true)]
    pub(crate) step: Option<f64>,
    /// Relative tolerance of adaptive steppers
    #[arg(long, value_name = "R", value_parser = number, allow_hyphen_values = true)]
    pub(crate) rtol: Option<f64>,
    /// Absolute tolerance of adaptive steppers
    #[arg(long, value_name = "A", value_parser = number, allow_hyphen_values = true)]
    pub(crate) atol: Option<f64>,
    /// Amplitude of additive white noise on the shape, the same in every direction
    #[arg(long, value_name = "ETA", value_parser = number, allow_hyphen_values = true)]
    pub(crate) noise: Option<f64>,
    /// Seed of the random start, and of the noise
    #[arg(long, value_name = "N", value_parser = whole, allow_hyphen_values = true)]
    pub(crate) seed: Option<u64>,
    /// Most steps to take
    #[arg(long, value_name = "N", value_parser = whole, allow_hyphen_values = true)]
    pub(crate) max_steps: Option<u64>,
    /// Output folder (default: MODEL-PRESET here), or one table if it ends in .parquet or .csv
    #[arg(long, value_name = "DIR|FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace an earlier dataset
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

/// What a command is about, for commands that ask about one motion.
#[derive(Args)]
pub(crate) struct MotionOptions {
    /// A model (`motiform models` lists them) or a study file ending in .toml
    #[arg(value_name = "MODEL|STUDY.toml")]
    pub(crate) subject: String,
    /// Start from a preset of the model, e.g. fig5a
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
    /// Set a parameter (repeatable)
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, f64)>,
    /// Set an initial value (repeatable); values not given are 0. Without any, the start is small and random
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) initial: Vec<(String, f64)>,
    /// Stepper (default: dop853 for tensor, krogstad4 for cell)
    #[arg(long, value_name = "NAME")]
    pub(crate) stepper: Option<String>,
    /// Fixed step (without it, adaptive steppers control their own; the others take 1e-3)
    #[arg(long, value_name = "H", value_parser = number, allow_hyphen_values = true)]
    pub(crate) step: Option<f64>,
    /// Relative tolerance of adaptive steppers
    #[arg(long, value_name = "R", value_parser = number, allow_hyphen_values = true)]
    pub(crate) rtol: Option<f64>,
    /// Absolute tolerance of adaptive steppers
    #[arg(long, value_name = "A", value_parser = number, allow_hyphen_values = true)]
    pub(crate) atol: Option<f64>,
    /// Seed of the random start
    #[arg(long, value_name = "N", value_parser = whole, allow_hyphen_values = true)]
    pub(crate) seed: Option<u64>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct ClassifyOptions {
    #[command(flatten)]
    pub(crate) motion: MotionOptions,
    /// Most model time to spend; 0 is the model's default
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) budget: Option<f64>,
}

#[derive(Args)]
pub(crate) struct LyapunovOptions {
    #[command(flatten)]
    pub(crate) motion: MotionOptions,
    /// How many exponents, from the largest (default: all, but at most 6)
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u16), allow_hyphen_values = true)]
    pub(crate) count: Option<u16>,
    /// Model time to run before averaging (default: 800 for tensor, 6000 for cell)
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) transient: Option<f64>,
    /// Model time to average over (default: 4000 for tensor, 30000 for cell)
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) t_end: Option<f64>,
    /// For chaos that does not last: the exponent of the chaotic saddle, from this many initial states, with the rate at
    /// which they escape
    #[arg(long, value_name = "M", value_parser = clap::value_parser!(u16).range(2..), allow_hyphen_values = true)]
    pub(crate) saddle: Option<u16>,
}

#[derive(Args)]
pub(crate) struct ReproduceOptions {
    /// fig1, fig2, ... fig6, models (what both models have in common); everything if none is given
    #[arg(value_name = "FIGURE")]
    pub(crate) figures: Vec<String>,
    /// Coarser scans and shorter runs: within a minute
    #[arg(long)]
    pub(crate) quick: bool,
    /// Output folder; a run that was interrupted goes on there
    #[arg(long, value_name = "DIR", default_value = "reproduction")]
    pub(crate) out: PathBuf,
    /// Threads (default: all cores); changes no number
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), allow_hyphen_values = true)]
    pub(crate) threads: Option<u16>,
    /// Print the claims as one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct ScanOptions {
    /// A model (`motiform models` lists them) or a study file ending in .toml
    #[arg(value_name = "MODEL|STUDY.toml")]
    pub(crate) subject: String,
    /// Start from a preset of the model, e.g. fig4
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
    /// Set a parameter (repeatable); axes win over it
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, f64)>,
    /// Vary a parameter (once or twice): NAME=LOW:HIGH:COUNT, both ends included, or NAME=v1,v2,v3
    #[arg(long = "axis", value_name = "NAME=LOW:HIGH:COUNT")]
    pub(crate) axes: Vec<String>,
    /// Initial states per cell (default: 1)
    #[arg(long, value_name = "M", value_parser = whole, allow_hyphen_values = true)]
    pub(crate) samples: Option<u64>,
    /// Seed of the random initial states
    #[arg(long, value_name = "N", value_parser = whole, allow_hyphen_values = true)]
    pub(crate) seed: Option<u64>,
    /// Most model time that naming one motion may take; 0 is the model's default
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) budget: Option<f64>,
    /// Fused multiply-add: faster, other last digits (the same ones on every machine)
    #[arg(long)]
    pub(crate) fast: bool,
    /// Output folder (default: MODEL-PRESET-scan here)
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Go on with the scan in the output folder (start it, if there is none)
    #[arg(long, conflicts_with = "force")]
    pub(crate) resume: bool,
    /// Compute one of N shares; `motiform merge` puts the folders together
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<String>,
    /// Threads (default: all cores); changes no number
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), allow_hyphen_values = true)]
    pub(crate) threads: Option<u16>,
    /// Replace an earlier scan
    #[arg(long)]
    pub(crate) force: bool,
    /// Leave the figures out
    #[arg(long)]
    pub(crate) no_figures: bool,
    /// Print the summary as one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct MergeOptions {
    /// Folders written by `motiform scan` with the same plan
    #[arg(value_name = "DIR", required = true)]
    pub(crate) folders: Vec<PathBuf>,
    /// Output folder
    #[arg(long, value_name = "DIR", required = true)]
    pub(crate) out: PathBuf,
    /// Replace an earlier scan
    #[arg(long)]
    pub(crate) force: bool,
    /// Print the summary as one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct DrawingOptions {
    /// Do not draw the animation
    #[arg(long)]
    pub(crate) no_animation: bool,
    /// Radius R0 of the undeformed body (default: so that the deformation is seen)
    #[arg(long, value_name = "R0", value_parser = number, allow_hyphen_values = true)]
    pub(crate) radius: Option<f64>,
    /// Size of the drawn outlines against the path (default: readable)
    #[arg(long, value_name = "F", value_parser = number, allow_hyphen_values = true)]
    pub(crate) scale: Option<f64>,
    /// Number of outlines along the path
    #[arg(long, value_name = "N", value_parser = whole, allow_hyphen_values = true)]
    pub(crate) outlines: Option<u64>,
    /// Draw from this time
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) from: Option<f64>,
    /// Draw to this time
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) to: Option<f64>,
    /// Also write PDF figures
    #[cfg(feature = "pdf")]
    #[arg(long)]
    pub(crate) pdf: bool,
}

#[derive(Args)]
pub(crate) struct CheckOptions {
    /// The study file
    #[arg(value_name = "STUDY.toml", required_unless_present = "schema")]
    pub(crate) study: Option<PathBuf>,
    /// Print the plan as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print the JSON schema of study files
    #[arg(long)]
    pub(crate) schema: bool,
}

#[derive(Args)]
pub(crate) struct FigureOptions {
    /// Folders written by `motiform simulate` or `motiform scan`
    #[arg(value_name = "DATASET", required = true)]
    pub(crate) datasets: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) drawing: DrawingOptions,
}

#[derive(Args)]
pub(crate) struct CompletionsOptions {
    /// The shell
    pub(crate) shell: clap_complete::Shell,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum TableFormat {
    Parquet,
    Csv,
}

fn number(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| format!("{text:?} is no number: write it like 0.5 or 1e-9"))?;
    if value.is_finite() { Ok(value) } else { Err(format!("{text} is not finite: give a finite number")) }
}

fn whole(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("{text:?} is no whole number from 0 to {}: write it like 7", u64::MAX))
}

fn assignment(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("write NAME=VALUE, e.g. kappa2=0.9")?;
    Ok((name.trim().to_owned(), number(value.trim())?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn assignments_need_a_name_and_a_finite_number() {
        assert_eq!(assignment("kappa2 = -0.1"), Ok(("kappa2".to_owned(), -0.1)));
        for bad in ["kappa2", "kappa2=", "kappa2=a", "kappa2=nan", "kappa2=inf", "kappa2=1e999"] {
            assert!(assignment(bad).is_err(), "{bad}");
        }
    }
}
