//! Ctrl-C ends a run soon, and what was computed until then is a complete dataset.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]
#![cfg(target_os = "linux")]

use crate::common;

use common::{Done, Folder, names, read_json};
use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Far longer than any of this takes; a run that ignored the signal would go on for hours.
const PATIENCE: Duration = Duration::from_secs(60);

/// Waits until the program listens for SIGINT: the kernel shows the mask of caught signals.
fn wait_until_it_listens(child: &Child) {
    let start = Instant::now();
    loop {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
        let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
        if u64::from_str_radix(caught.trim(), 16).unwrap() & 2 != 0 {
            return;
        }
        assert!(start.elapsed() < PATIENCE, "the program never listened for Ctrl-C");
        sleep(Duration::from_millis(2));
    }
}

fn wait(mut child: Child) -> Done {
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > PATIENCE {
            child.kill().unwrap();
            panic!("still running {PATIENCE:?} after Ctrl-C");
        }
        sleep(Duration::from_millis(5));
    }
    println!("ended {:.2} s after Ctrl-C", start.elapsed().as_secs_f64());
    child.wait_with_output().unwrap().into()
}

/// Starts a run of astronomical length, lets it work, and interrupts it.
fn interrupt(folder: &Folder, words: &str) -> Done {
    let long = "simulate tensor --preset fig5a --t-end 1e9 --dt-out 100 --max-steps 100000000000 --out run";
    let mut command = folder.command(&format!("{long} {words}"));
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    wait_until_it_listens(&child);
    sleep(Duration::from_millis(300)); // some rows; none would be right too
    interrupt_child(&child);
    wait(child)
}

fn interrupt_child(child: &Child) {
    let kill = Command::new("bash").args(["-c", &format!("kill -INT {}", child.id())]).status().unwrap();
    assert!(kill.success());
}

#[test]
fn what_was_computed_is_kept() {
    let folder = Folder::new();
    let done = interrupt(&folder, "--transient 0").expect(130);
    assert!(done.stdout.contains("outcome   interrupted at t = "), "{}", done.stdout);
    assert_eq!(done.stderr, "");
    assert_eq!(folder.names(), ["run"]);
    let manifest = read_json(&folder.path("run/manifest.json"));
    assert_eq!(manifest["outcome"]["kind"], "interrupted");
    let t = manifest["outcome"]["t"].as_f64().unwrap();
    assert!(t > 0.0 && t < 1e9, "{t}");
    assert!(manifest["steps"].as_u64().unwrap() > 0);
    folder.run("figure run").expect(0); // complete and readable
}

#[test]
fn json_says_so_too() {
    let folder = Folder::new();
    let json = interrupt(&folder, "--transient 0 --json --no-figures").expect(130).json();
    assert_eq!(json["outcome"]["kind"], "interrupted");
    assert_eq!(json["t"], json["outcome"]["t"]);
    assert_eq!(names(&folder.path("run")), ["_inventory.jsonl", "manifest.json", "trajectory.parquet"]);
}

/// An end during the transient says so, with the time since the start; that is a dataset too.
#[test]
fn during_the_transient() {
    let folder = Folder::new();
    interrupt(&folder, "--transient 1e9").expect(130);
    let manifest = read_json(&folder.path("run/manifest.json"));
    assert_eq!(manifest["outcome"]["kind"], "interrupted");
    assert!(manifest["outcome"]["t"].as_f64().unwrap() > 0.0);
    assert_eq!(manifest["outcome"]["during"], "transient");
    assert_eq!(names(&folder.path("run")), ["_inventory.jsonl", "manifest.json", "trajectory.parquet"]);
    folder.run("figure run").expect(0);
}

/// Statistics are those of the bodies that are finished.
#[test]
fn bodies_that_are_finished_are_measured() {
    let folder = Folder::new();
    let words =
        "statistics tensor --set gamma=1 --set kappa2=2 --noise 0.1 --t-end 20 --bodies 100000 --threads 2";
    let interrupted_after = |pause: u64| {
        let mut command = folder.command(&format!("{words} --out found --force"));
        let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        wait_until_it_listens(&child);
        sleep(Duration::from_millis(pause));
        interrupt_child(&child);
        wait(child).expect(130)
    };
    let left_out = |done: &Done| done.stderr.contains("of 100000 bodies were not finished and are left out");
    // 64 bodies take a tenth of a second, or a few on a busy machine
    let done = [2500, 20_000].into_iter().map(interrupted_after).find(left_out);
    assert!(done.is_some(), "none was finished");
    let found = read_json(&folder.path("found/statistics.json"));
    let bodies = found["bodies"].as_u64().unwrap();
    assert!((1..100_000).contains(&bodies) && found["complete"] == false, "{bodies}");
    assert!(found["mean_speed"]["value"].is_f64());
}

/// Tracked cells: nothing is written while cells are observed, and everything but pages while these are drawn.
#[test]
fn observations_say_so_too() {
    let folder = Folder::new();
    let names: Vec<String> = (0..600).map(|number| format!("c{number}")).collect();
    let cells: Vec<&str> = names.iter().map(String::as_str).collect();
    folder.write("cells.csv", &crate::observe::table(&cells));
    for pause in [0, 300] {
        let mut command =
            folder.command("observe cells.csv --pixel-size 0.5 --interval 2 --out seen --force");
        let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        wait_until_it_listens(&child);
        sleep(Duration::from_millis(pause));
        interrupt_child(&child);
        let done = wait(child).expect(130);
        assert!(done.stderr.contains("interrupted"), "{}", done.stderr);
        if done.stderr.contains("no observation is written") {
            assert_eq!(folder.names(), ["cells.csv"]);
        } else {
            folder.run("verify seen").expect(0); // all but pages
            fs::remove_dir_all(folder.path("seen")).unwrap();
        }
    }
}
