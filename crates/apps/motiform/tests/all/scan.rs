//! Scans from the command line: killed at any moment and resumed, sharded and merged, damaged, and refused.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]
#![cfg(target_os = "linux")]

use crate::common;

use common::{Done, Folder, keys, names};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Far longer than any of this takes.
const PATIENCE: Duration = Duration::from_secs(120);

/// 300 cells in 150 parts, little to do in each.
const MANY: &str = "scan tensor --preset fig1 --axis kappa2=0.1:1.6:20 --axis gamma=-1:1:15 --samples 2 --budget 30 --no-figures";

/// Runs a scan whose motions may be undetermined: exit code 0 or 1.
fn scan(folder: &Folder, words: &str) -> Done {
    let done = folder.run(words);
    let code = done.code;
    assert!(matches!(code, Some(0 | 1)), "{code:?}\n{}\n{}", done.stdout, done.stderr);
    done
}

/// Every file that is no lock, with its bytes.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let names = names(folder).into_iter().filter(|name| name != ".lock");
    names.map(|name| (name.clone(), std::fs::read(folder.join(name)).unwrap())).collect()
}

fn count_parts(folder: &Path) -> usize {
    let entries: Vec<_> =
        std::fs::read_dir(folder).map(|entries| entries.flatten().collect()).unwrap_or_default();
    entries.iter().filter(|entry| entry.file_name().to_string_lossy().starts_with("part-")).count()
}

/// Starts a scan and waits until it has written so many parts, or is done.
fn start(folder: &Folder, words: &str, parts: usize) -> Child {
    let mut command = folder.command(words);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let begun = Instant::now();
    while !folder.path("run").exists() || count_parts(&folder.path("run")) < parts {
        assert!(begun.elapsed() < PATIENCE, "no {parts} parts after {PATIENCE:?}");
        if child.try_wait().unwrap().is_some() {
            break;
        }
        sleep(Duration::from_millis(1));
    }
    child
}

/// The options of the method are those of the plan, and `classify` with the same ones has the same motion.
#[test]
fn a_scan_has_the_method_that_was_asked_for() {
    let folder = Folder::new();
    let method = "--rtol 1e-6 --stepper dopri5 --json";
    let words = "scan tensor --preset fig5a --axis kappa2=0.8,0.9 --no-figures --out scan";
    folder.run(&format!("{words} {method}")).expect(0);
    let manifest = std::fs::read_to_string(folder.path("scan/_manifest.json")).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    let plan = &manifest["plan"]["computation"];
    assert_eq!((&plan["stepper"], &plan["control"]["rtol"]), (&"dopri5".into(), &1e-6.into()), "{plan}");
    let refused =
        folder.run("scan tensor --preset fig5a --axis kappa2=0.8 --stepper dopri --out other").expect(2);
    assert!(refused.stderr.contains("did you mean dopri5?"), "{}", refused.stderr);
    for kappa2 in ["0.8", "0.9"] {
        let done = folder.run(&format!("classify tensor --preset fig5a --set kappa2={kappa2} {method}"));
        assert_eq!(done.expect(0).json()["regime"], "zigzag", "{kappa2}");
    }
}

#[test]
fn killed_at_any_moment_and_resumed() {
    let folder = Folder::new();
    scan(&folder, &format!("{MANY} --threads 2 --out whole"));
    let whole = contents(&folder.path("whole"));
    assert_eq!(whole.len(), 152);
    let mut killed = 0;
    for parts in [0, 1, 2, 40, 90, 140] {
        let mut child = start(&folder, &format!("{MANY} --threads 2 --out run --resume"), parts);
        child.kill().unwrap(); // SIGKILL
        child.wait().unwrap();
        let there = count_parts(&folder.path("run"));
        println!("killed with {there} of 150 parts");
        killed += usize::from(there < 150);
    }
    assert!(killed >= 3, "the scan was over too soon to be killed");
    let done = scan(&folder, &format!("{MANY} --threads 1 --out run --resume"));
    assert!(!done.stderr.contains("recomputed"), "a kill damages no part: {}", done.stderr);
    assert!(contents(&folder.path("run")) == whole);
    // Nothing is left to do: nothing changes.
    scan(&folder, &format!("{MANY} --out run --resume"));
    assert!(contents(&folder.path("run")) == whole);
}

#[test]
fn ctrl_c_keeps_whole_parts() {
    let folder = Folder::new();
    let long = MANY.replace("--budget 30", "--budget 3000");
    let child = start(&folder, &format!("{long} --threads 2 --out run"), 1);
    let kill = Command::new("bash").args(["-c", &format!("kill -INT {}", child.id())]).status().unwrap();
    assert!(kill.success());
    let done = Done::from(child.wait_with_output().unwrap()).expect(130);
    assert!(done.stderr.contains("the same `motiform scan` with --resume continues"), "{}", done.stderr);
    let parts = count_parts(&folder.path("run"));
    assert!((1..150).contains(&parts), "{parts}");
    assert!(names(&folder.path("run")).iter().all(|name| !name.ends_with(".partial")));
}

#[test]
fn shards_threads_and_a_merge_give_the_same_bytes() {
    let folder = Folder::new();
    scan(&folder, &format!("{MANY} --threads 1 --out whole"));
    for shard in 1..=3 {
        let done =
            scan(&folder, &format!("{MANY} --shard {shard}/3 --threads {shard} --out s{shard} --json"));
        assert_eq!(done.json()["missing"], 200);
    }
    let some = folder.run("merge s1 s3 --out some").expect(1);
    assert!(
        some.stderr.contains("50 of 150 parts (100 cells) are in none of these folders"),
        "{}",
        some.stderr
    );
    let all = scan(&folder, "merge some s2 --out all --json");
    assert_eq!(all.json()["missing"], 0);
    assert!(contents(&folder.path("all")) == contents(&folder.path("whole")));
    scan(&folder, &format!("{MANY} --out some --resume"));
    assert!(contents(&folder.path("some")) == contents(&folder.path("whole")));
}

#[test]
fn the_json_object_counts_everything() {
    let folder = Folder::new();
    folder.write(
        "study.toml",
        "preset = \"fig1\"\n[scan]\naxes = [\"kappa2=0.5,1\", \"gamma=-1\"]\nsamples = 3\n",
    );
    let json = folder.run("scan study.toml --json").expect(0).json();
    let expected = [
        "plan_hash",
        "cells",
        "random",
        "rows",
        "regimes",
        "multistable",
        "undetermined",
        "escaped",
        "missing",
        "folder",
    ];
    assert_eq!(keys(&json), expected);
    assert_eq!(
        (&json["cells"], &json["rows"], &json["folder"]),
        (&2.into(), &6.into(), &"tensor-study-scan".into())
    );
    assert_eq!(json["regimes"]["motionless"], 6); // gamma < 0: nothing drives it
    let checked = folder.run("check study.toml").expect(0).stdout;
    assert!(checked.contains(json["plan_hash"].as_str().unwrap()), "{checked}");
    let other = scan(&folder, "scan study.toml --axis kappa2=0.5:1:3 --samples 1 --out other --json").json();
    assert_eq!((&other["cells"], &other["rows"]), (&3.into(), &3.into())); // the command line wins
}

#[test]
fn damaged_parts_are_found_recomputed_and_said() {
    let folder = Folder::new();
    scan(&folder, &format!("{MANY} --out run"));
    let whole = contents(&folder.path("run"));
    let path = |part: usize| folder.path("run").join(format!("part-{part:05}.parquet"));
    std::fs::write(path(7), &whole["part-00007.parquet"][..100]).unwrap();
    let mut bytes = whole["part-00011.parquet"].clone();
    bytes[50] ^= 4;
    std::fs::write(path(11), bytes).unwrap();
    let done = scan(&folder, &format!("{MANY} --out run --resume"));
    for part in ["part-00007.parquet: it is cut off", "part-00011.parquet: its bytes do not give its digest"]
    {
        assert!(done.stderr.contains(part), "{}", done.stderr);
    }
    assert_eq!(done.stderr.matches("its cells are recomputed").count(), 2);
    for part in [7, 11] {
        let aside = format!("_damaged-part-{part:05}.parquet");
        assert!(done.stderr.contains(&format!("it is kept as {aside}")), "{}", done.stderr);
        std::fs::remove_file(folder.path("run").join(aside)).unwrap();
    }
    assert!(contents(&folder.path("run")) == whole);
}

#[test]
fn two_processes_do_not_share_a_folder() {
    let folder = Folder::new();
    let long = MANY.replace("--budget 30", "--budget 3000");
    let mut child = start(&folder, &format!("{long} --out run"), 1);
    for words in ["--resume", "--force"] {
        let done = folder.run(&format!("{long} --out run {words}")).expect_error(2);
        assert_eq!(
            done.stderr,
            "error: another motiform process computes in run: wait until it is done, or choose another --out\n"
        );
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

/// A limit on the size of files (4 KiB) stands in for a full disk: parts are larger, the manifest is not.
#[test]
fn a_full_disk() {
    let folder = Folder::new();
    let words = "scan tensor --preset fig1 --axis kappa2=0.1:1.6:20 --samples 4 --budget 30 --out run";
    let full = folder.bash(&format!("trap '' XFSZ; ulimit -f 4; exec $motiform {words}")).expect_error(2);
    assert!(full.stderr.starts_with("error: writing run/part-000"), "{}", full.stderr);
    assert!(
        full.stderr.contains("File too large")
            && full
                .stderr
                .contains("complete parts are kept; free some space and run again; --resume continues it")
    );
    assert_eq!(names(&folder.path("run")), ["_inventory.jsonl", "_manifest.json"]);
    scan(&folder, &format!("{words} --resume"));
    assert_eq!(count_parts(&folder.path("run")), 20);
    // No room for anything: nothing is left behind.
    let words = words.replace("--out run", "--out none");
    let full = folder.bash(&format!("trap '' XFSZ; ulimit -f 0; exec $motiform {words}")).expect_error(2);
    assert!(full.stderr.contains("writing none failed"), "{}", full.stderr);
    let full = folder.bash("trap '' XFSZ; ulimit -f 4; exec $motiform merge run --out all").expect_error(2);
    assert!(full.stderr.contains("free some space and run again"), "{}", full.stderr);
    assert_eq!(folder.names(), ["run"]);
}

/// Figures carry an underscore, so that readers of the whole folder pass them over; `figure` draws them again.
#[test]
fn a_scan_has_its_figures() {
    let folder = Folder::new();
    scan(&folder, "scan tensor --preset fig1 --axis kappa2=0.5,1 --axis gamma=-1:1:3 --out plane");
    scan(&folder, "scan tensor --preset fig1 --axis gamma=-1:1:3 --out line");
    for (name, figures) in [("plane", vec!["_diagram"]), ("line", vec!["_diagram", "_exponent"])] {
        let svg = |figure: &str| std::fs::read(folder.path(name).join(format!("{figure}.svg"))).unwrap();
        let before: Vec<_> = figures.iter().map(|figure| svg(figure)).collect();
        let done = folder.run(&format!("figure {name}")).expect(0);
        for (figure, before) in figures.iter().zip(before) {
            assert!(done.stdout.contains(&format!("{figure}.svg {figure}.png")), "{}", done.stdout);
            assert!(svg(figure) == before);
        }
    }
}

/// In a model that tells left from right the two senses of circular motion have marks of their own, and values carry no round-off.
#[test]
fn maps_tell_the_senses_of_turning_apart() {
    let folder = Folder::new();
    let axes = "--axis omega=-0.2,0.1,0.2 --axis kappa2=1.1:1.5:9";
    let done = folder.run(&format!("scan chiral {axes} --out map")).expect(0);
    assert!(
        done.stdout.contains("omega = -0.2, 0.1, 0.2") && done.stdout.contains("27 rows (100.0 %)"),
        "{}",
        done.stdout
    );
    let svg = std::fs::read_to_string(folder.path("map/_diagram.svg")).expect("a figure");
    for words in [">circular, anticlockwise<", ">circular, clockwise<", "stand in columns of one width"] {
        assert!(svg.contains(words), "{words}");
    }
    let line = folder.run("scan tensor --preset fig4 --axis kappa2=0.1:0.6:5 --out line").expect(0);
    assert!(line.stdout.contains("kappa2 = 0.1, 0.225, 0.35, 0.475, 0.6"), "{}", line.stdout);
}
