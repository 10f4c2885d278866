//! Options of `atlas`.

use super::settings::{Lines, SettingOptions};
use super::{FolderOptions, StyleOptions, SubjectOptions, ThreadOptions, number, random, whole};
use clap::Args;
use motiform_study::Random;

#[derive(Args)]
#[command(mut_arg("out", |out| out.help("Output folder (default: MODEL-PRESET-atlas in the current folder)")))]
pub(crate) struct AtlasOptions {
    #[command(flatten)]
    pub(crate) subject: SubjectOptions,
    /// Vary a parameter (twice: across, then upwards): NAME=LOW:HIGH, or with the number of values of the finest grid NAME=LOW:HIGH:COUNT
    /// (default: 65, for stiff models 17; without axes those of the study, or the plane of the explorer's map)
    #[arg(long = "axis", value_name = "NAME=LOW:HIGH:COUNT")]
    pub(crate) axes: Vec<String>,
    /// Initial states per cell (default: 3); more find motions with smaller basins
    #[arg(long, value_name = "M", value_parser = whole, allow_hyphen_values = true)]
    pub(crate) samples: Option<u64>,
    /// Random initial states: SIZE is each coordinate within +-SIZE, MIN:MAX is all directions and log-uniform sizes (default: 0.01
    /// to 1 times the model's typical size)
    #[arg(long, value_name = "SIZE|MIN:MAX", value_parser = random, allow_hyphen_values = true)]
    pub(crate) random: Option<Random>,
    /// Seed of the random initial states
    #[arg(long, value_name = "N", value_parser = whole, allow_hyphen_values = true)]
    pub(crate) seed: Option<u64>,
    /// Maximum model time for classifying one motion; 0 is the model's default
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) budget: Option<f64>,
    #[command(flatten)]
    pub(crate) lines: SettingOptions<Lines>,
    #[command(flatten)]
    pub(crate) threads: ThreadOptions,
    #[command(flatten)]
    pub(crate) folder: FolderOptions,
    #[command(flatten)]
    pub(crate) style: StyleOptions,
    /// Do not draw figures, and write no page
    #[arg(long)]
    pub(crate) no_figures: bool,
    /// Print the summary as one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}
