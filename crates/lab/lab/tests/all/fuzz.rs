//! Damaged inputs end in an error or in what they say: no panic, no abort, no memory without bound. `MOTIFORM_FUZZ=200000` tries more
//! of each kind.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;
#[path = "common/mutate.rs"]
mod mutate;

use common::{preset, run};
use motiform_lab::dataset::{read_dataset, read_table_file};
use motiform_lab::fields::write_dataset;
use motiform_lab::scan::{Axis, Classify, Opening, Scan, ScanFolder, Shard, Totals, read_part};
use motiform_store::{Audit, INVENTORY, Inventory};
use motiform_store::{Format, Kind, Staged, decoding, read_fields, write_fields};
use motiform_study::presets::{EXTENSIONS, PRESETS};
use motiform_study::{RunPlan, ScanPlan, Study};
use mutate::{Mutator, cases, each, in_turn};
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

/// A folder in memory, where the system has one: a file that is written and read there costs a twentieth.
fn in_memory() -> TempDir {
    TempDir::new_in("/dev/shm").or_else(|_| TempDir::new()).unwrap()
}

fn dataset(folder: &Path, format: Format, name: &str) {
    let dataset = run(&preset(name, |study| {
        (study.run.transient, study.run.t_end, study.run.dt_out) = (0.0, 2.0, 0.1);
    }));
    let staged = Staged::new(folder, Kind::Dataset, true).unwrap();
    write_dataset(&dataset, format, &staged).unwrap();
    staged.commit().unwrap();
}

/// Reads a text as a study and plans it. An error must say its sentence, however long the text is.
fn planned(text: &[u8]) -> bool {
    match Study::parse(&String::from_utf8_lossy(text), "study.toml", "study") {
        Ok(study) => {
            let _ = (RunPlan::new(&study), ScanPlan::new(&study));
            true
        }
        Err(error) => {
            let said = error.to_string();
            assert!(said.len() < 20_000, "{} bytes: {}", said.len(), &said[..400]);
            false
        }
    }
}

#[test]
fn studies() {
    let mut seeds: Vec<&str> = PRESETS.iter().map(|preset| preset.text).collect();
    seeds.push("[model.tensor]\nkappa2 = 0.5\n[scan]\naxes = [\"kappa2=0:1:3\"]\n[initial]\nv1 = 0.1\nrandom = \"0.1:1\"\n");
    let good = each("studies", (1, 4000), in_turn(&seeds), planned);
    assert!(good > cases(4000) / 50);
}

#[test]
fn equations() {
    let seeds: Vec<&str> = EXTENSIONS.iter().map(|preset| preset.text).collect();
    let good = each("equations", (10, 4000), in_turn(&seeds), planned);
    assert!(good > cases(4000) / 50);
}

/// Mutates one file of a folder and reads the folder.
fn damage(folder: &Path, file: &str, seed: u64, usual: usize, read: impl Fn(&Path) -> bool) {
    let path = folder.join(file);
    let whole = fs::read(&path).unwrap();
    let damaged = |random: &mut Mutator, _| {
        // Parquet and HDF5 keep what they are about at the end, and texts all over: half of the changes are in the last part.
        let tail = whole.len().saturating_sub(if random.below(2) == 0 { 1500 } else { whole.len() });
        [&whole[..tail], &random.mutate(&whole[tail..])].concat()
    };
    each(file, (seed, usual), damaged, |bytes| {
        fs::write(&path, bytes).unwrap();
        read(folder)
    });
    fs::write(&path, &whole).unwrap();
    assert!(read(folder), "{file} is as it was");
}

/// No file outside its folder is listed, whatever an inventory says.
#[test]
fn inventories() {
    let place = in_memory();
    let folder = place.path().join("run");
    dataset(&folder, Format::Csv, "fig3");
    let leads_out =
        |name: &String| name.is_empty() || name.split('/').any(|part| matches!(part, "" | "." | ".."));
    damage(&folder, INVENTORY, 11, 4000, |folder| {
        Audit::of(folder).is_ok_and(|audit| {
            let Audit { inventory, unchanged, changed, missing, .. } = audit;
            assert!(!inventory.files.keys().any(leads_out));
            assert_eq!(inventory.files.len(), unchanged.len() + changed.len() + missing.len());
            true
        })
    });
    let mut text = fs::read_to_string(folder.join(INVENTORY)).unwrap();
    for line in ["partial\":\".run.12", "moving\":\"3", "gives_way_to\":\"z", "replaced_by\":\"z"] {
        text += &format!("{{\"{line}\"}}\n");
    }
    fs::write(folder.join(INVENTORY), text).unwrap();
    let read = |folder: &Path| {
        Inventory::read(folder)
            .is_ok_and(|found| found.is_some_and(|found| !found.files.keys().any(leads_out)))
    };
    damage(&folder, INVENTORY, 12, 4000, read);
}

#[test]
fn datasets() {
    quiet();
    let place = in_memory();
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

/// Found by `datasets`: a schema that says of a column that it has no nulls, or several values a row, gave columns of different lengths.
#[test]
fn a_column_of_another_length_is_damage() {
    let place = in_memory();
    let folder = place.path().join("run");
    dataset(&folder, Format::Parquet, "fig3");
    let table = folder.join("trajectory.parquet");
    let whole = fs::read(&table).unwrap();
    let optional = b"\x25\x02\x18\x05speed"; // repetition 1, name: in Thrift's compact form
    let at = whole.windows(optional.len()).position(|window| window == optional).unwrap();
    for repetition in [0, 4] {
        let mut damaged = whole.clone();
        damaged[at + 1] = repetition;
        fs::write(&table, damaged).unwrap();
        if let Ok(data) = read_dataset(&folder) {
            let columns = data.trajectory.columns.iter();
            let lengths: Vec<usize> = columns.map(|column| column.values.len()).collect();
            assert!(lengths.iter().all(|length| *length == lengths[0]), "{repetition}: {lengths:?}");
        }
    }
}

#[test]
fn fields() {
    quiet();
    let place = in_memory();
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
    let place = in_memory();
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
