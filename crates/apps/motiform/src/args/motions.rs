//! The words of `continue`, `equilibria` and `section`: commands about motions that may be unstable.

use super::{
    FolderOptions, Following, MethodOptions, MotionOptions, SettingOptions, Span, StyleOptions,
    SubjectOptions, UnitsOptions, number,
};
use clap::{Args, ValueEnum};
use motiform_diagrams::draw::Ordinate;
use std::path::PathBuf;

#[derive(Args)]
#[command(mut_arg("subject", |subject| subject.required_unless_present("start")))]
#[command(mut_arg("from_stable", |from_stable| from_stable.conflicts_with("steady")))]
#[command(mut_arg("out", |out| out.help("Output folder (default: MODEL-PRESET-branches here, with --curve MODEL-PRESET-curves)")))]
pub(crate) struct ContinueOptions {
    #[command(flatten)]
    pub(crate) subject: SubjectOptions,
    #[command(flatten)]
    pub(crate) method: MethodOptions,
    #[command(flatten)]
    pub(crate) follow: SettingOptions<Following>,
    /// Start from a point of an earlier result, stable or not, with its parameters; --set changes them. FOLDER:BRANCH:POINT of
    /// `continue`, FILE.json:NUMBER of `equilibria --json`, DATASET[:t=TIME|:ROW] of `simulate`. Without POINT, a dataset
    /// starts from its last state, and the others list their points
    #[arg(long, value_name = "FILE[:POINT]", conflicts_with_all = ["initial", "random"])]
    pub(crate) start: Option<String>,
    /// Draw the curves over this scan of the same plane
    #[arg(long, value_name = "SCAN", requires = "curve")]
    pub(crate) over: Option<PathBuf>,
    /// Quantity that the diagram shows against the parameter
    #[arg(long, value_name = "NAME", value_enum, default_value_t = Observable::Speed)]
    pub(crate) observable: Observable,
    /// Zeros of a given start become random values within SIZE times its largest value (default: 1e-6), because an
    /// orbit never leaves an exact symmetry; 0 keeps the exact start
    #[arg(long, value_name = "SIZE", value_parser = number, allow_hyphen_values = true)]
    pub(crate) perturb: Option<f64>,
    #[command(flatten)]
    pub(crate) folder: FolderOptions,
    #[command(flatten)]
    pub(crate) style: StyleOptions,
    #[command(flatten)]
    pub(crate) units: UnitsOptions,
    /// Leave the figures out
    #[arg(long)]
    pub(crate) no_figures: bool,
    /// Print the summary as one JSON object; writes files only with --out
    #[arg(long)]
    pub(crate) json: bool,
}

impl Observable {
    /// The axis of the diagram.
    pub(crate) fn ordinate(self) -> Ordinate {
        match self {
            Self::Speed => Ordinate::Speed,
            Self::TurningRate => Ordinate::TurningRate,
            Self::Size => Ordinate::Size,
            Self::NetRotation => Ordinate::NetRotation,
        }
    }
}

/// The quantity that a diagram shows.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Observable {
    /// Mean speed
    Speed,
    /// Mean turning rate of the heading
    TurningRate,
    /// Largest size of the shape
    Size,
    /// Net rotation per period
    NetRotation,
}

#[derive(Args)]
pub(crate) struct EquilibriaOptions {
    #[command(flatten)]
    pub(crate) motion: MotionOptions,
    /// Number of random shapes Newton's method starts from, beside the circle
    #[arg(long, value_name = "M", default_value_t = 200, allow_hyphen_values = true)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) starts: u32,
}

#[derive(Args)]
pub(crate) struct SectionOptions {
    #[command(flatten)]
    pub(crate) motion: MotionOptions,
    /// The surface: a coordinate of the shape, or x or y, at a fixed value
    #[arg(long, value_name = "NAME=VALUE", value_parser = super::assignment, allow_hyphen_values = true)]
    pub(crate) at: (String, f64),
    /// Which crossings count
    #[arg(long = "crossings", value_enum, default_value_t = Crossing::Rising)]
    pub(crate) direction: Crossing,
    #[command(flatten)]
    pub(crate) run: SettingOptions<Span>,
}

/// Which crossings count.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Crossing {
    /// Where the coordinate grows
    Rising,
    /// Where it falls
    Falling,
    /// Both
    Either,
}
