//! Options of the commands about files and the machine.

use super::{DrawingOptions, Observable};
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct NewOptions {
    /// The file; one that exists stays as it is
    #[arg(value_name = "FILE.toml")]
    pub(crate) file: PathBuf,
    /// Write equations as text instead of a study of the tensor model
    #[arg(long)]
    pub(crate) equations: bool,
}

#[derive(Args)]
pub(crate) struct DoctorOptions {
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
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
    /// Folders written by `motiform simulate`, `scan`, `continue` or `atlas` (those of other commands are drawn once); as a panel also one
    /// figure of a folder, such as DIR:series
    #[arg(value_name = "DIR", required = true)]
    pub(crate) datasets: Vec<PathBuf>,
    /// Draw figures again that were edited since; the edited ones are kept as NAME.edited.svg. With --out: replace earlier figures there
    #[arg(long)]
    pub(crate) force: bool,
    /// Write the figures into this folder; those of the result stay as they are
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// One figure of panels (a), (b), ... with aligned axes: the first figure of each folder, in rows from the left
    #[arg(long, value_name = "COLUMNSxROWS", value_parser = grid, requires = "out")]
    pub(crate) panels: Option<[usize; 2]>,
    /// Quantity that a diagram of branches shows against the parameter
    #[arg(long, value_name = "NAME", value_enum)]
    pub(crate) observable: Option<Observable>,
    #[command(flatten)]
    pub(crate) drawing: DrawingOptions,
}

/// Most panels of a figure: one for each letter.
const LETTERS: usize = 26;

fn grid(text: &str) -> Result<[usize; 2], String> {
    let number = |text: &str| text.trim().parse().ok().filter(|count| (1..=LETTERS).contains(count));
    let sides = text.split_once(['x', '×']).and_then(|(a, b)| Some([number(a)?, number(b)?]));
    let lettered = sides.filter(|[columns, rows]| columns * rows <= LETTERS);
    lettered.ok_or_else(|| {
        format!("{text:?} is not COLUMNSxROWS: write it like 2x2, with at most {LETTERS} panels, (a) to (z)")
    })
}

#[derive(Args)]
pub(crate) struct VerifyOptions {
    /// A folder that motiform wrote
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// Compute all rows of a dataset or scan again, not only a sample
    #[arg(long)]
    pub(crate) all: bool,
    /// Print the findings as one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct CompletionsOptions {
    /// The shell
    pub(crate) shell: clap_complete::Shell,
}
