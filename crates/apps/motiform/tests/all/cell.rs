//! The active cell model on the command line: the keys of the contract, its files, and what it refuses.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{Folder, keys};

const SHORT: &str = "simulate cell --set length=7 --set modes=12 --transient 600 --t-end 20 --dt-out 1";

#[test]
fn json_has_velocity_length_area_and_residual_beside_the_state() {
    let json = Folder::new().run(&format!("{SHORT} --json")).expect(0).json();
    for key in ["velocity", "length", "area", "closure_residual", "self_intersecting"] {
        assert!(keys(&json).contains(&key), "{key}");
    }
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    assert_eq!(keys(&json["state"]).len(), 24);
    assert_eq!(&keys(&json["state"])[..4], ["c1", "s1", "c2", "s2"]);
    // The saturated amplitude of the straight motion, 2 |phi_1| ~ 2.944 (physics.md, measured; default tolerance 1e-6).
    let amplitude = number(&json["state"]["c1"]).hypot(number(&json["state"]["s1"]));
    assert!((amplitude - 2.944).abs() < 1e-3, "{amplitude}");
    assert!((number(&json["length"]) - 7.0).abs() < 1e-9 && number(&json["closure_residual"]) < 1e-12);
    // A deformed boundary encloses less than the circle, 7^2 / (4 pi) = 3.899.
    assert!((1.0..3.899).contains(&number(&json["area"])));
}

#[test]
fn a_run_writes_fields_and_the_figures_of_the_boundary() {
    let folder = Folder::new();
    folder.run("simulate cell --transient 0 --t-end 60 --dt-out 0.2 --no-animation --out cell").expect(0);
    let names = common::names(&folder.path("cell"));
    for name in [
        "fields.h5",
        "manifest.json",
        "path.svg",
        "phi.png",
        "series.svg",
        "spectrum.svg",
        "trajectory.parquet",
    ] {
        assert!(names.iter().any(|known| known == name), "{name} in {names:?}");
    }
    let magic = std::fs::read(folder.path("cell/fields.h5")).unwrap();
    assert_eq!(&magic[..8], b"\x89HDF\r\n\x1a\n");
}

#[test]
fn initial_modes_are_named_c_and_s() {
    let json = Folder::new()
        .run("simulate cell --set length=6 --set modes=8 --initial c1=0.01 --initial s2=0.02 --t-end 1e-5 --json")
        .expect(0)
        .json();
    // length below 2 pi: mode 2 decays with rate 65, by 1.3e-5 in 1e-5 of time
    for (name, value) in [("c1", 0.01), ("s2", 0.02), ("c3", 0.0)] {
        assert!((json["state"][name].as_f64().unwrap() - value).abs() < 1e-3, "{name}");
    }
}

#[test]
fn what_cannot_be_computed_is_refused_with_the_remedy() {
    for (words, said) in [
        ("--set length=0", "length = 0 is out of range"),
        ("--set length=60", "give at least 29"),
        ("--set modes=8.5", "without a fraction"),
        ("--set g3=0", "g3 = 0 is out of range"),
        ("--initial c99=1", "did you mean c9?"),
        ("--stepper rk4 --step 0.1", "use an exponential stepper"),
        ("--stepper ifrk4 --step -1", "step = -1 is out of range"),
    ] {
        let done = Folder::new().run(&format!("simulate cell {words} --json"));
        assert_eq!(done.code, Some(2), "{words}: {}", done.stderr);
        assert!(done.stderr.starts_with("error: ") && done.stderr.contains(said), "{words}: {}", done.stderr);
        assert!(done.stdout.is_empty());
    }
}

#[test]
fn a_coarse_step_is_called_coarse_and_a_run_without_a_boundary_has_its_outcome() {
    let folder = Folder::new();
    let coarse = folder
        .run("simulate cell --stepper ifrk4 --step 0.5 --initial c1=1 --initial s2=1 --t-end 5 --json")
        .expect(0);
    assert!(coarse.stderr.starts_with("warning: the step loses accuracy"), "{}", coarse.stderr);
    assert!(coarse.json()["manifest"]["step_error"].as_f64().unwrap() > 1e-4);

    let failed = folder.run("simulate cell --initial c1=1e5 --t-end 5 --json").expect(1).json();
    let kind = failed["outcome"]["kind"].as_str().unwrap();
    assert!(["closure-failed", "escaped", "step-underflow"].contains(&kind), "{kind}");
}
