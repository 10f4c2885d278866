//! `motiform lifetimes`: table, JSON, folder, exit codes and error texts.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use crate::continuation::interrupt;
use common::{Folder, keys};
use std::process::Stdio;
use std::time::Duration;

const SHORT: &str =
    "lifetimes tensor --preset fig4 --set kappa3=0.1 --axis kappa2=0.1,0.2 --samples 6 --until 400";

#[test]
fn a_short_run_has_too_few_events_and_says_so() {
    let folder = Folder::new();
    let done = folder.run(SHORT).expect(1);
    assert!(
        done.stdout.contains("95 % limits") && done.stdout.contains("too few events to compare laws"),
        "{}",
        done.stdout
    );
    assert_eq!(folder.names(), [""; 0], "without --out it writes no file");
    let json = folder.run(&format!("{SHORT} --json --threads 1 --out lives")).expect(1).json();
    assert_eq!(json["laws"]["answer"], "too-few");
    assert_eq!((json["values"].as_array().unwrap().len(), &json["values"][0]["starts"]), (2, &6.into()));
    assert!(keys(&json["values"][0]["life"]).contains(&"lower"));
    let names = common::names(&folder.path("lives"));
    assert_eq!(
        names,
        ["_inventory.jsonl", "lifetimes.json", "mean-life.png", "mean-life.svg", "orbits.json"]
    );
    assert!(folder.run(&format!("{SHORT} --out lives")).expect(2).stderr.contains("--force"));
    folder.run(&format!("{SHORT} --out lives --force")).expect(1);
}

#[test]
fn bad_input_names_the_remedy() {
    let folder = Folder::new();
    for (words, told) in [
        ("lifetimes tensor --preset fig4", "--axis"),
        ("lifetimes tensor --preset fig4 --axis kappa9=0.1:0.2:3", "kappa9"),
        ("lifetimes tensor --preset fig4 --axis kappa2=0.1:0.2", "NAME=LOW:HIGH:COUNT"),
        ("lifetimes tensor --preset fig4 --axis kappa2=0.1 --until 0", "give a model time above 0"),
        ("lifetimes tensor --preset fig4 --axis kappa2=0.1 --transient -1", "give a model time above 0"),
        ("lifetimes tensor --preset fig4 --axis kappa2=0.1 --samples 0", "give at least 1"),
    ] {
        let done = folder.run(words).expect(2);
        assert!(done.stderr.contains(told), "{words}: {}", done.stderr);
    }
}

#[test]
fn an_interrupted_run_goes_on_to_the_same_numbers() {
    let folder = Folder::new();
    let words = "lifetimes tensor --preset fig4 --set kappa3=0.1 --axis kappa2=0.1,0.2,0.3 --samples 64 --until 2e4 --threads 1";
    let whole = folder.run(&format!("{words} --out whole"));
    let mut command = folder.command(&format!("{words} --out parts"));
    let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let code = interrupt(child, Duration::from_millis(200));
    if code == Some(130) {
        assert_eq!(common::names(&folder.path("parts")), ["_inventory.jsonl", "orbits.json"]);
        let orbits = common::read_json(&folder.path("parts/orbits.json"));
        let orbits = orbits["orbits"].as_array().unwrap();
        assert!(orbits.len() == 192 && orbits.iter().any(serde_json::Value::is_null));
    }
    let again = folder.run(&format!("{words} --out parts --resume"));
    assert_eq!(again.stdout.replace("parts", "whole"), whole.stdout);
    for name in ["lifetimes.json", "orbits.json", "mean-life.svg"] {
        let bytes = |out: &str| std::fs::read(folder.path(out).join(name)).unwrap();
        assert_eq!(bytes("whole"), bytes("parts"), "{name}");
    }
    let other = folder.run(&format!("{words} --seed 2 --out parts --resume")).expect(2).stderr;
    assert!(
        other.contains("another plan (seed: 1 there, 2 requested)") && other.contains("--force"),
        "{other}"
    );
    // what another version left may have other looks
    let kept = std::fs::read_to_string(folder.path("parts/orbits.json")).unwrap();
    folder.write("parts/orbits.json", &kept.replacen("{\"format\":2,", "{", 1));
    let other = folder.run(&format!("{words} --out parts --resume")).expect(2).stderr;
    assert!(other.contains("another version of motiform") && other.contains("--force"), "{other}");
}
