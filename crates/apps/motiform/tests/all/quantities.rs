//! Every column of every table is a declared quantity, or one that the model declares.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::Folder;
use crate::ownership::tree;
use motiform_models::{MODELS, amplitudes};
use motiform_store::quantity::{
    answer, cell, coefficient, frame, motion, special, state, statistic, subjects,
};
use motiform_store::{Quantity, columns};
use motiform_study::Settings;
use motiform_study::study::RunSettings;
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use std::path::Path;

/// Commands that write every kind of table.
const COMMANDS: [&str; 9] = [
    "simulate tensor --preset fig3 --t-end 20 --no-figures --out run",
    "simulate cell --preset fig6a --t-end 2 --transient 0 --no-figures --out body",
    "scan tensor --preset fig1 --axis kappa2=0.1:0.2:2 --samples 1 --budget 300 --no-figures --out scan",
    "continue tensor --preset fig4 --set kappa2=0.5 --set kappa3=0.5 --along kappa2=0.4:0.6 --branches 1 --points 5 \
     --curve hopf --in kappa2=0.4:0.6,kappa3=0.4:0.6 --out curves",
    "continue tensor --preset fig5a --along kappa2=0.85:0.95 --branches 1 --points 5 --sweep 2 --out branches",
    "atlas tensor --preset fig1 --axis kappa2=0.02:0.06:5 --axis gamma=0.02:0.1:5 --samples 2 --budget 300 --lines 1 --branches 2 \
     --out atlas",
    "statistics tensor --preset fig5b --bodies 3 --t-end 100 --dt-out 1 --transient 20 --out bodies",
    "observe cells.csv --interval 1 --pixel-size 1 --no-report --out seen",
    "fit cells.csv --interval 1 --pixel-size 1 --no-report --simulations 0 --draws 1 --out fitted",
];

/// Quantities of figures that are no columns.
const OF_FIGURES: [&Quantity; 4] =
    [&frame::SPEED, &statistic::TURNING_ANGLE, &statistic::PER_DEGREE, &statistic::LIFE];

/// The subject of a table by its place.
fn subject(path: &Path) -> Option<&'static [&'static Quantity]> {
    let of_curves = path.starts_with("curves");
    if path.extension()? != "parquet" && !path.ends_with("numbers.csv") {
        return None; // the numbers of a figure
    }
    Some(match path.file_stem()?.to_str()? {
        "trajectory" | "crossings" => state::ALL,
        "points" if of_curves => special::ALL,
        "points" | "samples" => motion::ALL,
        "cells" if path.starts_with("atlas") => motion::ALL,
        "curves" => special::ALL,
        "msd" | "autocorrelations" | "distributions" | "spectra" | "first_passage" => statistic::ALL,
        "modes" => frame::ALL,
        "coefficients" => coefficient::ALL,
        "numbers" => cell::ALL,
        part if part.starts_with("part-") => motion::ALL,
        _ => return None,
    })
}

/// Names and meanings of the columns of a table; those of CSV have no meanings.
fn named(path: &Path) -> Map<String, Value> {
    if path.extension().unwrap() == "csv" {
        let text = std::fs::read_to_string(path).unwrap();
        let names = text.lines().next().unwrap().split(',');
        return names.map(|name| (name.to_owned(), Value::Null)).collect();
    }
    let metadata = columns::metadata(path).unwrap();
    let meanings = metadata.into_iter().find(|entry| entry.0 == "motiform.columns").unwrap().1;
    serde_json::from_str(&meanings).unwrap()
}

/// Columns that models declare: parameters, coordinates, observables and measures.
fn of_models() -> BTreeSet<&'static str> {
    let mut all = BTreeSet::new();
    for info in MODELS {
        let defaults: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
        let model = info.build(&defaults).unwrap();
        all.extend(info.parameters().iter().map(|spec| spec.name));
        all.extend(info.coordinates(&defaults).iter().map(|coordinate| coordinate.name));
        all.extend(model.observables().iter().chain(model.measures()).map(|observable| observable.name));
    }
    all
}

/// The quantity of a column; the ends of an interval belong to its number.
fn quantity(subject: &'static [&'static Quantity], path: &Path, name: &str) -> Option<&'static Quantity> {
    let number = name.trim_end_matches("_low").trim_end_matches("_high");
    let name = if path.ends_with("numbers.csv") { number } else { name };
    subject.iter().find(|one| one.name == name).copied()
}

#[test]
fn every_column_is_declared_once() {
    let folder = Folder::new();
    folder.write("cells.csv", &crate::fits::outlines(1));
    for command in COMMANDS {
        assert!(matches!(folder.run(command).code, Some(0 | 1)), "{command}");
    }
    let declared = of_models();
    let mut seen: Vec<&Quantity> = OF_FIGURES.to_vec();
    for (path, _) in tree(&folder.path("")) {
        let Some(subject) = subject(&path) else { continue };
        for (name, meaning) in named(&folder.path("").join(&path)) {
            let Some(one) = quantity(subject, &path, &name) else {
                assert!(declared.contains(name.as_str()), "{name} in {path:?} is declared nowhere");
                continue;
            };
            let known = meaning.as_str().is_none_or(|text| [&*one.described(), one.meaning].contains(&text));
            assert!(known, "{name} in {path:?} means {meaning}");
            seen.push(one);
        }
    }
    let of_tables = subjects().into_iter().filter(|entry| entry.0 != "answer");
    let unused = of_tables.flat_map(|(_, all)| all);
    let unused: Vec<&str> = unused
        .filter(|one| !seen.iter().any(|other| std::ptr::eq(*other, **one)))
        .map(|one| one.name)
        .collect();
    assert!(unused.is_empty(), "no table has {unused:?}");
}

/// A parameter becomes a column of scans, branches, curves and atlases.
#[test]
fn no_parameter_has_the_name_of_a_column() {
    for Quantity { name, .. } in [motion::ALL, special::ALL].concat() {
        assert!(
            MODELS.iter().flat_map(motiform_models::ModelInfo::parameters).all(|spec| spec.name != *name),
            "{name}"
        );
        assert!(amplitudes::reserved(name).is_some(), "{name} can be a parameter of amplitude equations");
    }
}

/// Python's `replace` takes parameters and settings as keywords.
#[test]
fn no_parameter_has_the_name_of_a_setting() {
    for key in RunSettings::keys() {
        let name = key.name();
        assert!(
            MODELS.iter().flat_map(motiform_models::ModelInfo::parameters).all(|spec| spec.name != name),
            "{name}"
        );
        assert!(amplitudes::reserved(name).is_some(), "{name} can be a parameter of amplitude equations");
    }
}

/// docs/quantities.md: a table per subject.
fn page() -> String {
    let mut text =
        "# Quantities\n\nColumns of all tables, with their dimension and meaning. In one kind of table a \
     name means one thing.\n"
            .to_owned();
    for (title, about, all) in [
        ("Runs", "`trajectory` and `crossings`: a row is a state.", state::ALL),
        ("Motions", "Scans, cells of atlases, points of branches, sweeps: a row is a motion.", motion::ALL),
        ("Special points", "Points of curves along which a motion is critical.", special::ALL),
        ("Statistics", "Tables of `motiform statistics`: a row is a value of a statistic.", statistic::ALL),
        ("Frames of cells", "`modes` of tracked cells: a row is a frame.", frame::ALL),
        (
            "Cells",
            "`numbers` of tracked cells; the columns NAME_low and NAME_high are the ends of its 95 % interval, such as `speed_low`.",
            cell::ALL,
        ),
        ("Coefficients", "`coefficients` of fits: a row is a coefficient of a cell.", coefficient::ALL),
        ("Answers", "Numbers of analyses that are in no table; JSON and Python have them.", answer::ALL),
    ] {
        text += &format!("\n## {title}\n\n{about}\n\n| name | dimension | meaning |\n| --- | --- | --- |\n");
        for one in all.iter().filter(|one| !OF_FIGURES.contains(one)) {
            let meaning = one.meaning.replace('|', "\\|").replace('<', "&lt;");
            text += &format!("| `{}` | {} | {meaning} |\n", one.name, one.dimension.unit(["length", "time"]));
        }
    }
    text
}

#[test]
fn the_page_of_the_documents_is_this_one() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../docs/quantities.md");
    if std::env::var_os("MOTIFORM_UPDATE").is_some() {
        std::fs::write(&path, page()).unwrap();
    }
    let there = std::fs::read_to_string(&path).unwrap();
    let renew = "docs/quantities.md is another: MOTIFORM_UPDATE=1 cargo test --release --workspace --test all quantities";
    assert!(there == page(), "{renew}");
}
