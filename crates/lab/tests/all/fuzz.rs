//! Damaged inputs end in an error or in what they say: no panic, no abort, no memory without bound. `MOTIFORM_FUZZ=200000` tries more
//! of each kind.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;
#[path = "common/mutate.rs"]
mod mutate;

use common::{preset, run};
use motiform_files::{
    Format, Kind, Staged, decoding, read_dataset, read_fields, read_table_file, write_fields,
};
use motiform_lab::fields::write_dataset;
use motiform_lab::scan::{Axis, Classify, Opening, Scan, ScanFolder, Shard, Totals, read_part};
use motiform_study::presets::PRESETS;
use motiform_study::{Plan, ScanPlan, Study};
use mutate::{Mutator, cases};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// The library's own panics on damaged files are caught; those of anything else are not quiet.
fn quiet() {
    let shown = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !decoding() {
            shown(panic);
        }
    }));
}

fn dataset(folder: &Path, format: Format, name: &str) {
    let dataset = run(&preset(name, |study| {
        (study.run.transient, study.run.t_end, study.run.dt_out) = (0.0, 2.0, 0.1);
    }));
    let staged = Staged::new(folder, Kind::Dataset, true).unwrap();
    write_dataset(&dataset, format, &staged).unwrap();
    staged.commit().unwrap();
}

#[test]
fn studies() {
    let mut seeds: Vec<Vec<u8>> = PRESETS.iter().map(|preset| preset.text.as_bytes().to_vec()).collect();
    seeds.push(b"[model.tensor]\nkappa2 = 0.5\n[scan]\naxes = [\"kappa2=0:1:3\"]\n[initial]\nv1 = 0.1\nrandom = \"0.1:1\"\n".to_vec());
    let (mut random, mut good) = (Mutator::new(1), 0);
    let count = cases(4000);
    for case in 0..count {
        let text = String::from_utf8_lossy(&random.mutate(&seeds[case % seeds.len()])).into_owned();
        match Study::parse(&text, "study.toml", "study") {
            Ok(study) => {
                good += 1;
                let _ = (Plan::new(&study), ScanPlan::new(&study));
            }
            Err(error) => {
                let said = error.to_string();
                assert!(said.len() < 20_000, "{} bytes: {}", said.len(), &said[..400]);
            }
        }
    }
    println!("{good} of {count} were studies");
    assert!(good > count / 50);
}

/// Mutates one file of a folder and reads the folder.
fn damage(folder: &Path, file: &str, seed: u64, usual: usize, read: impl Fn(&Path) -> bool) {
    let path = folder.join(file);
    let whole = fs::read(&path).unwrap();
    let (mut random, mut good) = (Mutator::new(seed), 0);
    let count = cases(usual);
    for _ in 0..count {
        // Parquet and HDF5 keep what they are about at the end, and texts all over: half of the changes are in the last part.
        let tail = whole.len().saturating_sub(if random.below(2) == 0 { 1500 } else { whole.len() });
        let mut bytes = whole[..tail].to_vec();
        bytes.extend(random.mutate(&whole[tail..]));
        fs::write(&path, bytes).unwrap();
        good += usize::from(read(folder));
    }
    fs::write(&path, whole).unwrap();
    println!("{file}: {good} of {count} could be read");
    assert!(read(folder), "{file} is as it was");
}

#[test]
fn datasets() {
    quiet();
    let place = TempDir::new().unwrap();
    let folder = place.path().join("run");
    let whole = |folder: &Path| {
        read_dataset(folder).is_ok_and(|data| {
            let columns = &data.trajectory.columns;
            assert!(columns.iter().all(|column| column.values.len() == columns[0].values.len()));
            true
        })
    };
    dataset(&folder, Format::Parquet, "fig3");
    damage(&folder, "trajectory.parquet", 2, 3000, whole);
    damage(&folder, "crossings.parquet", 3, 1000, whole);
    damage(&folder, "manifest.json", 4, 3000, whole);
    dataset(&folder, Format::Csv, "fig3");
    damage(&folder, "trajectory.csv", 5, 2000, whole);
    damage(&folder, "trajectory.csv", 6, 500, |folder| {
        read_table_file(&folder.join("trajectory.csv")).is_ok()
    });
}

#[test]
fn fields() {
    quiet();
    let place = TempDir::new().unwrap();
    let folder = place.path().join("run");
    dataset(&folder, Format::Parquet, "fig6a");
    damage(&folder, "fields.h5", 7, 400, |folder| {
        read_fields(&folder.join("fields.h5"))
            .is_ok_and(|fields| write_fields(&folder.join("again.h5"), &fields).is_ok())
    });
}

#[test]
fn scans() {
    quiet();
    let place = TempDir::new().unwrap();
    let folder = place.path().join("scan");
    let plan = ScanPlan::new(&preset("fig1", |study| {
        study.scan.axes = vec![Axis::parse("gamma=0.05:0.1:3").unwrap()];
        study.scan.budget = 200.0;
    }))
    .unwrap();
    let scan = Scan::open(&folder, &plan, Shard::WHOLE, Opening::New).unwrap();
    scan.run(&Classify, 1, &()).unwrap();
    drop(scan);
    let totals = |folder: &Path| ScanFolder::read(folder).is_ok_and(|found| Totals::of(&found).is_ok());
    damage(&folder, "_manifest.json", 8, 2000, totals);
    damage(&folder, "part-00001.parquet", 9, 1500, |folder| {
        let found = ScanFolder::read(folder).unwrap();
        assert!(Totals::of(&found).is_ok(), "damage is counted, not fatal");
        // behind the digest's back too: the reader itself believes nothing
        let rows = read_part(&plan, &found.parts(), 1);
        rows.is_ok_and(|rows| rows.len() == 1)
    });
}
