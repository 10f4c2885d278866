//! `motiform continue`: what it prints, what it finds, what it refuses, and that interruptions change nothing.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Folder, keys, names, read_json};
use serde_json::Value;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// The full model at kappa3 = 0.1, from the zigzag that a simulation settles on.
pub(crate) const ZIGZAG: &str =
    "continue tensor --preset fig4 --set kappa3=0.1 --set kappa2=0.9 --motion zigzag --along";

/// The parameters of the special points of a kind, over all branches.
fn places(json: &Value, kind: &str) -> Vec<f64> {
    let branches = json["branches"].as_array().unwrap().iter();
    let all = branches.flat_map(|branch| branch["special"].as_array().unwrap());
    all.filter(|entry| entry["kind"] == kind).map(|entry| entry["kappa2"].as_f64().unwrap()).collect()
}

fn holds(found: &[f64], expected: f64, error: f64) -> bool {
    found.iter().any(|value| (value - expected).abs() < error)
}

#[test]
fn the_zigzag_branch_has_its_symmetry_breakings() {
    let folder = Folder::new();
    let done = folder.run(&format!("{ZIGZAG} kappa2=0.7:1.2 --branches 1 --json")).expect(0);
    let json = done.json();
    let branch = &json["branches"][0];
    assert_eq!(json["branches"].as_array().unwrap().len(), 1);
    assert_eq!((&branch["motion"], &branch["form"]), (&"zigzag".into(), &"mirror-zigzag".into()));
    // values of a prototype, which AUTO confirmed
    let found = places(&json, "symmetry-breaking");
    assert!(holds(&found, 0.783547, 1e-6) && holds(&found, 1.148047, 1e-6), "{found:?}");
    let range: Vec<f64> =
        branch["stable"][0].as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect();
    assert_eq!(range, found, "stable between them");
    assert_eq!(
        keys(&branch["special"][0]),
        [
            "kind",
            "kappa2",
            "error",
            "period",
            "period_error",
            "criticality",
            "normal_form",
            "coefficient",
            "coefficient_error",
            "test",
            "residual",
            "transversality"
        ]
    );
    assert!((branch["special"][0]["period"].as_f64().unwrap() - 36.2047).abs() < 1e-4);
    assert!(branch["end"].is_string() && branch["ends"].as_array().unwrap().len() == 2);
    assert_eq!(folder.names(), [""; 0], "--json alone writes no file");
    let again = folder.run(&format!("{ZIGZAG} kappa2=0.7:1.2 --branches 1 --json")).expect(0);
    assert_eq!(again.stdout, done.stdout, "the same bits");
}

/// Zigzag -> gluing homoclinic -> quasi-periodic along one loop -> shrinks to circular motion: its Hopf bifurcation.
#[test]
fn one_command_leads_from_the_zigzag_to_the_hopf_bifurcation_of_circular_motion() {
    let folder = Folder::new();
    let json = folder.run(&format!("{ZIGZAG} kappa2=0.75:1.6 --branches 5 --json")).expect(0).json();
    let motions: Vec<&str> = json["branches"]
        .as_array()
        .unwrap()
        .iter()
        .map(|branch| branch["motion"].as_str().unwrap())
        .collect();
    assert_eq!(motions, ["zigzag", "straight", "quasi-periodic", "circular", "quasi-periodic"]);
    let broken = places(&json, "symmetry-breaking");
    assert!(holds(&broken, 0.783547, 1e-6) && holds(&broken, 1.148047, 1e-6), "{broken:?}");
    assert!(holds(&places(&json, "homoclinic"), 1.344179, 1e-6));
    assert!(holds(&places(&json, "hopf"), 1.121937, 1e-6), "{:?}", places(&json, "hopf"));
    let circular = &json["branches"][3]["special"];
    let hopf = circular.as_array().unwrap().iter().find(|entry| entry["kind"] == "hopf").unwrap();
    assert_eq!(hopf["criticality"], "subcritical");
    assert!((hopf["period"].as_f64().unwrap() - 21.6002).abs() < 1e-4);
    assert_eq!(hopf["branch"], 2, "what begins there is known");
}

/// Rest, straight and circular motion of Ohta and Ohkuma's body: each begins at a pitchfork of the one before, at gamma = 0 and at
/// kappa^2/(a b) + kappa/2 = 0.75, and a branch does not go on into its own images, from whichever of them it is followed.
#[test]
fn branches_that_gain_a_symmetry_end_at_a_pitchfork() {
    let folder = Folder::new();
    for (start, expected) in
        [("1.2", ["circular", "straight", "motionless"]), ("0.4", ["straight", "circular", "motionless"])]
    {
        let along = format!("continue ohta-ohkuma --set gamma={start} --along gamma=-0.2:1.5 --json");
        let json = folder.run(&along).expect(0).json();
        let branches = json["branches"].as_array().unwrap();
        let mut motions: Vec<&str> =
            branches.iter().map(|branch| branch["motion"].as_str().unwrap()).collect();
        assert_eq!(motions[0], expected[0]);
        motions.sort_unstable();
        assert_eq!(motions, ["circular", "motionless", "straight"]);
        let specials = branches.iter().flat_map(|branch| branch["special"].as_array().unwrap());
        for special in specials {
            let gamma = special["gamma"].as_f64().unwrap();
            let exact = if special["breaks"] == "mirror" { 0.75 } else { 0.0 };
            assert!(special["kind"] == "pitchfork" && (gamma - exact).abs() < 1e-8, "{special}");
            assert!(special["branch"].is_u64(), "{special}");
        }
        let of = |name: &str| branches.iter().find(|branch| branch["motion"] == name).unwrap();
        let stable = |name: &str| of(name)["stable"][0].as_array().unwrap().clone();
        let near = |value: &Value, exact: f64| (value.as_f64().unwrap() - exact).abs() < 1e-8;
        assert!(near(&stable("circular")[0], 0.75) && near(&stable("circular")[1], 1.5));
        assert!(near(&stable("straight")[0], 0.0) && near(&stable("straight")[1], 0.75));
        assert!(near(&stable("motionless")[0], -0.2) && near(&stable("motionless")[1], 0.0));
    }
}

/// At zero force the body can move in any direction. This point is neither a fold nor a pitchfork, and no branch starts there. The
/// folds beside it belong to the motion against the force. For a body without an ellipse they are at g = 2 (gamma/3)^(3/2).
#[test]
fn a_force_that_vanishes_is_no_bifurcation() {
    let folder = Folder::new();
    let along = "continue force --set a1=0 --along g=-0.2:0.3 --json";
    let json = folder.run(along).expect(0).json();
    let branches = json["branches"].as_array().unwrap();
    assert_eq!(branches.len(), 1, "{json}");
    let fold = 2.0 * (0.1_f64).powf(1.5);
    let mut seen = [0, 0];
    for special in branches[0]["special"].as_array().unwrap() {
        let g = special["g"].as_f64().unwrap();
        match special["kind"].as_str().unwrap() {
            "continuum" => {
                seen[0] += 1;
                assert!(g.abs() < 1e-8);
            }
            kind => {
                seen[1] += 1;
                assert!(kind == "fold" && (g.abs() - fold).abs() < 1e-8, "{special}");
            }
        }
    }
    assert_eq!(seen, [2, 2]);
}

/// Branches of a handed body have a sense of rotation, and turning rates a sign: the mirror image for the opposite handedness.
#[test]
fn circular_branches_of_a_handed_body_have_a_sense() {
    let folder = Folder::new();
    let rates = [("0.3", "0.1:0.5", "clockwise"), ("-0.3", "-0.5:-0.1", "anticlockwise")].map(|(omega, range, course)| {
        let words = format!(
            "continue chiral --set kappa2=1.5 --set kappa3=0.8 --set omega={omega} --along omega={range} --out to{omega}"
        );
        let told = folder.run(&words).expect(0).stdout;
        assert!(told.contains(&format!("circular {course}")), "{told}");
        let summary = read_json(&folder.path(&format!("to{omega}/summary.json")));
        assert_eq!(summary["branches"][0]["course"], course);
        let found = read_json(&folder.path(&format!("to{omega}/branches.json")));
        let last = found["branches"][0]["legs"][usize::from(omega == "0.3")]["samples"].as_array().unwrap().last().unwrap().clone();
        last["reading"]["turning_rate"].as_f64().unwrap()
    });
    assert!(rates[0] < 0.0 && (rates[0] + rates[1]).abs() < 1e-9, "{rates:?}");
}

#[test]
fn the_folder_holds_points_summary_figures_and_the_plan() {
    let folder = Folder::new();
    let told = folder.run(&format!("{ZIGZAG} kappa2=0.85:0.95 --branches 1 --out run")).expect(0).stdout;
    assert!(told.contains("stable from 0.850000000 to 0.950000000"), "{told}");
    let expected = [
        "_inventory.jsonl",
        "branches.csv",
        "branches.json",
        "branches.png",
        "branches.svg",
        "manifest.json",
        "period.csv",
        "period.png",
        "period.svg",
        "points.parquet",
        "summary.json",
    ];
    assert_eq!(names(&folder.path("run")), expected);
    let manifest = read_json(&folder.path("run/manifest.json"));
    assert_eq!(manifest["plan_hash"].as_str().unwrap().len(), 64);
    assert_eq!(manifest["branches"]["computation"]["along"]["name"], "kappa2");
    let error =
        folder.run(&format!("{ZIGZAG} kappa2=0.85:0.95 --branches 1 --out run")).expect_error(2).stderr;
    assert!(error.contains("exists"), "{error}");
    let error = folder.run(&format!("{ZIGZAG} kappa2=0.8:0.95 --out run --resume")).expect_error(2).stderr;
    assert!(error.contains("branches of another plan (along.from: 0.85 there, 0.8 requested"), "{error}");
}

#[test]
fn what_cannot_be_followed_is_refused_with_the_reason() {
    let folder = Folder::new();
    let fig4 = "continue tensor --preset fig4 --set kappa3=0.1 --set kappa2=0.9";
    let cases = [
        (format!("{fig4} --along kapa2=0.3:1.6"), "did you mean kappa2"),
        (format!("{fig4} --along kappa2=1:1.6"), "the start, kappa2 = 0.9, is outside"),
        (format!("{fig4} --along kappa2=1.6:0.3"), "the range must rise"),
        (format!("{fig4} --along kappa2"), "write NAME=LOW:HIGH"),
        (format!("{fig4} --along kappa2=0.3:1.6 --motion zigzig"), "did you mean zigzag"),
        (format!("{fig4} --along kappa2=0.3:1.6 --motion circular"), "settles on zigzag motion"),
        (format!("{fig4} --along kappa2=0.3:1.6 --set kappa2=0.5"), "settles on chaotic motion"),
        (
            "continue tensor --preset fig1 --set kappa2=-0.1 --set gamma=-0.04 --along gamma=-0.1:0"
                .to_owned(),
            "settles on rectangular motion",
        ),
        ("continue cell --along modes=10:20".to_owned(), "whole number"),
    ];
    for (words, expected) in cases {
        let error = folder.run(&words).expect_error(2).stderr;
        assert!(error.contains(expected), "{words}: {error}");
    }
    assert_eq!(folder.names(), [""; 0], "nothing is left behind");
}

#[test]
fn the_reduced_models_lines_are_found() {
    let folder = Folder::new();
    // straight -> circular at s = 0.1: gamma = 32 s^2 + 2 s, kappa2 = 4 s - 8 s^2 (a1 = 1, b1 = 0.5, b3 = 1)
    let s: f64 = 0.1;
    let (gamma, expected) = (32.0 * s * s + 2.0 * s, 4.0 * s - 8.0 * s * s);
    let words = format!(
        "continue tensor --preset fig1 --set gamma={gamma} --set kappa2=0.6 --along kappa2=0.2:0.8 --json"
    );
    let json = folder.run(&words).expect(0).json();
    let found = places(&json, "pitchfork");
    assert!(holds(&found, expected, 1e-8), "{found:?}, expected {expected}");
    assert_eq!(json["branches"][0]["motion"], "straight");
    assert_eq!(json["branches"][1]["motion"], "circular");
}

/// Waits until the program listens for SIGINT: the kernel shows the mask of caught signals.
pub(crate) fn interrupt(mut child: Child, after: Duration) -> Option<i32> {
    let start = Instant::now();
    loop {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
        let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
        if u64::from_str_radix(caught.trim(), 16).unwrap() & 2 != 0 {
            break;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "the program never listened for Ctrl-C");
        sleep(Duration::from_millis(2));
    }
    sleep(after);
    Command::new("bash").args(["-c", &format!("kill -INT {}", child.id())]).status().unwrap();
    child.wait().unwrap().code()
}

#[test]
fn an_interrupted_run_goes_on_to_the_same_points() {
    let folder = Folder::new();
    let words = format!("{ZIGZAG} kappa2=0.6:1.2 --branches 3 --no-figures");
    folder.run(&format!("{words} --out whole")).expect(0);
    let mut command = folder.command(&format!("{words} --out parts"));
    let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let code = interrupt(child, Duration::from_millis(900));
    assert!(code == Some(130) || code == Some(0), "{code:?}");
    if code == Some(130) {
        assert_eq!(read_json(&folder.path("parts/manifest.json"))["complete"], false);
    }
    folder.run(&format!("{words} --out parts --resume")).expect(0);
    for name in ["points.parquet", "summary.json", "branches.json", "manifest.json"] {
        let bytes = |out: &str| std::fs::read(folder.path(out).join(name)).unwrap();
        assert_eq!(bytes("whole"), bytes("parts"), "{name}");
    }
}
