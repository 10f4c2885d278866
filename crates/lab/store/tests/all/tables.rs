//! Tables in files: written at once or row by row, read whole or by columns.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_store::table::same_bits;
use motiform_store::{Error, Format, GROUP_ROWS, Table, TableWriter, read_columns, read_table, write_table};

fn table(rows: usize) -> Table {
    let mut table = Table::default();
    table.push("t", "model time", (0..rows).map(|row| 0.1 * row as f64).collect());
    let gap = |row: usize| if row.is_multiple_of(7) { f64::NAN } else { -(row as f64).sqrt() };
    table.push("x", "with gaps", (0..rows).map(gap).collect());
    table
}

fn manifest() -> serde_json::Value {
    serde_json::json!({ "motiform": "0", "seed": 1 })
}

/// Row by row or at once: the same bytes, on both sides of everything that depends on the number of rows;
/// and all of them are read.
#[test]
fn rows_that_come_one_by_one_give_the_same_file() {
    let folder = tempfile::tempdir().unwrap();
    let manifest = manifest();
    for rows in [0, 1, 1023, 1024, GROUP_ROWS - 1, GROUP_ROWS, GROUP_ROWS + 1, 2 * GROUP_ROWS + 5] {
        let whole = table(rows);
        for format in [Format::Parquet, Format::Csv] {
            let at = |name: &str| folder.path().join(format.file(name));
            write_table(&whole, &manifest, format, &at("whole")).unwrap();
            let mut writer = TableWriter::new(table(0), format, &at("rows"));
            // What came before a restart is no part of it.
            writer.table().columns.iter_mut().for_each(|column| column.values.push(9.0));
            writer.advance().unwrap();
            writer.restart();
            for row in 0..rows {
                for (column, from) in writer.table().columns.iter_mut().zip(&whole.columns) {
                    column.values.push(from.values[row]);
                }
                writer.advance().unwrap();
            }
            let kept = writer.finish(&manifest).unwrap();
            assert_eq!(kept.is_some(), rows < GROUP_ROWS, "{rows}");
            assert!(std::fs::read(at("whole")).unwrap() == std::fs::read(at("rows")).unwrap(), "{rows}");
            assert!(same_bits(&read_table(&at("rows")).unwrap(), &whole), "{rows}");
        }
    }
}

/// One column is as in the whole table; a name that is not there is refused.
#[test]
fn columns_are_read_alone() {
    let folder = tempfile::tempdir().unwrap();
    let whole = table(1500);
    for format in [Format::Parquet, Format::Csv] {
        let path = folder.path().join(format.file("table"));
        write_table(&whole, &manifest(), format, &path).unwrap();
        let mut read = Table::default();
        let mut take = |group: Table| -> Result<(), Error> {
            read = group;
            Ok(())
        };
        read_columns(&path, Some(&["x".to_owned()]), &mut take).unwrap();
        let refused = read_columns(&path, Some(&["z".to_owned()]), &mut |_| Ok::<(), Error>(()));
        assert!(refused.unwrap_err().to_string().contains("no column z: it has t, x"));
        assert_eq!(read.columns.len(), 1);
        let bits = |table: &Table| -> Vec<u64> {
            table.get("x").unwrap().iter().map(|value| value.to_bits()).collect()
        };
        assert_eq!(bits(&read), bits(&whole));
    }
}
