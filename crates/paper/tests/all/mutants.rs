//! Claims that can lose: each claim of the report fails under at least one fault in what it is judged by.
//!
//! `mutants.txt` is the registry: a line for each claim, with the faults that make it fail. A claim without a line, a line without a claim, and
//! a claim that holds under the faults of its line are errors. `MOTIFORM_UPDATE=1` writes it again.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_analysis::{Estimate, Regime, Verdict};
use motiform_lab::scan::CellSummary;
use motiform_paper::{Fault, Kept, claims_under, names};
use motiform_report::Verdict as Judged;
use motiform_study::{Dataset, Study};
use std::collections::BTreeMap;
use std::fmt::Write as _;

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

/// For each claim of a chapter the faults under which it fails.
fn faults_of(chapter: &str) -> BTreeMap<String, Vec<&'static str>> {
    let (folder, kept) = (tempfile::tempdir().unwrap(), Kept::default());
    let under = |fault: &Fault| claims_under(fault, chapter, &kept, (folder.path(), 2)).unwrap();
    let mut found: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for claim in under(&Fault::NONE) {
        assert!(
            !matches!(claim.verdict, Judged::Fails { .. } | Judged::Unjudged { .. }),
            "{chapter}: {}: {}",
            claim.says,
            claim.finds
        );
        assert!(found.insert(claim.says.clone(), Vec::new()).is_none(), "{chapter}: twice: {}", claim.says);
    }
    for fault in &FAULTS {
        if fault.name == "the model is damped" && !COMPUTED_AGAIN.contains(&chapter) {
            continue;
        }
        for claim in under(fault).iter().filter(|claim| matches!(claim.verdict, Judged::Fails { .. })) {
            found.entry(claim.says.clone()).or_default().push(fault.name);
        }
    }
    found
}

fn registered(chapter: &str) -> BTreeMap<&'static str, &'static str> {
    let lines = REGISTRY.lines().filter_map(|line| line.strip_prefix(chapter)?.strip_prefix(" | "));
    lines.filter_map(|line| line.split_once(" | ").map(|(faults, says)| (says, faults))).collect()
}

fn check(chapters: &[&str]) {
    let update = std::env::var_os("MOTIFORM_UPDATE").is_some();
    let mut text = String::new();
    for chapter in chapters {
        let (found, registered) = (faults_of(chapter), registered(chapter));
        let unbeaten: Vec<&String> =
            found.iter().filter(|(_, faults)| faults.is_empty()).map(|(says, _)| says).collect();
        for (says, faults) in &found {
            writeln!(text, "{chapter} | {} | {says}", faults.join(", ")).unwrap();
            if !update {
                let expected = registered
                    .get(says.as_str())
                    .unwrap_or_else(|| panic!("{chapter}: no mutant for: {says}"));
                for fault in expected.split(", ") {
                    assert!(
                        faults.iter().any(|known| *known == fault),
                        "{chapter}: holds though {fault}: {says}"
                    );
                }
            }
        }
        assert!(unbeaten.is_empty() || update, "{chapter}: no fault makes these fail: {unbeaten:#?}");
        assert!(
            update || registered.keys().all(|says| found.contains_key(*says)),
            "{chapter}: lines without a claim"
        );
    }
    if update {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/all/mutants.txt");
        let name = |line: &str| chapters.iter().any(|chapter| line.starts_with(&format!("{chapter} |")));
        let old = std::fs::read_to_string(path).unwrap();
        let others: String = old.lines().filter(|line| !name(line)).map(|line| format!("{line}\n")).collect();
        std::fs::write(path, others + &text).unwrap();
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
