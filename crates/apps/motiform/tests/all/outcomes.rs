//! A run that does not reach its end says how it ended, exits with 1, and never shows a NaN.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{Folder, names, read_json};
use serde_json::Value;

const LARGE: &str = "simulate tensor --preset fig4 --transient 0 --set kappa2=0.2 --set kappa3=0.1 \
    --initial v1=8 --initial v2=1 --initial s11=30 --initial s12=3 --initial u111=-20 --initial u222=5";

/// NaN and infinity would stand as null: the only null of the contract is a plan without a return map.
fn assert_no_nan(value: &Value, place: &str) {
    match value {
        Value::Null => assert!(place.ends_with("/return_map"), "{place} is null"),
        Value::Array(items) => items.iter().for_each(|item| assert_no_nan(item, place)),
        Value::Object(entries) => {
            entries.iter().for_each(|(key, item)| assert_no_nan(item, &format!("{place}/{key}")));
        }
        _ => {}
    }
}

#[test]
fn a_blow_up_has_its_time() {
    let folder = Folder::new();
    let times: Vec<f64> = ["1e-8", "1e-12"]
        .iter()
        .map(|rtol| {
            let json = folder.run(&format!("{LARGE} --json --rtol {rtol}")).expect(1).json();
            assert_no_nan(&json, "");
            let outcome = &json["outcome"];
            assert_eq!((&outcome["kind"], &outcome["singular"]), (&"escaped".into(), &true.into()));
            assert!(outcome["t"].as_f64() > outcome["t_last"].as_f64(), "{outcome}");
            assert_eq!(json["t"], outcome["t_last"], "the state shown is the last finite one");
            outcome["t"].as_f64().unwrap()
        })
        .collect();
    // As in engine/models/tests/all/accuracy.rs: a property of the equations, not of the tolerance.
    assert!((times[0] - times[1]).abs() < 1e-6, "{times:?}");
}

#[test]
fn a_blow_up_is_drawn_up_to_its_last_state() {
    let folder = Folder::new();
    let done = folder.run(&format!("{LARGE} --dt-out 1e-3 --out run --format csv")).expect(1);
    assert!(done.stdout.contains("outcome   blew up at t* = "), "{}", done.stdout);
    assert!(names(&folder.path("run")).contains(&"path.svg".to_owned()), "{}", done.stdout);
    let table = std::fs::read_to_string(folder.path("run/trajectory.csv")).unwrap();
    let t_last = read_json(&folder.path("run/manifest.json"))["outcome"]["t_last"].as_f64().unwrap();
    let mut rows = 0;
    for line in table.lines().skip(1) {
        let fields: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
        assert!(fields.iter().all(|x| x.is_finite()) && fields[0] <= t_last, "{line}");
        rows += 1;
    }
    assert!(rows > 2, "shorter, not padded and not empty: {rows}");
}

#[test]
fn a_blow_up_during_the_transient_is_one_too() {
    let folder = Folder::new();
    let words = LARGE.replace("--transient 0", "--transient 100 --dt-out 1e-3 --out run");
    let json = folder.run(&format!("{words} --json")).expect(1).json();
    assert_no_nan(&json, "");
    let outcome = &json["outcome"];
    assert_eq!((&outcome["kind"], &outcome["during"]), (&"escaped".into(), &"transient".into()));
    // times count from the start of the run: that of the same run without a transient
    let at_once = folder.run(&format!("{LARGE} --json")).expect(1).json();
    let [t, expected] = [outcome, &at_once["outcome"]].map(|outcome| outcome["t"].as_f64().unwrap());
    assert!((t - expected).abs() < 1e-6 && json["t"].as_f64().unwrap() > 0.0, "{t} {expected}");
    assert!(at_once["outcome"].get("during").is_none());
    assert!(json["steps"].as_u64().unwrap() > 10);
    let told = folder.run(&format!("{words} --force")).expect(1).stdout;
    assert!(told.contains(", during the transient"), "{told}");
    assert!(names(&folder.path("run")).contains(&"path.svg".to_owned()), "{told}");
}

/// One Euler step from 1e100 lands at -1e299: a finite state whose norm overflows and that no axis can hold.
#[test]
fn overflow_is_an_outcome_that_files_can_hold() {
    let folder = Folder::new();
    let words = "simulate tensor --stepper euler --step 0.1 --initial v1=1e100 --out run";
    let json = folder.run(&format!("{words} --json --no-figures")).expect(1).json();
    assert_eq!(json["outcome"]["kind"], "escaped");
    assert_no_nan(&json, "");

    let done = folder.run(&format!("{words} --force")).expect(1);
    let reason = "error: the tables are written, the figures are not: ";
    assert!(done.stderr.starts_with(reason), "{}", done.stderr);
    assert_eq!(names(&folder.path("run")), ["_inventory.jsonl", "manifest.json", "trajectory.parquet"]);
    assert_no_nan(&read_json(&folder.path("run/manifest.json")), "");
}

#[test]
fn the_step_budget_bounds_a_run() {
    let folder = Folder::new();
    let json = folder.run("simulate tensor --preset fig5a --max-steps 50 --json").expect(1).json();
    assert_eq!(json["outcome"]["kind"], "step-budget");
    assert!(json["outcome"]["steps"].as_u64().unwrap() <= 50);
    assert_no_nan(&json, "");
    let table = folder.run("simulate tensor --preset fig5a --transient 0 --max-steps 50 --out run").expect(1);
    assert!(table.stdout.contains("step budget used up at t = "), "{}", table.stdout);
    folder.run("figure run").expect(0);
}

/// The tightest tolerance and the coarsest method alike.
#[test]
fn every_stepper_ends_a_blow_up() {
    let folder = Folder::new();
    for stepper in ["euler", "heun", "rk4", "dopri5", "dop853"] {
        let json = folder.run(&format!("{LARGE} --json --stepper {stepper} --rtol 1e-14")).expect(1).json();
        assert_eq!(json["outcome"]["kind"], "escaped", "{stepper}");
        assert_no_nan(&json, stepper);
    }
}

/// A body that grows exponentially along a slow direction, stiff far out: half a million explicit steps. The classification follows it
/// by the implicit method; the run is the independent reference. Without singularity the time is that at which the norm passes the
/// bound.
#[test]
fn a_stiff_blow_up_has_the_time_of_the_explicit_run() {
    let folder = Folder::new();
    let body = "tensor --preset fig4 --set a2=0.2 --set b3=0 --set d3=0 --set kappa2=-0.2 --set kappa3=-0.2";
    let time = |words: &str| -> f64 {
        let json = folder.run(&format!("{words} --json")).json();
        json["outcome"]["t"].as_f64().or(json["escape_time"].as_f64()).unwrap_or_else(|| panic!("{json:#}"))
    };
    let run = time(&format!("simulate {body} --transient 0 --t-end 100 --no-figures --rtol 1e-10"));
    for rtol in ["1e-8", "1e-10", "1e-12"] {
        let found = time(&format!("classify {body} --rtol {rtol}"));
        assert!((found - run).abs() < 1e-5, "{rtol}: {found} {run}");
    }
}
