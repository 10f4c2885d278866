//! `motiform lifetimes`: table, JSON, folder, exit codes and error texts.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{Folder, keys};

const SHORT: &str =
    "lifetimes tensor --preset fig4 --set kappa3=0.1 --along kappa2=0.1,0.2 --samples 6 --until 400";

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
    assert_eq!(names, ["lifetimes.json", "mean-life.png", "mean-life.svg"]);
    assert!(folder.run(&format!("{SHORT} --out lives")).expect(2).stderr.contains("--force"));
    folder.run(&format!("{SHORT} --out lives --force")).expect(1);
}

#[test]
fn bad_input_names_the_remedy() {
    let folder = Folder::new();
    for (words, told) in [
        ("lifetimes tensor --preset fig4", "--along"),
        ("lifetimes tensor --preset fig4 --along kappa9=0.1:0.2:3", "kappa9"),
        ("lifetimes tensor --preset fig4 --along kappa2=0.1:0.2", "NAME=LOW:HIGH:COUNT"),
        ("lifetimes tensor --preset fig4 --along kappa2=0.1 --until 0", "give a model time above 0"),
        ("lifetimes tensor --preset fig4 --along kappa2=0.1 --transient -1", "give a model time above 0"),
        ("lifetimes tensor --preset fig4 --along kappa2=0.1 --samples 0", "give at least 1"),
    ] {
        let done = folder.run(words).expect(2);
        assert!(done.stderr.contains(told), "{words}: {}", done.stderr);
    }
}
