//! Options of `observe` and `fit`.

use super::{StyleOptions, ThreadOptions, number};
use clap::Args;
use motiform_cells::Correction;
use motiform_tracks::Format;
use std::path::PathBuf;

/// Files with outlines, and their units.
#[derive(Args)]
pub(crate) struct CellsOptions {
    /// Files with outlines of tracked cells: tables (CSV, Parquet), TrackMate XML, QuimP, AmoePy, ImageJ regions, WKT,
    /// label masks (TIFF, PNG, or a folder of them)
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Time between frames, where the file does not say it; without it times are in frames
    #[arg(long, value_name = "DT", value_parser = number, allow_hyphen_values = true)]
    pub(crate) interval: Option<f64>,
    /// Length of a pixel, where the file does not say it; without it lengths are in pixels
    #[arg(long, value_name = "S", value_parser = number, allow_hyphen_values = true)]
    pub(crate) pixel_size: Option<f64>,
    /// Unit of --interval, s without this option, or of times in the file whose unit it does not say
    #[arg(long, value_name = "UNIT")]
    pub(crate) time_unit: Option<String>,
    /// Unit of --pixel-size, um without this option
    #[arg(long, value_name = "UNIT")]
    pub(crate) length_unit: Option<String>,
    /// The format, where the content does not decide it: csv, parquet, trackmate, quimp-csv, quimp-snqp, amoepy, roi, roi-zip,
    /// wkt or masks
    #[arg(long = "input-format", value_name = "FORMAT", value_parser = format)]
    pub(crate) format: Option<Format>,
    /// A column of the table by its header (repeatable): cell, frame, i, x, y or wkt, e.g. --column frame=t
    #[arg(long = "column", value_name = "NAME=HEADER", value_parser = column)]
    pub(crate) columns: Vec<(String, String)>,
    /// Subtract motions of the stage, found in all cells together: drift, jumps, jitter (separated by commas). `fit` also subtracts a
    /// drift that one cell alone shows
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub(crate) correct: Vec<Correction>,
    /// Only these cells (repeatable)
    #[arg(long, value_name = "NAME")]
    pub(crate) cell: Vec<String>,
    /// Write results into this folder: pages (open report.html), modes and numbers as tables, study files of fits
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Do not draw pages (report.html and a page per cell) in this folder
    #[arg(long, requires = "out")]
    pub(crate) no_report: bool,
    #[command(flatten)]
    pub(crate) style: StyleOptions,
    /// Replace an existing folder of results (or the file of --write-outlines); what motiform did not write stays
    #[arg(long)]
    pub(crate) force: bool,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

/// `frame=t`.
fn format(text: &str) -> Result<Format, String> {
    text.parse::<Format>().map_err(|error| error.to_string())
}

fn column(text: &str) -> Result<(String, String), String> {
    let (name, header) = text.split_once('=').ok_or("write NAME=HEADER, e.g. frame=t")?;
    let known = ["cell", "frame", "i", "x", "y", "wkt"];
    if !known.contains(&name) {
        return Err(format!("there is no column {name}: the columns are {}", known.join(", ")));
    }
    Ok((name.to_owned(), header.to_owned()))
}

#[derive(Args)]
pub(crate) struct ObserveOptions {
    #[command(flatten)]
    pub(crate) cells: CellsOptions,
    /// Also write the outlines, for other programs: a table (.csv with cell, frame, i, x, y), or, one cell in um and s, the text
    /// of AmoePy (.txt)
    #[arg(long = "write-outlines", value_name = "FILE")]
    pub(crate) outlines: Option<PathBuf>,
}

#[derive(Args)]
pub(crate) struct FitCellsOptions {
    #[command(flatten)]
    pub(crate) cells: CellsOptions,
    /// Highest order of the terms: 3 (22 terms, those of the paper), 4 or 5 (91 terms)
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(3..=5))]
    pub(crate) order: u32,
    /// Amplitudes of the model: 3 (velocity, z2, z3; without z3 where it does not exceed its errors), 2, or 4 with z4, the
    /// square mode of the outline (45 terms of order 3)
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(2..=4))]
    pub(crate) modes: u32,
    /// Most models drawn from the estimate, whose motions decide the name; 23 of one motion are enough
    #[arg(long, value_name = "N", default_value_t = 160, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(crate) draws: u32,
    /// Seed of the draws and of the simulated cells
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
    /// Most cells simulated by each fit, to be compared with the observed one (0 for none): the least p-value is 1/(N + 1). Of up to 199
    /// the first 99 are enough where none of its statistics is in doubt
    #[arg(long, value_name = "N", default_value_t = 199, value_parser = clap::value_parser!(u32).range(0..=100_000))]
    pub(crate) simulations: u32,
    /// Also look for the nearest bifurcations along gamma, kappa2 and kappa3 of each fit (may take minutes a cell)
    #[arg(long)]
    pub(crate) bifurcations: bool,
    /// Also compare models, from a persistent random walk to all terms and handed ones, by frames that their fits did not see (each is
    /// fitted five times: takes several times as long)
    #[arg(long)]
    pub(crate) ladder: bool,
    /// Fit one set of coefficients to all cells, with errors from the differences between cells
    #[arg(long)]
    pub(crate) together: bool,
    /// Continue the fits in --out after an interruption: only cells (with --together: stages) that are not done are computed,
    /// with the same result
    #[arg(long, requires = "out", conflicts_with = "force")]
    pub(crate) resume: bool,
    #[command(flatten)]
    pub(crate) threads: ThreadOptions,
}

pub(super) const OBSERVE_HELP: &str = "\
Examples:
  motiform observe cells.xml
  motiform observe outlines.csv --pixel-size 0.2 --interval 5 --out observed
  motiform observe roi.zip --interval 6 --time-unit min --json
  motiform observe cells.xml --write-outlines cells.csv    the outlines as a table

A motion is named where the record leaves no other: straight, circular, zigzag, quasi-periodic
or motionless. Otherwise it is 'undecided', with what is missing. Frames that are no observation
of the shape (clipped at the border, self-crossing, repeated, ...) are left out and listed.
Definitions: docs/cells.md.";

pub(super) const FIT_HELP: &str = "\
Examples:
  motiform fit cells.xml --out fitted
  motiform fit outlines.csv --pixel-size 0.2 --interval 5 --json
  motiform fit cells.xml --out fitted --resume    after Ctrl-C or a crash
  motiform fit cells.xml --together               one law for all cells
  motiform simulate fitted/cell-3.toml            the fitted model is a study file
  motiform explore fitted/cell-3.toml

Maximum likelihood through an extended Kalman filter, over all terms that rotations allow; best
subsets of terms; a test of mirror symmetry; what the motion determines; the motions of models
drawn from the estimate; the place on the planes of Figs 4 and 1; cells simulated by the fit
beside the observed one. With --out there are pages to look at, and each cell is written as soon as
it is done. After Ctrl-C, which prints the cells that are done, or after a crash, the same command
with --resume continues. Method and definitions: docs/inference.md, docs/cells.md.";
