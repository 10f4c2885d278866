//! Options of `lifetimes`.

use super::{
    FolderOptions, Method, SettingOptions, StyleOptions, SubjectOptions, ThreadOptions, UnitsOptions, number,
    random, whole,
};
use clap::Args;
use motiform_study::Random;

#[derive(Args)]
#[command(mut_arg("out", |out| out.help("Write lifetimes.json and the figure mean-life into this folder")))]
#[command(mut_arg("resume", |resume| resume.requires("out")))]
pub(crate) struct LifetimesOptions {
    #[command(flatten)]
    pub(crate) subject: SubjectOptions,
    /// The parameter and its values: NAME=LOW:HIGH:COUNT, both ends included, or NAME=v1,v2,v3
    #[arg(long = "axis", value_name = "NAME=LOW:HIGH:COUNT", required = true)]
    pub(crate) along: String,
    /// Random initial states for each value
    #[arg(long, value_name = "M", value_parser = whole, allow_hyphen_values = true, default_value_t = 64)]
    pub(crate) samples: u64,
    /// Longest model time for which an orbit is followed, in whole looks of the model (200 for tensor); default: 100 looks
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) until: Option<f64>,
    /// Model time after which a life counts: the way onto the chaotic set (default: see below)
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) transient: Option<f64>,
    /// Random initial states: SIZE is each coordinate within +-SIZE, MIN:MAX is all directions and log-uniform sizes
    /// (default: 0.01 to 1 times the model's typical size)
    #[arg(long, value_name = "SIZE|MIN:MAX", value_parser = random, allow_hyphen_values = true)]
    pub(crate) random: Option<Random>,
    #[command(flatten)]
    pub(crate) run: SettingOptions<Method>,
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

pub(super) const LIFETIMES_HELP: &str = "\
Examples:
  motiform lifetimes tensor --preset fig4 --set kappa3=0.1 --axis kappa2=0.36:0.46:6 --until 2e5
  motiform lifetimes tensor --preset fig4 --set kappa3=0.1 --axis kappa2=1.1995,1.2002,1.2003,1.2004,1.2006,1.2008 \
    --samples 128 --random 0.01 --until 4e4 --out crisis

Chaos that is transient ends in one of two ways: the body blows up, or it is captured by a stable steady motion. For each value the \
table shows how many of the starts did, the number of events (ends of lives after --transient), the time watched, and the mean life \
with its exact 95 % limits. A start that is still chaotic at --until counts as watched until then.

Two laws of the mean life tau are compared by likelihood: tau = C |p - pc|^-gamma (chaos becomes transient in a crisis at pc) and \
tau = C exp(-k p) (no crisis). 'Cannot be told apart' is an answer: give more --samples, or values closer to the suspected crisis.

Default of --transient: one look of the model, or if orbits are captured, twice the time that the approach to their steady motion takes.

Exit code 1: there are too few events to compare laws, neither law holds, or the lives are not exponential. See docs/lifetimes.md.";
