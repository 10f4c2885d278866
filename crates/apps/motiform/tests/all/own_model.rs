//! A model that this library does not know passes through every verb: run, name, exponents, scan with a kill, branches, statistics.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

#[path = "../../examples/own_model.rs"]
#[allow(dead_code, unreachable_pub, reason = "the model of the example, without its main function")]
mod example;

use example::{Memory, MemoryParameters};
use motiform::dynamics::conformance;
use motiform::prelude::*;
use motiform::{lab, statistics};
use std::sync::atomic::{AtomicUsize, Ordering};

fn memory() -> &'static ModelInfo {
    let about = About { name: "memory", look: 100.0, ..About::default() };
    register(&about, |parameters: &MemoryParameters| Ok(Memory(*parameters))).unwrap()
}

fn study(k: f64) -> Study {
    let mut study = Study::of_model(memory());
    study.set("k", k).unwrap();
    study
}

#[test]
fn it_is_a_model() {
    let body = Memory(MemoryParameters::default());
    let start = [0.1, 0.02, 0.0, 0.01];
    assert!(conformance::rotation_defect(&body, &start, 1.0) < 1e-14);
    assert!(
        conformance::spin_defect(&body, &start) < 1e-8 && conformance::mirror_defect(&body, &start) == 0.0
    );
}

/// Speeds and turning rates from the formulas of the example.
#[test]
fn its_motions_are_named() {
    for (k, regime, speed, turning) in
        [(0.3, "straight", 0.7_f64.sqrt(), 0.0), (0.9, "circular", 0.5_f64.sqrt(), 0.8_f64.sqrt() / 2.0)]
    {
        let verdict = classify(&RunPlan::new(&study(k)).unwrap(), 0.0, &()).unwrap().unwrap();
        assert_eq!(verdict.regime.name(), regime);
        assert!((verdict.speed.unwrap().mean - speed).abs() < 1e-8);
        assert!((verdict.turning_rate.unwrap_or(0.0).abs() - turning).abs() < 1e-8);
    }
}

/// Its studies are files, as those of other models are.
#[test]
fn its_studies_are_files() {
    let text = study(0.3).to_toml().unwrap();
    assert!(text.contains("[model.memory]"), "{text}");
    let read = Study::parse(&text, "memory.toml", "memory").unwrap();
    assert_eq!(RunPlan::new(&read).unwrap().hash(), RunPlan::new(&study(0.3)).unwrap().hash());
}

/// A name that the model does not have is refused, however it came into the study, with those that it has.
#[test]
fn its_names_are_checked() {
    let mut typed = study(0.3);
    let said = typed.set("kk", 1.0).unwrap_err().to_string();
    assert!(said.ends_with("(did you mean k?): the parameters are gamma, k, tau"), "{said}");
    typed.parameters.push(("kk".to_owned(), 1.0));
    assert_eq!(RunPlan::new(&typed).unwrap_err().to_string(), said);
}

/// On the circle: 0 along the orbit (its heading), and none above.
#[test]
fn its_exponents_are_computed() {
    let found = lyapunov(&RunPlan::new(&study(0.9)).unwrap(), 4, Spans::default(), &()).unwrap();
    let values: Vec<f64> = found.exponents.iter().map(|exponent| exponent.value).collect();
    assert!(values[0].abs() < 1e-3 && values[1] < 0.0, "{values:?}");
    // the sum is the mean divergence: 2 (gamma - 2 v^2) - 2/tau with v^2 = gamma - 1/tau
    assert!((values.iter().sum::<f64>() + 1.0).abs() < 1e-3, "{values:?}");
}

/// Circles begin at `k tau = 1`.
#[test]
fn its_branches_are_followed() {
    let mut study = study(0.3);
    study.follow.along = Some(Along::parse("k=0.1:0.9").unwrap());
    let plan = BranchPlan::new(&study, &study.follow.branches().unwrap()).unwrap();
    let branches = follow(&plan, None, &()).unwrap();
    let summary = motiform::diagrams::summary(&plan, &branches);
    let special = &summary["branches"][0]["special"][0];
    assert!((special["k"].as_f64().unwrap() - 0.5).abs() < 1e-9, "{special}");
}

/// Stops after some looks.
struct Stop(AtomicUsize);

impl Watch for Stop {
    fn stopped(&self) -> bool {
        self.0.fetch_add(1, Ordering::Relaxed) > 40
    }
}

fn scan_plan() -> ScanPlan {
    let mut study = study(0.9);
    study.scan.axes = vec![Axis::parse("k=0.1:0.9:9").unwrap()];
    ScanPlan::new(&study).unwrap()
}

fn totals(scan: &Scan) -> Vec<(String, usize)> {
    let totals = Totals::of(scan.folder()).unwrap();
    totals
        .regimes()
        .map(|(regime, count)| (regime.name().to_owned(), count))
        .filter(|entry| entry.1 > 0)
        .collect()
}

#[test]
fn its_scans_are_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let (plan, at) = (scan_plan(), folder.path().join("scan"));
    let scan = Scan::open(&at, &plan, Shard::WHOLE, Opening::New).unwrap();
    scan.run(&Classify, 1, &Stop(AtomicUsize::new(0))).unwrap();
    drop(scan);
    let scan = Scan::open(&at, &plan, Shard::WHOLE, Opening::Resume).unwrap();
    assert!(scan.run(&Classify, 2, &()).unwrap().complete);
    let expected = [("straight", 4), ("circular", 4)];
    let found = totals(&scan);
    for (name, count) in expected {
        assert!(found.iter().any(|entry| entry.0 == name && entry.1 >= count), "{found:?}");
    }
}

/// A result says which equations it has: others of the same name do not go on with it.
#[test]
fn other_equations_of_the_same_name_are_refused() {
    let plan = RunPlan::new(&study(0.9)).unwrap();
    let text = serde_json::to_string(&plan).unwrap();
    let field = memory().field().unwrap();
    let changed: RunPlan = serde_json::from_str(&text.replace(field, "0000000000000000")).unwrap();
    assert!(changed.body().err().unwrap().to_string().contains("other equations of the same name"));
    let again = About { name: "memory", ..About::default() };
    let other = register(&again, |parameters: &MemoryParameters| {
        Ok(Memory(MemoryParameters { tau: 2.0 * parameters.tau, ..*parameters }))
    });
    assert!(other.unwrap_err().to_string().contains("another model has this name"));
    let changed = About { name: "memory", look: 50.0, ..About::default() };
    assert!(register(&changed, |parameters: &MemoryParameters| Ok(Memory(*parameters))).is_err());
    let timeless = About { name: "timeless", look: 0.0, ..About::default() };
    let refused = register(&timeless, |parameters: &MemoryParameters| Ok(Memory(*parameters))).unwrap_err();
    assert!(refused.to_string().contains("look = 0: give a number above 0"), "{refused}");
    let taken = About { name: "tensor", ..About::default() };
    assert!(register(&taken, |parameters: &MemoryParameters| Ok(Memory(*parameters))).is_err());
}

/// Noise in the plane: bodies that go straight and diffuse.
#[test]
fn its_bodies_have_statistics() {
    let mut study = study(0.3);
    (study.run.t_end, study.run.dt_out, study.run.transient, study.run.noise) = (400.0, 0.5, 50.0, 0.05);
    let measured = lab::statistics::simulated(&study, 8, &statistics::Settings::default(), 2, &()).unwrap();
    let summary = lab::statistics::summary(&measured);
    assert!(summary.to_string().contains("diffusion"), "{summary}");
}
