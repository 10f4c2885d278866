//! Options that several commands share: the subject of the computation, and the method.

use super::{Method, SettingOptions, ThreadOptions, assignment, random, tie};
use clap::Args;
use motiform_study::Random;

/// The subject of a command.
#[derive(Args)]
pub(crate) struct SubjectOptions {
    /// A model or a preset (`motiform models` lists them), or a study file ending in .toml; not needed with --preset
    #[arg(value_name = "MODEL|STUDY.toml", required_unless_present = "preset")]
    pub(crate) subject: Option<String>,
    /// Start from a preset, e.g. fig5a
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
    #[command(flatten)]
    pub(crate) parameters: ParameterOptions,
}

/// Values of parameters.
#[derive(Args, Clone, Default)]
pub(crate) struct ParameterOptions {
    /// Set a parameter (repeatable); the axes of a scan take precedence
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, f64)>,
    /// Let a parameter follow from others (repeatable), also where those are varied: b3=d3, kappa3=2*kappa2
    #[arg(long = "tie", value_name = "NAME=EXPRESSION", value_parser = tie, allow_hyphen_values = true)]
    pub(crate) ties: Vec<(String, String)>,
}

/// Several initial states instead of one.
#[derive(Args)]
pub(crate) struct SamplesOptions {
    /// Use this many initial states: the given one, if any, and random ones of all sizes (see --random); on all cores
    #[arg(long, value_name = "M", value_parser = clap::value_parser!(u32).range(1..=1_000_000), allow_hyphen_values = true)]
    pub(crate) samples: Option<u32>,
    #[command(flatten)]
    pub(crate) threads: ThreadOptions,
}

/// The initial state of an orbit, and the numerical method.
#[derive(Args)]
pub(crate) struct MethodOptions {
    /// Set an initial value (repeatable); values not given are those of the preset's start, or 0. Without any, the start is that of the
    /// preset, or small and random
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) initial: Vec<(String, f64)>,
    /// Random starts: SIZE is each coordinate within +-SIZE (mode n of the cell: SIZE/n^2), MIN:MAX is all directions and log-uniform
    /// sizes. Default: 0.01 for one start; for several 0.01 to 1 times the model's typical size
    #[arg(long, value_name = "SIZE|MIN:MAX", value_parser = random, allow_hyphen_values = true)]
    pub(crate) random: Option<Random>,
    #[command(flatten)]
    pub(crate) run: SettingOptions<Method>,
}
