//! Long tables as Parquet.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Files, outlines, read, read_with, refusal};
use crate::formats::same;
use motiform_tracks::{Format, Limits, Options, detect};
use parquet::basic::Compression;
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use std::sync::Arc;

pub(crate) fn parquet(frames: i64) -> Vec<u8> {
    compressed(frames, Compression::UNCOMPRESSED)
}

fn compressed(frames: i64, compression: Compression) -> Vec<u8> {
    let schema = "message rows \
        { optional binary cell (UTF8); required int64 frame; required int64 i; required double x; required double y; }";
    let schema = Arc::new(parse_message_type(schema).unwrap());
    let properties = Arc::new(WriterProperties::builder().set_compression(compression).build());
    let mut file = SerializedFileWriter::new(Vec::new(), schema, properties).unwrap();
    for (frame, points) in (0_i64..).zip(outlines(frames)) {
        let mut group = file.next_row_group().unwrap();
        let cells = vec![ByteArray::from("a"); points.len()];
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<ByteArrayType>().write_batch(&cells, Some(&vec![1; points.len()]), None).unwrap();
        column.close().unwrap();
        let order: Vec<i64> = (0_i64..).take(points.len()).collect();
        for values in [vec![frame; points.len()], order] {
            let mut column = group.next_column().unwrap().unwrap();
            column.typed::<Int64Type>().write_batch(&values, None, None).unwrap();
            column.close().unwrap();
        }
        for k in 0..2 {
            let values: Vec<f64> = points.iter().map(|point| point[k]).collect();
            let mut column = group.next_column().unwrap().unwrap();
            column.typed::<DoubleType>().write_batch(&values, None, None).unwrap();
            column.close().unwrap();
        }
        group.close().unwrap();
    }
    file.into_inner().unwrap()
}

#[test]
fn parquet_is_read() {
    let files = Files::new();
    assert_eq!(detect(&files.put("x", parquet(4)), &Options::default()).unwrap(), Format::Parquet);
    let tracks = read(parquet(4)).unwrap();
    same(&tracks, 4);
    assert_eq!(tracks.cells[0].name, "a");
}

/// pandas and pyarrow write snappy, polars zstd.
#[test]
fn every_usual_compression_is_read() {
    for compression in [
        Compression::SNAPPY,
        Compression::GZIP(Default::default()),
        Compression::LZ4_RAW,
        Compression::ZSTD(Default::default()),
    ] {
        same(&read(compressed(3, compression)).unwrap(), 3);
    }
}

#[test]
fn damaged_parquet_is_an_error() {
    let whole = parquet(2);
    for length in (4..whole.len()).step_by(97) {
        assert!(refusal(&whole[..length]).contains("a sound Parquet file"), "{length}");
    }
}

/// The count of rows is compared with the limit before any is read.
#[test]
fn too_many_rows_are_not_read() {
    let limits = Limits { vertices: 79, ..Limits::default() };
    let error = read_with(parquet(2), &Options { limits, ..Options::default() }).unwrap_err().to_string();
    assert!(error.contains("more than 79 vertices") && error.contains("limits.vertices"), "{error}");
}
