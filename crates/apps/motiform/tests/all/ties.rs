//! Parameters that follow from others: in runs, on the axes of scans, along branches, over a plane.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::Folder;
use serde_json::Value;

/// The model of Fig. 4 with one more coupling.
const MODEL: &str = "tensor --preset fig4 --set a2=0.2";

fn verdict(folder: &Folder, words: &str) -> Value {
    folder.run(&format!("classify {words} --json")).expect(0).json()
}

/// A tie is another way to write the same values: the same bits.
#[test]
fn a_tied_parameter_has_the_value_of_its_expression() {
    let folder = Folder::new();
    let set =
        verdict(&folder, &format!("{MODEL} --set d3=0.05 --set b3=0.05 --set kappa2=0.6 --set kappa3=0.3"));
    let tied = verdict(
        &folder,
        &format!("{MODEL} --tie b3=d3 --tie kappa3=kappa2/2 --set d3=0.05 --set kappa2=0.6"),
    );
    assert_eq!(set, tied);
    folder.write(
        "study.toml",
        "preset = \"fig4\"\n[model.tensor]\na2 = 0.2\nd3 = 0.05\nkappa2 = 0.6\n[ties]\nb3 = \"d3\"\nkappa3 = \"0.5*kappa2\"\n",
    );
    let shown = folder.run("check study.toml").expect(0);
    assert!(shown.stdout.contains("ties        b3 = d3, kappa3 = 0.5*kappa2"), "{}", shown.stdout);
    let read = verdict(&folder, "study.toml");
    assert_eq!(
        (&read["parameters"], &read["regime"], &read["speed"]),
        (&set["parameters"], &set["regime"], &set["speed"])
    );
}

/// Each cell of a scan, and each point of a branch, has the tied values that belong to its own.
#[test]
fn ties_hold_on_axes_and_along_branches() {
    let folder = Folder::new();
    let words = format!(
        "scan {MODEL} --tie b3=d3 --axis d3=0.01,0.09 --axis kappa2=0.5,0.9 --set kappa3=0.2 --out z --no-figures"
    );
    folder.run(&words).expect(0);
    let rows = folder.run("verify z --all").expect(0);
    assert!(rows.stdout.contains("4"), "{}", rows.stdout);
    let branch = |options: &str| {
        let words = format!("continue tensor --preset fig1 {options} --branches 1 --steady --json");
        folder.run(&words).expect(0).json()["branches"][0]["special"].clone()
    };
    // A line of the plane of Fig. 1 that rises: what is special on it is special on the lines across it.
    let tied = branch("--tie gamma=kappa2/3-0.01 --set kappa2=0.18 --along kappa2=-0.1:0.3");
    let special = tied.as_array().unwrap();
    assert!(!special.is_empty());
    for point in special {
        let kappa2 = point["kappa2"].as_f64().unwrap();
        let across = branch(&format!("--set kappa2={kappa2} --set gamma=0.01 --along gamma=-0.02:0.1"));
        let same = |other: &&Value| {
            let gamma = other["gamma"].as_f64().unwrap();
            other["kind"] == point["kind"] && (gamma - (kappa2 / 3.0 - 0.01)).abs() < 1e-8
        };
        assert!(across.as_array().unwrap().iter().any(|other| same(&other)), "{point} is not in {across}");
    }
}

/// Ties that contradict themselves are refused, with the remedy.
#[test]
fn ties_that_contradict_are_refused() {
    let folder = Folder::new();
    for (options, part) in [
        ("--tie b3=d33", "did you mean d3?"),
        ("--tie b3=b3+1", "b3 is tied itself"),
        ("--tie b3=d3 --tie d3=b3", "b3 is tied itself"),
        ("--tie b3=d3 --tie d3=a2", "the tie of b3 contains d3"),
        ("--tie b3=i*d3", "a parameter is a real number"),
        ("--tie b3=d3 --set b3=0.7", "leave out the tie"),
        ("--tie q=d3", "q"),
        ("--tie b3", "NAME=EXPRESSION"),
    ] {
        let refused = folder.run(&format!("classify {MODEL} {options}")).expect(2);
        assert!(refused.stderr.contains(part), "{options}: {}", refused.stderr);
    }
    for words in [
        "scan tensor --preset fig4 --tie b3=d3 --axis b3=0:1:3",
        "continue tensor --preset fig4 --tie b3=d3 --along b3=-1:1",
        "continue tensor --preset fig4 --tie kappa3=d3 --along kappa2=0.1:1 --curve hopf --in kappa2,kappa3",
    ] {
        let refused = folder.run(words).expect(2);
        assert!(refused.stderr.contains("vary what it is tied to"), "{words}: {}", refused.stderr);
        assert_eq!(folder.names(), [""; 0]);
    }
}

/// A tie without effect is named where nothing in it is varied, and nowhere else.
#[test]
fn a_tie_that_says_nothing_is_named() {
    let folder = Folder::new();
    let says = "the tie b3 = d3 says 0 = 0 everywhere here: d3 is 0 and is not varied";
    let classify = |set: &str| folder.run(&format!("classify {MODEL} --tie b3=d3 --set d3={set}")).stderr;
    assert!(classify("0").contains(says), "{}", classify("0"));
    assert!(!classify("0.05").contains("says 0 = 0"));
    let scan = |axis: &str| {
        let words = format!(
            "scan {MODEL} --set d3=0 --tie b3=d3 --axis {axis} --set kappa2=0.6 --set kappa3=0.3 --out z --force --no-figures"
        );
        folder.run(&words).stderr
    };
    assert!(scan("kappa3=0.2,0.3").contains(says));
    assert!(!scan("d3=0.05,0.06").contains("says 0 = 0"));
}
