//! Datasets on disk: what is read is what was written, to the bit; what is damaged is refused by name.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{preset, run};
use motiform_lab::dataset::read_dataset;
use motiform_lab::fields::write_dataset;
use motiform_store::table::{Table, same_bits};
use motiform_store::{Format, Kind, Staged};
use motiform_study::{Dataset, Manifest};
use proptest::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use tempfile::TempDir;

const FORMATS: [Format; 2] = [Format::Parquet, Format::Csv];

/// A short run with crossings and, at rest at the start, undefined turning rates.
static SHORT: LazyLock<Dataset> = LazyLock::new(|| {
    let dataset = run(&preset("fig3", |study| {
        study.initial = vec![("s11".into(), 0.1)];
        (study.run.transient, study.run.t_end, study.run.dt_out) = (0.0, 20.0, 0.5);
        study.return_map.as_mut().unwrap().y = 0.0;
    }));
    assert!(common::column(&dataset, "turning_rate").iter().any(|rate| rate.is_nan()));
    dataset
});

fn write(dataset: &Dataset, format: Format, folder: &Path) {
    let staged = Staged::new(folder, Kind::Dataset, true).unwrap();
    write_dataset(dataset, format, &staged).unwrap();
    staged.commit().unwrap();
}

#[test]
fn a_dataset_round_trips() {
    for format in FORMATS {
        let place = TempDir::new().unwrap();
        let folder = place.path().join("run");
        write(&SHORT, format, &folder);
        let read = read_dataset(&folder).unwrap();
        assert_eq!(read.manifest, SHORT.manifest);
        assert_eq!(read.manifest.plan.hash(), SHORT.manifest.plan_hash, "recomputed from the file");
        assert!(same_bits(&read.trajectory, &SHORT.trajectory), "{format:?}");
        assert!(same_bits(read.crossings.as_ref().unwrap(), SHORT.crossings.as_ref().unwrap()));
        let meanings = |table: &Table| table.columns.iter().map(|c| c.meaning.clone()).collect::<Vec<_>>();
        if format == Format::Parquet {
            assert_eq!(meanings(&read.trajectory), meanings(&SHORT.trajectory));
        }
    }
}

#[test]
fn a_dataset_without_rows_round_trips() {
    let mut empty = SHORT.clone();
    empty.trajectory.columns.iter_mut().for_each(|column| column.values.clear());
    empty.crossings = None;
    for format in FORMATS {
        let place = TempDir::new().unwrap();
        write(&empty, format, &place.path().join("run"));
        let read = read_dataset(&place.path().join("run")).unwrap();
        assert!(same_bits(&read.trajectory, &empty.trajectory) && read.crossings.is_none());
    }
}

#[test]
fn a_manifest_knows_no_host_and_survives_json() {
    let text = serde_json::to_string(&SHORT.manifest).unwrap();
    let read: Manifest = serde_json::from_str(&text).unwrap();
    assert_eq!(read, SHORT.manifest);
    assert_eq!(serde_json::to_string(&read).unwrap(), text);
    for variable in ["HOME", "PWD", "USER", "HOSTNAME"] {
        let Ok(value) = std::env::var(variable) else { continue };
        assert!(value.len() < 5 || !text.contains(&value), "{variable}");
    }
}

/// Any number that a table may hold: subnormals, both zeros, the largest ones, and undefined.
fn number() -> impl Strategy<Value = f64> {
    use prop::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    let special = [f64::NAN, f64::MAX, f64::MIN, f64::MIN_POSITIVE, 5e-324, -5e-324, 0.1, 1e22, 9e15];
    prop_oneof![
        4 => POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO,
        1 => prop::sample::select(special.to_vec()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_numbers_round_trip(rows in 0_usize..30, numbers in prop::collection::vec(number(), 13 * 30)) {
        let mut dataset = SHORT.clone();
        dataset.crossings = None;
        for (column, values) in dataset.trajectory.columns.iter_mut().zip(numbers.chunks(30)) {
            column.values = values[..rows].to_vec();
        }
        for format in FORMATS {
            let place = TempDir::new().unwrap();
            write(&dataset, format, &place.path().join("run"));
            let read = read_dataset(&place.path().join("run")).unwrap();
            prop_assert!(same_bits(&read.trajectory, &dataset.trajectory), "{format:?}");
        }
    }
}

/// Writes a dataset, damages one file, and checks that reading complains about that file.
fn damaged(format: Format, file: &str, damage: impl FnOnce(Vec<u8>) -> Option<Vec<u8>>) -> String {
    let place = TempDir::new().unwrap();
    let folder = place.path().join("run");
    write(&SHORT, format, &folder);
    let path = folder.join(file);
    match damage(fs::read(&path).unwrap()) {
        Some(bytes) => fs::write(&path, bytes).unwrap(),
        None => fs::remove_file(&path).unwrap(),
    }
    let Err(error) = read_dataset(&folder) else { panic!("{file}: damage not seen") };
    assert!(!error.is_machine_failure());
    let text = error.to_string();
    let run = folder.display();
    let named = [format!("cannot read {run}"), format!("{run} contains no dataset: {file}: ")];
    assert!(named.iter().any(|start| text.starts_with(start)), "{text}");
    text
}

fn half(mut bytes: Vec<u8>) -> Option<Vec<u8>> {
    bytes.truncate(bytes.len() / 2);
    Some(bytes)
}

#[test]
fn damage_is_named() {
    let (manifest, parquet, csv) = ("manifest.json", "trajectory.parquet", "trajectory.csv");
    for file in [manifest, parquet, "crossings.parquet"] {
        assert!(damaged(Format::Parquet, file, half).contains(file));
        assert!(damaged(Format::Parquet, file, |_| Some(vec![])).contains(file));
        assert!(damaged(Format::Parquet, file, |_| Some(b"not what it was".to_vec())).contains(file));
    }
    damaged(Format::Parquet, manifest, |_| None);
    damaged(Format::Csv, csv, |_| None);
    damaged(Format::Parquet, parquet, |_| None);
    let edit = |from: &'static str, to: &'static str| {
        move |bytes: Vec<u8>| Some(String::from_utf8(bytes).unwrap().replacen(from, to, 1).into_bytes())
    };
    let model = damaged(Format::Csv, manifest, edit("\"model\": \"tensor\"", "\"model\": \"tenser\""));
    assert!(model.contains("unknown model"), "{model}");
    let number = damaged(Format::Csv, csv, edit("\n0.5,", "\n0.5 s,"));
    assert!(number.contains("row 3, column t: \"0.5 s\" is not a number"), "{number}");
    let column = damaged(Format::Csv, csv, edit("speed", "pace"));
    assert!(column.contains("trajectory.csv: it has no column speed"), "{column}");
    let column = damaged(Format::Csv, "crossings.csv", edit("rising", "up"));
    assert!(column.contains("crossings.csv: it has no column rising"), "{column}");
    let row = damaged(Format::Csv, csv, |mut bytes| {
        let newline = bytes[..bytes.len() - 1].iter().rposition(|&byte| byte == b'\n').unwrap();
        bytes.truncate(newline + 20);
        Some(bytes)
    });
    assert!(row.contains("trajectory.csv"), "{row}");
}

/// One wrong byte anywhere: an error, or numbers; never a panic.
#[test]
fn a_flipped_byte_is_survived() {
    let place = TempDir::new().unwrap();
    let folder = place.path().join("run");
    write(&SHORT, Format::Parquet, &folder);
    let path = folder.join("trajectory.parquet");
    let good = fs::read(&path).unwrap();
    let every = std::env::var("ALL").map_or(good.len() / 200, |_| 1);
    for (at, mask) in
        (0..good.len()).step_by(every).flat_map(|at| [0x01, 0x55, 0x80, 0xff].map(|mask| (at, mask)))
    {
        let mut bytes = good.clone();
        bytes[at] ^= mask;
        fs::write(&path, bytes).unwrap();
        let _ = read_dataset(&folder); // the result does not matter
    }
}

fn listing(folder: &Path) -> Vec<PathBuf> {
    let mut all: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    all.sort();
    all
}

#[test]
fn only_datasets_are_replaced() {
    let place = TempDir::new().unwrap();
    let (ours, theirs) = (place.path().join("ours"), place.path().join("theirs"));
    write(&SHORT, Format::Csv, &ours);
    fs::write(ours.join("path.svg"), "a figure of others").unwrap();
    write(&SHORT, Format::Parquet, &ours);
    let names: Vec<_> = listing(&ours).iter().map(|path| path.file_name().unwrap().to_owned()).collect();
    assert_eq!(
        names,
        ["_inventory.jsonl", "crossings.parquet", "manifest.json", "path.svg", "trajectory.parquet"],
        "the old one is gone, what others wrote is not"
    );

    fs::create_dir(&theirs).unwrap();
    for manifest in ["", "{}", "[1, 2]", "{\"motiform\": \"0.1.0\", \"plan_hash\": \"\"}"] {
        fs::write(theirs.join("manifest.json"), manifest).unwrap();
        let refusal = Staged::new(&theirs, Kind::Dataset, true).unwrap_err().to_string();
        assert!(refusal.contains("no inventory of motiform"), "{refusal}");
    }
    assert_eq!(listing(place.path()), [ours, theirs]);
}

/// Each count of a Parquet file changed alone: its columns then differ in length from each other or from the footer.
#[test]
fn a_changed_count_is_no_other_table() {
    let place = TempDir::new().unwrap();
    let path = place.path().join("table.parquet");
    let rows = SHORT.trajectory.rows();
    assert!(rows < 60, "a count is one byte");
    let manifest = &SHORT.manifest;
    motiform_store::write_table(&SHORT.trajectory, manifest, Format::Parquet, &path).unwrap();
    let whole = fs::read(&path).unwrap();
    // Thrift writes a number as a zigzag varint: twice the number.
    let count = u8::try_from(2 * rows).unwrap();
    let mut refused = 0;
    for place in whole.iter().enumerate().filter(|(_, byte)| **byte == count).map(|(place, _)| place) {
        for other in [count - 2, count + 2, 126] {
            let mut bytes = whole.clone();
            bytes[place] = other;
            fs::write(&path, bytes).unwrap();
            match motiform_lab::dataset::read_table_file(&path) {
                Err(_) => refused += 1,
                Ok((table, _)) => assert!(table.columns.iter().all(|column| column.values.len() == rows)),
            }
        }
    }
    assert!(refused >= 3 * SHORT.trajectory.columns.len(), "{refused} changes were refused");
}
