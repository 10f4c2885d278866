//! Long tables as Parquet, written by pandas: `table.to_parquet(path, compression=..., row_group_size=40, index=False)` with pyarrow 26,
//! `table` being [`crate::common::csv`] of three frames.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Files, read, read_with, refusal};
use crate::formats::same;
use motiform_tracks::{Format, Limits, Options, detect};

/// Without compression: three frames.
pub(crate) const PARQUET: &[u8] = include_bytes!("parquet/none.parquet");

#[test]
fn parquet_is_read() {
    let files = Files::new();
    assert_eq!(detect(&files.put("x", PARQUET), &Options::default()).unwrap(), Format::Parquet);
    let tracks = read(PARQUET).unwrap();
    same(&tracks, 3);
    assert_eq!(tracks.cells[0].name, "a");
}

/// pandas and pyarrow write snappy, polars zstd.
#[test]
fn every_usual_compression_is_read() {
    let compressed: [&[u8]; 4] = [
        include_bytes!("parquet/snappy.parquet"),
        include_bytes!("parquet/gzip.parquet"),
        include_bytes!("parquet/lz4.parquet"),
        include_bytes!("parquet/zstd.parquet"),
    ];
    for file in compressed {
        same(&read(file).unwrap(), 3);
    }
}

#[test]
fn damaged_parquet_is_an_error() {
    for length in (4..PARQUET.len()).step_by(97) {
        assert!(refusal(&PARQUET[..length]).contains("a sound Parquet file"), "{length}");
    }
}

/// The count of rows is compared with the limit before any is read.
#[test]
fn too_many_rows_are_not_read() {
    let limits = Limits { vertices: 119, ..Limits::default() };
    let error = read_with(PARQUET, &Options { limits, ..Options::default() }).unwrap_err().to_string();
    assert!(error.contains("more than 119 vertices") && error.contains("limits.vertices"), "{error}");
}
