//! Files and outlines of known content.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::Normal;
use motiform_tracks::synthetic::Synthetic;
use motiform_tracks::{Error, Options, Tracks};
use std::io::Write;
use std::path::PathBuf;
use tempfile::TempDir;

/// A folder of files that is gone afterwards.
pub(crate) struct Files(TempDir);

impl Files {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn put(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        std::fs::write(self.path(name), content).unwrap();
        self.path(name)
    }
}

/// Reads one file of this content; the name says nothing of the format.
pub(crate) fn read(content: impl AsRef<[u8]>) -> Result<Tracks, Error> {
    read_with(content, &Options::default())
}

pub(crate) fn read_with(content: impl AsRef<[u8]>, options: &Options) -> Result<Tracks, Error> {
    let files = Files::new();
    motiform_tracks::read(&[files.put("cell.dat", content)], options)
}

/// The message of a failure.
pub(crate) fn refusal(content: impl AsRef<[u8]>) -> String {
    read(content).unwrap_err().to_string()
}

/// All notes as text.
pub(crate) fn notes(tracks: &Tracks) -> String {
    tracks.notes.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// A cell that moves and changes its shape, frame by frame.
pub(crate) fn cell(frame: i64) -> Synthetic {
    let t = frame as f64;
    Synthetic {
        centre: [20.0 + 0.5 * t, 15.0 + (0.3 * t).sin()],
        r0: 8.0,
        z: vec![[0.6, 0.1 * t.cos()], [-0.2, 0.3 * (0.2 * t).sin()]],
    }
}

/// Vertices of `frames` frames, rounded as files have them.
pub(crate) fn outlines(frames: i64) -> Vec<Vec<[f64; 2]>> {
    let round = |value: f64| (value * 1e4).round() / 1e4;
    (0..frames)
        .map(|frame| cell(frame).vertices(40, 0.1).into_iter().map(|p| p.map(round)).collect())
        .collect()
}

/// A long table of one cell.
pub(crate) fn csv(frames: i64) -> String {
    let mut text = String::from("cell,frame,i,x,y\n");
    for (frame, points) in outlines(frames).iter().enumerate() {
        for (i, [x, y]) in points.iter().enumerate() {
            text += &format!("a,{frame},{i},{x},{y}\n");
        }
    }
    text
}

/// Standard normal deviates of a named seed.
pub(crate) fn normal(seed: u64) -> impl FnMut() -> f64 {
    let mut normal = Normal::new(seed, 0);
    move || normal.next()
}

/// Uniform on [0, 1), from a seed.
pub(crate) fn uniform(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

pub(crate) fn zip(entries: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, bytes) in entries {
        archive.start_file(*name, zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}
