//! Claims that can lose: each claim of the report fails under at least one fault in what it is judged by.
//!
//! `mutants.txt` is the registry: a line for each claim, with faults that make it fail: few for a chapter, so
//! that few have to be tried. A claim without a line, a line without a claim, and a claim that does not fail
//! under a fault of its line are errors. `MOTIFORM_UPDATE=1` tries all faults and writes it again.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::paper::KEPT;
use motiform_analysis::{Estimate, Regime, Verdict};
use motiform_figures::report::Verdict as Judged;
use motiform_lab::scan::CellSummary;
use motiform_paper::{Fault, claims_under, names};
use motiform_study::{Dataset, Study};
use std::collections::BTreeMap;
use std::sync::Mutex;

/// The next name of a motion.
fn another(regime: Regime) -> Regime {
    let place = Regime::ALL.iter().position(|known| *known == regime).unwrap_or(0);
    Regime::ALL[(place + 1) % Regime::ALL.len()]
}

/// Off by half and a bit: zeros are none any more, and ratios change.
fn off(x: f64) -> f64 {
    1.5 * x + 0.01
}

fn named_wrongly(verdict: &mut Verdict) {
    verdict.regime = another(verdict.regime);
    verdict.course = None;
}

fn cells_named_wrongly(cell: &mut CellSummary) {
    cell.motions.iter_mut().for_each(|motion| motion.regime = another(motion.regime));
}

fn all_at_rest(cell: &mut CellSummary) {
    cell.motions.iter_mut().for_each(|motion| motion.regime = Regime::Motionless);
}

fn all_chaotic(cell: &mut CellSummary) {
    cell.motions.iter_mut().for_each(|motion| motion.regime = Regime::Chaotic);
}

fn all_zigzag(cell: &mut CellSummary) {
    cell.motions.iter_mut().for_each(|motion| motion.regime = Regime::Zigzag);
}

/// The numbers of a verdict; its name is right.
fn measured_wrongly(verdict: &mut Verdict) {
    let numbers = [
        &mut verdict.turning_rate,
        &mut verdict.period,
        &mut verdict.net_rotation,
        &mut verdict.swing,
        &mut verdict.drift,
    ];
    numbers.into_iter().flatten().for_each(|x| *x = off(*x));
    verdict.legs.iter_mut().for_each(|turn| *turn = off(*turn));
    verdict.exponents.iter_mut().for_each(|exponent| exponent.value = -exponent.value);
    if let Some(saddle) = &mut verdict.saddle {
        saddle.out = off(saddle.out);
    }
    if let Some(speed) = &mut verdict.speed {
        speed.mean = off(speed.mean);
    }
}

/// Every column but the time, by an amount that changes from row to row.
fn recorded_wrongly(dataset: &mut Dataset) {
    let columns = dataset.crossings.iter_mut().flat_map(|table| &mut table.columns);
    for column in dataset
        .trajectory
        .columns
        .iter_mut()
        .chain(columns)
        .filter(|c| !["t", "rising"].contains(&c.name.as_str()))
    {
        for (x, row) in column.values.iter_mut().zip(0_u32..) {
            *x = 1.5 * *x + 0.3 * (f64::from(row) * 1.7).sin() + 0.01;
        }
    }
}

/// Left and right exchanged.
fn backwards(dataset: &mut Dataset) {
    for name in ["x", "v1"] {
        let column = dataset.trajectory.columns.iter_mut().find(|column| column.name == name);
        column.into_iter().flat_map(|column| &mut column.values).for_each(|x| *x = -*x);
    }
}

/// A tenth of the points of a return map is missing in a row: an open arc.
fn cut_open(dataset: &mut Dataset) {
    let Some(table) = &mut dataset.crossings else { return };
    let Some(x) = table.get("x").map(<[f64]>::to_vec) else { return };
    let mut sorted = x.clone();
    sorted.sort_by(f64::total_cmp);
    let limit = sorted[9 * sorted.len() / 10];
    let keep: Vec<bool> = x.iter().map(|x| *x <= limit).collect();
    for column in &mut table.columns {
        let mut keep = keep.iter();
        column.values.retain(|_| *keep.next().unwrap_or(&false));
    }
}

fn estimated_wrongly(estimate: &mut Estimate) {
    estimate.value = off(estimate.value) + 10.0 * estimate.error;
}

fn of_other_sign(estimate: &mut Estimate) {
    estimate.value = -estimate.value;
}

/// The model itself: damped where it was driven.
fn damped(study: &mut Study) {
    // a parameter that a model lacks cannot be set
    let _ = study.set("gamma", -1.0);
}

const FAULTS: [Fault; 15] = [
    Fault { name: "motions have other names", verdict: named_wrongly, ..Fault::NONE },
    Fault { name: "cells have other names", cells: cells_named_wrongly, ..Fault::NONE },
    Fault { name: "all cells are motionless", cells: all_at_rest, ..Fault::NONE },
    Fault { name: "all cells are chaotic", cells: all_chaotic, ..Fault::NONE },
    Fault { name: "all cells are zigzags", cells: all_zigzag, ..Fault::NONE },
    Fault { name: "numbers of motions are off", verdict: measured_wrongly, ..Fault::NONE },
    Fault { name: "recordings are off", run: recorded_wrongly, ..Fault::NONE },
    Fault { name: "paths run backwards", run: backwards, ..Fault::NONE },
    Fault { name: "return maps are open arcs", run: cut_open, ..Fault::NONE },
    Fault { name: "estimates are off", estimate: estimated_wrongly, ..Fault::NONE },
    Fault { name: "estimates have the other sign", estimate: of_other_sign, ..Fault::NONE },
    Fault { name: "numbers are off", number: off, ..Fault::NONE },
    Fault { name: "numbers vanish", number: |_| 0.0, ..Fault::NONE },
    Fault { name: "numbers have the other sign", number: |x| -x, ..Fault::NONE },
    Fault { name: "the model is damped", study: damped, ..Fault::NONE },
];

/// Chapters that are cheap enough to be computed again with another model.
const COMPUTED_AGAIN: [&str; 1] = ["fig3"];

const REGISTRY: &str = include_str!("mutants.txt");

type Faults = BTreeMap<String, Vec<&'static str>>;

/// For each claim of a chapter the faults, of those that are tried, under which it fails.
fn faults_of(chapter: &str, tried: impl Fn(&str) -> bool) -> Faults {
    let folder = tempfile::tempdir().unwrap();
    let under = |fault: &Fault| claims_under(fault, chapter, &KEPT, folder.path(), 2).unwrap();
    let mut found = Faults::new();
    for claim in under(&Fault::NONE) {
        let open = matches!(claim.verdict, Judged::Fails { .. } | Judged::Unjudged { .. });
        assert!(!open, "{chapter}: {}: {}", claim.says, claim.finds);
        assert!(found.insert(claim.says.clone(), Vec::new()).is_none(), "{chapter}: twice: {}", claim.says);
    }
    let model = |fault: &Fault| fault.name != "the model is damped" || COMPUTED_AGAIN.contains(&chapter);
    for fault in FAULTS.iter().filter(|fault| tried(fault.name) && model(fault)) {
        for claim in under(fault).iter().filter(|claim| matches!(claim.verdict, Judged::Fails { .. })) {
            // what a fault alone brings up is no claim of the report
            if let Some(faults) = found.get_mut(&claim.says) {
                faults.push(fault.name);
            }
        }
    }
    found
}

/// The lines of the registry: the faults of each claim.
fn registered(chapter: &str) -> BTreeMap<&'static str, Vec<&'static str>> {
    let lines = REGISTRY.lines().filter_map(|line| line.strip_prefix(chapter)?.strip_prefix(" | "));
    let parsed = lines.filter_map(|line| line.split_once(" | "));
    parsed.map(|(faults, says)| (says, faults.split(", ").collect())).collect()
}

/// Faults that are tried in a chapter whatever else makes its claims fail: they are what a claim had let pass.
const SPECIFIC: [(&str, &str); 2] =
    [("fig3", "return maps are open arcs"), ("fig5", "estimates have the other sign")];

/// Few faults that beat all claims: that which beats most of those that are left, and so on.
fn few(chapter: &str, found: &Faults) -> Vec<&'static str> {
    let own = SPECIFIC.iter().filter(|(of, _)| *of == chapter);
    let mut chosen: Vec<&str> = own.map(|(_, fault)| *fault).collect();
    loop {
        let left = |fault: &str| {
            let beaten = |faults: &&Vec<&str>| {
                faults.contains(&fault) && !faults.iter().any(|known| chosen.contains(known))
            };
            found.values().filter(beaten).count()
        };
        match FAULTS.iter().map(|fault| (left(fault.name), fault.name)).max_by_key(|entry| entry.0) {
            Some((count, name)) if count > 0 => chosen.push(name),
            _ => return chosen,
        }
    }
}

/// Writes the lines of a chapter again.
fn update(chapter: &str) {
    static WRITING: Mutex<()> = Mutex::new(());
    let found = faults_of(chapter, |_| true);
    let few = few(chapter, &found);
    let _alone = WRITING.lock().unwrap();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/all/mutants.txt");
    let mut lines: Vec<String> = std::fs::read_to_string(path).unwrap().lines().map(str::to_owned).collect();
    lines.retain(|line| !line.starts_with(&format!("{chapter} |")));
    for (says, faults) in found {
        let faults: Vec<&str> = faults.into_iter().filter(|fault| few.contains(fault)).collect();
        lines.push(format!("{chapter} | {} | {says}", faults.join(", ")));
    }
    lines.sort();
    std::fs::write(path, lines.join("\n") + "\n").unwrap();
}

fn check(chapters: &[&str]) {
    for chapter in chapters {
        if std::env::var_os("MOTIFORM_UPDATE").is_some() {
            update(chapter);
            continue;
        }
        let registered = registered(chapter);
        let found = faults_of(chapter, |name| registered.values().flatten().any(|fault| *fault == name));
        for (says, faults) in &found {
            let expected = registered.get(says.as_str());
            let expected =
                expected.unwrap_or_else(|| panic!("{chapter}: no mutant in mutants.txt for: {says}"));
            for fault in expected {
                assert!(faults.contains(fault), "{chapter}: it does not fail though {fault:?}: {says}");
            }
        }
        let stale: Vec<_> = registered.keys().filter(|says| !found.contains_key(**says)).collect();
        assert!(stale.is_empty(), "{chapter}: lines without a claim: {stale:#?}");
    }
}

#[test]
fn every_chapter_is_tested() {
    let all = [ONE, TWO, THREE].concat();
    assert!(names().iter().all(|name| all.contains(name)), "a chapter without mutants");
}

const ONE: &[&str] = &["equations", "fig1", "fig2", "fig3"];
const TWO: &[&str] = &["fig4", "fig5"];
const THREE: &[&str] = &["fig6", "models", "extensions"];

#[test]
fn claims_on_equations_and_the_first_figures_can_lose() {
    check(ONE);
}

#[test]
fn claims_on_the_full_model_can_lose() {
    check(TWO);
}

#[test]
fn claims_on_the_cell_can_lose() {
    check(THREE);
}
