//! Settings of studies by name: what front ends give, and what a study file says, is the same.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_study::study::{FigureSettings, FollowSettings, RunSettings, ScanSettings};
use motiform_study::{Settings, Study};
use serde_json::{Value, json};

/// Sets each key by name, and reads the same from the text of a study file.
fn both<S: Settings + Clone>(table: &str, of: fn(&Study) -> &S, given: &[(&str, Value)]) -> [S; 2] {
    let plain = Study::parse("preset = \"fig5b\"", "text", "a").unwrap();
    let mut named = of(&plain).clone();
    let mut text = format!("preset = \"fig5b\"\n[{table}]\n");
    for (name, value) in given {
        assert!(named.set(name, value).unwrap(), "{name}");
        text += &format!("{name} = {value}\n"); // plain values are written alike in JSON and TOML
    }
    let names: Vec<&str> = given.iter().map(|entry| entry.0).collect();
    assert_eq!(
        names,
        S::keys().iter().map(motiform_study::Key::name).collect::<Vec<_>>(),
        "every key of [{table}]"
    );
    let typed = Study::parse(&text, "text", "a").unwrap();
    // ... and what is written reads back
    let back = Study::parse(&typed.to_toml().unwrap(), "text", "a").unwrap();
    assert_eq!(back, typed, "[{table}]");
    [named, of(&typed).clone()]
}

#[test]
fn a_setting_by_name_is_that_of_a_study_file() {
    let run: [RunSettings; 2] = both(
        "run",
        |study| &study.run,
        &[
            ("t_end", json!(12.5)),
            ("transient", json!(3.0)),
            ("dt_out", json!(0.25)),
            ("stepper", json!("rk4")),
            ("rtol", json!(1e-7)),
            ("atol", json!(1e-8)),
            ("step", json!(0.01)),
            ("seed", json!(9)),
            ("max_steps", json!(1000)),
            ("escape_norm", json!(1000.0)),
            ("noise", json!(0.25)),
            ("noise_velocity", json!(0.0)),
        ],
    );
    assert_eq!(run[0], run[1]);
    let scan: [ScanSettings; 2] = both(
        "scan",
        |study| &study.scan,
        &[("axes", json!(["gamma=0.1:0.7:5", "kappa2=0.3"])), ("samples", json!(4)), ("budget", json!(12.0))],
    );
    assert_eq!(scan[0], scan[1]);
    let follow: [FollowSettings; 2] = both(
        "continue",
        |study| &study.follow,
        &[
            ("along", json!("kappa2=0.3:1.6")),
            ("from", json!("zigzag")),
            ("curve", json!(["hopf", "fold"])),
            ("in", json!("kappa2,gamma=0.02:0.5")),
            ("points", json!(7)),
            ("branches", json!(3)),
            ("samples", json!(40)),
            ("first_step", json!(0.001)),
            ("branch_step", json!(0.25)),
            ("tolerance", json!(1e-11)),
            ("direction", json!("down")),
            ("steady", json!(true)),
            ("from_stable", json!(true)),
            ("doublings", json!(2)),
        ],
    );
    assert_eq!(follow[0], follow[1]);
    let figure: [FigureSettings; 2] = both(
        "figure",
        |study| &study.figure,
        &[
            ("radius", json!(1.5)),
            ("scale", json!(2.0)),
            ("outlines", json!(3)),
            ("from", json!(4.0)),
            ("to", json!(5.0)),
            ("animation", json!(false)),
            ("units", json!("20um,1min")),
        ],
    );
    assert_eq!(figure[0], figure[1]);
}

#[test]
fn a_value_of_another_type_is_refused_by_its_key() {
    let refused = |given: Result<bool, motiform_study::Error>| given.unwrap_err().to_string();
    let mut follow = FollowSettings::default();
    for (key, value, says) in [
        ("points", json!(-1), "points = -1: give a whole number of at least 0"),
        ("first_step", json!("x"), "first_step = \"x\": give a finite number"),
        ("first_step", json!(f64::INFINITY), "first_step = inf or nan: give a finite number"),
        ("steady", json!(1), "steady = 1: give true or false"),
        ("along", json!(2), "along = 2: give a text"),
        ("curve", json!([1]), "curve = [1]: give a list of texts"),
        ("direction", json!("upp"), "unknown direction \"upp\" (did you mean up?): give up, down or both"),
    ] {
        assert_eq!(refused(follow.set(key, &value)), says);
    }
    assert!(!follow.set("point", &json!(3)).unwrap());
    assert_eq!(follow, FollowSettings::default(), "nothing of it is set");
}
