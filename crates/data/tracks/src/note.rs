//! The notes on files that could be read.

use motiform_dynamics::digits::four_digits;
use motiform_store::counted;
use serde::Serialize;
use std::fmt;

/// Something in the data that a user must know: named, with evidence.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
#[serde(tag = "note", rename_all = "kebab-case")]
#[allow(missing_docs, reason = "each variant says what it is; the fields are its evidence")]
pub enum Note {
    /// The scale is unknown: lengths are in pixels.
    UnknownScale { file: String },
    /// The interval is unknown: times are in frames.
    UnknownInterval { file: String },
    /// The file has values in a unit that nobody states: they count in steps (of the time between frames, in frames).
    UnknownUnit { file: String, what: &'static str, step: Option<f64>, key: &'static str },
    /// The file says 1: the default of the program that wrote it, taken as unknown.
    ScaleOne { file: String, what: String },
    /// Areas that no cell has: the unit may be wrong.
    ImplausibleArea { cell: String, area: f64, unit: String },
    /// A pixel that no microscope of cells has.
    UnusualPixel { file: String, size: f64 },
    /// The median area of all cells is that of large cells only: for others the scale is wrong.
    LargeArea { area: f64 },
    /// Times are not multiples of one interval: frames are numbered in order.
    UnevenTimes { cell: String },
    /// Times are those of an even clock, rounded: its own times are used.
    RoundedTimes { file: String, interval: f64, unit: f64 },
    /// A cell divides: it ends, and each daughter is a cell of its own.
    Split { track: String, frame: i64, into: usize },
    /// Cells merge: they end, and what follows is a cell of its own.
    Merge { track: String, frame: i64, from: usize },
    /// A cell of label masks becomes others, as the table of tracks says.
    Becomes { cell: String, into: Vec<String> },
    /// A cell of label masks has several parts; the largest is kept.
    SeveralParts { cell: String, frames: usize },
    /// Detections without an outline, left out.
    WithoutOutline { file: String, count: usize },
    /// Detections that belong to no track, left out.
    WithoutTrack { file: String, count: usize },
    /// Tracks that the file itself has filtered out, left out.
    FilteredTracks { file: String, count: usize },
    /// Links that name a detection that is not there, or join one frame with itself; left out.
    BadLinks { file: String, count: usize },
    /// The same outline filed several times in one frame; one is kept.
    SameFrameTwice { cell: String, frames: Vec<i64> },
    /// Different outlines in one frame; the frame is left out.
    ConflictingFrames { cell: String, frames: Vec<i64> },
    /// Vertices that are not finite, left out of their outlines.
    MissingVertices { cell: String, frames: Vec<i64> },
    /// Frame numbers that stand for 'none', left out.
    SentinelFrames { cell: String, frames: Vec<i64> },
    /// Two cells have the same outlines in the same frames.
    SameCell { first: String, second: String, frames: usize },
    /// Cells with positions and no outlines.
    Positions { cells: usize },
}

impl Note {
    /// The cells that it names; none where it is about a file or a track.
    pub fn cells(&self) -> Vec<&str> {
        match self {
            Self::ImplausibleArea { cell, .. }
            | Self::Becomes { cell, .. }
            | Self::SeveralParts { cell, .. }
            | Self::UnevenTimes { cell }
            | Self::SameFrameTwice { cell, .. }
            | Self::ConflictingFrames { cell, .. }
            | Self::MissingVertices { cell, .. }
            | Self::SentinelFrames { cell, .. } => vec![cell],
            Self::SameCell { first, second, .. } => vec![first, second],
            _ => Vec::new(),
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownScale { file } => {
                write!(f, "{file}: no scale: lengths are in pixels; give the pixel size (pixel_size)")
            }
            Self::UnknownInterval { file } => {
                write!(
                    f,
                    "{file}: no frame interval: times are in frames; give the frame interval (interval)"
                )
            }
            Self::UnknownUnit { file, what, step, key } => {
                let apart = step
                    .map_or_else(String::new, |step| format!(", {} from frame to frame,", four_digits(step)));
                write!(
                    f,
                    "{file}: {what}{apart} have no unit, and are taken in frames; give the unit ({key})"
                )
            }
            Self::ScaleOne { file, what } => {
                write!(
                    f,
                    "{file}: {what}: the file says 1, which often stands for unknown, and is taken as unknown"
                )
            }
            Self::UnusualPixel { file, size } => {
                write!(
                    f,
                    "{file}: a pixel of {size} um: cameras on microscopes have 0.02 to 5 um; check the pixel size"
                )
            }
            Self::LargeArea { area } => write!(
                f,
                "the median area of the cells is {area:.0} um^2: bacteria have 1 to 10, amoebae and \
                leukocytes 50 to 500, spread tissue cells 500 to 5000; check the pixel size"
            ),
            Self::ImplausibleArea { cell, area, unit } => {
                write!(
                    f,
                    "cell {cell}: a median area of {area:.3e} {unit}^2 is not that of a cell; check the scale"
                )
            }
            Self::UnevenTimes { cell } => {
                write!(
                    f,
                    "cell {cell}: times are not multiples of one interval; frames are numbered in order"
                )
            }
            Self::RoundedTimes { file, interval, unit } => {
                let decimals = (-libm::log10(*unit)).round().max(0.0) as usize;
                let digits = decimals + 3;
                write!(
                    f,
                    "{file}: times are those of an even clock, {interval:.digits$} from frame to frame, rounded to {unit:.decimals$}: \
                     the times of the clock are used"
                )
            }
            Self::Split { track, frame, into } => {
                write!(f, "track {track} splits into {into} after frame {frame}: cut into cells")
            }
            Self::Merge { track, frame, from } => {
                write!(f, "{from} branches of track {track} merge in frame {frame}: cut into cells")
            }
            Self::Becomes { cell, into } => write!(f, "cell {cell} becomes {}", into.join(", ")),
            Self::SeveralParts { cell, frames } => {
                write!(f, "cell {cell}: several parts in {}; the largest is kept", counted(*frames, "frame"))
            }
            Self::WithoutOutline { file, count } => {
                write!(f, "{file}: {} without an outline, left out", counted(*count, "detection"))
            }
            Self::WithoutTrack { file, count } => {
                write!(f, "{file}: {} in no track, left out", counted(*count, "outline"))
            }
            Self::FilteredTracks { file, count } => {
                write!(f, "{file}: {} that the file has filtered out, left out", counted(*count, "track"))
            }
            Self::BadLinks { file, count } => {
                write!(f, "{file}: {} to nothing, left out", counted(*count, "link"))
            }
            Self::SameFrameTwice { cell, frames } => {
                write!(f, "cell {cell}: the same outline several times in {}; one kept", list(frames))
            }
            Self::ConflictingFrames { cell, frames } => {
                write!(f, "cell {cell}: different outlines in {}; left out", list(frames))
            }
            Self::MissingVertices { cell, frames } => {
                write!(f, "cell {cell}: vertices that are not finite in {}", list(frames))
            }
            Self::SentinelFrames { cell, frames } => {
                write!(f, "cell {cell}: {} far from all others, or negative; left out", list(frames))
            }
            Self::Positions { cells } => write!(
                f,
                "{} with positions and no outlines: numbers of the path alone (speed, persistence, diffusion, turning); names and fits \
                 need outlines",
                counted(*cells, "cell")
            ),
            Self::SameCell { first, second, frames } => {
                write!(
                    f,
                    "cells {first} and {second} have the same outlines in {}: leave one out",
                    counted(*frames, "frame")
                )
            }
        }
    }
}

/// `frame 3`, `frames 3, 4, 5 and 20 more`.
fn list(frames: &[i64]) -> String {
    let shown: Vec<String> = frames.iter().take(5).map(i64::to_string).collect();
    let more = match frames.len().saturating_sub(5) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!("frame{} {}{more}", if frames.len() == 1 { "" } else { "s" }, shown.join(", "))
}
