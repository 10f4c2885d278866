//! Options of `statistics`.

use super::{
    FolderOptions, MethodOptions, ParameterOptions, Recording, SettingOptions, StyleOptions, ThreadOptions,
    UnitsOptions, number, whole,
};
use clap::Args;
use std::path::PathBuf;

const TRANSIENT: &str =
    "Model time to leave out: integrated before recording; of datasets, rows before this time";

#[derive(Args)]
#[command(mut_arg("transient", |transient| transient.help(TRANSIENT)))]
#[command(mut_arg("out", |out| out.help("Write tables, statistics.json and figures into this folder")))]
#[command(mut_arg("resume", |resume| resume.requires("out")))]
pub(crate) struct StatisticsOptions {
    /// A model or a preset (`motiform models` lists them), a study file ending in .toml, or folders written by `motiform simulate`, one
    /// body each
    #[arg(value_name = "MODEL|STUDY.toml|DATASET", required_unless_present = "preset")]
    pub(crate) subjects: Vec<PathBuf>,
    /// Start from a preset of the model, e.g. fig5a
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
    #[command(flatten)]
    pub(crate) parameters: ParameterOptions,
    #[command(flatten)]
    pub(crate) method: MethodOptions,
    /// Number of bodies to simulate (default: 100): body k has the seed --seed + k, so another random start and other noise
    #[arg(long, value_name = "N", value_parser = whole, allow_hyphen_values = true)]
    pub(crate) bodies: Option<u64>,
    #[command(flatten)]
    pub(crate) run: SettingOptions<Recording>,
    /// Radius of a disc for first-passage times (repeatable; default: six, from the displacements)
    #[arg(long = "disc", value_name = "R", value_parser = number, allow_hyphen_values = true)]
    pub(crate) radius: Vec<f64>,
    /// Residence times of this quantity above and below a threshold: speed, or the size of a mode (s, u; mode1, ...); without VALUE: its
    /// median (default: speed)
    #[arg(long, value_name = "QUANTITY[=VALUE]", value_parser = threshold)]
    pub(crate) threshold: Option<(String, Option<f64>)>,
    #[command(flatten)]
    pub(crate) threads: ThreadOptions,
    #[command(flatten)]
    pub(crate) folder: FolderOptions,
    #[command(flatten)]
    pub(crate) style: StyleOptions,
    #[command(flatten)]
    pub(crate) units: UnitsOptions,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

fn threshold(text: &str) -> Result<(String, Option<f64>), String> {
    match text.split_once('=') {
        Some((name, value)) => Ok((name.trim().to_owned(), Some(number(value.trim())?))),
        None => Ok((text.trim().to_owned(), None)),
    }
}

pub(super) const STATISTICS_HELP: &str = "\
Examples:
  motiform statistics tensor --preset fig5a --noise 0.01 --t-end 2000 --transient 100 --out noisy
  motiform statistics tensor --preset fig5b --bodies 200 --t-end 4000 --out chaos
  motiform statistics my-study.toml --bodies 50 --disc 5 --threshold speed=0.3 --json
  motiform statistics run1 run2 run3 --transient 50

What is measured, each with its 95 % interval (docs/statistics.md has the formulas):
  speed          its mean, root mean square and distribution
  persistence    time P and speed S of a persistent random walk, from mean-square displacements
  diffusion      coefficient D, of that walk (S^2 P/2); without a model of the motion from
                 velocities (Green and Kubo) and from displacements, and their difference
  correlation    integral correlation times of velocity, heading, speed, modes of the shape;
                 frequency and decay of those that oscillate
  leaves         mean first-passage times out of discs
  stays          residence times above and below a threshold
'unknown' comes with a reason: too short a track has no diffusion coefficient.

Without --dt-out samples are as far apart as in the subject's own run, and further, with a
warning, where all bodies would have more than two million. 'sampled too coarsely' says which
--dt-out is enough; 'not stationary' that --transient should be longer.
Intervals are those over bodies, from 8 bodies on. Fewer are cut into 16 blocks altogether: then
lags end within a block.

The output folder holds
  statistics.json      what --json prints
  msd, autocorrelations, distributions, spectra, first_passage              as .parquet
  msd, exponent, autocorrelations, speed, turning, spectra, first-passage   as .svg and .png
Ctrl-C measures the bodies that are finished. The numbers do not depend on --threads.";
