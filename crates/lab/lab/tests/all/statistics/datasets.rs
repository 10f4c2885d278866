//! Bodies from dataset folders.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_lab::draw::FigureFormat;
use motiform_lab::fields::write_dataset;
use motiform_lab::simulate::simulate;
use motiform_lab::statistics::{open, read, write};
use motiform_statistics::{Errors, Settings};
use motiform_store::{Format, Kind, Opening, Staged};
use motiform_study::{RunPlan, Study};
use std::path::{Path, PathBuf};

/// Writes a dataset of this study, with other lines in `[run]`.
fn dataset(folder: &Path, name: &str, text: &str) -> PathBuf {
    let plan = RunPlan::new(&Study::parse(text, "text", "test").unwrap()).unwrap();
    let staged = Staged::new(&folder.join(name), Kind::Dataset, false).unwrap();
    write_dataset(&simulate(&plan, &()).unwrap(), Format::Parquet, &staged).unwrap();
    staged.commit().unwrap().0
}

fn tensor(run: &str) -> String {
    format!("[model.tensor]\ngamma = 1\nkappa2 = 2\nkappa3 = 2\n[run]\nnoise = 0.2\n{run}")
}

#[test]
fn folders_are_bodies() {
    let folder = tempfile::tempdir().unwrap();
    let paths: Vec<PathBuf> = (1..4)
        .map(|seed| {
            dataset(
                folder.path(),
                &seed.to_string(),
                &tensor(&format!("t_end = 200\ndt_out = 0.1\nseed = {seed}")),
            )
        })
        .collect();
    let found = read(&paths, 10.0, &Settings::default()).unwrap();
    assert_eq!((found.statistics.bodies, found.statistics.samples), (3, [1901, 1901]));
    assert_eq!(found.statistics.errors, Errors::Blocks { count: 18, samples: 316 });
    let out = folder.path().join("out");
    let into = open(&out, Opening::New, None).unwrap();
    write(&found, &FigureFormat::default(), &into).unwrap();
    assert!(out.join("msd.parquet").is_file() && out.join("msd.png").is_file());
}

#[test]
fn folders_that_do_not_fit_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let one = dataset(folder.path(), "one", &tensor("t_end = 100\ndt_out = 0.1"));
    let other = dataset(folder.path(), "other", &tensor("t_end = 100\ndt_out = 0.2"));
    let cell = "[model.cell]\nlength = 12.6\n[run]\nt_end = 10\ndt_out = 0.1";
    let cell = dataset(folder.path(), "cell", cell);
    let told = |paths: &[&PathBuf]| {
        let paths: Vec<PathBuf> = paths.iter().map(|&path| path.clone()).collect();
        read(&paths, 0.0, &Settings::default()).unwrap_err().to_string()
    };
    assert!(told(&[&one, &other]).contains("record with one dt_out"));
    assert!(told(&[&one, &cell]).contains("give one model"));
    // other numbers in the equations are other bodies; another seed is not
    let text = tensor("t_end = 100\ndt_out = 0.1\nseed = 7");
    let seed = dataset(folder.path(), "seed", &text);
    let kappa = dataset(folder.path(), "kappa", &text.replace("kappa3 = 2", "kappa3 = 2.5"));
    let noise = dataset(folder.path(), "noise", &text.replace("noise = 0.2", "noise = 0.1"));
    let silent = dataset(folder.path(), "silent", &text.replace("noise = 0.2", ""));
    assert!(read(&[one.clone(), seed], 0.0, &Settings::default()).is_ok());
    assert!(told(&[&one, &kappa]).contains("its kappa3 is 2.5, that of the first folder 2: give one set"));
    assert!(
        told(&[&one, &noise]).contains("its noise is") && told(&[&one, &silent]).contains("noise is none")
    );
    assert!(told(&[]).contains("at least one track"));
    assert!(told(&[&folder.path().to_owned()]).contains("contains no dataset: manifest.json"));
    let late = read(&[one], 99.0, &Settings::default()).unwrap_err().to_string();
    assert!(late.contains("body 0 has 11 samples"), "{late}");
}
