//! `motiform continue --curve` and `--sweep`, and the table `[continue]` of a study.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;
use crate::continuation::{ZIGZAG, interrupt};

use common::{Folder, names, read_json};
use serde_json::Value;
use std::process::Stdio;
use std::time::Duration;

/// The rows of a figure's CSV of this label, as numbers: the columns `from` on.
fn rows(folder: &Folder, file: &str, label: (usize, &str), from: usize) -> Vec<[f64; 2]> {
    let text = std::fs::read_to_string(folder.path(file)).unwrap();
    let fields = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let lines = text.replace("\"simulated, upwards\"", "up").replace("\"simulated, downwards\"", "down");
    let rows = lines.lines().skip(1).map(fields).filter(|row| row[label.0] == label.1);
    rows.map(|row| [from, from + 1].map(|place| row[place].parse().unwrap())).collect()
}

fn kinds(json: &Value) -> Vec<&str> {
    json["curves"].as_array().unwrap().iter().map(|curve| curve["kind"].as_str().unwrap()).collect()
}

/// gamma = 32 s^2 + 2 s, kappa2 = 4 s - 8 s^2 (a1 = 1, b1 = 0.5, b3 = 1): the closed form of Fig. 1's line.
#[test]
fn straight_motion_bends_along_the_line_of_the_formula() {
    let folder = Folder::new();
    let s: f64 = 0.03;
    let (gamma, kappa2) = (32.0 * s * s + 2.0 * s, 4.0 * s - 8.0 * s * s);
    let start = gamma - 0.04;
    let words = format!(
        "continue tensor --preset fig1 --set gamma={start} --set kappa2={kappa2} --along gamma=0.01:0.3 --branches 1 \
         --curve pitchfork --in gamma,kappa2=0.01:0.22 --out run"
    );
    folder.run(&words).expect(0);
    let summary = read_json(&folder.path("run/summary.json"));
    assert_eq!(kinds(&summary)[0], "pitchfork");
    let found = rows(&folder, "run/curves.csv", (1, "pitchfork"), 3);
    assert!(found.len() > 10, "{}", found.len());
    for [gamma, kappa2] in found {
        let s = ((4.0 + 1024.0 * gamma / 8.0).sqrt() - 2.0) / 64.0; // the root of the formula of gamma
        assert!((kappa2 - (4.0 * s - 8.0 * s * s)).abs() < 1e-8, "{gamma} {kappa2}");
    }
    let expected = [
        "_inventory.jsonl",
        "curves.csv",
        "curves.json",
        "curves.png",
        "curves.svg",
        "manifest.json",
        "points.parquet",
        "summary.json",
    ];
    assert_eq!(names(&folder.path("run")), expected);
}

/// Both symmetry breakings of the zigzag at kappa3 = 0.1 lie on one arch, whose top is below 0.12.
#[test]
fn an_arch_through_two_special_points_is_followed_once() {
    let folder = Folder::new();
    let words = format!(
        "{ZIGZAG} kappa2=0.7:1.2 --branches 1 --curve symmetry-breaking --in kappa2,kappa3=0.09:0.2 --json"
    );
    let done = folder.run(&words).expect(0);
    let json = done.json();
    assert_eq!(kinds(&json), ["symmetry-breaking"]);
    let curve = &json["curves"][0];
    assert!((curve["start"]["kappa2"].as_f64().unwrap() - 0.783547).abs() < 1e-6);
    assert_eq!(curve["not_found"], serde_json::json!(["doubly-critical"]));
    let top = curve["range"]["kappa3"][1].as_f64().unwrap();
    assert!(0.113 < top && top < 0.12, "{top}");
    assert_eq!(curve["ends"].as_array().unwrap().len(), 2);
    assert_eq!(folder.run(&words).expect(0).stdout, done.stdout, "the same bits");
}

/// Just right of the paper's window: there circular motion loses its stability sub- and supercritically.
#[test]
fn the_hopf_curve_of_circular_motion_has_a_bautin_point() {
    let folder = Folder::new();
    let words = "continue tensor --preset fig4 --set kappa3=0.1 --set kappa2=1.4 --motion circular --along kappa2=1:1.6 --branches 1 \
         --curve hopf --in kappa2=1:2,kappa3=0.02:0.2 --json";
    let json = folder.run(words).expect(0).json();
    let found = json["curves"][0]["codimension_2"].as_array().unwrap();
    assert_eq!(found.len(), 1);
    assert_eq!(found[0]["kind"], "bautin");
    let kappa2 = found[0]["kappa2"].as_f64().unwrap();
    assert!(1.6 < kappa2 && kappa2 < 1.7, "{kappa2}");
}

/// The four curves of Fig. 1 meet at the origin: the figure has one mark there, with the names of what happens.
#[test]
fn curves_that_meet_have_one_mark() {
    let folder = Folder::new();
    let words = "continue tensor --preset fig1 --set kappa2=-0.06 --set gamma=0.05 --along gamma=-0.16:0.12 \
                 --curve hopf,pitchfork --in gamma,kappa2=-0.1:0.1 --out run";
    folder.run(words).expect(0);
    let svg = std::fs::read_to_string(folder.path("run/curves.svg")).unwrap();
    assert!(!svg.contains("not located"));
    let table = std::fs::read_to_string(folder.path("run/curves.csv")).unwrap();
    let at_origin = |line: &&str| line.contains("gains symmetry") && line.contains("Bogdanov-Takens");
    assert_eq!(table.lines().filter(at_origin).count(), 1, "{table}");
}

#[test]
fn curves_that_cannot_be_followed_are_refused() {
    let folder = Folder::new();
    let fig4 = "continue tensor --preset fig4 --set kappa3=0.1 --set kappa2=0.9 --along kappa2=0.3:1.6";
    let cases = [
        (
            "--curve homoclinic --in kappa2,kappa3=0.02:1",
            "that can be followed over two parameters are hopf, fold",
        ),
        ("--curve hopff --in kappa2,kappa3=0.02:1", "did you mean hopf"),
        ("--curve hopf", "--in NAME,NAME=LOW:HIGH"),
        ("--in kappa2,kappa3=0.02:1", "--curve KIND"),
        ("--curve hopf --in kappa2", "write NAME,NAME=LOW:HIGH"),
        ("--curve hopf --in kappa2,kapa3=0.02:1", "did you mean kappa3"),
        ("--curve hopf --in gamma=0.1:2,kappa3=0.02:1", "one of them kappa2"),
        ("--curve hopf --in kappa2,kappa2=0.02:1", "two different parameters"),
        ("--curve hopf --in kappa2,gamma", "give its range, gamma=LOW:HIGH"),
        ("--curve hopf --in kappa2,kappa3=0.2:1", "the start, kappa3 = 0.1, is outside"),
        ("--curve hopf --in kappa2=0.5:1.6,kappa3=0.02:1", "must hold that of the branches"),
        ("--sweep 1", "from 2 to 100000"),
    ];
    for (words, expected) in cases {
        let error = folder.run(&format!("{fig4} {words}")).expect_error(2).stderr;
        assert!(error.contains(expected), "{words}: {error}");
    }
    assert_eq!(folder.names(), [""; 0], "nothing is left behind");
}

#[test]
fn interrupted_curves_go_on_to_the_same_points() {
    let folder = Folder::new();
    let words = format!(
        "{ZIGZAG} kappa2=0.7:1.2 --curve symmetry-breaking,period-doubling --in kappa2,kappa3=0.09:0.2 --no-figures \
         --branches 3"
    );
    folder.run(&format!("{words} --out whole")).expect(0);
    let mut command = folder.command(&format!("{words} --out parts"));
    let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let code = interrupt(child, Duration::from_millis(2500));
    assert!(code == Some(130) || code == Some(0), "{code:?}");
    if code == Some(130) {
        assert_eq!(read_json(&folder.path("parts/manifest.json"))["complete"], false);
    }
    folder.run(&format!("{words} --out parts --resume")).expect(0);
    for name in ["points.parquet", "summary.json", "curves.json", "manifest.json"] {
        let bytes = |out: &str| std::fs::read(folder.path(out).join(name)).unwrap();
        assert_eq!(bytes("whole"), bytes("parts"), "{name}");
    }
    let error = folder.run(&format!("{words} --points 9 --out parts --resume")).expect_error(2).stderr;
    assert!(
        error.contains("branches.points: 2000 there, 9 requested") && error.contains("--force"),
        "{error}"
    );
}

/// Simulation and continuation give the same mean speed of the stable zigzag.
#[test]
fn samples_lie_on_the_stable_branch() {
    let folder = Folder::new();
    folder.run(&format!("{ZIGZAG} kappa2=0.88:0.92 --branches 1 --sweep 3 --out run")).expect(0);
    let branch = rows(&folder, "run/branches.csv", (1, "zigzag"), 4);
    let speed = branch.iter().find(|row| row[0] == 0.9).unwrap()[1];
    for direction in ["up", "down"] {
        let sampled = rows(&folder, "run/branches.csv", (0, direction), 4);
        assert_eq!(sampled.len(), 3);
        let here = sampled.iter().find(|row| (row[0] - 0.9).abs() < 1e-12).unwrap()[1];
        // seventeen periods under the weight: what is left is what the transient left, and the sampling
        assert!((here - speed).abs() < 1e-4 * speed, "{direction}: {here}, the branch has {speed}");
    }
    assert!(folder.path("run/samples.parquet").is_file());
}

#[test]
fn a_study_says_what_to_follow() {
    let folder = Folder::new();
    let study = |table: &str| {
        let text =
            format!("preset = \"fig4\"\n[model.tensor]\nkappa2 = 0.9\nkappa3 = 0.1\n[continue]\n{table}\n");
        std::fs::write(folder.path("run.toml"), text).unwrap();
    };
    study("along = \"kappa2=0.7:1.2\"\nfrom = \"zigzag\"\nbranches = 1");
    let told = folder.run("continue run.toml --json").expect(0).stdout;
    let words = format!("{ZIGZAG} kappa2=0.7:1.2 --branches 1 --json");
    assert_eq!(told, folder.run(&words).expect(0).stdout, "as the same options");
    study("curve = [\"symmetry-breaking\"]\nin = \"kappa2,kappa3=0.09:0.11\"\nbranches = 1");
    let json = folder.run("continue run.toml --along kappa2=0.75:0.95 --json").expect(0).json();
    assert_eq!(kinds(&json), ["symmetry-breaking"]);
    let error = folder.run("continue run.toml").expect_error(2).stderr;
    assert!(error.contains("--along NAME=LOW:HIGH, or along in [continue]"), "{error}");
    let cases = [
        ("allong = \"kappa2=0.3:1.6\"", "did you mean along"),
        ("along = \"kapa2=0.3:1.6\"", "did you mean kappa2"),
        ("along = \"kappa2\"", "write NAME=LOW:HIGH"),
        ("from = \"zigzig\"", "did you mean zigzag"),
        ("curve = \"hopff\"", "did you mean hopf"),
        ("in = \"kappa2,kapa3\"", "did you mean kappa3"),
        ("points = 0.5", "whole number"),
    ];
    for (table, expected) in cases {
        study(table);
        let error = folder.run("continue run.toml").expect_error(2).stderr;
        assert!(error.contains(expected) && error.contains("run.toml:6"), "{table}: {error}");
    }
}
