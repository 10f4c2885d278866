//! Options of `scan` and `merge`.

use super::{
    Cells, FolderOptions, Method, SettingOptions, StyleOptions, SubjectOptions, ThreadOptions, UnitsOptions,
    assignment, number, random,
};
use clap::Args;
use motiform_study::Random;
use std::path::PathBuf;

#[derive(Args)]
#[command(mut_arg("out", |out| out.help("Output folder (default: MODEL-PRESET-scan in the current folder)")))]
pub(crate) struct ScanOptions {
    #[command(flatten)]
    pub(crate) subject: SubjectOptions,
    #[command(flatten)]
    pub(crate) scan: SettingOptions<Cells>,
    /// Set an initial value (repeatable) of the first initial state of every cell; values not given are those of the preset's
    /// start, or 0. Without any, without a preset's start and without a coordinate on an axis, that one is small and random
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub(crate) initial: Vec<(String, f64)>,
    /// Random initial states: SIZE is each coordinate within +-SIZE (mode n of the cell: SIZE/n^2; default for one state: 0.01),
    /// MIN:MAX is all directions and log-uniform sizes (default for several: 0.01 to 1 times the model's typical size)
    #[arg(long, value_name = "SIZE|MIN:MAX", value_parser = random, allow_hyphen_values = true)]
    pub(crate) random: Option<Random>,
    #[command(flatten)]
    pub(crate) run: SettingOptions<Method>,
    /// Replace zeros of a given start by random values within SIZE times its largest value (default: 1e-6), because an
    /// orbit never leaves an exact symmetry; 0 keeps the exact start
    #[arg(long, value_name = "SIZE", value_parser = number, allow_hyphen_values = true)]
    pub(crate) perturb: Option<f64>,
    /// Compute share I of N; `motiform merge` combines the folders
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<String>,
    #[command(flatten)]
    pub(crate) threads: ThreadOptions,
    #[command(flatten)]
    pub(crate) folder: FolderOptions,
    #[command(flatten)]
    pub(crate) style: StyleOptions,
    #[command(flatten)]
    pub(crate) units: UnitsOptions,
    /// Do not draw figures
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
    /// Replace an existing scan; what motiform did not write stays
    #[arg(long)]
    pub(crate) force: bool,
    /// Print the summary as one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}
