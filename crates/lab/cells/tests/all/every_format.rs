//! Simulated, drawn as noisy outlines, written in every format, read: the same modes; fitted: the same motion.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::bodies::{RADIUS, outlines, preset};
use super::format_writers::{self as formats, Outlines, SCALE};
use motiform_analysis::regime::Regime;
use motiform_cells::{CellTrack, FitOptions, Sample, fit_cell};
use motiform_tracks::modes::ModeOptions;
use motiform_tracks::{Format, Options, detect};
use std::path::{Path, PathBuf};

/// Pixels of a unit of length: the radius is 20 pixels.
const PIXELS: f64 = 10.0;
/// Where the cell begins, in pixels: away from 0, as in an image.
const CORNER: f64 = 3000.0;

type Writer = fn(&Path, &Outlines) -> Vec<PathBuf>;

fn read(write: Writer, outlines: &Outlines, format: Format) -> CellTrack {
    let folder = tempfile::tempdir().unwrap();
    let paths = write(folder.path(), outlines);
    assert_eq!(detect(&paths[0], &Options::default()).unwrap(), format);
    let has_scale = matches!(format, Format::TrackMate | Format::QuimpNodes | Format::AmoePy);
    let [pixel, interval] = SCALE.map(|value| (!has_scale).then_some(value));
    let options = Options { pixel_size: pixel, interval, ..Options::default() };
    let mut sample = Sample::read(&paths, &options, &ModeOptions::default()).unwrap();
    assert_eq!((sample.tracks.length_unit.as_str(), sample.tracks.time_unit.as_str()), ("um", "s"));
    assert_eq!(sample.cells.len(), 1);
    sample.cells.remove(0)
}

/// Largest difference of times, centres and modes, in um and s.
fn difference(one: &CellTrack, other: &CellTrack) -> f64 {
    assert_eq!(one.frames(), other.frames(), "frames that count: {:?} and {:?}", one.flags(), other.flags());
    let pairs = one.track.0.iter().zip(&other.track.0);
    let of = |(a, b): (&motiform_inference::Observation, &motiform_inference::Observation)| {
        a.y.iter().zip(&b.y).map(|(a, b)| (a - b).abs()).fold((a.t - b.t).abs(), f64::max)
    };
    pairs.map(of).fold(0.0, f64::max)
}

fn motion(cell: &CellTrack) -> Option<Regime> {
    // the fit alone: whether simulated cells are like this one is another question, and p-values of one cell are what they are
    let options = FitOptions { draws: 20, drift: false, simulations: 0, ..FitOptions::default() };
    let fitted = fit_cell(cell, &options, &()).unwrap().fitted.unwrap();
    fitted.regime.as_ref().and_then(|found| found.regime)
}

#[test]
fn every_format_gives_the_same_modes_and_the_same_motion() {
    let bodies = outlines(&preset("fig5b", 0.01, (SCALE[1], 500)), RADIUS, 0.01);
    let drawn: Vec<Vec<[f64; 2]>> = bodies
        .into_iter()
        .map(|frame| frame.points.into_iter().map(|p| p.map(|x| CORNER + PIXELS * x)).collect())
        .collect();
    let reference = read(formats::csv, &drawn, Format::Csv);
    assert_eq!(reference.frames(), 500);
    // coordinates of 3000 pixels, 300 um, have a round-off of 4e-14 um; differences of such numbers and sums of 48 of them lose 100 times
    // that
    let round = 1e-11;
    // ImageJ keeps f32: 2^-13 pixels at 3000, of which a mode averages 48
    let single = 1e-4 * SCALE[0];
    let writers: [(Writer, Format, f64); 8] = [
        (formats::parquet, Format::Parquet, 0.0),
        (formats::trackmate, Format::TrackMate, round),
        (formats::quimp_table, Format::QuimpTable, 0.0),
        (formats::quimp_nodes, Format::QuimpNodes, 0.0),
        (formats::amoepy, Format::AmoePy, round),
        (formats::wkt, Format::Wkt, 0.0),
        (formats::regions, Format::Roi, single),
        (formats::archive, Format::RoiZip, single),
    ];
    for (write, format, allowed) in writers {
        let found = difference(&reference, &read(write, &drawn, format));
        println!("{format:?}: {found:.1e} um");
        assert!(found <= allowed, "{format:?}: {found:e}");
    }
    // whole pixels: errors of 0.29 pixels a vertex are those of 1.4 % of the radius
    let pixelated = read(formats::pixelated, &drawn, Format::RoiZip);
    assert!(difference(&reference, &pixelated) < SCALE[0]);
    assert_eq!(motion(&reference), Some(Regime::Chaotic));
    assert_eq!(motion(&pixelated), Some(Regime::Chaotic));
}
